// Large deflection and buckling of rods: chains of rigid links with springs in their hinges, which approach
// the elastica with the square of the link.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "closed_form_solids.h"
#include "ledger/families.h"
#include "ledger/motion.h"

namespace pbdcheck::ledger {
namespace {

using namespace pbd;
using std::numbers::pi;

/// Chains of links under load leave residuals of 1e-11.
Method chain_method() {
  Method method = direct_method();
  method.tolerance = 1e-10;
  return method;
}

/// What a rod of links is made with; equilibria do not depend on masses and inertia.
struct RodKind {
  int links;
  double inertia;   // kg m^2, of a link
  double tip_mass;  // kg
  bool pinned = false;
  double angle = 0;  // rad, from the x axis
};

/// A rod of 1 m, 1 kg and 1 N m^2 along x in the plane z = 0, body 0 the ground, and a node at its tip, the
/// last one. A pinned rod's tip stays on the x axis.
struct Rod {
  Scene scene;
  int tip;
};
Rod make_rod(const RodKind& kind) {
  const int links = kind.links;
  const double link = 1.0 / links;
  Rod rod;
  Scene& scene = rod.scene;
  add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  PointJoint points;
  AxisJoint axes;
  AngleJoint springs;
  const Vec3 along = link * Vec3(std::cos(kind.angle), std::sin(kind.angle), 0);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(kind.angle, Vec3::UnitZ()));
  for (int i = 0; i < links; ++i) {
    const int body = add_body(scene, (i + 0.5) * along, link, Vec3::Constant(kind.inertia), turn);
    points.body.push_back({body - 1, body});
    points.point.push_back({i == 0 ? Vec3(Vec3::Zero()) : Vec3(link / 2, 0, 0), Vec3(-link / 2, 0, 0)});
    points.compliance.push_back(0);
    axes.body.push_back({body - 1, body});
    axes.axis.push_back({Vec3::UnitZ(), Vec3::UnitZ()});
    axes.compliance.push_back(0);
    if (i == 0 && kind.pinned) continue;
    springs.body.push_back({body - 1, body});
    springs.axis.emplace_back(Vec3::UnitZ());
    springs.reference.push_back({Vec3::UnitX(), Vec3::UnitX()});
    springs.rest_angle.push_back(0);
    springs.rate.push_back(0);
    springs.compliance.push_back(i == 0 ? link / 2 : link);
  }
  rod.tip = add_node(scene, links * along, kind.tip_mass);
  Attachment end{{links}, {rod.tip}, {Vec3(link / 2, 0, 0)}, {0}};
  scene.effects = {points, axes, springs, end};
  if (kind.pinned)
    scene.effects.emplace_back(
        LineJoint{{{0, links}}, {{Vec3::Zero(), Vec3(link / 2, 0, 0)}}, {Vec3::UnitX()}, {0}});
  return rod;
}

// ---- bent by a load across its tip, and by a moment

constexpr double bend_h = 1;  // s: the slowest mode, 3.5 rad/s, keeps a quarter a step

Vec3 bent_tip(const Method& method, double load, int links) {
  Rod rod = make_rod({links, 0.01 / links, 0.1});
  rod.scene.effects.emplace_back(ExternalForce{{rod.tip}, {Vec3(0, load, 0)}});
  Motion motion(rod.scene, method);
  calm(motion, 0.02, bend_h);
  return equilibrium(motion, bend_h).x.col(rod.tip);
}

void bent_rows(Ledger& rows) {
  constexpr int links = 20;
  for (const double load : {0.25, 0.5, 1.0, 2.0, 5.0, 10.0})
    for (const bool drops : {true, false}) {
      const LedgerRow row{
          .quantity = drops ? "drop of the tip over the length" : "shortening over the length",
          .unit = "1",
          .source = "landau1976mechanics",
          .method = chain_method()};
      const auto part = [drops](const reference::TipPlace& tip) { return drops ? tip.drop : tip.shortening; };
      const auto measured = [=](const Method& method, int count) {
        const Vec3 tip = bent_tip(method, load, count);
        return drops ? tip.y() : 1 - tip.x();
      };
      LedgerRow chain = row, rod = row;
      const std::string name = fmt::format("{}_{:g}", drops ? "drop" : "shortening", load);
      chain.id = "elastica.links_" + name;
      chain.statement = "a chain of links with springs bends as its equilibrium says";
      chain.formula = "theta_i - theta_i-1 = P l/k sum of cos(theta_j), j >= i";
      chain.scene = fmt::format("20 links with springs, P L^2/(E I) = {:g} across the tip", load);
      chain.bound = {.absolute = 1e-8, .derivation = "exact for the chain but for the tolerance"};
      chain.expected = [=] { return part(reference::elastica_of_links(load, links)); };
      chain.run = [=](const Method& method) { return measured(method, links); };
      rod.id = "elastica." + name;
      rod.statement = "ever shorter links approach the elastica";
      rod.formula = "sqrt(P L^2/(E I)) = K(k) - F(phi, k)";
      rod.scene = fmt::format("20 and 40 links with springs, P L^2/(E I) = {:g} across the tip", load);
      rod.bound = {.absolute = std::max(1.0, load) * std::pow(links, -4),
                   .derivation = "order 2 in the link, 20 and 40 extrapolated: P L^2/(E I) over 20^4"};
      rod.expected = [=] { return part(reference::elastica(load)); };
      rod.run = [=](const Method& method) {
        return extrapolated(
            [&](double link) { return measured(method, static_cast<int>(std::lround(1 / link))); },
            1.0 / links, 2);
      };
      rows.push_back(std::move(chain));
      rows.push_back(std::move(rod));
    }
}

constexpr double rolled_h = 5, rolled_inertia = 0.1;  // s, kg m^2: such links are slow

/// Under a moment of `share` 2 pi E I/L at its end, raised in steps.
double rolled_distance(const Method& method, double share, int links) {
  Rod rod = make_rod({links, rolled_inertia, 0.1});
  const auto moment = [&](double part) {
    return ExternalTorque{{links}, {Vec3(0, 0, 2 * pi * share * part)}};
  };
  rod.scene.effects.emplace_back(moment(0.05));
  Motion motion(rod.scene, method);
  for (int k = 1; k <= 20; ++k) {
    motion.workspace.change(rod.scene.effects.size() - 1, moment(0.05 * k));
    motion.advance(rolled_h, 5);
  }
  motion.advance(rolled_h, 30);
  return motion.state.x.col(rod.tip).norm();
}

void rolled_rows(Ledger& rows) {
  constexpr int links = 20;
  for (const double share : {0.5, 1.0})
    rows.push_back({.id = fmt::format("elastica.rolled_{:g}", share),
                    .statement = share == 1 ? "an end moment of 2 pi E I/L rolls a rod up into a circle"
                                            : "half of it into half a circle",
                    .quantity = "distance of its ends over the length",
                    .unit = "1",
                    .formula = "sin(pi share)/(n sin(pi share/n))",
                    .scene = fmt::format("20 links with springs, M L/(E I) = {:g} pi", 2 * share),
                    .method = chain_method(),
                    .bound = {.absolute = 1e-10 * rolled_h * rolled_h * 2 * pi * share / rolled_inertia,
                              .derivation = "exact for the chain but for the tolerance, 1e-10 of h^2 M/I"},
                    .expected = [=] { return std::sin(pi * share) / (links * std::sin(pi * share / links)); },
                    .run = [=](const Method& method) { return rolled_distance(method, share, links); }});
}

// ---- buckling: a load along the rod under which a small angle grows

/// Whether the tip's way from the axis has grown after 200 steps of 1 s: beyond the load by 1e-4 it grows
/// e-fold in 30 s, below it decays.
bool grows(Rod rod, const Method& method, Effect load, int watched) {
  constexpr int steps = 200;
  rod.scene.effects.emplace_back(std::move(load));
  const double before = std::abs(rod.scene.initial.x(1, watched));
  return std::abs(state_after(rod.scene, method, 1, steps).x(1, watched)) > before;
}

void buckling_rows(Ledger& rows) {
  constexpr int links = 10;
  constexpr double resolution = 1e-4;
  static constexpr RodKind straight{
      .links = links, .inertia = 1.0 / (12 * links * links * links), .tip_mass = 1e-6, .angle = 1e-4};
  const LedgerRow row{.unit = "1",
                      .method = chain_method(),
                      .bound = {.relative = 2 * resolution,
                                .derivation = "bisected to 1e-4; what grows is seen within 200 s"}};
  LedgerRow euler = row, greenhill = row;
  euler.id = "elastica.euler";
  euler.statement = "a clamped rod bends under Euler's load, of links";
  euler.quantity = "least P L^2/(E I) under which an angle of 1e-4 rad grows";
  euler.formula = "4 n^2 sin^2(pi/(4 n)), pi^2/4 in the limit";
  euler.scene = "10 links with springs, clamped and free, a dead load along it";
  euler.expected = [] { return reference::euler_load_of_links(false, links); };
  euler.run = [](const Method& method) {
    const double exact = reference::euler_load_of_links(false, links);
    return exact * threshold(0.9, 1.1, resolution, [&](double share) {
             const Rod rod = make_rod(straight);
             return grows(rod, method, ExternalForce{{rod.tip}, {Vec3(-share * exact, 0, 0)}}, rod.tip);
           });
  };
  greenhill.id = "elastica.greenhill";
  greenhill.statement = "a clamped column bends under its own weight as Greenhill's, of links";
  greenhill.quantity = "least rho A g L^3/(E I) under which an angle of 1e-4 rad grows";
  greenhill.formula = "lowest root of det(K - load G), 9/4 j^2 in the limit";
  greenhill.scene = "10 links with springs, clamped below and free, gravity along it";
  greenhill.expected = [] { return reference::greenhill_load_of_links(links); };
  greenhill.run = [](const Method& method) {
    const double exact = reference::greenhill_load_of_links(links);
    return exact * threshold(0.9, 1.1, resolution, [&](double share) {
             const Rod rod = make_rod(straight);
             return grows(rod, method, Gravity{Vec3(-share * exact, 0, 0)}, rod.tip);
           });
  };
  rows.push_back(std::move(euler));
  rows.push_back(std::move(greenhill));
}

}  // namespace

void elasticas(Ledger& rows) {
  bent_rows(rows);
  rolled_rows(rows);
  buckling_rows(rows);
}

}  // namespace pbdcheck::ledger
