#include "primal_newton.h"

#include <Eigen/CholmodSupport>
#include <algorithm>
#include <chrono>
#include <cmath>

#include "kkt.h"

namespace pbd::reference {
namespace {

/// Displacements below this share of the positions count as this share: rounding would dominate relative
/// measures.
constexpr double smallest_displacement = 1e-6;

/// Time spent, with pauses while observers run.
class Clock {
 public:
  double seconds() const { return spent_ + since(); }
  void pause() { spent_ += since(); }
  void resume() { start_ = now(); }

 private:
  using Time = std::chrono::steady_clock::time_point;
  static Time now() { return std::chrono::steady_clock::now(); }
  double since() const { return std::chrono::duration<double>(now() - start_).count(); }
  Time start_ = now();
  double spent_ = 0;
};

/// One minimisation: the objective, its factorisation and what happened so far.
struct Search {
  Objective objective;
  Assembly assembly;
  Vector u, start;  // unknowns now and at the beginning, m
  Multipliers multipliers;
  const NewtonSettings& settings;
  Clock clock;
  Eigen::CholmodSupernodalLLT<SparseMatrix> factor;
  bool analysed = false;
  int iterations = 0, projected = 0, shifted = 0, rank = 0;
  double correction = 0;

  Search(Objective problem, const Vector& first, const NewtonSettings& s)
      : objective(std::move(problem)), assembly(*objective.model), u(first), start(first), settings(s) {
    multipliers.gamma.setZero(objective.model->hard_rows);
    factor.cholmod().print = 0;
    factor.cholmod().quick_return_if_not_posdef = 1;
  }

  const Model& model() const { return *objective.model; }
  double displacement() const {
    const double target = objective.inertia.any() ? (objective.target - start).cwiseAbs().maxCoeff() : 0;
    return std::max(
        {(u - start).cwiseAbs().maxCoeff(), target, smallest_displacement * u.cwiseAbs().maxCoeff(), 1e-300});
  }
  void show(const Vector& unknowns) {
    if (!settings.observer) return;
    clock.pause();
    settings.observer(clock.seconds(), objective.positions(unknowns));
    clock.resume();
  }
};

bool factorise(Search& s, const SparseMatrix& hessian, double shift) {
  SparseMatrix h = hessian;
  h.diagonal() += s.objective.inertia + shift * s.model().mass;
  if (!s.analysed) s.factor.analyzePattern(h);
  s.analysed = true;
  s.factor.factorize(h);
  return s.factor.info() == Eigen::Success;
}

/// Factorises the Hessian at u, made positive definite if it is not. Returns the gradient and its magnitude.
struct Slope {
  Vector gradient, magnitude;
  double value;
};
Slope factorise_at(Search& s) {
  const Points x = s.objective.positions(s.u);
  const Derivatives* d = &s.assembly.at(x, s.multipliers);
  Slope slope{s.objective.gradient(s.u, *d), s.objective.magnitude(s.u, *d),
              s.objective.value(s.u, s.multipliers)};
  if (factorise(s, d->hessian, 0)) return slope;
  ++s.projected;
  d = &s.assembly.at(x, s.multipliers, Curvature::projected);
  double shift = 0;
  const double unit = std::max(d->hessian.diagonal().cwiseQuotient(s.model().mass).maxCoeff(), 1e-300);
  while (!factorise(s, d->hessian, shift)) {
    shift = std::max(10 * shift, 1e-10 * unit);
    ++s.shifted;
  }
  return slope;
}

/// Largest t in 1, 1/2, 1/4 ... with sufficient decrease (up to rounding), or 0.
double line_search(const Search& s, const Slope& slope, const Vector& dx) {
  const double rounding = 1e-15 * (slope.magnitude.dot(s.u.cwiseAbs()) + std::abs(slope.value));
  const double descent = slope.gradient.dot(dx);
  for (double t = 1; t > 1e-12; t /= 2) {
    const double value = s.objective.value(s.u + t * dx, s.multipliers);
    if (std::isfinite(value) && value <= slope.value + 1e-4 * t * descent + rounding) return t;
  }
  return 0;
}

/// Newton with fixed multipliers until the correction, relative to the displacement, is below the tolerance
/// or stalls at rounding. Returns whether it did.
bool descend(Search& s, double tolerance) {
  constexpr double rounding = 1e-9;
  double previous = infinity;
  for (; s.iterations < s.settings.max_iterations; ++s.iterations) {
    const Slope slope = factorise_at(s);
    const Vector dx = -s.factor.solve(slope.gradient);
    const double t = line_search(s, slope, dx);
    s.correction = dx.cwiseAbs().maxCoeff() / s.displacement();
    if (!std::isfinite(s.correction) || t == 0) return s.correction < rounding;
    s.u += t * dx;
    s.show(s.u);
    const bool stalled = s.correction < rounding && s.correction > 0.25 * previous;
    if (t == 1 && (s.correction <= tolerance || stalled)) return ++s.iterations, true;
    previous = s.correction;
  }
  return false;
}

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
  const Model model = make_model(scene);
  const Points target = state.x + h * state.v;
  Search search({&model, model.mass / (h * h), gather(model, target), target}, gather(model, state.x),
                settings);
  const bool converged = minimise(search);
  Judgement j = judge(search, converged);
  j.v = (j.x - state.x) / h;
  for (std::size_t a = 0; a < scene.mass.size(); ++a)
    if (model.first[a] < 0) j.v.col(static_cast<int>(a)) = state.v.col(static_cast<int>(a));
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
