// A clamped bar whose tip's load is taken away, as elements and as springs: the course of its tip.
//
// The bar is that of beam_statics.h. Its load bends it by `bend` of its length, so little that what the
// geometry adds to a frequency, a share of bend^2, is below anything compared here. It starts in the
// equilibrium that a judge finds (primal_static).
//
//   tip, by modes      u(t) = u(0) sum of a_i cos(w_i t), sum of a_i = 1, all a_i > 0
//   by an integrator   mode i grows by Discrete.growth and turns by Discrete.phase a step (closed_form.h)
//
// With the tip's way measured by the work of the same loads, a_i = (f . phi_i)^2/(w_i^2 f . u(0)) > 0, so
// that all modes but the first together are never farther from the course than 1 - a_1. Two courses differ by
// what their first modes do, and by 2 (1 - a_1) at most.
#pragma once

#include "harness/integrator_rules.h"
#include "studies/accuracy/spring_network.h"

namespace pbdcheck {

constexpr double bar_poisson = 0.3;
constexpr double bend = 1e-3;

struct Bar {
  Model model;
  BeamMesh mesh;
  pbd::Scene scene;        // starts bent
  pbd::Points pull;        // 1 N in all on the end face, across the bar as its first mode sways
  pbd::Points first_mode;  // M phi, phi the first mode at rest, kg m, scaled at will
  double frequency;        // Hz, of that mode; of elements by a judge
  double start;            // m, the tip's way at the start
  double others;           // 1 - a_1
  pbd::Report report;      // of what was solved for it
};
Bar bent_bar(Model model, int n, double kappa);

/// The tip's way, m: by the work of the pull.
double tip(const Bar& bar, const pbd::Points& x);

struct BarCourse {
  std::vector<double> tip;           // m, at the start and after each step
  pbd::reference::Discrete first{};  // of the first mode, measured
  Simulation run;
};
/// `steps`: a multiple of `quarters`, so many quarters of a period of beam theory.
constexpr int quarters = 4;
BarCourse bar_course(const Bar& bar, const pbd::Method& method, double h, int steps);

/// Of that mode by a rule of implicit_euler or newmark with alpha 1/2, which are those compared.
pbd::reference::Discrete predicted(const pbd::Method& method, double frequency, double h);

/// The course in continuous time at the samples of the finest one, `steps` of h seconds (ode.h).
std::vector<double> true_course(const Bar& bar, double h, int steps);

/// Largest distance of a course from each so many-th sample of a finer one, over the tip's way at the start.
double apart(const std::vector<double>& course, const std::vector<double>& finer, double start);

/// What the integrator alone is predicted to make of the first mode against continuous time, likewise.
double predicted_error(const pbd::reference::Discrete& step, double frequency, double h, int steps);

}  // namespace pbdcheck
