// How do sweeps solve the contacts of a step? The residual, the dual objective of the convex law and what
// still overlaps, sweep by sweep, for each relaxation, and beside them the gradient methods whose bounds are
// known (gradient_methods.h), with restart and without. Where bodies give way, elastic rows stand beside
// those of contacts, and the residual is of both.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cones/cone_relaxations.h"
#include "harness/measure.h"
#include "harness/order_fit.h"
#include "linear/linear_solver.h"
#include "scenes/contacts.h"
#include "studies/experiments.h"
#include "studies/iteration/deformable_contacts.h"
#include "studies/iteration/dual_trace.h"
#include "studies/iteration/gradient_methods.h"

namespace pbdcheck {
namespace {

using namespace pbd;
using namespace reference;

constexpr double dual_h = 0.01;        // s
constexpr double dual_solved = 1e-10;  // natural residual
/// Five cubes on each other that slide on the ground together.
Scene sliding_column() {
  Scene scene = column(5);
  scene.initial.v.rightCols(5).row(0).setConstant(1);
  return scene;
}

std::vector<DualCase> dual_cases(FrictionLaw law) {
  return {dual_case("column of 10", column(10), dual_h, law),
          dual_case("column of 50", column(50), dual_h, law),
          dual_case("masses 1:100", column(2, 100), dual_h, law),
          dual_case("sliding column", sliding_column(), dual_h, law),
          dual_case("pile", pile(), dual_h, law),
          planted_case(50, dual_h, law)};
}

DualTrace run_relaxation(const DualCase& of, std::string_view name, int most) {
  LinearSolver any = make_linear_solver(name);
  Rows rows = of.step.rows;
  Points v = of.step.v_free;
  DualTrace trace(of);
  std::visit(
      [&](auto& relaxation) {
        relaxation.begin(rows, v, true);
        for (int k = 1; k <= most && !trace.done(); ++k) {
          const bool exhausted = relaxation.sweep(rows, v, nullptr).exhausted;
          std::int64_t sweep = k;
          if constexpr (requires { relaxation.further_sweeps(); }) sweep += relaxation.further_sweeps();
          trace.add(sweep, impulses_in_order(rows));
          if (exhausted) break;
        }
      },
      any);
  return trace;
}

DualTrace run_gradient(const DualCase& of, const GradientMethod& method, const Metric& metric, int most) {
  GradientSweeps sweeps(of.problem, method.momentum, metric, most);
  DualTrace trace(of);
  for (int k = 1; k <= most && !trace.done(); ++k) {
    sweeps.sweep();
    trace.add(k, sweeps.impulse());
  }
  return trace;
}

/// Exponent of the decrease over the decade of sweeps from `first` on, or until the run ends, of the largest
/// gap from each sweep on.
double gap_exponent(const DualTrace& trace, double first) {
  std::vector<double> sweeps, gaps;
  constexpr int parts = 10;
  for (int part = 0; part <= parts; ++part) {
    const auto k = static_cast<std::size_t>(std::ceil(first * std::pow(10.0, 1.0 * part / parts)));
    if (k > trace.samples.size()) break;
    double largest = 0;
    for (std::size_t j = k - 1; j < trace.samples.size(); ++j)
      largest = larger(largest, trace.samples[j].gap);
    sweeps.push_back(static_cast<double>(k));
    gaps.push_back(largest);
  }
  return -fitted_order(sweeps, gaps);
}

/// All of the first 20 sweeps, then about 5 % apart.
bool drawn(std::size_t k, std::size_t count) {
  return k < 20 || k + 1 == count || k % (k / 20) == 0;
}

std::string law_of(const DualCase& of) {
  return std::string(friction_law_names[static_cast<std::size_t>(of.law)]);
}

/// f(sample, status, reason) for each sample that is drawn.
template <class F>
void each_drawn(const DualTrace& run, F&& f) {
  const bool reached = run.samples.back().residual <= dual_solved;
  for (std::size_t k = 0; k < run.samples.size(); ++k)
    if (drawn(k, run.samples.size()))
      f(run.samples[k], reached ? "ok" : "not_converged", reached ? "" : "sweeps spent");
}

class DualTables {
 public:
  explicit DualTables(Context& context)
      : traces_(context.table("traces", {"scene", "law", "relaxation", "sweep", "natural_residual", "error",
                                         "penetration_m", "status", "reason"})),
        gaps_(context.table("gaps", {"scene", "relaxation", "sweep", "gap", "bound", "status", "reason"})),
        bounds_(context.table("bounds", {"scene", "relaxation", "lipschitz", "bound_share", "exponent",
                                         "rises", "sweeps", "status", "reason"})),
        budgets_(context.table("budgets", {"scene", "relaxation", "budget", "gap", "natural_residual",
                                           "penetration_m", "status", "reason"})),
        deformables_(context.table("deformables", {"scene", "law", "relaxation", "contacts", "rows", "sweep",
                                                   "natural_residual", "error", "status", "reason"})) {}

  void trace(const DualCase& of, std::string_view name, const DualTrace& run) {
    each_drawn(run, [&](const DualSample& now, const char* status, const char* reason) {
      traces_.row({of.scene, law_of(of), std::string(name), now.sweep, now.residual, now.error,
                   now.penetration, status, reason});
    });
  }

  /// The exponent is fitted from sweep `first` on.
  void gap(const DualCase& of, std::string_view name, const DualTrace& run, const DualBound& bound,
           double first) {
    Worst share;
    for (std::size_t k = 0; k < run.samples.size(); ++k) {
      const DualSample& now = run.samples[k];
      share.add(now.gap / bound.after(k + 1));
      if (drawn(k, run.samples.size()))
        gaps_.row({of.scene, std::string(name), now.sweep, now.gap, bound.after(k + 1), "ok", ""});
    }
    bounds_.row({of.scene, std::string(name), bound.lipschitz(), share.value(), gap_exponent(run, first),
                 run.rises(), std::ssize(run.samples), "ok", ""});
    shares[std::string(name)].add(share.value());
    all_rises[std::string(name)].add(static_cast<double>(run.rises()));
  }

  void budget(const DualCase& of, std::string_view name, const DualTrace& run, int budget) {
    const auto end = std::find_if(run.samples.begin(), run.samples.end(),
                                  [&](const DualSample& each) { return each.sweep > budget; });
    const double none = std::nan("");
    if (end == run.samples.begin())
      budgets_.row({of.scene, std::string(name), std::int64_t{budget}, none, none, none, "skipped",
                    "set-up takes more sweeps"});
    else
      budgets_.row({of.scene, std::string(name), std::int64_t{budget}, (end - 1)->gap, (end - 1)->residual,
                    (end - 1)->penetration, "ok", ""});
  }

  void deformable(const DualCase& of, std::string_view name, const DualTrace& run) {
    each_drawn(run, [&](const DualSample& now, const char* status, const char* reason) {
      deformables_.row({of.scene, law_of(of), std::string(name), std::int64_t{of.problem.contacts()},
                        std::int64_t{of.problem.rows()}, now.sweep, now.residual, now.error, status, reason});
    });
    // The step of jacobi rests on an estimate; gauss_seidel minimises block by block, whatever the rows.
    if (of.law == FrictionLaw::cone && name == "gauss_seidel")
      all_rises[std::string(name)].add(static_cast<double>(run.rises()));
  }

  void close() { traces_.close(), gaps_.close(), bounds_.close(), budgets_.close(), deformables_.close(); }

  std::map<std::string, Worst> shares, all_rises;  // of each method, in all scenes

 private:
  Table traces_, gaps_, bounds_, budgets_, deformables_;
};

constexpr std::array budgets{10, 20, 50, 100, 200, 500, 1000};

/// The gaps of relaxations and gradient methods in a case of the convex law.
void add_gaps(DualTables& tables, const DualCase& of, const std::map<std::string_view, DualTrace>& relaxed,
              int most) {
  using enum DualBound::Order;
  const Metric mean = metric_of(of, gradient_methods.front());
  const double first_sweep = DualBound(of, mean, second).worth();
  for (const auto& [name, run] : relaxed) {
    // These methods step by their own estimate of 1/L, or by up to twice that: beside the bounds, not below
    // by proof.
    const auto order = name == "nesterov_jacobi" ? second : name == "jacobi" ? first : none;
    tables.gap(of, name, run, DualBound(of, mean, order), first_sweep);
    for (const int budget : budgets) tables.budget(of, name, run, budget);
  }
  for (const GradientMethod& method : gradient_methods) {
    const Metric metric = metric_of(of, method);
    const DualTrace run = run_gradient(of, method, metric, most);
    const auto order = method.momentum == Momentum::none       ? first
                       : method.momentum == Momentum::nesterov ? second
                                                               : none;
    tables.gap(of, method.name, run, DualBound(of, metric, order), first_sweep);
    for (const int budget : budgets)
      tables.budget(of, method.name,
                    method.momentum == Momentum::power_law ? run_gradient(of, method, metric, budget) : run,
                    budget);
  }
}

}  // namespace

void contact_convergence(Context& context) {
  const int most = context.full() ? 20000 : 2500;
  const int most_soft = context.full() ? 20000 : 1000;  // rows of deformables are many
  DualTables tables(context);
  context.begin(21);
  for (const FrictionLaw law : {FrictionLaw::cone, FrictionLaw::coulomb})
    for (const DualCase& of : dual_cases(law)) {
      std::map<std::string_view, DualTrace> relaxed;
      for (const auto name : general_solver_names()) {
        const DualTrace& run = relaxed.emplace(name, run_relaxation(of, name, most)).first->second;
        tables.trace(of, name, run);
      }
      if (law == FrictionLaw::cone && of.scene != "planted") add_gaps(tables, of, relaxed, most);
      context.advance(of.scene);
    }
  for (const DeformableContact& each : deformable_contacts())
    for (const FrictionLaw law : {FrictionLaw::cone, FrictionLaw::coulomb, FrictionLaw::box}) {
      const DualCase of = dual_case(each.name, each.scene, each.h, law);
      for (const auto name : general_solver_names())
        tables.deformable(of, name, run_relaxation(of, name, most_soft));
      context.advance(of.scene);
    }
  tables.close();
  for (const char* name : {"ista", "mass_splitting", "fista"})
    context.verdict(Basis::theory, fmt::format("contact_convergence.bound.{}", name),
                    fmt::format("the dual gap of {} is within its bound after every sweep", name),
                    "largest gap over bound", tables.shares[name].value(), 1);
  for (const char* name : {"jacobi", "gauss_seidel"})
    context.verdict(Basis::theory, fmt::format("contact_convergence.monotone.{}", name),
                    fmt::format("no sweep of {} raises the dual objective of the convex law", name),
                    "most rises in a scene", tables.all_rises[name].value(), 0);
}

}  // namespace pbdcheck
