// Boxes that stick and slide.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "ledger/families.h"
#include "ledger/motion.h"
#include "scenes/contacts.h"
#include "studies/contact/contact_answers.h"

namespace pbdcheck::ledger {
namespace {

using namespace pbd;

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

void incline_rows(Ledger& rows) {
  constexpr double resolution = 1e-6, h = contact_h;
  constexpr int steps = 20;
  for (const double degrees : {10.0, 20.0, 26.5650512, 30.0}) {
    const double angle = radians(degrees), tangent = std::tan(angle);
    // What a shortfall of the friction by half the resolution adds up to.
    const double creep = gravity * std::cos(angle) * resolution / 2 * h * h * steps * (steps + 1) / 2;
    rows.push_back(
        {.id = fmt::format("friction.incline_{:.3g}", degrees),
         .statement = "a box sticks on an incline where friction reaches the tangent",
         .quantity = "least friction",
         .unit = "1",
         .formula = "tan(angle)",
         .scene = fmt::format("box at rest on a plane of {:.9g} degrees, 20 steps of 0.01 s", degrees),
         .method = patient_method("direct"),
         .bound = {.absolute = 2 * resolution, .derivation = "resolution of the bisection and of the way"},
         .expected = [tangent] { return tangent; },
         .run =
             [=](const Method& method) {
               return threshold(0.9 * tangent, 1.1 * tangent, resolution, [&](double friction) {
                 const Scene scene = sliding_box(angle, friction, 0);
                 const State end = state_after(scene, method, h, steps);
                 return (end.x - scene.initial.x).norm() < creep;
               });
             }});
  }
  for (const auto& [degrees, mu] : {std::pair{30, 0.5}, {20, 0.3}, {10, 0.1}}) {
    const double angle = radians(degrees), friction = mu;
    rows.push_back(
        {.id = fmt::format("friction.slide_{}", degrees),
         .statement = "a box slides down an incline as Coulomb says",
         .quantity = "acceleration",
         .unit = "m/s^2",
         .formula = "g (sin(angle) - mu cos(angle))",
         .scene = fmt::format("box on a plane of {} degrees, friction {:g}, 1 s", degrees, friction),
         .method = direct_method(),
         .bound = {.relative = 1e-9, .derivation = "velocities are exact; tolerance"},
         .expected = [=] { return gravity * (std::sin(angle) - friction * std::cos(angle)); },
         .run =
             [=](const Method& method) {
               const Scene scene = sliding_box(angle, friction, 0);
               return state_after(scene, method, contact_h, 100).v.col(1).norm();
             }});
  }
}

void stopping_rows(Ledger& rows) {
  struct Case {
    const char* id;
    double speed, h;
    Vec3 size;
  };
  const Vec3 flat(0.2, 0.2, 0.1);
  for (const Case& c : {Case{"stop_0.01", 5, 0.01, flat}, Case{"stop_0.001", 5, 0.001, flat},
                        Case{"stop_cube", 6, 0.005, Vec3::Constant(0.1)}}) {
    constexpr double friction = 0.5;
    const double a = friction * gravity;
    rows.push_back(
        {.id = fmt::format("friction.{}", c.id),
         .statement = "a sliding box stops half a step's way before where it does in continuous time",
         .quantity = "way to rest",
         .unit = "m",
         .formula = "v^2/(2 mu g) - h v/2",
         .scene = fmt::format("box of {:g} m height at {:g} m/s, friction 0.5, h = {:g} s", c.size.z(),
                              c.speed, c.h),
         .method = direct_method(),
         .bound = {.absolute = a * c.h * c.h / 8 + 1e-9,
                   .derivation = "mu g h^2/8: the last step is cut anywhere"},
         .expected = [=] { return c.speed * c.speed / (2 * a) - c.h * c.speed / 2; },
         .run =
             [=](const Method& method) {
               const auto steps = static_cast<std::int64_t>(c.speed / (a * c.h)) + 10;
               return state_after(sliding_box(0, friction, c.speed, 0, c.size), method, c.h, steps).x(0, 1);
             }});
  }
  rows.push_back({.id = "friction.no_lift",
                  .statement = "a cube that slides and stops stays on the ground",
                  .quantity = "largest height over the ground",
                  .unit = "m",
                  .formula = "0",
                  .scene = "cube of 0.1 m at 6 m/s, friction 0.5, h = 0.005 s",
                  .method = direct_method(),
                  .bound = {.absolute = 1e-10, .derivation = "tolerance of gaps"},
                  .expected = [] { return 0.0; },
                  .run =
                      [](const Method& method) {
                        Motion motion(sliding_box(0, 0.5, 6, 0, Vec3::Constant(0.1)), method);
                        double highest = 0;
                        while (motion.state.time < 1.5) {
                          motion.advance(0.005);
                          highest = std::max(highest, std::abs(motion.state.x(2, 1) - 0.05));
                        }
                        return highest;
                      }});
}

/// Deceleration of a box that slides at 45 degrees to the axes of its contacts' tangents.
double diagonal_deceleration(const Method& method) {
  constexpr int steps = 5;
  const Scene scene = sliding_box(0, 0.3, 2, std::numbers::pi / 4);
  const double end = state_after(scene, method, contact_h, steps).v.col(1).norm();
  return (2 - end) / (steps * contact_h);
}

void law_rows(Ledger& rows) {
  const LedgerRow row{.statement = "friction slows a box by mu g at every heading",
                      .quantity = "deceleration",
                      .unit = "m/s^2",
                      .formula = "mu g",
                      .scene = "box at 2 m/s, 45 degrees from the axes, friction 0.3",
                      .bound = {.relative = 1e-9, .derivation = "velocities are exact; tolerance"},
                      .expected = [] { return 0.3 * gravity; },
                      .run = diagonal_deceleration};
  LedgerRow round = row, square = row;
  round.id = "friction.diagonal";
  round.method = contact_method("direct");
  square.id = "friction.diagonal_box";
  square.method = contact_method("direct", "box");
  square.deviation = {"the law box, which slows each axis by itself: sqrt(2) mu g",
                      [] { return std::numbers::sqrt2 * 0.3 * gravity; }};
  rows.push_back(std::move(round));
  rows.push_back(std::move(square));
  constexpr double angle = 0.4;
  rows.push_back(
      {.id = "friction.convex_gap",
       .statement = "a box that slides steadily stays on the plane",
       .quantity = "gap over its speed",
       .unit = "s",
       .formula = "0",
       .source = "tasora2011matrix",
       .scene = "box at 1 m/s on a plane of 0.4 rad, friction tan(0.4), h = 0.01 s, 1 s",
       .method = contact_method("direct", "cone"),
       .bound = {.absolute = 1e-9, .derivation = "tolerance; the start dies out as (mu^2/(1 + mu^2))^n"},
       .expected = [] { return 0.0; },
       .run =
           [](const Method& method) {
             const Scene scene = sliding_box(angle, std::tan(angle), 1);
             const State end = state_after(scene, method, contact_h, 100);
             const Vec3 normal(std::sin(angle), 0, std::cos(angle));
             return (normal.dot(end.x.col(1)) - 0.05) / end.v.col(1).norm();
           },
       .deviation = Deviation{"the convex law cone, by which what slides hovers: h mu",
                              [] { return contact_h * std::tan(angle); }}});
}

}  // namespace

void sliding(Ledger& rows) {
  incline_rows(rows);
  stopping_rows(rows);
  law_rows(rows);
}

}  // namespace pbdcheck::ledger
