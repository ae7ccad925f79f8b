// At which order does each integrator approach the motion in continuous time? Errors against the judge `ode`
// at four times of the motion, over steps halved again and again; the observed order is that of the four
// finest ones.
#include <algorithm>
#include <cmath>

#include "experiments.h"
#include "integrator_rules.h"
#include "measure.h"
#include "ode.h"
#include "order_fit.h"
#include "scenes/standard.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr int samples = 4;  // at equal intervals, the last at the end
constexpr int fitted_levels = 4;

struct Motion {
  std::string name;
  Scene scene;
  double duration;     // s
  int coarsest_steps;  // of the first level
  bool hard = false;
  bool judged = true;  // false: so long that the orders are not yet seen
  reference::Trajectory exact{};
  double size = 0;  // m, the largest displacement from the start at a sample
};

/// Bob on a link along x of rest length 1 m, stretched by 0.1 m: 1 Hz.
Scene spring() {
  const double w = 2 * 3.14159265358979323846;
  Scene scene;
  add_node(scene, Vec3::Zero(), infinity);
  add_node(scene, Vec3(1.1, 0, 0), 1);
  scene.effects.emplace_back(Distance{.node = {{0, 1}}, .rest_length = {1}, .compliance = {1 / (w * w)}});
  return scene;
}

Scene links(int count, double compliance) {
  Scene scene = chain(count);
  for (double& each : std::get<Distance>(scene.effects[1]).compliance) each = compliance;
  return scene;
}

Scene bar() {
  return clamped_solid(kuhn_grid({4, 1, 1}, Vec3(1, 0.25, 0.25)), {1e5, 0.3}, Strain::green);
}

std::vector<Motion> motions() {
  return {{"spring", spring(), 1, 200},
          {"compliant links", links(3, 0.05), 0.5, 200},
          {"compliant double pendulum", links(2, 0.01), 0.5, 200},
          {"tetrahedra", bar(), 0.5, 200},
          {"hard pendulum", pendulum(1.5, 0), 1, 200, true},
          {"hard double pendulum", links(2, 0), 0.5, 200, true},
          {"hard pendulum over 10 s", pendulum(1.5, 0), 10, 400, true, false}};
}

std::vector<double> sample_times(const Motion& motion) {
  std::vector<double> times;
  for (int i = 1; i <= samples; ++i) times.push_back(motion.duration * i / samples);
  return times;
}

double largest_distance(const Points& a, const Points& b) {
  return (a - b).colwise().norm().maxCoeff<Eigen::PropagateNaN>();
}

struct Level {
  int steps;
  double h;             // s
  double error = 0;     // of the worst node and sample over the motion's size
  double unsolved = 0;  // difference to the same steps at 100 times the tolerance, likewise
  Simulation run{};
};

/// Positions at the samples.
std::vector<Points> sampled(const Motion& motion, const Method& method, Level& level) {
  std::vector<Points> x;
  int done = 0;
  level.run =
      simulate_steps(motion.scene, method, level.h, level.steps, [&](const State&, const State& after) {
        if (++done % (level.steps / samples) == 0) x.push_back(after.x);
        const bool lost = !(largest_distance(after.x, motion.scene.initial.x) < 100 * motion.size);
        return lost ? "a hundred times the motion away" : "";
      });
  return x;
}

Level level_of(const Motion& motion, Rule rule, int steps) {
  Level level{.steps = steps, .h = motion.duration / steps};
  Level looser = level;
  const auto x = sampled(motion, rule.method, level);
  rule.method.tolerance *= 100;
  const auto other = sampled(motion, rule.method, looser);
  if (x.size() < samples || other.size() < samples) {
    level.error = level.unsolved = std::nan("");
    return level;
  }
  Worst error, unsolved;
  for (std::size_t i = 0; i < samples; ++i) {
    error.add(largest_distance(x[i], motion.exact.samples[i].x) / motion.size);
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

struct Course {
  const Motion* motion;
  Rule rule;
  std::vector<Level> levels{};
};

double largest_error(const std::vector<double>& errors) {
  return *std::max_element(errors.begin(), errors.end());
}

void write_errors(Table& table, const Course& course) {
  const double judged = largest_error(course.motion->exact.position_error) / course.motion->size;
  double coarser = std::nan("");
  for (const Level& level : course.levels) {
    std::vector<Cell> row{course.motion->name};
    for (auto& cell : method_cells(course.rule)) row.push_back(std::move(cell));
    for (const double number :
         {level.h, level.error, std::log2(coarser / level.error), level.unsolved, judged})
      row.emplace_back(number);
    row.emplace_back(status_cell(level.run.status));
    row.emplace_back(level.run.reason);
    table.row(row);
    coarser = level.error;
  }
}

/// Where a rule's order is decided: not of a damped newmark, whose errors of first and second order compete,
/// nor where hard constraints are marginal.
bool judged(const Course& course) {
  const bool damped = course.rule.method.integrator == "newmark" && course.rule.order == 1;
  return course.motion->judged && !damped && !(course.motion->hard && course.rule.marginal);
}

/// A row of `orders`, and the verdicts.
void conclude(Context& context, Table& table, const Course& course, Worst& resolved) {
  std::vector<double> h, error;
  Simulation worst;
  const double exact = largest_error(course.motion->exact.position_error) / course.motion->size;
  for (auto level = course.levels.end() - fitted_levels; level != course.levels.end(); ++level) {
    h.push_back(level->h);
    error.push_back(level->error);
    if (level->run.status > worst.status) worst = level->run;
    if (judged(course)) resolved.add((level->unsolved + exact) / level->error);
  }
  const double order = fitted_order(h, error);
  std::vector<Cell> row{course.motion->name};
  for (auto& cell : method_cells(course.rule)) row.push_back(std::move(cell));
  row.insert(row.end(),
             {order, static_cast<double>(course.rule.order), std::int64_t{fitted_levels}, h.back(),
              error.back(), std::string(behaviour_of(error)), status_cell(worst.status), worst.reason});
  table.row(row);
  if (!judged(course)) return;
  std::string id = "time_order." + course.motion->name + "." + course.rule.name();
  std::replace(id.begin(), id.end(), ' ', '_');
  const bool solved = worst.status == Status::ok && behaviour_of(error) == "converging";
  context.verdict(
      id, "the errors fall at the integrator's order", "|order - " + std::to_string(course.rule.order) + "|",
      solved ? std::abs(order - course.rule.order) : std::nan(""), course.rule.order == 1 ? 0.05 : 0.1);
}

}  // namespace

void time_order(Context& context) {
  auto scenes = motions();
  const int levels = context.full() ? 7 : 5;
  context.begin(std::ssize(scenes));
  Table errors =
      context.table("errors", {"scene", "integrator", "alpha", "outer", "relaxation", "step_s", "error",
                               "order", "error_solve", "error_reference", "status", "reason"});
  Table orders = context.table(
      "orders", {"scene", "integrator", "alpha", "outer", "relaxation", "order", "order_expected", "levels",
                 "step_s", "error", "behaviour", "status", "reason"});
  Worst resolved;
  for (Motion& motion : scenes) {
    motion.exact = reference::ode(motion.scene, sample_times(motion));
    if (motion.exact.outcome != reference::Outcome::ok)
      throw std::runtime_error("ode: " + motion.exact.reason);
    for (const State& sample : motion.exact.samples)
      motion.size = std::max(motion.size, largest_distance(sample.x, motion.scene.initial.x));
    std::vector<Course> courses;
    for (const Rule& rule : integrator_rules({0.5, 0.55})) courses.push_back({&motion, rule});
    for (Course& course : courses) course.levels.resize(static_cast<std::size_t>(levels));
    context.parallel(std::ssize(courses) * levels, [&](std::int64_t index) {
      Course& course = courses[static_cast<std::size_t>(index / levels)];
      const auto k = static_cast<int>(index % levels);
      course.levels[static_cast<std::size_t>(k)] = level_of(motion, course.rule, motion.coarsest_steps << k);
    });
    for (const Course& course : courses) {
      write_errors(errors, course);
      conclude(context, orders, course, resolved);
    }
    context.advance(motion.name);
  }
  errors.close();
  orders.close();
  context.verdict(
      "time_order.resolved",
      "what is left unsolved in the steps and the judge's own error stay two decades below each error fitted",
      "largest share of the error", resolved.value(), 0.01);
}

}  // namespace pbdcheck
