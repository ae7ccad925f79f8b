#include "interrupt.h"

#include <csignal>

namespace pbdcheck {
namespace {

// The one piece of state a signal handler can reach is a global.
volatile std::sig_atomic_t asked_to_stop = 0;

void on_interrupt(int signal) {
  asked_to_stop = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
}

bool interrupted() {
  return asked_to_stop != 0;
}

}  // namespace pbdcheck
