#include "harness/order_study.h"

#include <algorithm>
#include <cmath>

#include "harness/integrator_rules.h"
#include "harness/measure.h"
#include "harness/order_fit.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr int samples = 4;  // at equal intervals, the last at the end
constexpr int fitted_levels = 4;

std::vector<double> sample_times(const Motion& motion) {
  std::vector<double> times;
  for (int i = 1; i <= samples; ++i) times.push_back(motion.duration * i / samples);
  return times;
}

double largest_distance(const Points& a, const Points& b) {
  return (a - b).colwise().norm().maxCoeff<Eigen::PropagateNaN>();
}

Points order_places(const Motion& motion, const State& state) {
  return places(motion.scene, state.x, state.orientation);
}

struct OrderLevel {
  int steps;
  double h;             // s
  double error = 0;     // of the worst node and sample over the motion's size
  double unsolved = 0;  // difference to the same steps at 100 times the tolerance, likewise
  Simulation run{};
};

/// Positions at the samples.
std::vector<Points> sampled(const Motion& motion, const Method& method, OrderLevel& level) {
  std::vector<Points> x;
  int done = 0;
  const Points start = order_places(motion, motion.scene.initial);
  level.run =
      simulate_steps(motion.scene, method, level.h, level.steps, [&](const State&, const State& after) {
        const Points now = order_places(motion, after);
        if (++done % (level.steps / samples) == 0) x.push_back(now);
        const bool lost = !(largest_distance(now, start) < 100 * motion.size);
        return lost ? "a hundred times the motion away" : "";
      });
  return x;
}

OrderLevel order_level(const Motion& motion, Rule rule, int steps) {
  OrderLevel level{.steps = steps, .h = motion.duration / steps};
  OrderLevel looser = level;
  const auto x = sampled(motion, rule.method, level);
  rule.method.tolerance *= 100;
  const auto other = sampled(motion, rule.method, looser);
  if (x.size() < samples || other.size() < samples) {
    level.error = level.unsolved = std::nan("");
    return level;
  }
  Worst error, unsolved;
  for (std::size_t i = 0; i < samples; ++i) {
    error.add(largest_distance(x[i], order_places(motion, motion.exact.samples[i])) / motion.size);
    unsolved.add(largest_distance(x[i], other[i]) / motion.size);
  }
  level.error = error.value();
  level.unsolved = unsolved.value();
  if (!(level.error < 1)) {
    level.run.status = Status::diverged;
    level.run.reason = "the error exceeds the motion";
  }
  return level;
}

struct OrderCourse {
  const Motion* motion;
  Rule rule;
  std::vector<OrderLevel> levels{};
};

double largest_error(const std::vector<double>& errors) {
  return *std::max_element(errors.begin(), errors.end());
}

void write_errors(Table& table, const OrderCourse& course) {
  const double judge_error = largest_error(course.motion->exact.position_error) / course.motion->size;
  double coarser = std::nan("");
  for (const OrderLevel& level : course.levels) {
    std::vector<Cell> row{course.motion->name};
    for (auto& cell : method_cells(course.rule)) row.push_back(std::move(cell));
    for (const double number :
         {level.h, level.error, std::log2(coarser / level.error), level.unsolved, judge_error})
      row.emplace_back(number);
    row.emplace_back(status_cell(level.run.status));
    row.emplace_back(level.run.reason);
    table.row(row);
    coarser = level.error;
  }
}

/// Where a rule's order is decided: not of a damped newmark, whose errors of first and second order compete,
/// nor where hard constraints are marginal.
bool order_is_judged(const OrderCourse& course) {
  const bool damped = course.rule.method.integrator == "newmark" && course.rule.order == 1;
  return course.motion->judged && !damped && !(course.motion->hard && course.rule.marginal);
}

int expected_order(const OrderCourse& course) {
  return std::min(course.rule.order, course.motion->highest_order);
}

/// A row of `orders`, and the verdicts.
void conclude_order(Context& context, std::string_view experiment, Table& table, const OrderCourse& course,
                    Worst& resolved) {
  std::vector<double> h, error;
  Simulation worst;
  const double exact = largest_error(course.motion->exact.position_error) / course.motion->size;
  for (auto level = course.levels.end() - fitted_levels; level != course.levels.end(); ++level) {
    h.push_back(level->h);
    error.push_back(level->error);
    if (level->run.status > worst.status) worst = level->run;
    if (order_is_judged(course)) resolved.add((level->unsolved + exact) / level->error);
  }
  const double order = fitted_order(h, error);
  const int expected = expected_order(course);
  std::vector<Cell> row{course.motion->name};
  for (auto& cell : method_cells(course.rule)) row.push_back(std::move(cell));
  row.insert(row.end(),
             {order, static_cast<double>(expected), std::int64_t{fitted_levels}, h.back(), error.back(),
              std::string(behaviour_of(error)), status_cell(worst.status), worst.reason});
  table.row(row);
  if (!order_is_judged(course)) return;
  const bool solved = worst.status == Status::ok && behaviour_of(error) == "converging";
  context.verdict(Basis::theory,
                  std::string(experiment) + "." + course.motion->name + "." + course.rule.name(),
                  "the errors fall at the integrator's order", "|order - " + std::to_string(expected) + "|",
                  solved ? std::abs(order - expected) : std::nan(""), expected == 1 ? 0.05 : 0.1);
}

}  // namespace

void study_orders(Context& context, std::string_view experiment, std::vector<Motion> motions,
                  const std::vector<double>& alphas) {
  const int levels = context.full() ? 7 : 5;
  Table errors =
      context.table("errors", {"scene", "integrator", "alpha", "outer", "relaxation", "step_s", "error",
                               "order", "error_solve", "error_reference", "status", "reason"});
  Table orders = context.table(
      "orders", {"scene", "integrator", "alpha", "outer", "relaxation", "order", "order_expected", "levels",
                 "step_s", "error", "behaviour", "status", "reason"});
  Worst resolved;
  for (Motion& motion : motions) {
    if (motion.coarsest_steps % samples != 0)
      throw std::logic_error(motion.name + ": samples fall between steps");
    motion.exact = reference::ode(motion.scene, sample_times(motion));
    if (motion.exact.outcome != reference::Outcome::ok)
      throw std::runtime_error("ode, " + motion.name + ": " + motion.exact.reason);
    for (const State& sample : motion.exact.samples)
      motion.size = std::max(motion.size, largest_distance(order_places(motion, sample),
                                                           order_places(motion, motion.scene.initial)));
    std::vector<OrderCourse> courses;
    for (const Rule& rule : integrator_rules(alphas))
      if (rule.method.integrator != motion.shown_elsewhere) courses.push_back({&motion, rule});
    for (OrderCourse& course : courses) course.levels.resize(static_cast<std::size_t>(levels));
    context.parallel(std::ssize(courses) * levels, [&](std::int64_t index) {
      OrderCourse& course = courses[static_cast<std::size_t>(index / levels)];
      const auto k = static_cast<int>(index % levels);
      course.levels[static_cast<std::size_t>(k)] =
          order_level(motion, course.rule, motion.coarsest_steps << k);
    });
    for (const OrderCourse& course : courses) {
      write_errors(errors, course);
      conclude_order(context, experiment, orders, course, resolved);
    }
    context.advance(motion.name);
  }
  errors.close();
  orders.close();
  context.verdict(
      Basis::theory, std::string(experiment) + ".resolved",
      "what is left unsolved in the steps and the judge's own error stay two decades below each error fitted",
      "largest share of the error", resolved.value(), 0.01);
}

}  // namespace pbdcheck
