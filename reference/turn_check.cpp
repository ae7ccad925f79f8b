// Where the bodies of joints went on the way of an Euler step, each by its own steady turn.
#include <cmath>
#include <numbers>

#include "joint_values.h"
#include "step_equations.h"

namespace pbd::reference {
namespace {

class Way {
 public:
  Way(const StepClaim& claim, const Joint& joint) : claim_(claim), joint_(joint) {
    double turn = 0;
    for (const int body : joint.body)
      if (body >= 0) turn += claim.h * claim.end.spin.col(body).norm();
    constexpr double fewest = 64, most = 1e5;
    places_ = static_cast<int>(std::clamp(turn / apart, fewest, most));
  }

  /// Of the joint at a share of the way, with what it asks for where the step begins.
  Vec3 value(double share) const {
    const auto found = joint_value<double>(joint_, frame(0, share), frame(1, share), claim_.start.time);
    Vec3 rows = Vec3::Zero();
    for (int k = 0; k < joint_.rows; ++k) rows[k] = found[static_cast<std::size_t>(k)];
    return rows;
  }

  double farthest_open() const {
    double most = 0;
    for (int k = 1; k < places_; ++k) most = larger(most, value(share(k)).norm());
    return most;
  }

  /// rad, that b turns about a's axis.
  double twist() const {
    double sum = 0;
    for (int k = 0; k < places_; ++k) sum += twist_between(share(k), share(k + 1), 20);
    return sum;
  }

 private:
  double share(int k) const { return static_cast<double>(k) / places_; }

  /// In halves where it is more than the bodies turn there: near its axis a reference goes about it fast.
  double twist_between(double from, double to, int halvings) const {
    const double twist = std::remainder(value(to)[0] - value(from)[0], 2 * std::numbers::pi);
    if (!(std::abs(twist) > apart) || halvings == 0) return twist;
    const double middle = from + (to - from) / 2;
    return twist_between(from, middle, halvings - 1) + twist_between(middle, to, halvings - 1);
  }

  JointFrame<double> frame(std::size_t side, double share) const {
    const int node = joint_.node[side], body = joint_.body[side];
    const Vec3 x = claim_.start.x.col(node) + share * (claim_.end.x.col(node) - claim_.start.x.col(node));
    Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
    if (body >= 0)
      q = turned_by(claim_.start.orientation[static_cast<std::size_t>(body)],
                    share * claim_.h * claim_.end.spin.col(body));
    return {{x.x(), x.y(), x.z()}, constant<double>(q)};
  }

  static constexpr double apart = 0.1;  // rad, between two places

  const StepClaim& claim_;
  const Joint& joint_;
  int places_;  // that are looked at
};

}  // namespace

void check_turns(const StepClaim& claim, const StepModel& model, Findings& findings) {
  const double right_angle = 1;                   // |c| of an axis or of two at right angles
  const double right_turn = std::numbers::sqrt2;  // of a rotation
  for (const Joint& joint : model.rigid.joints) {
    const auto row = static_cast<std::size_t>(joint.row);
    const Way way(claim, joint);
    if (joint.kind == JointKind::angle) {
      const double turned = way.twist() - joint.rate * claim.h;
      findings.require("turns", model.name[row] + ", other than it drives, rad", std::abs(turned),
                       std::numbers::pi);
      const auto& [lower, upper] = model.bounds[row];
      if ((lower == 0) != (upper == 0))  // at half a turn from it, it is on the other side at once
        findings.require("turns", model.name[row] + ", from its stop, rad",
                         std::abs(way.value(0)[0] + turned), std::numbers::pi * (1 + step_rounding));
    } else if (joint.compliance > 0) {
      continue;
    } else if (joint.kind == JointKind::axis || joint.kind == JointKind::perpendicular ||
               joint.kind == JointKind::rotation) {
      // A little less, as no place need be where it is open most.
      const double out = 0.99 * (joint.kind == JointKind::rotation ? right_turn : right_angle);
      findings.require("turns", model.name[row] + ", open on its way", way.farthest_open(),
                       std::max(out, 1.01 * way.value(0).norm()));
    }
  }
}

}  // namespace pbd::reference
