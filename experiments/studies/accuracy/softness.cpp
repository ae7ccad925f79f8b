// How soft do constraints get where the solver is stopped early? The stretch at rest of a chain and of a
// cloth that hang, over the sweeps of a step and over the step: hard and compliant links by the solver, and
// the relaxation factor of classic PBD, beside formulas (soft_chain.h) and a judge's equilibrium.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>

#include "harness/measure.h"
#include "primal_newton.h"
#include "scenes/standard.h"
#include "studies/accuracy/soft_chain.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr int soft_links = 10;
constexpr double soft_compliance = 1e-3;  // m/N
constexpr std::array soft_steps{1.0 / 30, 1.0 / 60, 1.0 / 240};
constexpr std::array soft_sweeps{1, 2, 5, 10, 20, 50, 100};

/// The solver as classic PBD is run: increments, one linearisation and `sweeps` sweeps a step, no impulse
/// kept.
Method stopped_method(std::string_view relaxation, int sweeps) {
  Method method;
  method.outer = "incremental";
  method.relaxation = relaxation;
  method.tolerance = method.inner_tolerance = 1e-14;
  method.max_outer = 1;
  method.max_sweeps = sweeps;
  method.warm_start = false;
  return method;
}

Method converged_method(std::string_view relaxation) {
  Method method;
  method.outer = "plain";
  method.relaxation = relaxation;
  method.tolerance = 1e-12;
  return method;
}

struct Hanging {
  State end;
  bool at_rest = false;
  int missed = 0;  // steps that are not ok
};

/// Steps until nothing moves by more than `still` m/s in two of them. After one alone the nodes may turn
/// round: a chain swept once a step does so after 2 N steps. Implicit Euler damps the slowest chain, w = 16
/// rad/s in steps of 1/240 s, by w^2 h/2 = 0.5/s: 1 m/s falls to 1e-12 in 13 000 steps.
Hanging hang(const Scene& scene, double still, const std::function<bool(State&)>& advance) {
  constexpr int most = 40000;
  Hanging found{scene.initial};
  bool slow = false;
  for (int k = 0; k < most && !found.at_rest && found.end.v.allFinite(); ++k) {
    throw_if_interrupted();
    found.missed += !advance(found.end);
    const bool now = found.end.v.cwiseAbs().maxCoeff() <= still;
    found.at_rest = slow && now;
    slow = now;
  }
  return found;
}

Hanging hang_by(const Scene& scene, const Method& method, double h, double still) {
  Workspace workspace(scene, method);
  return hang(scene, still, [&](State& state) { return step(workspace, h, state).status == Status::ok; });
}

/// Mean depth of the nodes that hang lowest in the scene's initial state.
double mean_depth(const Scene& scene, const Points& x) {
  const double lowest = scene.initial.x.row(2).minCoeff();
  double sum = 0;
  int count = 0;
  for (int node = 0; node < scene.nodes(); ++node)
    if (scene.initial.x(2, node) < lowest + 1e-9) sum -= x(2, node), ++count;
  return sum / count;
}

class Stretches {
 public:
  explicit Stretches(Context& context)
      : table_(context.table(
            "stretches", {"scene", "variant", "relaxation", "step_s", "sweeps", "compliance_m_per_n",
                          "factor", "stretch_m", "expected_m", "physical_m", "error", "status", "reason"})) {}

  /// `expected` and `physical` in m, the first NaN where no formula says; 0 sweeps: as many as it takes.
  double add(std::string_view scene, std::string_view variant, std::string_view relaxation, double h,
             int sweeps, double compliance, double factor, const Hanging& run, double stretch,
             double expected, double physical) {
    const double error = std::abs(stretch / expected - 1);
    table_.row({std::string(scene), std::string(variant), std::string(relaxation), h, std::int64_t{sweeps},
                compliance, factor, stretch, expected, physical, error, run.at_rest ? "ok" : "not_converged",
                run.at_rest ? "" : "not at rest"});
    return run.at_rest ? error : std::nan("");
  }
  void close() { table_.close(); }

 private:
  Table table_;
};

/// m/s, above what rounding moves a chain of 11 m by. A compliant chain has still to sink by that over 0.5/s,
/// 2e-11 m of its 0.054 m.
constexpr double chain_still = 1e-11;

/// Links by the solver, stopped after so many sweeps.
void stop_early(Stretches& table, Worst& apart, double compliance, double h) {
  const Scene scene = hanging_chain(soft_links, compliance);
  for (const auto* relaxation : {"gauss_seidel", "jacobi", "nesterov_jacobi"})
    for (const int sweeps : soft_sweeps) {
      if (std::string_view(relaxation) != "gauss_seidel" && h != soft_steps[1]) continue;  // no formula
      const Hanging run = hang_by(scene, stopped_method(relaxation, sweeps), h, chain_still);
      const bool predicted = std::string_view(relaxation) == "gauss_seidel";
      const double expected = predicted ? predicted_stretch(scene, h, sweeps, 1) : std::nan("");
      const double error = table.add("chain", "stopped", relaxation, h, sweeps, compliance, 1, run,
                                     mean_depth(scene, run.end.x) - 1, expected, physical_stretch(scene));
      if (predicted) apart.add(error);
    }
}

void by_factor(Stretches& table, Worst& apart, double h) {
  const Scene scene = hanging_chain(soft_links, 0);
  for (const double factor : {0.1, 0.5, 1.0})
    for (const int sweeps : {1, 5, 20}) {
      const Hanging run = hang(scene, chain_still, [&](State& state) {
        classic_step(scene, h, sweeps, factor, state);
        return true;
      });
      apart.add(table.add("chain", "classic", "gauss_seidel", h, sweeps, 0, factor, run,
                          mean_depth(scene, run.end.x) - 1, predicted_stretch(scene, h, sweeps, factor), 0));
    }
}

void regularised(Stretches& table, Worst& apart, double h) {
  const Scene scene = hanging_chain(soft_links, soft_compliance);
  const double physical = physical_stretch(scene);
  for (const auto* relaxation : {"gauss_seidel", "nesterov_jacobi"}) {
    const Hanging run = hang_by(scene, converged_method(relaxation), h, 1e-10);
    const double error = table.add("chain", "converged", relaxation, h, 0, soft_compliance, 1, run,
                                   mean_depth(scene, run.end.x) - 1, physical, physical);
    apart.add(run.missed == 0 ? error : std::nan(""));
  }
}

/// A sheet that hangs by an edge, beside the judge's equilibrium.
void hang_cloth(Stretches& table, bool full) {
  Scene scene = cloth(full ? 20 : 8, true);
  const double top = scene.initial.x.row(0).minCoeff();
  scene.initial.x.row(2) = top - scene.initial.x.row(0).array();
  scene.initial.x.row(0).setZero();
  const double rest = mean_depth(scene, scene.initial.x);
  const reference::Judgement judged = reference::primal_static(scene);
  const bool known = judged.outcome == reference::Outcome::ok;
  const double expected = known ? mean_depth(scene, judged.x) - rest : std::nan("");
  constexpr double h = 1.0 / 60, still = 1e-6;
  for (const int sweeps : {1, 5, 20, 100})
    for (const auto* relaxation : {"gauss_seidel", "nesterov_jacobi"}) {
      const Hanging run = hang_by(scene, stopped_method(relaxation, sweeps), h, still);
      table.add("cloth", "stopped", relaxation, h, sweeps, 1e-5, 1, run, mean_depth(scene, run.end.x) - rest,
                expected, expected);
    }
}

}  // namespace

void softness(Context& context) {
  Stretches table(context);
  Worst stopped, classic, converged;
  context.begin(std::ssize(soft_steps) + 1);
  for (const double h : soft_steps) {
    for (const double compliance : {0.0, soft_compliance}) stop_early(table, stopped, compliance, h);
    by_factor(table, classic, h);
    regularised(table, converged, h);
    context.advance(fmt::format("chain, h = {:g} s", h));
  }
  hang_cloth(table, context.full());
  context.advance("cloth");
  table.close();
  const char* quantity = "largest relative difference of the stretch";
  context.verdict(Basis::theory, "softness.stopped.gauss_seidel",
                  "a chain whose sweeps are stopped stretches as the sweeps' matrix says", quantity,
                  stopped.value(), 1e-6);
  context.verdict(Basis::theory, "softness.classic",
                  "a chain with a relaxation factor stretches as the sweeps' matrix says", quantity,
                  classic.value(), 1e-6);
  context.verdict(Basis::theory, "softness.converged",
                  "a compliant chain stretches by the sum of m g A, whatever the step", quantity,
                  converged.value(), 1e-6);
}

}  // namespace pbdcheck
