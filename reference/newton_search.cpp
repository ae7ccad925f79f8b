#include "newton_search.h"

#include <algorithm>
#include <cmath>

namespace pbd::reference {
namespace {

struct Descent {
  Vector gradient, magnitude;
  double value;
};

/// Factorises the Hessian at u, made positive definite if it is not. Returns value, gradient and its
/// magnitude.
Descent factorise_at(Search& s) {
  const Points x = s.objective.positions(s.u);
  const Derivatives* d = &s.assembly.at(x, s.multipliers);
  Descent slope{s.objective.gradient(s.u, *d), s.objective.magnitude(s.u, *d),
                s.objective.value(s.u, s.multipliers)};
  if (factorise(s, d->hessian, 0)) return slope;
  ++s.projected;
  d = &s.assembly.at(x, s.multipliers, Curvature::projected);
  double shift = 0;
  const double unit = std::max(d->hessian.diagonal().cwiseQuotient(s.model().mass).maxCoeff(), 1e-300);
  while (!factorise(s, d->hessian, shift) && shift < unit) {
    shift = std::max(10 * shift, 1e-10 * unit);
    ++s.shifted;
  }
  return slope;
}

/// Largest t in 1, 1/2, 1/4 ... with sufficient decrease (up to rounding), or 0.
double line_search(const Search& s, const Descent& slope, const Vector& dx) {
  const double rounding = 1e-15 * (slope.magnitude.dot(s.u.cwiseAbs()) + std::abs(slope.value));
  const double descent = slope.gradient.dot(dx);
  for (double t = 1; t > 1e-12; t /= 2) {
    const double value = s.objective.value(s.u + t * dx, s.multipliers);
    if (std::isfinite(value) && value <= slope.value + 1e-4 * t * descent + rounding) return t;
  }
  return 0;
}

}  // namespace

double Search::displacement() const {
  const double target = objective.inertia.any() ? (objective.target - start).cwiseAbs().maxCoeff() : 0;
  return std::max(
      {(u - start).cwiseAbs().maxCoeff(), target, smallest_displacement * u.cwiseAbs().maxCoeff(), 1e-300});
}

void Search::show(const Vector& unknowns) {
  if (!settings.observer) return;
  const double seconds = clock.seconds();
  clock.pause();
  settings.observer(seconds, objective.positions(unknowns));
  clock.resume();
}

bool factorise(Search& s, const SparseMatrix& hessian, double shift) {
  SparseMatrix h = hessian;
  h.diagonal() += s.objective.inertia + shift * s.model().mass;
  return s.factor.compute(h);
}

bool descend(Search& s, double tolerance) {
  constexpr double rounding = 1e-9;
  double previous = infinity;
  for (; s.iterations < s.settings.max_iterations; ++s.iterations) {
    const Descent slope = factorise_at(s);
    const Vector dx = -s.factor.solve(slope.gradient);
    const double t = line_search(s, slope, dx);
    s.correction = dx.cwiseAbs().maxCoeff() / s.displacement();
    if (!std::isfinite(s.correction)) return false;
    if (t == 0) {  // the objective no longer tells better from worse; the last correction does
      if (s.correction < rounding) s.u += dx;
      return s.correction < rounding;
    }
    s.u += t * dx;
    s.show(s.u);
    const bool stalled = s.correction < rounding && s.correction > 0.25 * previous;
    if (t == 1 && (s.correction <= tolerance || stalled)) return ++s.iterations, true;
    previous = s.correction;
  }
  return false;
}

}  // namespace pbd::reference
