#include "damping.h"

#include "dense.h"
#include "error.h"

namespace pbd::reference {
namespace {

/// 1 + T/h of a constraint of `rows` rows, T by the moduli of both stresses where it is a strain.
Eigen::MatrixXd slowed(const Effect& effect, int constraint, int rows, double h) {
  Eigen::MatrixXd one = Eigen::MatrixXd::Identity(rows, rows);
  return std::visit(
      [&]<class E>(const E& own) -> Eigen::MatrixXd {
        if constexpr (std::is_same_v<E, TetStrain>) {
          return one + solve(Eigen::MatrixXd(elasticity(own.material)),
                             Eigen::MatrixXd(elasticity(*own.damping) / h));
        } else if constexpr (std::is_same_v<E, TriangleStrain>) {
          return one + solve(Eigen::MatrixXd(membrane(own.material, own.thickness)),
                             Eigen::MatrixXd(membrane(*own.damping, own.thickness) / h));
        } else if constexpr (std::is_same_v<E, PointJoint> || std::is_same_v<E, Attachment>) {
          throw SetupError(E::name, "damping", "none: its value is then that in a body's frame");
        } else if constexpr (requires { own.damping; }) {
          return (1 + own.damping[static_cast<std::size_t>(constraint)] / h) * one;
        } else {
          return one;
        }
      },
      effect);
}

}  // namespace

std::map<int, Damping> damping_of(const Scene& scene, const RigidModel& undamped, const Placement& start,
                                  double h) {
  std::map<int, Damping> all;
  const Vector value = values_at(undamped, start);
  const auto add = [&](int effect, int constraint, int row, int rows) {
    const Effect& stated = scene.effects[static_cast<std::size_t>(effect)];
    if (!damped(stated)) return;
    const Eigen::MatrixXd share = inverse(slowed(stated, constraint, rows, h));
    const RowVector from = value.segment(row, rows);
    all[row] = {share, from - share * from};
  };
  for (std::size_t i = 0; i < undamped.element_row.size(); ++i) {
    const Element& element = undamped.nodes.elements[i];
    add(element.effect, element.entry, undamped.element_row[i], element.rows);
  }
  int effect = -1, entry = 0;
  for (const Joint& joint : undamped.joints) {
    entry = joint.effect == effect ? entry + 1 : 0;
    effect = joint.effect;
    add(effect, entry, joint.row, joint.rows);
  }
  return all;
}

}  // namespace pbd::reference
