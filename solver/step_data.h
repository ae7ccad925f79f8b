// What a step works on: rows, iterates and the tools of the outer iterations. Allocated once a workspace.
#pragma once

#include <optional>
#include <vector>

#include "acceleration.h"
#include "contact_rows.h"
#include "hard_rows.h"
#include "linearise.h"
#include "outer.h"
#include "quasi_newton.h"
#include "relaxation.h"
#include "step.h"

namespace pbd {

/// Above this contraction the accelerated proximal iteration is the faster one.
inline constexpr double slow_contraction = 0.7;

/// What an integrator keeps of earlier steps; the arrays stay empty where it asks for none.
struct History {
  double h = 0;  // s, of the last step; 0 if there is none
  Points x, v;   // where the last step began
  Points q, a;   // m/s^2, as in integrators.h
};

struct StepData {
  Integrator integrator;
  Outer outer;
  std::vector<bool> eliminated;  // of each block: its impulses are its own, p = -Sigma^-1 c/d
  bool on_potential = false;     // all are
  bool in_metric = false;        // some may be, and the others are solved in the metric of quasi_newton
  Relaxation relaxation;
  std::vector<std::size_t> effect_of_block;
  Rows rows;
  ContactRows contacts;
  Bodies bodies;
  bool implicit_gyroscopic = false;
  std::vector<Pose> start_poses, poses, other_poses;  // at start_x, x and where else a constraint is taken
  std::vector<double> inverse_mass;                   // 1/kg; the rows' own is changed by a proximal term
  double finite_mass = 0;                             // kg, of all nodes that can move

  StepMap map;
  StepCoefficients coefficients{};  // of this step, and of the last one until the next begins
  History history;
  bool hard_constraints = false;
  double direction_blend = 1;  // of this step
  Points start_x, start_v;     // m, m/s, of all columns, where the step begins
  Points directions_x;         // m, where J is taken; empty if that is x
  std::vector<Pose> direction_poses;
  double x_time = 0;  // s, of x
  State ended;        // where the last step ended, kept where there are rigid bodies
  Points acceleration, zero, v, x, rebuilt, previous;
  double torque_missed = 0;            // J, what `rebuilt` misses of its gyroscopic torques, squared
  double change = 0, last_change = 0;  // |v_k - v_k-1|_M, and the one before
  std::vector<double> seconds;         // per block, of the current outer iteration's first sweep
  std::vector<EffectCost> costs;

  std::vector<double> inertia, own_inertia;  // kg, D of the proximal term, and an effect's share of it
  Anderson anderson;
  bool heavier = false;                   // D was added in this step
  std::vector<int> component;             // of each node, connected by rows; -1 if held from outside
  std::vector<Eigen::Vector4d> momentum;  // missing of each component (N s), and its mass (kg)
  bool accelerated = false;               // v is not an image of the iteration, but its acceleration

  QuasiNewton quasi_newton;
  HardRows hard_rows;
  double potential = 0;                      // J, at v
  int since_factor = 0;                      // iterations
  double slope = 0;                          // of the potential along `direction`, J
  std::vector<Eigen::Matrix3d> deformation;  // m^3, about each node, whose rotation turns the metric
  bool evaluated = false;                    // the potential and the impulses are those of v
  Points gradient, last_gradient, direction, search_from;

  double contraction = std::nan("");  // of plain, at the end of the last step
  std::optional<Configuration> directions;
  int slow_changes = 0;  // of v in this step, in a row
  static constexpr int most_krylov = 12;
  std::vector<Points> krylov;  // orthonormal in M; the first one is what plain reduces least, if known
  bool mode_known = false;
  Points turned_x, push;
  std::vector<double> kept;
  double best_residual = infinity;  // sqrt(J)
  Points best_v;
  std::vector<double> best_rows;

  StepData(const Scene& scene, const Method& method);

  /// Gets ready for a step of h seconds from `state`.
  void begin(const Scene& scene, const Method& method, double h, const State& state);

  /// Keeps the iterate if its residual is the smallest of this step, from the `first_kept` iteration on.
  void keep_if_best(int outer_iteration, double residual);
  /// Takes the kept iterate if it is better; true if so.
  bool return_to_best(double residual);

  /// True if the iterates' motion has brought contacts that were not thought of.
  bool widen_contacts(const Scene& scene);

  /// Carries the solved map on to the step's end.
  void end(double h, State& state);

  /// |a - b|_M and |velocity|_M over the nodes that can move, sqrt(J).
  double distance(const Points& a, const Points& b) const;
  double inner_product(const Points& a, const Points& b) const;
  double norm(const Points& velocity) const { return distance(velocity, zero); }

  /// Refreshes all rows at velocity `at` and `rebuilt`, the velocities that the impulses give along the new
  /// directions.
  BlockResidual linearise_at(const Scene& scene, const Points& at);

  /// Sets the eliminated rows' own impulses at v, the potential and its gradient, unless they are; refreshes
  /// the other rows, and `rebuilt` by all. Returns the residual of the other rows.
  BlockResidual potential_at_v(const Scene& scene);

  /// One proximal step in the metric: down the gradient, under the rows that are not eliminated. Returns the
  /// number of times these were visited.
  std::int64_t project(double accuracy, int most);

  /// Finds the quasi-Newton direction at v; returns Newton's decrement, sqrt(-gradient . direction), an
  /// estimate of the distance from the solution (sqrt(J)).
  double find_direction();

  /// Whichever of the two the outer iteration works on.
  BlockResidual refresh(const Scene& scene) {
    return on_potential || in_metric ? potential_at_v(scene) : linearise_at(scene, v);
  }

  /// One line search down the potential along the direction found. Stays where no length gains anything. The
  /// first iteration of a step goes where the potential is lowest: the old velocity, v_free or rest.
  void descend(const Scene& scene, bool first);

  /// The rows' own impulses answer for what rounding makes of x, times the stiffness. So takes v and them to
  /// the solution of the linear rows at v. `unsettle` comes back.
  BlockResidual settle(const Scene& scene, double accuracy);
  void unsettle(const Scene& scene);

  /// Fills `inertia` by the effects' geometric bounds at v, of the impulses (sign 1: what stiffens) or their
  /// opposites (-1: what softens). Returns the bound of plain's contraction that they give together, the
  /// largest 2 D/M; each effect's alone goes into `costs`.
  double bound_contraction(const Scene& scene, int sign);

  /// Replaces M by M + D and v_free by (M + D)^-1 (M v_free + D v), D the `inertia`.
  void add_inertia();

  /// Sweeps the rows from v; returns the number of sweeps.
  std::int64_t relax(bool fresh, const InnerBudget& budget);

  /// Estimates at v what plain would multiply its error by: the bound where that is small, else Arnoldi's
  /// method on the error's map; nothing where plain is no choice or J is not taken at x. Returns the number
  /// of sweeps it took.
  std::int64_t estimate_contraction(const Scene& scene);

  /// A proximal term moves momentum from one iterate to the next, which vanishes as they converge. Gives
  /// every component that only internal constraints act on the momentum of v_free again, by a shift of v and
  /// x.
  void restore_momentum();

  void forget_impulses();
  void forget_prediction();
  void forget_history() { history.h = 0; }

 private:
  void make_map(const Scene& scene, const Method& method, double h, const State& state);
  bool goes_on(const State& state) const;
  void begin_damping(const Scene& scene, double time);
  const Configuration* directions_for(const Points& at);
  Configuration placed(const Points& at, std::vector<Pose>& storage, double time);
  /// Returns what the velocity misses of its gyroscopic torque, squared in J.
  double add_gyroscopic(Points& velocity) const;
  void find_free_components();
  void factor_metric(const Scene& scene, MetricShape shape);
  bool start_low(const Scene& scene);
  void turn_metric(const Scene& scene, const Points& at);
  BlockResidual evaluate_potential(const Scene& scene);
  std::int64_t apply_plain(const Scene& scene, Points& error);
};

}  // namespace pbd
