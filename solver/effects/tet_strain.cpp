#include "effects/tet_strain.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "effects/stress_bound.h"
#include "mesh.h"
#include "rows/bodies.h"
#include "rows/effect_rows.h"
#include "rows/polar.h"
#include "rows/symmetric_eigen.h"

namespace pbd {
namespace {

/// Y C^-1 at Poisson's ratio nu
Constraint<TetStrain>::Square inverse_elasticity(double nu) {
  Constraint<TetStrain>::Square inverse = Constraint<TetStrain>::Square::Zero();
  inverse.topLeftCorner<3, 3>().setConstant(-nu);
  inverse.diagonal() << 1, 1, 1, 2 * (1 + nu), 2 * (1 + nu), 2 * (1 + nu);
  return inverse;
}

Eigen::Matrix3d stress_of(const Constraint<TetStrain>::Value& p) {
  Eigen::Matrix3d matrix;
  matrix << p[0], p[3], p[5], p[3], p[1], p[4], p[5], p[4], p[2];
  return matrix;
}

Eigen::Matrix3d inverse_rest(const TetStrain& effect, std::size_t i) {
  const auto& rest = effect.rest[i];
  return Eigen::Matrix3d(rest.rightCols<3>().colwise() - rest.col(0)).inverse();
}

Eigen::Matrix<double, 4, 3> tet_gradients(const Eigen::Matrix3d& inverse) {
  Eigen::Matrix<double, 4, 3> y;
  y << -inverse.colwise().sum(), inverse;
  return y;
}

Eigen::Matrix3d directions(Strain strain, const Eigen::Matrix3d& f) {
  switch (strain) {
    case Strain::green:
      return f;
    case Strain::corotational:
      return polar_rotation(f);
    case Strain::linear:
      return Eigen::Matrix3d::Identity();
  }
  return f;
}

/// The least sum of two stretches that counts as one.
constexpr double least_pair = 0.1;

Vec3 axial(const Eigen::Matrix3d& m) {
  return {m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)};
}

/// How R follows F: by w = inverse ax(T^T dF).
struct Turning {
  Eigen::Matrix3d stretch;                            // U
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();  // (tr U - U)^-1, or 0 where R is held

  explicit Turning(const Constraint<TetStrain>::Deformation& at) {
    const Eigen::Matrix3d product = at.t.transpose() * at.f;
    stretch = (product + product.transpose()) / 2;
    const Eigen::Matrix3d pairs = stretch.trace() * Eigen::Matrix3d::Identity() - stretch;
    const Eigen::Matrix3d above = pairs - least_pair * Eigen::Matrix3d::Identity();
    // Its leading minors tell whether all sums of two are above.
    if (above(0, 0) > 0 && above.topLeftCorner<2, 2>().determinant() > 0 && above.determinant() > 0)
      inverse = pairs.inverse();
  }

  /// B of kept_jacobians.h: in each column what a unit of ax takes off the strain as it turns R; z, x, y.
  StrainJacobians::Turning by_skew() const {
    StrainJacobians::Turning by;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Matrix3d turned = cross_matrix(inverse.col((k + 2) % 3)) * stretch;
      by.col(k) << turned.diagonal(), turned(0, 1) + turned(1, 0), turned(1, 2) + turned(2, 1),
          turned(2, 0) + turned(0, 2);
    }
    return by;
  }
};

}  // namespace

auto Constraint<TetStrain>::node(const TetStrain& effect, std::size_t i) -> Nodes {
  return effect.node[i];
}

auto Constraint<TetStrain>::rest(const TetStrain& effect, std::size_t i) -> const Positions& {
  return effect.rest[i];
}

double Constraint<TetStrain>::compliance_scale(const TetStrain& effect, std::size_t i) {
  return 1 / tet_volume(effect.rest[i]);
}

auto Constraint<TetStrain>::unit_compliance(const TetStrain& effect) -> Square {
  return inverse_elasticity(effect.material.poisson) / effect.material.young;
}

auto Constraint<TetStrain>::retardation(const TetStrain& effect, std::size_t) -> Square {
  return inverse_elasticity(effect.material.poisson) *
         inverse_of(inverse_elasticity(effect.damping->poisson)) *
         (effect.damping->young / effect.material.young);
}

auto Constraint<TetStrain>::deformation(const TetStrain& effect, std::size_t i, const Positions& x)
    -> Deformation {
  const Eigen::Matrix3d inverse = inverse_rest(effect, i);
  const Eigen::Matrix3d f = (x.rightCols<3>().colwise() - x.col(0)) * inverse;
  return {inverse, f, directions(effect.strain, f)};
}

auto Constraint<TetStrain>::strain(const TetStrain& effect, const Deformation& at) -> Value {
  const Eigen::Matrix3d stretch = at.t.transpose() * at.f;
  const Eigen::Matrix3d twice = stretch + stretch.transpose();
  Value value;
  value << twice.diagonal() / 2, twice(0, 1), twice(1, 2), twice(2, 0);
  if (effect.strain == Strain::green) value /= 2;
  value.head<3>().array() -= effect.strain == Strain::green ? 0.5 : 1.0;
  return value;
}

auto Constraint<TetStrain>::push(const TetStrain& effect, const Deformation& at, const Value& impulse)
    -> Positions {
  Eigen::Matrix3d stress = stress_of(impulse);
  if (turns(effect)) {
    const Turning turning(at);
    stress -= cross_matrix(turning.inverse * axial(stress * turning.stretch));
  }
  Positions pushed;
  pushed.rightCols<3>().noalias() = at.t * stress * at.inverse.transpose();
  pushed.col(0) = -pushed.rightCols<3>().rowwise().sum();
  return pushed;
}

Eigen::Matrix3d Constraint<TetStrain>::weighted_deformation(const TetStrain& effect, std::size_t i,
                                                            const Positions& x) {
  const Eigen::Matrix3d f = (x.rightCols<3>().colwise() - x.col(0)) * inverse_rest(effect, i);
  return tet_volume(effect.rest[i]) * (effect.strain == Strain::linear ? Eigen::Matrix3d::Identity() : f);
}

bool Constraint<TetStrain>::turns(const TetStrain& effect) {
  return effect.strain == Strain::corotational && effect.damping;
}

void Constraint<TetStrain>::linearise(const TetStrain& effect, std::size_t i, const Positions& x,
                                      Value& value, StrainJacobians& jacobians, std::size_t row) {
  const Deformation at = deformation(effect, i, x);
  value = strain(effect, at);
  jacobians.set(row, at.inverse, at.t);
  if (turns(effect)) jacobians.set_turning(row, Turning(at).by_skew());
}

void Constraint<TetStrain>::evaluate(const TetStrain& effect, std::size_t i, const Positions& x, Value& value,
                                     Jacobian& jacobian) {
  const Deformation at = deformation(effect, i, x);
  value = strain(effect, at);
  StrainJacobians::Turning turning;
  if (turns(effect)) turning = Turning(at).by_skew();
  jacobian = StrainJacobians::whole(at.inverse, at.t, turns(effect) ? &turning : nullptr);
}

auto Constraint<TetStrain>::geometric_bound(const TetStrain& effect, std::size_t i, const Positions& x,
                                            const Value& impulse) -> NodeBounds {
  if (effect.strain == Strain::linear) return NodeBounds::Zero();
  const Eigen::Matrix3d stress = stress_of(impulse);
  const Eigen::Matrix3d inverse = inverse_rest(effect, i);
  if (effect.strain == Strain::green) return stress_bound(tet_gradients(inverse), Eigen::Matrix3d(-stress));
  const Eigen::Matrix3d f = (x.rightCols<3>().colwise() - x.col(0)) * inverse;
  const Eigen::Matrix3d stretch = polar_rotation(f).transpose() * f;
  const Eigen::Matrix3d symmetric = (stretch + stretch.transpose()) / 2;
  const double pair = symmetric.trace() - symmetric_eigenvalues(symmetric).maxCoeff();
  const Vec3 tension = symmetric_eigenvalues(-stress);
  double largest = 0;
  for (int a = 0; a < 3; ++a) {
    const double one = tension[a], other = tension[(a + 1) % 3];
    largest = std::max(largest, (one + other + std::sqrt(2 * (one * one + other * other))) / 2);
  }
  const Eigen::Matrix<double, 4, 3> y = tet_gradients(inverse);  // `stress_bound` of a multiple of 1
  return std::max(0.0, largest) / std::max(pair, least_pair) *
         (y * y.transpose()).cwiseAbs().rowwise().sum().transpose();
}

std::unique_ptr<Source> make_source(const Scene& scene, const TetStrain& effect) {
  return std::make_unique<EffectRows<TetStrain>>(scene, effect);
}

}  // namespace pbd
