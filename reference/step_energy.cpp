#include "step_energy.h"

#include <algorithm>
#include <cmath>

#include "contact_slack.h"
#include "dense.h"
#include "step_rows.h"

namespace pbd::reference {
namespace {

/// Velocities of all unknowns, of rotations in the body's axes.
Vector velocities(const RigidModel& model, const State& state) {
  Vector v = Vector::Zero(model.unknowns);
  for (std::size_t i = 0; i < model.nodes.first.size(); ++i)
    if (const int u = model.nodes.first[i]; u >= 0)
      v.segment<3>(u) = state.v.col(static_cast<Eigen::Index>(i));
  for (std::size_t b = 0; b < model.rotors.size(); ++b)
    if (const int u = model.rotors[b].unknown; u >= 0)
      v.segment<3>(u) = state.spin.col(static_cast<Eigen::Index>(b));
  return v;
}

class Energy {
 public:
  Energy(const StepClaim& claim, const StepModel& model, double level)
      : claim_(claim),
        model_(model.rigid),
        bounds_(model.bounds),
        own_frame_(model.own_frame),
        damped_(model.damped),
        v0_(velocities(model.rigid, claim.start)),
        v1_(velocities(model.rigid, claim.end)),
        level_(level) {}

  void add_inertia();
  void add_constraints(const Vector& gamma);
  /// False where the energy cannot be told.
  bool add_contacts(const Contact& contact);
  void report(Findings& findings) const;

  /// A collision's force acts along the mean of the velocities that it changes; every other term along that
  /// of the end, so that what it takes back of the difference is to be allowed.
  bool collides = false;

 private:
  void gain(double energy) {
    gained_ += energy;
    terms_ += std::abs(energy);
  }
  void allow(double energy) { allowed_ += std::max(energy, 0.0); }
  void add_given(const Vector& force);
  void add_block(const Block& block, const RowVector& before, const RowVector& own);
  double rounded_turns(const ClaimedContact& c, std::size_t side, const Sides& sides) const;
  void add_contact(const ClaimedContact& c, const Sides& sides);

  const StepClaim& claim_;
  const RigidModel& model_;
  const std::vector<std::array<double, 2>>& bounds_;
  const std::vector<bool>&own_frame_, &damped_;
  Vector v0_, v1_;
  double level_ = 0, gained_ = 0, terms_ = 0, allowed_ = 0;  // sqrt(J), J
};

/// Of forces (N, N m) that are given: their work is no gain.
void Energy::add_given(const Vector& force) {
  gain(-claim_.h * force.dot(v1_));
  if (collides) allow(-claim_.h * force.dot(v1_ - v0_) / 2);
}

void Energy::add_inertia() {
  gain(model_.inertia.dot(v1_.cwiseAbs2()) / 2);
  gain(-model_.inertia.dot(v0_.cwiseAbs2()) / 2);
  Vector force = Vector::Zero(model_.unknowns);
  force.head(model_.nodes.unknowns) = model_.nodes.force;
  for (std::size_t b = 0; b < model_.rotors.size(); ++b) {
    const Rotor& rotor = model_.rotors[b];
    if (rotor.unknown < 0) continue;
    force.segment<3>(rotor.unknown) = claim_.start.orientation[b].conjugate() * rotor.torque;
    if (model_.gyroscopic == GyroscopicTorque::none) continue;
    const bool at_end = model_.gyroscopic == GyroscopicTorque::at_end;
    const Vec3 w = (at_end ? v1_ : v0_).segment<3>(rotor.unknown);
    force.segment<3>(rotor.unknown) -= w.cross(rotor.inertia.cwiseProduct(w));
  }
  add_given(force);
}

/// `before` is the constraint's value where the step begins, `own` its force.
void Energy::add_block(const Block& block, const RowVector& before, const RowVector& own) {
  RowVector moved = RowVector::Zero(block.rows()), changed = moved;
  double turned = 0;  // rad, of what the constraint acts on
  each_moving(model_, block, [&](int unknown, int offset) {
    const auto columns = block.jacobian.middleCols<3>(offset);
    moved += claim_.h * (columns * v1_.segment<3>(unknown));
    changed += claim_.h * (columns * (v1_ - v0_).segment<3>(unknown));
    if (unknown >= model_.nodes.unknowns) turned += claim_.h * v1_.segment<3>(unknown).norm();
  });
  // In a body's axes, which are not told, the force may point anywhere.
  const bool turned_axes = own_frame_[static_cast<std::size_t>(block.row)];
  const auto work = [&](const RowVector& way) {
    return turned_axes ? own.norm() * way.norm() : own.dot(way);
  };
  if (collides) allow(work(-changed) / 2);
  const bool bounded = bounds_[static_cast<std::size_t>(block.row)] != std::array{-infinity, infinity};
  if (block.hard) {
    allow(work(moved));
    terms_ += own.norm() * moved.norm();
    return;
  }
  const Eigen::MatrixXd compliance = block.compliance;
  const RowVector pull = solve(compliance, Vector(block.value)), pulled = solve(compliance, Vector(before));
  const double stored = pull.dot(block.value) / 2, stored_before = pulled.dot(before) / 2;
  gain(stored);
  gain(-stored_before);
  if (bounded) return allow(stored - stored_before + work(moved));
  allow(stored - stored_before - pull.dot(moved));
  if (!damped_[static_cast<std::size_t>(block.row)]) {
    const Vector pulled_along = solve(compliance, Vector(moved));
    allow(level_ * std::sqrt(pulled_along.dot(metric_of(model_, block, claim_.h) * pulled_along)));
  }
  const double curved = (block.value - before - moved).norm() + (turned_axes ? turned * before.norm() : 0.0);
  allow((turned_axes ? own.norm() + pull.norm() : (own + pull).norm()) * curved);
}

void Energy::add_constraints(const Vector& gamma) {
  const Vector before = values_at(model_, placement_of(claim_.start));
  each_block(model_, placement_of(claim_.end), [&](const Block& block) {
    add_block(block, before.segment(block.row, block.rows()), gamma.segment(block.row, block.rows()));
  });
}

/// What a turn's arc differs from its tangent, m; what met on the way goes on along the tangent.
double Energy::rounded_turns(const ClaimedContact& c, std::size_t side, const Sides& sides) const {
  const Side own = sides.side(c.collider[side]);
  if (own.body < 0 || c.met) return 0;
  const double turn = claim_.h * claim_.end.spin.col(own.body).norm();
  return turn * turn * sides.lever(c, side) / 2;
}

void Energy::add_contact(const ClaimedContact& c, const Sides& sides) {
  const auto& [a, b] = c.collider;
  const double h = claim_.h;
  const ContactSlack open = slack_of(claim_, c, sides, level_);
  const auto against = [&](const State& state) -> Vec3 {
    return sides.velocity(c, 0, state) - sides.velocity(c, 1, state);
  };
  const Vec3 start = against(claim_.start);
  const double slip = open.slip.norm(), friction = h * open.friction.dot(open.slip);
  for (const std::size_t side : {0, 1})
    if (sides.inverse_mass(c.collider[side], 1) == 0)  // is led
      allow((side == 0 ? -1 : 1) * h * c.force.dot(sides.velocity(c, side, claim_.end)));
  allow(-h * open.friction.dot(open.conveyed));
  terms_ += h * c.force.norm() * (slip + start.norm());
  allow(2 * open.law.friction * (std::abs(open.normal) * h + open.impulse) * open.velocity +
        (1 + open.law.friction) * slip * open.impulse);
  const double overlap =
      std::max(0.0, -separation(sides.placed(a, claim_.start), sides.placed(b, claim_.start), c.normal));
  const double curved = rounded_turns(c, 0, sides) + rounded_turns(c, 1, sides);
  const bool may_collide = open.law.restitution > 0 && c.normal.dot(start) < 0;
  const double opened = may_collide ? 0 : c.gap;
  allow(std::max(open.normal, 0.0) * (opened + overlap + curved + h * open.velocity));
  if (may_collide) {
    // By the convex law the normal velocity gives back what friction takes along the end's slip.
    const double taken = claim_.friction == Friction::cone ? 0 : friction;
    allow((taken + h * open.friction.dot(start)) / 2);
  } else if (collides) {
    allow(h * c.force.dot(start - against(claim_.end)) / 2);
  }
}

bool Energy::add_contacts(const Contact& contact) {
  const Sides sides(claim_, contact);
  for (const ClaimedContact& claimed : claim_.contacts) {
    if (claimed.force.isZero(0)) continue;
    if (std::max(claimed.collider[0], claimed.collider[1]) >= sides.count()) return false;
    add_contact(claimed, sides);
  }
  return true;
}

void Energy::report(Findings& findings) const {
  const double speed = std::sqrt(model_.inertia.dot(v1_.cwiseAbs2()));
  findings.require("energy", "gained beyond what forces bring, J", gained_,
                   allowed_ + speed * level_ + step_rounding * terms_);
}

bool any_collides(const StepClaim& claim, const Contact& contact) {
  const Sides sides(claim, contact);
  return std::any_of(claim.contacts.begin(), claim.contacts.end(), [&](const ClaimedContact& c) {
    return c.force.dot(c.normal) > 0 && sides.law(c.collider[0], c.collider[1]).restitution > 0;
  });
}

}  // namespace

void check_energy(const StepClaim& claim, const StepModel& model, double level, Findings& findings) {
  Vector gamma;
  if (!gather_forces(claim, model.rigid, gamma)) return;  // told by check_momentum
  Energy energy(claim, model, level);
  for (const Effect& effect : claim.scene.effects)
    if (const auto* contact = std::get_if<Contact>(&effect))
      energy.collides = energy.collides || any_collides(claim, *contact);
  energy.add_inertia();
  energy.add_constraints(gamma);
  for (const Effect& effect : claim.scene.effects)
    if (const auto* contact = std::get_if<Contact>(&effect);
        contact != nullptr && !energy.add_contacts(*contact))
      return findings.leave_out("energy: surfaces in contact");
  energy.report(findings);
}

}  // namespace pbd::reference
