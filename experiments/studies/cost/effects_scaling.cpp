// Does the time of a sweep grow linearly with the scene, beyond the caches?
#include "studies/cost/effects_scaling.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "harness/measure.h"
#include "harness/order_fit.h"
#include "harness/rows_of_step.h"
#include "scenes/standard.h"
#include "studies/cost/swept.h"

namespace pbdcheck {
namespace {

using namespace pbd;

/// Seconds a sweep of each step by repeats, [size][repeat]: each repeat goes through all sizes, so that what
/// else the machine does meets all of them.
std::vector<std::vector<double>> sweep_seconds(const std::vector<LinearStep>& steps,
                                               std::string_view relaxation) {
  constexpr int repeats = 5;
  std::vector<Sweeps> sweeps;
  for (const LinearStep& step : steps) sweeps.emplace_back(step.rows, step.v_free, relaxation);
  std::vector<std::vector<double>> seconds(steps.size());
  for (int repeat = 0; repeat < repeats; ++repeat)
    for (std::size_t i = 0; i < steps.size(); ++i)
      seconds[i].push_back(least_seconds([&] { sweeps[i].sweep(); }));
  return seconds;
}

/// Of each repeat, the fitted exponent of the sizes from `first` on; times are [size][repeat].
std::vector<double> exponents(const std::vector<double>& rows, const std::vector<std::vector<double>>& time,
                              std::size_t first) {
  const auto from = static_cast<std::ptrdiff_t>(first);
  std::vector<double> all;
  for (std::size_t repeat = 0; repeat < time[0].size(); ++repeat) {
    std::vector<double> each;
    for (std::size_t i = first; i < time.size(); ++i) each.push_back(time[i][repeat]);
    all.push_back(fitted_order({rows.begin() + from, rows.end()}, each));
  }
  return all;
}

/// The first size from which on, as far as two remain, the rows are larger than the caches; 0 if the system
/// does not say how large these are.
std::size_t first_beyond_caches(const std::vector<double>& bytes) {
  const auto cache = static_cast<double>(sysconf(_SC_LEVEL3_CACHE_SIZE));
  std::size_t first = 0;
  while (first + 2 < bytes.size() && bytes[first] <= cache) ++first;
  return first;
}

struct Family {
  std::string name;
  std::vector<int> sizes;  // elements, about
  std::int64_t rows_an_element;
  Scene (*make)(int);
};

Scene chain_of(int links) {
  return chain(links);
}

void scale(Context& context, Table& table, const Family& family) {
  const std::vector<std::string> relaxations{"gauss_seidel", "nesterov_jacobi"};
  std::vector<double> rows, memory;
  std::vector<LinearStep> steps;
  for (const int size : family.sizes) {
    const Scene scene = family.make(size);
    steps.push_back(linear_step(scene, scene.initial, 1.0 / 240));
    rows.push_back(static_cast<double>(row_count(steps.back().rows)));
    memory.push_back(static_cast<double>(bytes(steps.back().rows.blocks)));
    context.advance(family.name);
  }
  std::vector<std::vector<std::vector<double>>> time;  // [relaxation][size][repeat]
  for (const std::string& relaxation : relaxations) time.push_back(sweep_seconds(steps, relaxation));
  const std::size_t first = first_beyond_caches(memory);
  WorstSpread worst;
  for (std::size_t r = 0; r < relaxations.size(); ++r) {
    const auto found = exponents(rows, time[r], first);
    const double exponent = Measured(found).value;
    for (std::size_t i = 0; i < rows.size(); ++i)
      table.row({family.name, relaxations[r], static_cast<std::int64_t>(rows[i]),
                 static_cast<std::int64_t>(rows[i]) / family.rows_an_element,
                 static_cast<std::int64_t>(memory[i]),
                 *std::min_element(time[r][i].begin(), time[r][i].end()), exponent, "ok", ""});
    worst.add(off_linear(found), relaxations[r]);
  }
  context.verdict(
      Basis::theory, "effects.linear." + family.name,
      "the time of a sweep grows linearly with the rows, nearer than n^(4/3)",
      fmt::format("|exponent - 1| from {:g} to {:g} rows ({})", rows[first], rows.back(), worst.owner()),
      worst.value(), off_linear_bound);
}

}  // namespace

void effects_scaling(Context& context) {
  Table table = context.table("scaling", {"scene", "relaxation", "rows", "elements", "bytes",
                                          "wall_s_per_sweep", "exponent", "status", "reason"});
  scale(context, table, {"chain", {1'000, 10'000, 100'000, 300'000, 1'000'000}, 1, chain_of});
  scale(context, table, {"solid", {1'000, 10'000, 100'000, 300'000}, 6, clamped_cube});
  table.close();
}

}  // namespace pbdcheck
