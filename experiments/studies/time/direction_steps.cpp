// Largest stable steps of every scheme, the taut chain's beside 2/(w sqrt(1 - 2 b)) of its fastest mode.
#include <algorithm>
#include <cmath>

#include "harness/measure.h"
#include "studies/time/direction.h"

namespace pbdcheck {
namespace {

using namespace pbd;

struct Search {
  DirectionScene scene;
  double first, ratio;  // the grid of steps: first * ratio^k, s
  int count;
  std::function<double(double h)> duration;     // s
  double (*predicted)(double blend) = nullptr;  // s
};

/// Of the taut chain's fastest mode.
double predicted_step(double blend) {
  return blend < 0.5 ? 2 / (TautChain::frequency(TautChain::links) * std::sqrt(1 - 2 * blend)) : infinity;
}

constexpr double fine_ratio = 1.01;

/// Enough that steps are solved: with implicit directions proximal took up to 1900 outer iterations for the
/// chain's first step, ten times as long as the explicit limit, and none of its forces known beforehand.
constexpr int outer_iterations = 4000;

std::vector<Search> searches(bool full) {
  const double duration = full ? 10 : 2;
  const auto constant = [=](double) { return duration; };
  return {{taut_chain(1e-4), 2e-3, fine_ratio, 357, [](double h) { return 400 * h; }, predicted_step},
          {hard_pendulum(), 1e-3, 1.05, 120, [](double) { return 10.0; }},
          {swinging_tip(10, 1), 1e-3, 1.05, 100, constant},
          {swinging_tip(10, 100), 1e-3, 1.05, 100, constant}};
}

struct Limit {
  double largest = 0;       // s; 0 if even the first step is too large
  bool whole_grid = false;  // stable at the largest step tried
  DirectionRun at_largest{}, beyond{};
};

/// Steps are doubled until one is unstable, the last interval is bisected.
Limit find_limit(const Search& search, const Method& method) {
  const int doubling = static_cast<int>(std::lround(std::log(2) / std::log(search.ratio)));
  Limit limit;
  int stable = -1, unstable = search.count;
  bool found = false;
  for (int k = 0; unstable - stable > 1;
       k = found ? (stable + unstable) / 2 : std::min(k + doubling, search.count - 1)) {
    const double h = search.first * std::pow(search.ratio, k);
    DirectionRun run = simulate(search.scene, method, h, search.duration(h));
    if (run.status == Status::diverged) {
      unstable = k;
      limit.beyond = std::move(run);
      found = true;
    } else {
      stable = k;
      limit.largest = h;
      limit.at_largest = std::move(run);
    }
  }
  if (stable < 0) limit.at_largest = limit.beyond;
  limit.whole_grid = stable == search.count - 1;
  return limit;
}

}  // namespace

void direction_largest_steps(Context& context) {
  // Where a step has several solutions, auto may begin with plain and end at a folded one.
  const auto all = searches(context.full());
  const auto tried =
      joined(joined(position_schemes("proximal"), velocity_schemes()), position_schemes("auto"));
  std::vector<Limit> limits(all.size() * tried.size());
  const auto method_of = [](const Scheme& scheme) {
    Method method = scheme.method;
    if (scheme.family == "position") method.max_outer = outer_iterations;
    return method;
  };
  context.parallel(std::ssize(limits), [&](std::int64_t index) {
    const auto k = static_cast<std::size_t>(index);
    limits[k] = find_limit(all[k / tried.size()], method_of(tried[k % tried.size()]));
  });
  Table table = direction_table(context, "largest_steps",
                                {"largest_step_s", "predicted_step_s", "error", "steps", "missed_steps",
                                 "most_outer_iterations", "limit", "status", "reason"});
  Worst error;
  for (std::size_t k = 0; k < limits.size(); ++k) {
    const Search& search = all[k / tried.size()];
    const Scheme& scheme = tried[k % tried.size()];
    const Limit& limit = limits[k];
    const double predicted =
        search.predicted ? search.predicted(scheme.method.direction_blend) : std::nan("");
    const bool never = predicted == infinity;
    const double apart = never ? (limit.whole_grid ? 0 : infinity) : std::abs(limit.largest / predicted - 1);
    if (search.predicted && scheme.method.outer != "auto") error.add(apart);
    add_row(table, search.scene.name, scheme,
            {limit.largest, predicted, search.predicted ? apart : std::nan(""),
             std::int64_t{limit.at_largest.steps}, std::int64_t{limit.at_largest.missed},
             std::int64_t{limit.at_largest.most_outer},
             limit.whole_grid ? "stable at the largest step tried" : limit.beyond.reason},
            limit.at_largest);
  }
  table.close();
  context.verdict(Basis::theory, "direction.largest_step",
                  "a taut chain is stable up to 2/(w sqrt(1 - 2 b)), from b = 1/2 on up to ten times the "
                  "explicit limit, if proximal "
                  "solves its steps",
                  "largest |measured/predicted - 1|", error.value(), fine_ratio - 1);
}

}  // namespace pbdcheck
