// One step of a world beside one of the same scene in other words, or by another method.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "step/step.h"
#include "step_check.h"
#include "studies/robustness/generated_world.h"
#include "studies/robustness/random.h"

namespace pbdcheck {

/// How a variant's step ended beside the world's own.
enum class Agreement { same, missed, conditioning, other_solution, undecided };
inline constexpr std::array agreement_names{"the same", "one missed", "told apart by the tolerance alone",
                                            "another solution", "not told"};

/// A scene that says the same, by which method, and what takes states of the world's scene to it.
struct Variant {
  std::string name;
  pbd::Scene scene;
  pbd::Method method;
  std::function<pbd::State(const pbd::State&)> to;
};

/// Turned and shifted, mirrored, in other units, with its parts in another order, by another linear solver
/// and another outer iteration. The tangents of the law box are no property of a scene: such a world is
/// neither turned nor mirrored.
std::vector<Variant> variants_of(const World& world, Random& random);

/// A step from the scene's initial state by a new workspace, and what the judge refutes of it if it is ok.
struct FirstStep {
  pbd::State end;
  pbd::Report report;
  std::vector<pbd::reference::Finding> refuted;
};
FirstStep first_step(const pbd::Scene& scene, const pbd::Method& method, double h);

struct Comparison {
  std::string variant;
  Agreement agreement = Agreement::missed;
  double apart = 0;                                // difference of velocities, of the step's scale
  double turn = 0;                                 // rad, the largest of a body in the step
  std::vector<pbd::reference::Finding> refuted{};  // of the variant's step
};

/// The variant's step beside `own`, the world's. Where they differ both are solved again to 1e-11.
Comparison compare(const World& world, const FirstStep& own, const Variant& variant);

}  // namespace pbdcheck
