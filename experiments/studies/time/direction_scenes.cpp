#include "studies/time/direction_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "names.h"
#include "outer/outer_names.h"
#include "scenes/standard.h"

namespace pbdcheck {

using namespace pbd;

std::vector<Scheme> position_schemes(std::string_view outer) {
  std::vector<Scheme> all;
  for (const auto& [integrator, blend] : {std::pair{"implicit_euler", 0.0},
                                          {"implicit_euler", 0.25},
                                          {"implicit_euler", 0.5},
                                          {"implicit_euler", 0.75},
                                          {"implicit_euler", 1.0},
                                          {"symplectic_euler", 0.0}}) {
    Method& method = all.emplace_back(Scheme{"position"}).method;
    method.integrator = integrator;
    method.outer = outer;
    method.relaxation = "direct";
    method.max_outer = 1000;
    method.direction_blend = blend;
  }
  return all;
}

std::vector<Scheme> velocity_schemes() {
  std::vector<Scheme> all;
  for (const double share : {0.0, 0.2, 1.0}) {
    Method& method = all.emplace_back(Scheme{"velocity"}).method;
    method.outer = "frozen";
    method.relaxation = "direct";
    method.max_outer = 1;
    method.direction_blend = 0;
    method.stabilisation = share;
  }
  return all;
}

std::vector<Scheme> joined(std::vector<Scheme> first, const std::vector<Scheme>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

namespace {

/// Kinetic energy and that of gravity, which is 0 at the start.
std::function<double(const State&)> energy_in_gravity(const Scene& scene) {
  return [&mass = scene.mass, start = scene.initial.x](const State& state) {
    double sum = 0;
    for (std::size_t node = 0; node < mass.size(); ++node) {
      if (!std::isfinite(mass[node])) continue;
      const auto i = static_cast<Eigen::Index>(node);
      sum += mass[node] *
             (state.v.col(i).squaredNorm() / 2 - Gravity{}.acceleration.dot(state.x.col(i) - start.col(i)));
    }
    return sum;
  };
}

const Distance& links_of(const Scene& scene) {
  return std::get<Distance>(scene.effects.back());
}

}  // namespace

DirectionScene hard_pendulum() {
  return {"pendulum", pendulum(std::numbers::pi / 2, 0), 9.81, 1, {}};
}

DirectionScene swinging_tip(int links, double ratio) {
  const Scene scene = chain(links, ratio);
  double scale = 0;  // that a fall to the lowest place sets free
  for (int node = 1; node <= links; ++node)
    scale += scene.mass[static_cast<std::size_t>(node)] * 9.81 * scene.initial.x(0, node);
  return {fmt::format("chain{} tip x{:g}", links, ratio), scene, scale, 1, {}};
}

double TautChain::frequency(int mode) {
  return 2 * std::sqrt(tension / (mass * length)) *
         std::sin((2 * mode - 1) * std::numbers::pi / (2 * (2 * links + 1)));
}

Vec3 TautChain::shape(int mode, int node) {
  return {0, 0, std::sin((2 * mode - 1) * std::numbers::pi * node / (2 * links + 1))};
}

double TautChain::coordinate(int mode, const Points& x) {
  double sum = 0, square = 0;
  for (int node = 1; node <= links; ++node) {
    const Vec3 direction = shape(mode, node);
    sum += direction.dot(x.col(node));
    square += direction.squaredNorm();
  }
  return sum / square;
}

Scene TautChain::at_rest() {
  Scene scene = chain(links);
  scene.effects.front() = ExternalForce{.node = {links}, .force = {Vec3(tension, 0, 0)}};
  return scene;
}

DirectionScene taut_chain(double speed) {
  DirectionScene all{"taut chain20", TautChain::at_rest(), 0, 1e4, {}};
  for (int node = 1; node <= TautChain::links; ++node)
    for (int mode = 1; mode <= TautChain::links; ++mode)
      all.scene.initial.v.col(node) += speed * TautChain::shape(mode, node);
  all.energy = [](const State& state) {
    double sum = 0;
    for (int node = 1; node <= TautChain::links; ++node) {
      const double slope = (state.x(2, node) - state.x(2, node - 1)) / TautChain::length;
      sum += TautChain::mass * state.v(2, node) * state.v(2, node) / 2 +
             TautChain::tension * TautChain::length * slope * slope / 2;
    }
    return sum;
  };
  all.energy_scale = all.energy(all.scene.initial);
  return all;
}

DirectionRun simulate(const DirectionScene& each, const Method& method, double h, double duration,
                      const StateWatch& watch) {
  const auto& [name, scene, scale, largest_gain, own_energy] = each;
  const auto energy_of = own_energy ? own_energy : energy_in_gravity(scene);
  const bool claims = find_named(outer_names(), "outer", method.outer).solves_step;
  const Distance& links = links_of(scene);
  Workspace workspace(scene, method);
  State state = scene.initial;
  const double before = energy_of(state);
  double energy = before, squares = 0;
  std::int64_t row_updates = 0;
  DirectionRun found;
  found.energy_lowest = found.energy_highest = before / scale;
  const int count = std::max(1, static_cast<int>(std::lround(duration / h)));
  while (found.steps < count && found.status != Status::diverged) {
    const Report report = step(workspace, h, state);
    ++found.steps;
    row_updates += report.row_updates;
    found.most_outer = std::max(found.most_outer, report.outer_iterations);
    if (report.status != Status::ok) {
      ++found.missed;
      if (claims || report.status == Status::diverged)
        found.status = report.status, found.reason = report.reason;
    }
    const double next = energy_of(state);
    found.largest_rise = std::max(found.largest_rise, (next - energy) / scale);
    energy = next;
    found.energy_lowest = std::min(found.energy_lowest, energy / scale);
    found.energy_highest = std::max(found.energy_highest, energy / scale);
    for (std::size_t i = 0; i < links.node.size(); ++i) {
      const auto& [a, b] = links.node[i];
      const double error = (state.x.col(b) - state.x.col(a)).norm() / links.rest_length[i] - 1;
      found.violation_largest = std::max(found.violation_largest, std::abs(error));
      squares += error * error;
    }
    if (!(energy - before <= largest_gain * scale)) {
      found.status = Status::diverged;
      found.reason = fmt::format("energy grew by {:g} times its scale", largest_gain);
    }
    if (!(found.violation_largest <= 1)) {
      found.status = Status::diverged;
      found.reason = "a link doubled its length";
    }
    if (watch) watch(state);
  }
  found.energy_end = energy / scale;
  found.violation_rms = std::sqrt(squares / (found.steps * static_cast<double>(links.node.size())));
  found.work_per_s = static_cast<double>(row_updates) / (found.steps * h);
  return found;
}

}  // namespace pbdcheck
