// Rigid bodies of scene files: what is read.
#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "harness/joint_force.h"
#include "harness/probes.h"
#include "harness/vtk.h"
#include "rigid_scene.h"

using namespace pbdcheck;
using namespace pbdcheck::test;
using pbd::Vec3;

// The wedge is a right triangle of 2 x 1 m (x, z) along 1 m of y: centre (2/3, 1/2, 1/3), moments per mass
// b^2/18 + h^2/18, 1/12 and the product -b h/36.
TEST_CASE("a mesh and its hull have the mass, place and inertia of the prism that they are") {
  for (const auto* shape : {"mesh", "hull"}) {
    INFO(shape);
    const auto file = read("[[rigid_body]]\nname = \"wedge\"\nshape = \"" + std::string(shape) +
                           "\"\nfile = \"meshes/wedge.obj\"\nscale = 0.5\ndensity_kg_m3 = 80\n" + placed);
    const auto& scene = file.scene;
    const double mass = 80 * 0.125;
    CHECK(scene.mass[0] == Approx(mass));
    const Eigen::Matrix3d rotation = turned({0.3, -0.4, 0.5});
    const Vec3 centre = Vec3(2.0 / 3, 0.5, 1.0 / 3) / 2;
    CHECK((scene.initial.x.col(0) - (Vec3(1, 2, 3) + rotation * centre)).norm() < 1e-14);
    CHECK(scene.initial.v.col(0) == Vec3(1, 0, 2));
    Eigen::Matrix3d inertia;
    inertia << 1.0 / 18 + 1.0 / 12, 0, 1.0 / 18, 0, 5.0 / 18, 0, 1.0 / 18, 0, 4.0 / 18 + 1.0 / 12;
    inertia *= mass / 4;
    const Eigen::Matrix3d axes = scene.initial.orientation[0].toRotationMatrix();
    CHECK((axes * scene.bodies[0].inertia.asDiagonal() * axes.transpose() -
           rotation * inertia * rotation.transpose())
              .norm() < 1e-14);
    CHECK((axes * scene.initial.spin.col(0) - Vec3(3, -2, 1)).norm() < 1e-14);

    const BodySurfaces surfaces(scene, file.bodies);
    pbd::Points x, v;
    surfaces.place(scene.initial, x, v);
    const Vec3 corner = Vec3(1, 2, 3) + rotation * Vec3(1, 0.5, 0);  // (2, 1, 0) of the file
    Eigen::Index nearest = 0;
    CHECK((x.colwise() - corner).colwise().norm().minCoeff(&nearest) < 1e-14);
    const Vec3 lever = corner - scene.initial.x.col(0);
    CHECK((v.col(nearest) - Vec3(1, 0, 2) - Vec3(3, -2, 1).cross(lever)).norm() < 1e-13);
    CHECK(surfaces.cells().count == 8);
  }
}

TEST_CASE("copies of a body stand on a grid, each shifted and turned a little, the same in every reading") {
  const std::string copies = R"(
[[rigid_body]]
name = "brick"
shape = "box"
size_m = [0.2, 0.1, 0.1]
mass_kg = 1
position_m = [3, 0, 1]
copies = [2, 1, 3]
spacing_m = [0.3, 0, 0.2]
)";
  const auto exact = read(copies), scattered = read(copies + "scatter_m = 0.01\nscatter_rad = 0.1\n"),
             again = read(copies + "scatter_m = 0.01\nscatter_rad = 0.1\n");
  REQUIRE(exact.bodies.size() == 6);
  CHECK(exact.bodies[0].name == "brick_0");
  CHECK(exact.bodies[5].name == "brick_5");
  CHECK((exact.scene.initial.x.col(1) - Vec3(3.3, 0, 1)).norm() <= 1e-15);
  CHECK((exact.scene.initial.x.col(4) - Vec3(3, 0, 1.4)).norm() <= 1e-15);
  const pbd::Points off = scattered.scene.initial.x - exact.scene.initial.x;
  CHECK(off.cwiseAbs().maxCoeff() <= 0.01);
  CHECK(off.cwiseAbs().minCoeff() > 0);
  CHECK(scattered.scene.initial.x == again.scene.initial.x);
  for (std::size_t i = 0; i < 6; ++i) {
    const double angle =
        exact.scene.initial.orientation[i].angularDistance(scattered.scene.initial.orientation[i]);
    CHECK((angle > 0 && angle <= 0.1 * std::sqrt(3.0)));
  }
}

TEST_CASE("bodies stand behind all nodes, in the file's order, held or free, and the world behind them") {
  const auto file = read(box + R"(
[[rigid_body]]
name = "wall"
held = "fixed"
position_m = [5, 0, 0]
[[rigid_body]]
name = "wheel"
held = "moving"
shape = "sphere"
radius_m = 1
velocity_m_s = [0, 7, 0]
angular_velocity_rad_s = [0, 0, 4]
rotation_rad = [1, 0, 0]
[[particle]]
position_m = [0, 0, 9]
mass_kg = 3
[[joint]]
kind = "ball"
bodies = ["world", "box"]
point_m = [0, 0, 0]
[[force]]
near_m = [0, 0, 0]
force_n = [1, 0, 0]
[[force]]
body = "box"
force_n = [2, 0, 0]
[[torque]]
body = "wheel"
torque_n_m = [0, 1, 0]
[[attachment]]
body = "wall"
near_m = [5, 0, 0]
stiffness_n_per_m = 4
damping_s = 0.5
)");
  const auto& scene = file.scene;
  CHECK(scene.mass[0] == 3);
  CHECK(scene.mass[1] == Approx(500 * 0.024));
  for (const std::size_t body : {1, 2, 3}) {
    CHECK(scene.mass[body + 1] == pbd::infinity);
    CHECK(scene.bodies[body].inertia == Vec3::Constant(pbd::infinity));
  }
  CHECK(file.bodies[3].name == "world");
  CHECK(scene.initial.x.col(4) == Vec3::Zero());
  CHECK(scene.initial.v.col(3) == Vec3(0, 7, 0));
  CHECK((scene.initial.orientation[2] * Vec3(scene.initial.spin.col(2)) - Vec3(0, 0, 4)).norm() < 1e-15);
  CHECK(only<pbd::ExternalForce>(scene).node == std::vector<int>{0, 1});
  CHECK(only<pbd::ExternalTorque>(scene).body == std::vector<int>{2});
  const auto& held = only<pbd::Attachment>(scene);
  CHECK(held.body == std::vector<int>{1});
  CHECK(held.point[0] == Vec3(-5, 0, 9));
  CHECK(held.compliance[0] == 0.25);
  CHECK(held.damping[0] == 0.5);
}
