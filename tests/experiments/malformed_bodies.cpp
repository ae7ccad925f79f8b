// What a user can get wrong with rigid bodies and joints: refused with exit code 2 and a message that says
// where it is, what stands there and what may, and nothing is written.
#include "mistakes.h"

using namespace pbdcheck::test;

namespace {

// Lines 1 to 14 of every scene below.
const std::string two_bodies = R"([[rigid_body]]
name = "arm"
shape = "sphere"
radius_m = 0.5
mass_kg = 2
[[rigid_body]]
name = "hand"
mass_kg = 1
inertia_kg_m2 = [1, 2, 2.5]
position_m = [1, 0, 0]
[step]
step_s = 0.01
steps = 2

)";

std::string body(const std::string& rest) {
  return "[[rigid_body]]\n" + rest;
}

/// Line 15 to 17 and what follows.
std::string joint(const std::string& kind, const std::string& rest) {
  return "[[joint]]\nbodies = [\"arm\", \"hand\"]\nkind = \"" + kind + "\"\n" + rest;
}

const std::string sphere = "name = \"third\"\nshape = \"sphere\"\n";
const std::string wall = body("name = \"wall\"\nheld = \"fixed\"\n");

const std::vector<Mistake> mistakes{
    {body("mass_kg = 1\n"), {"scene.toml:15: rigid_body.2.name", "got nothing"}},
    {body("name = \"Arm\"\n"), {"scene.toml:16: rigid_body.2.name", "`Arm`", "lower case letters"}},
    {body("name = \"arm\"\n"), {"scene.toml:16: rigid_body.2.name", "`arm` twice", "a name of its own"}},
    {body("name = \"world\"\n"), {"scene.toml:16: rigid_body.2.name", "`world`", "another name"}},
    {body("name = \"a\"\nshape = \"spere\"\n"),
     {"scene.toml:17: rigid_body.2.shape", "did you mean `sphere`?"}},
    {body(sphere + "mass_kg = 1\n"), {"scene.toml:15: rigid_body.2.radius_m", "got nothing"}},
    {body(sphere + "radius_m = 0\n"), {"scene.toml:18: rigid_body.2.radius_m", "got 0", "> 0"}},
    {body(sphere + "radius_m = 1\n"),
     {"scene.toml:15: rigid_body.2.density_kg_m3", "density_kg_m3 or mass_kg"}},
    {body(sphere + "radius_m = 1\nlength_m = 1\nmass_kg = 1\n"),
     {"scene.toml:19: rigid_body.2.length_m", "unknown key"}},
    {body(sphere + "radius_m = 1\nmass_kg = 1\ndensity_kg_m3 = 1\n"),
     {"scene.toml:19: rigid_body.2.mass_kg", "a density and a mass", "one of them"}},
    {body(sphere + "radius_m = 1\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 1]\n"),
     {"scene.toml:20: rigid_body.2.inertia_kg_m2", "a shape and moments of inertia"}},
    {body(sphere + "radius_m = 1\nmass_kg = inf\n"), {"scene.toml:19: rigid_body.2.mass_kg", "got inf"}},
    {body(sphere + "radius_m = 1e100\ndensity_kg_m3 = 1\n"),
     {"scene.toml:15: rigid_body.2", "moments of inertia inf", "up to 1e100"}},
    {body(sphere + "radius_m = 1e-80\ndensity_kg_m3 = 1\n"),
     {"scene.toml:15: rigid_body.2", "moments of inertia 0"}},
    {body(sphere + "radius_m = 1\nmass_kg = 1\nheld = \"still\"\n"),
     {"scene.toml:20: rigid_body.2.held", "`still`", "free, fixed, moving"}},
    {body(sphere + "radius_m = 1\nheld = \"fixed\"\nvelocity_m_s = [1, 0, 0]\n"),
     {"scene.toml:20: rigid_body.2.velocity_m_s", "a fixed body", "moving"}},
    {body("name = \"a\"\nshape = \"box\"\nsize_m = [1, 1]\nmass_kg = 1\n"),
     {"scene.toml:18: rigid_body.2.size_m", "[ 1, 1 ]", "a list of 3 numbers"}},
    {body("name = \"a\"\nmass_kg = 1\n"), {"scene.toml:15: rigid_body.2.inertia_kg_m2", "got nothing"}},
    {body("name = \"a\"\ninertia_kg_m2 = [1, 1, 1]\n"),
     {"scene.toml:15: rigid_body.2.mass_kg", "got nothing"}},
    {body("name = \"a\"\ndensity_kg_m3 = 1\n"),
     {"scene.toml:17: rigid_body.2.density_kg_m3", "a density without a shape"}},
    {body("name = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 3]\n"),
     {"scene.toml:18: rigid_body.2.inertia_kg_m2", "[ 1, 1, 3 ]", "none larger than the sum"}},
    {body("name = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 0]\n"),
     {"scene.toml:18: rigid_body.2.inertia_kg_m2", "got 0", "> 0"}},
    {body("name = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 1]\nrotation_rad = [0, nan, 0]\n"),
     {"scene.toml:19: rigid_body.2.rotation_rad", "got nan"}},
    {body("name = \"a\"\nshape = \"mesh\"\nfile = \"open.obj\"\nmass_kg = 1\n"),
     {"scene.toml:15: rigid_body.2: open.obj: surface: got edge", "a closed surface"}},
    {body("name = \"a\"\nshape = \"mesh\"\nfile = \"inside_out.obj\"\nmass_kg = 1\n"),
     {"scene.toml:15: rigid_body.2: inside_out.obj: surface: got volume -", "seen from outside"}},
    {body("name = \"a\"\nshape = \"mesh\"\nfile = \"none.obj\"\nmass_kg = 1\n"),
     {"scene.toml:18: rigid_body.2.file", "none.obj, no such file"}},
    {body("name = \"a\"\nshape = \"mesh\"\nfile = \"mesh.stl\"\nmass_kg = 1\n"),
     {"extension `.stl`", ".obj or .off"}},
    {body("name = \"a\"\nshape = \"hull\"\nfile = \"flat.obj\"\nmass_kg = 1\n"),
     {"scene.toml:15: rigid_body.2: flat.obj: convex hull: got 5 points within 2 x 3 x 0 m",
      "do not lie in one plane"}},
    {body("name = \"a\"\nshape = \"hull\"\nfile = \"broken.obj\"\nmass_kg = 1\n"),
     {"broken.obj: convex hull: got 5 points within 1 x 1 x 1e+30 m"}},
    {body("name = \"a\"\nshape = \"mesh\"\nfile = \"crossed.obj\"\nmass_kg = 1\n"),
     {"crossed.obj: surface: got parts that enclose a negative volume", "does not cross itself"}},
    {body("name = \"a\"\nshape = \"hull\"\nfile = \"few.obj\"\nmass_kg = 1\n"),
     {"few.obj: convex hull: got 3 points", "four points"}},
    {"[[joint]]\nbodies = [\"arm\", \"hand\"]\nkind = 1\n",
     {"scene.toml:17: joint.0.kind", "got 1", "one of ball, hinge"}},
    {body("name = \"a\"\nshape = 1\n"), {"scene.toml:17: rigid_body.2.shape", "got 1", "one of sphere, box"}},
    {"[method]\nouter = 1\n", {"scene.toml:16: method.outer", "got 1", "one of auto, plain"}},
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

TEST_CASE("mistakes with rigid bodies and joints are refused with line, key, value and what is allowed") {
  const TemporaryFolder folder;
  const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  folder.write("open.obj", tetrahedron);
  folder.write("inside_out.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 4 2\nf 2 4 3\nf 3 4 1\nf 1 2 3\n");
  folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 2 3 0\n");
  folder.write("broken.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1e30\n");
  // The tetrahedron, and a smaller one inside out far away.
  folder.write("crossed.obj", tetrahedron +
                                  "f 1 3 2\nv 9 0 0\nv 9.5 0 0\nv 9 0.5 0\nv 9 0 0.5\n"
                                  "f 5 8 6\nf 6 8 7\nf 7 8 5\nf 5 6 7\n");
  folder.write("few.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  folder.write("mesh.stl", "solid\n");
  const auto out = folder.path / "out";
  for (const auto& mistake : mistakes) {
    INFO(mistake.text);
    const auto scene = folder.write("scene.toml", two_bodies + mistake.text);
    const auto ran = run_program({"simulate", scene, "-o", out});
    check_refused(ran, mistake.message);
    CHECK(std::count(ran.err.begin(), ran.err.end(), '\n') == 1);
    CHECK_FALSE(std::filesystem::exists(out));
  }
}

TEST_CASE("bodies that are missed are asked for") {
  const TemporaryFolder folder;
  const std::string step = "[step]\nstep_s = 1\nsteps = 1\n";
  for (const auto& [text, message] : std::vector<Mistake>{
           {"[gyroscopic]\n[[particle]]\nposition_m = [0, 0, 0]\nmass_kg = 1\n",
            {"scene.toml:4: gyroscopic", "a gyroscopic torque without a rigid body", "[[rigid_body]]"}},
           {"", {"a scene without nodes", "rigid_body"}},
           {"[[rigid_body]]\nname = \"a\"\nheld = \"fixed\"\n", {"every node has infinite mass"}},
           {"[[particle]]\nposition_m = [0, 0, 0]\nmass_kg = 1\n[[probe]]\nkind = \"position\"\nbody = "
            "\"a\"\n",
            {"scene.toml:9: probe.0.body", "`a`", "of which the scene has none"}}}) {
    INFO(text);
    check_refused(
        run_program({"simulate", folder.write("scene.toml", step + text), "-o", folder.path / "out"}),
        message);
  }
}
