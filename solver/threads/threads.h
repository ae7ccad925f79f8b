// Work on several threads, divided so that no result depends on how many there are: into tasks whose number
// follows from the work alone, and whose sums are added in their order. OpenMP runs them: it comes with the
// compiler, and loops over independent tasks are all that is asked for. What oneTBB adds, work stealing among
// nested tasks, nothing here uses.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <type_traits>

namespace pbd {

/// task(context, k) for k < count on so many threads, one of which is the caller's. None may throw.
void run_tasks(int threads, std::size_t count, void (*task)(void* context, std::size_t k), void* context);

/// f(k) for k < count.
template <class F>
void each_task(int threads, std::size_t count, F&& f) {
  run_tasks(
      threads, count,
      [](void* context, std::size_t k) { (*static_cast<std::remove_reference_t<F>*>(context))(k); }, &f);
}

/// The same for all k of groups, one group after the other. `first` states where each begins, and then the
/// total.
void run_groups(int threads, std::span<const int> first, void (*task)(void* context, std::size_t k),
                void* context);

/// f(k) for all k of the groups.
template <class F>
void each_of_groups(int threads, std::span<const int> first, F&& f) {
  run_groups(
      threads, first,
      [](void* context, std::size_t k) { (*static_cast<std::remove_reference_t<F>*>(context))(k); }, &f);
}

inline constexpr std::size_t most_tasks = 32;  // of a loop: several for each thread of a desktop's processor

/// f(first, last, sum) for parts of [0, count); what each adds to its own sum is added to `total` in order.
template <class Sum, class F>
void add_parts(int threads, std::size_t count, Sum& total, F&& f) {
  const std::size_t tasks = std::min(count, most_tasks);
  if (tasks <= 1) {
    if (count > 0) f(std::size_t{0}, count, total);
    return;
  }
  std::array<Sum, most_tasks> part{};
  each_task(threads, tasks, [&](std::size_t k) {
    Sum own{};  // not in `part`, whose lines of the cache threads would pass to and fro
    f(k * count / tasks, (k + 1) * count / tasks, own);
    part[k] = own;
  });
  for (std::size_t k = 0; k < tasks; ++k) total += part[k];
}

/// Of what has no sum.
struct Nothing {
  Nothing& operator+=(const Nothing&) { return *this; }
};

/// Several sums.
template <int N>
struct Sums : std::array<double, N> {
  Sums& operator+=(const Sums& other) {
    for (std::size_t k = 0; k < N; ++k) (*this)[k] += other[k];
    return *this;
  }
};

/// Of a task: 100 kB of velocities take far longer than to begin one.
inline constexpr std::size_t columns_together = 4096;

/// f(first, count, sum) for ranges of columns.
template <class Sum, class F>
void add_columns(int threads, std::ptrdiff_t columns, Sum& total, F&& f) {
  const auto count = static_cast<std::size_t>(columns);
  add_parts(threads, (count + columns_together - 1) / columns_together, total,
            [&](std::size_t begin, std::size_t end, Sum& sum) {
              const std::size_t first = begin * columns_together;
              f(static_cast<std::ptrdiff_t>(first),
                static_cast<std::ptrdiff_t>(std::min(end * columns_together, count) - first), sum);
            });
}

/// f(first, count) for ranges of columns.
template <class F>
void each_columns(int threads, std::ptrdiff_t columns, F&& f) {
  Nothing nothing;
  add_columns(threads, columns, nothing,
              [&](std::ptrdiff_t first, std::ptrdiff_t count, Nothing&) { f(first, count); });
}

}  // namespace pbd
