#include "rivals/sweeping.h"

#include <limits>
#include <vector>

#include "rivals/stopwatch.h"

namespace pbd::rivals {

Sweeping::Sweeping(const std::string& name, const Scene& scene, double h)
    : step_(name, scene, h),
      potential_(name, scene, std::vector<int>(static_cast<std::size_t>(scene.nodes()), -1)) {}

Report Sweeping::step(State& state, const Budget& budget, const Observer& observer) {
  Report report;
  double seconds = 0;
  timed(seconds, [&] {
    step_.begin(state);
    now_.x = step_.target;
    begin();
  });
  for (;; ++report.iterations) {
    step_.evaluate(potential_, now_);
    const bool end = step_.finished(now_, budget, rounding(now_.x), report);
    if (observer) observer({report.iterations, seconds, report.residual, now_.x});
    if (end) break;
    before_ = now_.x;
    timed(seconds, [&] { sweep(now_.x); });
    constexpr double rounded = 4 * std::numeric_limits<double>::epsilon();
    if (!((now_.x - before_).cwiseAbs().maxCoeff() <= rounded * now_.x.cwiseAbs().maxCoeff())) continue;
    report.reason = "sweeps change nothing more";
    break;
  }
  if (report.status != Status::diverged) step_.end(now_.x, state);
  report.seconds = seconds;
  return report;
}

}  // namespace pbd::rivals
