#include "step.h"

#include <algorithm>
#include <cmath>

#include "step_data.h"
#include "validate.h"

namespace pbd {

double Report::residual() const {
  const double largest = std::max(primal, dual);
  return largest > 0 ? largest / scale : largest;
}

struct Workspace::Data : StepData {
  using StepData::StepData;
};

Workspace::Workspace(const Scene& scene, const Method& method) {
  validate(scene);
  validate(method);
  data_ = std::make_unique<Data>(scene, method);
}
Workspace::~Workspace() = default;
Workspace::Workspace(Workspace&&) noexcept = default;
Workspace& Workspace::operator=(Workspace&&) noexcept = default;

std::vector<EffectCost> Workspace::costs() const {
  std::vector<EffectCost> all;
  for (std::size_t b = 0; b < data_->costs.size(); ++b) {
    const EffectCost& own = data_->costs[b];
    if (b == 0 || data_->effect_of_block[b] != data_->effect_of_block[b - 1]) {
      all.push_back(own);
      continue;
    }
    all.back().rows += own.rows;
    all.back().bytes += own.bytes;
    all.back().seconds += own.seconds;
    all.back().contraction = std::max(all.back().contraction, own.contraction);
  }
  return all;
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

std::vector<ContactForce> Workspace::contacts() const {
  return data_->contacts.forces({data_->x, data_->poses, data_->x_time}, data_->map, data_->v, data_->rows);
}

std::vector<double> Workspace::forces(std::size_t index) const {
  std::vector<double> flat;
  for (std::size_t b = 0; b < data_->rows.blocks.size(); ++b)
    if (data_->effect_of_block[b] == index)
      std::visit(
          [&](const auto& block) {
            constexpr auto rows = static_cast<std::size_t>(std::decay_t<decltype(block)>::rows);
            flat.assign(rows * (block.entry(block.size() - 1) + 1), std::nan(""));
            for (std::size_t i = 0; i < block.size(); ++i)
              for (std::size_t r = 0; r < rows; ++r)
                flat[rows * block.entry(i) + r] =
                    block.impulse[i][static_cast<Eigen::Index>(r)] / data_->map.s;
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
  void linearise_at_start() override {
    data_.linearise_at(scene_, data_.zero);
    if (method_.stabilisation != 1) scale_hard_biases(data_.rows, method_.stabilisation);
  }
  void add_inertia() override {
    begin_accelerated();
    data_.bound_contraction(scene_, 1);
    data_.add_inertia();
  }
  void project() override {
    begin_accelerated();
    const auto sweeps = data_.project(inner_accuracy(), method_.max_sweeps);
    report_.sweeps += sweeps;
    report_.row_updates += sweeps * row_count(data_.rows, data_.eliminated);
  }
  void accelerate() override {
    data_.accelerated = data_.anderson.accelerate(data_.inverse_mass, data_.rows, data_.v);
  }
  bool on_potential() override { return data_.on_potential; }
  void descend() override { data_.descend(scene_, first()); }

  bool plain_contracts() override {
    constexpr double slow = 0.9;
    constexpr int patience = 2;
    if (report_.outer_iterations >= 2 && data_.slow_changes < patience)
      data_.slow_changes = data_.change > slow * data_.last_change ? data_.slow_changes + 1 : 0;
    if (data_.slow_changes >= patience) return false;  // for the rest of the step, whatever was predicted
    return data_.contraction <= slow_contraction ||
           (data_.direction_blend == 1 && data_.bound_contraction(scene_, 1) <= slow_contraction);
  }

  void relax() override {
    const InnerBudget budget{.max_sweeps = method_.max_sweeps, .absolute = inner_accuracy()};
    const auto sweeps = data_.relax(first(), budget);
    report_.sweeps += sweeps;
    report_.row_updates += sweeps * row_count(data_.rows);
  }

 private:
  double residual() const { return std::max(report_.primal, report_.dual); }

  /// Takes an acceleration back that the residual refutes, and notes where the next image comes from.
  void begin_accelerated() {
    constexpr double too_much = 10;  // growth of the residual that an acceleration may bring
    if (data_.accelerated && residual() > too_much * last_residual_) {
      data_.anderson.reject(data_.rows, data_.v);
      data_.refresh(scene_);
    }
    last_residual_ = residual();
    data_.anderson.begin(data_.rows, data_.v);
  }

  /// As exact as the outer iteration can use: tighter while its residual does not fall.
  double inner_accuracy() {
    constexpr double inner_share = 0.1;  // of the step's tolerance, left to the linear problem
    constexpr double good_fall = 0.5, tighter = 0.3, tightest = 1e-6;
    forcing_ = residual() > good_fall * relaxed_residual_
                   ? std::max(tighter * forcing_, tightest * method_.inner_tolerance)
                   : std::min(forcing_ / tighter, method_.inner_tolerance);
    relaxed_residual_ = residual();
    return std::max(inner_share * method_.tolerance * report_.scale, forcing_ * residual());
  }

  const Scene& scene_;
  const Method& method_;
  StepData& data_;
  Report& report_;
  double last_residual_ = 0;
  double forcing_ = method_.inner_tolerance;  // share of the residual that the linear problem is solved to
  double relaxed_residual_ = std::numeric_limits<double>::infinity();
};

}  // namespace

Report step(const Scene& scene, const Method& method, double h, State& state, Workspace& workspace,
            const Observer& observer) {
  StepData& w = *workspace.data_;
  w.begin(scene, method, h, state);

  Report report;
  const double free_change = w.distance(w.map.v_free, w.start_v);
  const double free_speed = w.norm(w.map.v_free);
  double first_residual = 0, last_residual = std::numeric_limits<double>::infinity();
  double lowest = std::numeric_limits<double>::infinity();
  int without_fall = 0;  // iterations since the primal residual was `lowest`
  StepIteration iteration(scene, method, w, report);
  double velocity_rounding = 0, rounding = 0;  // of the primal and of the dual residual
  const auto measure = [&](const BlockResidual& found) {
    report.dual = std::sqrt(found.squared);
    report.primal = std::hypot(w.distance(w.v, w.rebuilt), std::sqrt(w.torque_missed));
    report.scale = w.distance(w.v, w.start_v) + free_change;
    const double impulses = std::sqrt(found.impulses_squared);
    const bool balance = report.scale <= std::sqrt(rounding_unit) * impulses;  // to half of the digits
    velocity_rounding = 8 * rounding_unit * (free_speed + (balance ? impulses : 0.0));
    rounding = 8 * rounding_unit * free_speed + std::sqrt(found.rounding_squared);
  };

  for (;; ++report.outer_iterations) {
    measure(w.refresh(scene));
    if (report.outer_iterations == 0) first_residual = std::max(report.primal, report.dual);
    if (observer)
      observer({report.outer_iterations, report.sweeps, report.row_updates, report.primal, report.dual,
                report.scale, w.x, w.v});
    w.keep_if_best(report.outer_iterations, std::max(report.primal, report.dual));
    w.last_change = w.change;
    w.change = w.distance(w.v, w.previous);
    const double now = std::max(report.primal, report.dual);
    constexpr double falling = 0.5;  // the impulses may go on where v has arrived
    const bool stalled = report.outer_iterations > 0 && w.change <= rounding_unit * w.norm(w.v) &&
                         !(now < falling * last_residual);
    last_residual = now;
    if (finished(method, velocity_rounding, rounding, first_residual, report)) {
      if (report.status != Status::ok || !w.widen_contacts(scene)) break;
      continue;
    }
    if (w.on_potential && report.outer_iterations > 0) {
      constexpr int patience = 5;
      constexpr double near = 10;  // times the tolerance
      without_fall = report.primal < lowest ? 0 : without_fall + 1;
      lowest = std::min(lowest, report.primal);
      const bool solved = w.find_direction() <= near * method.tolerance * report.scale;
      if (stalled || (solved && without_fall >= patience) ||
          report.outer_iterations + 1 >= method.max_outer) {
        constexpr double inner_share = 0.3;  // of the tolerance, left to the linear rows
        measure(w.settle(scene, inner_share * method.tolerance * report.scale));
        if (finished(method, velocity_rounding, rounding, first_residual, report)) break;
        without_fall = 0;
        w.unsettle(scene);
      }
    }
    if (stalled) {
      report.reason = "stalled away from the solution";
      break;
    }
    w.previous = w.v;
    w.outer.iterate(iteration);
  }
  if (report.status == Status::not_converged && w.return_to_best(std::max(report.primal, report.dual)))
    measure(w.refresh(scene));
  if (!w.x.allFinite() || !w.v.allFinite() || !std::isfinite(state.time + h)) {
    report.status = Status::diverged;
    report.reason = not_finite;
  }
  if (report.status != Status::diverged) {
    const auto sweeps = w.estimate_contraction(scene);
    report.sweeps += sweeps;
    report.row_updates += sweeps * row_count(w.rows);
    report.contraction = w.contraction;
    w.restore_momentum();
    w.end(h, state);
  } else {
    w.forget_impulses();
    w.forget_prediction();
    w.forget_history();
  }
  return report;
}

}  // namespace pbd
