// What rows keep of their Jacobians J, one a constraint: the matrix where nothing less will do. A link's
// gradients by its two ends are opposite, of which one is kept; a tetrahedron's are products of its rest's
// inverse and of the directions of its strain, 18 numbers for 72 (tet_strain.h). A sweep reads so much less.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstring>
#include <vector>

#include "scene.h"

namespace pbd {

/// J = (-g, g).
class LinkJacobians {
 public:
  using Value = Eigen::Matrix<double, 1, 1>;
  using Whole = Eigen::Matrix<double, 1, 6>;
  static constexpr std::size_t bytes_of_each = sizeof(Vec3);

  void resize(std::size_t count) { gradient_.resize(count); }
  std::size_t bytes() const { return gradient_.size() * bytes_of_each; }
  void set(std::size_t i, const Whole& jacobian) { gradient_[i] = jacobian.tail<3>().transpose(); }
  void copy(std::size_t from, std::size_t to) { gradient_[to] = gradient_[from]; }

  Whole operator[](std::size_t i) const {
    Whole whole;
    whole << -gradient_[i].transpose(), gradient_[i].transpose();
    return whole;
  }

  /// J_i v
  Value rate(std::size_t i, const std::array<int, 2>& node, const Points& v) const {
    return Value(gradient_[i].dot(v.col(node[1]) - v.col(node[0])));
  }

  /// v += W J_i^T p
  void apply(std::size_t i, const std::array<int, 2>& node, const std::vector<double>& inverse_mass,
             const Value& p, Points& v) const {
    const Vec3 push = gradient_[i] * p[0];
    v.col(node[0]) -= inverse_mass[node[0]] * push;
    v.col(node[1]) += inverse_mass[node[1]] * push;
  }

 private:
  std::vector<Vec3> gradient_;
};

/// A symmetric matrix by its entries xx, yy, zz, xy, yz, zx.
inline Eigen::Matrix3d symmetric_of(const Eigen::Matrix<double, 6, 1>& entries) {
  Eigen::Matrix3d matrix;
  matrix << entries[0], entries[3], entries[5],  //
      entries[3], entries[1], entries[4],        //
      entries[5], entries[4], entries[2];
  return matrix;
}

/// (M_zy - M_yz, M_xz - M_zx, M_yx - M_xy)
inline Vec3 axial(const Eigen::Matrix3d& m) {
  return {m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)};
}

/// How the rotation of a tetrahedron's material follows dF: by w = inverse ax(T^T dF).
struct StrainTurning {
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();  // (tr U - U)^-1, or 0 where it is held fixed
  Eigen::Matrix3d stretch = Eigen::Matrix3d::Zero();  // U
};

Eigen::Matrix<double, 6, 12> strain_jacobian(const Eigen::Matrix3d& rest_inverse,
                                             const Eigen::Matrix3d& directions, const StrainTurning& turning);

/// J v = the entries of M - [w]x U + its transpose, those of the diagonal halved, M = T^T dF, dF = [v1-v0,
/// v2-v0, v3-v0] Dm^-1; J^T p = T (S - [inverse ax(S U)]x) Dm^-T by nodes 1 to 3.
class StrainJacobians {
 public:
  using Value = Eigen::Matrix<double, 6, 1>;
  using Whole = Eigen::Matrix<double, 6, 12>;
  static constexpr std::size_t bytes_of_each = 20 * sizeof(double);

  void resize(std::size_t count) { kept_.resize(count); }
  /// Some turn; else none does, and nothing is kept of it.
  void resize_turning() { turning_.resize(kept_.size()); }
  std::size_t bytes() const { return kept_.size() * sizeof(Kept) + turning_.size() * sizeof(StrainTurning); }
  void set(std::size_t i, const Eigen::Matrix3d& rest_inverse, const Eigen::Matrix3d& directions) {
    Eigen::Matrix3d::Map(kept_[i].data()) = rest_inverse.transpose();
    Eigen::Matrix3d::Map(kept_[i].data() + 9) = directions;
  }
  void set_turning(std::size_t i, const StrainTurning& turning) { turning_[i] = turning; }
  void copy(std::size_t from, std::size_t to) {
    kept_[to] = kept_[from];
    if (!turning_.empty()) turning_[to] = turning_[from];
  }
  Whole operator[](std::size_t i) const;

  /// J_i v
  Value rate(std::size_t i, const std::array<int, 4>& node, const Points& v) const {
    const Kept& kept = kept_[i];
    std::array<Lanes, 3> df, m;  // by rows
    for (int axis = 0; axis < 3; ++axis) {
      const Lanes base = all(v(axis, node[0]));
      df[axis] = three(kept, 0) * (all(v(axis, node[1])) - base) +
                 three(kept, 1) * (all(v(axis, node[2])) - base) +
                 three(kept, 2) * (all(v(axis, node[3])) - base);
    }
    for (int a = 0; a < 3; ++a)
      m[a] = df[0] * all(kept[9 + 3 * a]) + df[1] * all(kept[10 + 3 * a]) + df[2] * all(kept[11 + 3 * a]);
    if (!turning_.empty()) return turning_rate(i, matrix_of(m).transpose());
    const Lanes normal =
        __builtin_shufflevector(__builtin_shufflevector(m[0], m[1], 0, 5, 2, 3), m[2], 0, 1, 6, 3);
    const Lanes below =
        __builtin_shufflevector(__builtin_shufflevector(m[1], m[2], 0, 5, 2, 3), m[0], 0, 1, 6, 3);
    const Lanes above =
        __builtin_shufflevector(__builtin_shufflevector(m[2], m[0], 0, 5, 2, 3), m[1], 0, 1, 6, 3);
    const Lanes shear = below + __builtin_shufflevector(above, above, 1, 2, 0, 3);
    Value rate;
    rate << normal[0], normal[1], normal[2], shear[0], shear[1], shear[2];
    return rate;
  }

  /// v += W J_i^T p
  void apply(std::size_t i, const std::array<int, 4>& node, const std::vector<double>& inverse_mass,
             const Value& p, Points& v) const {
    const Kept& kept = kept_[i];
    const Lanes x = three(kept, 3), y = three(kept, 4), z = three(kept, 5);
    std::array<Lanes, 3> along;  // T S, by columns
    if (turning_.empty()) {
      along[0] = x * all(p[0]) + y * all(p[3]) + z * all(p[5]);
      along[1] = x * all(p[3]) + y * all(p[1]) + z * all(p[4]);
      along[2] = x * all(p[5]) + y * all(p[4]) + z * all(p[2]);
    } else {
      const Eigen::Matrix3d turned = turning_stress(i, p);
      for (int a = 0; a < 3; ++a)
        along[a] = x * all(turned(0, a)) + y * all(turned(1, a)) + z * all(turned(2, a));
    }
    std::array<Lanes, 3> push;
    for (int k = 0; k < 3; ++k)
      push[k] =
          along[0] * all(kept[3 * k]) + along[1] * all(kept[3 * k + 1]) + along[2] * all(kept[3 * k + 2]);
    for (int k = 0; k < 3; ++k) v.col(node[k + 1]) += inverse_mass[node[k + 1]] * vector_of(push[k]);
    v.col(node[0]) -= inverse_mass[node[0]] * vector_of(push[0] + push[1] + push[2]);
  }

 private:
  /// The rows of Dm^-1, and the columns of T. Three of them are read as four numbers, of which the last is of
  /// no use.
  using Kept = std::array<double, 20>;
  using Lanes [[gnu::vector_size(32)]] = double;
  static Lanes three(const Kept& kept, int k) {
    Lanes lanes;
    std::memcpy(&lanes, kept.data() + 3 * k, sizeof lanes);
    return lanes;
  }
  static Lanes all(double value) { return Lanes{value, value, value, value}; }
  static Vec3 vector_of(const Lanes& lanes) { return {lanes[0], lanes[1], lanes[2]}; }
  static Eigen::Matrix3d matrix_of(const std::array<Lanes, 3>& columns) {
    Eigen::Matrix3d matrix;
    for (int a = 0; a < 3; ++a) matrix.col(a) = vector_of(columns[a]);
    return matrix;
  }
  Value turning_rate(std::size_t i, const Eigen::Matrix3d& m) const;
  /// S - [inverse ax(S U)]x
  Eigen::Matrix3d turning_stress(std::size_t i, const Value& p) const;

  std::vector<Kept> kept_;
  std::vector<StrainTurning> turning_;
};

}  // namespace pbd
