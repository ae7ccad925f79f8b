#include "damping.h"

#include <algorithm>

#include "dense.h"
#include "error.h"
#include "step_rows.h"

namespace pbd::reference {
namespace {

/// 1 + T/d of a constraint of `rows` rows, T by the moduli of both stresses where it is a strain.
Eigen::MatrixXd slowed(const Effect& effect, int constraint, int rows, double d) {
  Eigen::MatrixXd one = Eigen::MatrixXd::Identity(rows, rows);
  return std::visit(
      [&]<class E>(const E& own) -> Eigen::MatrixXd {
        if constexpr (std::is_same_v<E, TetStrain>) {
          return one + solve(Eigen::MatrixXd(elasticity(own.material)),
                             Eigen::MatrixXd(elasticity(*own.damping) / d));
        } else if constexpr (std::is_same_v<E, TriangleStrain>) {
          return one + solve(Eigen::MatrixXd(membrane(own.material, own.thickness)),
                             Eigen::MatrixXd(membrane(*own.damping, own.thickness) / d));
        } else if constexpr (std::is_same_v<E, PointJoint> || std::is_same_v<E, Attachment>) {
          throw SetupError(E::name, "damping", "none: the judge does not know its value in a body's frame");
        } else if constexpr (requires { own.damping; }) {
          return (1 + own.damping[static_cast<std::size_t>(constraint)] / d) * one;
        } else {
          return one;
        }
      },
      effect);
}

/// Where everything that moves is a time later, at the velocities of the start.
Placement later(const State& start, double time) {
  Placement at = placement_of(start);
  at.x += time * start.v;
  for (std::size_t b = 0; b < at.orientation.size(); ++b)
    at.orientation[b] = turned_by(at.orientation[b], time * start.spin.col(static_cast<Eigen::Index>(b)));
  return at;
}

/// c0 of all rows.
Vector value_before(const RigidStep& step) {
  const RigidModel& model = step.model;
  const Placement start = placement_of(step.start);
  const Vector value = values_at(model, start);
  if (!step.map) return value;
  const IntegratorMap& map = *step.map;
  Vector before = value;
  if (map.share != 0) before += map.share * (value - values_at(model, *map.last));
  if (map.bend != 0)
    before += map.bend / (map.d * map.d) *
              (values_at(model, later(step.start, map.d)) - 2 * value +
               values_at(model, later(step.start, -map.d)));
  for (const Block& block : blocks_at(model, start, Coordinates::turns)) {
    const auto add = [&](int offset, const Vec3& way) {
      before.segment(block.row, block.rows()) += block.jacobian.middleCols<3>(offset) * way;
    };
    for (const Block::Part& part : block.parts) {
      add(part.offset, map.along * step.start.v.col(part.node));
      if (part.body >= 0) add(part.offset + 3, map.along * step.start.spin.col(part.body));
    }
    if (map.bend != 0)
      each_moving(model, block, [&](int unknown, int offset) {
        add(offset, map.bend * map.acceleration.segment<3>(unknown));
      });
  }
  return before;
}

}  // namespace

std::map<int, Damping> damping_of(const Scene& scene, const RigidStep& undamped) {
  std::map<int, Damping> all;
  if (std::none_of(scene.effects.begin(), scene.effects.end(), [](const Effect& own) { return damped(own); }))
    return all;
  const RigidModel& model = undamped.model;
  const Vector value = value_before(undamped);
  const auto add = [&](int effect, int constraint, int row, int rows) {
    const Effect& stated = scene.effects[static_cast<std::size_t>(effect)];
    if (!damped(stated)) return;
    const Eigen::MatrixXd share = inverse(slowed(stated, constraint, rows, undamped.d()));
    const RowVector from = value.segment(row, rows);
    all[row] = {share, from - share * from};
  };
  for (std::size_t i = 0; i < model.element_row.size(); ++i) {
    const Element& element = model.nodes.elements[i];
    add(element.effect, element.entry, model.element_row[i], element.rows);
  }
  int effect = -1, entry = 0;
  for (const Joint& joint : model.joints) {
    entry = joint.effect == effect ? entry + 1 : 0;
    effect = joint.effect;
    add(effect, entry, joint.row, joint.rows);
  }
  return all;
}

}  // namespace pbd::reference
