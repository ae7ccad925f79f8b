// What do directions at a step's begin, its end or between do to stability, constraints and energy, and what
// does velocity time stepping, which solves one linearisation? A small transverse motion y of a taut chain
// has y'' = -w^2 y of each mode, with the force at y_l + b (y_l+1 - y_l): the step's matrix has the
// determinant 1/D and the trace 1 + (1 - h^2 w^2)/D, D = 1 + b h^2 w^2. It is stable up to h = 2/(w sqrt(1 -
// 2 b)) if b < 1/2, else always, and leaves 1/D of the energy.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "direction_scenes.h"
#include "experiments.h"
#include "measure.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double gravity = 9.81;
constexpr double frame = 1.0 / 60;  // s

/// Every scheme as a user would take it.
std::vector<Scheme> default_schemes() {
  return joined(position_schemes("auto"), velocity_schemes());
}

std::vector<Cell> name_cells(const std::string& scene, const Scheme& scheme) {
  const Method& m = scheme.method;
  const double none = std::nan("");
  return {scene,
          scheme.family,
          m.integrator,
          m.outer,
          m.relaxation,
          m.direction_blend,
          m.outer == "frozen" ? m.stabilisation : none};
}
const std::vector<std::string> name_columns{"scene",      "family",          "integrator",   "outer",
                                            "relaxation", "direction_blend", "stabilisation"};

Table open(Context& context, std::string_view name, std::initializer_list<std::string> columns) {
  auto all = name_columns;
  all.insert(all.end(), columns);
  return context.table(name, all);
}

void add_row(Table& table, const std::string& scene, const Scheme& scheme, std::vector<Cell> values,
             const Simulation& run) {
  auto cells = name_cells(scene, scheme);
  cells.insert(cells.end(), values.begin(), values.end());
  cells.emplace_back(std::string(status_names[static_cast<std::size_t>(run.status)]));
  cells.emplace_back(run.reason);
  table.row(cells);
}

// ---- largest stable steps

struct Search {
  DirectionScene scene;
  double first, ratio;  // the grid of steps: first * ratio^k, s
  int count;
  std::function<double(double h)> duration;     // s
  double (*predicted)(double blend) = nullptr;  // s
};

/// Of the taut chain's fastest mode.
double predicted_step(double blend) {
  return blend < 0.5 ? 2 / (TautChain::frequency(TautChain::links) * std::sqrt(1 - 2 * blend)) : infinity;
}

constexpr double fine_ratio = 1.01;

std::vector<Search> searches(bool full) {
  const double duration = full ? 10 : 2;
  const auto constant = [=](double) { return duration; };
  return {{taut_chain(1e-4), 2e-3, fine_ratio, 357, [](double h) { return 400 * h; }, predicted_step},
          {hard_pendulum(), 1e-3, 1.05, 120, [](double) { return 10.0; }},
          {swinging_tip(10, 1), 1e-3, 1.05, 100, constant},
          {swinging_tip(10, 100), 1e-3, 1.05, 100, constant}};
}

struct Limit {
  double largest = 0;       // s; 0 if even the first step is too large
  bool whole_grid = false;  // stable at the largest step tried
  Simulation at_largest{}, beyond{};
};

/// Steps are doubled until one is unstable, the last interval is bisected.
Limit find_limit(const Search& search, const Method& method) {
  const int doubling = static_cast<int>(std::lround(std::log(2) / std::log(search.ratio)));
  Limit limit;
  int stable = -1, unstable = search.count;
  bool found = false;
  for (int k = 0; unstable - stable > 1;
       k = found ? (stable + unstable) / 2 : std::min(k + doubling, search.count - 1)) {
    const double h = search.first * std::pow(search.ratio, k);
    Simulation run = simulate(search.scene, method, h, search.duration(h));
    if (run.status == Status::diverged) {
      unstable = k;
      limit.beyond = std::move(run);
      found = true;
    } else {
      stable = k;
      limit.largest = h;
      limit.at_largest = std::move(run);
    }
  }
  if (stable < 0) limit.at_largest = limit.beyond;
  limit.whole_grid = stable == search.count - 1;
  return limit;
}

void largest_steps(Context& context) {
  // Where a step has several solutions, auto may begin with plain and end at a folded one.
  const auto all = searches(context.full());
  const auto tried =
      joined(joined(position_schemes("proximal"), velocity_schemes()), position_schemes("auto"));
  std::vector<Limit> limits(all.size() * tried.size());
  context.parallel(std::ssize(limits), [&](std::int64_t index) {
    const auto k = static_cast<std::size_t>(index);
    limits[k] = find_limit(all[k / tried.size()], tried[k % tried.size()].method);
  });
  Table table = open(
      context, "largest_steps",
      {"largest_step_s", "predicted_step_s", "error", "steps", "missed_steps", "limit", "status", "reason"});
  Worst error;
  for (std::size_t k = 0; k < limits.size(); ++k) {
    const Search& search = all[k / tried.size()];
    const Scheme& scheme = tried[k % tried.size()];
    const Limit& limit = limits[k];
    const double predicted =
        search.predicted ? search.predicted(scheme.method.direction_blend) : std::nan("");
    const bool never = predicted == infinity;
    const double apart = never ? (limit.whole_grid ? 0 : infinity) : std::abs(limit.largest / predicted - 1);
    if (search.predicted && scheme.method.outer != "auto") error.add(apart);
    add_row(table, search.scene.name, scheme,
            {limit.largest, predicted, search.predicted ? apart : std::nan(""),
             std::int64_t{limit.at_largest.steps}, std::int64_t{limit.at_largest.missed},
             limit.whole_grid ? "stable at the largest step tried" : limit.beyond.reason},
            limit.at_largest);
  }
  table.close();
  context.verdict("direction.largest_step",
                  "a taut chain is stable up to 2/(w sqrt(1 - 2 b)), from b = 1/2 on up to ten times the "
                  "explicit limit, if proximal "
                  "solves its steps",
                  "largest |measured/predicted - 1|", error.value(), fine_ratio - 1);
}

// ---- modes of the taut chain

void modes(Context& context) {
  Table table =
      open(context, "modes",
           {"mode", "step_s", "predicted_left", "measured_left", "error", "row_updates", "status", "reason"});
  constexpr double amplitude = 1e-6;  // m
  constexpr double slope = 2 * amplitude / TautChain::length;
  Worst worst;
  for (const auto& scheme : default_schemes())
    for (const int mode : {5, 10, 20}) {
      const double w = TautChain::frequency(mode), h = 1 / w;
      DirectionScene scene = taut_chain(0);
      for (int node = 1; node <= TautChain::links; ++node)
        scene.scene.initial.v.col(node) = amplitude * w * TautChain::shape(mode, node);
      scene.energy_scale = 1;  // the start has none of its own
      Method method = scheme.method;
      method.tolerance = 1e-12;
      std::vector<double> q;
      const Simulation run = simulate(scene, method, h, 4 * h, [&](const State& state) {
        q.push_back(TautChain::coordinate(mode, state.x));
      });
      const double predicted = 1 / (1 + method.direction_blend);
      const double left =
          q.size() < 4 ? std::nan("") : (q[3] * q[1] - q[2] * q[2]) / (q[2] * q[0] - q[1] * q[1]);
      const double error = std::abs(left / predicted - 1);
      worst.add(run.status == Status::ok ? error : std::nan(""));
      add_row(
          table, scene.name, scheme,
          {std::int64_t{mode}, h, predicted, left, error, std::int64_t(std::llround(run.work_per_s * 4 * h))},
          run);
    }
  table.close();
  // N links that turn by `slope` shorten by N d slope^2/2; that pulls N masses within h = sqrt(m d/T)/2 or
  // more, and so changes the tension by 2 N^2 slope^2 of it.
  context.verdict("direction.mode",
                  "a step leaves 1/(1 + b h^2 w^2) of a mode's energy, all of it where b = 0",
                  "largest |measured/predicted - 1|", worst.value(),
                  2 * TautChain::links * TautChain::links * slope * slope);
}

// ---- the pendulum's energy

struct Swing {
  Simulation run;
  double squares = 0;  // sum of h^2 |v|^2, m^2
  double fastest = 0;  // m/s
  double square = 0;   // of the length at the end, m^2
};

Swing swing(const Scheme& scheme, double h, double duration, Table* table) {
  const DirectionScene scene = hard_pendulum();
  Swing found;
  int k = 0;
  struct Sample {
    double time, energy;
  };
  std::vector<Sample> samples{{0, 0}};
  found.run = simulate(scene, scheme.method, h, duration, [&](const State& state) {
    const double speed = state.v.col(1).norm();
    found.squares += h * h * speed * speed;
    found.fastest = std::max(found.fastest, speed);
    found.square = state.x.col(1).squaredNorm();
    if (++k % 3 == 0) samples.push_back({state.time, speed * speed / 2 + gravity * state.x(2, 1)});
  });
  if (table)
    for (const auto& [time, energy] : samples)
      add_row(*table, scene.name, scheme, {h, time, energy, found.run.work_per_s}, found.run);
  return found;
}

void pendulum_energy(Context& context) {
  Table table =
      open(context, "energy", {"step_s", "time_s", "energy_j", "row_updates_per_s", "status", "reason"});
  constexpr double duration = 10;  // s
  // An explicit step's velocity is that of its middle: it lacks h/2 of the change of kinetic energy, at most
  // m g times the largest rate of fall, sqrt(2 g l cos a) sin a at cos^2 a = 1/3; the next order is smaller
  // by h sqrt(g/l).
  const double fall = std::sqrt(2 * gravity / std::sqrt(3.0)) * std::sqrt(2.0 / 3);
  const double band = frame / 2 * gravity * fall * (1 + frame * std::sqrt(gravity));
  Worst explicit_band, rise, violation, leaves, stabilised;
  for (const auto& scheme : default_schemes()) {
    const Method& m = scheme.method;
    const auto [run, squares, fastest, square] = swing(scheme, frame, duration, &table);
    const bool usable = run.status == Status::ok;
    const auto added = [&](double value) { return usable ? value : std::nan(""); };
    if (m.outer == "frozen") {
      if (m.stabilisation == 0) leaves.add(added(std::abs((square - 1) / squares - 1)));
      if (m.stabilisation == 1)
        stabilised.add(added(run.violation_largest / (frame * frame * fastest * fastest / 2)));
      continue;
    }
    violation.add(added(run.violation_largest));
    if (m.direction_blend == 0)
      explicit_band.add(added(gravity * std::max(run.energy_highest, -run.energy_lowest)));
    if (m.direction_blend == 1) rise.add(added(run.largest_rise));
  }
  table.close();
  const double tolerance = Method{}.tolerance;
  context.verdict("direction.explicit_energy",
                  "explicit directions keep the pendulum's energy in the band of velocities half a step late",
                  "largest change (J)", explicit_band.value(), band);
  // The link pulls all the time; then a step changes the energy by -m |v_l+1 - v_l|^2/2 - T l (1 -
  // cos(turn)).
  context.verdict("direction.implicit_energy",
                  "implicit directions let the pendulum's energy fall every step",
                  "largest rise in a step, of m g l", rise.value(), tolerance);
  // |c|/h is at most the tolerance times the scale: changes of velocity by accelerations up to 3 g together.
  context.verdict("direction.violation", "solved steps violate the pendulum's link by their tolerance",
                  "largest violation (m)", violation.value(), 4 * tolerance * frame * frame * gravity);
  context.verdict(
      "direction.velocity_leaves",
      "velocity time stepping leaves the circle: the square of the length grows by (h v)^2 a step",
      "|growth/sum of (h v)^2 - 1|", leaves.value(), 1e-10);
  context.verdict("direction.velocity_stabilised",
                  "stabilised in full, velocity time stepping violates the link by (h v)^2/2 l, a step's own",
                  "largest violation over (h v)^2/2 l of the fastest step", stabilised.value(), 1);
}

// ---- constraints at equal work

void equal_work(Context& context) {
  const double duration = context.full() ? 10 : 2;
  std::vector<DirectionScene> scenes{hard_pendulum(), taut_chain(0.1), swinging_tip(10, 1),
                                     swinging_tip(10, 100)};
  const std::vector<int> counts =
      context.full() ? std::vector{1, 2, 4, 8, 16, 32, 64, 128} : std::vector{1, 2, 4, 8, 16, 32, 64};
  const auto tried = default_schemes();
  struct Budget {
    const DirectionScene* scene;
    const Scheme* scheme;
    int linearisations;  // a frame
    double h;
    Simulation run{};
  };
  std::vector<Budget> all;
  for (const auto& scene : scenes)
    for (const auto& scheme : tried)
      for (const int count : counts)
        all.push_back({&scene, &scheme, count, scheme.family == "velocity" ? frame / count : frame});
  context.parallel(std::ssize(all), [&](std::int64_t index) {
    Budget& each = all[static_cast<std::size_t>(index)];
    Method method = each.scheme->method;
    if (each.scheme->family == "position") method.max_outer = each.linearisations;
    each.run = simulate(*each.scene, method, each.h, duration);
  });
  Table table = open(context, "equal_work",
                     {"linearisations_per_frame", "step_s", "duration_s", "row_updates_per_s", "error",
                      "violation_rms", "energy_change", "missed_steps", "steps", "status", "reason"});
  for (const auto& each : all)
    add_row(table, each.scene->name, *each.scheme,
            {std::int64_t{each.linearisations}, each.h, duration, each.run.work_per_s,
             each.run.violation_largest, each.run.violation_rms, each.run.energy_end,
             std::int64_t{each.run.missed}, std::int64_t{each.run.steps}},
            each.run);
  table.close();

  /// The violation by velocity time stepping of the same kind that does as much work or the next more.
  const auto next_dearer = [&](const Budget& each, const Scheme& other) {
    const Budget* next = nullptr;
    for (const auto& run : all)
      if (run.scene == each.scene && run.scheme == &other && run.run.work_per_s >= each.run.work_per_s &&
          (!next || run.run.work_per_s < next->run.work_per_s))
        next = &run;
    return next ? next->run.violation_largest : std::nan("");
  };
  Worst ratio;
  for (const auto& each : all)
    if (each.scene == scenes.data() && each.scheme->family == "position" &&
        each.scheme->method.direction_blend == 1)
      for (const auto& other : tried)
        if (other.family == "velocity") ratio.add(each.run.violation_largest / next_dearer(each, other));
  // One linearisation leaves the pendulum's link by (h v)^2/2 l. The next begins at a velocity that is off by
  // h^2 times an acceleration, and leaves by the square of that: less, as h a < v.
  context.verdict("direction.equal_work",
                  "on the pendulum, linearisations of one step violate the link less than as many row "
                  "updates of shorter steps",
                  "largest violation, position/velocity", ratio.value(), 1);
}

}  // namespace

void direction(Context& context) {
  context.begin(4);
  largest_steps(context);
  context.advance("largest steps");
  modes(context);
  context.advance("modes");
  pendulum_energy(context);
  context.advance("energy");
  equal_work(context);
  context.advance("equal work");
}

}  // namespace pbdcheck
