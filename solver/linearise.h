// From effects to rows: b = c(x_k)/d - J v_k, Sigma = A/(s d), N_ii^-1, at the positions x_k = x0 + d v_k.
#pragma once

#include "metric.h"
#include "rows.h"

namespace pbd {

/// Allocates the rows of every non-empty effect with rows, or of its hard constraints alone, impulses zero.
/// `effect_of_block` receives the index in `scene.effects` of each block.
Rows allocate_rows(const Scene& scene, std::vector<std::size_t>& effect_of_block, bool hard_alone = false);

/// Squared dual residual of a block, sum_i r_i^T N_ii^-1 r_i with r = c(x)/d + Sigma p, and the same of the
/// rounding errors of c(x): 8 unit roundoffs of the constraint's largest coordinate along each row of J; and
/// what the rows' impulses p do each alone, sum_i |W J_i^T p_i|_M^2. All in J.
struct BlockResidual {
  double squared = 0;
  double rounding_squared = 0;
  double impulses_squared = 0;

  BlockResidual& operator+=(const BlockResidual& other) {
    squared += other.squared;
    rounding_squared += other.rounding_squared;
    impulses_squared += other.impulses_squared;
    return *this;
  }
};

/// Refreshes one block of rows from its effect at `at` = x(v) and velocities v. Where N_ii is singular and r
/// is not zero, nothing can meet the constraint: its share of the residual is then r^2 weighted with
/// `unreachable_mass` (kg). J is taken at `directions` if given, else at x.
BlockResidual linearise(const Effect& effect, const StepMap& map, const Configuration& at, const Points& v,
                        const std::vector<double>& inverse_mass, double unreachable_mass, AnyBlock& block,
                        const Configuration* directions = nullptr);

/// The step's potential as one block of compliant rows gives it, 1/2 (c/d)^T Sigma^-1 (c/d) in J: sets
/// impulses p = -Sigma^-1 c/d at positions x and adds W J^T p to `v`.
double add_potential(const Effect& effect, const StepMap& map, const Points& x,
                     const std::vector<double>& inverse_mass, AnyBlock& block, Points& v);

/// Of the effects, for the quasi-Newton metric: at rest, or as it is.
enum class MetricShape { rest, current };

/// Appends the effect's share of the quasi-Newton metric (metric.h), J at positions x or, with
/// MetricShape::rest, at the effect's rest shape if it states one. Fills the block's `stiffness`.
void add_metric(const Effect& effect, const StepMap& map, const Points& x, MetricShape shape, AnyBlock& block,
                std::vector<MetricEntry>& entries);

/// Adds the volumes times the deformation gradients (m^3) of the elements about each node at positions x.
void add_deformation(const Effect& effect, const Points& x, std::vector<Eigen::Matrix3d>& deformation);

/// True if every row of the effect gives way: A is positive definite. Contacts act at a step's end alone.
bool all_compliant(const Effect& effect);

/// True if the effect's constraints are those of rigid bodies: they have no potential by the columns.
bool of_bodies(const Effect& effect);

/// True if the effect has no rows, or rows that are stiff in every direction: one number a pair of nodes is
/// then a good metric of them.
bool fills_space(const Effect& effect);

/// Adds half the effect's geometric bounds at `at` times d to `inertia` (kg, one a node): the inertia
/// D that the proximal outer iteration adds, and half a bound of the geometric stiffness. Of `factor` times
/// the impulses.
void add_geometric_inertia(const Effect& effect, const StepMap& map, const Configuration& at, double factor,
                           const AnyBlock& block, std::vector<double>& inertia);

/// Rows of the error's map: adds W J(turned)^T p to `push`, then sets the impulses to zero and the biases to
/// what the values at `turned` = x(v + scale * error) have beyond J, (c(turned) - c(x))/(d scale) - J error.
/// The turned J is taken at `directions` if given.
void perturb(const Effect& effect, const StepMap& map, const Configuration& turned, const Points& v,
             double scale, const Points& error, const std::vector<double>& inverse_mass, AnyBlock& block,
             Points& push, const Configuration* directions = nullptr);

/// Refreshes N_ii^-1 for other inverse masses than `linearise` was given.
void refresh_inverse_diagonal(Rows& rows);

/// Sum of the given forces' accelerations, m/s^2, of all columns.
void accelerations(const Scene& scene, const StepBegin& begin, Points& acceleration);

}  // namespace pbd
