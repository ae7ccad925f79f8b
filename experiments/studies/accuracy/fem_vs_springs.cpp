// Elements against springs on the same mesh, in motion and in contact: a clamped bar let go (bar_motion.h), a
// soft cube on the ground (soft_cube.h), and the rows, sweeps and time of both. One number, kappa, fits the
// springs to Young's modulus on each mesh (spring_network.h); elements are fitted to nothing.
#include <cmath>
#include <numbers>

#include "closed_form.h"
#include "harness/trajectory.h"
#include "studies/accuracy/bar_motion.h"
#include "studies/accuracy/soft_cube.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr std::array models{Model::elements, Model::springs};

std::string text(Model model) {
  return std::string(model_names[static_cast<std::size_t>(model)]);
}

double beam_frequency() {
  return reference::timoshenko_cantilever_frequency(beam_theory(bar_poisson), 1);
}

/// Trapezoidal rule: newmark with alpha 1/2.
Method direct_method(std::string_view integrator) {
  Method method;
  method.integrator = integrator;
  method.alpha = 0.5;
  method.relaxation = "direct";
  method.tolerance = 1e-10;
  method.max_outer = 1000;  // contacts at the edge of sliding take many
  return method;
}

Bar fitted_bar(Model model, int n) {
  const double rod = beam_size.x() / (beam_young * beam_size.y() * beam_size.z());
  const double bent =
      reference::tip_deflection(beam_theory(bar_poisson), 1, reference::BeamTheory::timoshenko);
  return bent_bar(model, n, model == Model::springs ? fitted_network(beam_mesh(n), rod, bent).kappa : 0);
}

/// Steps a period of beam theory.
constexpr int coarse = 32, middle = 64, finest = 128;

struct Bars {
  Table bars, courses;
  Worst period{}, course{};
};

/// One course, of `steps` steps a period of beam theory; `truth` is that in continuous time, or empty.
void bar_row(Bars& to, const Bar& bar, const Method& method, int steps, const std::vector<double>& truth) {
  const double h = 1 / (beam_frequency() * steps);
  const BarCourse made = bar_course(bar, method, h, steps);
  const reference::Discrete expected = predicted(method, bar.frequency, h);
  const double error = truth.empty() ? std::nan("") : apart(made.tip, truth, bar.start);
  const double own = predicted_error(expected, bar.frequency, h, steps);
  const auto left = [&](const reference::Discrete& step) {
    return std::pow(step.growth, 1 / (bar.frequency * h));
  };
  constexpr double turn = 2 * std::numbers::pi;
  to.bars.row({text(bar.model), std::int64_t{bar.mesh.n}, method.integrator, h, bar.start,
               bend * beam_size.x(), made.first.phase / (turn * h), expected.phase / (turn * h),
               bar.frequency, beam_frequency(), left(made.first), left(expected), error, own, bar.others,
               status_cell(made.run.status), made.run.reason});
  to.period.add(std::abs(made.first.phase / expected.phase - 1), text(bar.model));
  to.period.add(std::abs(made.first.growth / expected.growth - 1), text(bar.model));
  // As shares of what is allowed.
  if (!truth.empty()) to.course.add(std::abs(error - own) / (2 * bar.others + bend), text(bar.model));
  if (method.integrator != "newmark" || steps != middle) return;
  for (std::size_t k = 0; k < made.tip.size(); ++k) {
    const double t = static_cast<double>(k) * h;
    to.courses.row({text(bar.model), std::int64_t{bar.mesh.n}, h, t, made.tip[k],
                    bend * beam_size.x() * std::cos(turn * beam_frequency() * t),
                    status_cell(made.run.status), made.run.reason});
  }
}

/// Returns the finest bar of each model.
std::vector<Bar> motion(Context& context) {
  std::vector<Bar> last;
  Bars to{
      context.table("bars", {"model", "n", "integrator", "step_s", "tip_m", "tip_beam_m", "frequency_hz",
                             "predicted_hz", "mesh_hz", "beam_hz", "left", "predicted_left", "error",
                             "predicted_error", "other_modes", "status", "reason"}),
      context.table("courses", {"model", "n", "step_s", "time_s", "tip_m", "beam_m", "status", "reason"})};
  const std::vector<int> levels = context.full() ? std::vector{2, 4} : std::vector{2};
  for (const Model model : models) {
    const Bar bar = fitted_bar(model, 1);
    const std::vector<double> truth = true_course(bar, 1 / (beam_frequency() * finest), finest);
    for (int steps = coarse; steps <= finest; steps *= 2)
      for (const auto* integrator : {"implicit_euler", "newmark"})
        bar_row(to, bar, direct_method(integrator), steps, truth);
    context.advance("bar n=1 " + text(model));
    for (const int n : levels) {
      const Bar finer = fitted_bar(model, n);
      for (const auto* integrator : {"implicit_euler", "newmark"})
        bar_row(to, finer, direct_method(integrator), middle, {});
      if (n == levels.back()) last.push_back(finer);
      context.advance(fmt::format("bar n={} {}", n, text(model)));
    }
  }
  to.bars.close();
  to.courses.close();
  context.verdict(Basis::code, "fem_vs_springs.period",
                  "the first mode turns and fades as the integrator makes of the mesh's own frequency",
                  fmt::format("largest |measured/predicted - 1| ({})", to.period.owner()), to.period.value(),
                  bend * bend);
  context.verdict(
      Basis::code, "fem_vs_springs.course",
      "the tip is as far from its course in continuous time as the first mode is predicted to be, but "
      "for twice what the other modes hold",
      fmt::format("largest share of what those may add ({})", to.course.owner()), to.course.value(), 1);
  return last;
}

/// Of the networks' lateral contraction, errors of the order 1/n and 1/n^2 taken away by n = 2, 4, 8.
void networks(Context& context, std::map<int, CubeNetwork>& fitted) {
  Table table = context.table(
      "networks", {"n", "kappa", "poisson", "lattice_poisson", "isotropic_poisson", "status", "reason"});
  constexpr double isotropic = 0.25;
  for (const int n : {2, 4, 8}) {
    const CubeNetwork made = fitted.emplace(n, fitted_cube(n)).first->second;
    table.row({std::int64_t{n}, made.kappa, made.lateral, kuhn_network_poisson(), isotropic,
               status_cell(made.report.status), std::string(made.report.reason)});
  }
  table.close();
  const double two = 2 * fitted[4].lateral - fitted[2].lateral,
               four = 2 * fitted[8].lateral - fitted[4].lateral;
  const double limit = (4 * four - two) / 3;
  context.advance("networks");
  context.verdict(Basis::theory, "fem_vs_springs.network",
                  "a network's lateral contraction tends to what its lattice makes of it",
                  "|extrapolated - formula|; bound: the last term", std::abs(limit - kuhn_network_poisson()),
                  std::abs(limit - four));
}

struct Cubes {
  Table table;
  Worst judged{}, weight{}, solid{};
};

void cube_row(Cubes& to, const CubeCase& each, const Resting& at, bool asked) {
  const double plate = each.plate ? plate_weight() : 0, own = cube_weight();
  const double strain = (plate + own / 2) / (soft_cube_young * soft_cube_side * soft_cube_side);
  const bool known = each.friction == 0;
  const double sag = known ? soft_cube_side * strain : std::nan(""),
               bulge = known ? each.poisson * strain : sag;
  to.table.row({text(each.model), std::int64_t{each.n}, std::string(each.plate ? "plate" : "own weight"),
                each.friction, each.poisson, at.sag, sag, at.bulge, bulge, at.ground, plate + own,
                at.off_judge, at.allowed, std::int64_t{at.judged_steps}, at.rows, at.sweeps,
                status_cell(at.status), at.reason});
  to.weight.add(std::abs(at.ground / (plate + own) - 1), text(each.model));
  if (asked) to.judged.add(at.off_judge / at.allowed, text(each.model));
  if (!known || each.model == Model::springs || !each.plate) return;
  // The cube's own weight bends what a plate's presses evenly: its share of the strain, by linear elements
  // h^2 of it.
  const double uneven = own / 2 / (plate + own / 2) / (each.n * each.n);
  to.solid.add(std::abs(at.sag / sag - 1) / uneven, fmt::format("sag, nu = {:g}", each.poisson));
  to.solid.add(std::abs(at.bulge - bulge) / strain / uneven, fmt::format("bulge, nu = {:g}", each.poisson));
}

/// Springs know nothing of Poisson's ratio: they are done once.
void cubes_of_each_poisson(Context& context, Cubes& to, CubeCase each, double kappa) {
  constexpr double usual = 0.3;
  const bool coarse = each.n == 2, quick = !context.full() && !coarse;
  std::optional<Resting> springs;
  for (const double poisson : quick ? std::vector{usual} : std::vector{0.0, 0.25, usual, 0.45}) {
    each.poisson = poisson;
    // The judge takes a second a step on 4^3 cells.
    const bool judged = coarse && (context.full() || (poisson == usual && each.plate));
    if (each.model == Model::elements) {
      cube_row(to, each, rest(soft_cube(each, kappa), direct_method("implicit_euler"), judged), judged);
      continue;
    }
    if (!springs)
      springs = rest(soft_cube(each, kappa), direct_method("implicit_euler"),
                     coarse && (context.full() || each.plate));
    cube_row(to, each, *springs, judged);
  }
}

void contact(Context& context, const std::map<int, CubeNetwork>& fitted) {
  Cubes to{context.table(
      "cubes", {"model", "n", "scene", "friction_coefficient", "poisson", "sag_m", "sag_expected_m", "bulge",
                "bulge_expected", "ground_n", "weight_n", "off_judge", "allowed_off_judge", "judged_steps",
                "rows", "sweeps", "status", "reason"})};
  for (const int n : {2, 4})
    for (const Model model : models) {
      for (const bool plate : {true, false})
        for (const double friction : {0.0, 0.5})
          cubes_of_each_poisson(context, to, {model, n, 0, friction, plate}, fitted.at(n).kappa);
      context.advance(fmt::format("cube n={} {}", n, text(model)));
    }
  to.table.close();
  context.verdict(Basis::code, "fem_vs_springs.judged",
                  "on its way to rest a cube's steps end where the judge's do, of those that it solves, as "
                  "near as the tolerance says",
                  fmt::format("largest share of what the tolerance allows ({})", to.judged.owner()),
                  to.judged.value(), 1);
  context.verdict(Basis::theory, "fem_vs_springs.weight", "the ground carries what stands on it",
                  fmt::format("largest |force/weight - 1| ({})", to.weight.owner()), to.weight.value(), 1e-8);
  context.verdict(
      Basis::theory, "fem_vs_springs.solid",
      "under a plate without friction elements sag and bulge by Young's modulus and Poisson's ratio",
      fmt::format("largest share of what their own weight may bend ({})", to.solid.owner()), to.solid.value(),
      1);
}

/// A step of both at the same tolerance: a bar let go, a cube under a plate with friction.
void cost(Context& context, const std::vector<Bar>& bars, const std::map<int, CubeNetwork>& fitted) {
  Table table = context.table("cost", {"scene", "model", "n", "relaxation", "tolerance", "step_s", "rows",
                                       "outer_iterations", "sweeps", "wall_s", "status", "reason"});
  constexpr int steps = 8;  // from the start on, where most happens
  for (const std::string_view relaxation : {"conjugate_gradients", "direct"})
    for (const bool bar : {true, false})
      for (const Bar& each : bars) {
        const int n = each.mesh.n;
        const Scene scene =
            bar ? each.scene : soft_cube({each.model, n, bar_poisson, 0.5, true}, fitted.at(n).kappa).scene;
        const double h = bar ? 1 / (beam_frequency() * 64) : 1.0 / 60;
        Method method = direct_method("implicit_euler");
        method.relaxation = relaxation;
        method.tolerance = 1e-8;
        SceneFile file;
        file.scene = scene;
        const Trajectory spent = timed_trajectory(file, steps * h, {.method = method, .steps = steps});
        table.row({std::string(bar ? "bar" : "cube"), text(each.model), std::int64_t{n},
                   std::string(relaxation), method.tolerance, h, spent.rows, spent.outer_iterations / steps,
                   spent.sweeps / steps, spent.wall_s / steps, status_cell(spent.status), spent.reason});
      }
  table.close();
  context.advance("cost");
}

}  // namespace

void fem_vs_springs(Context& context) {
  context.begin(2 * (context.full() ? 3 : 2) + 1 + 4 + 1);
  std::map<int, CubeNetwork> fitted;
  const std::vector<Bar> bars = motion(context);
  networks(context, fitted);
  contact(context, fitted);
  cost(context, bars, fitted);
}

}  // namespace pbdcheck
