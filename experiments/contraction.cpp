// Is the contraction of the plain outer iteration the predicted one, effect by effect? Small bodies of one
// effect each are loaded, so that their geometric stiffness matters: the rate is measured beside the solution
// and compared with the dense spectral radius, the solver's own prediction and its bound for the effect.
#include "contraction.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiments.h"
#include "judges.h"
#include "measure.h"
#include "measured_rate.h"
#include "mesh.h"
#include "scenes/standard.h"

namespace pbdcheck {
namespace {

using namespace pbd;

/// A body of one effect. Loads (N) stretch it where positive; the stiffnesses' unit is the effect's own.
struct Body {
  std::string effect, strain, unit;
  std::vector<double> stiffnesses, loads;
  Scene (*make)(double stiffness);
  Vec3 direction;  // of the load, on the nodes farthest along x
};

Scene links(double stiffness) {
  Scene scene;
  Distance effect;
  for (int i = 0; i <= 3; ++i) {
    add_node(scene, Vec3(i, 0, 0), i == 0 ? infinity : 1);
    if (i == 0) continue;
    effect.node.push_back({i - 1, i});
    effect.rest_length.push_back(1);
    effect.compliance.push_back(1 / stiffness);
  }
  scene.effects = {effect};
  return scene;
}

Scene hinge(double stiffness) {
  Scene scene;
  for (const auto& [x, y, mass] :
       {std::tuple{0.0, 0.0, infinity}, {0.0, 1.0, infinity}, {-1.0, 0.5, infinity}, {1.0, 0.5, 1.0}})
    add_node(scene, Vec3(x, y, 0), mass);
  scene.effects = {Bending{.node = {{0, 1, 2, 3}}, .rest_angle = {0}, .compliance = {1 / stiffness}}};
  return scene;
}

Scene sheet(double young) {
  const TriangleMesh mesh = grid_sheet({2, 1}, {1, 0.5});
  Scene scene;
  const int first = add_sheet_nodes(scene, mesh, 1);
  scene.effects = {sheet_strain(mesh, first, {young, 0.3}, 1e-3)};
  clamp_smallest_x(scene);
  return scene;
}

template <Strain strain>
Scene bar(double young) {
  Scene scene;
  add_solid(scene, kuhn_grid({2, 1, 1}, Vec3(1, 0.5, 0.5)), 1000, {young, 0.3}, strain);
  clamp_smallest_x(scene);
  return scene;
}

Scene held(double stiffness) {
  Scene scene;
  add_node(scene, Vec3::Zero(), 1);
  scene.effects = {Anchor{.node = {0}, .target = {Vec3(-1, 0, 0)}, .compliance = {1 / stiffness}}};
  return scene;
}

/// Three rods of 1 m and 1 kg along x, the first on the ground: balls of this stiffness (N/m; inf: hard), or
/// hard hinges about z whose axes are held with it (N m/rad).
template <bool hinges>
Scene rods(double stiffness) {
  Scene scene;
  add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  PointJoint balls;
  AxisJoint axes;
  const double compliance = 1 / stiffness;
  for (int i = 0; i < 3; ++i) {
    const int rod = add_body(scene, Vec3(i + 0.5, 0, 0), 1, Vec3(0.01, 1.0 / 12, 1.0 / 12));
    balls.body.push_back({rod - 1, rod});
    balls.point.push_back({Vec3(i == 0 ? 0 : 0.5, 0, 0), Vec3(-0.5, 0, 0)});
    balls.compliance.push_back(hinges ? 0 : compliance);
    axes.body.push_back({rod - 1, rod});
    axes.axis.push_back({Vec3::UnitZ(), Vec3::UnitZ()});
    axes.compliance.push_back(compliance);
  }
  scene.effects = {balls};
  if (hinges) scene.effects.emplace_back(axes);
  return scene;
}

std::vector<Body> bodies() {
  const Vec3 along = Vec3::UnitX(), across = Vec3::UnitZ();
  const std::vector<double> solid_young{1e5, 1e6, 1e7}, solid_loads{-500, 2000, 8000, 32000};
  return {{"distance", "", "N/m", {1e3, 1e4, 1e5}, {-50, 50, 250, 1000}, links, along},
          {"bending", "", "N m/rad", {1e2, 1e3, 1e4}, {-50, 200, 800, 2800}, hinge, across},
          {"triangle_strain", "", "Pa", {1e6, 1e7, 1e8}, {-2, 4, 20, 80}, sheet, along},
          {"tet_strain", "green", "Pa", solid_young, solid_loads, bar<Strain::green>, along},
          {"tet_strain", "corotational", "Pa", solid_young, solid_loads, bar<Strain::corotational>, along},
          {"anchor", "", "N/m", {1e3, 1e4, 1e5}, {-50, 50, 250, 1000}, held, along},
          {"point_joint", "", "N/m", {1e4, 1e5, infinity}, {-50, 50, 250, 1000}, rods<false>, along},
          {"axis_joint", "", "N m/rad", {1e2, 1e3, 1e4}, {-50, 50, 250, 1000}, rods<true>, along}};
}

/// Adds `load` on the nodes farthest along x, shared equally, and a slow motion without any symmetry.
void load_and_stir(Scene& scene, const Vec3& load) {
  constexpr double speed = 0.1;  // m/s
  const auto x = scene.initial.x.row(0);
  ExternalForce force;
  for (int node = 0; node < scene.nodes(); ++node) {
    if (!std::isfinite(scene.mass[static_cast<std::size_t>(node)])) continue;
    for (int axis = 0; axis < 3; ++axis) scene.initial.v(axis, node) = speed * std::sin(3 * node + axis + 1);
    if (x[node] == x.maxCoeff()) force.node.push_back(node);
  }
  force.force.assign(force.node.size(), load / static_cast<double>(force.node.size()));
  scene.effects.emplace_back(force);
}

struct Problem : Case {
  Body body;
  double stiffness, load;
};

std::vector<Problem> problems(bool full) {
  std::vector<double> steps{1.0 / 15, 1.0 / 21, 1.0 / 30, 1.0 / 60};
  if (full) steps = {1.0 / 15, 1.0 / 21, 1.0 / 30, 1.0 / 42, 1.0 / 60, 1.0 / 85, 1.0 / 120, 1.0 / 240};
  std::vector<Problem> all;
  for (const auto& body : bodies())
    for (const double stiffness : body.stiffnesses)
      for (const double load : body.loads)
        for (const double h : steps) {
          Scene scene = body.make(stiffness);
          load_and_stir(scene, load * body.direction);
          all.push_back(
              {{fmt::format("{} {} {:g} {}, {:g} N", body.effect, body.strain, stiffness, body.unit, load),
                scene, h},
               body,
               stiffness,
               load});
        }
  return all;
}

struct Found {
  reference::Contraction dense;
  double predicted = 0, bound = 0, measured = 0;
};

constexpr double rounding = 1e-6;

/// Whether the stiffening part of the geometric stiffness decides the rate; where both parts are as large, it
/// does.
bool stiffens(const reference::Contraction& dense) {
  return -dense.smallest >= (1 - rounding) * dense.largest;
}

/// By an outer iteration that finds the step also where plain does not, and predicts by the same rows.
Found find(const Problem& problem) {
  const State& start = problem.scene.initial;
  const auto exact = truth(problem.scene, start, problem.h);
  Method method;
  method.outer = "proximal";
  method.relaxation = "direct";
  method.tolerance = 1e-12;
  method.max_outer = 1000;
  Workspace workspace(problem.scene, method);
  State end = start;
  const Report report = step(problem.scene, method, problem.h, end, workspace);
  double bound = 0;  // of the effects, and of turns that are linearised: h |w| / 2
  for (const auto& cost : workspace.costs()) bound += cost.contraction;
  if (!problem.scene.bodies.empty()) bound += problem.h / 2 * exact.spin.colwise().norm().maxCoeff();
  return {problem.scene.bodies.empty()
              ? reference::plain_contraction(problem.scene, exact.x, exact.multiplier, problem.h)
              : reference::plain_contraction_of_bodies(problem.scene, start, problem.h, exact),
          report.status == Status::ok ? report.contraction : std::nan(""), bound,
          measured_rate(problem.scene, start, problem.h, exact)};
}

void write_rates(Context& context, const std::vector<Problem>& all, const std::vector<Found>& found) {
  Table table = context.table(
      "rates", {"effect", "strain", "step_s", "stiffness", "unit", "load_n", "predicted_rate", "stiffening",
                "predicted_contraction", "bound", "measured_rate", "status", "reason"});
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto& [dense, predicted, bound, measured] = found[k];
    const bool ok = !std::isnan(measured);
    table.row({all[k].body.effect, all[k].body.strain, all[k].h, all[k].stiffness, all[k].body.unit,
               all[k].load, dense.radius(), -dense.smallest, predicted, bound, measured,
               ok ? "ok" : "not_converged", ok ? "" : "the error does not fall at a steady rate"});
  }
  table.close();
}

void verdicts(Context& context, const std::vector<Found>& all) {
  constexpr double worth_estimating = 0.7, measurable = 0.95;
  constexpr double comparable = 0.01;  // two iterations fit between the measured errors, 1e-6 and 1e-10
  Worst above, different, stiffened, softened;
  int compared = 0, still = 0, not_falling = 0;
  for (const auto& [dense, predicted, bound, measured] : all) {
    if (!(dense.radius() <= comparable) && !(dense.radius() >= measurable)) {
      different.add(std::abs(measured / dense.radius() - 1));
      ++compared;
    }
    still += measured == 0;
    not_falling += std::isnan(measured);
    if (measured == 0) continue;
    const double rate = std::isnan(measured) ? 1 : measured;  // of an error that does not fall 1 at least
    above.add(rate / bound - 1);
    if (measured > worth_estimating && measured < measurable)
      (stiffens(dense) ? stiffened : softened).add(std::abs(predicted / measured - 1));
  }
  context.verdict(
      "contraction.radius",
      fmt::format(
          "the measured rate is the dense spectral radius where that is from {:g} to {:g} ({} of {} cases)",
          comparable, measurable, compared, all.size()),
      "largest |measured/radius - 1|", different.value(), 0.01);
  context.verdict(
      "contraction.bound",
      fmt::format("no measured rate exceeds the effect's bound ({} of {} cases, below {:g}, are left out; {} "
                  "whose error does not fall count as 1)",
                  still, all.size(), least_rate, not_falling),
      "largest measured/bound - 1", above.value(), rounding);
  const std::string statement = "the solver predicts measured rates between 0.7 and 0.95, ";
  context.verdict("contraction.prediction_stiffening", statement + "stiffening decides",
                  "largest |predicted/measured - 1|", stiffened.value(), 0.05);
  context.verdict("contraction.prediction_softening", statement + "compression decides",
                  "largest |predicted/measured - 1|", softened.value(), 0.05);
}

}  // namespace

std::vector<Case> contraction_cases(bool full) {
  const auto all = problems(full);
  return {all.begin(), all.end()};
}

void contraction(Context& context) {
  const auto all = problems(context.full());
  std::vector<Found> found(all.size());
  context.begin(1);
  context.parallel(std::ssize(all), [&](std::int64_t index) {
    found[static_cast<std::size_t>(index)] = find(all[static_cast<std::size_t>(index)]);
  });
  write_rates(context, all, found);
  verdicts(context, found);
  context.advance("rates");
}

}  // namespace pbdcheck
