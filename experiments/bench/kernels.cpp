// Kernels of a step beside copying memory, on one thread and on two: time, constraints a second, and the
// bytes that each moves at least a second.
//   build/release/kernels --benchmark_filter=solid
#include <benchmark/benchmark.h>

#include <string>
#include <utility>

#include "harness/rows_of_step.h"
#include "linear/linear_solver.h"
#include "scenes/standard.h"
#include "threads/threads.h"

namespace pbdcheck {
namespace {

using namespace pbd;

/// About 3e5 tetrahedra, 172 MB of rows.
const Scene& solid() {
  static const Scene scene = clamped_cube(300'000);
  return scene;
}

/// About 1e6 links, 64 MB of rows.
const Scene& sheet() {
  static const Scene scene = cloth(577, true);
  return scene;
}

/// Rows with every mode excited, divided among as many threads as the benchmark asks for.
LinearStep stirred(const Scene& still, const benchmark::State& state) {
  Scene scene = still;
  stir(scene);
  LinearStep step = linear_step(scene, scene.initial, 1.0 / 240);
  divide(step.rows, static_cast<int>(state.range(0)));
  return step;
}

void copy(benchmark::State& state) {
  const Eigen::Index columns = 1 << 23;
  const Points from = Points::Ones(3, columns);
  Points to = Points::Zero(3, columns);
  for (auto _ : state)
    each_columns(static_cast<int>(state.range(0)), columns, [&](Eigen::Index first, Eigen::Index count) {
      to.middleCols(first, count) = from.middleCols(first, count);
    });
  state.SetBytesProcessed(state.iterations() * 2 * from.size() * static_cast<std::int64_t>(sizeof(double)));
}

template <class Solver>
void sweep(benchmark::State& state, const Scene& (*scene)()) {
  LinearStep step = stirred(scene(), state);
  Solver solver;
  solver.begin(step.rows, step.v_free, true);
  for (auto _ : state) solver.sweep(step.rows, step.v_free, nullptr);
  state.SetItemsProcessed(state.iterations() * constraints_of(step.rows));
  state.SetBytesProcessed(state.iterations() * least_bytes(step.rows));
}

void linearise(benchmark::State& state, const Scene& (*scene)()) {
  StepRows step(scene(), scene().initial, 1.0 / 240, Friction::coulomb, static_cast<int>(state.range(0)));
  const Points v = Points::Zero(3, step.v_free().cols());
  for (auto _ : state) step.linearise(v);
  state.SetItemsProcessed(state.iterations() * constraints_of(step.rows()));
}

template <class... Arguments>
void on_one_and_two(const std::string& name, Arguments... arguments) {
  benchmark::RegisterBenchmark(name.c_str(), arguments...)
      ->ArgName("threads")
      ->Arg(1)
      ->Arg(2)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

void register_kernels() {
  on_one_and_two("copy", copy);
  using MakesScene = const Scene& (*)();
  for (const auto& [of, scene] : {std::pair<std::string, MakesScene>{"/solid", solid}, {"/sheet", sheet}}) {
    on_one_and_two("linearise" + of, linearise, scene);
    on_one_and_two("gauss_seidel" + of, sweep<GaussSeidel>, scene);
    on_one_and_two("coloured_gauss_seidel" + of, sweep<ColouredGaussSeidel>, scene);
    on_one_and_two("jacobi" + of, sweep<Jacobi>, scene);
    on_one_and_two("nesterov_jacobi" + of, sweep<NesterovJacobi>, scene);
    on_one_and_two("conjugate_gradients" + of, sweep<ConjugateGradients>, scene);
  }
}

}  // namespace
}  // namespace pbdcheck

int main(int count, char** arguments) {
  benchmark::Initialize(&count, arguments);
  if (benchmark::ReportUnrecognizedArguments(count, arguments)) return 2;
  pbdcheck::register_kernels();
  benchmark::RunSpecifiedBenchmarks();
}
