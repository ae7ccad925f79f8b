// The linear rows of a step, and their exact solution by a dense factorisation.
#pragma once

#include "effects/sources.h"
#include "scene.h"

namespace pbdcheck {

struct LinearStep {
  pbd::Rows rows;      // impulses zero
  pbd::Points v_free;  // m/s
};

/// The rows of an implicit Euler step of h seconds from `state`; those of contacts by `law`.
class StepRows {
 public:
  StepRows(const pbd::Scene& scene, const pbd::State& state, double h, pbd::Friction law, int threads = 1);

  /// Linearises them where velocities v (m/s, of nodes and then of bodies' rotations) lead, impulses zero.
  void linearise(const pbd::Points& v);

  /// True if the solution asks for other rows: contacts have been found anew. `impulse` is of contacts with
  /// friction, N s, three each in the rows' order; what is below `tolerance` of the largest counts as none.
  bool widen(const pbd::Points& v, const Eigen::VectorXd& impulse, double tolerance);

  const pbd::Rows& rows() const { return rows_; }
  std::string_view effect_of(std::size_t block) const;
  const pbd::Points& v_free() const { return map_.v_free; }

  /// Where velocities v lead.
  pbd::State end(const pbd::Points& v) const;

 private:
  pbd::Configuration start() const { return {map_.x0, start_poses_, time_}; }
  pbd::StepBegin step_begin(const pbd::Configuration& start) const;
  pbd::Configuration reached(const pbd::Points& v);

  const pbd::Scene& scene_;
  pbd::Rows rows_;
  std::vector<pbd::Slot> slots_;
  pbd::Bodies bodies_;
  std::vector<pbd::Pose> start_poses_, poses_;
  pbd::StepMap map_;
  pbd::StepCoefficients coefficients_;
  pbd::Points start_v_, no_acceleration_, x_;
  double time_;
};

/// How many constraints the rows are of.
std::int64_t constraints_of(const pbd::Rows& rows);

/// Bytes that a sweep over the rows moves at least: the rows once, their impulses twice, and the velocity of
/// each column in and out.
std::int64_t least_bytes(const pbd::Rows& rows);

/// Adds smooth velocities that excite every mode.
void stir(pbd::Scene& scene);

/// Implicit Euler rows of h seconds from `state`, linearised at its positions; those of contacts by `law`.
LinearStep linear_step(const pbd::Scene& scene, const pbd::State& state, double h,
                       pbd::Friction law = pbd::Friction::coulomb);

/// Velocities (m/s) that solve the rows exactly, by Eigen's dense LDL^T of N = J W J^T + Sigma.
pbd::Points dense_solution(const LinearStep& step);

/// sqrt(sum_i r_i^T N_ii^-1 r_i) of r = J v + b + Sigma p at the rows' impulses, sqrt(J).
double residual(const pbd::Rows& rows, const pbd::Points& v);

/// 1 + lambda^(-1/2), lambda the least eigenvalue above rounding of N = J W J^T + Sigma beside its blocks
/// N_ii, of the rows of an implicit Euler step of h seconds, with what is near as it begins, where `end` is.
double error_per_residual(const pbd::Scene& scene, const pbd::State& begin, const pbd::State& end, double h,
                          pbd::Friction law);

}  // namespace pbdcheck
