#include "rivals/implicit_step.h"

#include <algorithm>
#include <string>

#include "error.h"
#include "rivals/potential.h"
#include "validate.h"

namespace pbd::rivals {

namespace {

const Scene& checked(const std::string& rival, const Scene& scene, double h) {
  if (!(h > 0 && std::isfinite(h)))
    throw SetupError(rival + ": h", std::to_string(h), "a finite number > 0, s");
  validate(scene);
  return scene;
}

}  // namespace

ImplicitStep::ImplicitStep(const std::string& rival, const Scene& scene, double step_s)
    : h(step_s),
      mass(Eigen::RowVectorXd::Zero(checked(rival, scene, step_s).nodes())),
      inverse_mass(mass),
      free_velocity_change_(step_s * acceleration(scene)) {
  for (int node = 0; node < scene.nodes(); ++node)
    if (const double own = scene.mass[static_cast<std::size_t>(node)]; std::isfinite(own)) {
      mass(node) = own;
      inverse_mass(node) = 1 / own;
    }
  if (mass.isZero(0))
    throw SetupError(rival + ": scene mass", "infinite masses only", "at least one finite mass");
}

void ImplicitStep::begin(const State& state) {
  start = state.x + h * state.v;
  target = start + h * free_velocity_change_;
}

void ImplicitStep::evaluate(const Potential& potential, Point& point) const {
  point.gradient = (point.x - target) * (mass / (h * h)).asDiagonal();
  point.phi = point.gradient.cwiseProduct(point.x - target).sum() / 2;
  point.phi += potential.energy(point.x, point.gradient);
}

bool ImplicitStep::finished(const Point& now, const Budget& budget, double rounding, Report& report) const {
  const double scale = norm((now.x - start) / h) + norm(free_velocity_change_);
  const double residual = h * dual_norm(now.gradient);
  report.residual = residual > 0 ? residual / scale : residual;
  if (!std::isfinite(residual)) {
    report.status = Status::diverged;
    report.reason = "not finite";
  } else if (residual <= std::max(budget.tolerance * scale, rounding)) {
    report.status = Status::ok;
  } else if (report.iterations >= budget.max_iterations) {
    report.reason = "iterations spent";
  } else {
    return false;
  }
  return true;
}

void ImplicitStep::end(const Points& x, State& state) const {
  for (int node = 0; node < state.v.cols(); ++node)
    if (mass(node) > 0) state.v.col(node) = (x.col(node) - state.x.col(node)) / h;
  state.x = x;
  state.time += h;
}

}  // namespace pbd::rivals
