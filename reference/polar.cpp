#include "polar.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace pbd::reference {
namespace {

using Matrix9 = Eigen::Matrix<double, 9, 9>;

Strain6 components(const Eigen::Matrix3d& s) {
  Strain6 c;
  c << s(0, 0), s(1, 1), s(2, 2), 2 * s(0, 1), 2 * s(1, 2), 2 * s(2, 0);
  return c;
}

Eigen::Matrix3d symmetric_factor(const ProperSvd& svd) {
  return svd.v * svd.s.asDiagonal() * svd.v.transpose();
}

/// 1/(s_i + s_j), its denominator kept away from zero with its sign.
Eigen::Matrix3d inverse_sums(const Eigen::Vector3d& s) {
  Eigen::Matrix3d inverse;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double sum = s(i) + s(j);
      inverse(i, j) = 1 / std::copysign(std::max(std::abs(sum), smallest_sum), sum);
    }
  return inverse;
}

/// Direction a of F in the frame of the singular vectors: the unit matrix with row a % 3, column a / 3.
Eigen::Matrix3d unit(int a) {
  Eigen::Matrix3d e = Eigen::Matrix3d::Zero();
  e(a % 3, a / 3) = 1;
  return e;
}

/// Kronecker matrix taking the entries of dF to those of U^T dF V.
Matrix9 to_singular_frame(const ProperSvd& svd) {
  Matrix9 p;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) p.block<3, 3>(3 * i, 3 * j) = svd.v(j, i) * svd.u.transpose();
  return p;
}

/// Takes the components of a symmetric matrix in the frame V to those in the frame of space.
Eigen::Matrix<double, 6, 6> to_space(const Eigen::Matrix3d& v) {
  static constexpr std::array<std::array<int, 2>, 6> pair{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
  Eigen::Matrix<double, 6, 6> t;
  for (int k = 0; k < 6; ++k) {
    const auto [i, j] = pair[k];
    Eigen::Matrix3d e = v.col(i) * v.col(j).transpose();
    if (i != j) e = (e + e.transpose()).eval() / 2;
    t.col(k) = components(e);
  }
  return t;
}

/// S and its first derivatives by the entries of U^T dF V, in the frame V.
struct Polar {
  ProperSvd svd;
  Eigen::Matrix3d inverse;
  Matrix9 frame;
  Eigen::Matrix<double, 6, 6> space;
  std::array<Eigen::Matrix3d, 9> first;

  explicit Polar(const Eigen::Matrix3d& f)
      : svd(proper_svd(f)),
        inverse(inverse_sums(svd.s)),
        frame(to_singular_frame(svd)),
        space(to_space(svd.v)) {
    for (int a = 0; a < 9; ++a) {
      const Eigen::Matrix3d half = svd.s.asDiagonal() * unit(a);
      first[a] = (half + half.transpose()).cwiseProduct(inverse);
    }
  }

  Strain6 strain() const { return components(symmetric_factor(svd) - Eigen::Matrix3d::Identity()); }
  Eigen::Matrix<double, 6, 9> jacobian() const {
    Eigen::Matrix<double, 6, 9> local;
    for (int a = 0; a < 9; ++a) local.col(a) = components(first[a]);
    return space * local * frame;
  }
};

}  // namespace

ProperSvd proper_svd(const Eigen::Matrix3d& f) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
  ProperSvd proper{svd.matrixU(), svd.singularValues(), svd.matrixV()};
  const auto make_proper = [&](Eigen::Matrix3d& rotation) {
    if (rotation.determinant() > 0) return;
    rotation.col(2) *= -1;
    proper.s(2) *= -1;
  };
  make_proper(proper.u);
  make_proper(proper.v);
  return proper;
}

Strain6 corotational_strain(const Eigen::Matrix3d& f) {
  return components(symmetric_factor(proper_svd(f)) - Eigen::Matrix3d::Identity());
}

StrainSlope corotational_slope(const Eigen::Matrix3d& f) {
  const Polar polar(f);
  return {polar.strain(), polar.jacobian()};
}

StrainDerivatives corotational_derivatives(const Eigen::Matrix3d& f) {
  const Polar polar(f);
  std::array<Matrix9, 6> second;
  for (int a = 0; a < 9; ++a)
    for (int b = 0; b <= a; ++b) {
      const auto &da = polar.first[a], &db = polar.first[b];
      const Eigen::Matrix3d half = unit(a).transpose() * unit(b) - da * db;
      const Strain6 d2 = components((half + half.transpose()).cwiseProduct(polar.inverse));
      for (std::size_t k = 0; k < 6; ++k) second[k](a, b) = second[k](b, a) = d2(k);
    }

  StrainDerivatives result;
  result.value = polar.strain();
  result.jacobian = polar.jacobian();
  for (int k = 0; k < 6; ++k) {
    Matrix9 sum = Matrix9::Zero();
    for (std::size_t l = 0; l < 6; ++l) sum += polar.space(k, l) * second[l];
    result.hessian[k] = polar.frame.transpose() * sum * polar.frame;
  }
  return result;
}

HeldRotation held_rotation(const Eigen::Matrix3d& f, const Strain6& p) {
  const ProperSvd svd = proper_svd(f);
  const Eigen::Matrix3d rotation = svd.u * svd.v.transpose(), inverse = inverse_sums(svd.s);
  Eigen::Matrix3d stress;
  stress << p(0), p(3), p(5), p(3), p(1), p(4), p(5), p(4), p(2);
  HeldRotation held;
  for (int a = 0; a < 9; ++a) {
    const Eigen::Matrix3d strain = rotation.transpose() * unit(a), g = svd.u.transpose() * unit(a) * svd.v;
    held.jacobian.col(a) = components((strain + strain.transpose()) / 2);
    const Eigen::Matrix3d turn = svd.u * (g - g.transpose()).cwiseProduct(inverse) * svd.v.transpose();
    held.turning.col(a) = (turn * stress).reshaped();
  }
  return held;
}

}  // namespace pbd::reference
