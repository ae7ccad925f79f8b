// Do bodies bounce as high and push each other as they should? A bouncing ball's heights, energy and time of
// coming to rest; impacts one after the other, of balls on each other and in Newton's cradle; a ball that
// strikes the ground at an angle.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "linear/linear_names.h"
#include "scenes/contacts.h"
#include "studies/contact/contact_answers.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double radius = 0.1;

/// The trapezoidal rule keeps the energy of free flight.
Method method_of(std::string_view relaxation) {
  Method method = contact_method(relaxation);
  method.integrator = "newmark";
  method.alpha = 0.5;
  return method;
}

Eigen::Quaterniond upright() {
  return Eigen::Quaterniond::Identity();
}

void bounce(KnownAnswers& answers, Table& heights, const Method& method, double h, double restitution) {
  constexpr double height = 1;
  BodyScene build({.friction = 0, .restitution = restitution});
  build.ground();
  build.ball(radius, 1, {Vec3(0, 0, radius + height)});
  const double slowest = 20 * gravity * h;  // later bounces are as short as some steps
  const double impact = std::sqrt(2 * height / gravity);
  const double rest = restitution < 1 ? impact * (1 + restitution) / (1 - restitution) : 5;  // s
  // In flight z + v^2/(2 g) is the height a flight reaches. A step that turns the speed may begin v h above
  // the ground and end (1 - e) v h/2 below: |H_n - e^2 H_n-1| <= (1 - e^2) v h.
  double expected = height, allowed = 0, before = -1, last_moving = 0;
  Worst worst, energy;
  int bounces = 0;
  const std::string name = fmt::format("ball dropped from 1 m, restitution {:g}", restitution);
  const ContactRun run = simulate_contacts(
      build.finish(), method, h, std::lround(1.25 * rest / h), [&](const State& now, const Workspace&) {
        const double v = now.v(2, 1);
        const double reached = now.x(2, 1) - radius + v * v / (2 * gravity);
        energy.add(std::abs(reached / height - 1));
        if (before < 0 && v > slowest) {
          const double square = restitution * restitution;
          allowed = square * allowed + (1 - square) * std::sqrt(2 * gravity * (expected + allowed)) * h;
          expected *= square;
          ++bounces;
          if (restitution < 1) {
            worst.add(std::abs(reached - expected) / allowed);
            if (bounces <= 8)
              heights.row({method.relaxation, h, restitution, std::int64_t{bounces}, reached, expected,
                           allowed, std::string("ok"), std::string()});
          }
        }
        if (std::abs(v) > gravity * h) last_moving = now.time;
        before = v;
      });
  if (restitution < 1) {
    const auto bounces_above = [&](double speed) {
      return std::log(speed / std::sqrt(2 * gravity * height)) / std::log(restitution);
    };
    answers.add("heights", name, method, h, worst.value(), 0,
                bounces + 1 > bounces_above(slowest) ? worst.value() : std::nan(""), run);
    // Each of n bounces is late or early by at most two steps.
    answers.add("rest_time", name, method, h, last_moving, rest,
                std::abs(last_moving - rest) / (2 * h * (bounces_above(gravity * h) + 1)), run);
  } else {
    answers.add("energy", name, method, h, energy.value(), 0, energy.value(), run);
  }
}

/// Without gravity, the impacts' order is all that counts.
void stacked(KnownAnswers& answers, const Method& method, double ratio) {
  constexpr double speed = 1, gap = 0.05, h = 0.01;
  BodyScene build({.friction = 0, .restitution = 1}, 0);
  build.ground();
  build.ball(radius, ratio, {Vec3(0, 0, radius + gap), upright(), Vec3(0, 0, -speed)});
  build.ball(radius, 1, {Vec3(0, 0, 3 * radius + 2 * gap), upright(), Vec3(0, 0, -speed)});
  const ContactRun run = simulate_contacts(build.finish(), method, h, 40);
  const double found = std::pow(run.end.v(2, 2) / speed, 2),
               exact = std::pow((3 * ratio - 1) / (ratio + 1), 2);
  answers.add("stacked", fmt::format("two balls, masses {:g}:1", ratio), method, h, found, exact,
              relative_difference(found, exact), run);
}

void cradle(KnownAnswers& answers, const Method& method, int moving, double gap) {
  constexpr double speed = 1, h = 0.01;
  constexpr int count = 5;
  BodyScene build({.friction = 0, .restitution = 1}, 0);
  for (int k = 0; k < count; ++k)
    build.ball(radius, 1,
               {Vec3(k * (2 * radius + gap), 0, 0), upright(), Vec3(k < moving ? speed : 0, 0, 0)});
  const ContactRun run = simulate_contacts(build.finish(), method, h, 200);
  Worst worst;
  for (int k = 0; k < count; ++k)
    worst.add(std::abs(run.end.v(0, k) - (k >= count - moving ? speed : 0)) / speed);
  answers.add("cradle", fmt::format("{} in of five balls, gaps of {:g} m", moving, gap), method, h,
              worst.value(), 0, worst.value(), run, gap > 0);
}

void oblique(KnownAnswers& answers, const Method& method, double friction) {
  constexpr double e = 0.5, h = 0.01;
  BodyScene build({.friction = friction, .restitution = e}, 0);
  build.ground();
  build.ball(radius, 1, {Vec3(0, 0, radius + 0.05), upright(), Vec3(1, 0, -1)});
  const ContactRun run = simulate_contacts(build.finish(), method, h, 20);
  // It sticks where friction can take 2/7 of the speed, from 2/7/(1 + e) on.
  const double lost = std::min(friction * (1 + e), 2.0 / 7);
  const Vec3 exact(1 - lost, e, 2.5 * lost);
  const Vec3 found(run.end.v(0, 1), run.end.v(2, 1), radius * run.end.spin(1, 1));
  answers.add("oblique", fmt::format("ball at 45 degrees, friction {:g}", friction), method, h, found.x(),
              exact.x(), (found - exact).cwiseAbs().maxCoeff(), run);
}

}  // namespace

void restitution(Context& context) {
  const auto relaxations = general_solver_names();
  KnownAnswers answers(
      context, "restitution",
      {{"heights", "a ball's n-th bounce rises to e^2n", "of what a step allows", 1 + 1e-6},
       {"rest_time", "it comes to rest when the sum of its bounces is over", "2 h (bounces + 1)", 1},
       {"energy", "without loss its energy stays", "relative", 1e-10},
       {"stacked", "of two balls the upper rises to ((3M - m)/(M + m))^2", "relative", 1e-9},
       {"cradle", "as many balls leave Newton's cradle as strike it", "of the speed", 1e-9},
       {"oblique", "a ball that strikes at an angle slides or sticks by Coulomb's law", "m/s", 1e-9}});
  Table heights = context.table("heights", {"relaxation", "step_s", "restitution", "bounce", "height_m",
                                            "expected_m", "allowed_m", "status", "reason"});
  context.begin(std::ssize(relaxations));
  for (const auto relaxation : relaxations) {
    const Method method = method_of(relaxation);
    for (const double h : context.full() ? std::vector{0.004, 0.002, 0.001, 5e-4} : std::vector{0.004, 0.001})
      for (const double e : {0.5, 0.8, 1.0}) bounce(answers, heights, method, h, e);
    for (const double ratio : {2.0, 10.0, 100.0, 1e4}) stacked(answers, method, ratio);
    for (const int moving : {1, 2, 3}) cradle(answers, method, moving, 0.03);
    cradle(answers, method, 1, 0);
    for (const double friction : {0.1, 0.19, 0.191, 0.5}) oblique(answers, method, friction);
    context.advance(relaxation);
  }
  heights.close();
  answers.close();
}

}  // namespace pbdcheck
