#include "rigid_newton.h"

#include <cmath>

#include "kkt.h"
#include "newton_search.h"
#include "rigid_kkt.h"

namespace pbd::reference {
namespace {

struct Point {
  Vector velocity, gamma;
};

struct RigidSearch {
  RigidStep step;
  double threshold = 1e-10;  // of independent rows
  const NewtonSettings& settings;
  Clock clock;
  int iterations = 0, rank = 0;
  double correction = 0;

  RigidSearch(RigidStep problem, const NewtonSettings& s) : step(std::move(problem)), settings(s) {}

  void show(const Point& point) {
    if (!settings.observer) return;
    const double seconds = clock.seconds();
    clock.pause();
    settings.observer(seconds, step.end(point.velocity).x);
    clock.resume();
  }
};

/// Residual of both equations, without dropped rows, in units of inertia^1/2 times length.
double merit(const RigidSearch& s, const Scales& scales, const Point& at) {
  const RigidSystem system = system_at(s.step, at.velocity, at.gamma);
  const double h2 = s.step.h * s.step.h;
  return std::hypot(h2 * scales.unknown.cwiseProduct(system.force(at.gamma)).norm(),
                    scales.row.cwiseProduct(system.gap(at.gamma)).norm());
}

/// Increments (dx, d) and the new gamma, zero of dropped rows; false where the system is singular.
bool body_step(const RigidSearch& s, const RigidSystem& system, const Scales& scales, Vector& increment,
               Vector& gamma) {
  RigidKkt kkt;
  if (!kkt.compute(s.step, system, scales)) return false;
  kkt.solve(-system.load, -system.value, increment, gamma);
  return increment.allFinite() && gamma.allFinite();
}

/// Largest t = 1, 1/2, ... that lowers the residual, or 0.
double shortened(const RigidSearch& s, const Scales& scales, const Point& at, const Vector& change,
                 const Vector& gamma) {
  const double before = merit(s, scales, at);
  for (double t = 1; t > 1e-6; t /= 2) {
    const Point next{at.velocity + t * change, at.gamma + t * (gamma - at.gamma)};
    if (merit(s, scales, next) <= (1 - 1e-4 * t) * before) return t;
  }
  return 0;
}

/// Newton from `at` until its corrections are at rounding.
bool find_root(RigidSearch& s, Point& at) {
  constexpr double rounding = 1e-15, converged = 1e-9;
  double previous = infinity;
  for (int k = 0; k < 60 && s.iterations < s.settings.max_iterations; ++k, ++s.iterations) {
    const RigidSystem system = system_at(s.step, at.velocity, at.gamma);
    Scales scales = scales_of(s.step, system);
    s.rank = drop_dependent(s.step.model, system, s.threshold, scales);
    Vector increment, gamma;
    if (!body_step(s, system, scales, increment, gamma)) return false;
    const Vector change = velocity_change(s.step, at.velocity, increment);
    s.correction = increment.cwiseProduct(s.step.model.radius).cwiseAbs().maxCoeff() /
                   displacement_of(s.step, at.velocity);
    if (!std::isfinite(s.correction)) return false;
    const bool near = s.correction < converged;
    const double t = near ? 1 : shortened(s, scales, at, change, gamma);
    if (t == 0) return false;
    at.velocity += t * change;
    at.gamma += t * (gamma - at.gamma);
    s.show(at);
    if (s.correction <= rounding || (near && s.correction > 0.25 * previous)) return true;
    previous = s.correction;
  }
  return false;
}

/// Solves at h, by shorter steps where that fails directly. The start is the free motion's.
bool solve_by_and_by(RigidSearch& s, Point& at) {
  const double h = s.step.h;
  double reached = 0, stride = 1;
  while (reached < 1 && s.iterations < s.settings.max_iterations) {
    Point trial = at;
    s.step.h = std::min(1.0, reached + stride) * h;
    if (find_root(s, trial)) {
      at = trial;
      reached = s.step.h / h;
      stride *= 2;
    } else {
      stride /= 2;
      if (stride < 1e-3) break;
    }
  }
  s.step.h = h;
  return reached == 1;
}

double violation(const RigidStep& step, const Point& at) {
  Judgement j;
  report(step, at.velocity, at.gamma, j);
  return j.infeasible;
}

/// Whether (K + K^T)/2 is positive definite where hard J is zero: Cholesky with weighted J^T J added, and
/// compliant rows as the springs they are.
bool certify_bodies(const RigidStep& step, const Point& at) {
  const RigidSystem system = system_at(step, at.velocity, at.gamma);
  const Scales scales = scales_of(step, system);
  const SparseMatrix own = scaled(step.h * step.h * scales.unknown, system.tangent, scales.unknown);
  const SparseMatrix symmetric = (own + SparseMatrix(own.transpose())) / 2;
  for (const double weight : {1e4, 1e7}) {
    // A scaled compliance is at most one: a spring's rows weigh as the spring does, up to `weight`.
    Vector weights(step.model.rows());
    for (int i = 0; i < step.model.rows(); ++i) {
      const double softness = system.compliance.coeff(i, i) * std::pow(scales.row(i) / step.h, 2);
      weights(i) = step.model.hard[i] ? weight : 1 / std::max(softness, 1 / weight);
    }
    const SparseMatrix j = scaled(scales.row, system.jacobian, scales.unknown);
    const SparseMatrix matrix = symmetric + SparseMatrix(j.transpose() * weights.asDiagonal() * j);
    if (SparseCholesky().compute(matrix)) return true;
  }
  return false;
}

/// Replaces the hard rows' multipliers by those of least 2-norm with the same forces.
void take_least_norm(const RigidStep& step, Point& at) {
  const RigidModel& model = step.model;
  const SparseMatrix jacobian = hard_rows(model, system_at(step, at.velocity, at.gamma).jacobian);
  Vector hard(jacobian.rows());
  int position = 0;
  for (int i = 0; i < model.rows(); ++i)
    if (model.hard[i]) hard(position++) = at.gamma(i);
  hard = least_norm(jacobian, hard);
  position = 0;
  for (int i = 0; i < model.rows(); ++i)
    if (model.hard[i]) at.gamma(i) = hard(position++);
}

}  // namespace

Judgement rigid_newton(const Scene& scene, const State& state, double h, const NewtonSettings& settings) {
  RigidSearch search({make_rigid_model(scene), state, h}, settings);
  const RigidModel& model = search.step.model;
  const Point start{search.step.start_velocity(), Vector::Zero(model.rows())};
  Point at = start;
  bool converged = false;
  constexpr double met = 1e-9;
  for (const double threshold : {1e-10, 1e-7, 1e-4}) {
    search.threshold = threshold;
    at = start;
    converged = solve_by_and_by(search, at);
    if (converged && violation(search.step, at) < met) break;
  }
  Judgement j;
  const auto hard = std::count(model.hard.begin(), model.hard.end(), true);
  if (converged && search.rank < hard) {
    take_least_norm(search.step, at);
    j.note = "hard constraints are redundant: rank " + std::to_string(search.rank) + " of " +
             std::to_string(hard) + " rows, multipliers of least norm";
  }
  report(search.step, at.velocity, at.gamma, j);
  j.rank = search.rank;
  j.iterations = search.iterations;
  j.correction = search.correction;
  j.certified = converged && certify_bodies(search.step, at);
  if (!j.certified) j.note += (j.note.empty() ? "" : "; ") + std::string("regularity not shown");
  j.seconds = search.clock.seconds();
  j.outcome = !converged ? Outcome::not_converged : j.infeasible > 1e-8 ? Outcome::infeasible : Outcome::ok;
  if (!converged) j.reason = "stopped after " + std::to_string(search.iterations) + " iterations";
  if (j.outcome == Outcome::infeasible) j.reason = "hard constraints contradict each other";
  return j;
}

}  // namespace pbd::reference
