// Time that a thread has worked: other work on the machine makes nothing slow.
#pragma once

#include <ctime>

namespace pbdcheck {

/// s, of this thread.
inline double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace pbdcheck
