// What the plain outer iteration does beside the solution of a step.
//
// Its first iterate is the old velocity: that is put beside the solution, and forces make up for it, so that
// the step's problem stays the same.
#pragma once

#include <string_view>

#include "judge.h"
#include "scene.h"

namespace pbdcheck {

/// Below this a rate cannot be told from what curvature makes of the error.
inline constexpr double least_rate = 1e-3;

/// Asymptotic contraction an iteration of `plain`, linear problems solved by `direct`, at the solved step of
/// h seconds from `start`. An iteration that contracts well reaches rounding before its slowest mode stands
/// alone, so the error is followed from 1e-6 to 1e-10 of the step and then started anew along its last
/// direction, several times over, as that mode may begin small; where modes of opposite signs contract alike,
/// two runs in turn give the rate as their mean. 0 below `least_rate`; NaN if the error does not fall or the
/// rate does not settle.
double measured_rate(const pbd::Scene& scene, const pbd::State& start, double h,
                     const pbd::reference::Judgement& solved);

/// Spectral radius of the map that an iteration of `plain` is beside that step, contacts by the law
/// `friction`: one iteration from either side of the solution along each velocity.
double measured_map_rate(const pbd::Scene& scene, const pbd::State& start, double h,
                         const pbd::reference::Judgement& solved, std::string_view friction);

/// How far `end` is from the solution: of all columns' velocities, over what the step changes of them.
double distance_from(const pbd::Scene& scene, const pbd::State& start,
                     const pbd::reference::Judgement& solved, const pbd::State& end);

/// Whether `plain` returns to the solution from 1e-6 of the step beside it within `iterations`: it ends ok,
/// and nearer than it began.
bool plain_returns(const pbd::Scene& scene, const pbd::State& start, double h,
                   const pbd::reference::Judgement& solved, int iterations,
                   std::string_view friction = "coulomb");

}  // namespace pbdcheck
