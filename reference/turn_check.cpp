// Where the bodies of joints went on the way of an Euler step, each by its own steady turn.
#include <cmath>
#include <numbers>
#include <optional>

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

  /// rad, that b turns about a's axis; none where its reference passes this so near that rounding tells how.
  std::optional<double> twist() const {
    double sum = 0;
    for (int k = 0; k < places_; ++k) {
      const auto twist = twist_between(share(k), share(k + 1));
      if (!twist) return std::nullopt;
      sum += *twist;
    }
    return sum;
  }

 private:
  double share(int k) const { return static_cast<double>(k) / places_; }

  /// In halves where it is more than the bodies turn there: near its axis a reference goes about it fast.
  std::optional<double> twist_between(double from, double to) const {
    constexpr double least = 1e-6;  // of a unit vector: the angle about the axis is known to 1e-10 there
    if (!(across(from) > least && across(to) > least)) return std::nullopt;
    const double twist = std::remainder(value(to)[0] - value(from)[0], 2 * std::numbers::pi);
    if (!(std::abs(twist) > apart)) return twist;
    const double middle = from + (to - from) / 2;
    const auto first = twist_between(from, middle);
    if (!first) return std::nullopt;
    const auto second = twist_between(middle, to);
    return second ? std::optional(*first + *second) : std::nullopt;
  }

  /// Length of the part of b's reference across a's axis.
  double across(double share) const {
    const auto turned = [&](std::size_t side, const Vec3& own) {
      const auto world = frame(side, share).turned(own);
      return Vec3(world[0], world[1], world[2]);
    };
    return turned(0, joint_.axis[0]).cross(turned(1, joint_.reference[1])).norm();
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
      const auto twist = way.twist();
      if (!twist) {
        findings.leave_out("turns: references that pass their axis");
        continue;
      }
      constexpr double half_turn = std::numbers::pi * (1 + step_rounding);
      const double turned = *twist - joint.rate * claim.h, begin = way.value(0)[0];
      findings.require("turns", model.name[row] + ", other than it drives, rad", std::abs(turned), half_turn);
      const auto& [lower, upper] = model.bounds[row];
      const bool at_jump = std::abs(begin) > std::numbers::pi * (1 - step_rounding);
      if ((lower == 0) != (upper == 0) && !at_jump)  // half a turn from it, it is on the other side at once
        findings.require("turns", model.name[row] + ", from its stop, rad", std::abs(begin + turned),
                         half_turn);
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
