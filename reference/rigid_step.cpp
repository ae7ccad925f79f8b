#include "rigid_step.h"

#include <Eigen/Dense>
#include <cmath>

#include "dense.h"

namespace pbd::reference {

Eigen::Matrix3d inverse_right_jacobian(const Vec3& t) {
  const double angle = t.norm();
  constexpr double small = 1e-3;  // the series' next term is angle^4/30240
  const double factor = angle > small ? (1 - angle / 2 / std::tan(angle / 2)) / (angle * angle)
                                      : 1.0 / 12 + angle * angle / 720;
  const Eigen::Matrix3d cross = cross_matrix(t);
  return Eigen::Matrix3d::Identity() + cross / 2 + factor * cross * cross;
}

namespace {

void add_square(Triplets& entries, int row, int column, const Eigen::Matrix3d& square) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) entries.emplace_back(row + i, column + j, square(i, j));
}

/// First unknown of each three coordinates of a block in turns, or -1.
std::vector<std::pair<int, int>> unknowns_of(const RigidModel& model, const Block& block) {
  std::vector<std::pair<int, int>> list;
  for (const auto& [node, body, offset] : block.parts) {
    list.emplace_back(offset, model.nodes.first[node]);
    if (body >= 0) list.emplace_back(offset + 3, model.rotors[body].unknown);
  }
  return list;
}

/// Inertia and loads of the rotations.
void add_rotations(const RigidStep& s, const Vector& velocity, RigidSystem& system, Triplets& tangent) {
  const Vector from = s.base();
  for (std::size_t b = 0; b < s.model.rotors.size(); ++b) {
    const Rotor& rotor = s.model.rotors[b];
    if (rotor.unknown < 0) continue;
    const Vec3 w = velocity.segment<3>(rotor.unknown), before = s.start.spin.col(b),
               base = from.segment<3>(rotor.unknown);
    const Vec3 torque = s.start.orientation[b].conjugate() * rotor.torque;
    const Vec3 momentum = rotor.inertia.cwiseProduct(w);
    Eigen::Matrix3d by_w = Eigen::Matrix3d(rotor.inertia.asDiagonal()) / s.s();
    Vec3 gyroscopic = Vec3::Zero();
    if (s.model.gyroscopic == GyroscopicTorque::at_end) {
      gyroscopic = w.cross(momentum);
      by_w += cross_matrix(w) * rotor.inertia.asDiagonal() - cross_matrix(momentum);
    } else if (s.model.gyroscopic == GyroscopicTorque::at_start) {
      gyroscopic = before.cross(rotor.inertia.cwiseProduct(before));
    }
    const Vec3 inertial = rotor.inertia.cwiseProduct(w - base) / s.s();
    system.load.segment<3>(rotor.unknown) = inertial + gyroscopic - torque;
    system.magnitude.segment<3>(rotor.unknown) =
        rotor.inertia.cwiseProduct(w.cwiseAbs() + base.cwiseAbs()) / s.s() + gyroscopic.cwiseAbs() +
        torque.cwiseAbs();
    add_square(tangent, rotor.unknown, rotor.unknown,
               by_w * inverse_right_jacobian(s.arc(velocity, rotor.unknown)) / s.d());
  }
}

}  // namespace

Vector RigidStep::start_velocity() const {
  Vector velocity(model.unknowns);
  velocity.head(model.nodes.unknowns) = gather(model.nodes, start.v);
  for (std::size_t b = 0; b < model.rotors.size(); ++b)
    if (const int i = model.rotors[b].unknown; i >= 0) velocity.segment<3>(i) = start.spin.col(b);
  return velocity;
}

State RigidStep::end(const Vector& velocity) const {
  const double solved = h / extension();
  State state = start;
  state.time += solved;
  state.v = scatter(model.nodes, start.v, velocity.head(model.nodes.unknowns));
  state.x += solved * state.v;
  if (map)
    for (std::size_t i = 0; i < model.nodes.first.size(); ++i)
      if (const int u = model.nodes.first[i]; u >= 0) {
        const auto node = static_cast<Eigen::Index>(i);
        state.x.col(node) = start.x.col(node) + map->shift.segment<3>(u) + map->d * state.v.col(node);
      }
  for (std::size_t b = 0; b < model.rotors.size(); ++b) {
    const auto column = static_cast<int>(b);
    if (const int i = model.rotors[b].unknown; i >= 0) state.spin.col(column) = velocity.segment<3>(i);
    const int unknown = model.rotors[b].unknown;
    const Vec3 turned = unknown >= 0 ? arc(velocity, unknown) : Vec3(solved * state.spin.col(column));
    state.orientation[b] = turned_by(start.orientation[b], turned);
  }
  return state;
}

State RigidStep::carried_on(const Vector& velocity) const {
  State state = end(velocity);
  const double on = extension() - 1;
  if (on == 0) return state;
  state.time = start.time + h;
  for (std::size_t b = 0; b < model.rotors.size(); ++b) {
    const int unknown = model.rotors[b].unknown;
    const Vec3 turned = unknown >= 0 ? arc(velocity, unknown)
                                     : Vec3(h / extension() * state.spin.col(static_cast<Eigen::Index>(b)));
    state.orientation[b] = turned_by(state.orientation[b], on * turned);
  }
  state.x += on * (state.x - start.x);
  state.v += on * (state.v - start.v);
  state.spin += on * (state.spin - start.spin);
  return state;
}

Placement RigidStep::placement(const Vector& velocity) const {
  State state = end(velocity);
  return {std::move(state.x), std::move(state.orientation), state.time};
}

Vector RigidSystem::force(const Vector& gamma) const {
  return load - jacobian.transpose() * gamma;
}
Vector RigidSystem::gap(const Vector& gamma) const {
  return value + compliance * gamma;
}

RigidSystem system_at(const RigidStep& s, const Vector& velocity, const Vector& gamma) {
  const RigidModel& model = s.model;
  const int n = model.nodes.unknowns;
  RigidSystem system;
  system.load.resize(model.unknowns);
  system.magnitude.resize(model.unknowns);
  system.value.resize(model.rows());
  const Vector before = s.base().head(n);
  system.load.head(n) = model.nodes.mass.cwiseProduct(velocity.head(n) - before) / s.s() - model.nodes.force;
  system.magnitude.head(n) =
      model.nodes.mass.cwiseProduct(velocity.head(n).cwiseAbs() + before.cwiseAbs()) / s.s() +
      model.nodes.force.cwiseAbs();
  Triplets tangent, jacobian, compliance;
  for (int i = 0; i < n; ++i) tangent.emplace_back(i, i, model.nodes.mass(i) / (s.s() * s.d()));
  add_rotations(s, velocity, system, tangent);
  for (Block& block : blocks_at(model, s.placement(velocity), Coordinates::turns)) {
    const int rows = block.rows();
    if (const auto damped = s.damping.find(block.row); damped != s.damping.end()) {
      block.value -= damped->second.offset;
      block.compliance = product(Eigen::MatrixXd(damped->second.share), Eigen::MatrixXd(block.compliance));
    }
    const RowVector own = gamma.segment(block.row, rows);
    const Block::Square geometric = block.geometric(own, Coordinates::turns);
    system.value.segment(block.row, rows) = block.value;
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < rows; ++j)
        if (!block.hard) compliance.emplace_back(block.row + i, block.row + j, block.compliance(i, j));
    const auto unknowns = unknowns_of(model, block);
    for (const auto& [at, unknown] : unknowns) {
      if (unknown < 0) continue;
      for (int i = 0; i < rows; ++i)
        for (int k = 0; k < 3; ++k)
          jacobian.emplace_back(block.row + i, unknown + k, block.jacobian(i, at + k));
      system.magnitude.segment<3>(unknown) +=
          block.jacobian.middleCols<3>(at).cwiseAbs().transpose() * own.cwiseAbs();
      for (const auto& [other, column] : unknowns)
        if (column >= 0) add_square(tangent, unknown, column, -geometric.block<3, 3>(at, other));
    }
  }
  system.tangent = from_triplets(model.unknowns, model.unknowns, tangent);
  system.jacobian = from_triplets(model.rows(), model.unknowns, jacobian);
  system.compliance = from_triplets(model.rows(), model.rows(), compliance);
  return system;
}

Vector velocity_change(const RigidStep& s, const Vector& velocity, const Vector& increment) {
  Vector change = increment / s.d();
  for (const Rotor& rotor : s.model.rotors)
    if (const int i = rotor.unknown; i >= 0)
      change.segment<3>(i) = inverse_right_jacobian(s.arc(velocity, i)) * increment.segment<3>(i) / s.d();
  return change;
}

double displacement_of(const RigidStep& s, const Vector& velocity) {
  const double moved = std::max(velocity.cwiseProduct(s.model.radius).cwiseAbs().maxCoeff(),
                                s.start_velocity().cwiseProduct(s.model.radius).cwiseAbs().maxCoeff());
  constexpr double smallest = 1e-6;  // of the positions
  return std::max({s.h * moved, smallest * s.end(velocity).x.cwiseAbs().maxCoeff(), 1e-300});
}

void report(const RigidStep& s, const Vector& velocity, const Vector& gamma, Judgement& j) {
  const RigidSystem system = system_at(s, velocity, gamma);
  State end = s.carried_on(velocity);
  j.x = std::move(end.x), j.v = std::move(end.v);
  j.orientation = std::move(end.orientation), j.spin = std::move(end.spin);
  const Vector per_length = s.model.radius.cwiseInverse();
  j.residual = system.force(gamma).cwiseProduct(per_length).cwiseAbs().maxCoeff() /
               std::max(system.magnitude.cwiseProduct(per_length).maxCoeff(), 1e-300);
  const double displacement = displacement_of(s, velocity);
  const Vector squares = squared_rows(scaled(system.jacobian, per_length), Vector::Ones(s.model.unknowns));
  std::vector<double> hard;
  j.infeasible = 0;
  for (int i = 0; i < s.model.rows(); ++i) {
    if (!s.model.hard[i]) continue;
    hard.push_back(gamma(i));
    const double length = squares(i) > 0 ? std::sqrt(squares(i)) : 1;
    j.infeasible = std::max(j.infeasible, std::abs(system.value(i)) / length / displacement);
  }
  j.multiplier = Eigen::Map<const Vector>(hard.data(), hard.size());
}

SparseMatrix hard_rows(const RigidModel& model, const SparseMatrix& rows) {
  std::vector<int> position;
  int count = 0;
  for (const bool hard : model.hard) position.push_back(hard ? count++ : -1);
  Triplets entries;
  for (int j = 0; j < rows.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(rows, j); it; ++it)
      if (const int row = position[it.row()]; row >= 0) entries.emplace_back(row, j, it.value());
  return from_triplets(count, rows.cols(), entries);
}

}  // namespace pbd::reference
