#include "harness/peak_memory.h"

#include <malloc.h>

#include <cmath>
#include <fstream>
#include <string>

namespace pbdcheck {
namespace {

/// Bytes of a line of the process's status (proc(5)), NaN without one.
double status_bytes(const std::string& key) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(key)) return 1024 * std::stod(line.substr(key.size()));
  return std::nan("");
}

}  // namespace

PeakMemory::PeakMemory() {
  malloc_trim(0);                               // what is free is given back: it would be taken unseen
  std::ofstream("/proc/self/clear_refs") << 5;  // the peak begins anew
  before_ = status_bytes("VmRSS:");
}

double PeakMemory::megabytes() const {
  return (status_bytes("VmHWM:") - before_) / 1e6;
}

}  // namespace pbdcheck
