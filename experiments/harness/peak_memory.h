// The memory that a part of the program takes at most.
#pragma once

namespace pbdcheck {

/// Counts from its making on: what is resident then is not counted.
class PeakMemory {
 public:
  PeakMemory();

  /// MB (1e6 bytes), NaN where the system (other than Linux) tells none.
  double megabytes() const;

 private:
  double before_;  // bytes
};

}  // namespace pbdcheck
