// Sampled steps of scene files, each judged as it is done: a table of them, and how near the solver came.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "harness/experiment.h"
#include "harness/measure.h"

namespace pbdcheck {

/// A scene file with settings as of `--set`, how long it is simulated (s), and after how many steps each one
/// is judged; in the full tier five times as often, over twice the time.
struct JudgedScene {
  std::string_view name;
  double duration;
  std::int64_t every;
  std::vector<std::string> settings{};
};

/// The setting by which the cow touches the ground with its nodes: with all of its surface the judge takes
/// minutes a frame.
inline constexpr std::string_view cow_of_nodes = "solid.0.contact={ radius_m = 0 }";

/// What the judge makes of the sampled steps of some runs.
struct SampledSteps {
  std::int64_t sampled = 0;
  std::int64_t missed = 0;       // their tolerance; one that diverged ends its run
  std::int64_t unknown = 0;      // to the judge, of the others
  std::int64_t as_they_are = 0;  // solutions as they are, next to none that the judge finds
  Worst nearest;  // of the rest, distance from a solution over the scale; NaN where none was found

  std::int64_t compared() const { return sampled - missed - unknown - as_they_are; }
  /// "distance over the step's scale, of 8 of 12 sampled steps (stack, step 3); 2 missed their tolerance; 1
  /// the judge does not know; by the judge's equations, to 1e-9, 1 is a solution next to none that it finds".
  std::string quantity() const;
};

class JudgedFrames {
 public:
  /// A table of that name.
  JudgedFrames(Context& context, std::string_view table);

  /// Simulates the scene at a tolerance and judges its sampled steps; one unit of the experiment's work.
  void run(const JudgedScene& each, double tolerance, SampledSteps& of_all);

  void close() { table_.close(); }

 private:
  Context& context_;
  Table table_;
};

}  // namespace pbdcheck
