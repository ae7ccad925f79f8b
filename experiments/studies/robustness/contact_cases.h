// Scenes of rigid and soft bodies in contact that solvers are known to fail on.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "scenes/contacts.h"
#include "studies/robustness/passage.h"

namespace pbdcheck {

/// Two things: all of both, and what is drawn in (passage.h).
struct Pair {
  std::array<Core, 2> whole, core;
};

struct ContactCase {
  std::string name;
  pbd::Scene scene;
  double h;              // s
  double duration;       // s, after which what settles has settled
  double size;           // m, of the smallest body, of a sheet or a mat its thickness
  bool settles = true;   // at the end
  bool stays = false;    // where it starts: to a thousandth of `size`
  double lift = -1;      // m, that no centre may rise above its start; negative: not asked
  double reaction = -1;  // N, that the ground carries at the end; negative: not asked
  bool falls =
      false;  // it does not stay: a centre moves by more than 0.1 m, a thousand times what stands may
  /// Relative error of a motion that is known, after steps of h seconds.
  std::function<double(const pbd::State& end, double h, std::int64_t steps)> missed = {};
  double exact_to = 1e-6;                 // the bound of `missed`
  std::string_view family = {};           // whose verdicts it has a part in
  std::vector<Pair> apart_for_ever = {};  // that must not pass through each other
};

// What the scenes share.
inline constexpr double video_frame = 1.0 / 60;  // s
inline Eigen::Quaterniond about_y(double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, pbd::Vec3::UnitY()));
}

/// Scenes that stand, or fall where they should; scenes that slide, roll, swing and spin.
std::vector<ContactCase> cases_at_rest(bool full);
std::vector<ContactCase> moving_cases(bool full);

/// Spikes, wedges, cliffs, holes and inner edges of meshes; thin walls; levers. A wing nut. Solids and cloth
/// that fall and carry; those that are twisted, thrown and pulled.
std::vector<ContactCase> surface_cases(bool full);
std::vector<ContactCase> screw_cases(bool full);
std::vector<ContactCase> soft_cases(bool full);
std::vector<ContactCase> driven_soft_cases(bool full);

/// The same motion told in other units: lengths times `length`, masses times `mass`. It ends where `each`
/// ends by the default method with `direct`, to the tolerance of each step times their number.
ContactCase in_other_units(const ContactCase& each, double length, double mass);

/// All of them; the quick tier has fewer and smaller ones of the same kinds.
std::vector<ContactCase> contact_cases(bool full);

}  // namespace pbdcheck
