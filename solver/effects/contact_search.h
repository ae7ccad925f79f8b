// Which contacts a step has. Where it begins, the shapes that may touch in it give contact points
// (collision/), each a pair of features carried by a body or a node. Shapes take part that are nearer than
// their motions go: to the free motion's end, and where a solved iterate went farther, twice as far as that.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "collision/bounds.h"
#include "collision/broad_phase.h"
#include "collision/generate.h"
#include "effects/active_contact.h"

namespace pbd {

/// Contacts of bodies with friction and without, of nodes with bodies, of surfaces.
enum ContactGroup : std::size_t {
  bodies_rough,
  bodies_smooth,
  nodes_rough,
  nodes_smooth,
  surfaces_rough,
  surfaces_smooth,
  contact_groups
};
using ContactLists = std::array<std::vector<ActiveContact>, contact_groups>;

class ContactSearch {
 public:
  ContactSearch(const Scene& scene, const Contact& effect);

  /// Places the colliders where a step begins; they go as far as to `free`, the free motion's end.
  void begin(const Bodies& bodies, const Configuration& start, const Points& free,
             const std::vector<double>& inverse_mass);

  /// True if some collider goes farther to x than was thought of; it is thought to go twice as far then.
  bool extend(const Bodies& bodies, const Configuration& start, const Points& x);

  /// The contacts of what is as near as that.
  void find(const Configuration& start, ContactLists& contacts);

 private:
  struct Motion {        // of a collider in this step
    Shape node_shape;    // of a node
    const Shape* shape;  // in `frame`
    Frame frame;         // in the world
    int carrier = -1;    // body or node
    bool is_node = false;
    bool moves = false;  // by impulses
    double radius = 0;   // m, of the farthest point about the body's centre
    double travel = 0;   // m, that its points move at most
  };

  void place_colliders(const Bodies& bodies, const Configuration& start,
                       const std::vector<double>& inverse_mass);
  double displacement(const Motion& motion, const Bodies& bodies, const Configuration& start,
                      const Points& to) const;
  void add_surfaces(const Points& x, ContactLists& contacts);
  void add_pair(int first, int second, ContactLists& contacts);

  const Contact& effect_;
  std::vector<std::array<int, 2>> apart_;  // bodies that joints connect, or the effect names
  std::vector<Motion> motions_;
  std::vector<ContactPoint> found_;
  std::vector<MovingBox> boxes_;
  BroadPhase broad_phase_;
  CollisionScratch scratch_;
  std::optional<SurfaceSearch> surfaces_;
  std::vector<SurfaceContact> surface_contacts_;
  std::vector<double> travel_;  // m, of each node, where there are surfaces
};

}  // namespace pbd
