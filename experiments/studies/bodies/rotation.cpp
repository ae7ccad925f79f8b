// What do the integrators and the two forms of the gyroscopic torque make of rotating bodies? Orders against
// the judge on a free body and a heavy top; energy and momentum of a free body over time; the period of a
// body that tumbles about its middle axis (Dzhanibekov).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "closed_form_bodies.h"
#include "harness/integrator_rules.h"
#include "harness/measure.h"
#include "harness/order_study.h"
#include "harness/probes.h"
#include "scenes/mechanisms.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

const Vec3 moments(1, 2, 3);  // kg m^2

std::vector<Motion> rotations() {
  // Steady precession would hide the tilt's errors: the top starts a tenth too fast about its foot.
  const double tilt = std::numbers::pi / 6;
  const double slow = reference::steady_precession({0.0125, 0.005, 9.81 * 0.1}, tilt, 100).slow;
  return {{"free body", free_body(moments, Vec3(1, 1, 1)), 2, 64},
          {.name = "free body, explicit torque",
           .scene = free_body(moments, Vec3(1, 1, 1), false),
           .duration = 2,
           .coarsest_steps = 64,
           .highest_order = 1,
           .shown_elsewhere = "symplectic_euler"},  // takes forces where a step begins in any case
          {"heavy top on a spring", heavy_top(tilt, 100, 1.1 * slow, 1e-4), 0.25, 1000},
          {"heavy top", heavy_top(tilt, 100, 1.1 * slow), 0.25, 500, true}};
}

Vec3 momentum_of(const State& state) {
  return state.orientation[0] * moments.cwiseProduct(Vec3(state.spin.col(0)));
}

double energy_of(const Vec3& spin) {
  return spin.dot(moments.cwiseProduct(spin)) / 2;
}

/// Energy and angular momentum of a tumbling body over time, and what of the energy the scheme's identity
/// does not explain: implicit Euler loses 1/2 dw . I dw a step by the implicit torque, and gains it by the
/// explicit one; midpoint keeps it.
void watch(Context& context) {
  const double h = 0.02, duration = context.full() ? 100 : 20;
  const int steps = static_cast<int>(std::lround(duration / h)), shown = 50;
  Table table = context.table(
      "series", {"torque", "integrator", "alpha", "outer", "relaxation", "step_s", "time_s", "energy_change",
                 "momentum_change", "momentum_length_change", "status", "reason"});
  Worst explained, kept;
  for (const bool implicit : {true, false}) {
    const Scene scene = free_body(moments, Vec3(0.1, 2, 0.1), implicit);
    const double energy = energy_of(scene.initial.spin.col(0));
    const Vec3 momentum = momentum_of(scene.initial);
    for (const Rule& rule : integrator_rules({0.5, 0.55})) {
      int done = 0;
      double expected = 0;
      const auto run =
          simulate_steps(scene, rule.method, h, steps, [&](const State& before, const State& after) {
            const Vec3 change = after.spin.col(0) - before.spin.col(0);
            expected += (implicit ? -1 : 1) * energy_of(change);
            const double now = energy_of(after.spin.col(0));
            const Vec3 turned = momentum_of(after);
            if (rule.method.integrator == "implicit_euler")
              explained.add(std::abs(now - energy - expected) / energy);
            if (rule.method.integrator == "midpoint" && implicit) {
              kept.add(std::abs(now / energy - 1));
              kept.add(std::abs(turned.norm() / momentum.norm() - 1));
            }
            if (++done % (steps / shown) == 0) {
              std::vector<Cell> row{std::string(implicit ? "implicit" : "explicit")};
              for (auto& cell : method_cells(rule)) row.push_back(std::move(cell));
              row.insert(row.end(),
                         {h, after.time, now / energy - 1, (turned - momentum).norm() / momentum.norm(),
                          turned.norm() / momentum.norm() - 1, std::string("ok"), std::string()});
              table.row(row);
            }
            return now < 1e3 * energy ? "" : "energy grew a thousandfold";
          });
      if (run.status == Status::ok) continue;
      std::vector<Cell> row{std::string(implicit ? "implicit" : "explicit")};
      for (auto& cell : method_cells(rule)) row.push_back(std::move(cell));
      const double nan = std::nan("");
      row.insert(row.end(), {h, run.steps * h, nan, nan, nan, status_cell(run.status), run.reason});
      table.row(row);
    }
  }
  table.close();
  context.verdict(Basis::theory, "rotation.energy",
                  "implicit Euler loses 1/2 dw . I dw a step, with the explicit torque gains it",
                  "unexplained share of the energy", explained.value(), 1e-10);
  context.verdict(Basis::theory, "rotation.midpoint",
                  "midpoint keeps energy and the length of the angular momentum", "largest relative change",
                  kept.value(), 1e-10);
}

/// Four times the time of the first passage of w_2 through zero, by Hermite's cubic between steps: the body
/// starts where w_3 is zero, a quarter before it. Later passages ask how near the body comes to its middle
/// axis again, which errors of the square of the disturbance decide.
double measured_period(const Vec3& spin, const Rule& rule, double h, double duration, Simulation& run) {
  double passage = std::nan("");
  const auto rate = [](const Vec3& w) { return (moments[2] - moments[0]) * w[2] * w[0] / moments[1]; };
  const Scene scene = free_body(moments, spin);
  run = simulate_steps(scene, rule.method, h, static_cast<int>(duration / h),
                       [&](const State& before, const State& after) {
                         const Vec3 a = before.spin.col(0), b = after.spin.col(0);
                         if (std::isnan(passage) && a[1] * b[1] < 0) {
                           double low = 0, high = 1;
                           const auto at = [&](double t) {
                             const double u = 1 - t;
                             return a[1] * u * u * (1 + 2 * t) + h * rate(a) * t * u * u +
                                    b[1] * t * t * (3 - 2 * t) - h * rate(b) * t * t * u;
                           };
                           for (int k = 0; k < 60; ++k) {
                             const double middle = (low + high) / 2;
                             (at(middle) * a[1] > 0 ? low : high) = middle;
                           }
                           passage = before.time + low * h;
                         }
                         return "";
                       });
  return 4 * passage;
}

/// Periods at two steps and what Richardson makes of them, against elliptic integrals. Roache's safety factor
/// of 1.25 on the estimate of the finer error is the bound.
void tumble(Context& context) {
  Table table = context.table("tumbling", {"disturbance_rad_s", "integrator", "alpha", "outer", "relaxation",
                                           "step_s", "period_s", "exact_s", "error", "status", "reason"});
  Worst share;
  for (const double disturbance : {1e-2, 1e-3, 1e-6}) {
    const Vec3 spin(disturbance, 1, 0);
    const double exact = reference::free_body_period(moments, spin);
    for (const Rule& rule : integrator_rules({0.5})) {
      if (rule.order < 2) continue;
      double coarser = std::nan("");
      const double first = context.full() ? 0.01 : 0.04;
      for (const double h : {first, first / 2}) {
        Simulation run;
        const double period = measured_period(spin, rule, h, 0.3 * exact, run);
        std::vector<Cell> row{disturbance};
        for (auto& cell : method_cells(rule)) row.push_back(std::move(cell));
        row.insert(row.end(),
                   {h, period, exact, std::abs(period / exact - 1), status_cell(run.status), run.reason});
        table.row(row);
        if (h < first) {
          constexpr double safety = 1.25;
          share.add(std::abs(period - exact) / (safety * std::abs(period - coarser) / 3));
        }
        coarser = period;
      }
    }
  }
  table.close();
  context.verdict(Basis::theory, "rotation.tumbling",
                  "the period of tumbling is within the error that two steps let expect",
                  "error over 1.25 |T(h) - T(2h)| / 3", share.value(), 1);
}

}  // namespace

void rotation(Context& context) {
  auto scenes = rotations();
  context.begin(std::ssize(scenes) + 2);
  study_orders(context, "rotation", std::move(scenes), {0.5, 0.55});
  watch(context);
  context.advance("a tumbling body over time");
  tumble(context);
  context.advance("periods of tumbling");
}

}  // namespace pbdcheck
