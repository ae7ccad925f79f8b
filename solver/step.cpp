#include "step.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "acceleration.h"
#include "linearise.h"
#include "names.h"
#include "outer.h"
#include "quasi_newton.h"
#include "relaxation.h"
#include "validate.h"

namespace pbd {

double Report::residual() const {
  const double largest = std::max(primal, dual);
  return largest > 0 ? largest / scale : largest;
}

namespace {

struct StepData {
  IntegratorFunction integrator;
  Outer outer;
  Relaxation relaxation;
  std::vector<std::size_t> effect_of_block;
  Rows rows;
  double finite_mass = 0;  // kg, of all nodes that can move

  StepMap map;
  Points acceleration, zero, v, x, rebuilt, previous;
  std::vector<double> inverse_mass, inertia;  // 1/kg of the nodes; kg of the proximal term
  Anderson anderson;
  QuasiNewton quasi_newton;
  double potential = 0;               // J, at v
  bool evaluated = false;             // the potential and the impulses are those of v
  double metric_d = 0, metric_s = 0;  // s, of the metric that is factored
  Points gradient, last_gradient, direction, search_from;
  std::vector<double> seconds;  // per block, of the current outer iteration's first sweep
  std::vector<EffectCost> costs;

  StepData(const Scene& scene, const Method& method)
      : integrator(find_named(integrators(), "integrator", method.integrator).map),
        outer(find_named(outers(), "outer", method.outer)),
        relaxation(make_relaxation(method.relaxation)),
        rows(allocate_rows(scene, effect_of_block)),
        zero(Points::Zero(3, scene.nodes())),
        inverse_mass(rows.inverse_mass),
        inertia(rows.inverse_mass.size(), 0.0),
        anderson(method.memory),
        quasi_newton(method.memory),
        seconds(rows.blocks.size(), 0.0) {
    for (const double mass : scene.mass)
      if (std::isfinite(mass)) finite_mass += mass;
    if (finite_mass == 0) finite_mass = 1;  // nothing moves, and an unmet constraint still weighs
    for (std::size_t b = 0; b < rows.blocks.size(); ++b)
      costs.push_back(
          {std::visit([](const auto& effect) { return effect.name; }, scene.effects[effect_of_block[b]]),
           row_count(rows.blocks[b]),
           std::visit([](const auto& block) { return block.bytes(); }, rows.blocks[b]), 0.0});
  }

  /// |v|_M over the nodes that can move, sqrt(J).
  double norm(const Points& velocity) const { return distance(velocity, zero); }

  double distance(const Points& a, const Points& b) const {
    double squared = 0;
    for (std::size_t node = 0; node < inverse_mass.size(); ++node)
      if (inverse_mass[node] > 0)
        squared += (a.col(static_cast<int>(node)) - b.col(static_cast<int>(node))).squaredNorm() /
                   inverse_mass[node];
    return std::sqrt(squared);
  }

  /// Refreshes all rows at velocity `at` and the velocities that the impulses give along the new directions.
  /// Returns the squared dual residual and its rounding.
  BlockResidual linearise_at(const Scene& scene, const Points& at) {
    x = map.x0 + map.d * at;
    rows.inverse_mass = inverse_mass;
    BlockResidual sums;
    for (std::size_t b = 0; b < rows.blocks.size(); ++b) {
      const auto start = std::chrono::steady_clock::now();
      const BlockResidual share = linearise(scene.effects[effect_of_block[b]], map, x, at, rows.inverse_mass,
                                            finite_mass, rows.blocks[b]);
      sums.squared += share.squared;
      sums.rounding_squared += share.rounding_squared;
      costs[b].seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    rebuilt = map.v_free;
    apply_impulses(rows, rebuilt);
    return sums;
  }

  /// Sets the rows' own impulses at velocity v, `rebuilt` and the potential. Where every row is compliant,
  /// the dual residual is zero.
  BlockResidual evaluate_potential(const Scene& scene) {
    x = map.x0 + map.d * v;
    rebuilt = map.v_free;
    const double kinetic = std::pow(distance(v, map.v_free), 2) / 2;
    potential = kinetic;
    for (std::size_t b = 0; b < rows.blocks.size(); ++b)
      potential +=
          add_potential(scene.effects[effect_of_block[b]], map, x, inverse_mass, rows.blocks[b], rebuilt);
    gradient = v - rebuilt;
    for (std::size_t node = 0; node < inverse_mass.size(); ++node)
      gradient.col(static_cast<Eigen::Index>(node)) *= inverse_mass[node] > 0 ? 1 / inverse_mass[node] : 0.0;
    evaluated = true;
    return {};
  }

  /// Factors the metric for this step's length unless it is.
  void factor_metric(const Scene& scene) {
    if (metric_d == map.d && metric_s == map.s) return;
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t b = 0; b < rows.blocks.size(); ++b)
      add_metric(scene.effects[effect_of_block[b]], map, scene.initial.x, rows.blocks[b], entries);
    quasi_newton.factor(inverse_mass, entries);
    metric_d = map.d;
    metric_s = map.s;
  }

  /// One line search along the quasi-Newton direction.
  void descend(const Scene& scene) {
    constexpr double sufficient = 1e-4;
    constexpr double flat = 1e-10, flatter = 0.8;  // where the potential's change is lost in its rounding
    constexpr int most_halvings = 30;
    quasi_newton.direction(gradient, direction);
    const double slope = (gradient.array() * direction.array()).sum();
    const double before = potential;
    search_from = v;
    last_gradient = gradient;
    double length = 1;
    for (int k = 0; k < most_halvings; ++k, length /= 2) {
      v = search_from + length * direction;
      evaluate_potential(scene);
      if (potential <= before + sufficient * length * slope) break;
      if (potential <= (1 + flat) * before &&
          (gradient.array() * direction.array()).sum() <= flatter * std::abs(slope))
        break;
    }
    quasi_newton.learn(v - search_from, gradient - last_gradient);
  }

  /// Replaces M by M + D and v_free by (M + D)^-1 (M v_free + D v).
  void add_inertia(const Scene& scene) {
    std::fill(inertia.begin(), inertia.end(), 0.0);
    for (std::size_t b = 0; b < rows.blocks.size(); ++b)
      add_geometric_inertia(scene.effects[effect_of_block[b]], map, x, rows.blocks[b], inertia);
    if (std::all_of(inertia.begin(), inertia.end(), [](double kg) { return kg == 0; })) return;
    rebuilt = map.v_free;
    for (std::size_t node = 0; node < inertia.size(); ++node) {
      const double share = inertia[node] * inverse_mass[node];  // D / M
      const auto column = static_cast<Eigen::Index>(node);
      rows.inverse_mass[node] = inverse_mass[node] / (1 + share);
      rebuilt.col(column) = (map.v_free.col(column) + share * v.col(column)) / (1 + share);
    }
    refresh_inverse_diagonal(rows);
    apply_impulses(rows, rebuilt);
  }
};

}  // namespace

struct Workspace::Data : StepData {
  using StepData::StepData;
};

Workspace::Workspace(const Scene& scene, const Method& method) {
  validate(scene);
  data_ = std::make_unique<Data>(scene, method);
  if (data_->outer.on_potential)
    for (std::size_t index = 0; index < scene.effects.size(); ++index)
      if (!all_compliant(scene.effects[index]))
        throw SetupError("outer quasi_newton", "effect " + std::to_string(index) + " has hard rows",
                         "compliant rows only");
}
Workspace::~Workspace() = default;
Workspace::Workspace(Workspace&&) noexcept = default;
Workspace& Workspace::operator=(Workspace&&) noexcept = default;

std::vector<EffectCost> Workspace::costs() const {
  return data_->costs;
}

std::vector<double> Workspace::impulses(std::size_t index) const {
  std::vector<double> flat;
  for (std::size_t b = 0; b < data_->rows.blocks.size(); ++b)
    if (data_->effect_of_block[b] == index)
      std::visit(
          [&](const auto& block) {
            for (const auto& impulse : block.impulse) flat.insert(flat.end(), impulse.begin(), impulse.end());
          },
          data_->rows.blocks[b]);
  return flat;
}

namespace {

constexpr double rounding_unit = std::numeric_limits<double>::epsilon();
constexpr std::string_view not_finite = "not finite";

/// Residual, scale and rounding level of an iterate; true if the outer iteration is to end.
bool finished(const Method& method, double primal_rounding, double dual_rounding, double first_residual,
              Report& report) {
  const double residual = std::max(report.primal, report.dual);
  constexpr double blown_up = 1e8;  // growth beyond any transient
  if (!std::isfinite(report.primal) || !std::isfinite(report.dual) || !std::isfinite(report.scale)) {
    report.status = Status::diverged;
    report.reason = not_finite;
  } else if (report.primal <= std::max(method.tolerance * report.scale, primal_rounding) &&
             report.dual <= std::max(method.tolerance * report.scale, dual_rounding)) {
    report.status = Status::ok;
    report.reason = "";
  } else if (residual > blown_up * std::max(first_residual, report.scale)) {
    report.status = Status::diverged;
    report.reason = "residual grew beyond 1e8 times its start";
  } else {
    report.status = Status::not_converged;
    report.reason = "outer iterations spent";
    return report.outer_iterations >= method.max_outer;
  }
  return true;
}

/// Outer iterations' view of the step; adds up their work in the report.
class StepIteration final : public OuterIteration {
 public:
  StepIteration(const Scene& scene, const Method& method, StepData& data, Report& report)
      : scene_(scene), method_(method), data_(data), report_(report) {}

  Points& v() override { return data_.v; }
  const Points& rebuilt() override { return data_.rebuilt; }
  bool first() override { return report_.outer_iterations == 0; }
  void linearise_at_start() override { data_.linearise_at(scene_, data_.zero); }
  void add_inertia() override {
    data_.anderson.begin(data_.rows, data_.v);
    data_.add_inertia(scene_);
  }
  void descend() override { data_.descend(scene_); }
  void accelerate() override { data_.anderson.accelerate(data_.inverse_mass, data_.rows, data_.v); }

  void relax() override {
    constexpr double inner_share = 0.1;  // of the step's tolerance, left to the linear problem
    const InnerBudget budget{.max_sweeps = method_.max_sweeps,
                             .relative = method_.inner_tolerance,
                             .absolute = inner_share * method_.tolerance * report_.scale};
    std::fill(data_.seconds.begin(), data_.seconds.end(), 0.0);
    const auto sweeps = pbd::relax(data_.relaxation, data_.rows, data_.v, report_.outer_iterations == 0,
                                   budget, &data_.seconds);
    report_.sweeps += sweeps;
    report_.row_updates += sweeps * row_count(data_.rows);
    for (std::size_t b = 0; b < data_.seconds.size(); ++b)
      data_.costs[b].seconds += data_.seconds[b] * static_cast<double>(sweeps);
  }

 private:
  const Scene& scene_;
  const Method& method_;
  StepData& data_;
  Report& report_;
};

}  // namespace

Report step(const Scene& scene, const Method& method, double h, State& state, Workspace& workspace,
            const Observer& observer) {
  StepData& w = *workspace.data_;
  accelerations(scene, w.acceleration);
  w.integrator(state, w.acceleration, h, w.map);
  if (!method.warm_start)
    for_each_block(w.rows.blocks, [](auto& block) {
      for (auto& impulse : block.impulse) impulse.setZero();
    });
  w.v = state.v;
  w.previous = w.v;
  w.anderson.forget();
  w.quasi_newton.forget();
  w.evaluated = false;
  if (w.outer.on_potential) w.factor_metric(scene);

  Report report;
  const double free_change = w.distance(w.map.v_free, state.v);
  const double velocity_rounding = 8 * rounding_unit * w.norm(w.map.v_free);
  double first_residual = 0;
  StepIteration iteration(scene, method, w, report);

  for (;; ++report.outer_iterations) {
    const BlockResidual dual = !w.outer.on_potential ? w.linearise_at(scene, w.v)
                               : w.evaluated         ? BlockResidual{}
                                                     : w.evaluate_potential(scene);
    report.dual = std::sqrt(dual.squared);
    report.primal = w.distance(w.v, w.rebuilt);
    report.scale = w.distance(w.v, state.v) + free_change;
    if (report.outer_iterations == 0) first_residual = std::max(report.primal, report.dual);
    if (observer)
      observer({report.outer_iterations, report.sweeps, report.row_updates, report.primal, report.dual,
                report.scale, w.x, w.v});
    if (finished(method, velocity_rounding, velocity_rounding + std::sqrt(dual.rounding_squared),
                 first_residual, report))
      break;
    if (report.outer_iterations > 0 && w.distance(w.v, w.previous) <= rounding_unit * w.norm(w.v)) {
      report.reason = "stalled away from the solution";
      break;
    }
    w.previous = w.v;
    w.outer.iterate(iteration);
  }
  if (!w.x.allFinite() || !w.v.allFinite() || !std::isfinite(state.time + h)) {
    report.status = Status::diverged;
    report.reason = not_finite;
  }
  if (report.status != Status::diverged) {
    state.x = w.x;
    state.v = w.v;
    state.time += h;
  } else {
    for_each_block(w.rows.blocks, [](auto& block) {
      for (auto& impulse : block.impulse) impulse.setZero();
    });
  }
  return report;
}

}  // namespace pbd
