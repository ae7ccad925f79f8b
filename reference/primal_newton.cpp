#include "primal_newton.h"

#include <cmath>

#include "newton_search.h"
#include "rigid_newton.h"

namespace pbd::reference {
namespace {

/// Penalties (N/m) that make each hard row alone `weight` times as stiff as the inertia it acts on; none for
/// rows without unknowns.
Vector penalties(const Vector& per_mass, double weight) {
  return per_mass.unaryExpr([&](double n) { return n > 0 ? weight / n : 0.0; });
}

/// KKT Newton from where the search is; near-redundant rows are dropped more and more freely until it
/// converges. A result counts if it is near by: some other stationary point is not what the augmented
/// Lagrangian approaches.
Polish attempt_polish(Search& s) {
  Polish polished;
  for (const double threshold : {1e-10, 1e-7, 1e-4}) {
    Vector u = s.u, gamma = s.multipliers.gamma;
    polished = polish(s.objective, s.assembly, {s.displacement(), threshold}, u, gamma,
                      [&](const Vector& w) { s.show(w); });
    s.iterations += polished.iterations;
    if (polished.converged && polished.violation < 1e-9 &&
        (u - s.u).cwiseAbs().maxCoeff() < 0.1 * s.displacement()) {
      s.u = u, s.multipliers.gamma = gamma, s.correction = polished.correction, s.rank = polished.rank;
      return polished;
    }
  }
  polished.converged = false;
  return polished;
}

/// Augmented Lagrangian until KKT Newton converges from where it is. Returns its result.
Polish satisfy(Search& s) {
  const Vector per_mass =
      inverse_effective_mass(s.model(), s.assembly.at(s.objective.positions(s.u), {}).jacobian);
  const double typical =
      s.objective.inertia.any() ? (s.objective.inertia.cwiseQuotient(s.model().mass)).mean() : 1;
  double weight = 100, previous = infinity, attempt = 1e-3;
  Polish polished;
  for (int round = 0; round < 20 && s.iterations < s.settings.max_iterations; ++round) {
    s.multipliers.rho = penalties(per_mass, weight * typical);
    if (!descend(s, 1e-4)) break;
    const Vector c = s.assembly.at(s.objective.positions(s.u), {}).hard;
    s.multipliers.gamma -= s.multipliers.rho.cwiseProduct(c);
    const double violation = c.cwiseAbs().maxCoeff() / s.displacement();
    if (violation < attempt) {
      attempt = violation / 10;
      polished = attempt_polish(s);
      if (polished.converged) return polished;
    }
    if (violation > 0.1 * previous) weight = std::min(10 * weight, 1e8);
    previous = violation;
  }
  return polished;
}

/// Whether the Hessian is positive definite on the null space of J: Cholesky of H + J^T diag(rho) J for large
/// rho.
bool certify(Search& s, const Vector& per_mass) {
  for (const double weight : {1e4, 1e7}) {
    Multipliers m = s.multipliers;
    const double typical =
        s.objective.inertia.any() ? (s.objective.inertia.cwiseQuotient(s.model().mass)).mean() : 1;
    m.rho = penalties(per_mass, weight * typical);
    if (factorise(s, s.assembly.at(s.objective.positions(s.u), m).hessian, 0)) return true;
    if (per_mass.size() == 0) return false;
  }
  return false;
}

void explain(const Search& s, Judgement& j) {
  const auto say = [&](const std::string& text) { j.note += (j.note.empty() ? "" : "; ") + text; };
  if (s.projected) say("Hessian made positive semidefinite " + std::to_string(s.projected) + " times");
  if (s.shifted) say("Hessian shifted " + std::to_string(s.shifted) + " times");
  if (j.rank < s.model().hard_rows)
    say("hard constraints are redundant: rank " + std::to_string(j.rank) + " of " +
        std::to_string(s.model().hard_rows) + " rows, multipliers of least norm");
  if (!j.certified) say("second-order condition not shown");
}

/// Residuals, certificate and outcome at the point reached.
Judgement judge(Search& s, bool converged) {
  Judgement j;
  s.multipliers.rho.resize(0);
  j.x = s.objective.positions(s.u);
  j.multiplier = s.multipliers.gamma;
  const Derivatives& d = s.assembly.at(j.x, s.multipliers);
  measure(s.objective, d, s.u, s.displacement(), j);
  const SparseMatrix jacobian = d.jacobian;
  j.rank = s.rank > 0 ? s.rank : static_cast<int>(independent_rows(s.model(), jacobian, 1e-10).size());
  j.certified = certify(s, inverse_effective_mass(s.model(), jacobian));
  j.correction = s.correction;
  j.iterations = s.iterations;
  j.seconds = s.clock.seconds();
  j.outcome = !converged ? Outcome::not_converged : j.infeasible > 1e-8 ? Outcome::infeasible : Outcome::ok;
  if (!converged)
    j.reason =
        "stopped after " + std::to_string(s.iterations) + " iterations" +
        (s.model().hard_rows > 0 && j.certified ? ": no regular KKT point near by (degenerate constraints?)"
                                                : "");
  if (j.outcome == Outcome::infeasible) j.reason = "hard constraints contradict each other";
  explain(s, j);
  return j;
}

bool minimise(Search& s) {
  if (s.model().hard_rows > 0) return satisfy(s).converged;
  return descend(s, 1e-15);
}

}  // namespace

Judgement primal_newton(const Scene& scene, const State& state, double h, const NewtonSettings& settings) {
  if (!scene.bodies.empty()) return rigid_newton(scene, state, h, settings);
  const Model model = make_model(scene);
  const Points target = state.x + h * state.v;
  Search search({&model, model.mass / (h * h), gather(model, target), target}, gather(model, state.x),
                settings);
  const bool converged = minimise(search);
  Judgement j = judge(search, converged);
  j.v = (j.x - state.x) / h;
  for (std::size_t a = 0; a < scene.mass.size(); ++a)
    if (model.first[a] < 0) j.v.col(a) = state.v.col(a);
  return j;
}

Judgement primal_newton(const Scene& scene, const State& state, double h) {
  return primal_newton(scene, state, h, {});
}

Judgement primal_static(const Scene& scene, const NewtonSettings& settings) {
  const Model model = make_model(scene);
  const Points& x = scene.initial.x;
  Search search({&model, Vector::Zero(model.unknowns), gather(model, x), x}, gather(model, x), settings);
  const Vector at_rest = search.start;
  bool converged = false;
  double h = 0.05;
  for (int i = 0; i < 60 && !converged; ++i, h *= 2) {
    const Vector before = search.u;
    search.objective.inertia = model.mass / (h * h);
    search.objective.target = before;
    if (!minimise(search)) break;
    const double moved = (search.u - before).cwiseAbs().maxCoeff();
    converged = moved < 1e-4 * (search.u - at_rest).cwiseAbs().maxCoeff() + 1e-14;
  }
  search.objective.inertia.setZero();
  if (converged && model.hard_rows > 0) {
    const Polish p = polish(search.objective, search.assembly, {search.displacement(), 1e-10}, search.u,
                            search.multipliers.gamma, [&](const Vector& u) { search.show(u); });
    search.correction = p.correction;
    search.rank = p.rank;
    converged = p.converged;
  } else if (converged) {
    converged = descend(search, 1e-15);
  }
  Judgement j = judge(search, converged);
  j.v = Points::Zero(3, x.cols());
  return j;
}

}  // namespace pbd::reference
