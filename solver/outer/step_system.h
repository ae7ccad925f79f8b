// The step under way: what stays as it is while it runs, its rows, and the iterate. Outer iterations work on
// it, and keep what else they need themselves.
#pragma once

#include <optional>
#include <vector>

#include "linear/linear_solver.h"
#include "method.h"
#include "rows/mass_norm.h"
#include "rows/source.h"
#include "scene.h"

namespace pbd {

/// Const while a step runs.
struct Problem {
  Problem(const Scene& stated_scene, const Method& stated_method)
      : scene(stated_scene), method(stated_method), bodies(stated_scene) {}

  const Scene& scene;
  const Method& method;
  Bodies bodies;
  std::vector<double> inverse_mass;  // 1/kg; the rows' own is changed by a proximal term
  double finite_mass = 0;            // kg, of all nodes that can move
  bool implicit_gyroscopic = false;
  bool hard_constraints = false;
  double direction_blend = 1;

  StepMap map;
  StepCoefficients coefficients{};
  Points start_x, start_v;  // m, m/s, of all columns
  std::vector<Pose> start_poses;
  double start_time = 0, x_time = 0;  // s, where the step begins, and of x(v)

  Configuration start() const { return {start_x, start_poses, start_time}; }
};

/// v_k and what belongs to it.
struct CurrentIterate {
  Points v, x;  // m/s, m
  std::vector<Pose> poses;
  Points rebuilt;            // m/s, v_free + W J_k^T p
  double torque_missed = 0;  // J, what `rebuilt` misses of its gyroscopic torques, squared
};

struct StepSystem {
  StepSystem(const Scene& scene, const Method& method) : problem(scene, method) {}

  Problem problem;
  Rows rows;
  std::vector<Slot> slots;
  LinearSolver solver;
  CurrentIterate at;
  std::vector<double> block_seconds;  // of the current outer iteration's first sweep

  // Where J is taken, if not at x.
  Points directions_x;  // m
  std::vector<Pose> direction_poses;
  std::optional<Configuration> directions;
};

/// How far a step has come.
struct Progress {
  int outer_iterations = 0;
  int iterations_of_rows = 0;  // since rows were found anew
  std::int64_t sweeps = 0, row_updates = 0;
  double primal = 0, dual = 0, scale = 0;  // sqrt(J)
  double change = 0, last_change = 0;      // |v_k - v_k-1|_M, and the one before
  double contraction = 0;                  // of plain, as the last step's end predicts it; NaN: unknown
  double forcing = 0;                      // share of the residual that the linear problem is solved to
  double relaxed_residual = infinity;      // that the last linear problem was solved for
  std::string_view linear_part;            // what solved it
  bool other_solver = false;               // solves the next one

  double residual() const { return larger(primal, dual); }

  /// Begins with other rows: what was learnt of the ones before says nothing of them.
  void begin_rows(const Method& method) {
    iterations_of_rows = 0;
    relaxed_residual = infinity;
    forcing = method.inner_tolerance;
  }
};

/// Residual (sqrt(J)) as small as the outer iteration can use: tighter while its own does not fall.
double inner_accuracy(const Method& method, Progress& progress);

/// Poses at positions x of all columns, kept in `storage`.
Configuration placed(const Problem& problem, const Points& x, std::vector<Pose>& storage, double time);

/// Where J is taken for an iterate at x; null if that is x.
const Configuration* directions_for(StepSystem& system, const Points& x);

/// Refreshes all rows at velocity `v`, x(v), and `rebuilt`, the velocities that the impulses give along the
/// new directions.
RowResidual linearise_at(StepSystem& system, const Points& v);

/// Adds the implicit gyroscopic torque to a velocity; returns what it misses of it, squared in J.
double add_gyroscopic(const StepSystem& system, Points& velocity);

/// Sweeps the rows from the iterate's v and counts the work.
void relax(StepSystem& system, Progress& progress);

}  // namespace pbd
