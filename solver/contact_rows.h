// Rows of contacts. Where a step begins, the shapes that may touch in it give contact points (contact/), each
// a pair of features carried by a body or a node; gap and normal n follow the iterates. Rows of a contact,
// with the velocities v of the map x(v) (integrators.h):
//   normal      (g(x) - min(0, g_l + recovery h)) / d, g the gap (m), g_l where the step begins
//               or, where shapes collide with restitution e in this step, by their free motion or as an
//               iterate has found, n . (u(v) + e u(v_l)), u the relative velocity of what touches (the
//               smaller of the two where they did not approach each other): with newmark and alpha = 1/2
//               energy is then kept for e = 1
//   tangential  t_j . u(v), two directions across n that follow it
// A contact without friction has the normal row alone. Impulses push along n and t at x, both bodies at one
// place: those of a face on one plane, through the point of the other body that is nearest to it; else in the
// middle of the gap.
#pragma once

#include <cstdint>
#include <optional>
#include <tuple>
#include <vector>

#include "contact/bounds.h"
#include "contact/broad_phase.h"
#include "contact/contact_point.h"
#include "contact/surface_contact.h"
#include "linearise.h"
#include "step.h"

namespace pbd {

/// One contact of a step.
struct ActiveContact {
  ContactPoint features;        // in the frames of its carriers
  std::array<int, 2> carrier;   // body or node of a and b
  std::array<int, 2> collider;  // as the effect counts them, nodes behind the shapes; of surfaces the
                                // node and a triangle's first one, or the edges' first ones
  int node_side = -1;           // 0 or 1 where a or b is a node
  bool of_surfaces = false;     // then `surface` is it, and there are no features
  SurfaceContact surface;
  Vec3 reference = Vec3::UnitX();  // the tangents are seen from this direction
  double nearest = 0;              // m, smallest gap of its pair
  double target = 0;               // m, the gap aimed at
  double restitution = 0;          // e where the shapes collide in this step, else 0
  bool closing = false;            // they approach each other where it begins
  ContactLaw law;                  // of its materials
  double offset = 0;               // m, of the gap by damping
  double compliance = 0;           // m/N, with damping's share
};

class ContactRows {
 public:
  ContactRows(const Scene& scene, Friction law, Rows& rows, std::vector<std::size_t>& effect_of_block);

  bool listed() const { return effect_ >= 0; }
  bool owns(std::size_t block) const { return listed() && block >= first_block_; }

  /// Finds the contacts of a step from `start`, of colliders as near as their free motions go, and fills the
  /// rows' blocks: impulses are those of the same contacts in the last step, or zero.
  void find(const Scene& scene, const Bodies& bodies, const Configuration& start, const Points& start_v,
            const StepMap& map, bool warm_start, const std::vector<double>& inverse_mass, Rows& rows);

  /// Finds the contacts anew if a collider has moved farther to x than was thought of; true if so: the rows
  /// are to be linearised again then.
  bool widen(const Scene& scene, const Bodies& bodies, const Configuration& start, const Points& x,
             const StepMap& map, Rows& rows);

  BlockResidual linearise(const Configuration& at, const Configuration* directions, const StepMap& map,
                          const Points& v, const std::vector<double>& inverse_mass, std::size_t block,
                          Rows& rows);

  /// As those of other effects (linearise.h).
  void add_geometric_inertia(const StepMap& map, const Configuration& at, double factor, const Rows& rows,
                             std::size_t block, std::vector<double>& inertia) const;
  void perturb(const StepMap& map, const Configuration& turned, const Points& v, double scale,
               const Points& error, const std::vector<double>& inverse_mass, std::size_t block, Rows& rows,
               Points& push) const;

  /// v += W J^T p of the contacts alone.
  void apply(const Rows& rows, const std::vector<double>& inverse_mass, Points& v) const;

  std::vector<ContactForce> forces(const Configuration& at, const StepMap& map, const Points& v,
                                   const Rows& rows) const;

 private:
  /// Blocks of contacts: of bodies with friction and without, of nodes with bodies, of surfaces.
  enum Group : std::size_t {
    bodies_rough,
    bodies_smooth,
    nodes_rough,
    nodes_smooth,
    surfaces_rough,
    surfaces_smooth,
    groups
  };

  struct Seed {  // of an impulse: what it was in the last step
    std::array<int, 2> collider;
    std::uint64_t key;
    Vec3 impulse;  // N s, on a, in the world

    auto name() const { return std::tie(collider, key); }
  };
  struct Motion {        // of a collider in this step
    Shape node_shape;    // of a node
    const Shape* shape;  // in `frame`
    Frame frame;         // in the world
    int carrier = -1;    // body or node
    bool is_node = false;
    bool moves = false;  // by impulses
    double radius = 0;   // m, of the farthest point about the body's centre
    double reach = 0;    // m, that its points move at most
  };

  struct Begin {  // of a step
    const Contact& effect;
    const Configuration& at;
    const StepMap& map;
    Points free_shift, own_shift;  // m, to the free motion's end and to x0
  };

  struct Linearisation {
    const Configuration& at;
    const Configuration* directions;
    const StepMap& map;
    const Points& v;
    const std::vector<double>& inverse_mass;
  };

  template <class Block>
  void linearise_contact(const Linearisation& to, ActiveContact& contact, Block& block, std::size_t i,
                         BlockResidual& sums) const;
  template <class Block>
  void begin_contact(const Begin& begin, ActiveContact& contact, Block& block, std::size_t i) const;
  void keep_impulses(const Rows& rows);
  void place_colliders(const Contact& effect, const Bodies& bodies, const Configuration& start,
                       const std::vector<double>& inverse_mass);
  double displacement(const Motion& motion, const Bodies& bodies, const Configuration& start,
                      const Points& to) const;
  void fill(const Contact& effect, const Bodies& bodies, const Configuration& start, const StepMap& map,
            Rows& rows);
  void add_surfaces(const Contact& effect, const Points& x);
  void add_pair(const Contact& effect, int first, int second);

  int effect_ = -1;
  std::size_t first_block_ = 0;
  std::vector<std::array<int, 2>> ignored_;  // bodies that joints connect, or the effect names
  std::vector<Motion> motions_;
  std::array<std::vector<ActiveContact>, groups> contacts_;
  std::vector<Seed> seeds_;
  std::vector<ContactPoint> found_;
  std::vector<MovingBox> boxes_;
  BroadPhase broad_phase_;
  std::optional<SurfaceSearch> surfaces_;
  std::vector<SurfaceContact> surface_contacts_;
  std::vector<double> reach_;  // m, of each node, where there are surfaces
  Points start_v_;             // m/s, where the step begins
  bool relaxed_ = false;       // the impulses are those of an iterate of this step
};

}  // namespace pbd
