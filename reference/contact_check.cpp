#include "contact_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact_slack.h"

namespace pbd::reference {
namespace {

void check_force(const StepClaim& claim, const ClaimedContact& c, const ContactSlack& open,
                 Findings& findings) {
  const std::string name = name_of(c.collider[0], c.collider[1]);
  const double slack = open.impulse / claim.h + step_rounding * c.force.norm();
  const double mu = open.law.friction * (claim.friction == Friction::box ? std::numbers::sqrt2 : 1.0);
  findings.require("contact pulls", name + ", N", -open.normal, slack);
  findings.require("friction", name + ", beyond the cone, N", open.friction.norm() - mu * open.normal,
                   (1 + mu) * slack);
}

/// Between the force and the gap that are told. `slack` is what a gap may be off, m.
void check_spring(const ClaimedContact& c, const ContactSlack& open, double h, double slack,
                  Findings& findings) {
  if (!(open.normal * h > open.impulse)) return;
  findings.require("spring of contact", name_of(c.collider[0], c.collider[1]) + ", m",
                   std::abs(c.gap + open.law.compliance * open.normal),
                   slack + open.law.compliance * open.impulse / h);
}

/// `slack` is what a gap may be off, m.
void check_rebound(const StepClaim& claim, const ClaimedContact& c, const ContactSlack& open,
                   const Sides& sides, double slack, Findings& findings) {
  const int a = c.collider[0], b = c.collider[1];
  const bool damped = open.law.compliance > 0 && open.law.damping > 0;
  if (!is_euler_step(claim) || explicit_forces(claim) || damped || c.met || std::max(a, b) >= sides.count())
    return findings.leave_out(
        "rebound: by this integrator, of what a damper holds, met on the way, on surfaces");
  if (!(open.normal * claim.h > open.impulse)) return;
  const auto parting = [&](const State& state) {
    return c.normal.dot(sides.velocity(c, 0, state) - sides.velocity(c, 1, state));
  };
  const double back = claim.h * open.law.restitution * parting(claim.start);
  if (c.gap <= slack) {
    if (-back > slack) findings.leave_out("rebound: of what approached and ends in touch");
    return;
  }
  const double missed = claim.h * parting(claim.end) + back;
  findings.require("rebound", name_of(a, b) + ", m", std::abs(missed), slack);
}

void check_gap(const StepClaim& claim, const ClaimedContact& c, const ContactSlack& open, const Sides& sides,
               Findings& findings) {
  const auto& [a, b] = c.collider;
  const std::string name = name_of(a, b) + ", m";
  const double size = claim.end.x.cwiseAbs().maxCoeff() + c.point.norm();
  const double slack =
      step_rounding * size + (1 + open.law.friction) * open.velocity * claim.h +
      (claim.friction == Friction::cone ? open.law.friction * open.slip.norm() * claim.h : 0);
  const bool surface = std::max(a, b) >= sides.count();
  double proved = -infinity;
  if (explicit_forces(claim) || c.met) {
    findings.leave_out("gap told: by this integrator, of what met on the way");
  } else if (!surface) {
    proved = separation(sides.placed(a, claim.end), sides.placed(b, claim.end), c.normal);
    findings.require("gap told", name, proved - c.gap, step_rounding * size + open.velocity * claim.h);
  }
  if (claim.friction == Friction::cone && (surface || explicit_forces(claim)))
    return findings.leave_out("open contact: where the convex law opens it by a slip that is not known");
  if (open.law.restitution > 0) return check_rebound(claim, c, open, sides, slack, findings);
  if (open.law.compliance > 0 && open.law.damping == 0 && is_euler_step(claim) && !c.met)
    return check_spring(c, open, claim.h, slack, findings);
  if (open.normal * claim.h > open.impulse)
    findings.require("open contact", name, larger(c.gap, proved), slack);
}

/// m, of a point from the nearest triangle that has not the node, less the triangle's longest side.
double beside_surface(const StepClaim& claim, const Contact& contact, const Vec3& point, int without) {
  double least = infinity;
  Points corners(3, 3);
  for (const auto& nodes : contact.triangle) {
    if (std::find(nodes.begin(), nodes.end(), without) != nodes.end()) continue;
    for (int k = 0; k < 3; ++k) corners.col(k) = claim.end.x.col(nodes[static_cast<std::size_t>(k)]);
    const Vec3 a = corners.col(0), b = corners.col(1), c = corners.col(2);
    const double side =
        std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
    if ((point - a).norm() - 2 * side < least)
      least = std::min(least, distance(Points(point), corners).proved - side);
  }
  return least;
}

/// What a surface is pushed by acts where it is, or beside it by no more than a triangle.
void check_place(const StepClaim& claim, const Contact& contact, const ClaimedContact& c,
                 const ContactSlack& open, const Sides& sides, Findings& findings) {
  if (contact.triangle.empty() || !(open.normal * claim.h > open.impulse)) return;
  const auto node_of = [&](std::size_t k) { return c.collider[k] - sides.count(); };
  const double allowed = contact.thickness + std::abs(c.gap) +
                         step_rounding * (claim.end.x.cwiseAbs().maxCoeff() + c.point.norm());
  for (const std::size_t k : {0, 1})
    if (node_of(k) >= 0)
      findings.require("place of contact", name_of(c.collider[0], c.collider[1]) + ", from its surface, m",
                       beside_surface(claim, contact, c.point, node_of(1 - k)), allowed);
}

/// What met on the way touched where it is said to, as it stood.
void check_meeting(const StepClaim& claim, const ClaimedContact& c, const ContactSlack& open,
                   const Sides& sides, Findings& findings) {
  constexpr double apart = 3e-4;  // of the round radius: what is documented of the search of contacts
  if (!c.met || !(open.normal * claim.h > open.impulse)) return;
  if (std::max(c.collider[0], c.collider[1]) >= sides.count())
    return findings.leave_out("place of meeting: on surfaces");
  const std::array<PlacedShape, 2> shape{sides.placed_as_met(c, 0), sides.placed_as_met(c, 1)};
  double round = infinity;
  for (const std::size_t side : {0, 1})
    if (!sides.is_node(c.collider[side])) round = std::min(round, size_of(*shape[side].shape).round);
  // What begins in each other is pushed between its two points: no farther from either than it is deep.
  const double along = separation(shape[0], shape[1], c.normal), depth = std::isfinite(along) ? -along : 0;
  const double allowed =
      std::max(depth, 0.0) + apart * round + step_rounding * (c.met->arm[0].norm() + c.met->arm[1].norm());
  for (const std::size_t side : {0, 1})
    findings.require("place of meeting", name_of(c.collider[0], c.collider[1]) + ", from a shape, m",
                     distance(shape[side], Vec3(Vec3::Zero())), allowed);
}

void check_sliding(const StepClaim& claim, const ClaimedContact& c, const ContactSlack& open,
                   const Sides& sides, Findings& findings) {
  const double mu = open.law.friction;
  if (!(mu > 0)) return;
  if (explicit_forces(claim) || claim.direction_blend != 1 || claim.friction == Friction::box)
    return findings.leave_out("sliding: by this integrator, blend of directions or law");
  if (std::max(c.collider[0], c.collider[1]) >= sides.count())
    return findings.leave_out("sliding: on surfaces");
  const double speed = open.slip.norm(), h = claim.h;
  const double bound = 2 * mu * (std::abs(open.normal) * h + open.impulse) * open.velocity +
                       (1 + mu) * speed * open.impulse + step_rounding * speed * c.force.norm() * h;
  findings.require("sliding", name_of(c.collider[0], c.collider[1]) + ", J",
                   h * (mu * open.normal * open.slip + speed * open.friction).norm(), bound);
}

}  // namespace

void check_contacts(const StepClaim& claim, const Contact& contact, double level, Findings& findings) {
  const Sides sides(claim, contact);
  for (const ClaimedContact& claimed : claim.contacts) {
    const ContactSlack open = slack_of(claim, claimed, sides, level);
    check_force(claim, claimed, open, findings);
    check_gap(claim, claimed, open, sides, findings);
    check_place(claim, contact, claimed, open, sides, findings);
    check_meeting(claim, claimed, open, sides, findings);
    check_sliding(claim, claimed, open, sides, findings);
  }
}

}  // namespace pbd::reference
