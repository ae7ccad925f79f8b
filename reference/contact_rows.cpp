// What the contacts of a step push, how that changes with the pose, and what their law sees.
#include <algorithm>
#include <cmath>

#include "contact_step.h"
#include "dense.h"
#include "step_rows.h"

namespace pbd::reference {
namespace {

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

/// Velocity of a's surface against b's by what moves along itself, m/s.
Vec3 conveyed(const Contact& contact, const FeaturePair& pair, const Placement& at) {
  Vec3 sum = Vec3::Zero();
  for (const std::size_t k : {0, 1}) {
    const auto side = static_cast<std::size_t>(pair.surface[k]);
    if (side >= contact.collider.size()) continue;
    const Collider& own = contact.collider[side];
    const Vec3 along = own.frame.rotation * own.surface_velocity;
    sum += (k == 0 ? 1.0 : -1.0) * (at.orientation[static_cast<std::size_t>(own.body)] * along);
  }
  return sum;
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

/// On a body's; a deformable triangle's nodes take forces up in its middle plane.
bool is_on_face(const FeaturePair& pair) {
  return pair.b.count == 3 && !pair.a.deformable && !pair.b.deformable;
}

/// Whether both are over the same face of the same side.
bool over_one_face(const FeaturePair& one, const Nearest& at_one, const FeaturePair& two,
                   const Nearest& at_two) {
  constexpr double same = 1e-10;
  return is_on_face(one) && is_on_face(two) && one.surface == two.surface &&
         (at_one.normal - at_two.normal).norm() <= same &&
         std::abs(at_one.normal.dot(at_one.on_b - at_two.on_b)) <=
             same * (at_one.on_b.norm() + at_two.on_b.norm());
}

}  // namespace

ContactPose ContactStep::pose_at(const Vector& velocity) const {
  ContactPose pose;
  pose.end = step.end(velocity);
  pose.at = placement_of(pose.end);
  std::map<std::array<int, 2>, double> least;  // gap of each pair of sides, m
  std::vector<Nearest> found;
  for (const JudgedContact& own : contacts) {
    found.push_back(nearest(own.pair, pose.at));
    double& gap = least.try_emplace(own.pair.surface, infinity).first->second;
    gap = std::min(gap, found.back().gap);
  }
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const JudgedContact& own = contacts[i];
    double& level = pose.level.emplace_back(own.collides ? found[i].gap : least.at(own.pair.surface));
    for (std::size_t k = 0; own.collides && k < contacts.size(); ++k)
      if (over_one_face(own.pair, found[i], contacts[k].pair, found[k]))
        level = std::min(level, found[k].gap);
  }
  return pose;
}

ContactRow ContactStep::row_of(const JudgedContact& own, const ContactPose& pose, const Placement& at) const {
  ContactRow row;
  Nearest found = nearest(own.pair, at);
  if (is_on_face(own.pair))
    found.place += (pose.level[static_cast<std::size_t>(&own - contacts.data())] - found.gap) * found.normal;
  const Eigen::Matrix3d directions = directions_of(found.normal, own.reference);
  for (const auto& [feature, weight, sign] :
       {std::tuple{&own.pair.a, &found.weight[0], 1.0}, std::tuple{&own.pair.b, &found.weight[1], -1.0}})
    add_parts(step.model, *feature, *weight, at, found.place, sign * directions, row.parts);
  row.seen = directions * against(own.pair, found, at, pose.end);
  row.normal_velocity = row.seen[0];
  row.seen.tail<2>() += directions.bottomRows<2>() * conveyed(contact, own.pair, at);
  row.seen[0] = (found.gap - (own.collides ? own.rebound : own.target)) / step.d();
  if (own.collides)
    row.seen[0] =
        std::min(row.seen[0], row.normal_velocity +
                                  own.bounce * found.normal.dot(against(own.pair, found, at, step.start)));
  return row;
}

Vector ContactStep::push(const Vector& velocity, Vector& magnitude) const {
  Vector sum = Vector::Zero(step.model.unknowns);
  const ContactPose pose = pose_at(velocity);
  for (const JudgedContact& own : contacts) {
    if (own.force.isZero(0)) continue;
    for (const auto& [unknown, c] : row_of(own, pose).parts) {
      sum.segment<3>(unknown) += c.transpose() * own.force;
      magnitude.segment<3>(unknown) += c.cwiseAbs().transpose() * own.force.cwiseAbs();
    }
  }
  return sum;
}

SparseMatrix ContactStep::stiffness(const Vector& velocity) const {
  const ContactPose pose = pose_at(velocity);
  const Moving moving(step.model);
  Triplets entries;
  for (const JudgedContact& own : contacts) {
    if (own.force.isZero(0)) continue;
    std::vector<int> unknowns;
    for (const auto& [unknown, c] : row_of(own, pose).parts)
      for (int k = 0; k < 3; ++k) unknowns.push_back(unknown + k);
    const auto size = static_cast<Eigen::Index>(unknowns.size());
    Eigen::MatrixXd bent = Eigen::MatrixXd::Zero(size, size);  // inertia being one
    for (Eigen::Index k = 0; k < size; ++k) {
      constexpr double change = 1e-6;  // m or rad: errors of 1e-10 of the force, over a metre
      for (const double sign : {1.0, -1.0}) {
        Placement shifted = pose.at;
        moving.move(unknowns[static_cast<std::size_t>(k)], sign * change, shifted);
        Eigen::Index part = 0;
        for (const auto& [unknown, c] : row_of(own, pose, shifted).parts)
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
  const ContactPose pose = pose_at(velocity);
  double worst = 0;
  for (const JudgedContact& own : contacts) {
    const ContactRow row = row_of(own, pose);
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
    seen[0] += compliance_of(own) * own.force[0] / step.d();
    if (law == FrictionLaw::coulomb) seen[0] += own.law.friction * seen.tail<2>().norm();
    const Vec3 impulse = step.s() * own.force;
    const Vec3 missed = impulse - project_on_cone(impulse - mass * seen, own.law.friction);
    worst = larger(worst, missed.norm() / mass);
  }
  return worst;
}

double ContactStep::bounds_residual(const RigidSystem& system, const Vector& gamma) const {
  const Vector open = system.gap(gamma) / step.d();
  const Vector per_length = step.model.radius.cwiseInverse();
  const Vector squares = squared_rows(scaled(system.jacobian, per_length), Vector::Ones(step.model.unknowns));
  const Vector inverse_mass = squared_rows(system.jacobian, step.model.inertia.cwiseInverse());
  double worst = 0;
  for (const auto& [row, bounds] : bounded) {
    const double mass = inverse_mass[row] > 0 ? 1 / inverse_mass[row] : 1;
    const double length = squares[row] > 0 ? std::sqrt(squares[row]) : 1;
    const double impulse = step.s() * gamma[row];
    const double kept = std::clamp(impulse - mass * open[row], step.s() * bounds[0], step.s() * bounds[1]);
    worst = larger(worst, std::abs(impulse - kept) / mass / length);
  }
  return worst;
}

}  // namespace pbd::reference
