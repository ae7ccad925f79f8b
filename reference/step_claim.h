// What a solver says of one step, as plain data, and what a judge finds in it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "friction.h"
#include "scene.h"

namespace pbd::reference {

/// How the bodies and nodes of a contact stood to each other where they met on the way of a step: from their
/// centres to where they touched (m), and body to world; of surfaces nothing.
struct ClaimedMeeting {
  std::array<Vec3, 2> arm{Vec3::Zero(), Vec3::Zero()};
  std::array<Eigen::Matrix3d, 2> rotation{Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity()};
};

/// `force` (N) acts on a at `point` (m), its opposite on b; `normal` points from b to a. Numbers count
/// colliders, then the contact effect's nodes, then (of surfaces) the scene's nodes. What `met` on the way is
/// pushed there; `gap` goes on from there by the rates.
struct ClaimedContact {
  std::array<int, 2> collider{};
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ(), force = Vec3::Zero();
  double gap = 0;  // m
  std::optional<ClaimedMeeting> met{};
};

/// Of two colliders or nodes, by such numbers: unit vectors that part them, from the second to the first.
using WaysOut = std::map<std::array<int, 2>, std::vector<Vec3>>;

/// The step of h seconds from `start` to `end`. `forces`: of each effect the multipliers of its constraints
/// in their order, N for lengths, none of effects without; NaN for what is no row under explicit forces.
/// Those of axis and line joints are along Eigen's unitOrthogonal() of a's axis and the axis times that.
struct StepClaim {
  const Scene& scene;
  const State& start;
  const State& end;
  double h = 0;
  std::string_view integrator = "implicit_euler";
  Friction friction = Friction::coulomb;
  double direction_blend = 1;
  double tolerance = 0;  // of `scale`
  double scale = 0;      // sqrt(J), |v - v_l|_M + |v_free - v_l|_M; of implicit_euler StepCheck has its own
  std::vector<std::vector<double>> forces{};
  std::vector<ClaimedContact> contacts{};
};

/// A number that is above its bound, both in the unit of the check.
struct Finding {
  std::string check, what;
  double number = 0, bound = 0;
};

/// Empty `refuted`: nothing speaks against the step. `left_out` counts what could not be judged, by check and
/// reason.
struct Findings {
  std::vector<Finding> refuted;
  std::map<std::string, int> left_out;
  int compared = 0;

  /// NaN is refuted.
  void require(std::string_view check, const std::string& what, double number, double bound) {
    ++compared;
    if (!(number <= bound)) refuted.push_back({std::string(check), what, number, bound});
  }
  void leave_out(const std::string& check_and_reason) { ++left_out[check_and_reason]; }
};

}  // namespace pbd::reference
