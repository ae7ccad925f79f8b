#include "contact_rows.h"

#include "contact_group.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "effect_rows.h"

namespace pbd {
namespace {

/// What the rows ask to vanish, or not to be negative, without the compliance's part, per second.
template <class Block>
typename Block::Value rates(const ActiveContact& contact, const typename Block::Jacobian& jacobian,
                            double gap, const StepMap& map, const typename Block::Velocities& start_v,
                            const typename Block::Velocities& v) {
  typename Block::Value rate = jacobian * v;
  const double apart = (gap - contact.target - contact.offset) / map.d;
  if (contact.restitution > 0) {
    rate[0] += contact.restitution * (jacobian * start_v)[0];
    if (contact.closing) return rate;
    rate[0] = std::min(rate[0], apart);
  } else {
    rate[0] = apart;
  }
  return rate;
}

/// A normal turns by at most |dx| over the height of its triangle, or the shorter edge times the sine between
/// them: twice the impulse over that length.
double surface_bound(const SurfaceContact& contact, const Points& x, double impulse) {
  const auto at = [&](std::size_t k) -> Vec3 { return x.col(contact.node[k]); };
  const Vec3 u = contact.edges ? at(1) - at(0) : at(2) - at(1);
  const Vec3 v = contact.edges ? at(3) - at(2) : at(3) - at(1);
  const double length = u.cross(v).norm() / std::max(u.norm(), v.norm());
  return length > 0 ? 2 * std::abs(impulse) / length : 0.0;
}

/// Sets `nearest` of contacts of bodies, a pair's in a row.
void find_nearest(const Configuration& at, std::vector<ActiveContact>& contacts) {
  for (auto first = contacts.begin(); first != contacts.end();) {
    auto last = first;
    double nearest = infinity;
    for (; last != contacts.end() && last->collider == first->collider; ++last)
      nearest =
          std::min(nearest, touching(last->features, frame_of(*last, 0, at), frame_of(*last, 1, at)).gap);
    for (; first != last; ++first) first->nearest = nearest;
  }
}

/// Largest coordinate of a contact, m.
double largest(const ActiveContact& contact, const Touching& found, const Configuration& at) {
  double most = std::max(found.point_a.cwiseAbs().maxCoeff(), found.point_b.cwiseAbs().maxCoeff());
  if (contact.of_surfaces) return most;
  for (const int side : {0, 1})
    most = std::max(most, frame_of(contact, side, at).origin.cwiseAbs().maxCoeff());
  return most;
}

}  // namespace

ContactRows::ContactRows(const Scene& scene, Friction law, Rows& rows,
                         std::vector<std::size_t>& effect_of_block)
    : first_block_(rows.blocks.size()) {
  for (std::size_t index = 0; index < scene.effects.size(); ++index)
    if (const auto* contact = std::get_if<Contact>(&scene.effects[index]))
      if (!contact->collider.empty() || !contact->triangle.empty()) effect_ = static_cast<int>(index);
  if (!listed()) return;
  RowBlock<3, 4> of_bodies;
  RowBlock<3, 3> of_nodes;
  of_bodies.law = of_nodes.law = law;
  rows.blocks.insert(rows.blocks.end(),
                     {of_bodies, RowBlock<1, 4>{}, of_nodes, RowBlock<1, 3>{}, of_bodies, RowBlock<1, 4>{}});
  rows.contacts = true;
  effect_of_block.insert(effect_of_block.end(), groups, static_cast<std::size_t>(effect_));
  const auto& effect = std::get<Contact>(scene.effects[static_cast<std::size_t>(effect_)]);
  if (!effect.triangle.empty()) surfaces_.emplace(effect.triangle);
  ignored_ = effect.apart;
  for (const Effect& other : scene.effects)
    std::visit(
        [&]<class E>(const E& joint) {
          if constexpr (requires { joint.body[0][1]; })
            ignored_.insert(ignored_.end(), joint.body.begin(), joint.body.end());
        },
        other);
  for (auto& pair : ignored_)
    if (pair[0] > pair[1]) std::swap(pair[0], pair[1]);
  std::sort(ignored_.begin(), ignored_.end());
}

/// One contact's rows; adds to the residual.
template <class Block>
void ContactRows::linearise_contact(const Linearisation& to, ActiveContact& contact, Block& block,
                                    std::size_t i, BlockResidual& sums) const {
  if (relaxed_ && block.impulse[i][0] > 0) contact.restitution = contact.law.restitution;
  auto& jacobian = block.jacobian[i];
  const Touching found = evaluate<Block>(contact, to.at, jacobian);
  if (to.directions != nullptr) evaluate<Block>(contact, *to.directions, jacobian);
  const typename Block::Value rate =
      rates<Block>(contact, jacobian, found.gap, to.map, block.gather(start_v_, i), block.gather(to.v, i));
  block.bias[i] = rate - jacobian * block.gather(to.v, i);
  block.compliance[i].setZero();
  block.compliance[i](0, 0) = contact.compliance / (to.map.h * to.map.d);
  block.bounds[i] = {0, infinity};
  invert_diagonal(block, to.inverse_mass, i);
  const typename Block::Value r = rate + block.compliance[i] * block.impulse[i];
  sums.squared +=
      block.squared_residual(i, r, block.allowed(i, block.impulse[i], -block.inverse_diagonal[i] * r));
  constexpr double roundoff = 8 * std::numeric_limits<double>::epsilon();
  const double size = roundoff * largest(contact, found, to.at) / to.map.d;
  sums.rounding_squared += size * size * jacobian.row(0).squaredNorm() * block.inverse_diagonal[i](0, 0);
  sums.impulses_squared += block.squared_effect(to.inverse_mass, i);
}

BlockResidual ContactRows::linearise(const Configuration& at, const Configuration* directions,
                                     const StepMap& map, const Points& v,
                                     const std::vector<double>& inverse_mass, std::size_t index, Rows& rows) {
  BlockResidual sums;
  const Linearisation to{at, directions, map, v, inverse_mass};
  with_contacts(rows, index, first_block_, contacts_, [&]<class Block>(Block& block, auto& contacts) {
    if (!contacts.empty() && !contacts[0].of_surfaces) find_nearest(at, contacts);
    for (std::size_t i = 0; i < block.size(); ++i) linearise_contact(to, contacts[i], block, i, sums);
  });
  if (index + 1 == first_block_ + groups) relaxed_ = true;
  return sums;
}

void ContactRows::add_geometric_inertia(const StepMap& map, const Configuration& at, double factor,
                                        const Rows& rows, std::size_t index,
                                        std::vector<double>& inertia) const {
  with_contacts(
      rows, index, first_block_, contacts_, [&]<class Block>(const Block& block, const auto& contacts) {
        for (std::size_t i = 0; i < block.size(); ++i) {
          const ActiveContact& contact = contacts[i];
          if constexpr (Block::nodes == 4)
            if (contact.of_surfaces) {
              const double bound = surface_bound(contact.surface, at.x, factor * block.impulse[i].norm());
              for (const int node : block.node[i])
                inertia[static_cast<std::size_t>(node)] += map.d / 2 * bound;
              continue;
            }
          const ContactPoint& features = contact.features;
          const Frame a = frame_of(contact, 0, at), b = frame_of(contact, 1, at);
          const Touching found = touching(features, a, b);
          const double normal = factor * block.impulse[i][0];
          Vec3 tangential = Vec3::Zero();
          if constexpr (Block::rows == 3)
            tangential =
                factor *
                directions_in<Block>(contact, block.jacobian[i]).template bottomRows<2>().transpose() *
                block.impulse[i].template tail<2>();
          const bool turns = features.kind != ContactPoint::Kind::face;  // n, as the points move apart
          const double distance = found.gap + features.radius_a + features.radius_b;
          const double apart = turns && distance > 0 ? std::max(0.0, -normal) * 2 / distance : 0.0;
          for (const int side : {0, 1}) {
            const int column = column_of<Block>(contact, side);
            const auto node = [&](int k) {
              return static_cast<std::size_t>(
                  block.node[i][static_cast<std::size_t>(column) + static_cast<std::size_t>(k)]);
            };
            inertia[node(0)] += map.d / 2 * apart;
            if (side == contact.node_side) continue;
            const Frame& own = side == 0 ? a : b;
            const Vec3 lever = own.rotation * (side == 0 ? features.point_a : features.point_b);
            const Vec3 arm = place_of(contact, found) - own.origin;
            const Vec3 push = (side == 0 ? normal : -normal) * found.normal;
            const Pose& pose =
                at.pose[static_cast<std::size_t>(contact.carrier[static_cast<std::size_t>(side)])];
            const Eigen::Matrix3d turn = cross_matrix(lever);
            inertia[node(1)] += map.d / 2 *
                                (largest_of(lever_form(push, lever) + apart * turn.transpose() * turn, pose) +
                                 product_bound(pose, lever_form(tangential, arm), pose));
          }
        }
      });
}

void ContactRows::perturb(const StepMap& map, const Configuration& turned, const Points& v, double scale,
                          const Points& error, const std::vector<double>& inverse_mass, std::size_t index,
                          Rows& rows, Points& push) const {
  with_contacts(
      rows, index, first_block_, contacts_,
      [&]<class Block>(Block& block, const std::vector<ActiveContact>& contacts) {
        typename Block::Jacobian jacobian;
        for (std::size_t i = 0; i < block.size(); ++i) {
          const Touching found = evaluate<Block>(contacts[i], turned, jacobian);
          block.apply(inverse_mass, i, jacobian, block.impulse[i], push);
          const typename Block::Value before = block.bias[i] + block.jacobian[i] * block.gather(v, i);
          const typename Block::Velocities moved = block.gather(v, i) + scale * block.gather(error, i);
          const typename Block::Value after =
              rates<Block>(contacts[i], jacobian, found.gap, map, block.gather(start_v_, i), moved);
          block.bias[i] = (after - before) / scale - block.jacobian[i] * block.gather(error, i);
          const bool open = block.impulse[i][0] <= 0;
          block.bounds[i] = open ? std::array{0.0, 0.0} : std::array{-infinity, infinity};
          block.impulse[i].setZero();
        }
      });
}

void ContactRows::apply(const Rows& rows, const std::vector<double>& inverse_mass, Points& v) const {
  for (std::size_t b = first_block_; listed() && b < rows.blocks.size(); ++b)
    std::visit(
        [&](const auto& block) {
          for (std::size_t i = 0; i < block.size(); ++i) block.apply(inverse_mass, i, block.impulse[i], v);
        },
        rows.blocks[b]);
}

std::vector<ContactForce> ContactRows::forces(const Configuration& at, const StepMap& map, const Points& v,
                                              const Rows& rows) const {
  std::vector<ContactForce> all;
  const auto first_node = static_cast<int>(motions_.size());  // of a surface
  for (std::size_t index = first_block_; listed() && index < rows.blocks.size(); ++index)
    with_contacts(rows, index, first_block_, contacts_, [&]<class Block>(const Block& block, auto& contacts) {
      RowBlock<3, Block::nodes> full;  // all three directions, of a contact without friction too
      for (std::size_t i = 0; i < block.size(); ++i) {
        typename decltype(full)::Jacobian jacobian = decltype(full)::Jacobian::Zero();
        const Touching found = evaluate<decltype(full)>(contacts[i], at, jacobian);
        const Directions<3> directions = directions_in<decltype(full)>(contacts[i], jacobian);
        std::array<int, 2> collider = contacts[i].collider;
        for (int& own : collider) own += contacts[i].of_surfaces ? first_node : 0;
        Vec3 impulse = Vec3::Zero();
        impulse.head<Block::rows>() = block.impulse[i];
        Vec3 slip = jacobian * block.gather(v, i);
        slip[0] = 0;
        all.push_back({collider, place_of(contacts[i], found), found.normal,
                       directions.transpose() * impulse / map.h, directions.transpose() * slip, found.gap});
      }
    });
  return all;
}

}  // namespace pbd
