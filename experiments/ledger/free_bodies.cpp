// Bodies that no torque acts on.
#include <cmath>

#include <fmt/format.h>

#include "closed_form_bodies.h"
#include "ledger/families.h"
#include "ledger/motion.h"
#include "scenes/mechanisms.h"

namespace pbdcheck::ledger {
namespace {

using namespace pbd;

const Vec3 moments(1, 2, 3), ones(1, 1, 1);  // kg m^2, rad/s

/// Passages of a component of the angular velocity, its rate by Euler's equations.
double spin_passage(const Vec3& spin, const Method& method, double h, int axis, double latest) {
  return passage(
      free_body(moments, spin), method, h, [axis](const State& state) { return state.spin(axis, 0); },
      [axis](const State& state) {
        const Vec3 w = state.spin.col(0), momentum = moments.cwiseProduct(w);
        return momentum.cross(w)[axis] / moments[axis];
      },
      latest);
}

void kept_rows(Ledger& rows) {
  const LedgerRow row{.source = "landau1976mechanics",
                      .scene = "free body of moments (1, 2, 3) kg m^2 from (1, 1, 1) rad/s, h = 0.01 s, 10 s",
                      .method = direct_method("midpoint"),
                      .bound = {.relative = 1e-10, .derivation = "kept exactly: tolerance of 1e3 steps"}};
  const auto end = [](const Method& method) {
    return Vec3(state_after(free_body(moments, ones), method, 0.01, 1000).spin.col(0));
  };
  LedgerRow energy = row, momentum = row;
  energy.id = "free_body.energy";
  energy.statement = "midpoint keeps a free body's energy";
  energy.quantity = "kinetic energy";
  energy.unit = "J";
  energy.formula = "1/2 sum I w^2";
  energy.expected = [] { return ones.dot(moments.cwiseProduct(ones)) / 2; };
  energy.run = [end](const Method& method) {
    const Vec3 w = end(method);
    return w.dot(moments.cwiseProduct(w)) / 2;
  };
  momentum.id = "free_body.momentum";
  momentum.statement = "and its angular momentum";
  momentum.quantity = "angular momentum";
  momentum.unit = "kg m^2/s";
  momentum.formula = "sqrt(sum I^2 w^2)";
  momentum.expected = [] { return moments.cwiseProduct(ones).norm(); };
  momentum.run = [end](const Method& method) { return moments.cwiseProduct(end(method)).norm(); };
  rows.push_back(std::move(energy));
  rows.push_back(std::move(momentum));
}

void spin_rows(Ledger& rows) {
  constexpr double h = 2e-3;
  const LedgerRow row{.source = "landau1976mechanics",
                      .scene = "free body of moments (1, 2, 3) kg m^2 from (1, 1, 1) rad/s",
                      .method = direct_method("midpoint")};
  LedgerRow period = row;
  period.id = "free_body.period";
  period.statement = "a free body's angular velocity has the period of the elliptic integral";
  period.quantity = "period";
  period.unit = "s";
  period.formula = "4 K/rate";
  period.bound = {
      .relative = std::pow(2 * h, 4),
      .derivation = "order 2, even powers, h = 0.002 s and h/2 extrapolated: (w h)^4, w = 2 rad/s"};
  period.expected = [] { return reference::free_body_period(moments, ones); };
  period.run = [](const Method& method) {
    return 4 * extrapolated(
                   [&](double step) {
                     return spin_passage(ones, method, step, 1, 4) - spin_passage(ones, method, step, 0, 4);
                   },
                   h, 2);
  };
  rows.push_back(std::move(period));
  for (const double time : {1.0, 10.0})
    for (const int axis : {0, 1, 2}) {
      LedgerRow spin = row;
      spin.id = fmt::format("free_body.spin_{}_{:g}", axis + 1, time);
      spin.statement = "a free body turns as Jacobi's functions say";
      spin.quantity = fmt::format("w{} after {:g} s", axis + 1, time);
      spin.unit = "rad/s";
      spin.formula = "(a1 cn, a2 sn, a3 dn)(rate t + phase)";
      spin.bound = {
          .absolute = std::pow(2 * h, 4) * 2 * time * 2,
          .derivation = "order 2, even powers, h = 0.002 s and h/2 extrapolated: (w h)^4 w t w, w = 2 rad/s"};
      spin.expected = [=] { return reference::free_body_spin(moments, ones, time)[axis]; };
      spin.run = [=](const Method& method) {
        return extrapolated(
            [&](double step) {
              return state_after(free_body(moments, ones), method, step, std::lround(time / step))
                  .spin(axis, 0);
            },
            h, 2);
      };
      rows.push_back(std::move(spin));
    }
}

void tumbling_rows(Ledger& rows) {
  constexpr double h = 0.01;
  for (const double off : {1e-2, 1e-3, 1e-6})
    rows.push_back(
        {.id = fmt::format("free_body.tumbling_{:g}", off),
         .statement = "a body about its middle axis flips at the period of the elliptic integral",
         .quantity = "period",
         .unit = "s",
         .formula = "4 K/rate",
         .source = "landau1976mechanics",
         .scene = fmt::format("free body of moments (1, 2, 3) kg m^2 from ({:g}, 1, 0) rad/s", off),
         .method = direct_method("midpoint"),
         .bound = {.relative = std::pow(h, 4),
                   .derivation =
                       "order 2, even powers, h = 0.01 s and h/2 extrapolated: (w h)^4, w = 1 rad/s"},
         .expected = [off] { return reference::free_body_period(moments, Vec3(off, 1, 0)); },
         .run =
             [off](const Method& method) {
               return 4 * extrapolated(
                              [&](double step) { return spin_passage(Vec3(off, 1, 0), method, step, 1, 40); },
                              h, 2);
             }});
}

void symmetric_rows(Ledger& rows) {
  const Vec3 spin(0.5, 0, 10), symmetric(1, 1, 2);
  constexpr double h = 1e-3;
  const LedgerRow row{.unit = "rad/s",
                      .source = "landau1976mechanics",
                      .scene = "free body of moments (1, 1, 2) kg m^2 from (0.5, 0, 10) rad/s",
                      .method = direct_method("midpoint")};
  LedgerRow own = row, space = row;
  own.id = "free_body.body_precession";
  own.statement = "the angular velocity of a symmetric body circles its axis";
  own.quantity = "rate in the body";
  own.formula = "(I3 - I1)/I1 w3";
  own.bound = {.relative = 1e-8,
               .derivation = "midpoint's phase 2 atan(w h/2) undone; tolerance over the phase of a step"};
  own.expected = [=] { return reference::body_precession(1, 2, spin); };
  own.run = [=](const Method& method) {
    const Vec3 after = state_after(free_body(symmetric, spin), method, h, 1).spin.col(0);
    return 2 * std::tan(turning_rate(Vec3::UnitZ(), spin, after, 1) / 2) / h;
  };
  space.id = "free_body.space_precession";
  space.statement = "and its axis circles the angular momentum";
  space.quantity = "rate in space";
  space.formula = "L/I1";
  space.bound = {
      .relative = std::pow(reference::space_precession(1, 2, spin) * h, 4),
      .derivation = "order 2, even powers, h = 0.001 s and h/2 extrapolated: (w h)^4, w = 20 rad/s"};
  space.expected = [=] { return reference::space_precession(1, 2, spin); };
  space.run = [=](const Method& method) {
    constexpr double time = 0.1;
    return extrapolated(
        [&](double step) {
          const State end = state_after(free_body(symmetric, spin), method, step, std::lround(time / step));
          return turning_rate(symmetric.cwiseProduct(spin).normalized(), Vec3::UnitZ(),
                              end.orientation[0] * Vec3::UnitZ(), time);
        },
        h, 2);
  };
  rows.push_back(std::move(own));
  rows.push_back(std::move(space));
}

}  // namespace

void free_bodies(Ledger& rows) {
  kept_rows(rows);
  spin_rows(rows);
  tumbling_rows(rows);
  symmetric_rows(rows);
}

}  // namespace pbdcheck::ledger
