// The steps of a simulation, judged as they are done (reference/step_check.h), and what was found.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "step/step.h"
#include "step_check.h"

namespace pbdcheck {

/// What a step of `workspace` from `start` to `end` claims.
pbd::reference::StepClaim claim_of(const pbd::Scene& scene, const pbd::Workspace& workspace,
                                   const pbd::State& start, const pbd::State& end, double h,
                                   const pbd::Report& report);

class StepChecks {
 public:
  struct Refuted {
    std::int64_t step;
    pbd::reference::Finding finding;
  };

  /// Judges step number `step`; those that missed their tolerance claim nothing. `changes`: the scene is
  /// another one than in the last step.
  void add(std::int64_t step, const pbd::reference::StepClaim& claim, pbd::Status status, bool changes);

  std::int64_t judged() const { return judged_; }
  std::int64_t missed() const { return missed_; }
  std::int64_t refuted_steps() const { return refuted_steps_; }
  const std::vector<Refuted>& refuted() const { return refuted_; }
  const std::map<std::string, std::int64_t>& left_out() const { return left_out_; }
  std::int64_t compared() const { return compared_; }

  /// One sentence.
  std::string text() const;

 private:
  std::optional<pbd::reference::StepCheck> check_;
  std::int64_t judged_ = 0, missed_ = 0, refuted_steps_ = 0, compared_ = 0;
  std::vector<Refuted> refuted_;
  std::map<std::string, std::int64_t> left_out_;
};

}  // namespace pbdcheck
