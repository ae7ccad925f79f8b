// Scenes of rigid bodies in contact that solvers are known to fail on.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "scenes/contacts.h"

namespace pbdcheck {

struct ContactCase {
  std::string name;
  pbd::Scene scene;
  double h;              // s
  double duration;       // s, after which what settles has settled
  double size;           // m, of the smallest body
  bool settles = true;   // at the end
  bool stays = false;    // where it starts: to a thousandth of `size`
  double lift = -1;      // m, that no centre may rise above its start; negative: not asked
  double reaction = -1;  // N, that the ground carries at the end; negative: not asked
  bool falls =
      false;  // it does not stay: a centre moves by more than 0.1 m, a thousand times what stands may
  /// Relative error of a motion that is known, after steps of h seconds.
  std::function<double(const pbd::State& end, double h, std::int64_t steps)> missed = {};
};

// What the scenes share.
inline constexpr double video_frame = 1.0 / 60;  // s
inline Eigen::Quaterniond about_y(double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, pbd::Vec3::UnitY()));
}

/// Scenes that stand, or fall where they should; scenes that slide, roll, swing and spin.
std::vector<ContactCase> cases_at_rest(bool full);
std::vector<ContactCase> moving_cases(bool full);

/// All of them; the quick tier has fewer and smaller ones of the same kinds.
std::vector<ContactCase> contact_cases(bool full);

}  // namespace pbdcheck
