#include "rows/threads.h"

namespace pbd {

void run_tasks(int threads, std::size_t count, void (*task)(void* context, std::size_t k), void* context) {
  if (threads <= 1 || count <= 1) {
    for (std::size_t k = 0; k < count; ++k) task(context, k);
    return;
  }
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::size_t k = 0; k < count; ++k) task(context, k);
}

}  // namespace pbd
