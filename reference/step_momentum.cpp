#include <algorithm>
#include <cmath>

#include "dense.h"
#include "step_rows.h"

namespace pbd::reference {
namespace {

/// g of all unknowns, and the sum of its terms' absolute values.
class Balance {
 public:
  Balance(const StepClaim& claim, const StepModel& model)
      : claim_(claim),
        model_(model),
        rest_(Vector::Zero(model.rigid.unknowns)),
        terms_(Vector::Zero(model.rigid.unknowns)),
        left_out_(static_cast<std::size_t>(model.rigid.unknowns / 3), false) {}

  void add_inertia();
  void add_constraints(const Vector& gamma, Findings& findings);
  void add_contacts(const Contact& contact, Findings& findings);
  void report(double level, Findings& findings) const;

 private:
  void add(int unknown, const Vec3& term) {
    rest_.segment<3>(unknown) += term;
    terms_.segment<3>(unknown) += term.cwiseAbs();
  }
  void leave_out(int unknown) { left_out_[static_cast<std::size_t>(unknown / 3)] = true; }
  void add_rotation(std::size_t b);
  void add_force(int body, int node, const ClaimedContact& contact, std::size_t side);
  void sum_up_surface(const Contact& contact);
  void require_sum(double level, Findings& findings) const;
  std::string name_of(int unknown) const;
  double gyroscopic_factor() const;

  const StepClaim& claim_;
  const StepModel& model_;
  Vector rest_, terms_;
  std::vector<bool> left_out_;  // of each three unknowns
  Vec3 surface_rest_ = Vec3::Zero(), surface_terms_ = Vec3::Zero();
  double surface_mass_ = 0;
};

void Balance::add_inertia() {
  const Model& nodes = model_.rigid.nodes;
  const Vector force = nodes.force;
  for (std::size_t i = 0; i < nodes.first.size(); ++i) {
    const int u = nodes.first[i];
    if (u < 0) continue;
    const auto node = static_cast<Eigen::Index>(i);
    add(u, nodes.mass(u) * claim_.end.v.col(node));
    add(u, -nodes.mass(u) * claim_.start.v.col(node));
    add(u, -claim_.h * force.segment<3>(u));
  }
  for (std::size_t b = 0; b < model_.rigid.rotors.size(); ++b) add_rotation(b);
}

void Balance::add_rotation(std::size_t b) {
  const Rotor& rotor = model_.rigid.rotors[b];
  if (rotor.unknown < 0) return;
  const auto body = static_cast<Eigen::Index>(b);
  const Vec3 before = claim_.start.spin.col(body), after = claim_.end.spin.col(body);
  add(rotor.unknown, rotor.inertia.cwiseProduct(after));
  add(rotor.unknown, -rotor.inertia.cwiseProduct(before));
  add(rotor.unknown, -claim_.h * (claim_.start.orientation[b].conjugate() * rotor.torque));
  const GyroscopicTorque torque = model_.rigid.gyroscopic;
  if (torque == GyroscopicTorque::none) return;
  const bool at_end = torque == GyroscopicTorque::at_end && !explicit_forces(claim_);
  const Vec3 w = at_end ? after : before;
  add(rotor.unknown, claim_.h * w.cross(rotor.inertia.cwiseProduct(w)));
}

void Balance::add_constraints(const Vector& gamma, Findings& findings) {
  const Placement at = placement_of(explicit_forces(claim_) ? claim_.start : claim_.end);
  each_block(model_.rigid, at, [&](const Block& block) {
    const auto row = static_cast<std::size_t>(block.row);
    RowVector own = gamma.segment(block.row, block.rows());
    const bool no_row = explicit_forces(claim_) && !block.hard && own.hasNaN();
    if (no_row) own = -solve(Eigen::MatrixXd(block.compliance), Vector(block.value));
    if (no_row && block.rows() == 1)
      own[0] = std::clamp(own[0], model_.bounds[row][0], model_.bounds[row][1]);
    const double size = at.x.cwiseAbs().maxCoeff();
    const double rounded =
        no_row ? solve(Eigen::MatrixXd(block.compliance), Vector(Vector::Constant(block.rows(), size))).norm()
               : 0;
    const bool jumps = no_row && at_jump(model_, block, block.value[0], size);
    const bool damps = model_.own_frame[row] || (no_row && model_.damped[row]);
    const bool unknown_force = jumps || damps;
    if (jumps) findings.leave_out("momentum: what an angle at its jump acts on");
    if (damps) findings.leave_out("momentum: what a damped joint acts on");
    each_moving(model_.rigid, block, [&](int unknown, int offset) {
      if (unknown_force) leave_out(unknown);
      const auto columns = block.jacobian.middleCols<3>(offset);
      add(unknown, -claim_.h * (columns.transpose() * own));
      // Rounded positions turn the directions of a length by their size over it, change a lever, and the
      // value that a compliant constraint's force is computed of.
      terms_.segment<3>(unknown).array() +=
          claim_.h * columns.norm() * (own.norm() * (1 + size * columns.norm()) + rounded);
    });
  });
}

void Balance::add_force(int body, int node, const ClaimedContact& contact, std::size_t side) {
  const Vec3 force = side == 0 ? contact.force : Vec3(-contact.force);
  const int u = model_.rigid.nodes.first[static_cast<std::size_t>(node)];
  if (u >= 0) add(u, -claim_.h * force);
  if (body < 0) return;
  const auto b = static_cast<std::size_t>(body);
  const int turn = model_.rigid.rotors[b].unknown;
  if (turn < 0) return;
  if (explicit_forces(claim_)) leave_out(turn);
  const Vec3 lever = contact.met ? contact.met->arm[side] : Vec3(contact.point - claim_.end.x.col(node));
  const Eigen::Matrix3d rotation =
      contact.met ? contact.met->rotation[side] : claim_.end.orientation[b].toRotationMatrix();
  add(turn, -claim_.h * (rotation.transpose() * lever.cross(force)));
  terms_.segment<3>(turn).array() += claim_.h * force.norm() * (contact.point.norm() + lever.norm());
}

/// Nodes of surfaces that are pressed count by their sum alone, if all of them count.
void Balance::sum_up_surface(const Contact& contact) {
  for (const auto& triangle : contact.triangle)
    for (const int node : triangle)
      if (const int u = model_.rigid.nodes.first[static_cast<std::size_t>(node)];
          u >= 0 && left_out_[static_cast<std::size_t>(u / 3)])
        surface_mass_ = infinity;
  for (const auto& triangle : contact.triangle)
    for (const int node : triangle) {
      const int u = model_.rigid.nodes.first[static_cast<std::size_t>(node)];
      if (u < 0) {
        surface_mass_ = infinity;
      } else if (!left_out_[static_cast<std::size_t>(u / 3)]) {
        leave_out(u);
        surface_rest_ += rest_.segment<3>(u);
        surface_terms_ += terms_.segment<3>(u);
        surface_mass_ += model_.rigid.nodes.mass(u);
      }
    }
}

void Balance::add_contacts(const Contact& contact, Findings& findings) {
  const auto colliders = static_cast<int>(contact.collider.size());
  const int nodes = colliders + static_cast<int>(contact.node.size());
  bool surface = false;
  for (const ClaimedContact& claimed : claim_.contacts)
    for (const std::size_t side : {0, 1}) {
      const int k = claimed.collider[side];
      const Vec3 force = side == 0 ? claimed.force : Vec3(-claimed.force);
      if (k >= nodes) {
        surface = surface || !force.isZero(0);
        surface_rest_ -= claim_.h * force;  // of two sides on surfaces they cancel
        surface_terms_ += claim_.h * force.cwiseAbs();
        continue;
      }
      const int body = k < colliders ? contact.collider[static_cast<std::size_t>(k)].body : -1;
      const int node = body < 0 ? contact.node[static_cast<std::size_t>(k - colliders)]
                                : model_.rigid.rotors[static_cast<std::size_t>(body)].node;
      add_force(body, node, claimed, side);
    }
  if (!surface) return;
  sum_up_surface(contact);
  findings.leave_out("momentum: single nodes of surfaces in contact");
}

std::string Balance::name_of(int unknown) const {
  for (std::size_t b = 0; b < model_.rigid.rotors.size(); ++b)
    if (model_.rigid.rotors[b].unknown == unknown ||
        model_.rigid.nodes.first[static_cast<std::size_t>(model_.rigid.rotors[b].node)] == unknown)
      return "body " + std::to_string(b);
  const auto& first = model_.rigid.nodes.first;
  return "node " + std::to_string(std::find(first.begin(), first.end(), unknown) - first.begin());
}

/// A solver that misses v by e of what its forces make of it, the implicit gyroscopic torque of that
/// included, misses g by e - h dG e, G = I^-1/2 w x I w by I^1/2 w: at most the largest 1 + h |dG| times as
/// much.
double Balance::gyroscopic_factor() const {
  double largest = 0;
  if (model_.rigid.gyroscopic == GyroscopicTorque::at_end && !explicit_forces(claim_))
    for (std::size_t b = 0; b < model_.rigid.rotors.size(); ++b) {
      const Rotor& rotor = model_.rigid.rotors[b];
      if (rotor.unknown < 0) continue;
      const Vec3 w = claim_.end.spin.col(int(b)), weight = rotor.inertia.cwiseSqrt().cwiseInverse();
      const Eigen::Matrix3d slope =
          cross_matrix(w) * rotor.inertia.asDiagonal() - cross_matrix(rotor.inertia.cwiseProduct(w));
      largest = std::max(largest, (weight.asDiagonal() * slope * weight.asDiagonal()).norm());
    }
  return 1 + claim_.h * largest;
}

void Balance::require_sum(double level, Findings& findings) const {
  if (!(surface_mass_ > 0)) return;
  if (std::isinf(surface_mass_))
    return findings.leave_out("momentum: surfaces in contact that are held or known in part");
  const double root = std::sqrt(surface_mass_);  // |sum g|^2 <= sum m sum |g|^2/m
  findings.require("momentum", "nodes of surfaces", surface_rest_.norm() / root,
                   level + step_rounding * surface_terms_.norm() / root);
}

void Balance::report(double level, Findings& findings) const {
  const int nodes = model_.rigid.nodes.unknowns;
  for (const bool turns : {false, true}) {
    double squared = 0, terms = 0, most = -1;
    int worst = -1;
    for (int u = turns ? nodes : 0; u < (turns ? model_.rigid.unknowns : nodes); u += 3) {
      if (left_out_[static_cast<std::size_t>(u / 3)]) continue;
      const Vec3 weight = model_.rigid.inertia.segment<3>(u).cwiseInverse();
      const double own = rest_.segment<3>(u).cwiseAbs2().dot(weight);
      squared += own;
      terms += terms_.segment<3>(u).cwiseAbs2().dot(weight);
      if (own <= most) continue;
      most = own;
      worst = u;
    }
    if (worst < 0) continue;
    findings.require(turns ? "angular momentum" : "momentum", "most of it of " + name_of(worst),
                     std::sqrt(squared),
                     (turns ? gyroscopic_factor() : 1) * level + step_rounding * std::sqrt(terms));
  }
  require_sum(level, findings);
}

}  // namespace

void check_momentum(const StepClaim& claim, const StepModel& model, double level, Findings& findings) {
  Vector gamma;
  if (!gather_forces(claim, model.rigid, gamma))
    return findings.require("momentum", "forces told, of all rows", static_cast<double>(gamma.size()),
                            std::nan(""));
  Balance balance(claim, model);
  balance.add_inertia();
  balance.add_constraints(gamma, findings);
  for (const Effect& effect : claim.scene.effects)
    if (const auto* contact = std::get_if<Contact>(&effect)) balance.add_contacts(*contact, findings);
  balance.report(level, findings);
}

}  // namespace pbd::reference
