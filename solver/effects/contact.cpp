#include "effects/contact.h"

#include <algorithm>
#include <cmath>

#include "effects/contact_stiffness.h"
#include "rows/row_operations.h"

namespace pbd {
namespace {

/// f(block, its contacts) for each block of contacts; there is none where nothing can touch.
template <class Blocks, class Lists, class F>
void with_contacts(Blocks&& blocks, Lists& contacts, F&& f) {
  for (std::size_t group = 0; group < blocks.size(); ++group)
    std::visit(
        [&]<class Block>(Block& block) {
          if constexpr ((Block::rows == 1 || Block::rows == 3) && Block::nodes >= 3 && Block::nodes <= 5)
            f(block, contacts[group]);
        },
        blocks[group]);
}

/// What the rows ask to vanish, or not to be negative, without the compliance's part, per second.
template <class Block>
typename Block::Value rates(const ActiveContact& contact, const typename Block::Jacobian& jacobian,
                            double gap, const StepMap& map, const typename Block::Velocities& start_v,
                            const typename Block::Velocities& v) {
  typename Block::Value rate = jacobian * v;
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
  const typename Block::Value rate = rates<Block>(contact, jacobian, found.gap, place.map,
                                                  block.gather(start_v, i), block.gather(place.v, i));
  block.bias[i] = rate - jacobian * block.gather(place.v, i);
  block.compliance[i].setZero();
  block.compliance[i](0, 0) = contact.compliance / (place.map.h * place.map.d);
  block.bounds[i] = {};
  using Operations = RowOperations<Block::rows, Block::nodes>;
  Operations::invert_diagonal(block, place.inverse_mass, i);
  const typename Block::Value r = rate + block.compliance[i] * block.impulse[i];
  const double size = value_rounding * largest_coordinate(contact, found, place.at) / place.map.d;
  sums.add(squared_residual(block, i, r), size * size *
                                              Operations::moving_squares(block, i, place.inverse_mass)[0] *
                                              block.inverse_diagonal[i](0, 0));
  sums.impulses_squared += block.squared_effect(place.inverse_mass, i);
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
  if (effect_.collider.empty() && effect_.triangle.empty()) return;
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

bool ContactRows::begin_step(const StepBegin& begin, BlockSpan blocks) {
  if (blocks.empty()) return false;
  start_v_ = begin.v;
  recovering_ = begin.after_miss || (begin.continued && recovering_);
  free_.x = begin.map.x0 + begin.map.d * begin.map.v_free;
  begin.bodies.place(free_.x, free_.pose);
  search_.begin(begin.bodies, begin.at, free_.x, begin.inverse_mass);
  collided_.clear();
  keep_impulses(blocks);
  if (!begin.warm_start) seeds_.clear();
  const bool others = fill(begin, blocks);
  if (!bounces_ || !search_.find_met(begin.at, {free_.x, free_.pose, begin.at.time}, contacts_))
    return others;
  return fill(begin, blocks) || others;
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
    for (std::size_t i = 0; i < block.size(); ++i)
      contacts[i].acts = block.impulse[i][0] > begin.tolerance * most;
  });
  if (!search_.extend(begin.bodies, begin.at, reached.x) &&
      !search_.look_again(begin.at, reached, {free_.x, free_.pose, begin.at.time}, begin.tolerance,
                          contacts_))
    return Widened::no;
  keep_impulses(blocks);
  return fill(begin, blocks) ? Widened::others : Widened::alike;
}

bool ContactRows::collide(ConstBlockSpan blocks, const Points& v, double accuracy) {
  constexpr double touching = 1e-6;  // of the speed at the start: what is left of the gap, a second
  bool any = false;
  with_contacts(blocks, contacts_, [&](const auto& block, auto& contacts) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      ActiveContact& contact = contacts[i];
      if (contact.restitution > 0 || !(contact.law.restitution > 0) || !(contact.closing > 0)) continue;
      const double unsolved = accuracy / std::sqrt(block.inverse_diagonal[i](0, 0));
      const double slack = std::max(touching * std::abs(contact.closing), unsolved);
      if (!(block.residual(v, i, block.impulse[i])[0] <= slack)) continue;
      const double parting = (block.jacobian[i] * block.gather(v, i))[0];
      if (!(parting < contact.law.restitution * contact.closing - slack)) continue;
      contact.restitution = contact.law.restitution;
      collided_.emplace(contact.pair(), contact.features.key);
      any = true;
    }
  });
  return any;
}

void ContactRows::linearise(const RowPlace& place, BlockSpan blocks, RowResidual& sums) {
  with_contacts(blocks, contacts_, [&]<class Block>(Block& block, auto& contacts) {
    if (Block::nodes != 5 && !contacts.empty() && !contacts[0].of_surfaces)
      find_nearest(place.directions != nullptr ? *place.directions : place.at, contacts);
    for (std::size_t i = 0; i < block.size(); ++i)
      linearise_contact(place, start_v_, contacts[i], block, i, sums);
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
      const typename Block::Value after =
          rates<Block>(contacts[i], jacobian, found.gap, error.map, block.gather(start_v_, i), moved);
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
        if (contacts[i].of_surfaces) collider[side] += first_node;
      }
      const auto acting = directions_in<std::remove_const_t<Block>>(contacts[i], block.jacobian[i]);
      const Vec3 normal = acting.row(0);
      Vec3 slip = directions_in<Full>(contacts[i], jacobian).transpose() * (jacobian * block.gather(v, i));
      slip -= normal.dot(slip) * normal;
      forces.push_back({collider, place_of(contacts[i], found), normal,
                        acting.transpose() * block.impulse[i] / map.h, slip, found.gap});
    }
  });
}

void ContactRows::keep_impulses(ConstBlockSpan blocks) {
  seeds_.clear();
  with_contacts(blocks, contacts_, [&]<class Block>(const Block& block, const auto& contacts) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      if (!(block.impulse[i][0] > 0)) continue;
      const auto directions = directions_in<std::remove_const_t<Block>>(contacts[i], block.jacobian[i]);
      seeds_.add(contacts[i].collider, contacts[i].features.key, directions.transpose() * block.impulse[i]);
    }
  });
  seeds_.sort();
}

/// The gap that a contact aims at, `gap` where the step begins and `from` at x0 (m).
template <class Block>
double ContactRows::target_of(const StepBegin& begin, const Shifts& shifts, double gap, double from,
                              const Block& block, std::size_t i) const {
  constexpr double recovered =
      0.1;  // a step, of what missed steps left: at once it would take a hundred times the energy
  const double target = std::min(0.0, std::max(gap, from + effect_.recovery * begin.map.d));
  if (!recovering_ || gap >= target) return target;
  const double forced = std::abs((block.jacobian[i] * block.gather(shifts.forced, i))[0]);
  return std::min(target, (1 - recovered) * gap + forced);
}

/// The impulse that a contact had in the last step, as its law lets it be.
template <class Block>
void ContactRows::take_seed(const ActiveContact& contact, Block& block, std::size_t i) const {
  const auto& [a, b] = contact.collider;
  const Vec3* seed = seeds_.find({a, b}, contact.features.key);
  double sign = 1;
  if (seed == nullptr && contact.heir_of != 0) {
    seed = seeds_.find({a, b}, contact.heir_of);
    if (seed == nullptr) seed = seeds_.find({b, a}, contact.heir_of), sign = -1;
  }
  if (seed == nullptr) return;
  block.impulse[i] = sign * (directions_in<Block>(contact, block.jacobian[i]) * *seed);
  block.impulse[i] += allowed(block, i, block.impulse[i], Block::Value::Zero());
}

/// True if what a gap falls to zero between touches there, on the way of the free motion, which the gap of
/// the contact ends as `ahead`, m.
bool ContactRows::meets_freely(const StepBegin& begin, const ActiveContact& contact, double gap,
                               double ahead) {
  const double share = gap > 0 ? gap / (gap - ahead) : 0;
  return search_.on_features(contact, begin.at, {free_.x, free_.pose, begin.at.time}, share);
}

/// What a contact asks for in this step, and the impulse it begins with.
template <class Block>
void ContactRows::begin_contact(const StepBegin& begin, const Shifts& shifts, ActiveContact& contact,
                                Block& block, std::size_t i) {
  auto& jacobian = block.jacobian[i];
  contact.reference = reference_for(evaluate<Block>(contact, begin.at, jacobian).normal);
  const double gap = evaluate<Block>(contact, begin.at, jacobian).gap;
  const double from = gap + (jacobian * block.gather(shifts.own, i))[0];
  if (!contact.late) contact.target = target_of(begin, shifts, gap, from, block, i);
  contact.closing = -(jacobian * block.gather(start_v_, i))[0];
  const double ahead = gap + (jacobian * block.gather(shifts.free, i))[0];
  const bool closes = contact.law.restitution > 0 && contact.closing > 0 && ahead < 0;
  const bool meets = closes && meets_freely(begin, contact, gap, ahead);
  contact.passes = closes && !meets;
  const bool collides = meets || collided_.contains({contact.pair(), contact.features.key});
  contact.restitution = collides ? contact.law.restitution : 0.0;
  contact.rebound =
      contact.closing > 0
          ? std::min(contact.target, from + begin.map.d * contact.law.restitution * contact.closing)
          : contact.target;
  const double elastic = 1 / (1 + contact.law.damping / begin.map.d);  // the spring's share
  contact.compliance = elastic * contact.law.compliance;
  // The damper is met with the shape; what is seen late was apart.
  contact.offset = contact.late ? 0 : (1 - elastic) * (std::min(from, 0.0) - contact.target);
  take_seed(contact, block, i);
}

/// True if the rows connect other columns than before.
bool ContactRows::fill(const StepBegin& begin, BlockSpan blocks) {
  search_.find(begin.at, contacts_);
  const Shifts shifts{begin.map.x0 + begin.map.d * begin.map.v_free - begin.at.x, begin.map.x0 - begin.at.x,
                      begin.map.d * (begin.map.v_free - begin.v)};
  bool others = false, apart = true;
  with_contacts(blocks, contacts_, [&]<class Block>(Block& block, auto& contacts) {
    std::vector<typename Block::Shape::Nodes> before;
    before.swap(block.node);
    block.resize_contacts(contacts.size());
    for (std::size_t i = 0; i < block.size(); ++i) {
      block.node[i] = columns_of_contact<Block>(contacts[i], begin.bodies);
      if (block.frictional()) block.friction[i] = contacts[i].law.friction;
      begin_contact(begin, shifts, contacts[i], block, i);
      apart = apart && contacts[i].target == 0;
    }
    others |= block.node != before;
  });
  if (apart) recovering_ = false;
  return others;
}

}  // namespace pbd
