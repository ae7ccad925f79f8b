#include "rivals/newton.h"

#include <cmath>

#include "rivals/implicit_step.h"
#include "rivals/potential.h"
#include "rivals/stopwatch.h"

namespace pbd::rivals {
namespace {

/// Block row of each node of finite mass, in order; -1 for the others. `blocks` is their number.
std::vector<int> number(const Eigen::RowVectorXd& mass, int& blocks) {
  std::vector<int> block;
  blocks = 0;
  for (const double own : mass) block.push_back(own > 0 ? blocks++ : -1);
  return block;
}

class Newton final : public Rival {
 public:
  Newton(const Scene& scene, double h);
  Report step(State& state, const Budget& budget, const Observer& observer) override;

 private:
  void evaluate(Point& point) { step_.evaluate(potential_, point); }
  bool factorise(bool projected);
  bool find_direction();
  bool search();

  ImplicitStep step_;
  int blocks_ = 0;
  std::vector<int> block_;
  Potential potential_;
  BlockCholesky matrix_;
  bool quadratic_, factorised_ = false;

  Points direction_;         // dx, m
  Eigen::VectorXd inertia_;  // M/h^2 of the unknowns, N/m
  Eigen::VectorXd right_;    // -grad phi of the unknowns
  Point now_, next_;
  double rounding_ = 0;  // of the residual, sqrt(J)
  Report report_;
};

Newton::Newton(const Scene& scene, double h)
    : step_("newton", scene, h),
      block_(number(step_.mass, blocks_)),
      potential_("newton", scene, block_),
      matrix_(blocks_, potential_.pairs()),
      quadratic_(potential_.quadratic()),
      direction_(Points::Zero(3, scene.nodes())),
      inertia_(3 * blocks_),
      right_(3 * blocks_) {
  potential_.attach(matrix_);
  for (int node = 0; node < scene.nodes(); ++node)
    if (const int first = 3 * block_[static_cast<std::size_t>(node)]; first >= 0)
      inertia_.segment<3>(first).setConstant(step_.mass(node) / (h * h));
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
  rounding_ = std::numeric_limits<double>::epsilon() * step_.h * step_.dual_norm(rounding);
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
  report_ = {};
  rounding_ = 0;
  step_.begin(state);
  now_.x = step_.start;
  timed(report_.evaluate_s, [&] { evaluate(now_); });
  for (;; ++report_.iterations) {
    const bool end = step_.finished(now_, budget, rounding_, report_);
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
  if (report_.status != Status::diverged) step_.end(now_.x, state);
  report_.seconds = since(start) - watching;
  return report_;
}

}  // namespace

std::unique_ptr<Rival> newton(const Scene& scene, double h) {
  return std::make_unique<Newton>(scene, h);
}

}  // namespace pbd::rivals
