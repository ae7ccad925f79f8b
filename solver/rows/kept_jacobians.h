// What rows keep of their Jacobians J, one a constraint: the matrix where nothing less will do. A link's
// gradients by its two ends are opposite: one of them is kept. A tetrahedron's are products of its rest's
// inverse and of the directions of its strain, 18 numbers for 72, and where its material's rotation follows
// 18 more (tet_strain.h). A sweep reads so much less.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstring>
#include <vector>

#include "scene.h"

namespace pbd {

/// J = (-g, g), g in units of the value a metre.
class LinkJacobians {
 public:
  using Value = Eigen::Matrix<double, 1, 1>;
  using Whole = Eigen::Matrix<double, 1, 6>;
  static constexpr std::size_t bytes_of_each = sizeof(Vec3);

  void resize(std::size_t count) { gradient_.resize(count); }
  std::size_t bytes() const { return gradient_.size() * bytes_of_each; }
  void set(std::size_t i, const Vec3& gradient) { gradient_[i] = gradient; }
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

/// With M = T^T dF and dF = [v1 - v0, v2 - v0, v3 - v0] Dm^-1
///   J v = e(M) - B (M_yx - M_xy, M_zy - M_yz, M_xz - M_zx),   e(M) = (M_xx, M_yy, M_zz, M_xy + M_yx, ..)
/// and by nodes 1 to 3 J^T p = T (S - [(w_2, w_3, w_1)]x) Dm^-T, S the symmetric matrix of p and w = B^T p.
/// B = 0 where the rotation is held.
class StrainJacobians {
  /// The rows of Dm^-1, and the columns of T. Three numbers are read as four, of which the last is of no use.
  using Kept = std::array<double, 20>;

 public:
  using Value = Eigen::Matrix<double, 6, 1>;
  using Whole = Eigen::Matrix<double, 6, 12>;
  using Turning = Eigen::Matrix<double, 6, 3>;                // B
  static constexpr std::size_t bytes_of_each = sizeof(Kept);  // but for what turns

  void resize(std::size_t count) {
    kept_.resize(count);
    if (!turning_.empty()) turning_.resize(count, Turning::Zero());
  }
  /// B = 0, until it is set; before, nothing is kept of it.
  void begin_turning() { turning_.assign(kept_.size(), Turning::Zero()); }
  std::size_t bytes() const { return kept_.size() * sizeof(Kept) + turning_.size() * sizeof(Turning); }

  /// Dm^-1 (1/m) and T.
  void set(std::size_t i, const Eigen::Matrix3d& rest_inverse, const Eigen::Matrix3d& directions) {
    Eigen::Matrix3d::Map(kept_[i].data()) = rest_inverse.transpose();
    Eigen::Matrix3d::Map(kept_[i].data() + 9) = directions;
  }
  void set_turning(std::size_t i, const Turning& turning) { turning_[i] = turning; }
  void copy(std::size_t from, std::size_t to) {
    kept_[to] = kept_[from];
    if (!turning_.empty()) turning_[to] = turning_[from];
  }
  Whole operator[](std::size_t i) const;
  /// J of these; without `turning` B = 0.
  static Whole whole(const Eigen::Matrix3d& rest_inverse, const Eigen::Matrix3d& directions,
                     const Turning* turning);

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
    const Lanes diagonal = one_of_each(m[0], m[1], m[2]), below = one_of_each(m[1], m[2], m[0]),
                before = one_of_each(m[2], m[0], m[1]);
    const Lanes above = __builtin_shufflevector(before, before, 1, 2, 0, 3);
    const Lanes shear = below + above, skew = below - above;
    Value rate;
    rate << diagonal[0], diagonal[1], diagonal[2], shear[0], shear[1], shear[2];
    if (!turning_.empty()) rate -= turning_[i] * vector_of(skew);
    return rate;
  }

  /// v += W J_i^T p
  void apply(std::size_t i, const std::array<int, 4>& node, const std::vector<double>& inverse_mass,
             const Value& p, Points& v) const {
    const Kept& kept = kept_[i];
    Vec3 w = Vec3::Zero();
    if (!turning_.empty()) w = turning_[i].transpose() * p;
    const Lanes x = three(kept, 3), y = three(kept, 4), z = three(kept, 5);
    const std::array<Lanes, 3> along{// T (S - [..]x), by columns
                                     x * all(p[0]) + y * all(p[3] - w[0]) + z * all(p[5] + w[2]),
                                     x * all(p[3] + w[0]) + y * all(p[1]) + z * all(p[4] - w[1]),
                                     x * all(p[5] - w[2]) + y * all(p[4] + w[1]) + z * all(p[2])};
    std::array<Lanes, 3> push;
    for (int k = 0; k < 3; ++k)
      push[k] =
          along[0] * all(kept[3 * k]) + along[1] * all(kept[3 * k + 1]) + along[2] * all(kept[3 * k + 2]);
    for (int k = 0; k < 3; ++k) v.col(node[k + 1]) += inverse_mass[node[k + 1]] * vector_of(push[k]);
    v.col(node[0]) -= inverse_mass[node[0]] * vector_of(push[0] + push[1] + push[2]);
  }

 private:
  using Lanes [[gnu::vector_size(32)]] = double;
  static Lanes three(const Kept& kept, int k) {
    Lanes lanes;
    std::memcpy(&lanes, kept.data() + 3 * k, sizeof lanes);
    return lanes;
  }
  static Lanes all(double value) { return Lanes{value, value, value, value}; }
  static Lanes one_of_each(const Lanes& a, const Lanes& b, const Lanes& c) {
    return __builtin_shufflevector(__builtin_shufflevector(a, b, 0, 5, 2, 3), c, 0, 1, 6, 3);
  }
  static Vec3 vector_of(const Lanes& lanes) { return {lanes[0], lanes[1], lanes[2]}; }

  std::vector<Kept> kept_;
  std::vector<Turning> turning_;
};

}  // namespace pbd
