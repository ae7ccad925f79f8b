// The equations of a step (step_check.h) at what somebody claims to be their solution.
#pragma once

#include <limits>

#include "rigid_rows.h"
#include "step_claim.h"

namespace pbd::reference {

/// What rounding may make of a sum of terms of size 1: some ten of them, each rounded a few times.
inline constexpr double step_rounding = 64 * std::numeric_limits<double>::epsilon();

/// A scene's rows and what is to be known of each.
struct StepModel {
  RigidModel rigid;
  std::vector<bool> damped{};                   // of each row
  std::vector<bool> angle{};                    // taken modulo 2 pi
  std::vector<bool> goes_on{};                  // an angle that does not jump within a step
  std::vector<bool> own_frame{};                // damped in the frame of a's body: J is another one
  std::vector<std::array<double, 2>> bounds{};  // of each row's force
  std::vector<std::string> name{};              // of each row's constraint
};
/// Throws SetupError for a scene that is invalid or where nothing can move.
StepModel make_step_model(const Scene& scene);

/// True of integrators whose step is judged by its momentum: x1 = x0 + h v1, and forces act where the step
/// begins (`explicit_forces`) or ends.
bool is_euler_step(const StepClaim& claim);
bool explicit_forces(const StepClaim& claim);

/// True if the value of an angle is so near to pi, where it jumps, that rounded positions of this `size` (m)
/// tell which way it turns.
bool at_jump(const StepModel& model, const Block& block, double value, double size);

/// What both residuals of the step may be at most, sqrt(J).
double level_of(const StepClaim& claim, const StepModel& model);

/// Whose motion is x1 - x0 = h v1: by these integrators all, by any what has no finite mass.
enum class Moved : std::uint8_t { all, fixed };

/// Appends what speaks against the step.
void check_motion(const StepClaim& claim, Moved what, Findings& findings);
void check_momentum(const StepClaim& claim, const StepModel& model, double level, Findings& findings);
void check_constraints(const StepClaim& claim, const StepModel& model, double level, Findings& findings);

/// How bodies turned on the way (turn_check.cpp): the equations above hold after half a turn over, too.
void check_turns(const StepClaim& claim, const StepModel& model, Findings& findings);

}  // namespace pbd::reference
