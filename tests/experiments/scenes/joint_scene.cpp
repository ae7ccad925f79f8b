// Joints of scene files: what is read, and forces that statics tells.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "harness/joint_force.h"
#include "harness/probes.h"
#include "rigid_scene.h"

using namespace pbdcheck;
using namespace pbdcheck::test;
using pbd::Vec3;

namespace {

/// Two bodies anyhow in space, and a joint of them.
SceneFile joined_pair(const std::string& joint) {
  return read(
      box + placed + "[[rigid_body]]\nname = \"rod\"\nmass_kg = 1\ninertia_kg_m2 = [1, 2, 2.5]\n" +
      "position_m = [0, 1, 0]\nrotation_rad = [-1, 2, 0.5]\n[[joint]]\nbodies = [\"box\", \"rod\"]\n" +
      joint);
}

}  // namespace

// Where the axes of both bodies part, the direction from which the turn is seen tells it, too.
TEST_CASE("an angle is what it is in a scene that is turned as a whole") {
  const auto angle_in = [](const Eigen::Quaterniond& turn) {
    const auto vector = [](const Vec3& v) { return fmt::format("[{}, {}, {}]", v[0], v[1], v[2]); };
    const auto body = [&](const char* name, const Vec3& rotation) {
      const Eigen::Quaterniond own(Eigen::AngleAxisd(rotation.norm(), rotation.normalized()));
      const Eigen::AngleAxisd turned(turn * own);
      return fmt::format(
          "[[rigid_body]]\nname = \"{}\"\nmass_kg = 1\ninertia_kg_m2 = [1, 2, 2.5]\nrotation_rad = {}\n",
          name, vector(turned.angle() * turned.axis()));
    };
    const SceneFile file = read(body("first", {0.3, 0.2, -0.4}) + body("second", {-1, 2, 0.5}) +
                                "[[joint]]\nkind = \"angle\"\nbodies = [\"first\", \"second\"]\naxis = " +
                                vector(turn * Vec3(0.1, 1, 0.3)) + "\n");
    return std::get<pbd::AngleJoint>(file.scene.effects.back());
  };
  const auto base = angle_in(Eigen::Quaterniond::Identity());
  const auto turned = angle_in(Eigen::Quaterniond(Eigen::AngleAxisd(2, Vec3(1, 2, -2) / 3)));
  CHECK((turned.axis[0] - base.axis[0]).norm() < 1e-14);
  for (const std::size_t k : {0, 1}) CHECK((turned.reference[0][k] - base.reference[0][k]).norm() < 1e-14);
}

TEST_CASE("every joint is met where it starts, by as many equations as its kind has") {
  const std::string at = "point_m = [0.1, 0.5, 2]\n", pair = "points_m = [[1, 2, 2.5], [0.5, 1, 0]]\n";
  const std::string axis = "axis = [1, 2, -2]\n", soft = "compliance_m_per_n = 0.5\n";
  const std::string soft_angles = "stiffness_n_m_per_rad = 8\ndamping_s = 0.125\n";
  struct Kind {
    std::string name, keys;
    std::int64_t lengths, angles;
  };
  const std::vector<Kind> kinds{{"ball", at, 3, 0},
                                {"hinge", at + axis, 3, 2},
                                {"weld", at, 3, 3},
                                {"slider", at + axis, 2, 3},
                                {"universal", "second_axis = [2, 1, 2]\n" + at + axis, 3, 1},
                                {"distance", pair, 1, 0},
                                {"angle", axis, 0, 1},
                                {"slide", pair + axis, 1, 0}};
  for (const Kind& kind : kinds) {
    const std::string text = fmt::format("kind = \"{}\"\n{}", kind.name, kind.keys);
    INFO(text);
    const auto hard = joined_pair(text);
    std::int64_t rows = 0;
    for (const auto& cost : pbd::Workspace(hard.scene, {}).costs()) rows += cost.rows;
    CHECK(rows == kind.lengths + kind.angles);
    for (const auto& effect : hard.scene.effects)
      CHECK(constraint_error(hard.scene, effect, hard.scene.initial) < 1e-14);
    const auto compliant =
        joined_pair(text + (kind.lengths > 0 ? soft : "") + (kind.angles > 0 ? soft_angles : ""));
    for (const auto& effect : compliant.scene.effects)
      std::visit(
          [&]<class E>(const E& typed) {
            if constexpr (requires { typed.compliance; }) {
              const bool of_angles =
                  std::is_same_v<E, pbd::AxisJoint> || std::is_same_v<E, pbd::AngleJoint> ||
                  std::is_same_v<E, pbd::RotationJoint> || std::is_same_v<E, pbd::PerpendicularJoint>;
              CHECK(typed.compliance == std::vector<double>{of_angles ? 0.125 : 0.5});
              CHECK(typed.damping == (kind.angles > 0 ? std::vector<double>{0.125} : std::vector<double>{}));
            }
          },
          effect);
  }
}

TEST_CASE("rest lengths, angles and rates of joints are read, and each effect collects its joints") {
  const auto file = joined_pair(R"(kind = "distance"
points_m = [[0, 0, 0], [0, 3, 4]]
[[joint]]
kind = "distance"
name = "rope"
bodies = ["rod", "box"]
points_m = [[0, 0, 0], [0, 3, 4]]
rest_length_m = 2
[[joint]]
kind = "angle"
bodies = ["box", "rod"]
axis = [0, 0, 2]
rest_angle_rad = 0.5
rate_rad_s = -3
[[joint]]
kind = "slide"
bodies = ["box", "rod"]
points_m = [[0, 0, 0], [0, 3, 4]]
axis = [0, 0, 2]
rate_m_s = 6
)");
  CHECK(only<pbd::BodyDistance>(file.scene).rest_length[0] == Approx(5));
  CHECK(only<pbd::BodyDistance>(file.scene).rest_length[1] == 2);
  CHECK(only<pbd::BodyDistance>(file.scene).body[1] == std::array{1, 0});
  CHECK(only<pbd::AngleJoint>(file.scene).rest_angle[0] == 0.5);
  CHECK(only<pbd::AngleJoint>(file.scene).rate[0] == -3);
  CHECK(only<pbd::SlideJoint>(file.scene).rest_position[0] == Approx(4));
  CHECK(only<pbd::SlideJoint>(file.scene).rate[0] == 6);
  CHECK(file.joints[1].name == "rope");
}

// A beam of weight m g held at one end, r = l/2 x from its centre of mass: the joint gives the force m g z,
// and the torque -r x (-m g z) = -l/2 m g y about its place.
TEST_CASE("joints exert the forces and torques that hold a beam") {
  const double weight = 0.8 * 9.81;
  const std::string beam =
      "[gravity]\n[gyroscopic]\n[[rigid_body]]\nname = \"beam\"\nshape = \"box\"\nsize_m = [1, 0.2, 0.2]\n"
      "mass_kg = 0.8\nposition_m = [0.5, 0, 0]\nrotation_rad = [0.5, 0, 0]\n[method]\ntolerance = "
      "1e-12\nrelaxation "
      "= \"direct\"\n";
  const auto joint = [](const std::string& rest, bool turned_round = false) {
    return "[[joint]]\nbodies = " +
           std::string(turned_round ? R"(["beam", "world"])" : R"(["world", "beam"])") +
           "\npoint_m = [0, 0, 0]\n" + rest;
  };
  const auto motor = std::string("[[joint]]\nbodies = [\"world\", \"beam\"]\n");
  struct Held {
    std::string joints;
    std::vector<Wrench> expected;
  };
  const Vec3 up(0, 0, weight), bend(0, -weight / 2, 0), none = Vec3::Zero();
  for (const auto& [joints, expected] : std::vector<Held>{
           {joint("kind = \"weld\"\n"), {{up, bend}}},
           {joint("kind = \"weld\"\n", true), {{-up, -bend}}},
           {joint("kind = \"slider\"\naxis = [1, 0, 0]\n"), {{up, bend}}},
           {joint("kind = \"hinge\"\naxis = [1, 0, 0]\n"), {{up, bend}}},
           {joint("kind = \"universal\"\naxis = [1, 0, 0]\nsecond_axis = [0, 0, 1]\n"), {{up, bend}}},
           {joint("kind = \"hinge\"\naxis = [0, 1, 0]\n") + motor + "kind = \"angle\"\naxis = [0, -1, 0]\n",
            {{up, none}, {none, bend}}},
           {joint("kind = \"slider\"\naxis = [0, 0, 1]\n") + motor +
                "kind = \"slide\"\npoints_m = [[0, 0, 0], [0, 0, 0]]\naxis = [0, 0, 1]\n",
            {{none, bend}, {up, none}}},
           {joint("kind = \"ball\"\n") + motor + "kind = \"distance\"\npoints_m = [[1, 0, 2], [1, 0, 0]]\n",
            {{up / 2, none}, {up / 2, none}}}}) {
    INFO(joints);
    const auto file = read(beam + joints);
    pbd::Workspace workspace(file.scene, file.method);
    auto state = file.scene.initial;
    for (int k = 0; k < 3; ++k) REQUIRE(pbd::step(workspace, file.step_s, state).status == pbd::Status::ok);
    REQUIRE(file.joints.size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const Wrench found = joint_force(file.joints[i], file.scene, state, workspace);
      CHECK((found.force - expected[i].force).norm() < 1e-9 * weight);
      CHECK((found.torque - expected[i].torque).norm() < 1e-9 * weight);
    }
  }
}

TEST_CASE("probes of bodies are named after them, and a joint's force is empty at the start") {
  const auto file = joined_pair(R"(kind = "ball"
name = "elbow"
point_m = [0, 0, 0]
[[probe]]
kind = "velocity"
body = "box"
point_m = [1, 2, 4]
[[probe]]
kind = "orientation"
body = "rod"
[[probe]]
kind = "angular_velocity"
body = "box"
[[probe]]
kind = "joint_force"
joint = "elbow"
)");
  const auto columns = probe_columns(file);
  CHECK(columns == std::vector<std::string>{
                       "box_vx_m_s", "box_vy_m_s", "box_vz_m_s", "rod_qw", "rod_qx", "rod_qy", "rod_qz",
                       "box_wx_rad_s", "box_wy_rad_s", "box_wz_rad_s", "elbow_force_x_n", "elbow_force_y_n",
                       "elbow_force_z_n", "elbow_torque_x_n_m", "elbow_torque_y_n_m", "elbow_torque_z_n_m"});
  std::vector<Cell> row;
  append_probes(file, file.scene.initial, nullptr, row);
  REQUIRE(row.size() == columns.size());
  const auto number = [&](std::size_t i) { return std::get<double>(row[i]); };
  const Vec3 velocity = Vec3(1, 0, 2) + Vec3(3, -2, 1).cross(Vec3(0, 0, 1));
  CHECK((Vec3(number(0), number(1), number(2)) - velocity).norm() < 1e-14);
  const Eigen::Quaterniond rod(number(3), number(4), number(5), number(6));
  CHECK((rod.toRotationMatrix() - turned({-1, 2, 0.5})).norm() < 1e-14);
  CHECK((Vec3(number(7), number(8), number(9)) - Vec3(3, -2, 1)).norm() < 1e-14);
  CHECK(std::get<std::string>(row[10]).empty());
}
