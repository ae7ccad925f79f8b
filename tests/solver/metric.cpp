#include "outer/metric_inverse.h"

#include <catch2/catch.hpp>
#include <random>

#include "dense.h"

using namespace pbd;

namespace {

/// A ring of nodes with random symmetric positive semidefinite couplings, and the same as a dense matrix;
/// node 3 cannot move.
struct Ring {
  static constexpr int nodes = 12;
  std::vector<double> inverse_mass = std::vector<double>(nodes, 0.5);
  std::vector<MetricEntry> entries;
  Eigen::MatrixXd dense = 2 * Eigen::MatrixXd::Identity(3 * nodes, 3 * nodes);

  /// Couplings that begin at the first half of the nodes are `ratio` times as stiff.
  explicit Ring(bool one_number, double ratio = 1) {
    inverse_mass[3] = 0;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int a = 0; a < nodes; ++a)
      for (const int b : {(a + 1) % nodes, (a + 5) % nodes}) {
        Eigen::Matrix<double, 3, 6> j;
        for (double& entry : j.reshaped()) entry = any(random);
        Eigen::Matrix<double, 6, 6> k = (a < nodes / 2 ? ratio : 1) * j.transpose() * j;
        if (one_number)
          for (int r = 0; r < 2; ++r)
            for (int c = 0; c < 2; ++c)
              k.block<3, 3>(3 * r, 3 * c) =
                  Eigen::Matrix3d(Vec3::Constant(k.block<3, 3>(3 * r, 3 * c).trace() / 3).asDiagonal());
        entries.push_back({a, a, k.topLeftCorner<3, 3>()});
        entries.push_back({b, a, k.bottomLeftCorner<3, 3>()});
        entries.push_back({b, b, k.bottomRightCorner<3, 3>()});
        dense.block<3, 3>(3 * a, 3 * a) += k.topLeftCorner<3, 3>();
        dense.block<3, 3>(3 * b, 3 * a) += k.bottomLeftCorner<3, 3>();
        dense.block<3, 3>(3 * a, 3 * b) += k.topRightCorner<3, 3>();
        dense.block<3, 3>(3 * b, 3 * b) += k.bottomRightCorner<3, 3>();
      }
    dense.middleRows<3>(9).setZero();
    dense.middleCols<3>(9).setZero();
    dense.block<3, 3>(9, 9).setIdentity();
  }
};

Points forces() {
  Points force(3, Ring::nodes);
  for (int k = 0; k < force.size(); ++k) force.reshaped()[k] = std::sin(1.0 + k);
  return force;
}

Points exact(const Ring& ring, Points force) {
  force.col(3).setZero();
  return reference::solve_semidefinite(ring.dense, force.reshaped()).reshaped(3, Ring::nodes);
}

Metric factored(const Ring& ring, double most_products) {
  StepMap map;
  map.d = map.s = 0.01;
  Metric metric;
  metric.factor(map, ring.inverse_mass, ring.entries, {}, MetricShape::rest, most_products);
  return metric;
}

}  // namespace

TEST_CASE("the metric's factor solves by full blocks and by one number a pair of nodes") {
  const bool one_number = GENERATE(false, true);
  const Ring ring(one_number);
  Metric metric = factored(ring, one_number ? 0 : 1e9);
  Points found;
  metric.solve(forces(), found);
  const Eigen::VectorXd eigenvalues = reference::symmetric_eigen(ring.dense).values;
  const double condition = eigenvalues.maxCoeff() / eigenvalues.minCoeff();
  const double roundoff = one_number ? 1.2e-16 : 6e-8;  // of L's precision
  const Points wanted = exact(ring, forces());
  CHECK((found - wanted).norm() <= 3 * Ring::nodes * roundoff * condition * wanted.norm());
  CHECK(found.col(3).isZero(0));
  for (int node = 0; node < Ring::nodes; ++node)
    CHECK(metric.inverse_diagonal()[node] ==
          Approx(node == 3 ? 0 : 3 / ring.dense.block<3, 3>(3 * node, 3 * node).trace()));
}

TEST_CASE("the metric turns with the material") {
  const Ring ring(false);
  Metric metric = factored(ring, 1e9);
  Points straight, turned;
  metric.solve(forces(), straight);
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(2, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Matrix3d stretch = Vec3(0.5, 1, 1.5).asDiagonal();
  metric.turn(std::vector<Eigen::Matrix3d>(Ring::nodes, rotation * stretch));
  metric.solve(rotation * forces(), turned);
  CHECK((turned - rotation * straight).norm() < 1e-13 * straight.norm());
}

TEST_CASE("blocks of the metric's inverse between some nodes are those of the whole") {
  const bool one_number = GENERATE(false, true);
  const double ratio = GENERATE(1.0, 1e6);  // the factor is of float, and of double
  const Ring ring(one_number, ratio);
  Metric metric = factored(ring, one_number ? 0 : 1e9);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  metric.turn(std::vector<Eigen::Matrix3d>(Ring::nodes, turn));
  MetricInverse inverse;
  inverse.begin(metric, 4);
  for (const int a : {7, 0, 11, 2})
    for (const int b : {2, 7, 5}) {
      Points unit, column;
      for (int axis = 0; axis < 3; ++axis) {
        unit.setZero(3, Ring::nodes);
        unit.col(b) = metric.rotation(b).col(axis);
        metric.solve(unit, column);
        const Vec3 wanted = metric.rotation(a).transpose() * column.col(a);
        const Vec3 found = inverse.block(inverse.place(metric, a), inverse.place(metric, b)).col(axis);
        CHECK((found - wanted).norm() <= 1e-12 * column.norm());
      }
    }
}

TEST_CASE("a factor of float knows its limits: pivots that differ too much stay double") {
  const Ring ring(false, 1e9);
  Metric metric = factored(ring, 1e9);
  Points found;
  metric.solve(forces(), found);
  Points force = forces();
  force.col(3).setZero();
  const Eigen::VectorXd residual = ring.dense * Eigen::VectorXd(found.reshaped()) - force.reshaped();
  // Backward stable: |P x - b| <= n eps |P| |x|.
  CHECK(residual.norm() <= 3 * Ring::nodes * 1.2e-16 * ring.dense.norm() * found.norm());
}
