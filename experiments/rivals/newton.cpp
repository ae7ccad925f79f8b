#include "rivals/newton.h"

#include <cmath>
#include <string>

#include "error.h"
#include "rivals/potential.h"
#include "rivals/stopwatch.h"
#include "validate.h"

namespace pbd::rivals {
namespace {

/// Block row of each node of finite mass, in order; -1 for the others. `blocks` is their number.
std::vector<int> number(const Scene& scene, int& blocks) {
  std::vector<int> block;
  blocks = 0;
  for (const double mass : scene.mass) block.push_back(std::isinf(mass) ? -1 : blocks++);
  if (blocks == 0) throw SetupError("newton: scene mass", "infinite masses only", "at least one finite mass");
  return block;
}

const Scene& checked(const Scene& scene, double h) {
  if (!(h > 0 && std::isfinite(h)))
    throw SetupError("newton: h", std::to_string(h), "a finite number > 0, s");
  validate(scene);
  return scene;
}

/// A point with phi (J) and its gradient (N).
struct Point {
  Points x, gradient;
  double phi = 0;
};

class Newton final : public Rival {
 public:
  Newton(const Scene& scene, double h);
  Report step(State& state, const Budget& budget, const Observer& observer) override;

 private:
  void begin(const State& state);
  void evaluate(Point& point);
  bool finished(const State& state, const Budget& budget);
  bool factorise(bool projected);
  bool find_direction();
  bool search();

  /// |v|_M of movable nodes, sqrt(J); and sqrt(sum_i |g_i|^2/m_i).
  double norm(const Points& v) const { return std::sqrt(v.colwise().squaredNorm().dot(mass_)); }
  double dual_norm(const Points& g) const { return std::sqrt(g.colwise().squaredNorm().dot(inverse_mass_)); }

  double h_;
  int blocks_ = 0;
  std::vector<int> block_;
  Eigen::RowVectorXd mass_, inverse_mass_;  // zero for infinite mass
  Points free_velocity_change_;             // h a
  Potential potential_;
  BlockCholesky matrix_;
  bool quadratic_, factorised_ = false;

  Points target_, direction_;  // y; dx
  Eigen::VectorXd inertia_;    // M/h^2 of the unknowns, N/m
  Eigen::VectorXd right_;      // -grad phi of the unknowns
  Point now_, next_;
  double rounding_ = 0;  // of the residual, sqrt(J)
  Report report_;
};

Newton::Newton(const Scene& scene, double h)
    : h_(h),
      block_(number(checked(scene, h), blocks_)),
      mass_(Eigen::RowVectorXd::Zero(scene.nodes())),
      inverse_mass_(mass_),
      free_velocity_change_(h * acceleration(scene)),
      potential_(scene, block_),
      matrix_(blocks_, potential_.pairs()),
      quadratic_(potential_.quadratic()),
      direction_(Points::Zero(3, scene.nodes())),
      inertia_(3 * blocks_),
      right_(3 * blocks_) {
  potential_.attach(matrix_);
  for (int node = 0; node < scene.nodes(); ++node)
    if (const double mass = scene.mass[static_cast<std::size_t>(node)]; std::isfinite(mass)) {
      mass_(node) = mass;
      inverse_mass_(node) = 1 / mass;
      inertia_.segment<3>(3 * block_[static_cast<std::size_t>(node)]).setConstant(mass / (h * h));
    }
}

void Newton::begin(const State& state) {
  report_ = {};
  rounding_ = 0;
  now_.x = state.x + h_ * state.v;
  target_ = now_.x + h_ * free_velocity_change_;
  timed(report_.evaluate_s, [&] { evaluate(now_); });
}

void Newton::evaluate(Point& point) {
  point.gradient = (point.x - target_) * (mass_ / (h_ * h_)).asDiagonal();
  point.phi = point.gradient.cwiseProduct(point.x - target_).sum() / 2;
  point.phi += potential_.energy(point.x, point.gradient);
}

/// Residual and status of the current point; true if the step is to end there.
bool Newton::finished(const State& state, const Budget& budget) {
  const double scale = norm((now_.x - state.x) / h_ - state.v) + norm(free_velocity_change_);
  const double residual = h_ * dual_norm(now_.gradient);
  report_.residual = residual > 0 ? residual / scale : residual;
  if (!std::isfinite(residual)) {
    report_.status = Status::diverged;
    report_.reason = "not finite";
  } else if (residual <= std::max(budget.tolerance * scale, rounding_)) {
    report_.status = Status::ok;
  } else if (report_.iterations >= budget.max_iterations) {
    report_.reason = "iterations spent";
  } else {
    return false;
  }
  return true;
}

/// H at the current point and its factor; false if it is not positive definite.
bool Newton::factorise(bool projected) {
  timed(report_.assemble_s, [&] {
    matrix_.reset(inertia_);
    potential_.add_stiffness(now_.x, projected, matrix_);
  });
  ++report_.factorisations;
  bool positive = false;
  timed(report_.factorise_s, [&] { positive = matrix_.factorise(); });
  return positive;
}

/// dx = -H^-1 grad phi, and what rounding of x makes of the residual; false if there is no factor.
bool Newton::find_direction() {
  if (!(quadratic_ && factorised_)) factorised_ = factorise(false) || factorise(true);
  if (!factorised_) return false;
  const Eigen::VectorXd diagonal = matrix_.diagonal();
  Points rounding = Points::Zero(3, now_.x.cols());
  for (std::size_t node = 0; node < block_.size(); ++node)
    if (const int first = 3 * block_[node], i = static_cast<int>(node); first >= 0) {
      right_.segment<3>(first) = -now_.gradient.col(i);
      rounding.col(i) = diagonal.segment<3>(first).cwiseProduct(now_.x.col(i));
    }
  rounding_ = std::numeric_limits<double>::epsilon() * h_ * dual_norm(rounding);
  timed(report_.solve_s, [&] {
    const auto solution = matrix_.solve(right_);
    for (std::size_t node = 0; node < block_.size(); ++node)
      if (block_[node] >= 0) direction_.col(static_cast<int>(node)) = solution.segment<3>(3 * block_[node]);
  });
  return true;
}

/// Moves to now + t dx with the largest t of 1, 1/2, 1/4 ... that decreases phi enough (Armijo); false if
/// none does. Where rounding hides the decrease, its derivative tells (hager2005new, eq. 27).
bool Newton::search() {
  constexpr double enough = 1e-4, smallest_step = 1e-6, rounding = 1e-9;
  const double slope = now_.gradient.cwiseProduct(direction_).sum();
  for (double t = 1; t > smallest_step; t /= 2) {
    next_.x = now_.x + t * direction_;
    timed(report_.evaluate_s, [&] { evaluate(next_); });
    const bool decreased = next_.phi <= now_.phi + enough * t * slope;
    const bool flat = next_.phi <= now_.phi + rounding * now_.phi &&
                      next_.gradient.cwiseProduct(direction_).sum() <= (2 * enough - 1) * slope;
    if (decreased || flat) {
      std::swap(now_, next_);
      return true;
    }
  }
  return false;
}

Report Newton::step(State& state, const Budget& budget, const Observer& observer) {
  const auto start = Clock::now();
  double watching = 0;
  begin(state);
  for (;; ++report_.iterations) {
    const bool end = finished(state, budget);
    if (observer) {
      const double seconds = since(start) - watching;
      observer({report_.iterations, seconds, report_.residual, now_.x});
      watching = since(start) - seconds;
    }
    if (end) break;
    if (!find_direction()) {
      report_.reason = "stiffness not positive definite";
      break;
    }
    if (!search()) {
      report_.reason = "no further decrease";
      break;
    }
  }
  if (report_.status != Status::diverged) {
    for (int node = 0; node < state.v.cols(); ++node)
      if (mass_(node) > 0) state.v.col(node) = (now_.x.col(node) - state.x.col(node)) / h_;
    state.x = now_.x;
    state.time += h_;
  }
  report_.seconds = since(start) - watching;
  return report_;
}

}  // namespace

std::unique_ptr<Rival> newton(const Scene& scene, double h) {
  return std::make_unique<Newton>(scene, h);
}

}  // namespace pbd::rivals
