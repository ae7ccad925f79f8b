#include "effects/contact.h"

#include <algorithm>
#include <cmath>

#include "effects/contact_blocks.h"
#include "effects/contact_stiffness.h"
#include "rows/row_operations.h"

namespace pbd {
namespace {

/// What the rows ask to vanish, or not to be negative, without the compliance's part, per second.
template <class Block>
typename Block::Value rates(const ActiveContact& contact, const Configuration& at,
                            const typename Block::Jacobian& jacobian, double gap, const StepMap& map,
                            const typename Block::Velocities& start_v, const typename Block::Velocities& v) {
  typename Block::Value rate = jacobian * v;
  if constexpr (Block::rows == 3)
    if (contact.conveys)
      rate.template tail<2>() +=
          directions_in<Block>(contact, jacobian).template bottomRows<2>() * conveyed(contact, at);
  const bool collides = contact.restitution > 0;
  const double apart = (gap - (collides ? contact.rebound : contact.target) - contact.offset) / map.d;
  rate[0] = collides ? std::min(rate[0] + contact.restitution * (jacobian * start_v)[0], apart) : apart;
  return rate;
}

/// One contact's rows; adds to the residual.
template <class Block>
void linearise_contact(const RowPlace& place, const Points& start_v, const ActiveContact& contact,
                       Block& block, std::size_t i, RowResidual& sums) {
  auto& jacobian = block.jacobian[i];
  const Touching found = evaluate<Block>(contact, place.at, jacobian);
  if (place.directions != nullptr) evaluate<Block>(contact, *place.directions, jacobian);
  const typename Block::Value rate = rates<Block>(contact, place.at, jacobian, found.gap, place.map,
                                                  block.gather(start_v, i), block.gather(place.v, i));
  block.bias[i] = rate - jacobian * block.gather(place.v, i);
  const double compliance = contact.restitution > 0 ? 0 : contact.compliance;  // what collides does not yield
  block.compliance.set(i, compliance / (place.map.h * place.map.d));
  block.bounds[i] = {};
  using Operations = RowOperations<Block::rows, Block::nodes>;
  Operations::invert_diagonal(block, place.inverse_mass, i, jacobian);
  const typename Block::Value r = rate + block.compliance[i] * block.impulse[i];
  const double size = value_rounding * largest_coordinate(contact, found, place.at) / place.map.d;
  sums.add(squared_residual(block, i, r),
           size * size * Operations::moving_squares(block, i, place.inverse_mass, jacobian)[0] *
               block.inverse_diagonal[i](0, 0));
  sums.impulses_squared += block.squared_effect(place.inverse_mass, i, jacobian);
}

}  // namespace

ContactRows::ContactRows(const Scene& scene, const Contact& effect, Friction law)
    : Source({.fills_space = false, .limited = true, .contacts = true}),
      effect_(effect),
      law_(law),
      search_(scene, effect),
      bounces_(std::any_of(effect.law.begin(), effect.law.end(),
                           [](const ContactLaw& own) { return own.restitution > 0; })) {}

void ContactRows::allocate(bool, BlockList& blocks) {
  if (effect_.collider.empty() && effect_.triangle.empty() && !effect_.nodes_touch) return;
  RowBlock<3, 4> of_bodies;
  RowBlock<3, 3> of_nodes;
  RowBlock<3, 5> of_triangles;
  of_bodies.law = of_nodes.law = of_triangles.law = law_;
  // In the order of ContactGroup; surfaces have four nodes, as bodies have four columns.
  blocks.add(RowBlock<3, 4>(of_bodies));
  blocks.add(RowBlock<1, 4>{});
  blocks.add(std::move(of_nodes));
  blocks.add(RowBlock<1, 3>{});
  blocks.add(std::move(of_bodies));
  blocks.add(RowBlock<1, 4>{});
  blocks.add(std::move(of_triangles));
  blocks.add(RowBlock<1, 5>{});
}

SearchedStep ContactRows::searched_step(const StepBegin& begin) const {
  return {begin.bodies, begin.at, straight_, free_.x, begin.inverse_mass, begin.tolerance, threads_};
}

bool ContactRows::begin_step(const StepBegin& begin, BlockSpan blocks) {
  if (blocks.empty()) return false;
  start_v_ = begin.v;
  recovering_ = begin.after_miss || (begin.continued && recovering_);
  free_.x = begin.map.x0 + begin.map.d * begin.map.v_free;
  begin.bodies.place(free_.x, free_.pose);
  straight_ = begin.map.x0 + begin.map.d * begin.v;
  threads_ = std::visit([](const auto& block) { return block.chunks.threads; }, blocks.front());
  search_.begin(searched_step(begin));
  collided_.clear();
  impact_ = Impact::none;
  keep_impulses(blocks);
  if (!begin.warm_start) seeds_.clear();
  waiting_.clear();
  const std::array<Configuration, 2> places{begin.at, {free_.x, free_.pose, begin.at.time}};
  const bool others = fill(begin, places, begin.at, blocks);
  if (!bounces_ || !search_.find_met(begin.at, places[1], contacts_)) return others;
  return fill(begin, places, begin.at, blocks) || others;
}

Widened ContactRows::widen(const StepBegin& begin, const Configuration& reached, BlockSpan blocks) {
  // What has collided does so for the rest of the step: nothing is told of it before the iterate solves the
  // step.
  if (blocks.empty() || (bounces_ && !begin.solved)) return Widened::no;
  double most = 0;  // N s
  with_contacts(blocks, contacts_, [&](const auto& block, auto&) {
    for (std::size_t i = 0; i < block.size(); ++i) most = std::max(most, block.impulse[i][0]);
  });
  with_contacts(blocks, contacts_, [&](const auto& block, auto& contacts) {
    // Of surfaces by any impulse: far beside its features a contact moves nodes by many times its own.
    for (std::size_t i = 0; i < block.size(); ++i)
      contacts[i].acts = block.impulse[i][0] > (contacts[i].of_surfaces ? 0 : begin.tolerance * most);
  });
  const Configuration free{free_.x, free_.pose, begin.at.time};
  const bool farther = search_.extend(searched_step(begin), reached.x);
  if (farther) {
    search_.find(begin.at, found_);
    waiting_.renew(found_, contacts_);
  }
  const bool more = may_wait() ? waiting_.call(reached) : farther;
  const bool others = search_.look_again(begin.at, reached, free, begin.tolerance, contacts_);
  if (!more && !others) return Widened::no;
  keep_impulses(blocks);
  return fill(begin, std::array{begin.at, free, reached}, reached, blocks) ? Widened::others : Widened::alike;
}

bool ContactRows::hold_back(const StepBegin& begin, const Configuration& reached,
                            std::vector<double>& share) {
  if (!effect_.continuous) return false;
  if (search_.extend(searched_step(begin), reached.x)) search_.find(begin.at, found_);
  return search_.hold_back(begin.bodies, begin.at, reached, share);
}

bool ContactRows::collide(ConstBlockSpan blocks, const Points& v, double accuracy) {
  constexpr double touching = 1e-6;  // of the speed at the start: what is left of the gap, a second
  bool any = false;
  with_contacts(blocks, contacts_, [&](const auto& block, auto& contacts) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      ActiveContact& contact = contacts[i];
      if (contact.restitution > 0 || !(contact.bounce > 0) || !(contact.closing > 0)) continue;
      const double unsolved = accuracy / std::sqrt(block.inverse_diagonal[i](0, 0));
      const double slack = std::max(touching * std::abs(contact.closing), unsolved);
      if (!(block.residual(v, i, block.impulse[i])[0] <= slack)) continue;
      const double parting = (block.jacobian[i] * block.gather(v, i))[0];
      if (!(parting < contact.bounce * contact.closing - slack)) continue;
      contact.restitution = contact.bounce;
      collided_.emplace(contact.pair(), contact.features.key);
      impact_ = std::max(impact_, Impact::rebound);
      any = true;
    }
  });
  return any;
}

void ContactRows::linearise(const RowPlace& place, BlockSpan blocks, RowResidual& sums) {
  with_contacts(blocks, contacts_, [&]<class Block>(Block& block, auto& contacts) {
    if (Block::nodes != 5 && !contacts.empty() && !contacts[0].of_surfaces)
      find_levels(place.directions != nullptr ? *place.directions : place.at, contacts);
    add_each(block, sums, [&](std::size_t i, RowResidual& own) {
      linearise_contact(place, start_v_, contacts[i], block, i, own);
    });
  });
}

void ContactRows::add_geometric_mass(const StepMap& map, const Configuration& at, double factor,
                                     ConstBlockSpan blocks, std::vector<double>& added_mass) const {
  with_contacts(blocks, contacts_, [&](const auto& block, const auto& contacts) {
    for (std::size_t i = 0; i < block.size(); ++i)
      add_contact_stiffness(contacts[i], map, at, factor, block, i, added_mass);
  });
}

void ContactRows::perturb(const RowError& error, BlockSpan blocks, Points& push) const {
  with_contacts(blocks, contacts_, [&]<class Block>(Block& block, const auto& contacts) {
    typename Block::Jacobian jacobian;
    for (std::size_t i = 0; i < block.size(); ++i) {
      const Touching found = evaluate<Block>(contacts[i], error.turned, jacobian);
      block.apply(error.inverse_mass, i, jacobian, block.impulse[i], push);
      const typename Block::Value before = block.bias[i] + block.jacobian[i] * block.gather(error.v, i);
      const typename Block::Velocities moved =
          block.gather(error.v, i) + error.scale * block.gather(error.error, i);
      const typename Block::Value after = rates<Block>(contacts[i], error.turned, jacobian, found.gap,
                                                       error.map, block.gather(start_v_, i), moved);
      block.bias[i] = (after - before) / error.scale - block.jacobian[i] * block.gather(error.error, i);
      block.bounds[i].freedom = block.impulse[i][0] > 0 ? Freedom::free : Freedom::held;
      block.impulse[i].setZero();
    }
  });
}

void ContactRows::add_contact_forces(const StepMap& map, const Configuration& at, const Points& v,
                                     ConstBlockSpan blocks, std::vector<ContactForce>& forces) const {
  const auto first_node = static_cast<int>(effect_.collider.size() + effect_.node.size());  // of a surface
  with_contacts(blocks, contacts_, [&]<class Block>(const Block& block, const auto& contacts) {
    using Full = RowBlock<3, Block::nodes>;  // all three directions, of a contact without friction too
    for (std::size_t i = 0; i < block.size(); ++i) {
      typename Full::Jacobian jacobian = Full::Jacobian::Zero();
      const Touching found = evaluate<Full>(contacts[i], at, jacobian);
      std::array<int, 2> collider = contacts[i].collider;
      for (const int side : {0, 1}) {
        if (side == contacts[i].triangle_side) collider[side] = first_node + contacts[i].triangle.node[0];
        if (contacts[i].of_surfaces && !contacts[i].surface.of_spheres())
          collider[side] = search_.side_of_surface(collider[side]);
      }
      const auto acting = directions_in<std::remove_const_t<Block>>(contacts[i], block.jacobian[i]);
      const Vec3 normal = acting.row(0);
      Vec3 slip = directions_in<Full>(contacts[i], jacobian).transpose() * (jacobian * block.gather(v, i));
      if (contacts[i].conveys) slip += conveyed(contacts[i], at);
      slip -= normal.dot(slip) * normal;
      forces.push_back({collider, place_of(contacts[i], found), normal,
                        acting.transpose() * block.impulse[i] / map.h, slip, found.gap});
      if (contacts[i].meeting) forces.back().met = contacts[i].meeting->on_way;
      if (contacts[i].surface.met) forces.back().met.emplace();
    }
  });
}

}  // namespace pbd
