#include "rigid_motion.h"

#include <algorithm>
#include <cmath>

#include "dense.h"
#include "error.h"

namespace pbd::reference {
namespace {

/// Velocities of a block's coordinates, those of bodies that keep theirs included.
Vector block_velocity(const Block& block, const State& state) {
  Vector velocity = Vector::Zero(block.jacobian.cols());
  for (const auto& [node, body, offset] : block.parts) {
    velocity.segment<3>(offset) = state.v.col(node);
    if (body >= 0) velocity.segment<3>(offset + 3) = state.spin.col(body);
  }
  return velocity;
}

/// A^-1 c of a compliant block.
RowVector pull(const Block& block) {
  return solve_semidefinite(block.compliance, block.value);
}

/// A block's Jacobian by all unknowns.
Eigen::MatrixXd by_unknowns(const RigidModel& model, const Block& block) {
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(block.rows(), model.unknowns);
  const auto add = [&](int unknown, int offset) {
    if (unknown >= 0) jacobian.middleCols<3>(unknown) += block.jacobian.middleCols<3>(offset);
  };
  for (const auto& [node, body, offset] : block.parts) {
    add(model.nodes.first[node], offset);
    if (body >= 0) add(model.rotors[body].unknown, offset + 3);
  }
  return jacobian;
}

}  // namespace

RigidMotion::RigidMotion(const Scene& scene) : scene_(scene), model_(make_rigid_model(scene)) {
  constexpr double slack = 1e-10;
  const Drift at_start = drift(scene.initial);
  if (at_start.position > slack || at_start.velocity > slack)
    throw SetupError("initial state",
                     "off its hard constraints by " + std::to_string(at_start.position) + " m, " +
                         std::to_string(at_start.velocity) + " m/s",
                     "one that fulfils them and their rates to 1e-10");
}

Vector RigidMotion::start() const {
  const int n = model_.nodes.unknowns;
  int turning = 0;
  for (const Rotor& rotor : model_.rotors) turning += rotor.unknown >= 0;
  Vector y(n + model_.unknowns + 4 * turning);
  y.head(n) = gather(model_.nodes, scene_.initial.x);
  y.segment(n, n) = gather(model_.nodes, scene_.initial.v);
  int at = n + model_.unknowns;
  for (std::size_t b = 0; b < model_.rotors.size(); ++b) {
    const int i = model_.rotors[b].unknown;
    if (i < 0) continue;
    y.segment<3>(n + i) = scene_.initial.spin.col(b);
    const Eigen::Quaterniond& q = scene_.initial.orientation[b];
    y.segment<4>(at) << q.w(), q.vec();
    at += 4;
  }
  return y;
}

State RigidMotion::state(double t, const Vector& y) const {
  const int n = model_.nodes.unknowns;
  State state = scene_.initial;
  state.time += t;
  state.x = scatter(model_.nodes, scene_.initial.x + t * scene_.initial.v, y.head(n));
  state.v = scatter(model_.nodes, scene_.initial.v, y.segment(n, n));
  int at = n + model_.unknowns;
  for (std::size_t b = 0; b < model_.rotors.size(); ++b) {
    const int i = model_.rotors[b].unknown, column = static_cast<int>(b);
    if (i < 0) {
      state.orientation[b] = turned_by(scene_.initial.orientation[b], t * state.spin.col(column));
      continue;
    }
    state.spin.col(column) = y.segment<3>(n + i);
    state.orientation[b] = Eigen::Quaterniond(y(at), y(at + 1), y(at + 2), y(at + 3)).normalized();
    at += 4;
  }
  return state;
}

void RigidMotion::slope(double t, const Vector& y, Vector& slope) const {
  const int n = model_.nodes.unknowns;
  const State now = state(t, y);
  Vector force = Vector::Zero(model_.unknowns);
  force.head(n) = model_.nodes.force;
  for (std::size_t b = 0; b < model_.rotors.size(); ++b) {
    const Rotor& rotor = model_.rotors[b];
    if (rotor.unknown < 0) continue;
    const Vec3 w = now.spin.col(b);
    Vec3 torque = now.orientation[b].conjugate() * rotor.torque;
    if (model_.gyroscopic != GyroscopicTorque::none) torque -= w.cross(rotor.inertia.cwiseProduct(w));
    force.segment<3>(rotor.unknown) = torque;
  }
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(model_.rows(), model_.unknowns);
  Vector wanted = Vector::Zero(model_.rows());
  for (const Block& block : blocks_at(model_, {now.x, now.orientation, now.time}, Coordinates::turns)) {
    const Eigen::MatrixXd own = by_unknowns(model_, block);
    if (!block.hard) {
      force -= own.transpose() * pull(block);
      continue;
    }
    const Vector moving = block_velocity(block, now);
    jacobian.middleRows(block.row, block.rows()) = own;
    for (int k = 0; k < block.rows(); ++k) wanted(block.row + k) = -moving.dot(block.second[k] * moving);
  }
  const Vector root = model_.inertia.cwiseSqrt().cwiseInverse();
  Vector acceleration = root.cwiseProduct(force);
  jacobian *= root.asDiagonal();
  const Vector lengths = jacobian.rowwise().norm().unaryExpr([](double l) { return l > 0 ? l : 1.0; });
  jacobian.array().colwise() /= lengths.array();
  if (model_.rows() > 0) {
    constexpr double dependent = 1e-9;
    const auto [change, rank] =
        least_squares(jacobian, wanted.cwiseQuotient(lengths) - jacobian * acceleration, dependent);
    acceleration += change;
    least_rank_ = std::min(least_rank_, rank);
    most_rank_ = std::max(most_rank_, rank);
  }
  slope.head(n) = y.segment(n, n);
  slope.segment(n, model_.unknowns) = root.cwiseProduct(acceleration);
  int at = n + model_.unknowns;
  for (const Rotor& rotor : model_.rotors) {
    if (rotor.unknown < 0) continue;
    const Vec3 w = y.segment<3>(n + rotor.unknown), v = y.segment<3>(at + 1);
    slope(at) = -v.dot(w) / 2;
    slope.segment<3>(at + 1) = (y(at) * w + v.cross(w)) / 2;
    at += 4;
  }
}

Drift RigidMotion::drift(const State& state) const {
  Vector rates = Vector::Zero(model_.rows());
  for (const Joint& joint : model_.joints) rates(joint.row) -= joint.rate;
  const Vector per_length = model_.radius.cwiseInverse();
  Drift drift;
  for (const Block& block : blocks_at(model_, {state.x, state.orientation, state.time}, Coordinates::turns)) {
    if (!block.hard) continue;
    const Vector velocity =
        block.jacobian * block_velocity(block, state) + rates.segment(block.row, block.rows());
    const Eigen::MatrixXd own = by_unknowns(model_, block) * per_length.asDiagonal();
    for (int k = 0; k < block.rows(); ++k) {
      const double length = own.row(k).norm() > 0 ? own.row(k).norm() : 1;
      drift.position = std::max(drift.position, std::abs(block.value(k)) / length);
      drift.velocity = std::max(drift.velocity, std::abs(velocity(k)) / length);
    }
  }
  return drift;
}

Energy RigidMotion::energy(const State& state) const {
  const Model& nodes = model_.nodes;
  double kinetic = gather(nodes, state.v).cwiseAbs2().dot(nodes.mass) / 2;
  double potential = -nodes.force.dot(gather(nodes, state.x) - gather(nodes, scene_.initial.x));
  for (std::size_t b = 0; b < model_.rotors.size(); ++b)
    if (model_.rotors[b].unknown >= 0) {
      const Vec3 w = state.spin.col(b);
      kinetic += w.dot(model_.rotors[b].inertia.cwiseProduct(w)) / 2;
    }
  for (const Block& block : blocks_at(model_, {state.x, state.orientation, state.time}, Coordinates::turns))
    if (!block.hard) potential += block.value.dot(pull(block)) / 2;
  return {kinetic + potential, kinetic + std::abs(potential)};
}

bool RigidMotion::conservative() const {
  for (int a = 0; a < scene_.nodes(); ++a)
    if (model_.nodes.first[a] < 0 && !scene_.initial.v.col(a).isZero(0)) return false;
  for (std::size_t b = 0; b < model_.rotors.size(); ++b) {
    if (model_.rotors[b].unknown < 0 && !scene_.initial.spin.col(b).isZero(0)) return false;
    if (!model_.rotors[b].torque.isZero(0)) return false;
  }
  return std::all_of(model_.joints.begin(), model_.joints.end(), [](const Joint& j) { return j.rate == 0; });
}

}  // namespace pbd::reference
