#include "effects/contact_stiffness.h"

#include <algorithm>
#include <cmath>

#include "effects/joint_parts.h"

namespace pbd {
namespace {

/// A normal turns by at most |dx| over the height of its triangle, the shorter edge times the sine between
/// them, or the distance of node and edge: twice the impulse over that length.
double surface_bound(const SurfaceContact& contact, const Points& x, double impulse) {
  const auto at = [&](std::size_t k) -> Vec3 { return x.col(contact.node[k]); };
  const auto height = [](const Vec3& u, const Vec3& v) {
    return u.cross(v).norm() / std::max(u.norm(), v.norm());
  };
  double length = 0;
  switch (contact.kind) {
    case SurfaceContact::Kind::node_triangle:
      length = height(at(2) - at(1), at(3) - at(1));
      break;
    case SurfaceContact::Kind::edge_edge:
      length = height(at(1) - at(0), at(3) - at(2));
      break;
    case SurfaceContact::Kind::node_edge:
      length = touching(contact, x).gap + contact.thickness;
  }
  return length > 0 ? 2 * std::abs(impulse) / length : 0.0;
}

/// Likewise; of a point the shares of the nodes do not change.
double triangle_bound(const TriangleFeature& triangle, const Points& x, double impulse) {
  if (triangle.kind == TriangleFeature::Kind::point) return 0;
  const auto at = [&](int k) -> Vec3 { return x.col(triangle.node[k]); };
  const Vec3 u = at(1) - at(0), v = at(2) - at(0), w = at(2) - at(1);
  const double length = triangle.kind == TriangleFeature::Kind::edge
                            ? (at(triangle.ends[1]) - at(triangle.ends[0])).norm()
                            : u.cross(v).norm() / std::max({u.norm(), v.norm(), w.norm()});
  return length > 0 ? 2 * impulse / length : 0.0;
}

}  // namespace

template <class Block>
void add_contact_stiffness(const ActiveContact& contact, const StepMap& map, const Configuration& at,
                           double factor, const Block& block, std::size_t i,
                           std::vector<double>& added_mass) {
  if constexpr (Block::nodes == 4)
    if (contact.of_surfaces) {
      if (contact.surface.met) return;  // its rows are linear
      const double bound = surface_bound(contact.surface, at.x, factor * block.impulse[i].norm());
      for (const int node : block.node[i]) added_mass[node] += map.d / 2 * bound;
      return;
    }
  if (contact.meeting) return;  // its rows are linear
  const ContactPoint& features = contact.features;
  const Frame a = frame_of(contact, 0, at), b = frame_of(contact, 1, at);
  const Touching found = touching_at(contact, at);
  const double normal = factor * block.impulse[i][0];
  Vec3 tangential = Vec3::Zero();
  if constexpr (Block::rows == 3)
    tangential = factor *
                 directions_in<Block>(contact, block.jacobian[i]).template bottomRows<2>().transpose() *
                 block.impulse[i].template tail<2>();
  const bool turns = features.kind != ContactPoint::Kind::face;  // n, as the points move apart
  const double distance = found.gap + features.radius_a + features.radius_b;
  const double apart = turns && distance > 0 ? std::max(0.0, -normal) * 2 / distance : 0.0;
  for (const int side : {0, 1}) {
    const int column = column_of<Block>(contact, side);
    if (side == contact.triangle_side) {
      const double bound = apart + triangle_bound(contact.triangle, at.x, factor * block.impulse[i].norm());
      for (std::size_t k = 0; k < 3; ++k) added_mass[block.node[i][k]] += map.d / 2 * bound;
      continue;
    }
    const auto node = [&](int k) {
      return static_cast<std::size_t>(
          block.node[i][static_cast<std::size_t>(column) + static_cast<std::size_t>(k)]);
    };
    added_mass[node(0)] += map.d / 2 * apart;
    if (side == contact.node_side) continue;
    const Frame& own = side == 0 ? a : b;
    const Vec3 lever = own.rotation * (side == 0 ? features.point_a : features.point_b);
    const Vec3 arm = place_of(contact, found) - own.origin;
    const Vec3 push = (side == 0 ? normal : -normal) * found.normal;
    const Pose& pose = at.pose[contact.carrier[side]];
    const Eigen::Matrix3d turn = cross_matrix(lever);
    added_mass[node(1)] += map.d / 2 *
                           (largest_of(lever_form(push, lever) + apart * turn.transpose() * turn, pose) +
                            product_bound(pose, lever_form(tangential, arm), pose));
  }
}

template void add_contact_stiffness(const ActiveContact&, const StepMap&, const Configuration&, double,
                                    const RowBlock<3, 4>&, std::size_t, std::vector<double>&);
template void add_contact_stiffness(const ActiveContact&, const StepMap&, const Configuration&, double,
                                    const RowBlock<1, 4>&, std::size_t, std::vector<double>&);
template void add_contact_stiffness(const ActiveContact&, const StepMap&, const Configuration&, double,
                                    const RowBlock<3, 3>&, std::size_t, std::vector<double>&);
template void add_contact_stiffness(const ActiveContact&, const StepMap&, const Configuration&, double,
                                    const RowBlock<1, 3>&, std::size_t, std::vector<double>&);
template void add_contact_stiffness(const ActiveContact&, const StepMap&, const Configuration&, double,
                                    const RowBlock<3, 5>&, std::size_t, std::vector<double>&);
template void add_contact_stiffness(const ActiveContact&, const StepMap&, const Configuration&, double,
                                    const RowBlock<1, 5>&, std::size_t, std::vector<double>&);

}  // namespace pbd
