// The memory that a part of the program has allocated and not given back.
#pragma once

#include <cstddef>

namespace pbdcheck {

/// Counts from its making on what all threads have got from the allocator, large pieces in whole pages. What
/// is resident (`PeakMemory`) tells nothing of small scenes: it grows by many pages at once, and not at all
/// where freed ones are used again. Freed pieces up to 1 kB stay in a store of their thread, which counts as
/// allocated, and are taken from it unseen: to be made on a new thread, whose store is empty.
class AllocatedMemory {
 public:
  AllocatedMemory();

  /// MB (1e6 bytes), NaN where glibc's allocator is not in use, as under a sanitizer.
  double megabytes() const;

 private:
  std::size_t before_;  // bytes
};

}  // namespace pbdcheck
