#include "harness/interrupt.h"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>

#include "harness/exit_codes.h"
#include "harness/files.h"

namespace pbdcheck {
namespace {

using Time = std::chrono::steady_clock::time_point;

// The one piece of state a signal handler can reach is a global.
std::atomic<Time> asked_to_stop = Time::min();
static_assert(std::atomic<Time>::is_always_lock_free);

/// timeout(1) and some shells signal the program and then its group: what comes this soon is the same
/// request.
constexpr auto same_request = std::chrono::milliseconds(100);

void on_interrupt(int) {
  const Time now = std::chrono::steady_clock::now();
  Time first = Time::min();
  if (asked_to_stop.compare_exchange_strong(first, now) || now - first < same_request) return;
  remove_partial_files();
  _exit(exit_interrupted);
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  std::signal(SIGPIPE, SIG_IGN);  // who reads the terminal's lines may go; the files are written
}

bool interrupted() {
  return asked_to_stop.load() != Time::min();
}

void throw_if_interrupted() {
  if (interrupted()) throw Interrupted{};
}

}  // namespace pbdcheck
