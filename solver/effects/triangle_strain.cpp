#include "effects/triangle_strain.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "effects/stress_bound.h"
#include "mesh.h"
#include "rows/effect_rows.h"

namespace pbd {
namespace {

/// Y C^-1 at Poisson's ratio nu
Eigen::Matrix3d plane_inverse_elasticity(double nu) {
  Eigen::Matrix3d inverse;
  inverse << 1, -nu, 0, -nu, 1, 0, 0, 0, 2 * (1 + nu);
  return inverse;
}

Eigen::Matrix<double, 3, 2> triangle_gradients(const Eigen::Matrix2d& inverse) {
  Eigen::Matrix<double, 3, 2> y;
  y << -inverse.colwise().sum(), inverse;
  return y;
}

Eigen::Matrix2d rest_edges(const Eigen::Matrix3d& rest) {
  const Vec3 first = rest.col(1) - rest.col(0);
  const Vec3 second = rest.col(2) - rest.col(0);
  const double length = first.norm();
  Eigen::Matrix2d edges;
  edges << length, first.dot(second) / length, 0, first.cross(second).norm() / length;
  return edges;
}

Eigen::Matrix2d tension_of(const Vec3& impulse) {
  Eigen::Matrix2d stress;
  stress << impulse[0], impulse[2], impulse[2], impulse[1];
  return -stress;
}

}  // namespace

auto Constraint<TriangleStrain>::node(const TriangleStrain& effect, std::size_t i) -> Nodes {
  return effect.node[i];
}

auto Constraint<TriangleStrain>::rest(const TriangleStrain& effect, std::size_t i) -> const Positions& {
  return effect.rest[i];
}

double Constraint<TriangleStrain>::compliance_scale(const TriangleStrain& effect, std::size_t i) {
  return 1 / triangle_area(effect.rest[i]);
}

auto Constraint<TriangleStrain>::unit_compliance(const TriangleStrain& effect) -> Square {
  return plane_inverse_elasticity(effect.material.poisson) / (effect.thickness * effect.material.young);
}

auto Constraint<TriangleStrain>::retardation(const TriangleStrain& effect, std::size_t) -> Square {
  return plane_inverse_elasticity(effect.material.poisson) *
         inverse_of(plane_inverse_elasticity(effect.damping->poisson)) *
         (effect.damping->young / effect.material.young);
}

void Constraint<TriangleStrain>::evaluate(const TriangleStrain& effect, std::size_t i, const Positions& x,
                                          Value& value, Jacobian& jacobian) {
  const Eigen::Matrix2d inverse = rest_edges(effect.rest[i]).inverse();
  const Eigen::Matrix<double, 3, 2> f = (x.rightCols<2>().colwise() - x.col(0)) * inverse;
  value << (f.col(0).squaredNorm() - 1) / 2, (f.col(1).squaredNorm() - 1) / 2, f.col(0).dot(f.col(1));

  const Eigen::Matrix<double, 3, 2> y = triangle_gradients(inverse);
  for (int a = 0; a < 3; ++a)
    jacobian.middleCols<3>(3 * a) << y(a, 0) * f.col(0).transpose(), y(a, 1) * f.col(1).transpose(),
        y(a, 1) * f.col(0).transpose() + y(a, 0) * f.col(1).transpose();
}

auto Constraint<TriangleStrain>::geometric_bound(const TriangleStrain& effect, std::size_t i,
                                                 const Positions&, const Value& impulse) -> NodeBounds {
  return stress_bound(triangle_gradients(rest_edges(effect.rest[i]).inverse()), tension_of(impulse));
}

auto Constraint<TriangleStrain>::geometric_stiffness(const TriangleStrain& effect, std::size_t i,
                                                     const Positions&, const Value& impulse, bool convex)
    -> Stiffness {
  const Eigen::Matrix<double, 3, 2> y = triangle_gradients(rest_edges(effect.rest[i]).inverse());
  const Eigen::Matrix2d tension = tension_of(impulse);
  const Eigen::Matrix3d pairs =
      convex ? stress_stiffness(y, tension) : Eigen::Matrix3d(y * tension * y.transpose());
  Stiffness stiffness;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      stiffness.block<3, 3>(3 * a, 3 * b) = pairs(a, b) * Eigen::Matrix3d::Identity();
  return stiffness;
}

std::unique_ptr<Source> make_source(const Scene& scene, const TriangleStrain& effect) {
  return std::make_unique<EffectRows<TriangleStrain>>(scene, effect);
}

}  // namespace pbd
