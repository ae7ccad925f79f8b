#include "harness/allocated_memory.h"

#include <malloc.h>

#include <cmath>

namespace pbdcheck {
namespace {

/// Large pieces are mapped apart from the heaps.
std::size_t allocated_bytes() {
  const struct mallinfo2 heaps = mallinfo2();
  return heaps.uordblks + heaps.hblkhd;
}

}  // namespace

AllocatedMemory::AllocatedMemory() : before_(allocated_bytes()) {}

double AllocatedMemory::megabytes() const {
  if (before_ == 0) return std::nan("");
  return (static_cast<double>(allocated_bytes()) - static_cast<double>(before_)) / 1e6;
}

}  // namespace pbdcheck
