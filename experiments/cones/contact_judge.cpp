#include "cones/contact_judge.h"

#include <fmt/format.h>

#include <chrono>
#include <limits>

#include "error.h"
#include "harness/interrupt.h"
#include "harness/rows_of_step.h"
#include "scenes/contacts.h"

namespace pbdcheck {

using namespace pbd;

namespace {

void refuse_restitution(const Scene& scene) {
  const Contact* contact = contact_of(scene);
  for (std::size_t i = 0; contact != nullptr && i < contact->law.size(); ++i)
    if (const double restitution = contact->law[i].restitution; restitution > 0)
      throw SetupError(fmt::format("contact restitution[{}]", i), fmt::format("{}", restitution),
                       "0 in a step that is judged");
}

}  // namespace

ContactJudgement judge_contacts(const ConeSolver& judge, const Scene& scene, const State& state, double h,
                                reference::FrictionLaw law) {
  constexpr double settled = 1e-12, accuracy = 1e-12;
  constexpr int most = 100;
  refuse_restitution(scene);
  const auto begin = std::chrono::steady_clock::now();
  ContactJudgement found;
  found.status = "not_converged";
  found.reason = "velocities do not settle";
  found.residual = std::numeric_limits<double>::infinity();
  StepRows step(scene, state, h, law == reference::FrictionLaw::cone ? Friction::cone : Friction::coulomb);
  const double scale = step.v_free().colwise().norm().maxCoeff();
  Points v = step.v_free();
  while (found.iterations < most && !(found.residual <= settled)) {
    throw_if_interrupted();
    step.linearise(v);
    const reference::ConeProblem problem = cone_problem(step.rows(), step.v_free());
    const auto solved = judge.solve({problem, law, accuracy, 0});
    const Points next = moved_by(step.rows(), step.v_free(), solved.impulse);
    found.residual = (next - v).colwise().norm().maxCoeff<Eigen::PropagateNaN>() / scale;
    v = next;
    ++found.iterations;
    if (solved.outcome != reference::Outcome::ok) {
      found.reason = solved.reason;
      break;
    }
    if (!(found.residual <= settled)) continue;
    if (step.widen(v, solved.impulse, accuracy))
      found.residual = std::numeric_limits<double>::infinity();
    else
      found.status = "ok", found.reason.clear();
  }
  found.end = step.end(v);
  found.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return found;
}

}  // namespace pbdcheck
