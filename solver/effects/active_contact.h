// One contact of a step: its features, its directions (normal n and two tangents) and its columns. Impulses
// push along n and t at x, both bodies at one place: those of a face on one plane, as far off it as the
// pair's nearest contact is apart, or if it collides the face's nearest one; of a deformable triangle where
// its nodes take them up; else in the middle of the gap.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "collision/contact_point.h"
#include "collision/rounded_triangle.h"
#include "collision/surface_contact.h"
#include "rows/bodies.h"
#include "rows/costs.h"
#include "scene.h"

namespace pbd {

/// What has met on the way of a step that an iterate takes: its normal n and its arms are those of the place
/// where it was found, whatever turns later. The gap is linear in where the step ends, n . (x_a + t_a x arm_a
/// - x_b - t_b x arm_b) + offset, t the rotation by the arcs as they act at that place: its impulses act
/// there.
struct Meeting {
  Vec3 normal;        // unit, from b to a
  double offset = 0;  // m
  double left = 1;    // share of the way
  MetOnWay on_way;
  std::array<Eigen::Matrix3d, 2> turn_per_arc;  // 1/m, of a body there
  Vec3 weight;                                  // of a triangle's nodes
};

/// One contact of a step.
struct ActiveContact {
  ContactPoint features;        // in the frames of its carriers
  std::array<int, 2> carrier;   // body, node or triangle of a and b
  std::array<int, 2> collider;  // as the effect counts them, nodes behind the shapes, triangles behind these;
                                // of surfaces (not two spheres) the node and a triangle's first one, or the
                                // edges' first ones
  int node_side = -1;           // 0 or 1 where a or b is a node
  int triangle_side = -1;       // 0 or 1 where a or b is a triangle; `triangle` then tells what of it
  TriangleFeature triangle;
  bool of_surfaces = false;  // then `surface` is it, and there are no features
  SurfaceContact surface;
  bool between_surfaces = false;           // of triangles' nodes and edges alone, of no sphere
  std::shared_ptr<const Meeting> meeting;  // of what has met on the way: of `features` the key alone counts
  Vec3 reference = Vec3::UnitX();          // the tangents are seen from this direction
  double gap = 0;                          // m, where it was made linear
  double level = 0;                        // m, of the plane in which a face's impulses act
  double apart = infinity;                 // m, the gap from which it may wait (waiting_contacts.h)
  double target = 0;                       // m, the gap aimed at
  double rebound = 0;                      // m, the same where the shapes collide
  double bounce = 0;                       // e, if the shapes may collide in this step
  double restitution = 0;                  // e where they do, else 0
  double closing = 0;         // m/s, at which they approach each other where it begins; negative: part
  bool needless = false;      // without a row, until a solved iterate brings its shapes into each other
  bool late = false;          // seen where a solved iterate ended; `target` is set there
  bool restated = false;      // features are those where a solved iterate ended; it began the step
  std::uint64_t heir_of = 0;  // of a late one, the key of a contact of its pair whose impulse it goes on with
  bool passes = false;        // its features have parted where the free motion closes its gap
  bool acts = false;          // has more of an impulse than an iterate's tolerance where that ended
  ContactLaw law;             // of its materials
  bool conveys = false;       // a surface moves along itself
  std::array<Vec3, 2> surface_velocity{Vec3(0, 0, 0), Vec3(0, 0, 0)};  // m/s, so, in the bodies' frames
  double offset = 0;                                                   // m, of the gap by damping
  double compliance = 0;                                               // m/N, with damping's share

  std::array<int, 2> pair() const {
    return {std::min(collider[0], collider[1]), std::max(collider[0], collider[1])};
  }
};

template <int R>
using Directions = Eigen::Matrix<double, R, 3>;  // n, t1, t2 in rows

/// The normal, and for R = 3 two tangents seen from `reference`.
template <int R>
Directions<R> directions_of(const Vec3& normal, const Vec3& reference) {
  Directions<R> directions;
  directions.row(0) = normal.transpose();
  if constexpr (R == 3) {
    directions.row(1) = (reference - normal.dot(reference) * normal).normalized().transpose();
    directions.row(2) = normal.cross(Vec3(directions.row(1))).transpose();
  }
  return directions;
}

/// The axis of the world that lies best across `normal`, the first one where it does well enough.
inline Vec3 reference_for(const Vec3& normal) {
  constexpr double steep = 0.9;
  return std::abs(normal.x()) < steep ? Vec3::UnitX() : Vec3::UnitY();
}

inline Frame frame_of(const ActiveContact& contact, int side, const Configuration& at) {
  const int carrier = contact.carrier[side];
  if (side == contact.triangle_side) return {};
  if (side == contact.node_side) return {at.x.col(carrier), Eigen::Matrix3d::Identity()};
  const Pose& pose = at.pose[carrier];
  return {pose.x, pose.rotation};
}

/// A body's arc at `at`, from where the step begins (bodies.h), m.
inline auto arc_of(int body, const Configuration& at) {
  return at.x.col(at.x.cols() - std::ssize(at.pose) + body);
}

/// Of what has features or has met: not of surfaces.
Touching touching_at(const ActiveContact& contact, const Configuration& at);

/// True of surfaces that touch farther beside their features than these are long: of lines that are nearly
/// parallel the nearest points lie anywhere, and forces there grow with their distance. Never of a node and
/// an edge.
bool beside_features(const SurfaceContact& contact, const SurfaceTouching& found);

/// m, of any contact; infinite of surfaces that are beside their features.
double gap_at(const ActiveContact& contact, const Configuration& at);

/// Sets `level` of contacts of bodies and nodes, a pair's in a row. What collides ends apart, however near
/// other features of its pair are.
void find_levels(const Configuration& at, std::vector<ActiveContact>& contacts);

/// First of a side's columns among the row's K: a node's and a triangle's stand in front of their body's.
template <class Block>
int column_of(const ActiveContact& contact, int side) {
  if (Block::nodes == 4) return 2 * side;
  if (Block::nodes == 5) return side == contact.triangle_side ? 0 : 3;
  return side == contact.node_side ? 0 : 1;
}

/// Where impulses act, m: at one place of both, so that together they turn nothing; those of a face on one
/// plane, so that all its points can stick at once, however far from it each is.
inline Vec3 place_of(const ActiveContact& contact, const Touching& found) {
  if (contact.meeting && contact.triangle_side >= 0)
    return contact.triangle_side == 0 ? found.point_a : found.point_b;
  if (contact.triangle_side == 0) return found.point_a + contact.features.radius_a * found.normal;
  if (contact.triangle_side == 1) return found.point_b - contact.features.radius_b * found.normal;
  const bool on_face =
      !contact.of_surfaces && !contact.meeting && contact.features.kind == ContactPoint::Kind::face;
  return on_face ? Vec3(found.point_b + contact.level * found.normal)
                 : Vec3((found.point_a + found.point_b) / 2);
}

/// Largest coordinate of a contact, m.
double largest_coordinate(const ActiveContact& contact, const Touching& found, const Configuration& at);

/// Gap and normal of a contact, and its row's J. Of the blocks that contacts have.
template <class Block>
Touching evaluate(const ActiveContact& contact, const Configuration& at, typename Block::Jacobian& jacobian);

/// The directions in which the impulses of a row push a.
template <class Block>
Directions<Block::rows> directions_in(const ActiveContact& contact,
                                      const typename Block::Jacobian& jacobian) {
  if (contact.triangle_side == 0) return -jacobian.template middleCols<3>(3 * column_of<Block>(contact, 1));
  const int column = contact.of_surfaces ? 0 : 3 * column_of<Block>(contact, 0);
  Directions<Block::rows> directions = jacobian.template middleCols<3>(column);
  if (contact.of_surfaces && contact.surface.kind == SurfaceContact::Kind::edge_edge)
    directions += jacobian.template middleCols<3>(3);
  return directions;
}

/// Velocity of a's surface against b's by what moves along itself, in the world, m/s.
inline Vec3 conveyed(const ActiveContact& contact, const Configuration& at) {
  const auto own = [&](int side) -> Vec3 {
    return (contact.meeting ? contact.meeting->on_way.rotation[side] : frame_of(contact, side, at).rotation) *
           contact.surface_velocity[side];
  };
  return own(0) - own(1);
}

/// The nodes of a contact's rows.
template <class Block>
typename Block::Nodes columns_of_contact(const ActiveContact& contact, const Bodies& bodies) {
  typename Block::Nodes columns{};
  if constexpr (Block::nodes == 4)
    if (contact.of_surfaces) return contact.surface.node;
  for (const int side : {0, 1}) {
    const auto column = static_cast<std::size_t>(column_of<Block>(contact, side));
    const int carrier = contact.carrier[side];
    if (side == contact.triangle_side) {
      std::copy(contact.triangle.node.begin(), contact.triangle.node.end(), columns.begin());
      continue;
    }
    columns[column] = side == contact.node_side ? carrier : bodies.node(carrier);
    if (side != contact.node_side) columns[column + 1] = static_cast<int>(bodies.column(carrier));
  }
  return columns;
}

/// Contacts of bodies with friction and without, of nodes with bodies, of surfaces, of triangles with bodies.
enum ContactGroup : std::size_t {
  bodies_rough,
  bodies_smooth,
  nodes_rough,
  nodes_smooth,
  surfaces_rough,
  surfaces_smooth,
  triangles_rough,
  triangles_smooth,
  contact_groups
};
using ContactLists = std::array<std::vector<ActiveContact>, contact_groups>;

}  // namespace pbd
