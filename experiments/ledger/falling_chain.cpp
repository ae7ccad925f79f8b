// A chain held at one end, its other end let go beside it: it falls faster than a stone.
#include <cmath>

#include <fmt/format.h>

#include "ledger/families.h"
#include "ledger/motion.h"
#include "numerics.h"
#include "scenes/standard.h"

namespace pbdcheck::ledger {
namespace {

using namespace pbd;

/// 1 m of `links` hard links, an odd number, folded about one that lies across.
Scene folded(int links) {
  const double link = 1.0 / links;
  Scene scene;
  const int half = (links - 1) / 2;
  for (int i = 0; i <= links; ++i) {
    const bool down = i <= half;
    const Vec3 place(down ? 0 : link, 0, -link * (down ? i : links - i));
    add_node(scene, place, i == 0 ? infinity : (i == links ? link / 2 : link));
  }
  add_links(scene, link);
  return scene;
}

constexpr double depth = 0.8;  // m, of the way of 1 m: before the last links whip round

double fall_time(const Method& method, int links) {
  constexpr double h = 2e-4;
  return passage(
      folded(links), method, h, [links](const State& state) { return state.x(2, links) + depth; },
      [links](const State& state) { return state.v(2, links); }, 1);
}

/// y = depth sin^2(s) makes dy/y' smooth: y'^2 = g y (2 - y)/(1 - y).
double exact_time() {
  const auto integrand = [](double s) {
    const double y = depth * std::pow(std::sin(s), 2);
    return 2 * std::sqrt(depth) * std::cos(s) * std::sqrt((1 - y) / (gravity * (2 - y)));
  };
  return reference::integrate(integrand, 0, std::acos(0.0));
}

}  // namespace

void falling_chains(Ledger& rows) {
  constexpr int coarse = 41, fine = 81;
  const double speed = std::sqrt(gravity * depth * (2 - depth) / (1 - depth));
  rows.push_back(
      {.id = "chain.folded",
       .statement = "the free end of a folded chain falls faster than a stone, its energy kept",
       .quantity = "time of its fall by 0.8 m",
       .unit = "s",
       .formula = "integral of dy/y', y'^2 = g y (2 L - y)/(L - y)",
       .scene = "chain of 1 m, 41 and 81 links, h = 2e-4 s",
       .method = direct_method("generalised_alpha"),
       .bound = {.absolute = 1 / (coarse * speed),
                 .derivation =
                     "order 1 in the link, 41 and 81 extrapolated: the time of a link at that speed"},
       .expected = exact_time,
       .run = [](const Method& method) {
         const double first = fall_time(method, coarse), second = fall_time(method, fine);
         return second + (second - first) * coarse / (fine - coarse);
       }});
}

}  // namespace pbdcheck::ledger
