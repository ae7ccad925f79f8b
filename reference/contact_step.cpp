#include "contact_step.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "damping.h"
#include "step_rows.h"

namespace pbd::reference {
namespace {

Contact contact_of(const Scene& scene) {
  for (const Effect& effect : scene.effects)
    if (const auto* contact = std::get_if<Contact>(&effect)) return *contact;
  return {};
}

/// The start with velocities that lead along `way` (m or rad, per unknown) within h; `held` those of nodes
/// that no force moves, m/s.
State led(const RigidStep& step, const Vector& way, const Points& held) {
  State state = step.start;
  const Vector velocity = way / step.h;
  state.v = scatter(step.model.nodes, held, velocity.head(step.model.nodes.unknowns));
  for (std::size_t b = 0; b < step.model.rotors.size(); ++b)
    if (const int i = step.model.rotors[b].unknown; i >= 0)
      state.spin.col(static_cast<Eigen::Index>(b)) = velocity.segment<3>(i);
  return state;
}

}  // namespace

ContactStep::ContactStep(const Scene& scene, const State& state, double h,
                         const std::optional<IntegratorMap>& map)
    : ContactStep(make_step_model(scene), scene, state, h, map) {}

ContactStep::ContactStep(StepModel stated, const Scene& scene, const State& state, double h,
                         const std::optional<IntegratorMap>& map)
    : step{std::move(stated.rigid), state, h, {}, map}, contact(contact_of(scene)), search(scene, contact) {
  start_ = placement_of(state);
  for (int row = 0; row < step.model.rows(); ++row) {
    const auto& bounds = stated.bounds[static_cast<std::size_t>(row)];
    if (bounds == std::array{-infinity, infinity}) continue;
    bounded.push_back({row, bounds});
    step.model.hard[static_cast<std::size_t>(row)] = false;
  }
  step.damping = damping_of(scene, step);
  Vector load = system_at(step, step.start_velocity(), Vector::Zero(step.model.rows())).load;
  // The free motion is without what only its end tells.
  if (step.model.gyroscopic == GyroscopicTorque::at_end)
    for (std::size_t b = 0; b < step.model.rotors.size(); ++b)
      if (const Rotor& rotor = step.model.rotors[b]; rotor.unknown >= 0) {
        const Vec3 spin = state.spin.col(static_cast<Eigen::Index>(b));
        load.segment<3>(rotor.unknown) -= spin.cross(rotor.inertia.cwiseProduct(spin));
      }
  const Points start_velocities = state.v;
  const Vector free = step.start_velocity() - step.s() * load.cwiseQuotient(step.model.inertia);
  free_end_ = step.placement(free);
  free_ = led(step, step.shift() + step.d() * free, start_velocities);
  shifted_ = led(step, step.shift(), (1 - step.d() / h) * start_velocities);
}

/// A share of the way of the free motion.
Placement ContactStep::freely(double share) const {
  Placement at = start_;
  at.x += share * (free_end_.x - start_.x);
  for (std::size_t b = 0; b < at.orientation.size(); ++b)
    at.orientation[b] = start_.orientation[b].slerp(share, free_end_.orientation[b]);
  return at;
}

/// Whether a pair's gap vanishes on the way of the free motion, and the pair touches by its features there.
/// By its rates it does; of a face with a body it must on its way, in one of sixteen parts of what is left.
bool ContactStep::meets_freely(const FeaturePair& pair, double gap, double ahead) const {
  constexpr double parts = 16, accuracy = 1e-6;  // of a part
  const double rated = gap > 0 ? gap / (gap - ahead) : 0, part = (1 - rated) / parts;
  const bool on_plane = pair.b.count == 3 && (pair.a.of_body() || pair.b.of_body());
  if (!on_plane) return search.on_both(pair, freely(rated));
  double share = rated;
  for (int k = 1; k <= parts && nearest(pair, freely(share)).gap > 0; ++k) share = rated + k * part;
  if (nearest(pair, freely(share)).gap > 0) return false;
  if (share > rated)  // it vanished within the last part
    for (double width = part / 2; width > accuracy * part; width /= 2)
      if (nearest(pair, freely(share - width)).gap <= 0) share -= width;
  return search.on_both(pair, freely(share));
}

JudgedContact ContactStep::begun(const FeaturePair& pair) const {
  JudgedContact made{.pair = pair,
                     .law = contact.between(static_cast<std::size_t>(pair.surface[0]),
                                            static_cast<std::size_t>(pair.surface[1]))};
  const Nearest found = nearest(pair, start_);
  Eigen::Index least = 0;
  found.normal.cwiseAbs().minCoeff(&least);
  made.reference = Vec3::Unit(least);
  const auto along = [&](const State& state) {
    return found.normal.dot(against(pair, found, start_, state));
  };
  const double h = step.h, d = step.d();
  const double from = step.map ? found.gap + h * along(shifted_) : found.gap;
  const bool yields = made.law.compliance > 0, loaded = yields && found.gap < 0;
  made.target = yields ? 0.0 : std::min(0.0, std::max(found.gap, from + contact.recovery * d));
  constexpr double parted = 0.1;  // a step, of the thickness
  if (!yields && pair.a.deformable && pair.b.deformable)
    made.target = std::min(made.target, found.gap + parted * contact.thickness);
  made.bounce = loaded ? 0.0 : made.law.restitution;
  made.closing = -along(step.start);
  const double ahead = found.gap + h * along(free_);
  made.collides = made.bounce > 0 && made.closing > 0 && ahead < 0 && meets_freely(pair, found.gap, ahead);
  made.rebound =
      made.closing > 0 ? std::min(made.target, from + d * made.bounce * made.closing) : made.target;
  const double elastic = 1 / (1 + made.law.damping / d);  // the spring's share
  const double offset = (1 - elastic) * (std::min(from, 0.0) - made.target);
  made.target += offset;
  made.rebound += offset;
  made.compliance = elastic * made.law.compliance;
  return made;
}

bool ContactStep::can_move(const ContactFeature& feature) const {
  const auto corners = std::span(feature.corner).first(static_cast<std::size_t>(feature.count));
  return std::any_of(corners.begin(), corners.end(), [&](const Corner& corner) {
    return step.model.nodes.first[static_cast<std::size_t>(corner.node)] >= 0 ||
           (corner.body >= 0 && step.model.rotors[static_cast<std::size_t>(corner.body)].unknown >= 0);
  });
}

void ContactStep::find_contacts(const Vector& velocity, bool also_start) {
  std::vector<FeaturePair> found;
  const Placement end = step.placement(velocity);
  const Points course = step.h * step.start.v;
  search.find(start_, end, course, deep, found);
  if (also_start) search.find(end, start_, course, {}, found);
  for (const JudgedContact& own : contacts)
    if (own.collides) found.push_back(own.pair);  // by now it may have left
  std::erase_if(found, [&](const FeaturePair& pair) { return !can_move(pair.a) && !can_move(pair.b); });
  const auto by_name = [](const FeaturePair& one, const FeaturePair& two) { return one.name < two.name; };
  std::stable_sort(found.begin(), found.end(), by_name);
  found.erase(
      std::unique(found.begin(), found.end(),
                  [](const FeaturePair& one, const FeaturePair& two) { return one.name == two.name; }),
      found.end());
  std::vector<JudgedContact> before;
  before.swap(contacts);
  auto known = before.begin();
  for (const FeaturePair& pair : found) {
    while (known != before.end() && known->pair.name < pair.name) ++known;
    contacts.push_back(known != before.end() && known->pair.name == pair.name ? *known : begun(pair));
  }
}

void ContactStep::take_forces(const std::vector<ClaimedContact>& claimed, const Vector& velocity) {
  const Placement at = step.placement(velocity);
  const auto side_of = [&, count = static_cast<int>(contact.collider.size() + contact.node.size())](int k) {
    return k < count ? k : search.side_at(k - count);
  };
  for (const ClaimedContact& claim : claimed) {
    const std::array<int, 2> sides{side_of(claim.collider[0]), side_of(claim.collider[1])};
    JudgedContact* taker = nullptr;
    Nearest taken;
    for (JudgedContact& own : contacts) {
      const auto& [a, b] = own.pair.surface;
      if (sides != std::array{a, b} && sides != std::array{b, a}) continue;
      const Nearest found = nearest(own.pair, at);
      if (taker != nullptr && (found.place - claim.point).norm() >= (taken.place - claim.point).norm())
        continue;
      taker = &own;
      taken = found;
    }
    if (taker == nullptr) continue;
    const double sign = taken.normal.dot(claim.normal) < 0 ? -1 : 1;
    taker->force += sign * step.h / step.s() * (directions_of(taken.normal, taker->reference) * claim.force);
  }
}

bool ContactStep::collide(const Vector& velocity) {
  constexpr double touching = 1e-6;  // of the speed at the start
  const ContactPose pose = pose_at(velocity);
  bool any = false;
  for (JudgedContact& own : contacts) {
    if (own.collides || !(own.bounce > 0) || !(own.closing > 0)) continue;
    const ContactRow row = row_of(own, pose);
    const double slack = touching * own.closing;
    if (row.seen[0] + compliance_of(own) * own.force[0] / step.d() > slack) continue;
    if (row.normal_velocity < own.bounce * own.closing - slack) own.collides = any = true;
  }
  return any;
}

}  // namespace pbd::reference
