#include "studies/accuracy/bar_motion.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "closed_form.h"
#include "harness/oscillation.h"
#include "linear_fem.h"
#include "ode.h"
#include "primal_newton.h"

namespace pbdcheck {

using namespace pbd;

namespace {

constexpr double turn = 2 * std::numbers::pi;

double first_mode_part(const Bar& bar, const Points& x) {
  return work_of(bar.first_mode, x - bar.mesh.mesh.x);
}

/// The first mode's part of a displacement, phi (phi . M u)/(phi . M phi).
Points first_mode_of(const Bar& bar, const Points& x) {
  Points mode = Points::Zero(3, x.cols());
  for (int i = 0; i < bar.scene.nodes(); ++i)
    mode.col(i) = bar.first_mode.col(i) / bar.scene.mass[static_cast<std::size_t>(i)];
  return first_mode_part(bar, x) / work_of(bar.first_mode, mode) * mode;
}

}  // namespace

Bar bent_bar(Model model, int n, double kappa) {
  BeamMesh mesh = beam_mesh(n);
  Scene scene = model == Model::springs ? spring_beam(mesh.mesh, kappa)
                                        : solid_beam(mesh.mesh, bar_poisson, Strain::corotational);
  const FirstMode mode = first_mode(scene, mesh.mesh);
  // A Kuhn grid's two lowest modes sway along the diagonals of the section.
  const Vec3 sum = mode.inertia.rowwise().sum();
  const Points pull = end_loads(mesh.mesh, Vec3(0, 1, std::copysign(1, sum.y() * sum.z())).normalized());
  const double load =
      bend * beam_size.x() /
      reference::tip_deflection(beam_theory(bar_poisson), 1, reference::BeamTheory::timoshenko);
  Scene loaded = scene;
  loaded.effects.emplace_back(nodal_force(load * pull));
  const reference::Judgement rest = reference::primal_static(loaded);
  if (rest.outcome != reference::Outcome::ok) throw std::runtime_error("no bent bar: " + rest.reason);
  scene.initial.x = rest.x;
  Bar bar{model, std::move(mesh), std::move(scene), pull, mode.inertia, mode.frequency, 0, 0, mode.report};
  if (model == Model::elements)
    bar.frequency = reference::linear_modes(reference::clamped_beam({10 * n, n, n}, beam_size,
                                                                    {beam_young, bar_poisson}, beam_density),
                                            1, reference::MassMatrix::lumped)
                        .at(0);
  bar.start = tip(bar, bar.scene.initial.x);
  bar.others = 1 - tip(bar, bar.mesh.mesh.x + first_mode_of(bar, bar.scene.initial.x)) / bar.start;
  return bar;
}

double tip(const Bar& bar, const Points& x) {
  return work_of(bar.pull, x - bar.mesh.mesh.x);
}

BarCourse bar_course(const Bar& bar, const Method& method, double h, int steps) {
  BarCourse made;
  made.tip = {bar.start};
  std::vector<double> part{first_mode_part(bar, bar.scene.initial.x)};
  made.run = simulate_steps(bar.scene, method, h, steps, [&](const State&, const State& after) {
    made.tip.push_back(tip(bar, after.x));
    part.push_back(first_mode_part(bar, after.x));
    return std::string_view();
  });
  // Each of these is a quarter of a period after the last one, or less of a bar that is too stiff.
  const auto apart = static_cast<std::size_t>(steps / quarters);
  if (made.run.status == Status::diverged || part.size() <= 3 * apart) {
    made.first = {std::nan(""), std::nan("")};
    return made;
  }
  const reference::Discrete far = sampled_oscillation(part[0], part[apart], part[2 * apart], part[3 * apart]);
  made.first = {std::pow(far.growth, 1.0 / static_cast<double>(apart)),
                far.phase / static_cast<double>(apart)};
  return made;
}

reference::Discrete predicted(const Method& method, double frequency, double h) {
  const double wh = turn * frequency * h;
  return method.integrator == "newmark" ? reference::newmark_oscillator(wh)
                                        : reference::implicit_euler_oscillator(wh);
}

std::vector<double> true_course(const Bar& bar, double h, int steps) {
  std::vector<double> times, found;
  for (int k = 0; k <= steps; ++k) times.push_back(k * h);
  // Of a step's error in places and speeds, which are of the size of the bend.
  const reference::Trajectory exact = reference::ode(bar.scene, times, {.tolerance = 1e-6 * bend});
  for (const State& sample : exact.samples) found.push_back(tip(bar, sample.x));
  return found;
}

double apart(const std::vector<double>& course, const std::vector<double>& finer, double start) {
  if (course.size() < 2 || (finer.size() - 1) % (course.size() - 1) != 0) return std::nan("");
  const std::size_t every = (finer.size() - 1) / (course.size() - 1);
  Worst worst;
  for (std::size_t k = 0; k < course.size(); ++k) worst.add(std::abs(course[k] - finer[k * every]) / start);
  return worst.value();
}

double predicted_error(const reference::Discrete& step, double frequency, double h, int steps) {
  Worst worst;
  for (int k = 0; k <= steps; ++k)
    worst.add(
        std::abs(std::pow(step.growth, k) * std::cos(k * step.phase) - std::cos(turn * frequency * k * h)));
  return worst.value();
}

}  // namespace pbdcheck
