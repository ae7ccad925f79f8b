// What rows keep of J in its place makes J v and W J^T p as the formulas do.
#include "rows/kept_jacobians.h"

#include <catch2/catch.hpp>

using namespace pbd;

namespace {

constexpr double rounding = 1e-14;

/// W J^T p of one constraint on its K nodes, W = 1 to 1/K, is adjoint to J v: p^T J v = sum of v W^-1 (W J^T
/// p).
template <std::size_t K, class Jacobians>
void check_adjoint(const Jacobians& jacobians, const std::array<int, K>& node, const Points& v,
                   const typename Jacobians::Value& p) {
  std::vector<double> inverse_mass;
  for (std::size_t a = 0; a < K; ++a) inverse_mass.push_back(1 / (1.0 + static_cast<double>(a)));
  Points pushed = Points::Zero(3, v.cols());
  jacobians.apply(0, node, inverse_mass, p, pushed);
  double product = 0;
  for (Eigen::Index a = 0; a < v.cols(); ++a)
    product += v.col(a).dot(pushed.col(a)) / inverse_mass[static_cast<std::size_t>(a)];
  CHECK(product == Approx(p.dot(jacobians.rate(0, node, v))).epsilon(0).margin(10 * rounding));
}

}  // namespace

TEST_CASE("a link's gradient by one end stands for both") {
  LinkJacobians jacobians;
  jacobians.resize(1);
  const Vec3 gradient = Vec3::Random();
  jacobians.set(0, gradient);
  CHECK(jacobians[0].leftCols<3>() == -gradient.transpose());
  CHECK(jacobians[0].rightCols<3>() == gradient.transpose());
  const std::array node{1, 0};
  const Points v = Points::Random(3, 2);
  CHECK(jacobians.rate(0, node, v)[0] == Approx(gradient.dot(v.col(0) - v.col(1))).epsilon(rounding));
  check_adjoint(jacobians, node, v, LinkJacobians::Value(1.3));
}

TEST_CASE("a tetrahedron's rows are made of its rest and its directions") {
  const bool turns = GENERATE(false, true);
  const Eigen::Matrix3d inverse = Eigen::Matrix3d::Random(), directions = Eigen::Matrix3d::Random();
  StrainJacobians::Turning turning = StrainJacobians::Turning::Zero();
  StrainJacobians jacobians;
  jacobians.resize(1);
  jacobians.set(0, inverse, directions);
  if (turns) {
    turning.setRandom();
    jacobians.begin_turning();
    jacobians.set_turning(0, turning);
  }
  const std::array node{2, 0, 3, 1};
  const Points v = Points::Random(3, 4);
  Eigen::Matrix3d edges;
  edges << v.col(0) - v.col(2), v.col(3) - v.col(2), v.col(1) - v.col(2);
  const Eigen::Matrix3d m = directions.transpose() * edges * inverse;
  StrainJacobians::Value expected;
  expected << m(0, 0), m(1, 1), m(2, 2), m(0, 1) + m(1, 0), m(1, 2) + m(2, 1), m(2, 0) + m(0, 2);
  expected -= turning * Vec3(m(1, 0) - m(0, 1), m(2, 1) - m(1, 2), m(0, 2) - m(2, 0));
  CHECK((jacobians.rate(0, node, v) - expected).norm() <= rounding * (1 + expected.norm()));
  Eigen::Matrix<double, 12, 1> local;
  local << v.col(2), v.col(0), v.col(3), v.col(1);
  CHECK((jacobians[0] * local - expected).norm() <= rounding * (1 + expected.norm()));
  StrainJacobians::Value p;
  p << 1, -2, 0.5, 0.3, -0.7, 0.9;
  check_adjoint(jacobians, node, v, p);
}
