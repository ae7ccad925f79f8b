// Mechanisms of jointed bodies: published benchmarks and a slider-crank.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "ledger/families.h"
#include "ledger/motion.h"
#include "studies/bodies/joints.h"

namespace pbdcheck::ledger {
namespace {

using namespace pbd;

struct Place {
  const char *id, *mechanism;  // the start of its name
  std::size_t component;
  const char *quantity, *unit, *formula, *source;
  double rate;       // rad/s, the largest
  double finer;      // steps than the study's coarsest
  double amplified;  // errors of the energy, where it moves slowest
};

const Mechanism& mechanism(std::string_view name) {
  static const std::vector<Mechanism> known = known_mechanisms(false);
  for (const Mechanism& each : known)
    if (each.name.starts_with(name)) return each;
  throw std::logic_error("no mechanism " + std::string(name));
}

/// Angles without their turns.
double without_turns(double value, std::string_view unit) {
  return unit == "rad" ? std::remainder(value, 2 * std::numbers::pi) : value;
}

/// Loops near a singular place leave residuals of 1e-11.
Method mechanism_method() {
  Method method = direct_method("bdf2");
  method.tolerance = 1e-10;
  return method;
}

void place_row(Ledger& rows, const Place& place) {
  const Mechanism& known = mechanism(place.mechanism);
  const double h = known.duration / (known.coarsest_steps * place.finer);
  const double turns = place.rate * known.duration;
  rows.push_back(
      {.id = fmt::format("mechanism.{}", place.id),
       .statement = "a mechanism moves as the benchmark says",
       .quantity = fmt::format("{} after {:g} s", place.quantity, known.duration),
       .unit = place.unit,
       .formula = place.formula,
       .source = place.source,
       .scene = known.name,
       .method = mechanism_method(),
       .bound = {.absolute = std::pow(place.rate * h, 3) * turns * place.amplified,
                 .derivation = fmt::format("order 2, h = {:.2g} s and h/2 extrapolated: (w h)^3 w t, "
                                           "w = {:g} rad/s, amplified by {:g}",
                                           h, place.rate, place.amplified)},
       .expected = [&known, place] { return without_turns(known.expected[place.component], place.unit); },
       .run =
           [&known, h, place](const Method& method) {
             return extrapolated(
                 [&](double step) {
                   const auto steps = std::lround(known.duration / step);
                   const State end = state_after(known.scene, method, step, steps);
                   return without_turns(known.values(end)[place.component], place.unit);
                 },
                 h, 2);
           }});
}

}  // namespace

void mechanisms(Ledger& rows) {
  const char* four_bars = "theta'' = -(G/I) cos(theta), integrated";
  const char* stated = "stated by the Test Set for IVP Solvers";
  constexpr double top = 7.0 * 7;  // 7 rad/s at the bottom, 1 rad/s at the top: the squares of the rates
  const Place places[]{
      {"four_bars_x", "A02", 0, "x of the first top", "m", four_bars, "gonzalez2006benchmarking", 7, 2, top},
      {"four_bars_y", "A02", 1, "y of the first top", "m", four_bars, "gonzalez2006benchmarking", 7, 2, top},
      {"squeezer_beta", "A03", 0, "beta", "rad", stated, "mazzia2008test", 1000, 2, 1},
      {"squeezer_gamma", "A03", 2, "gamma", "rad", stated, "mazzia2008test", 1000, 2, 1},
      {"squeezer_epsilon", "A03", 6, "epsilon", "rad", stated, "mazzia2008test", 1000, 2, 1},
      {"slider_crank", "slider", 0, "place of the slider", "m", "r cos(w t) + sqrt(l^2 - r^2 sin^2(w t))", "",
       5, 1, 1}};
  for (const Place& place : places) place_row(rows, place);
}

}  // namespace pbdcheck::ledger
