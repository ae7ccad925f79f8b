#include "rivals/xpbd.h"

#include <limits>

#include "rivals/implicit_step.h"
#include "rivals/potential.h"
#include "rivals/stopwatch.h"

namespace pbd::rivals {
namespace {

class Xpbd final : public Rival {
 public:
  Xpbd(const Scene& scene, double h)
      : step_("xpbd", scene, h),
        potential_("xpbd", scene, std::vector<int>(static_cast<std::size_t>(scene.nodes()), -1)) {}

  Report step(State& state, const Budget& budget, const Observer& observer) override {
    Report report;
    double seconds = 0;
    timed(seconds, [&] {
      step_.begin(state);
      now_.x = step_.target;
      multiplier_.assign(potential_.elements(), 0.0);
    });
    for (;; ++report.iterations) {
      step_.evaluate(potential_, now_);
      const bool end = step_.finished(now_, budget, 0, report);
      if (observer) observer({report.iterations, seconds, report.residual, now_.x});
      if (end) break;
      before_ = now_.x;
      timed(seconds, [&] { potential_.sweep(step_.inverse_mass, step_.h, multiplier_, now_.x); });
      constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
      if (!((now_.x - before_).cwiseAbs().maxCoeff() <= rounding * now_.x.cwiseAbs().maxCoeff())) continue;
      report.reason = "sweeps change nothing beside the solution";
      break;
    }
    if (report.status != Status::diverged) step_.end(now_.x, state);
    report.seconds = seconds;
    return report;
  }

 private:
  ImplicitStep step_;
  Potential potential_;
  Point now_;
  Points before_;
  std::vector<double> multiplier_;  // of the elements, sqrt(J) s^2
};

}  // namespace

std::unique_ptr<Rival> xpbd(const Scene& scene, double h) {
  return std::make_unique<Xpbd>(scene, h);
}

}  // namespace pbd::rivals
