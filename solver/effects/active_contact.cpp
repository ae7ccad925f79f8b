#include "effects/active_contact.h"

#include "rows/row_block.h"

namespace pbd {
namespace {

/// Where what acts on a side of a meeting would be, if it only moved and did not turn.
Vec3 meeting_place(const ActiveContact& contact, int side, const Configuration& at) {
  const int carrier = contact.carrier[side];
  if (side == contact.triangle_side) {
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < 3; ++k) sum += contact.meeting->weight[k] * at.x.col(contact.triangle.node[k]);
    return sum;
  }
  if (side == contact.node_side) return at.x.col(carrier);
  return at.pose[carrier].x + contact.meeting->on_way.arm[side];
}

Touching meeting_at(const ActiveContact& contact, const Configuration& at) {
  const Meeting& meeting = *contact.meeting;
  Touching found{meeting.offset, meeting.normal, meeting_place(contact, 0, at),
                 meeting_place(contact, 1, at)};
  found.gap += meeting.normal.dot(found.point_a - found.point_b);
  for (const int side : {0, 1}) {
    if (side == contact.node_side || side == contact.triangle_side) continue;
    const Vec3 turn = meeting.turn_per_arc[side] * arc_of(contact.carrier[side], at);
    found.gap += (side == 0 ? 1 : -1) * meeting.normal.dot(turn.cross(meeting.on_way.arm[side]));
  }
  return found;
}

}  // namespace

Touching touching_at(const ActiveContact& contact, const Configuration& at) {
  if (contact.meeting) return meeting_at(contact, at);
  const Frame a = frame_of(contact, 0, at), b = frame_of(contact, 1, at);
  if (contact.triangle_side < 0) return touching(contact.features, a, b);
  ContactPoint features = contact.features;
  follow(contact.triangle, at.x, contact.triangle_side, features);
  return touching(features, a, b);
}

bool beside_features(const SurfaceContact& contact, const SurfaceTouching& found) {
  constexpr double most = 1;
  return !on_features(found, contact.kind, most);
}

double gap_at(const ActiveContact& contact, const Configuration& at) {
  if (!contact.of_surfaces) return touching_at(contact, at).gap;
  const SurfaceTouching found = touching(contact.surface, at.x);
  return beside_features(contact.surface, found) ? infinity : found.gap;
}

double largest_coordinate(const ActiveContact& contact, const Touching& found, const Configuration& at) {
  double most = std::max(found.point_a.cwiseAbs().maxCoeff(), found.point_b.cwiseAbs().maxCoeff());
  if (contact.of_surfaces) return most;
  for (const int side : {0, 1})
    most = std::max(most, frame_of(contact, side, at).origin.cwiseAbs().maxCoeff());
  return most;
}

template <class Block>
Touching evaluate(const ActiveContact& contact, const Configuration& at, typename Block::Jacobian& jacobian) {
  if constexpr (Block::nodes == 4)
    if (contact.of_surfaces) {
      const SurfaceTouching found = touching(contact.surface, at.x);
      const Directions<Block::rows> directions = directions_of<Block::rows>(found.normal, contact.reference);
      for (int k = 0; k < 4; ++k) jacobian.template middleCols<3>(3 * k) = found.weight[k] * directions;
      const Vec3 point = found.point - contact.surface.radius * found.normal;
      return {found.gap, found.normal, point, point - found.gap * found.normal};
    }
  Touching found = touching_at(contact, at);
  const Directions<Block::rows> directions = directions_of<Block::rows>(found.normal, contact.reference);
  const Vec3 place = place_of(contact, found);
  for (const int side : {0, 1}) {
    const int column = 3 * column_of<Block>(contact, side);
    const double sign = side == 0 ? 1 : -1;
    if constexpr (Block::nodes == 5)
      if (side == contact.triangle_side) {
        const Vec3 weight =
            contact.meeting ? contact.meeting->weight : weights_at(contact.triangle, at.x, place);
        for (int k = 0; k < 3; ++k) jacobian.template middleCols<3>(3 * k) = sign * weight[k] * directions;
        continue;
      }
    jacobian.template middleCols<3>(column) = sign * directions;
    if (side == contact.node_side) continue;
    const Pose& pose = at.pose[contact.carrier[side]];
    const Vec3 arm = contact.meeting ? contact.meeting->on_way.arm[side] : Vec3(place - pose.x);
    jacobian.template middleCols<3>(column + 3) =
        -sign * directions * cross_matrix(arm) *
        (contact.meeting ? contact.meeting->turn_per_arc[side] : pose.turn_per_arc);
  }
  return found;
}

template Touching evaluate<RowBlock<1, 3>>(const ActiveContact&, const Configuration&,
                                           RowBlock<1, 3>::Jacobian&);
template Touching evaluate<RowBlock<3, 3>>(const ActiveContact&, const Configuration&,
                                           RowBlock<3, 3>::Jacobian&);
template Touching evaluate<RowBlock<1, 4>>(const ActiveContact&, const Configuration&,
                                           RowBlock<1, 4>::Jacobian&);
template Touching evaluate<RowBlock<3, 4>>(const ActiveContact&, const Configuration&,
                                           RowBlock<3, 4>::Jacobian&);
template Touching evaluate<RowBlock<1, 5>>(const ActiveContact&, const Configuration&,
                                           RowBlock<1, 5>::Jacobian&);
template Touching evaluate<RowBlock<3, 5>>(const ActiveContact&, const Configuration&,
                                           RowBlock<3, 5>::Jacobian&);

}  // namespace pbd
