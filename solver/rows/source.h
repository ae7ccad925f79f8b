// What an effect with rows is to the solver: a source, which fills rows at an iterate x_k = x0 + d v_k,
//   J,  b = c(x_k)/d - J v_k,  Sigma = A/(s d), of contacts A/(h d),  N_ii^-1 = (J W J^T + Sigma)^-1
// and states what else of its formulas the outer iterations ask for. The formulas are compiled behind this
// interface, once: in the effect's own file.
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "rows/bodies.h"
#include "rows/costs.h"
#include "rows/rows.h"
#include "rows/step_map.h"
#include "rows/turned_way.h"

namespace pbd {

/// Sums over rows, J.
struct RowResidual {
  /// sum_i r_i^T N_ii^-1 r_i of the dual residual r = c(x)/d + Sigma p; of bounds and laws of friction what
  /// they leave of it (`squared_residual` in rows/laws.h).
  double squared = 0;
  /// The same of the rounding errors of c(x): 8 unit roundoffs of the constraint's largest coordinate along
  /// each row of J.
  double rounding_squared = 0;
  /// The part of `squared` of constraints that miss more than their own rounding.
  double beyond_rounding_squared = 0;
  /// sum_i |W J_i^T p_i|_M^2: what each constraint's impulse does alone.
  double impulses_squared = 0;

  /// Adds a constraint's.
  void add(double missed, double rounding) {
    squared += missed;
    rounding_squared += rounding;
    if (!(missed <= rounding)) beyond_rounding_squared += missed;
  }
  RowResidual& operator+=(const RowResidual& other) {
    squared += other.squared;
    rounding_squared += other.rounding_squared;
    beyond_rounding_squared += other.beyond_rounding_squared;
    impulses_squared += other.impulses_squared;
    return *this;
  }
};
inline constexpr double value_rounding = 8 * std::numeric_limits<double>::epsilon();

/// What one-sided limits tell of: nothing, that they stop something, or also that hard ones hold something.
enum class Limits : std::uint8_t { silent, stops, holds };

/// Where a step begins, and what its map is.
struct StepBegin {
  const Bodies& bodies;
  const StepMap& map;
  const StepCoefficients& coefficients;
  const Configuration& at;
  const Configuration &ahead, &behind;  // d further and back along v; read where c0 bends (damping)
  const Points& v;                      // m/s
  const Points& a;                      // m/s^2, that the integrator carries on, if it does
  const std::vector<double>& inverse_mass;
  Limits limits;     // what they are to tell of
  double tolerance;  // of the step's scale, to which the iterate is solved that rows are found for
  bool solved;       // that is enough
  bool warm_start;
  bool continued = false;   // from where the last step ended
  bool after_miss = false;  // the last step was not solved
};

/// Where rows are taken. `directions` is where J is, if not at x. What no impulse can move weighs with
/// `unreachable_mass` (kg): where N_ii is singular and r is not zero, r^2 times that is its residual.
struct RowPlace {
  const StepMap& map;
  const Configuration& at;
  const Configuration* directions;
  const Points& v;
  const std::vector<double>& inverse_mass;
  double unreachable_mass;
};

/// An error of the iterate v, and where it leads: x(v + scale * error).
struct RowError {
  const StepMap& map;
  const Configuration& turned;
  const Configuration* directions;  // where the turned J is taken; null: at `turned`
  const Points& v;
  double scale;
  const Points& error;
  const std::vector<double>& inverse_mass;
};

/// A block of s d K, kg, row >= column in the order of nodes or not; each pair of nodes once.
struct MetricEntry {
  int row, column;
  Eigen::Matrix3d block;
};

/// Of the effects, for the quasi-Newton metric: at rest; as it is, with all geometric stiffness that effects
/// state; or without what of it is not convex.
enum class MetricShape { rest, tangent, convex };

/// Of the speed that forces bring in a step: what rests approaches by no more.
inline constexpr double pressed_speed = 1e-3;

/// How velocities jump in a step: what has a restitution or touches an undamped spring comes back, all else
/// stops, at limits always.
enum class Impact : std::uint8_t { none, rebound, stop };

/// Whether rows have been found anew, whether they connect other columns than before, and whether the iterate
/// has gone where these do not tell how it came.
enum class Widened : std::uint8_t { no, alike, others, others_from_start };

using BlockSpan = std::span<AnyBlock>;
using ConstBlockSpan = std::span<const AnyBlock>;

class Source {
 public:
  /// What its rows are, which nothing changes.
  struct Kind {
    std::size_t constraints = 0;  // all, rows or not; of contacts none
    int rows_of_each = 0;
    bool compliant = true;    // every constraint gives way: A is positive definite; true of contacts, too
    bool of_bodies = false;   // no potential by the columns
    bool fills_space = true;  // stiff in every direction, or no rows
    bool limited = false;     // impulses with bounds
    bool damped = false;      // some retardation time is not 0
    bool contacts = false;    // act at a step's end alone

    bool operator==(const Kind&) const = default;
  };

  explicit Source(Kind kind) : kind_(kind) {}
  virtual ~Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  const Kind& kind() const { return kind_; }

  /// Adds blocks with impulses zero, none where there are no rows: of all constraints, or of the hard ones
  /// alone.
  virtual void allocate(bool hard_alone, BlockList& blocks) = 0;

  /// Gets ready for a step; true if the rows are others than before.
  virtual bool begin_step(const StepBegin& begin, BlockSpan blocks) = 0;

  /// Refreshes the rows.
  virtual void linearise(const RowPlace& place, BlockSpan blocks, RowResidual& sums) = 0;

  /// Adds half the geometric bounds times d to `added_mass` (kg, one a column): what the proximal outer
  /// iteration adds, and half a bound of the geometric stiffness. Of `factor` times the impulses.
  virtual void add_geometric_mass(const StepMap& map, const Configuration& at, double factor,
                                  ConstBlockSpan blocks, std::vector<double>& added_mass) const = 0;

  /// Rows of the error's map: adds W J(turned)^T p to `push`, then sets the impulses to zero and the biases
  /// to what the values at `turned` have beyond J, (c(turned) - c(x))/(d scale) - J error.
  virtual void perturb(const RowError& error, BlockSpan blocks, Points& push) const = 0;

  /// The step's potential as compliant rows give it, 1/2 (c/d)^T Sigma^-1 (c/d): adds it to `potential` (J),
  /// sets impulses p = -Sigma^-1 c/d at positions x and adds W J^T p to v. Asked of blocks with a stiffness.
  virtual void add_potential(const StepMap&, const Points& /*x*/, const std::vector<double>& /*inverse_mass*/,
                             BlockSpan, Points& /*v*/, double& /*potential*/) const {}

  /// Appends its share of the quasi-Newton metric, J at positions x or, with MetricShape::rest, at the
  /// effect's rest shape if it states one. Fills the blocks' `stiffness`.
  virtual void add_metric(const StepMap&, const Points& /*x*/, MetricShape, BlockSpan,
                          std::vector<MetricEntry>&) const {}

  /// Adds the volumes times the deformation gradients (m^3) of the elements about each node at positions x.
  virtual void add_deformation(const Points& /*x*/, ConstBlockSpan, std::vector<Eigen::Matrix3d>&) const {}

  /// Forces of compliant constraints as they are in a given state, without rows: adds the accelerations
  /// W J^T (-A^-1 (c + T J v)) (m/s^2); hard ones have no force by their value and add nothing.
  virtual void add_compliant_forces(const Configuration&, const Points& /*v*/,
                                    const std::vector<double>& /*inverse_mass*/,
                                    Points& /*acceleration*/) const {}

  /// Adds to `sum.energy`, and takes the larger `sum.missed`.
  virtual void measure(const Configuration&, ConstraintMeasure& /*sum*/) const {}

  /// J^T gamma of constraint i by its columns, three entries each, gamma all constraints' force multipliers.
  virtual Eigen::VectorXd push(std::size_t /*i*/, const std::vector<double>& /*gamma*/,
                               const Configuration&) const {
    return {};
  }

  /// The impact of the step, as far as it is known, where an iterate has the velocities v.
  virtual Impact impact(ConstBlockSpan, const Points&) const { return Impact::none; }

  /// True if on the way of a step of h seconds bodies that a hard constraint holds to each other's directions
  /// turn by more than 60 degrees out of them, and farther than they began, or if bodies turn about an axis
  /// by more than half a turn otherwise than a constraint's angle drives them, hard, soft or a limit, or past
  /// half a turn from a limit, beyond which they would be on its other side.
  virtual bool turns_over(double /*h*/, TurnedWay& /*way*/) const { return false; }

  /// True if a constraint's angle goes by more than a radian on the way of a step of h seconds, or past half
  /// a turn from a limit: `turns_over` is to look at it, however slowly bodies turn. The way is `extension`
  /// times as far as from `start` to `reached`, both at the time of the start.
  virtual bool twists_far(double /*h*/, const Configuration& /*start*/, const Configuration& /*reached*/,
                          double /*extension*/) const {
    return false;
  }

  /// True if a constraint drives bodies by more than half a turn in h seconds, which it cannot tell from the
  /// other way round.
  virtual bool drives_round(double /*h*/) const { return false; }

  /// True of a constraint that has no row because nothing comes near its limit: its impulse is 0.
  virtual bool waits(std::size_t /*constraint*/) const { return false; }

  /// Gives those rows, too; true if there are any.
  virtual bool call_all(const std::vector<double>& /*inverse_mass*/, BlockSpan) { return false; }

  /// Marks the bodies of those.
  virtual void add_bodies_that_wait(std::vector<bool>& /*body*/) const {}

  /// The effect has been replaced where it stands, while nothing waits.
  virtual void take_effect() {}

  /// Finds rows anew where the iterate went farther than was thought of, which is solved to
  /// `StepBegin::tolerance`, or something overlaps that no row tells of; they are to be linearised again
  /// then.
  virtual Widened widen(const StepBegin&, const Configuration& /*reached*/, BlockSpan) { return Widened::no; }

  // Of contacts alone.

  /// Lets what approached and touches in the step that is solved by v (to `accuracy`, sqrt(J)), but was not
  /// to collide, collide: true if there is any.
  virtual bool collide(ConstBlockSpan, const Points& /*v*/, double /*accuracy*/) { return false; }

  /// Lowers the share of its way to `reached` that each column may go, so that nothing passes there what it
  /// begins apart from: true if any is lower. Where ways are not looked at nothing is.
  virtual bool hold_back(const StepBegin&, const Configuration& /*reached*/, std::vector<double>& /*share*/) {
    return false;
  }

  virtual void add_contact_forces(const StepMap&, const Configuration&, const Points& /*v*/, ConstBlockSpan,
                                  std::vector<ContactForce>&) const {}

 private:
  Kind kind_;
};

/// An effect with rows, and which blocks of the rows are its own.
struct Slot {
  std::unique_ptr<Source> source;
  std::size_t effect = 0;  // index in the scene
  std::size_t first = 0, count = 0;
  EffectCost cost;
  bool eliminated = false;  // its impulses are its own, p = -Sigma^-1 c/d

  BlockSpan blocks(Rows& rows) const { return BlockSpan(rows.blocks).subspan(first, count); }
  ConstBlockSpan view(const Rows& rows) const { return ConstBlockSpan(rows.blocks).subspan(first, count); }

  /// Sets the cost's rows and bytes.
  void count_rows(const Rows& rows) {
    cost.rows = row_count(view(rows));
    cost.bytes = bytes(view(rows));
  }
};

}  // namespace pbd
