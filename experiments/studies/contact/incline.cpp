// Does a box on a plane stick and slide as Coulomb's law says? Planes of four angles: friction just above and
// just below the tangent, acceleration beside implicit Euler's recurrence, and bodies of very different mass.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "linear/linear_names.h"
#include "scenes/choices.h"
#include "scenes/contacts.h"
#include "studies/contact/contact_answers.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double margin = 1e-6;  // of the friction about the tangent

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

/// m, downhill from the start.
double way(const Scene& scene, const State& end, double angle) {
  return Vec3(std::cos(angle), 0, -std::sin(angle)).dot(end.x.col(1) - scene.initial.x.col(1));
}

/// Way of a box that starts at rest. By the convex law it takes off until it hovers at h mu v: with d_k the
/// growth of the speed in a step, d_k = h a - mu^2 (d_k - d_k-1).
double recurrence(double acceleration, double friction, bool convex, std::int64_t steps) {
  double v = 0, x = 0, growth = 0;
  const double square = convex ? friction * friction : 0;
  for (std::int64_t k = 0; k < steps; ++k) {
    growth = (contact_h * acceleration + square * growth) / (1 + square);
    v += growth;
    x += contact_h * v;
  }
  return x;
}

void stick(KnownAnswers& answers, const Method& method, double degrees) {
  const double angle = radians(degrees), tangent = std::tan(angle);
  const std::string name = fmt::format("{:g} degrees", degrees);
  const auto steps = std::lround(10 / contact_h);
  const Scene rough = sliding_box(angle, tangent * (1 + margin), 0);
  const ContactRun held = simulate_contacts(rough, method, contact_h, steps);
  const double creep = (held.end.x - rough.initial.x).norm() / (static_cast<double>(steps) * contact_h);
  answers.add("creep", name, method, contact_h, creep, 0, creep, held);
  const Scene smooth = sliding_box(angle, tangent * (1 - margin), 0);
  const auto few = std::lround(1 / contact_h);
  const ContactRun slid = simulate_contacts(smooth, method, contact_h, few);
  const double exact =
      recurrence(gravity * std::sin(angle) * margin, tangent, method.friction == "cone", few);
  const double moved = way(smooth, slid.end, angle);
  answers.add("threshold", name, method, contact_h, moved, exact, relative_difference(moved, exact), slid);
}

void accelerate(KnownAnswers& answers, const Method& method, double degrees, double friction) {
  const double angle = radians(degrees);
  const double a = gravity * (std::sin(angle) - friction * std::cos(angle));
  const Scene scene = sliding_box(angle, friction, 0);
  const ContactRun run = simulate_contacts(scene, method, contact_h, 100);
  const double exact = recurrence(a, friction, method.friction == "cone", 100);
  const double moved = way(scene, run.end, angle);
  answers.add("acceleration", fmt::format("{:g} degrees, friction {:g}", degrees, friction), method,
              contact_h, moved, exact, relative_difference(moved, exact), run);
}

void weigh(KnownAnswers& answers, const Method& method, double factor) {
  const double angle = radians(20), friction = 0.3;
  Scene scene = sliding_box(angle, friction, 0);
  scene.mass[1] *= factor;
  scene.bodies[1].inertia *= factor;
  const ContactRun run = simulate_contacts(scene, method, contact_h, 100);
  const double a = gravity * (std::sin(angle) - friction * std::cos(angle));
  const double exact = recurrence(a, friction, method.friction == "cone", 100);
  const double moved = way(scene, run.end, angle);
  answers.add("mass", fmt::format("{:g} kg", scene.mass[1]), method, contact_h, moved, exact,
              relative_difference(moved, exact), run);
}

}  // namespace

void incline(Context& context) {
  const auto relaxations = general_solver_names();
  // A step misses its velocity by about twice the tolerance times g h, and grows it by g h sin(10 deg)
  // margin.
  const double slowest = 2 * contact_method("direct").tolerance / (std::sin(radians(10)) * margin);
  KnownAnswers answers(
      context, "incline",
      {{"creep", "a box sticks where friction exceeds the tangent by a millionth", "m/s", 1e-9},
       {"threshold", "it slides where friction falls short by a millionth", "relative", slowest},
       {"acceleration", "it slides as implicit Euler's recurrence says", "relative", 1e-9},
       {"mass", "it slides so whatever its mass", "relative", 1e-9}});
  context.begin(std::ssize(relaxations) * std::ssize(friction_names));
  for (const auto relaxation : relaxations)
    for (const auto law : friction_names) {
      const Method method = patient_method(relaxation, law);
      for (const double degrees : {10.0, 20.0, 26.5650512, 30.0})
        if (context.full() || degrees == 20 || law == "coulomb") stick(answers, method, degrees);
      accelerate(answers, method, 30, 0.5);
      accelerate(answers, method, 20, 0.3);
      accelerate(answers, method, 10, 0.1);
      for (const double factor : {2.5e-7, 2.5e5}) weigh(answers, method, factor);
      context.advance(fmt::format("{} {}", relaxation, law));
    }
  answers.close();
}

}  // namespace pbdcheck
