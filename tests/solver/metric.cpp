#include "outer/metric_inverse.h"

#include <array>
#include <catch2/catch.hpp>
#include <random>
#include <vector>

#include "dense.h"

using namespace pbd;

namespace {

struct Graph {
  int nodes = 0;
  std::vector<std::array<int, 2>> links;
};

Graph ring() {
  Graph graph{12, {}};
  for (int a = 0; a < graph.nodes; ++a)
    for (const int step : {1, 5}) graph.links.push_back({a, (a + step) % graph.nodes});
  return graph;
}

/// Neighbours in a cube of nodes, diagonal ones, too: its factor has panels of one column and of many.
Graph lattice() {
  constexpr int side = 5;
  Graph graph{side * side * side, {}};
  for (int a = 0; a < graph.nodes; ++a)
    for (const Eigen::Vector3i& step :
         {Eigen::Vector3i(1, 0, 0), {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {0, 1, 1}}) {
      const Eigen::Vector3i at(a % side, a / side % side, a / side / side), to = at + step;
      if (to.maxCoeff() < side) graph.links.push_back({a, to.x() + side * (to.y() + side * to.z())});
    }
  return graph;
}

/// Nodes with random symmetric positive semidefinite couplings, and the same as a dense matrix; node 3 cannot
/// move.
struct Coupled {
  int nodes;
  std::vector<double> inverse_mass;
  std::vector<MetricEntry> entries;
  Eigen::MatrixXd dense;

  /// Couplings that begin at the first half of the nodes are `ratio` times as stiff.
  explicit Coupled(const Graph& graph, bool one_number, double ratio = 1)
      : nodes(graph.nodes),
        inverse_mass(static_cast<std::size_t>(nodes), 0.5),
        dense(2 * Eigen::MatrixXd::Identity(3 * nodes, 3 * nodes)) {
    inverse_mass[3] = 0;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    for (const auto& [a, b] : graph.links) {
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

Points forces(int nodes) {
  Points force(3, nodes);
  for (int k = 0; k < force.size(); ++k) force.reshaped()[k] = std::sin(1.0 + k);
  return force;
}

Points exact(const Coupled& coupled, Points force) {
  force.col(3).setZero();
  return reference::solve_semidefinite(coupled.dense, force.reshaped()).reshaped(3, coupled.nodes);
}

Metric factored(const Coupled& coupled, double most_products) {
  StepMap map;
  map.d = map.s = 0.01;
  Metric metric;
  metric.factor(map, coupled.inverse_mass, coupled.entries, {}, MetricShape::rest, most_products);
  return metric;
}

}  // namespace

TEST_CASE("the metric's factor solves by full blocks and by one number a pair of nodes") {
  const bool one_number = GENERATE(false, true);
  const Coupled coupled(GENERATE(false, true) ? lattice() : ring(), one_number);
  Metric metric = factored(coupled, one_number ? 0 : 1e9);
  Points found;
  metric.solve(forces(coupled.nodes), found);
  const Eigen::VectorXd eigenvalues = reference::symmetric_eigen(coupled.dense).values;
  const double condition = eigenvalues.maxCoeff() / eigenvalues.minCoeff();
  const double roundoff = one_number ? 1.2e-16 : 6e-8;  // of L's precision
  const Points wanted = exact(coupled, forces(coupled.nodes));
  CHECK((found - wanted).norm() <= 3 * coupled.nodes * roundoff * condition * wanted.norm());
  CHECK(found.col(3).isZero(0));
  for (int node = 0; node < coupled.nodes; ++node)
    CHECK(metric.inverse_diagonal()[node] ==
          Approx(node == 3 ? 0 : 3 / coupled.dense.block<3, 3>(3 * node, 3 * node).trace()));
}

TEST_CASE("a tangent that is not positive definite has no factor, and another one that of full blocks") {
  Coupled coupled(lattice(), false);
  StepMap map;
  map.d = map.s = 0.01;
  Metric metric;
  const auto factors = [&](double most_products) {
    return metric.factor(map, coupled.inverse_mass, coupled.entries, {}, MetricShape::tangent, most_products);
  };
  CHECK(factors(1e9));
  Points found;
  metric.solve(forces(coupled.nodes), found);
  const Points wanted = exact(coupled, forces(coupled.nodes));
  CHECK((found - wanted).norm() <= 1e-9 * wanted.norm());
  CHECK_FALSE(factors(0));
  coupled.entries.push_back({0, 0, -2 * coupled.dense.topLeftCorner<3, 3>()});
  CHECK_FALSE(factors(1e9));
}

TEST_CASE("the metric turns with the material") {
  const Coupled coupled(ring(), false);
  Metric metric = factored(coupled, 1e9);
  Points straight, turned;
  metric.solve(forces(coupled.nodes), straight);
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(2, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Matrix3d stretch = Vec3(0.5, 1, 1.5).asDiagonal();
  metric.turn(std::vector<Eigen::Matrix3d>(coupled.nodes, rotation * stretch));
  metric.solve(rotation * forces(coupled.nodes), turned);
  CHECK((turned - rotation * straight).norm() < 1e-13 * straight.norm());
}

TEST_CASE("blocks of the metric's inverse between some nodes are those of the whole") {
  const bool one_number = GENERATE(false, true);
  const double ratio = GENERATE(1.0, 1e6);  // the factor is of float, and of double
  const Coupled coupled(GENERATE(false, true) ? lattice() : ring(), one_number, ratio);
  Metric metric = factored(coupled, one_number ? 0 : 1e9);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  metric.turn(std::vector<Eigen::Matrix3d>(coupled.nodes, turn));
  MetricInverse inverse;
  inverse.begin(metric, 4);
  for (const int a : {7, 0, 11, 2})
    for (const int b : {2, 7, 5}) {
      Points unit, column;
      for (int axis = 0; axis < 3; ++axis) {
        unit.setZero(3, coupled.nodes);
        unit.col(b) = metric.rotation(b).col(axis);
        metric.solve(unit, column);
        const Vec3 wanted = metric.rotation(a).transpose() * column.col(a);
        const Vec3 found = inverse.block(inverse.place(metric, a), inverse.place(metric, b)).col(axis);
        CHECK((found - wanted).norm() <= 1e-12 * column.norm());
      }
    }
}

TEST_CASE("a factor of float knows its limits: pivots that differ too much stay double") {
  const Coupled coupled(lattice(), false, 1e9);
  Metric metric = factored(coupled, 1e9);
  Points found;
  metric.solve(forces(coupled.nodes), found);
  Points force = forces(coupled.nodes);
  force.col(3).setZero();
  const Eigen::VectorXd residual = coupled.dense * Eigen::VectorXd(found.reshaped()) - force.reshaped();
  // Backward stable: |P x - b| <= n eps |P| |x|.
  CHECK(residual.norm() <= 3 * coupled.nodes * 1.2e-16 * coupled.dense.norm() * found.norm());
}
