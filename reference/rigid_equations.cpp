#include "rigid_equations.h"

#include <cmath>

#include "joint_values.h"

namespace pbd::reference {
namespace {

using Half = Eigen::Matrix<double, 3, 4>;

/// Im(a* b) as a matrix on b's components (w, x, y, z).
Half conjugate_product(const Eigen::Vector4d& a) {
  return Half{{-a[1], a[0], a[3], -a[2]}, {-a[2], -a[3], a[0], a[1]}, {-a[3], a[2], -a[1], a[0]}};
}

/// q_l (cos(h |w|/2), h w/2 sinc) with derivatives by w.
std::array<Jet<3, 1>, 4> turned_quaternion(const Eigen::Quaterniond& from, const Vec3& w, double h) {
  using T = Jet<3, 1>;
  Triple<T> half;
  for (int i = 0; i < 3; ++i) half[i] = 0.5 * h * T::variable(w[i], i);
  // cos(s) and sin(s)/s are functions of s^2; their derivatives by it are -sin(s)/(2 s) and
  // (cos(s) - sin(s)/s)/(2 s^2).
  const T square = dot(half, half);
  const double s = std::sqrt(square.value);
  constexpr double small = 1e-4;
  const double sinc = s > small ? std::sin(s) / s : 1 - s * s / 6;
  const double slope = s > small ? (std::cos(s) - sinc) / (2 * s * s) : -1.0 / 6 + s * s / 60;
  const T ratio = T::chain(square, sinc, slope, 0);
  const Quaternion<T> turn{T::chain(square, std::cos(s), -sinc / 2, 0),
                           {ratio * half[0], ratio * half[1], ratio * half[2]}};
  const Quaternion<T> q = product(constant<T>(from), turn);
  return {q.w, q.v[0], q.v[1], q.v[2]};
}

class EquationBuilder {
 public:
  EquationBuilder(const RigidStep& step, const Layout& layout, const Vector& z)
      : s_(step), layout_(layout), z_(z), out_{Vector::Zero(layout.size), {}} {}

  Equations build() {
    Placement at = s_.placement(z_.head(layout_.model.unknowns));
    translations();
    for (std::size_t b = 0; b < layout_.model.rotors.size(); ++b)
      if (layout_.quaternion[b] >= 0) {
        const Eigen::Vector4d q = z_.segment<4>(layout_.quaternion[b]);
        at.orientation[b] = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
        rotation(b);
      }
    const Vector gamma = z_.tail(layout_.model.rows());
    for (const Block& block : blocks_at(layout_.model, at, Coordinates::quaternions)) add(block, gamma);
    return std::move(out_);
  }

 private:
  template <class Square>
  void put(int row, int column, const Square& part) {
    for (int i = 0; i < part.rows(); ++i)
      for (int j = 0; j < part.cols(); ++j) out_.jacobian.emplace_back(row + i, column + j, part(i, j));
  }

  void translations() {
    const Model& nodes = s_.model.nodes;
    const int n = nodes.unknowns;
    out_.residual.head(n) =
        nodes.mass.cwiseProduct(z_.head(n) - gather(nodes, s_.start.v)) / s_.h - nodes.force;
    for (int i = 0; i < n; ++i) out_.jacobian.emplace_back(i, i, nodes.mass(i) / s_.h);
  }

  void rotation(std::size_t b) {
    const Rotor& rotor = s_.model.rotors[b];
    const int first = rotor.unknown, at = layout_.quaternion[b];
    const Vec3 w = z_.segment<3>(first), before = s_.start.spin.col(b);
    // Euler's equations: I2 w2' - (I3 - I1) w3 w1 = ..., by jets.
    Triple<Jet<3, 1>> now;
    for (int i = 0; i < 3; ++i) now[i] = Jet<3, 1>::variable(w[i], i);
    const bool implicit = s_.model.gyroscopic == GyroscopicTorque::at_end;
    const bool none = s_.model.gyroscopic == GyroscopicTorque::none;
    const Vec3 torque = s_.start.orientation[b].toRotationMatrix().transpose() * rotor.torque;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const auto turn = [&](int l) { return implicit ? now[l] : Jet<3, 1>(before[l]); };
      Jet<3, 1> equation = rotor.inertia[i] / s_.h * (now[i] - Jet<3, 1>(before[i])) - Jet<3, 1>(torque[i]);
      if (!none) equation += (rotor.inertia[k] - rotor.inertia[j]) * (turn(j) * turn(k));
      out_.residual(first + i) = equation.value;
      put(first + i, first, equation.gradient.transpose());
    }
    const auto turned = turned_quaternion(s_.start.orientation[b], w, s_.h);
    for (int i = 0; i < 4; ++i) {
      const auto& component = turned[i];
      out_.residual(at + i) = z_(at + i) - component.value;
      out_.jacobian.emplace_back(at + i, at + i, 1.0);
      put(at + i, first, -component.gradient.transpose());
    }
  }

  /// A part's equations, as a matrix on dc/d(its coordinates), and the unknowns these depend on.
  struct Share {
    int equation, offset, size, unknown;
    double per_unknown;  // of the coordinates: h for velocities
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 4> balance;
  };

  std::vector<Share> shares(const Block& block) const {
    std::vector<Share> list;
    for (const auto& [node, body, offset] : block.parts) {
      if (const int i = s_.model.nodes.first[node]; i >= 0)
        list.push_back({i, offset, 3, i, s_.h, Eigen::Matrix3d::Identity()});
      if (body >= 0 && layout_.quaternion[body] >= 0) {
        const int at = layout_.quaternion[body];
        list.push_back(
            {s_.model.rotors[body].unknown, offset + 3, 4, at, 1, conjugate_product(z_.segment<4>(at)) / 2});
      }
    }
    return list;
  }

  void add(const Block& block, const Vector& gamma) {
    const int row = layout_.multipliers + block.row, rows = block.rows();
    const RowVector own = gamma.segment(block.row, rows);
    const Block::Square geometric = block.geometric(own, Coordinates::quaternions);
    out_.residual.segment(row, rows) = block.value;
    if (!block.hard) {
      out_.residual.segment(row, rows) += block.compliance * own;
      put(row, row, block.compliance);
    }
    const Vector force = block.jacobian.transpose() * own;
    const std::vector<Share> list = shares(block);
    for (const Share& a : list) {
      const auto slope = block.jacobian.middleCols(a.offset, a.size);
      put(row, a.unknown, a.per_unknown * slope);
      out_.residual.segment<3>(a.equation) -= a.balance * force.segment(a.offset, a.size);
      put(a.equation, row, -a.balance * slope.transpose());
      for (const Share& b : list)
        put(a.equation, b.unknown,
            -b.per_unknown * a.balance * geometric.block(a.offset, b.offset, a.size, b.size));
      // Im(q* g)/2 changes with q, too: Im(q* g) = -Im(g* q).
      if (a.size == 4) put(a.equation, a.unknown, conjugate_product(force.segment<4>(a.offset)) / 2);
    }
  }

  const RigidStep& s_;
  const Layout& layout_;
  const Vector& z_;
  Equations out_;
};

}  // namespace

Layout::Layout(const RigidModel& m) : model(m) {
  int next = m.unknowns;
  for (const Rotor& rotor : m.rotors) {
    quaternion.push_back(rotor.unknown < 0 ? -1 : next);
    if (rotor.unknown >= 0) next += 4;
  }
  multipliers = next;
  size = next + m.rows();
}

Equations equations_at(const RigidStep& step, const Layout& layout, const Vector& z) {
  return EquationBuilder(step, layout, z).build();
}

}  // namespace pbd::reference
