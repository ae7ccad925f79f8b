#include "threads/threads.h"

namespace pbd {

void run_tasks(int threads, std::size_t count, void (*task)(void* context, std::size_t k), void* context) {
  if (threads <= 1 || count <= 1) {
    for (std::size_t k = 0; k < count; ++k) task(context, k);
    return;
  }
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::size_t k = 0; k < count; ++k) task(context, k);
}

void run_groups(int threads, std::span<const int> first, void (*task)(void* context, std::size_t k),
                void* context) {
  if (threads <= 1) {
    for (int k = 0; k < first.back(); ++k) task(context, static_cast<std::size_t>(k));
    return;
  }
#pragma omp parallel num_threads(threads)
  for (std::size_t g = 0; g + 1 < first.size(); ++g) {
#pragma omp for schedule(static, 1)
    for (int k = first[g]; k < first[g + 1]; ++k) task(context, static_cast<std::size_t>(k));
  }
}

}  // namespace pbd
