// Tops on a fixed point.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "closed_form_bodies.h"
#include "ledger/families.h"
#include "ledger/motion.h"
#include "scenes/mechanisms.h"

namespace pbdcheck::ledger {
namespace {

using namespace pbd;
using std::numbers::pi;

const reference::HeavyTop top{0.0125, 0.005, 9.81 * 0.1};

Vec3 axis_after(const Scene& scene, const Method& method, double h, double time) {
  return state_after(scene, method, h, std::lround(time / h)).orientation[1] * Vec3::UnitZ();
}

void precession_rows(Ledger& rows) {
  constexpr double h = 1e-4, tilt = pi / 6, time = 0.03;
  for (const double spin : {100.0, 200.0})
    for (const bool slow : {true, false}) {
      const auto exact = [=] {
        const auto found = reference::steady_precession(top, tilt, spin);
        return slow ? found.slow : found.fast;
      };
      rows.push_back(
          {.id = fmt::format("top.{}_{:g}", slow ? "slow" : "fast", spin),
           .statement = "a heavy top precesses steadily where its torques balance",
           .quantity = "rate of precession",
           .unit = "rad/s",
           .formula = "I1 cos(tilt) W^2 - I3 w3 W + m g l = 0",
           .source = "landau1976mechanics",
           .scene = fmt::format("disc of 1 kg on a point, 30 degrees from upright, {:g} rad/s", spin),
           .method = direct_method("bdf2"),
           .bound = {.absolute = std::pow(spin * h, 3) / time,
                     .derivation = "order 2, h = 1e-4 s and h/2 extrapolated: (w h)^3 over 0.03 s"},
           .expected = exact,
           .run = [=](const Method& method) {
             const Scene scene = heavy_top(tilt, spin, exact());
             const Vec3 before = scene.initial.orientation[1] * Vec3::UnitZ();
             return extrapolated(
                 [&](double step) {
                   return turning_rate(Vec3::UnitZ(), before, axis_after(scene, method, step, time), time);
                 },
                 h, 2);
           }});
    }
}

void sleeping_row(Ledger& rows) {
  constexpr double h = 1e-3, spin = 40, first = 1.5, last = 2.5;
  const double half = top.along * spin / (2 * top.across);
  rows.push_back({.id = "top.waking",
                  .statement = "below 2 sqrt(I1 m g l)/I3 = 44.3 rad/s an upright top wakes",
                  .quantity = "growth of its tilt",
                  .unit = "1/s",
                  .formula = "sqrt(m g l/I1 - (I3 w3/(2 I1))^2)",
                  .source = "landau1976mechanics",
                  .scene = "disc of 1 kg on a point, 1e-7 rad from upright, 40 rad/s; from 1.5 to 2.5 s",
                  .method = direct_method("bdf2"),
                  .bound = {.absolute = std::pow(spin * h, 3),
                            .derivation = "order 2, h = 0.001 s and h/2 extrapolated: (w h)^3; decaying part "
                                          "1e-5, tilt squared 1e-6"},
                  .expected = [half] { return std::sqrt(top.weight_moment / top.across - half * half); },
                  .run =
                      [](const Method& method) {
                        const Scene scene = heavy_top(1e-7, spin, 0);
                        return extrapolated(
                            [&](double step) {
                              const auto tilt = [&](double time) {
                                return axis_after(scene, method, step, time).head<2>().norm();
                              };
                              return std::log(tilt(last) / tilt(first)) / (last - first);
                            },
                            h, 2);
                      }});
}

}  // namespace

void tops(Ledger& rows) {
  precession_rows(rows);
  sleeping_row(rows);
}

}  // namespace pbdcheck::ledger
