// Hanging chains of hard links: catenaries at rest, frequencies.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "closed_form.h"
#include "dense.h"
#include "ledger/families.h"
#include "ledger/motion.h"
#include "scenes/standard.h"

namespace pbdcheck::ledger {
namespace {

using namespace pbd;

// ---- at rest between two supports

/// Chains that come to rest from a corner: more iterations, and a tolerance that rounding does not reach.
Method patient_direct() {
  Method method = direct_method();
  method.tolerance = 1e-11;
  method.max_outer = 1000;
  return method;
}

struct Slack {
  double sag;                      // m
  double horizontal, end_tension;  // over the chain's weight per length, m
};

/// A chain of `links` links over a span of 1 m, let go as two straight halves.
Slack hung_chain(const Method& method, double length, int links) {
  Scene scene;
  const double half = length / 2, depth = std::sqrt(half * half - 0.25), link = length / links;
  for (int i = 0; i <= links; ++i) {
    const double along = static_cast<double>(i) / links;
    const double low = depth * (1 - std::abs(2 * along - 1));
    add_node(scene, Vec3(along, 0, -low), i == 0 || i == links ? infinity : link);
  }
  add_links(scene, link);
  Motion motion(scene, method);
  constexpr double h = 0.3;  // s: the lowest modes, about 4 rad/s, lose a third a step
  calm(motion, 0.01, h);
  const State rest = equilibrium(motion, h);
  const double tension = -motion.workspace.forces(1)[0];  // of the first link, at its middle
  const Vec3 along = (rest.x.col(1) - rest.x.col(0)) / link;
  const double horizontal = tension * along.x() / gravity;  // 1 kg/m
  return {-rest.x.row(2).minCoeff(), horizontal,
          std::hypot(horizontal, -tension * along.z() / gravity + link / 2)};
}

void discrete_rows(Ledger& rows) {
  for (const int links : {10, 20, 40, 80}) {
    const LedgerRow row{
        .source = "dowell1971modified",
        .scene = fmt::format("chain of {} links of {:g} m over a span of 1 m", links, 1.5 / links),
        .method = patient_direct(),
        .bound = {.relative = 1e-9, .derivation = "exact for the chain but for the tolerance"}};
    LedgerRow sag = row, share = row;
    sag.id = fmt::format("chain.discrete_sag_{}", links);
    sag.statement = "a chain of links hangs as the polygon in equilibrium";
    sag.quantity = "sag";
    sag.unit = "m";
    sag.formula = "links along (H, V_i), V_i linear in i";
    sag.expected = [links] { return reference::discrete_catenary(1, 1.5, links).sag; };
    sag.run = [links](const Method& method) { return hung_chain(method, 1.5, links).sag; };
    share.id = fmt::format("chain.discrete_pull_{}", links);
    share.statement = "and pulls its supports together as that";
    share.quantity = "horizontal tension over the weight";
    share.unit = "1";
    share.formula = sag.formula;
    share.expected = [links] { return reference::discrete_catenary(1, 1.5, links).horizontal_share; };
    share.run = [links](const Method& method) { return hung_chain(method, 1.5, links).horizontal / 1.5; };
    rows.push_back(std::move(sag));
    rows.push_back(std::move(share));
  }
}

void catenary_rows(Ledger& rows) {
  constexpr int links = 20;
  struct Part {
    const char *id, *quantity, *formula;
    double (*exact)(const reference::Catenary&);
    double Slack::*measured;
  };
  const Part parts[]{{"sag", "sag", "a (cosh(s/(2 a)) - 1)",
                      [](const reference::Catenary& c) { return c.sag; }, &Slack::sag},
                     {"parameter", "horizontal tension over weight per length", "2 a sinh(s/(2 a)) = length",
                      [](const reference::Catenary& c) { return c.parameter; }, &Slack::horizontal},
                     {"tension", "end tension over weight per length", "a cosh(s/(2 a))",
                      [](const reference::Catenary& c) { return c.end_tension; }, &Slack::end_tension}};
  for (const double length : {1.2, 1.5, 2.0})
    for (const Part& part : parts)
      rows.push_back({.id = fmt::format("chain.catenary_{}_{:g}", part.id, length),
                      .statement = "chains of ever more links approach the catenary",
                      .quantity = part.quantity,
                      .unit = "m",
                      .formula = part.formula,
                      .scene = fmt::format("chains of 20 and 40 links, {:g} m, span 1 m", length),
                      .method = patient_direct(),
                      .bound = {.absolute = length / std::pow(links, 4),
                                .derivation = "order 2 in the link, 20 and 40 extrapolated: length/20^4"},
                      .expected = [=] { return part.exact(reference::catenary(1, length)); },
                      .run =
                          [=](const Method& method) {
                            return extrapolated(
                                [&](double link) {
                                  const auto count = static_cast<int>(std::lround(length / link));
                                  return hung_chain(method, length, count).*part.measured;
                                },
                                length / links, 2);
                          }});
}

// ---- small swings of a chain that hangs from its end

/// Stiffness and inertia of small angles of `links` links of 1/links m under the masses (kg) at their ends.
struct SmallAngles {
  Eigen::MatrixXd stiffness, inertia;
};
SmallAngles small_angles(const std::vector<double>& mass) {
  const auto n = static_cast<Eigen::Index>(mass.size());
  const double link = 1.0 / static_cast<double>(n);
  SmallAngles found{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      for (Eigen::Index k = std::max(i, j); k < n; ++k) {
        const double own = mass[static_cast<std::size_t>(k)];
        found.inertia(i, j) += own * link * link;
        if (i == j) found.stiffness(i, i) += own * gravity * link;
      }
  return found;
}

/// Frequency (Hz) of a mode that the chain is let go in, its largest angle 1e-4 rad.
double chain_frequency(const Method& method, int links, double tip_ratio, int mode) {
  constexpr double amplitude = 1e-4;
  std::vector<double> mass(static_cast<std::size_t>(links), 0.1);
  mass.back() *= tip_ratio;
  const SmallAngles small = small_angles(mass);
  Eigen::VectorXd angle = reference::generalised_eigen(small.stiffness, small.inertia).vectors.col(mode - 1);
  angle *= amplitude / angle.cwiseAbs().maxCoeff();
  Scene scene = chain(links, tip_ratio);
  for (int i = 1; i <= links; ++i)
    scene.initial.x.col(i) =
        scene.initial.x.col(i - 1) + Vec3(std::sin(angle[i - 1]), 0, -std::cos(angle[i - 1])) / links;
  constexpr double h = 0.02;
  return slowest_frequency(scene, method, h, 2, [links](const State& state) { return state.x(0, links); });
}

void swing_rows(Ledger& rows) {
  constexpr int links = 40;
  constexpr double zeros[]{2.404825557695773, 5.520078110286311, 8.653727912911013};  // of J0
  for (const int mode : {1, 2, 3}) {
    const double per_link = zeros[mode - 1] / links;
    rows.push_back({.id = fmt::format("chain.mode_{}", mode),
                    .statement = "chains of ever more links swing as the hanging chain",
                    .quantity = fmt::format("frequency of mode {}", mode),
                    .unit = "Hz",
                    .formula = "j_0n/2 sqrt(g/l)/(2 pi)",
                    .scene = "chains of 40 and 80 links, 1 m, in the mode's shape, 1e-4 rad, h = 0.02 s",
                    .method = direct_method(),
                    .bound = {.relative = std::pow(per_link, 4),
                              .derivation = "order 2 in the link, 40 and 80 extrapolated: (j_0n/40)^4"},
                    .expected = [mode] { return reference::hanging_chain_frequency(mode, 1, gravity); },
                    .run =
                        [mode](const Method& method) {
                          return extrapolated(
                              [&](double link) {
                                return chain_frequency(method, static_cast<int>(std::lround(1 / link)), 0.5,
                                                       mode);
                              },
                              1.0 / links, 2);
                        }});
  }
}

}  // namespace

void chains(Ledger& rows) {
  discrete_rows(rows);
  catenary_rows(rows);
  swing_rows(rows);
}

}  // namespace pbdcheck::ledger
