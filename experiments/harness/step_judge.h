// A simulation's steps against a reference that solves them anew from where each begins, and how far from it
// the solver ended. A step that stands still has no displacement to compare with, so that errors are told
// against what the step's tolerance is a share of, too.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "harness/results.h"
#include "step/step.h"

namespace pbdcheck {

class StepJudge {
 public:
  /// Judges every step whose number `every` divides, by the reference of that name, into `directory`'s
  /// judged.csv.
  StepJudge(const std::filesystem::path& directory, std::string reference, std::int64_t every);

  bool due(std::int64_t step) const { return step % every_ == 0; }

  /// A step of h seconds by `method`. Throws SetupError for what the reference does not know.
  void add(std::int64_t step, const pbd::Scene& scene, const pbd::Method& method, const pbd::State& begun,
           const pbd::State& ended, double h, const pbd::Report& report);

  void close() { table_.close(); }
  const TableTotals& totals() const { return totals_; }

  const std::string& reference() const { return reference_; }
  std::int64_t every() const { return every_; }
  std::int64_t judged() const { return judged_; }
  /// Of steps that both solved.
  std::int64_t unsolved() const { return unsolved_; }
  double worst_error_m() const { return worst_error_m_; }
  double worst_error_of_scale() const { return worst_error_of_scale_; }

  /// One sentence.
  std::string text() const;

 private:
  std::string reference_;
  std::int64_t every_ = 1, judged_ = 0, unsolved_ = 0, worst_step_ = 0;
  double worst_error_m_ = 0, worst_error_of_scale_ = 0;
  TableTotals totals_;
  Table table_;
};

}  // namespace pbdcheck
