// A simulation's steps against a reference that solves them anew from where each begins, and how far from it
// the solver ended, in the metric of masses and as a share of the scale that the step's tolerance refers to.
//
// That may be more than the tolerance, which bounds residuals. Two reasons can be told apart: where the
// distance is more than the tolerance, a reference that knows contact starts again from what the solver
// claims. Coulomb's law may have several solutions: then it ends next to the solver. And the solver goes on
// with the features that are near where a step begins (solver/effects/contact.h): then it does if it keeps
// those, too.
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>

#include "harness/judges.h"
#include "harness/results.h"
#include "step/step.h"
#include "step_claim.h"

namespace pbdcheck {

/// How far a step ended from a reference's end: the worst node over the largest displacement, m, and the end
/// velocities' distance as a share of the step's scale. NaN where the reference found none.
struct StepDistance {
  double relative = std::nan(""), metres = std::nan(""), of_scale = std::nan("");
};

/// What a reference says of a claim: by itself, and from the start from which it ends nearest to the claim.
struct JudgedClaim {
  Judged reference;
  StepDistance own, nearest;
  std::string_view start = "own";
};

/// Throws SetupError for what the reference does not know.
JudgedClaim judge_claim(const std::string& reference, const pbd::reference::StepClaim& claim);

class StepJudge {
 public:
  /// Judges every step whose number `every` divides, by the reference of that name, into `directory`'s
  /// judged.csv.
  StepJudge(const std::filesystem::path& directory, std::string reference, std::int64_t every);

  bool due(std::int64_t step) const { return step % every_ == 0; }

  void add(std::int64_t step, const pbd::reference::StepClaim& claim, const pbd::Report& report);

  void close() { table_.close(); }
  const TableTotals& totals() const { return totals_; }

  const std::string& reference() const { return reference_; }
  std::int64_t every() const { return every_; }
  std::int64_t judged() const { return judged_; }
  /// By the reference.
  std::int64_t unsolved() const { return unsolved_; }
  /// Of those judged, by the solver.
  std::int64_t missed() const { return missed_; }
  /// Of steps that both solved: those that are nearest to another solution than the one that the reference
  /// finds by itself, and to one by the features of the step's begin.
  std::int64_t ambiguous() const { return ambiguous_; }
  std::int64_t by_features() const { return by_features_; }
  /// Of steps that both solved, from the nearest solution: m, and a share of the scale.
  double worst_error_m() const { return worst_error_m_; }
  double worst_error_of_scale() const { return worst_error_of_scale_; }

  /// One sentence.
  std::string text() const;

 private:
  std::string reference_;
  std::int64_t every_ = 1, judged_ = 0, unsolved_ = 0, missed_ = 0, ambiguous_ = 0, by_features_ = 0,
               worst_step_ = 0;
  double worst_error_m_ = 0, worst_error_of_scale_ = 0;
  TableTotals totals_;
  Table table_;
};

}  // namespace pbdcheck
