// What a user can get wrong with joints, attachments and their probes: refused with exit code 2 and a message
// that says where it is, what stands there and what may, and nothing is written.
#include "mistakes.h"
#include "two_bodies.h"

using namespace pbdcheck::test;

namespace {

const std::vector<Mistake> joint_mistakes{
    {joint("bal", ""), {"scene.toml:17: joint.0.kind", "`bal`", "did you mean `ball`?"}},
    {"[[joint]]\nbodies = [\"arm\", \"hand\"]\n",
     {"scene.toml:15: joint.0.kind", "got nothing", "one of ball, hinge"}},
    {"[[joint]]\nkind = \"ball\"\n", {"scene.toml:15: joint.0.bodies", "got nothing"}},
    {"[[joint]]\nkind = \"ball\"\nbodies = [\"arm\"]\n",
     {"scene.toml:17: joint.0.bodies", "arm", "a list of 2 texts"}},
    {"[[joint]]\nkind = \"ball\"\nbodies = [\"arm\", 1]\n",
     {"scene.toml:17: joint.0.bodies", "a list of 2 texts"}},
    {"[[joint]]\nkind = \"ball\"\nbodies = [\"arm\", \"hnd\"]\n",
     {"scene.toml:17: joint.0.bodies", "`hnd`", "one of world, arm, hand", "did you mean `hand`?"}},
    {"[[joint]]\nkind = \"ball\"\nbodies = [\"arm\", \"arm\"]\n",
     {"scene.toml:17: joint.0.bodies", "`arm` twice", "two different bodies"}},
    {wall + "[[joint]]\nkind = \"ball\"\nbodies = [\"world\", \"wall\"]\n",
     {"scene.toml:20: joint.0.bodies", "two bodies that nothing moves"}},
    {joint("ball", ""), {"scene.toml:15: joint.0.point_m", "got nothing"}},
    {joint("ball", "point_m = [0, 0, 0]\naxis = [1, 0, 0]\n"),
     {"scene.toml:19: joint.0.axis", "unknown key"}},
    {joint("ball", "point_m = [0, 0, 0]\ncompliance_rad_per_n_m = 1\n"),
     {"scene.toml:19: joint.0.compliance_rad_per_n_m", "unknown key"}},
    {joint("ball", "point_m = [0, 0, 0]\ncompliance_m_per_n = 1\nstiffness_n_per_m = 1\n"),
     {"scene.toml:20: joint.0.stiffness_n_per_m", "one of them"}},
    {joint("angle", "axis = [0, 0, 1]\nstiffness_n_m_per_rad = 0\n"),
     {"scene.toml:19: joint.0.stiffness_n_m_per_rad", "got 0", "> 0"}},
    {joint("weld", "point_m = [0, 0, 0]\ndamping_s = -1\n"),
     {"scene.toml:19: joint.0.damping_s", "got -1", ">= 0"}},
    {joint("hinge", "point_m = [0, 0, 0]\n"), {"scene.toml:15: joint.0.axis", "got nothing"}},
    {joint("hinge", "point_m = [0, 0, 0]\naxis = [0, 0, 0]\n"),
     {"scene.toml:19: joint.0.axis", "the zero vector", "a direction of any length"}},
    {joint("universal", "point_m = [0, 0, 0]\naxis = [0, 0, 1]\nsecond_axis = [1, 0, 1]\n"),
     {"scene.toml:20: joint.0.second_axis", "[ 1, 0, 1 ]", "at right angles to axis"}},
    {joint("distance", "points_m = [[0, 0, 0]]\n"),
     {"scene.toml:18: joint.0.points_m", "[ [ 0, 0, 0 ] ]", "a place of the first body"}},
    {joint("distance", "points_m = [[0, 0, 0], [0, 0, 0]]\n"),
     {"scene.toml:15: joint.0", "a hard distance of rest length 0", "or a ball"}},
    {joint("angle", "axis = [0, 0, 1]\nrate_rad_s = inf\n"),
     {"scene.toml:19: joint.0.rate_rad_s", "got inf"}},
    {joint("slide", "axis = [0, 0, 1]\npoints_m = [[0, 0, 0], [0, 0, 0]]\nrate_rad_s = 1\n"),
     {"scene.toml:20: joint.0.rate_rad_s", "did you mean `rate_m_s`?"}},
    {joint("angle", "axis = [0, 0, 1]\nmin_angle_rad = 0.5\nmax_angle_rad = 0.5\n"),
     {"scene.toml:20: joint.0.max_angle_rad", "got 0.5", "above min_angle_rad"}},
    {joint("angle", "axis = [0, 0, 1]\nmin_angle_rad = -2\nmax_angle_rad = 2\n"),
     {"scene.toml:20: joint.0.max_angle_rad", "got 2", "less than half a turn"}},
    {joint("angle", "axis = [0, 0, 1]\nmin_angle_rad = 7\nmax_angle_rad = 8\n"),
     {"scene.toml:19: joint.0.min_angle_rad", "got 7", "between -pi and pi"}},
    {joint("angle", "axis = [0, 0, 1]\nmax_angle_rad = -3.5\nmin_angle_rad = -3\n"),
     {"scene.toml:19: joint.0.max_angle_rad", "got -3.5", "between -pi and pi"}},
    {joint("angle", "axis = [0, 0, 1]\nmin_angle_rad = nan\n"),
     {"scene.toml:19: joint.0.min_angle_rad", "got nan", "finite"}},
    {joint("angle", "axis = [0, 0, 1]\nmin_angle_rad = -1\nrate_rad_s = 1\n"),
     {"scene.toml:20: joint.0.rate_rad_s", "rate_rad_s and limits", "a joint of its own"}},
    {joint("angle", "axis = [0, 0, 1]\nmax_angle_rad = 1\nmax_torque_n_m = 1\n"),
     {"scene.toml:20: joint.0.max_torque_n_m", "max_torque_n_m and limits"}},
    {joint("angle", "axis = [0, 0, 1]\nmax_torque_n_m = 0\n"),
     {"scene.toml:19: joint.0.max_torque_n_m", "got 0", "> 0"}},
    {joint("angle", "axis = [0, 0, 1]\nmax_force_n = 1\n"),
     {"scene.toml:19: joint.0.max_force_n", "unknown key"}},
    {joint("slide", "axis = [0, 0, 1]\npoints_m = [[0, 0, 0], [0, 0, 0]]\nmax_angle_rad = 1\n"),
     {"scene.toml:20: joint.0.max_angle_rad", "unknown key"}},
    {joint("slide",
           "axis = [0, 0, 1]\npoints_m = [[0, 0, 0], [0, 0, 0]]\nmax_position_m = 0\nmin_position_m "
           "= 1\n"),
     {"scene.toml:20: joint.0.max_position_m", "got 0", "above min_position_m"}},
    {joint("distance", "points_m = [[0, 0, 0], [1, 0, 0]]\nmax_length_m = 0\n"),
     {"scene.toml:19: joint.0.max_length_m", "got 0", "> 0"}},
    {joint("distance", "points_m = [[0, 0, 0], [1, 0, 0]]\nmax_length_m = 1\nrest_length_m = 1\n"),
     {"scene.toml:20: joint.0.rest_length_m", "rest_length_m and limits"}},
    {joint("angle", "axis = [0, 0, 1]\nover_time = [[0, 1]]\n"),
     {"scene.toml:19: joint.0.over_time", "a course without a rate", "rate_rad_s"}},
    {joint("angle", "axis = [0, 0, 1]\nmax_angle_rad = 1\nover_time = [[0, 1]]\n"),
     {"scene.toml:20: joint.0.over_time", "over_time and limits"}},
    {joint("ball", "point_m = [0, 0, 0]\nover_time = [[0, 1]]\n"),
     {"scene.toml:19: joint.0.over_time", "unknown key"}},
    {body("name = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 1]\nover_time = [[0, 1]]\n"),
     {"scene.toml:19: rigid_body.2.over_time", "held = \"free\"", "held = \"moving\""}},
    {"[[torque]]\nbody = \"arm\"\ntorque_n_m = [1, 0, 0]\nover_time = []\n",
     {"scene.toml:18: torque.0.over_time", "an empty list", "at least one"}},
    {"[[torque]]\nbody = \"arm\"\ntorque_n_m = [1, 0, 0]\nover_time = [[0, 1], [0, 2]]\n",
     {"scene.toml:18: torque.0.over_time", "the time 0 after 0", "times that grow"}},
    {"[[torque]]\nbody = \"arm\"\ntorque_n_m = [1, 0, 0]\nover_time = [0, 1]\n",
     {"scene.toml:18: torque.0.over_time", "got 0", "a list of lists of two numbers"}},
    {"[[torque]]\nbody = \"arm\"\ntorque_n_m = [1, 0, 0]\nover_time = [[0, nan]]\n",
     {"scene.toml:18: torque.0.over_time", "got nan", "finite"}},
    {joint("ball", "point_m = [0, 0, 0]\nmax_force_n = 1\n"),
     {"scene.toml:19: joint.0.max_force_n", "unknown key"}},
    {joint("ball", "name = \"a\"\npoint_m = [0, 0, 0]\n") +
         joint("ball", "name = \"a\"\npoint_m = [0, 0, 0]\n"),
     {"scene.toml:23: joint.1.name", "`a` twice", "a name of its own"}},
    {"[gyroscopic]\nform = \"exact\"\n", {"scene.toml:16: gyroscopic.form", "`exact`", "implicit, explicit"}},
    {"[[torque]]\nbody = \"leg\"\ntorque_n_m = [1, 0, 0]\n",
     {"scene.toml:16: torque.0.body", "`leg`", "one of world"}},
    {"[[torque]]\nbody = \"arm\"\n", {"scene.toml:15: torque.0.torque_n_m", "got nothing"}},
    {"[[force]]\nbody = \"arm\"\nnode = 0\nforce_n = [1, 0, 0]\n",
     {"scene.toml:17: force.0.node", "unknown key"}},
    {"[[force]]\nnode = 0\nforce_n = [1, 0, 0]\n",
     {"scene.toml:16: force.0.node", "a scene without nodes", "rigid bodies have names"}},
    {"[[distance]]\nnodes = [0, 1]\n", {"scene.toml:16: distance.0.nodes", "a scene without nodes"}},
    {"[[attachment]]\nnode = 0\n",
     {"scene.toml:15: attachment.0.body", "got nothing", "one of world, arm, hand"}},
    {"[[chain]]\nlength_m = 1\nmass_kg = 1\n[[attachment]]\nbody = \"arm\"\nnode = 21\n",
     {"scene.toml:20: attachment.0.node", "got 21", "from 0 to 20"}},
    {"[[chain]]\nlength_m = 1\nmass_kg = 1\n[[attachment]]\nbody = \"arm\"\nnode = 1\n[[attachment]]\nbody = "
     "\"arm\"\nnodes = [2, 1]\n",
     {"scene.toml:21: attachment.1", "node 1 attached twice"}},
    {"[[chain]]\nlength_m = 1\nmass_kg = 1\nstart = \"fixed\"\n[[attachment]]\nbody = \"world\"\nnode = 0\n",
     {"scene.toml:19: attachment.0", "node 0 and a body that nothing moves"}},
    {"[[probe]]\nkind = \"position\"\nbody = \"leg\"\n",
     {"scene.toml:17: probe.0.body", "`leg`", "one of arm, hand"}},
    {"[[probe]]\nkind = \"orientation\"\n",
     {"scene.toml:15: probe.0.body", "got nothing", "one of arm, hand"}},
    {"[[probe]]\nkind = \"joint_force\"\njoint = \"knee\"\n",
     {"scene.toml:17: probe.0.joint", "`knee`", "of which the scene has none"}},
    {joint("ball", "name = \"elbow\"\npoint_m = [0, 0, 0]\n") +
         "[[probe]]\nkind = \"joint_force\"\njoint = \"elbov\"\n",
     {"scene.toml:22: probe.0.joint", "`elbov`", "did you mean `elbow`?"}},
    {"[method]\nintegrator = \"symplectic_euler\"\n" +
         joint("ball", "name = \"elbow\"\npoint_m = [0, 0, 0]\nstiffness_n_per_m = 1\n") +
         "[[probe]]\nkind = \"joint_force\"\njoint = \"elbow\"\n",
     {"scene.toml:25: probe.0.joint", "a compliant joint under symplectic_euler", "an implicit integrator"}},
};

}  // namespace

TEST_CASE("mistakes with joints are refused with line, key, value and what is allowed") {
  const TemporaryFolder folder;
  const auto out = folder.path / "out";
  for (const auto& mistake : joint_mistakes) {
    INFO(mistake.text);
    const auto scene = folder.write("scene.toml", two_bodies + mistake.text);
    const auto ran = run_program({"simulate", scene, "-o", out});
    check_refused(ran, mistake.message);
    CHECK(std::count(ran.err.begin(), ran.err.end(), '\n') == 1);
    CHECK_FALSE(std::filesystem::exists(out));
  }
}
