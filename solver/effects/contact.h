// Rows of contacts: one source among others. Which contacts a step has is found where it begins
// (contact_search.h); gap and normal n follow the iterates. Rows of a contact, with the velocities v of the
// map x(v) (integrators.h):
//   normal      (g(x) - min(0, max(g_l, g_0 + recovery d))) / d, g the gap (m), g_l where the step begins,
//               g_0 at x0: overlaps part at `recovery` at most and get no deeper. What yields (A > 0) is a
//               spring from g = 0 on instead. Sigma = A/(h d); a damper is met where the shapes touch. Where
//               shapes collide with restitution e in this step, the smaller of this and n . (u(v) + e
//               u(v_l)), u the relative velocity of what touches, in u(v_l) by a body's spin in its own axes:
//               what rolls sinks by the curvature of its path if it is kept from approaching alone. The gap
//               may then be the one to which that speed leads from x0: with newmark and alpha = 1/2 energy is
//               kept for e = 1
//   tangential  t_j . (u(v) + s), two directions across n that follow it, s the velocity at which surfaces
//               that move along themselves go against each other
// A contact without friction has the normal row alone. The law listed for a step is `Method::friction`.
//
// Features are those of the step's beginning, and of its end where something overlaps there or a contact has
// left its features: one that touches where its shapes are not (left_contacts.cpp) acts no more in the step.
//
// Limits: impulses act at a step's end alone, under newmark, too, on both bodies at one place, so that they
// turn nothing together. Nodes go through nodes that they pass in one step. Deformable surfaces touch each
// other by nodes over triangles and edges that cross, where the nearest points lie on them as the step
// begins, and by what they pass or overlap by where a solved iterate ends; the side is the one from which
// they come. What overlaps from the start stays on the wrong side. Bodies touch each
// triangle half a thickness from it, by all features of both; features that triangles share count once, and
// where a body is nearer to a triangle beside them, not at all. `thickness` should be well below the shortest
// edge; a crease so sharp that its triangles are nearer than that parts them by force, and such steps may not
// converge.
//
// What a missed step leaves overlapping, or a diverged one began with, parts by a tenth of that a step, and
// what forces move in one, until nothing overlaps: to part at once would throw it, by all the speed that has
// gone into the overlap. Surfaces in each other part by a tenth of their thickness a step at most
// (surface_contact.h).
//
// Restitution is Newton's. What approaches each other where the step begins collides if its free motion
// meets, by features that are there when their gap closes (that motion is without the gyroscopic torque where
// it is implicit; the gap closes by its rates where the step begins, that of a face also on the way); and
// whatever approached and touches in the solved step, but parts by less than e of its speed at the start:
// such are let collide, and the step is solved again, until there are no more. What parts where the step
// begins, and forces bring back in it, does not collide. So what collides depends on the velocities that
// solve a step, not on how a solver shares impulses among contacts; where friction leaves velocities open,
// what collides is open, too. A collision falls at its step's end: the speed that comes back is e times that
// at the step's start, g h too small at most, from a place up to v h above the ground: heights of rebounds
// are of first order in h. What one round has let collide does so for the rest of the step, solved or missed.
// What yields and is loaded where the step begins does not collide: its spring brings back what comes back.
#pragma once

#include <set>

#include "effects/contact_search.h"
#include "effects/contact_seeds.h"
#include "effects/waiting_contacts.h"
#include "rows/source.h"

namespace pbd {

class ContactRows final : public Source {
 public:
  ContactRows(const Scene& scene, const Contact& effect, Friction law);

  void allocate(bool hard_alone, BlockList& blocks) override;
  bool begin_step(const StepBegin& begin, BlockSpan blocks) override;
  Widened widen(const StepBegin& begin, const Configuration& reached, BlockSpan blocks) override;
  bool collide(ConstBlockSpan blocks, const Points& v, double accuracy) override;
  Impact impact(ConstBlockSpan, const Points&) const override { return impact_; }
  void linearise(const RowPlace& place, BlockSpan blocks, RowResidual& sums) override;
  void add_geometric_mass(const StepMap& map, const Configuration& at, double factor, ConstBlockSpan blocks,
                          std::vector<double>& added_mass) const override;
  void perturb(const RowError& error, BlockSpan blocks, Points& push) const override;
  bool hold_back(const StepBegin& begin, const Configuration& reached, std::vector<double>& share) override;
  void add_contact_forces(const StepMap& map, const Configuration& at, const Points& v, ConstBlockSpan blocks,
                          std::vector<ContactForce>& forces) const override;

 private:
  struct Shifts {  // m, from the step's start to the free motion's end, to x0, and by the step's forces
    Points free, own, forced;
  };
  struct FreeEnd {  // of the free motion
    Points x;
    std::vector<Pose> pose;
  };

  /// By the convex law what slides acts from afar.
  bool may_wait() const { return law_ != Friction::cone; }
  SearchedStep searched_step(const StepBegin& begin) const;
  void keep_impulses(ConstBlockSpan blocks);
  bool fill(const StepBegin& begin, std::span<const Configuration> places, const Configuration& last,
            BlockSpan blocks);
  template <class Block>
  double target_of(const StepBegin& begin, const Shifts& shifts, const ActiveContact& contact, double gap,
                   double shift, const Block& block, std::size_t i) const;
  template <class Block>
  void take_seed(const Configuration& at, const ActiveContact& contact, Block& block, std::size_t i) const;
  template <class Block>
  void begin_contact(const StepBegin& begin, const Shifts& shifts, ActiveContact& contact, Block& block,
                     std::size_t i);
  void look_ahead(const StepBegin& begin, double gap, double ahead, ActiveContact& contact);

  const Contact& effect_;
  Friction law_;
  ContactSearch search_;
  ContactLists contacts_, found_;
  WaitingContacts waiting_;
  ContactSeeds seeds_;
  int threads_ = 1;
  Points start_v_;                                                   // m/s, where the step begins
  Points straight_;                                                  // m, where that takes it by itself
  FreeEnd free_;                                                     // where the step's free motion ends
  std::set<std::pair<std::array<int, 2>, std::uint64_t>> collided_;  // pairs and features, by `collide`
  bool bounces_ = false;                                             // some law has restitution
  Impact impact_ = Impact::none;                                     // of this step
  bool recovering_ = false;  // from what missed steps have left overlapping
};

}  // namespace pbd
