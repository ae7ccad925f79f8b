// What contacts ask for where a step begins, or where they are found anew in it.
#include <algorithm>
#include <cmath>

#include "effects/contact.h"
#include "effects/contact_blocks.h"
#include "rows/row_operations.h"

namespace pbd {
namespace {

/// True if it meets by the speed at which it approaches, not for what forces bring alone.
template <class Block>
bool hits(const Points& forced, const ActiveContact& contact, double d, double ahead, const Block& block,
          std::size_t i) {
  if (!(contact.closing > 0) || !(ahead < 0)) return false;
  return contact.closing * d > pressed_speed * std::abs((block.jacobian[i] * block.gather(forced, i))[0]);
}

}  // namespace

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

/// The gap that a hard contact aims at, `gap` where the step begins and farther by `shift` at x0 (m).
template <class Block>
double ContactRows::target_of(const StepBegin& begin, const Shifts& shifts, const ActiveContact& contact,
                              double gap, double shift, const Block& block, std::size_t i) const {
  constexpr double recovered =
      0.1;  // a step, of what missed steps left: at once it would take a hundred times the energy
  double target = std::min(0.0, std::max(gap, gap + shift + effect_.recovery * begin.map.d));
  if (contact.between_surfaces) target = std::min(target, gap + parted * contact.surface.thickness);
  if (!recovering_ || gap >= target) return target;
  const double forced = std::abs((block.jacobian[i] * block.gather(shifts.forced, i))[0]);
  return std::min(target, (1 - recovered) * gap + forced);
}

/// The impulse that a contact had at `at`, where the last step or the rows before ended, as its law lets it
/// be.
template <class Block>
void ContactRows::take_seed(const Configuration& at, const ActiveContact& contact, Block& block,
                            std::size_t i) const {
  const auto& [a, b] = contact.collider;
  const Vec3* seed = seeds_.find({a, b}, contact.features.key);
  double sign = 1;
  if (seed == nullptr && contact.heir_of != 0) {
    seed = seeds_.find({a, b}, contact.heir_of);
    if (seed == nullptr) seed = seeds_.find({b, a}, contact.heir_of), sign = -1;
  }
  if (seed == nullptr) return;
  typename Block::Jacobian jacobian;
  evaluate<Block>(contact, at, jacobian);
  block.impulse[i] = sign * (directions_in<Block>(contact, jacobian) * *seed);
  block.impulse[i] += allowed(block, i, block.impulse[i], Block::Value::Zero());
}

/// Whether a gap closes on the way of the free motion, the contact's rates of which take it to `ahead` (m),
/// and whether what it is between touches there.
void ContactRows::look_ahead(const StepBegin& begin, double gap, double ahead, ActiveContact& contact) {
  const Configuration free{free_.x, free_.pose, begin.at.time};
  const auto share = search_.closes_at(contact, begin.at, free, gap > 0 ? gap / (gap - ahead) : 0);
  const bool meets = share && search_.on_features(contact, begin.at, free, *share);
  contact.restitution = meets ? contact.bounce : 0;
  contact.passes = share && !meets;
}

/// What a contact asks for in this step, and the impulse it begins with.
template <class Block>
void ContactRows::begin_contact(const StepBegin& begin, const Shifts& shifts, ActiveContact& contact,
                                Block& block, std::size_t i) {
  auto& jacobian = block.jacobian[i];
  contact.reference = reference_for(evaluate<Block>(contact, begin.at, jacobian).normal);
  const double gap = evaluate<Block>(contact, begin.at, jacobian).gap;
  const double shift = (jacobian * block.gather(shifts.own, i))[0], from = gap + shift;
  const auto recovered = [&](double deep) {
    return target_of(begin, shifts, contact, deep, shift, block, i);
  };
  // What yields is a spring from where the shapes touch, however deep it begins. A late one is told how deep
  // its pair began, as its features may have lain anywhere then. Of what surfaces pass and of triangles,
  // which may have begun cut by others, the target stays.
  const bool yields = contact.law.compliance > 0;
  const double loaded = std::min(contact.late ? std::max(from, contact.target) : from, 0.0);
  if (yields)
    contact.target = 0;
  else if (!contact.late)
    contact.target = recovered(gap);
  else if (!contact.of_surfaces && contact.triangle_side < 0)
    contact.target = recovered(contact.target);
  contact.closing = -(jacobian * block.gather(start_v_, i))[0];
  const double ahead = gap + (jacobian * block.gather(shifts.free, i))[0];
  const bool springs = yields && contact.law.damping == 0;
  if (hits(shifts.forced, contact, begin.map.d, ahead, block, i))
    impact_ = std::max(impact_, springs || contact.law.restitution > 0 ? Impact::rebound : Impact::stop);
  contact.bounce = yields && gap < 0 ? 0 : contact.law.restitution;
  contact.restitution = 0;
  contact.passes = false;
  if (contact.bounce > 0 && contact.closing > 0 && ahead < 0) look_ahead(begin, gap, ahead, contact);
  if (collided_.contains({contact.pair(), contact.features.key})) contact.restitution = contact.bounce;
  contact.rebound = contact.closing > 0
                        ? std::min(contact.target, from + begin.map.d * contact.bounce * contact.closing)
                        : contact.target;
  const double elastic = 1 / (1 + contact.law.damping / begin.map.d);  // the spring's share
  contact.compliance = elastic * contact.law.compliance;
  // The damper is met with the shape: what is seen late began no deeper than its pair.
  contact.offset = (1 - elastic) * (loaded - contact.target);
}

/// Rows of what touches, or is near to it, at one of the places. True if they connect other columns than
/// before. The impulses to begin with were found at `last`.
bool ContactRows::fill(const StepBegin& begin, std::span<const Configuration> places,
                       const Configuration& last, BlockSpan blocks) {
  search_.find(begin.at, contacts_);
  if (may_wait()) waiting_.take(places, contacts_);
  const bool none =
      std::all_of(contacts_.begin(), contacts_.end(), [](const auto& list) { return list.empty(); });
  if (none && row_count(blocks) == 0) {
    recovering_ = false;
    return false;
  }
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
      take_seed(last, contacts[i], block, i);
      apart = apart && contacts[i].target == 0;
    }
    block.divide(begin.inverse_mass, block.chunks.threads, true);
    others |= block.node != before;
  });
  if (apart) recovering_ = false;
  return others;
}

}  // namespace pbd
