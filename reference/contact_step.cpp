#include "contact_step.h"

#include <algorithm>
#include <cmath>

#include "damping.h"
#include "dense.h"
#include "error.h"
#include "step_equations.h"
#include "step_rows.h"

namespace pbd::reference {
namespace {

Contact contact_of(const Scene& scene) {
  for (const Effect& effect : scene.effects)
    if (const auto* contact = std::get_if<Contact>(&effect)) return *contact;
  return {};
}

Vec3 velocity_of(const Corner& corner, const Placement& at, const State& state, const Vec3& place) {
  Vec3 v = state.v.col(corner.node);
  if (corner.body < 0) return v;
  const Vec3 w = at.orientation[static_cast<std::size_t>(corner.body)] * Vec3(state.spin.col(corner.body));
  return v + w.cross(place - at.x.col(corner.node));
}

/// Of a feature, where a force acts on it, m/s.
Vec3 velocity_of(const ContactFeature& feature, const std::array<double, 3>& weight, const Placement& at,
                 const State& state, const Vec3& place) {
  if (feature.of_body()) return velocity_of(feature.corner[0], at, state, place);
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < static_cast<std::size_t>(feature.count); ++k)
    sum += weight[k] * velocity_of(feature.corner[k], at, state, place);
  return sum;
}

Eigen::Matrix3d directions_of(const Vec3& normal, const Vec3& reference) {
  Eigen::Matrix3d directions;
  const Vec3 tangent = (reference - normal.dot(reference) * normal).normalized();
  directions << normal.transpose(), tangent.transpose(), normal.cross(tangent).transpose();
  return directions;
}

/// C of a feature's carriers.
void add_parts(const RigidModel& model, const ContactFeature& feature, const std::array<double, 3>& weight,
               const Placement& at, const Vec3& place, const Eigen::Matrix3d& directions,
               std::vector<std::pair<int, Eigen::Matrix3d>>& parts) {
  const auto first = [&](const Corner& corner) {
    return model.nodes.first[static_cast<std::size_t>(corner.node)];
  };
  if (!feature.of_body()) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(feature.count); ++k)
      if (const int i = first(feature.corner[k]); i >= 0) parts.emplace_back(i, weight[k] * directions);
    return;
  }
  const Corner& corner = feature.corner[0];
  if (const int i = first(corner); i >= 0) parts.emplace_back(i, directions);
  const auto body = static_cast<std::size_t>(corner.body);
  const int turn = model.rotors[body].unknown;
  if (turn < 0) return;
  const Eigen::Matrix3d rotation = at.orientation[body].toRotationMatrix();
  const Vec3 local = rotation.transpose() * (place - at.x.col(corner.node));
  parts.emplace_back(turn, -directions * rotation * cross_matrix(local));
}

/// The unknowns' places, each of which a test may move.
struct Moving {
  const RigidModel& model;
  std::vector<int> node, body;  // by three unknowns: the node or the body, else -1

  explicit Moving(const RigidModel& own)
      : model(own), node(own.unknowns / 3, -1), body(own.unknowns / 3, -1) {
    for (std::size_t i = 0; i < own.nodes.first.size(); ++i)
      if (const int u = own.nodes.first[i]; u >= 0)
        node[static_cast<std::size_t>(u / 3)] = static_cast<int>(i);
    for (std::size_t b = 0; b < own.rotors.size(); ++b)
      if (const int u = own.rotors[b].unknown; u >= 0)
        body[static_cast<std::size_t>(u / 3)] = static_cast<int>(b);
  }

  void move(int unknown, double change, Placement& at) const {
    const auto three = static_cast<std::size_t>(unknown / 3);
    const Vec3 step = change * Vec3::Unit(unknown % 3);
    if (node[three] >= 0) {
      at.x.col(node[three]) += step;
    } else {
      auto& orientation = at.orientation[static_cast<std::size_t>(body[three])];
      orientation = turned_by(orientation, step);
    }
  }
};

}  // namespace

ContactStep::ContactStep(const Scene& scene, const State& state, double h)
    : step{make_step_model(scene).rigid, state, h}, contact(contact_of(scene)), search(scene, contact) {
  start_ = placement_of(state);
  for (const Effect& effect : scene.effects)
    std::visit(
        []<class E>(const E& own) {
          if constexpr (requires { own.bounds; })
            if (!own.bounds.empty())
              throw SetupError(own.name, "limits or motors of limited force",
                               "equations: the judge of contact knows no other bounds of forces");
        },
        effect);
  step.damping = damping_of(scene, step.model, start_, h);
  free_ = state;
  const RigidSystem system = system_at(step, step.start_velocity(), Vector::Zero(step.model.rows()));
  const Vector free = step.start_velocity() - h * system.load.cwiseQuotient(step.model.inertia);
  const State end = step.end(free);
  free_.v = end.v;
  free_.spin = end.spin;
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
    return found.normal.dot(velocity_of(pair.a, found.weight[0], start_, state, found.place) -
                            velocity_of(pair.b, found.weight[1], start_, state, found.place));
  };
  const double h = step.h;
  made.target = std::min(0.0, found.gap + contact.recovery * h);
  made.closing = -along(step.start);
  made.collides = made.law.restitution > 0 && made.closing > 0 && found.gap + h * along(free_) < 0;
  made.rebound = made.closing > 0 ? std::min(made.target, found.gap + h * made.law.restitution * made.closing)
                                  : made.target;
  const double elastic = 1 / (1 + made.law.damping / h);  // the spring's share
  const double offset = (1 - elastic) * (std::min(found.gap, 0.0) - made.target);
  made.target += offset;
  made.rebound += offset;
  made.compliance = elastic * made.law.compliance;
  return made;
}

void ContactStep::find_contacts(const Vector& velocity, bool also_start) {
  std::vector<FeaturePair> found;
  const Placement end = step.placement(velocity);
  search.find(start_, end, found);
  if (also_start) search.find(end, start_, found);
  for (const JudgedContact& own : contacts)
    if (own.collides) found.push_back(own.pair);  // by now it may have left
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
  const auto surface = static_cast<int>(contact.collider.size() + contact.node.size());
  for (const ClaimedContact& claim : claimed) {
    const std::array<int, 2> sides{std::min(claim.collider[0], surface),
                                   std::min(claim.collider[1], surface)};
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
    taker->force += sign * (directions_of(taken.normal, taker->reference) * claim.force);
  }
}

ContactStep::LeastGaps ContactStep::least_gaps(const Placement& at) const {
  LeastGaps least;
  for (const JudgedContact& own : contacts) {
    double& gap = least.try_emplace(own.pair.surface, infinity).first->second;
    gap = std::min(gap, nearest(own.pair, at).gap);
  }
  return least;
}

ContactRow ContactStep::row_of(const JudgedContact& own, const Placement& at, const State& end,
                               const LeastGaps& least) const {
  ContactRow row;
  row.found = nearest(own.pair, at);
  const bool on_face = own.pair.b.count == 3 && !own.pair.a.deformable && !own.pair.b.deformable;
  if (on_face) row.found.place += (least.at(own.pair.surface) - row.found.gap) * row.found.normal;
  const Eigen::Matrix3d directions = directions_of(row.found.normal, own.reference);
  for (const auto& [feature, weight, sign] : {std::tuple{&own.pair.a, &row.found.weight[0], 1.0},
                                              std::tuple{&own.pair.b, &row.found.weight[1], -1.0}})
    add_parts(step.model, *feature, *weight, at, row.found.place, sign * directions, row.parts);
  const auto against = [&](const State& state) {
    return Vec3(velocity_of(own.pair.a, row.found.weight[0], at, state, row.found.place) -
                velocity_of(own.pair.b, row.found.weight[1], at, state, row.found.place));
  };
  row.velocity = directions * against(end);
  row.seen = row.velocity;
  const double apart = (row.found.gap - (own.collides ? own.rebound : own.target)) / step.h;
  if (own.collides) {
    State before = step.start;
    for (Eigen::Index b = 0; b < before.spin.cols(); ++b)
      before.spin.col(b) = solve(Eigen::MatrixXd(inverse_right_jacobian(step.h * end.spin.col(b))),
                                 Vector(before.spin.col(b)));
    const double bounced = row.velocity[0] + own.law.restitution * row.found.normal.dot(against(before));
    row.seen[0] = std::min(bounced, apart);
  } else {
    row.seen[0] = apart;
  }
  return row;
}

bool ContactStep::collide(const Vector& velocity) {
  constexpr double touching = 1e-6;  // of the speed at the start
  const State end = step.end(velocity);
  const Placement at = placement_of(end);
  const LeastGaps least = least_gaps(at);
  bool any = false;
  for (JudgedContact& own : contacts) {
    if (own.collides || !(own.law.restitution > 0) || !(own.closing > 0)) continue;
    const ContactRow row = row_of(own, at, end, least);
    const double slack = touching * own.closing;
    if (row.seen[0] + own.compliance * own.force[0] / step.h > slack) continue;
    if (row.velocity[0] < own.law.restitution * own.closing - slack) own.collides = any = true;
  }
  return any;
}

Vector ContactStep::push(const Vector& velocity, Vector& magnitude) const {
  Vector sum = Vector::Zero(step.model.unknowns);
  const State end = step.end(velocity);
  const Placement at = placement_of(end);
  const LeastGaps least = least_gaps(at);
  for (const JudgedContact& own : contacts) {
    if (own.force.isZero(0)) continue;
    for (const auto& [unknown, c] : row_of(own, at, end, least).parts) {
      sum.segment<3>(unknown) += c.transpose() * own.force;
      magnitude.segment<3>(unknown) += c.cwiseAbs().transpose() * own.force.cwiseAbs();
    }
  }
  return sum;
}

SparseMatrix ContactStep::stiffness(const Vector& velocity) const {
  const State end = step.end(velocity);
  const Placement at = placement_of(end);
  const LeastGaps least = least_gaps(at);
  const Moving moving(step.model);
  Triplets entries;
  for (const JudgedContact& own : contacts) {
    if (own.force.isZero(0)) continue;
    std::vector<int> unknowns;
    for (const auto& [unknown, c] : row_of(own, at, end, least).parts)
      for (int k = 0; k < 3; ++k) unknowns.push_back(unknown + k);
    const auto size = static_cast<Eigen::Index>(unknowns.size());
    Eigen::MatrixXd bent = Eigen::MatrixXd::Zero(size, size);  // inertia being one
    for (Eigen::Index k = 0; k < size; ++k) {
      constexpr double change = 1e-6;  // m or rad: errors of 1e-10 of the force, over a metre
      for (const double sign : {1.0, -1.0}) {
        Placement shifted = at;
        moving.move(unknowns[static_cast<std::size_t>(k)], sign * change, shifted);
        Eigen::Index part = 0;
        for (const auto& [unknown, c] : row_of(own, shifted, end, least).parts)
          bent.block<3, 1>(3 * part++, k) -= sign / (2 * change) * (c.transpose() * own.force);
      }
    }
    Vector root(size);
    for (Eigen::Index k = 0; k < size; ++k)
      root[k] = std::sqrt(step.model.inertia(unknowns[static_cast<std::size_t>(k)]));
    const Eigen::MatrixXd scaled_bent =
        root.cwiseInverse().asDiagonal() * (bent + bent.transpose()) / 2 * root.cwiseInverse().asDiagonal();
    const SymmetricEigen eigen = symmetric_eigen(scaled_bent);
    const Eigen::MatrixXd convex = root.asDiagonal() * eigen.vectors * eigen.values.cwiseMax(0).asDiagonal() *
                                   eigen.vectors.transpose() * root.asDiagonal();
    for (Eigen::Index i = 0; i < size; ++i)
      for (Eigen::Index k = 0; k < size; ++k)
        entries.emplace_back(unknowns[static_cast<std::size_t>(i)], unknowns[static_cast<std::size_t>(k)],
                             convex(i, k));
  }
  return from_triplets(step.model.unknowns, step.model.unknowns, entries);
}

double ContactStep::law_residual(FrictionLaw law, const Vector& velocity) const {
  const State end = step.end(velocity);
  const Placement at = placement_of(end);
  const LeastGaps least = least_gaps(at);
  double worst = 0;
  for (const JudgedContact& own : contacts) {
    const ContactRow row = row_of(own, at, end, least);
    double inverse = 0;
    for (const ContactFeature* feature : {&own.pair.a, &own.pair.b}) {
      double lightest = infinity;
      for (std::size_t k = 0; k < static_cast<std::size_t>(feature->count); ++k)
        if (const int i = step.model.nodes.first[static_cast<std::size_t>(feature->corner[k].node)]; i >= 0)
          lightest = std::min(lightest, step.model.inertia(i));
      if (std::isfinite(lightest)) inverse += 1 / lightest;
    }
    const double mass = inverse > 0 ? 1 / inverse : 1;
    Vec3 seen = row.seen;
    seen[0] += own.compliance * own.force[0] / step.h;
    if (law == FrictionLaw::coulomb) seen[0] += own.law.friction * seen.tail<2>().norm();
    const Vec3 impulse = step.h * own.force;
    const Vec3 missed = impulse - project_on_cone(impulse - mass * seen, own.law.friction);
    worst = larger(worst, missed.norm() / mass);
  }
  return worst;
}

}  // namespace pbd::reference
