// Where the impulses of contacts act.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "dense.h"
#include "harness/rows_of_step.h"
#include "scenes/contacts.h"

using namespace pbd;
using namespace pbdcheck;

namespace {

constexpr double h = 0.01;

/// Rows of contacts as forces and torques (about each body's centre, in the world), 6 columns a body.
Eigen::MatrixXd wrenches(const Scene& scene) {
  StepRows step(scene, scene.initial, h, Friction::coulomb);
  step.linearise(Points::Zero(3, step.v_free().cols()));
  const auto bodies = std::ssize(scene.bodies);
  Eigen::MatrixXd all(row_count(step.rows()), 6 * bodies);
  all.setZero();
  Eigen::Index row = 0;
  for_each_block(step.rows().blocks, [&]<class Block>(const Block& block) {
    for (std::size_t i = 0; i < block.size(); ++i, row += Block::rows)
      for (int a = 0; a < Block::nodes; ++a) {
        const int column = block.node[i][static_cast<std::size_t>(a)];
        const Eigen::Matrix<double, Block::rows, 3> part = block.jacobian[i].template middleCols<3>(3 * a);
        if (column < scene.nodes()) {
          all.template block<Block::rows, 3>(row, 6 * column) = part;
          continue;
        }
        const int b = column - scene.nodes();
        const auto& [node, inertia] = scene.bodies[static_cast<std::size_t>(b)];
        const double mass = scene.mass[static_cast<std::size_t>(node)];
        if (!std::isfinite(mass)) continue;
        const Vec3 radius = (inertia / mass).cwiseSqrt();
        const Eigen::Matrix3d axes =
            scene.initial.orientation[static_cast<std::size_t>(b)].toRotationMatrix();
        all.template block<Block::rows, 3>(row, 6 * b + 3) = part * radius.asDiagonal() * axes.transpose();
      }
  });
  return all;
}

Eigen::Quaterniond turned(double angle, const Vec3& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()));
}

}  // namespace

TEST_CASE("impulses between bodies have no torque together, however far they are apart") {
  BodyScene build({.friction = 0.5}, 0);
  const Placing lower{Vec3(0, 0, 0), turned(0.2, Vec3(1, 2, 3)), Vec3(0, 0, 2)};
  build.box(Vec3(1, 1.2, 0.4), 3, lower);
  build.box(Vec3(0.5, 0.3, 0.2), 2, {Vec3(0.1, 0.05, 0.35), turned(0.25, Vec3(1, 1, 3))});
  build.ball(0.1, 1, {Vec3(0.45, 0.3, 0.42)});
  build.ball(0.1, 1, {Vec3(0.45, 0.3, 0.65), Eigen::Quaterniond::Identity(), Vec3(0, 0, -5)});
  build.cylinder(0.1, 0.3, 1, {Vec3(-0.4, -0.3, 0.4), turned(0.3, Vec3(2, 1, 0)), Vec3(0, 0, -5)});
  const Scene scene = build.finish();
  const Eigen::MatrixXd rows = wrenches(scene);
  REQUIRE(rows.rows() >= 3 * 5);
  for (Eigen::Index row = 0; row < rows.rows(); ++row) {
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    for (int b = 0; b < std::ssize(scene.bodies); ++b) {
      const Vec3 own = rows.row(row).segment<3>(6 * b);
      force += own;
      torque += scene.initial.x.col(b).cross(own) + Vec3(rows.row(row).segment<3>(6 * b + 3));
    }
    INFO(row);
    CHECK(rows.row(row).norm() > 1);
    CHECK(force.norm() <= 1e-14);
    CHECK(torque.norm() <= 1e-14);
  }
}

TEST_CASE("all points of a tilted face can stick at once") {
  BodyScene build({.friction = 0.5});
  build.ground();
  build.box(Vec3(0.4, 0.3, 0.2), 3, {Vec3(0, 0, 0.13), turned(0.1, Vec3(1, 2, 0)), Vec3(0, 0, -10)});
  const Eigen::MatrixXd rows = wrenches(build.finish()).rightCols<6>();
  REQUIRE(rows.rows() >= 3 * 4);
  std::vector<Eigen::Index> across;  // two of three
  for (Eigen::Index row = 0; row < rows.rows(); ++row)
    if (row % 3 != 0) across.push_back(row);
  const auto rank = [](const Eigen::MatrixXd& m) {
    return m.cols() - pbd::reference::null_space(m, 1e-12).cols();
  };
  CHECK(rank(rows) == 6);
  CHECK(rank(rows(across, Eigen::all)) == 3);  // two slides along the face, one turn about its normal
}

TEST_CASE("a ball is pushed at its own surface, however high it is") {
  constexpr double radius = 0.1;
  BodyScene build({.friction = 0.5});
  build.ground();
  build.ball(radius, 3, {.position = {0, 0, 0.13}, .velocity = {0, 0, -10}});
  const Eigen::MatrixXd rows = wrenches(build.finish()).rightCols<3>();
  REQUIRE(rows.rows() == 3);
  CHECK(rows.row(0).norm() <= 1e-15);
  for (const int across : {1, 2}) CHECK(std::abs(rows.row(across).norm() - radius) <= 1e-15);
}
