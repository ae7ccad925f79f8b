// Which contacts a step has. Where it begins, the shapes that may touch in it give contact points
// (collision/), each a pair of features carried by a body or a node. Shapes take part that are nearer than
// their motions go: to the free motion's end, and where a solved iterate went farther, a quarter farther than
// that. A motion is told from its course, where velocities take it, with a quarter of it to spare, so that
// what flies side by side is not near for all of its speed. What is near by far less than its motion, and
// touches neither where the step begins nor where its free motion ends, waits without rows
// (waiting_contacts.h). Of surfaces what lies beside its features waits, whatever its gap; what then passes
// is found late. Contacts of two bodies' shapes have no rows either where another plane parts these, however
// the features meet (needless_contacts.cpp): such pairs are looked at again where a solved step ends.
//
// Why nothing is missed: a point of a body at most r from its centre moves by at most |shift| + r |turn|, the
// chord being shorter than the arc. A gap therefore falls in a step by at most what both sides travel beside
// their courses, and the courses against each other, and what is generated is every feature whose gap is
// less. A half space has no r: its travel is that of its points within the other's reach. Which features lie
// lowest changes as bodies turn: those of meshes are told by how much; other shapes write all corners of the
// faces that meet. A body that is stopped on one side turns although it goes no farther: it is expected to
// turn by its travel over r at least.
//
// What a contact's features miss as shapes pass each other's edges and corners is second order in their
// travel T: a ball of radius r that goes round an edge and is as far from it as before may be T^2/(8 r) deep
// in the face behind. Pairs that go so far that sixteen times this (rims that turn over sides) takes them
// deeper than is overlooked are looked at again where the solved step ends, and what overlaps there by more
// than that, and by more than where the step began, joins the step's contacts; not on a half space, all of
// whose contacts are exact as bodies move. Pairs that begin deeper are looked at again in every step: bodies
// that a contact has left are to part as far as their first contacts asked.
// Overlooked is the tolerance's share of r, but 1e-6 r at least and 1e-4 r at most, and 1e-4 r under
// continuous contact. Of polyhedra r is half their least width. Sixteen is no bound: it is measured, and
// random steps hold to it (tests/solver/contact_motion.cpp). Of meshes that begin in others the depth is what
// generate.h says of them, which may be too large; a triangle that begins cut by one may end cut by other
// features, none deeper than it began, and what the step's tolerance leaves of r is overlooked of it.
//
// Under continuous contact a pair is followed on its way to where a solved iterate ends. What it meets there
// joins the step, where it is no farther apart than 3e-4 r, as a `Meeting` (active_contact.h): a row that is
// linear, and asks of the end that what met goes no nearer than it was. Of what meets on one way that joins
// which meets first, and what meets less than a round radius later: what comes after may be missed for it.
// A pair that a meeting pushes, and that comes nowhere near on the way of a solved iterate, is tried without,
// once: if either of it meets something then, it is held again. What goes farther against each other than it
// is round has, from there on, no other contacts than what it meets, or touches where the step begins:
// features that are carried about by what turns tell nothing of a way.
//
// Where nothing was near at all, boxes many times their motions apart say for how long that holds: until then
// no step is searched (clearance.h). So it is of surfaces by themselves (`SurfaceSearch`).
//
// A contact goes on as a plane or a line where its features end. One that touches in a solved iterate beside
// one of its shapes, by more than the tolerance's share of r there, leaves the step, unless the shapes have
// it there, as those that lie corner on corner do; and so does one of convex shapes of which one is round
// where these have come to be in each other by other features, or along its normal. Its pair is looked at
// again from then on, along the way from the start, too, so that nothing thin is passed for it. What takes
// its place is as far apart there as it is: what slides under the convex law hovers. A contact of two edges
// that is stated as a plane, and acts or touches, is stated as the edges where these cross at the end; if
// they do not cross, it leaves. Of deformable surfaces only what acts farther beside its features than these
// are long leaves; what then passes or overlaps is found where the step ends.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "collision/bounds.h"
#include "collision/broad_phase.h"
#include "collision/generate.h"
#include "collision/surface_search.h"
#include "effects/active_contact.h"
#include "effects/allowed_pairs.h"
#include "effects/clearance.h"
#include "effects/collider_motion.h"
#include "effects/searched_pairs.h"

namespace pbd {

/// A step whose contacts are searched for.
struct SearchedStep {
  const Bodies& bodies;
  const Configuration& start;
  const Points& straight;  // where courses end
  const Points& free;      // where the free motion ends
  const std::vector<double>& inverse_mass;
  double tolerance;  // of the step's scale
  int threads;       // that pairs and surfaces are searched on
};

class ContactSearch {
 public:
  ContactSearch(const Scene& scene, const Contact& effect);

  /// Places the colliders where a step begins; they go as far as to the free motion's end.
  void begin(const SearchedStep& step);

  /// True if some collider goes farther to x than was thought of; it is thought to go a quarter farther then.
  bool extend(const SearchedStep& step, const Points& x);

  /// The contacts of what is as near as that.
  void find(const Configuration& start, ContactLists& contacts);

  /// True if `find` will give other contacts, where a step is solved by these to `tolerance` and ends at
  /// `end`: some act where their features have parted, or pairs overlap as none tells.
  bool look_again(const Configuration& start, const Configuration& end, const Configuration& free,
                  double tolerance, const ContactLists& contacts);

  /// Of pairs that begin apart and meet on the way to `end`, or begin in touch and cut into each other:
  /// lowers the shares of it that the columns of both may go to one at which they are apart. True if any is
  /// lower.
  bool hold_back(const Bodies& bodies, const Configuration& start, const Configuration& end,
                 std::vector<double>& share);

  /// True if `find` will give other contacts: some of these pass, and their pairs meet by other features on
  /// the way of the free motion.
  bool find_met(const Configuration& start, const Configuration& free, const ContactLists& contacts);

  /// The share of the way from `start` to `end` at which the gap of a face closes, looked for at one at first
  /// and from there on: none if it does not. Of other contacts the first one.
  std::optional<double> closes_at(const ActiveContact& contact, const Configuration& start,
                                  const Configuration& end, double first);

  /// What a contact of surfaces names a node's side: the node, if it is a sphere, else that of a surface's,
  /// behind the colliders and nodes of the effect.
  int side_of_surface(int node) const;

  /// True if what touches of a contact is on both shapes at a share of the way.
  bool on_features(const ActiveContact& contact, const Configuration& start, const Configuration& end,
                   double share);

 private:
  /// How deep surfaces may be in each other that are not looked at again, of half their thickness: far less
  /// than what has passed.
  static constexpr double overlooked_of_surfaces = 1e-4;
  static constexpr double least_beside = 1e-9;  // what lies edge on edge comes and goes by rounding
  static constexpr double wary = 16;            // times what a ball makes of its travel: measured, see above
  static constexpr int most_places = 10000;     // of a way: a hundred sizes take some hundred
  static constexpr double clipped_unseen = 0.01;  // of the radius: half of that is what may be cut unseen
  static constexpr double room = search_room;     // so that few steps are searched anew
  static constexpr double near = 0.5;             // of a way: what is farther may wait

  using Motion = ColliderMotion;

  using Pair = FarPair;
  using Met = MetPair;

  // How far colliders go: contact_motion.cpp, with begin and extend.
  void set_out(const SearchedStep& step);
  void set_surfaces_out(const SearchedStep& step);
  bool extend_colliders(const SearchedStep& step, const Points& x);
  void place_colliders(const Bodies& bodies, const Configuration& start,
                       const std::vector<double>& inverse_mass);
  Vec3 shift_of(const Motion& motion, const Bodies& bodies, const Points& start, const Points& to) const;
  Displacement displacement(const Motion& motion, const Bodies& bodies, const Configuration& start,
                            const Points& to) const;
  /// As the effect counts them.
  int first_triangle() const { return static_cast<int>(effect_.collider.size() + effect_.node.size()); }
  ActiveContact of_surfaces(const SurfaceContact& found, Eigen::Index nodes) const;
  void add_surfaces(Eigen::Index nodes, ContactLists& contacts);
  bool see_passed(const Points& start, const Points& end, const ContactLists& contacts);
  bool may_touch(int first, int second) const;
  AxisBox box_of(const Motion& motion, const Points& x) const;
  void search(const Configuration& start);
  void search_colliders(const Configuration& start);
  bool is_above(int first, int second) const;
  void look_for_clearance(const Configuration& start);
  void search_pair(int first, int second, const Configuration& start, SearchTask& task) const;
  void search_meetings(int first, int second, const Configuration& start, SearchTask& task) const;
  void search_nodes(int first, int second, const Points& x, SearchTask& task) const;
  void search_asked(const Configuration& start);
  void add_pair(const NearPair& pair, std::span<const ActiveContact> near, ContactLists& contacts);
  ActiveContact active(const ContactPoint& point, int first, int second,
                       const RoundedTriangle& triangle) const;
  std::vector<ActiveContact>::iterator late_contact(const PairFeatures& features);
  Frame placed_frame(int collider, const Configuration& at) const;
  void find_points(const std::array<int, 2>& pair, const Frame& at_first, const Frame& at_second,
                   const Reach& reach, PairPoints& points) const;
  /// m, with the frames of the pair in the order of the colliders.
  static double gap_of(const ContactPoint& point, const Frame& at_first, const Frame& at_second);

  // Triangles of deformable surfaces, the second ones of their pairs: triangle_contacts.cpp.
  void place_triangle(const Points& x, const std::vector<double>& inverse_mass, Motion& motion) const;
  Displacement triangle_displacement(const Motion& motion, const Points& from, const Points& to) const;
  std::array<Vec3, 3> corners(const Motion& motion, const Points& x) const;
  void name_by_scene(const Motion& triangle, ActiveContact& contact) const;
  bool nearest_of_surface(const ActiveContact& contact, const Configuration& at) const;
  void keep_each_once(std::vector<ActiveContact>& contacts);

  // Contacts that another plane makes needless: needless_contacts.cpp.
  PairPlane plane_along(const std::array<int, 2>& pair, const Vec3& normal, double overlooked) const;
  void add_to_planes(const Touching& contact, const std::array<int, 2>& pair, double overlooked,
                     PairPoints& points) const;
  void find_parting(const PairPlane& plane, const std::array<int, 2>& pair, double overlooked,
                    PairPoints& points) const;
  void find_needless(std::span<ActiveContact> contacts, const Configuration& start, PairPoints& points) const;

  // Late contacts: late_contacts.cpp, passing_contacts.cpp for ways, and meetings.cpp for what meets on them.
  // The way between is straight, and turns by one angular velocity.
  static Vec3 turn_between(int body, const Configuration& start, const Configuration& end);
  double way_between(const Pair& pair, const Configuration& start, const Configuration& end) const;
  static Pose pose_between(int body, const Configuration& start, const Configuration& end, double share);
  Frame frame_between(int collider, const Configuration& start, const Configuration& end, double share) const;
  double generate_between(const Pair& pair, const Configuration& start, const Configuration& end,
                          double share, double reach);
  void keep_overlapping(const Pair& pair, const Configuration& start, const Configuration& end,
                        double allowed, double behind);
  bool begins_cut(const Pair& pair) const;
  bool goes_round_apart(const Pair& pair, double slack) const;
  bool is_convex(int collider) const;
  bool is_round(int collider) const;
  void keep_deepening(const Pair& pair, const Configuration& start, const Configuration& end, double allowed);
  /// True of what goes farther against each other than it is round: it is held by what meets on its way
  /// alone.
  bool is_fast(const Motion& one, const Motion& two) const;
  double gap_between(const Pair& pair, const Configuration& start, const Configuration& end, double share,
                     double reach, double slack);
  void keep_meetings(const Pair& pair, const Configuration& start, const Configuration& end, double share,
                     double allowed);
  bool find_meetings(const Pair& pair, const Configuration& start, const Configuration& end, double allowed,
                     double slack);
  static void meet(const Configuration& at, const Configuration& start, const Configuration& end,
                   double share, ActiveContact& contact);
  Configuration placed_between(const ActiveContact& contact, const Configuration& start,
                               const Configuration& end, double share);
  bool passes_round(const ContactPoint& point, const Pair& pair, const Configuration& start,
                    const Configuration& end) const;
  enum class Cut { none, in, through };
  Cut cut_on_way(const Pair& pair, const Configuration& start, const Configuration& end, double slack);
  bool find_passed(const Pair& pair, const Configuration& start, const Configuration& end, double slack,
                   Cut cut);
  bool meets(const Pair& pair, const Configuration& start, const Configuration& end, double allowed,
             double slack);
  double last_apart(const Pair& pair, const Configuration& start, const Configuration& end, double behind);
  double entering(const Pair& pair, const Configuration& start, const Configuration& end, double behind,
                  double apart, double& overlapping);
  bool find_overlapping(const Pair& pair, const Configuration& start, const Configuration& end);
  void add_late(const ActiveContact& found, double target);
  void add_first_met();
  bool let_go();
  bool is_of_tried(const Pair& pair) const;
  static double bent(const ActiveContact& contact, const Configuration& end);
  void see_contacts(const Configuration& end, const ContactLists& contacts);
  bool is_told(const ActiveContact& found, const Configuration& at);
  bool see_overlaps(const Configuration& start, const Configuration& end, const ContactLists& contacts);

  // Contacts that leave their features: left_contacts.cpp.
  double beside(const std::array<int, 2>& pair) const;
  bool on_shape(int collider, const Vec3& point, const Configuration& at, double slack,
                PairPoints& points) const;
  bool on_shapes(const ActiveContact& contact, const Configuration& at, double slack,
                 PairPoints& points) const;
  bool on_shapes(const ActiveContact& contact, const Configuration& at);
  double apart_along_normal(const ActiveContact& contact, const Configuration& at) const;
  bool is_nearest(const ActiveContact& contact, const Configuration& start, const Configuration& end);
  bool is_left(const PairFeatures& features) const;
  void restate(const ActiveContact& contact, const Configuration& start, ActiveContact stated);
  bool is_same(const ActiveContact& one, const ActiveContact& two, const Configuration& at);
  static bool is_crossing_as_plane(const ActiveContact& contact);
  std::optional<ActiveContact> stated_at(const ActiveContact& contact, const Configuration& start,
                                         const Configuration& end);
  Pair begun(const std::array<int, 2>& colliders, const Configuration& start);
  bool agree(const ActiveContact& one, const ActiveContact& two, const Configuration& at, double slack) const;
  static double hovering(const std::vector<ActiveContact>& contacts, const Configuration& at);
  void keep_parted(const Configuration& start, const Configuration& end,
                   std::vector<ActiveContact>& contacts);
  void add_touching(const std::vector<ActiveContact>& left, const Configuration& start,
                    const Configuration& end, const Configuration& free);
  bool is_left(const SurfaceContact& contact) const { return left_surfaces_.contains(contact.features()); }
  bool leaves(const ActiveContact& contact, const Points& x) const;
  bool drop_left_surfaces(const Points& x, const ContactLists& contacts);
  bool drop_left(const Configuration& start, const Configuration& end, const Configuration& free,
                 const ContactLists& contacts);

  const Contact& effect_;
  AllowedPairs allowed_;
  Clearance clearance_;
  // Of this step: nothing of them is placed, and nothing found.
  bool colliders_clear_ = false, surfaces_clear_ = false;
  std::vector<Motion> motions_;
  bool searched_ = false;  // `near_` holds what is as near as motions go
  std::vector<NearPair> near_pairs_;
  std::vector<ActiveContact> near_;
  std::vector<NearPair> pairs_before_;
  std::vector<ActiveContact> near_before_;
  std::vector<Pair> far_;                        // those that go far in this step
  std::map<std::array<int, 2>, double> parted_;  // m, of pairs that begin deep, the least gap first asked for
  std::vector<ActiveContact> late_;              // and what is restated
  std::uint64_t meetings_ = 0;                   // so far: each has a name of its own
  double touching_ = 0, inside_ = 0;             // shares of a way at which `meets` found a pair so
  double least_ = 0;               // m, gap of a pair on the way that `meets` walked, if it is pushed
  double apart_ = 0;               // the last share of a way that `meets` walked at which the pair was apart
  double overlooked_ = 0;          // depth of pairs that are not looked at again, of their r
  double besides_ = least_beside;  // that a contact may touch a shape beside it, of the same radius
  std::set<PairFeatures> left_;    // whose contacts acted in this step where they are not
  std::set<std::pair<SurfaceContact::Kind, std::array<int, 4>>>
      left_surfaces_;                        // likewise, or passed without rows
  std::vector<std::array<int, 2>> dropped_;  // pairs that contacts have just left
  Points between_x_;  // m, on the way of a contact's carriers; the others' are of no use
  std::vector<Pose> between_pose_;
  std::vector<ActiveContact> overlapping_;
  std::vector<Met> met_;
  std::set<std::array<int, 2>> tried_;  // pairs, without their meetings, in this step
  std::vector<ActiveContact> held_;     // the meetings of the one that is tried
  std::vector<MovingBox> boxes_;
  BroadPhase broad_phase_;
  PairPoints points_;
  int threads_ = 1;
  std::vector<std::array<int, 2>> asked_;  // pairs that are searched
  std::vector<SearchTask> tasks_;
  std::vector<NearView> views_;  // of pairs found before or now
  std::vector<TriangleName> names_;
  std::optional<SurfaceSearch> surfaces_;
  SurfaceReach surface_reach_;
  std::vector<int> side_;  // of each node where there are surfaces: as a sphere, or one of its triangles
  std::vector<SurfaceContact> surface_contacts_;
  std::vector<PassedContact> passed_, late_surfaces_;  // as `late_`
  bool surfaces_grown_ = false;                        // their nodes go farther than they were searched for
};

}  // namespace pbd
