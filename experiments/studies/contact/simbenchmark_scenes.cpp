// Scenes of SimBenchmark (kang2018simbenchmark). SI units.
#include <cmath>
#include <random>

#include "scenes/contacts.h"
#include "studies/contact/simbenchmark.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double box_mass = 10, ball_mass = 1, ball_radius = 0.5, push = 150;
constexpr int balls = 25;

constexpr double small = 0.1, heavy = 10;  // m, kg

double energy(const State& state) {
  double sum = 0;
  for (Eigen::Index k = 1; k < state.x.cols(); ++k)  // the ground is the first
    sum += heavy * (state.v.col(k).squaredNorm() / 2 + gravity * state.x(2, k));
  for (Eigen::Index b = 1; b < state.spin.cols(); ++b)
    sum += heavy * small * small / 5 * state.spin.col(b).squaredNorm();
  return sum;
}

std::function<double(const State&)> energy_error(const Scene& scene) {
  return [start = energy(scene.initial)](const State& state) { return std::pow(energy(state) - start, 2); };
}

double overlap(const State& state) {
  double sum = 0;
  for (Eigen::Index k = 1; k < state.x.cols(); ++k) {
    sum += std::pow(std::max(0.0, small - state.x(2, k)), 2);
    for (Eigen::Index l = 1; l < k; ++l)
      sum += std::pow(std::max(0.0, 2 * small - (state.x.col(k) - state.x.col(l)).norm()), 2);
  }
  return sum;
}

}  // namespace

Benchmark rolling_balls(double angle, const std::string& variant) {
  constexpr double rough = 0.4, rougher = 0.8, sunk = 2e-5;
  BodyScene build({.friction = 0.5});
  build.materials(3, {.friction = 0.5});
  build.law(0, 1, {.friction = rough});
  build.law(1, 2, {.friction = rougher});
  build.ground(0, 0);
  const double floor = 0.5 - sunk;
  const int box = build.box(Vec3(20, 20, 1), box_mass, {Vec3(0, 0, floor)}, 1);
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j)
      build.ball(ball_radius, ball_mass,
                 {Vec3(2.0 * (i - 2), 2.0 * (j - 2), floor + 0.5 + ball_radius - 2 * sunk)}, 2);
  build.contact().recovery = 0;  // the benchmark corrects no overlap, either
  Benchmark made{"rolling_" + variant, build.finish(), 4, "implicit_euler", {}};
  const Vec3 direction(std::cos(angle), std::sin(angle), 0);
  const int box_node = made.scene.bodies[static_cast<std::size_t>(box)].node, ball_node = box_node + 1;
  made.scene.effects.emplace_back(ExternalForce{{box_node}, {push * direction}});
  // Each ball rolls: its contact's force f gives it f/m, and its surface 3.5 f/m against its centre at rest.
  const double below = rough * (box_mass + balls * ball_mass) * gravity;
  const double on_ball = (push - below) / box_mass / (3.5 / ball_mass + balls / box_mass);
  const double box_rate = (push - below - balls * on_ball) / box_mass, ball_rate = on_ball / ball_mass;
  made.error = [=](const State& state) {
    return (state.v.col(box_node) - box_rate * state.time * direction).squaredNorm() +
           (state.v.col(ball_node) - ball_rate * state.time * direction).squaredNorm();
  };
  return made;
}

Benchmark bouncing_balls() {
  BodyScene build({.friction = 0, .restitution = 1});
  build.ground();
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j < 7; ++j) build.ball(small, heavy, {Vec3(2.0 * i, 2.0 * j, 5)});
  Benchmark made{"bouncing", build.finish(), 20, "newmark", {}};
  made.error = energy_error(made.scene);
  return made;
}

Benchmark cube_of_balls(bool elastic) {
  BodyScene build({.friction = 0, .restitution = elastic ? 1.0 : 0.0});
  build.ground();
  std::mt19937_64 engine(42);
  std::uniform_real_distribution<double> disturbed(0, 1e-3);
  constexpr double pitch = 0.21;
  const double lowest = elastic ? 1.101 : 0.101;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      for (int k = 0; k < 6; ++k) {
        const double x = disturbed(engine), y = disturbed(engine), z = disturbed(engine);
        build.ball(small, heavy, {Vec3(pitch * i + x, pitch * j + y, lowest + pitch * k + z)});
      }
  Benchmark made{
      elastic ? "elastic_666" : "666", build.finish(), 10, elastic ? "newmark" : "implicit_euler", {}};
  made.error = elastic ? energy_error(made.scene) : overlap;
  return made;
}

}  // namespace pbdcheck
