// Limits and motors of limited force in scene files, against what statics and the step's recurrence say.
#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>

#include "harness/joint_force.h"
#include "harness/probes.h"
#include "program.h"
#include "scenes/scene_file.h"

using namespace pbdcheck;
using namespace pbdcheck::test;
using pbd::Vec3;

namespace {

SceneFile read_limited(const std::string& text, const std::string& relaxation) {
  const TemporaryFolder folder;
  return read_scene_file(folder.write("scene.toml", text +
                                                        "[step]\nstep_s = 0.01\nsteps = 300\n[method]\n"
                                                        "relaxation = \"" +
                                                        relaxation + "\"\ntolerance = 1e-9\n"));
}

/// The first body's state at the end, and what the joint named last exerts there.
struct End {
  SceneFile file;
  pbd::State state;
  pbd::Workspace workspace;

  explicit End(const std::string& text, const std::string& relaxation = "direct")
      : file(read_limited(text, relaxation)), state(file.scene.initial), workspace(file.scene, file.method) {
    for (std::int64_t k = 0; k < file.steps; ++k)
      REQUIRE(pbd::step(workspace, file.step_s, state).status == pbd::Status::ok);
  }
  Wrench wrench(std::size_t joint) const {
    return joint_force(file.joints.at(joint), file.scene, state, workspace);
  }
  /// About z, from the start.
  double angle() const {
    const Eigen::Quaterniond turn = state.orientation[0] * file.scene.initial.orientation[0].conjugate();
    return 2 * std::atan2(turn.z(), turn.w());
  }
  double largest_error() const {
    double largest = 0;
    for (const auto& effect : file.scene.effects)
      largest = std::max(largest, constraint_error(file.scene, effect, state));
    return largest;
  }
};

const std::string door =
    "[gravity]\n[gyroscopic]\n[[rigid_body]]\nname = \"door\"\nshape = \"box\"\nsize_m = [1, 0.05, 2]\n"
    "mass_kg = 3\nposition_m = [0.5, 0, 0]\n"
    "[[joint]]\nkind = \"hinge\"\nbodies = [\"world\", \"door\"]\npoint_m = [0, 0, 0]\naxis = [0, 0, 1]\n";

std::string angle(const std::string& rest) {
  return "[[joint]]\nkind = \"angle\"\nbodies = [\"world\", \"door\"]\naxis = [0, 0, 1]\n" + rest;
}

std::string torque(double z) {
  return "[[torque]]\nbody = \"door\"\ntorque_n_m = [0, 0, " + std::to_string(z) + "]\n";
}

const std::string ball =
    "[gravity]\n[[rigid_body]]\nname = \"ball\"\nshape = \"sphere\"\nradius_m = 0.1\nmass_kg = 2\n";

}  // namespace

TEST_CASE("a door that is pushed stops at its limit, which takes the push") {
  for (const double push : {4.0, -4.0}) {
    const End end(door + torque(push) + angle("min_angle_rad = -0.7\nmax_angle_rad = 0.5\n"));
    CHECK(end.angle() == Approx(push > 0 ? 0.5 : -0.7).epsilon(1e-9));
    CHECK((end.wrench(1).torque - Vec3(0, 0, -push)).norm() < 1e-7);
    CHECK(end.wrench(1).force.norm() < 1e-7);
    CHECK(end.largest_error() < 1e-9);
  }
}

TEST_CASE("a soft limit gives way by its compliance, and holds that energy") {
  const End end(door + torque(4) +
                angle("max_angle_rad = 0.5\ncompliance_rad_per_n_m = 0.02\ndamping_s = 0.1\n"));
  CHECK(end.angle() == Approx(0.58).epsilon(1e-4));
  CHECK(elastic_energy(end.file.scene, end.state) == Approx(0.02 * 4 * 4 / 2).epsilon(1e-3));
  CHECK(elastic_energy(end.file.scene, end.file.scene.initial) == 0);
}

// Between its limits a door turns freely: theta = w t.
TEST_CASE("a limit does nothing where it is not reached") {
  const auto free = door + angle("min_angle_rad = -1\nmax_angle_rad = 1\n");
  const std::string moving = "velocity_m_s = [0, 0.1, 0]\nangular_velocity_rad_s = [0, 0, 0.2]\n";
  auto text = free;
  text.insert(text.find("[[joint]]"), moving);
  const End end(text);
  CHECK(end.angle() == Approx(0.2 * 3).epsilon(1e-3));
  CHECK(end.wrench(1).torque.norm() == 0);
}

// A motor of 1.5 N m at 0.3 rad/s turns the door until it leans on the limit: both then exert 1.5 N m.
TEST_CASE("a motor stalls at its torque") {
  const End end(door + angle("rate_rad_s = 0.3\nmax_torque_n_m = 1.5\n") + angle("max_angle_rad = 0.4\n"));
  CHECK(end.angle() == Approx(0.4).epsilon(1e-9));
  CHECK((end.wrench(1).torque - Vec3(0, 0, 1.5)).norm() < 1e-7);
  CHECK((end.wrench(2).torque + Vec3(0, 0, 1.5)).norm() < 1e-7);
  CHECK(end.largest_error() < 1e-9);  // what it falls behind is none
  const End strong(door + angle("rate_rad_s = 0.3\nmax_torque_n_m = 1500\n"));
  CHECK(strong.angle() == Approx(0.9).epsilon(1e-8));
}

// Where motor and limit balance and nothing moves, rounding of their impulses is all that is left to solve.
TEST_CASE("a motor leans on a limit without gravity, by every relaxation") {
  const std::string scene = door.substr(door.find("[gyroscopic]")) +
                            angle("rate_rad_s = 0.3\nmax_torque_n_m = 1.5\n") +
                            angle("max_angle_rad = 0.4\n");
  for (const std::string relaxation :
       {"gauss_seidel", "jacobi", "nesterov_jacobi", "conjugate_gradients", "direct"}) {
    INFO(relaxation);
    const End end(scene, relaxation);
    CHECK(end.angle() == Approx(0.4).epsilon(1e-9));
    CHECK((end.wrench(2).torque + Vec3(0, 0, 1.5)).norm() < 1e-7);
  }
}

TEST_CASE("ropes, slides and motors of limited force hold and yield by their weight") {
  const Vec3 weight(0, 0, 2 * 9.81);
  const auto world = [](const std::string& rest) {
    return ball + "[[joint]]\nbodies = [\"world\", \"ball\"]\npoints_m = [[0, 0, 1], [0, 0, 0]]\n" + rest;
  };
  const std::string slide = "kind = \"slide\"\naxis = [0, 0, 1]\n";
  struct Held {
    std::string joint;
    double height;
    Vec3 force;
  };
  const double t = 3, h = 0.01, fall = 9.81 * t * (t + h) / 2;  // of implicit Euler
  for (const auto& [joint, height, force] :
       {Held{"kind = \"distance\"\nmax_length_m = 1.5\n", -0.5, weight},
        {"kind = \"distance\"\nmin_length_m = 0.5\n", -fall, Vec3::Zero()},
        {slide + "min_position_m = -1.25\n", -0.25, weight},
        {slide + "max_force_n = 20\n", 0, weight},
        {slide + "max_force_n = 10\n", -fall * (1 - 10 / weight.z()), Vec3(0, 0, 10)}}) {
    INFO(joint);
    const End end(world(joint));
    CHECK(end.state.x(2, 0) == Approx(height).margin(1e-9));
    CHECK((end.wrench(0).force - force).norm() < 1e-7);
  }
}

// Rounding leaves an impulse of 1e-32 N s on the limit; taken for a stop, it had each integrator begin anew.
TEST_CASE("a limit out of reach changes nothing of a free fall, by any integrator") {
  const std::string bodies = R"(
[[rigid_body]]
name = "b0"
shape = "sphere"
radius_m = 6.654
density_kg_m3 = 0.1476
position_m = [4.343, 8.963, 16.82]
[[rigid_body]]
name = "b1"
shape = "capsule"
radius_m = 2.941
length_m = 14.27
density_kg_m3 = 0.02657
position_m = [-0.008295, 5.034, 40.36]
[[rigid_body]]
name = "b2"
shape = "capsule"
radius_m = 2.834
length_m = 11.48
density_kg_m3 = 0.2692
position_m = [10.27, 2.571, 63.91]
[[rigid_body]]
name = "b3"
shape = "sphere"
radius_m = 3.451
density_kg_m3 = 0.6759
position_m = [2.542, 11.49, 87.45]
[[joint]]
kind = "slider"
point_m = [2.167, 6.999, 28.59]
axis = [-0.3832, -0.859, 0.948]
bodies = ["b0", "b1"]
[gravity]
acceleration_m_s2 = [0, 0, -0.007894]
[contact]
)";
  const std::string limit = R"([[joint]]
kind = "slide"
points_m = [[2.167, 6.999, 28.59], [2.167, 6.999, 28.59]]
axis = [-0.3832, -0.859, 0.948]
max_position_m = 1000
bodies = ["b0", "b1"]
)";
  for (const std::string integrator : {"implicit_euler", "newmark", "bdf2", "generalised_alpha"}) {
    const auto end = [&](const std::string& text) {
      SceneFile file = read_limited(text, "direct");
      file.method.integrator = integrator;
      pbd::Workspace workspace(file.scene, file.method);
      pbd::State state = file.scene.initial;
      for (int k = 0; k < 14; ++k) REQUIRE(pbd::step(workspace, 4.089, state).status == pbd::Status::ok);
      return state.x;
    };
    INFO(integrator);
    CHECK((end(bodies + limit) - end(bodies)).norm() <= 1e-9);
  }
}
