// What must hold of a simulation of bodies in contact, however hard the scene.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "studies/robustness/contact_cases.h"
#include "studies/robustness/gates.h"

namespace pbdcheck {

/// What was seen on the way.
struct Watched {
  double excess;                    // of energy, 0 if there is none, as part of the scale
  double overlap, overlap_at_end;   // m
  double joints, lift;              // m
  double reaction;                  // N, of the ground at the end
  double not_finite;                // number of coordinates and steps
  double refuted, unimproved;       // numbers of steps
  std::int64_t judged;              // number of steps that say ok
  double crossing = 0, passed = 0;  // triangles at most, steps
};

/// The gates of a case; one that the case does not ask for is skipped. `mass` in kg, of all that moves:
///    finite              coordinates at the end that are not finite, and diverged steps
///    energy              largest excess of kinetic, elastic and gravity's energy over the start's, as part
///    of
///                        the start's kinetic and elastic energy + m g L; skipped where scripted parts do
///                        work
///    penetration         largest overlap, as part of the smallest body's size, 1e-2 while bodies strike
///    penetration_at_end  the same where the run ends, 1e-3
///    crosses             triangles of soft surfaces that cross others, or what is rigid (crossings.h)
///    passes              steps in which two that begin apart pass through each other (passage.h)
///    joints              largest error of a hard joint, link or attachment, as part of the size
///    claims              steps that say ok and are refuted by independent checks (harness/step_checks.h), or
///                        in which surfaces come to cross, or bodies pass
///    residual            steps that gave up without having improved on their first residual
///    settles             kinetic energy at the end, as part of m g L
///    stays               largest way of a body's centre, as part of the size
///    falls               1 where what cannot stand has not fallen
///    lift                m, that a centre has risen
///    reaction            relative error of what the ground carries at the end
///    answer              relative error of a motion that is known, as part of what it may be
std::vector<Gate> gates_of(const ContactCase& each, const Watched& watched, const pbd::State& end,
                           double mass, double h, std::int64_t steps);

struct CaseRun {
  std::vector<Gate> gates;
  std::int64_t steps = 0, ok = 0, sweeps = 0;
  pbd::Status worst = pbd::Status::ok;
  std::string reason;
};

/// Simulates a case by steps of h seconds and measures its gates.
CaseRun run_contact_case(const ContactCase& each, const pbd::Method& method, double h);

}  // namespace pbdcheck
