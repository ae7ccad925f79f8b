// A simulation's steps against a reference that solves them anew from where each begins, and how far from it
// the solver ended, in the metric of masses and as a share of the scale that the step's tolerance refers to.
//
// That may be more than the tolerance, which bounds residuals. Where it is, a reference that knows contact
// starts again from what the solver claims: Coulomb's law may have several solutions, and then it ends next
// to the solver. And it starts so with the features that are near where the step begins, with which the
// solver goes on (solver/effects/contact.h), as far as it states the same ones. Where solutions lie beside
// each other a reference ends at another one all the same: then what is claimed may be told a solution by
// what it leaves of the reference's own equations. A distance that is left else may be either's fault, or
// come from how each states what touches.
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>

#include "harness/judges.h"
#include "harness/results.h"
#include "integrator_map.h"
#include "step/step.h"
#include "step_claim.h"

namespace pbdcheck {

/// How far a step ended from a reference's end: the worst node over the largest displacement, m, and the end
/// velocities' distance as a share of the step's scale: infinite where something without a finite mass or
/// inertia does not keep its velocity, else NaN where the reference found none.
struct StepDistance {
  double relative = std::nan(""), metres = std::nan(""), of_scale = std::nan("");
};

enum class JudgeStart { own, claim, claim_and_features_kept };
inline constexpr std::array<std::string_view, 3> judge_start_names{"own", "claim", "claim and features kept"};

inline constexpr std::string_view not_judged_if_met =
    "contacts act that met on the way of the step: the judge knows those where it ends";

/// Of the scale: an end that is nearer to a solution is next to it.
inline constexpr double next_to_solution = 1e-6;

/// What a reference says of a claim: by itself, and from the start from which it ends nearest to the claim.
struct JudgedClaim {
  Judged reference;
  StepDistance own, nearest;
  JudgeStart start = JudgeStart::own;
  /// What the claim leaves of the reference's equations (reference/judge.h); NaN where it did not start from
  /// it.
  double residual = std::nan("");

  /// It is a solution as it is, and next to none that the reference finds.
  bool solves_as_it_is() const {
    return !(nearest.of_scale <= next_to_solution) && residual <= pbd::reference::allowed_residual;
  }
};

/// `map` is that of another integrator than implicit Euler. Steps in which contacts act that met on the way
/// are `not_judged`. Throws SetupError for what the reference does not know.
JudgedClaim judge_claim(const std::string& reference, const pbd::reference::StepClaim& claim,
                        const pbd::reference::IntegratorMap* map = nullptr);

class StepJudge {
 public:
  /// Judges every step whose number `every` divides, each part of those that are made in parts, by the
  /// reference of that name, into `directory`'s judged.csv. The steps are by the integrator of `method`.
  StepJudge(const std::filesystem::path& directory, std::string reference, std::int64_t every,
            const pbd::Method& method);

  bool due(std::int64_t step) const { return step % every_ == 0; }

  void add(std::int64_t step, const pbd::reference::StepClaim& claim, const pbd::Report& report);

  /// To be told of each step, behind `add`: what an integrator carries on comes from them all.
  void follow(const pbd::reference::StepClaim& claim) { memory_.follow(claim); }

  void close() { table_.close(); }
  const TableTotals& totals() const { return totals_; }

  const std::string& reference() const { return reference_; }
  std::int64_t every() const { return every_; }
  std::int64_t judged() const { return judged_; }
  /// By the reference.
  std::int64_t unsolved() const { return unsolved_; }
  /// Of those judged, by the solver.
  std::int64_t missed() const { return missed_; }
  /// Of steps that both solved, the reference by itself, too: those that are nearest to another solution, and
  /// to one by the features of the step's begin.
  std::int64_t ambiguous() const { return ambiguous_; }
  std::int64_t by_features() const { return by_features_; }
  /// That the reference solved from what is claimed alone.
  std::int64_t from_claim_alone() const { return from_claim_alone_; }
  /// That are solutions as they are, and next to none that the reference finds.
  std::int64_t as_they_are() const { return as_they_are_; }
  /// Of other steps that both solved, from the nearest solution: m, and a share of the scale; NaN of none.
  double worst_error_m() const { return worst_error_m_; }
  double worst_error_of_scale() const { return worst_error_of_scale_; }

  /// For people, one line.
  std::string text() const;

 private:
  std::string reference_;
  std::int64_t every_ = 1, judged_ = 0, unsolved_ = 0, missed_ = 0, compared_ = 0, ambiguous_ = 0,
               by_features_ = 0, from_claim_alone_ = 0, as_they_are_ = 0, worst_step_ = 0;
  double worst_error_m_ = std::nan(""), worst_error_of_scale_ = std::nan("");
  pbd::reference::IntegratorMemory memory_;
  TableTotals totals_;
  Table table_;
};

}  // namespace pbdcheck
