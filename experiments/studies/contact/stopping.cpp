// Do sliding bodies come to rest where they should? Boxes beside implicit Euler's recurrence and the motion
// in continuous time, balls, cylinders and hoops that slip until they roll, cubes that must not take off,
// a ring that spins flat on the ground and a row of cubes that is pushed.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "linear/linear_names.h"
#include "scenes/choices.h"
#include "scenes/contacts.h"
#include "studies/contact/contact_answers.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

void stop(KnownAnswers& answers, const Method& method, double h) {
  constexpr double friction = 0.5, speed = 5;
  const double a = friction * gravity;
  const auto steps = static_cast<std::int64_t>(speed / (a * h)) + 10;
  const ContactRun run = simulate_contacts(sliding_box(0, friction, speed), method, h, steps);
  const double moved = run.end.x(0, 1), exact = slide(speed, a, h, steps).x;
  const std::string name = "box, 5 m/s, friction 0.5";
  answers.add("distance", name, method, h, moved, exact, std::abs(moved - exact), run);
  // With v0 = (n + f) h a, 0 <= f < 1, the recurrence is h^2 a (f - f^2)/2 <= a h^2/8 from it.
  const double continuous = speed * speed / (2 * a), offset = -h * speed / 2;
  answers.add("offset", name, method, h, moved - continuous, offset,
              std::abs(moved - continuous - offset) / (a * h * h / 8), run);
}

/// Inertia over m R^2 is `share`: where it has slipped to v0/(1 + share), it rolls.
void roll(KnownAnswers& answers, const Method& method, double h, Round shape, double share,
          const std::string& name) {
  constexpr double friction = 0.2, speed = 1;
  const Scene scene = slipping(shape);
  const auto steps = std::lround(0.4 / h);
  const ContactRun run = simulate_contacts(scene, method, h, steps);
  const Slide exact = slide(speed, friction * gravity, h, steps, speed / (1 + share));
  const double v = run.end.v(0, 1), moved = run.end.x(0, 1);
  answers.add("rolling_speed", name, method, h, v, exact.v, relative_difference(v, exact.v), run);
  answers.add("rolling_way", name, method, h, moved, exact.x, std::abs(moved - exact.x), run);
}

void launch(KnownAnswers& answers, const Method& method, double h) {
  constexpr double friction = 0.5, speed = 6;
  const Scene scene = sliding_box(0, friction, speed, 0, Vec3::Constant(0.1));
  Worst lift;
  const auto steps = std::lround(1.5 / h);
  const ContactRun run = simulate_contacts(scene, method, h, steps, [&](const State& now, const Workspace&) {
    lift.add(now.x(2, 1) - scene.initial.x(2, 1));
  });
  // The convex law's step begins at the ground and ends at h mu v: the cube takes off.
  answers.add("lift", "cube of 0.1 m, 6 m/s", method, h, lift.value(), 0, lift.value(), run,
              method.friction != "cone");
}

/// A ring flat on the ground spins slower by h mu g/r in each step.
void spin_down(KnownAnswers& answers, const Method& method, double h) {
  constexpr double friction = 0.2, radius = 0.1, spin = 10, thickness = 0.05;
  constexpr std::int64_t steps = 20;
  BodyScene build({.friction = friction});
  build.ground();
  build.cylinder(radius, thickness, 1, {.position = Vec3(0, 0, thickness / 2), .spin = Vec3(0, 0, spin)});
  Scene scene = build.finish();
  const double across = radius * radius / 2 + thickness * thickness / 12;  // m^2, all its mass on the rim
  scene.bodies[1].inertia = Vec3(across, across, radius * radius);
  const ContactRun run = simulate_contacts(scene, method, h, steps);
  const double exact = slide(spin, friction * gravity / radius, h, steps).v, left = run.end.spin(2, 1);
  answers.add("spin_down", "ring of 0.1 m, 10 rad/s, friction 0.2", method, h, left, exact,
              relative_difference(left, exact), run);
}

/// Cubes in a row, pushed at one end by `share` of the friction under all of them.
void push_row(KnownAnswers& answers, const Method& method, double h, double share) {
  constexpr int count = 3;
  constexpr double friction = 0.3, mass = 4, size = 0.2, limit = count * friction * mass * gravity;
  constexpr std::int64_t steps = 20;
  BodyScene build({.friction = friction});
  build.materials(2, {.friction = friction});
  build.law(1, 1, {.friction = 0});
  build.ground();
  for (int k = 0; k < count; ++k) build.box(Vec3::Constant(size), mass, {Vec3(k * size, 0, size / 2)}, 1);
  Scene scene = build.finish();
  scene.effects.emplace_back(ExternalForce{{1}, {Vec3(share * limit, 0, 0)}});
  const ContactRun run = simulate_contacts(scene, method, h, steps);
  const double force = std::max(0.0, (share - 1) * limit);
  const double exact = slide(0, -force / (count * mass), h, steps).x;
  const double moved = run.end.x(0, count) - scene.initial.x(0, count);
  answers.add("pushed_row", fmt::format("{} cubes, {:g} of their friction", count, share), method, h, moved,
              exact, std::abs(moved - exact), run);
}

}  // namespace

void stopping(Context& context) {
  const auto relaxations = general_solver_names();
  const std::vector<double> steps = context.full() ? std::vector{1.0 / 60, 0.01, 0.003, 0.001, 3e-4, 1e-4}
                                                   : std::vector{1.0 / 60, 0.01, 0.001};
  KnownAnswers answers(
      context, "stopping",
      {{"distance", "a sliding box stops where implicit Euler's recurrence says", "m", 1e-9},
       {"offset", "that is h v0/2 before where it stops in continuous time", "a h^2/8", 1 + 1e-3},
       {"rolling_speed", "bodies slip to the speed they roll at", "relative", 1e-9},
       {"rolling_way", "they slip as far as implicit Euler's recurrence says", "m", 1e-9},
       {"lift", "a cube that slides does not take off", "m", 1e-10},
       {"spin_down", "friction on its rim slows a spinning ring", "relative", 1e-9},
       {"pushed_row", "a row of cubes moves once the push exceeds the friction under all of them", "m",
        1e-9}});
  context.begin(std::ssize(relaxations) * std::ssize(steps));
  for (const auto relaxation : relaxations)
    for (const double h : steps) {
      for (const auto law : friction_names) {
        const Method method = contact_method(relaxation, law);
        launch(answers, method, h);
        if (law != "cone") stop(answers, method, h);
      }
      const Method method = contact_method(relaxation);
      roll(answers, method, h, Round::ball, 0.4, "ball");
      roll(answers, method, h, Round::cylinder, 0.5, "cylinder");
      roll(answers, method, h, Round::hoop, 1, "hoop");
      const Method patient = patient_method(relaxation);
      spin_down(answers, patient, h);
      for (const double share : {0.99, 1.5}) push_row(answers, patient, h, share);
      context.advance(fmt::format("{} {:.3g} s", relaxation, h));
    }
  answers.close();
}

}  // namespace pbdcheck
