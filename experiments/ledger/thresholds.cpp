// Structures that stand or fall: bricks that overhang, arches, ladders, blocks that tip, and the rod of
// Painleve.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "closed_form_contact.h"
#include "ledger/families.h"
#include "ledger/motion.h"
#include "scenes/arch.h"
#include "scenes/contacts.h"
#include "studies/contact/contact_answers.h"
#include "studies/contact/stack.h"

namespace pbdcheck::ledger {
namespace {

using namespace pbd;

/// Moves by no more than a millionth of a metre in `time`, in steps of 0.01 s.
bool stands(const Scene& scene, const Method& method, double time) {
  constexpr double still = 1e-6;  // m
  Motion motion(scene, method);
  while (motion.state.time < time) {
    motion.advance(contact_h);
    if ((motion.state.x - scene.initial.x).colwise().norm().maxCoeff() > still) return false;
  }
  return true;
}

// What falls grows as cosh(sqrt(g/l) t) from a share of its size: over 1 s, 1e-4 of 0.2 m by a hundredfold.
constexpr double resolution = 1e-4, watched = 1;  // of the threshold; s
const LedgerBound bisected{.relative = 3 * resolution,
                           .derivation = "bisected to 1e-4; what falls is seen within 1 s at 1e-4 beyond"};

void overhang_rows(Ledger& rows) {
  for (const int count : {2, 3, 4, 5})
    rows.push_back({.id = fmt::format("threshold.overhang_{}", count),
                    .statement = "bricks overhang by the harmonic sum",
                    .quantity = "largest overhang over the length",
                    .unit = "1",
                    .formula = "(1 + 1/2 + ... + 1/n)/2",
                    .scene = fmt::format("{} bricks of 0.2 m at the edge of a table", count),
                    .method = contact_method("direct"),
                    .bound = bisected,
                    .expected = [count] { return reference::brick_overhang(count, 1); },
                    .run =
                        [count](const Method& method) {
                          return reference::brick_overhang(count, 1) *
                                 threshold(0.99, 1.01, resolution, [&](double share) {
                                   return !stands(overhang(count, share), method, watched);
                                 });
                        }});
}

void arch_rows(Ledger& rows) {
  for (const int stones : {7, 9, 15})
    rows.push_back(
        {.id = fmt::format("threshold.arch_{}", stones),
         .statement = "a semicircular arch stands while a line of thrust fits into its stones",
         .quantity = "least thickness over the radius",
         .unit = "1",
         .formula = "Heyman's safe theorem for radial cuts",
         .source = "heyman1966stone",
         .scene = fmt::format("arch of {} stones, radius 1 m, friction 1", stones),
         .method = contact_method("direct"),
         .bound = {.relative = 3e-3, .derivation = "bisected to 1e-3; what falls is seen within 1 s"},
         .expected = [stones] { return limit_thickness(stones); },
         .run =
             [stones](const Method& method) {
               const double limit = limit_thickness(stones);
               return limit * threshold(0.98, 1.02, 1e-3, [&](double share) {
                        return stands(Arch{share * limit, stones}.scene(), method, watched);
                      });
             },
         .tier = stones > 9 ? Tier::full : Tier::quick});
}

void tipping_row(Ledger& rows) {
  rows.push_back({.id = "threshold.tipping",
                  .statement = "a block on an incline tips where its weight leaves its base",
                  .quantity = "tangent of the angle",
                  .unit = "1",
                  .formula = "width/height",
                  .scene = "block of 0.05 x 0.1 x 0.2 m, friction 1",
                  .method = contact_method("direct"),
                  .bound = bisected,
                  .expected = [] { return 0.25; },
                  .run =
                      [](const Method& method) {
                        return threshold(0.24, 0.26, 0.25 * resolution, [&](double tangent) {
                          return !stands(sliding_box(std::atan(tangent), 1, 0, 0, Vec3(0.05, 0.1, 0.2)),
                                         method, watched);
                        });
                      }});
}

// ---- a uniform rod of 1 m and 1 kg with a ball of no size at its ends

constexpr double half = 0.5, tip = 1e-7;  // m

/// In the plane y = 0, at `angle` from the floor, with friction on the floor and none on the wall x = 0.
Scene rod(double angle, double friction, bool against_wall, double speed) {
  BodyScene build({.friction = friction});
  build.materials(2, {.friction = friction});
  build.law(0, 1, {.friction = 0});
  build.ground();
  const Eigen::Quaterniond across(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitY()));
  if (against_wall) build.fixed(HalfSpace{}, {Vec3::Zero(), across}, 1);
  // Its own x axis points from the foot on the floor up to the wall.
  const Eigen::Quaterniond leaning(Eigen::AngleAxisd(std::numbers::pi + angle, Vec3::UnitY()));
  const Vec3 up = leaning * Vec3::UnitX();
  const double lift = tip + half * std::abs(up.z());
  const int body =
      build.ball(tip, 1, {Vec3(tip + half * std::abs(up.x()), 0, lift), leaning, Vec3(speed, 0, 0)});
  for (const double end : {-half, half})
    build.contact().collider.push_back({Sphere{tip}, body, {end * Vec3::UnitX()}});
  Scene scene = build.finish();
  scene.bodies.back().inertia = Vec3(1e-3, 1, 1) * (4 * half * half / 12);
  return scene;
}

void ladder_rows(Ledger& rows) {
  for (const double degrees : {60.0, 65.0, 75.0}) {
    const double angle = degrees * std::numbers::pi / 180, least = reference::ladder_friction(angle);
    rows.push_back({.id = fmt::format("threshold.ladder_{:g}", degrees),
                    .statement = "a ladder against a smooth wall stands by the friction of the floor",
                    .quantity = "least friction",
                    .unit = "1",
                    .formula = "1/(2 tan(angle))",
                    .scene = fmt::format("rod of 1 m at {:g} degrees, points at its ends", degrees),
                    .method = contact_method("direct"),
                    .bound = bisected,
                    .expected = [least] { return least; },
                    .run =
                        [=](const Method& method) {
                          return threshold(0.98 * least, 1.02 * least, resolution * least,
                                           [&](double friction) {
                                             return stands(rod(angle, friction, true, 0), method, watched);
                                           });
                        }});
  }
}

void painleve_row(Ledger& rows) {
  constexpr double h = 1e-7, speed = 1;
  const double angle = std::atan(2.0);
  rows.push_back(
      {.id = "threshold.painleve",
       .statement = "a rod that slides on its lower end jams at once from Painleve's friction on",
       .quantity = "least friction that stops it within a step",
       .unit = "1",
       .formula = "(1 + 3 cos^2)/(3 sin cos)",
       .scene = "rod of 1 m at atan(2), at 1 m/s, h = 1e-7 s",
       .method = contact_method("direct"),
       .bound = {.absolute = 1e-4,
                 .derivation = "bisected to 2e-5; beside it the force is g h over the distance from it"},
       .expected = [angle] { return reference::painleve_friction(angle); },
       .run =
           [=](const Method& method) {
             return threshold(1.2, 1.5, 2e-5, [&](double friction) {
               const State end = state_after(rod(angle, friction, false, speed), method, h, 1);
               const Vec3 arm = end.orientation.back() * Vec3(-half, 0, 0);
               const Vec3 spin = end.orientation.back() * Vec3(end.spin.rightCols<1>());
               const Vec3 foot = Vec3(end.v.rightCols<1>()) + spin.cross(arm);
               return std::abs(foot.x()) < speed / 2;
             });
           }});
}

}  // namespace

void thresholds(Ledger& rows) {
  overhang_rows(rows);
  arch_rows(rows);
  tipping_row(rows);
  ladder_rows(rows);
  painleve_row(rows);
}

}  // namespace pbdcheck::ledger
