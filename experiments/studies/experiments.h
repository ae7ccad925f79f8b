// The experiments: one source each, named as here and in experiment_list.cpp.
#pragma once

#include "harness/experiment.h"

namespace pbdcheck {

/// All experiments, in the order of the report.
const std::vector<Experiment>& experiments();

void judges(Context& context);
void outer_convergence(Context& context);
void stability_map(Context& context);
void contraction(Context& context);
void contact_contraction(Context& context);
void direction(Context& context);
void damping(Context& context);
void inner_convergence(Context& context);
void contact_convergence(Context& context);
void conditioning(Context& context);
void inexact(Context& context);
void dual_vs_primal(Context& context);
void softness(Context& context);
void mesh_refinement(Context& context);
void fem_vs_springs(Context& context);
void time_order(Context& context);
void energy(Context& context);
void figure_1(Context& context);
void contact_scenes(Context& context);
void rotation(Context& context);
void joints(Context& context);
void redundant(Context& context);
void incline(Context& context);
void stopping(Context& context);
void friction_isotropy(Context& context);
void late_friction(Context& context);
void convex_gap(Context& context);
void coupling(Context& context);
void restitution(Context& context);
void stack(Context& context);
void simbenchmark(Context& context);
void contact_hard_cases(Context& context);
void judged_frames(Context& context);
void cone_problems(Context& context);
void friction_cone(Context& context);
void work_precision(Context& context);
void trajectories(Context& context);
void advice(Context& context);
void rival_newton(Context& context);
void large_scenes(Context& context);
void effects_cost(Context& context);
void threads(Context& context);
void frame_scaling(Context& context);
void point_hard_cases(Context& context);
void generated_scenes(Context& context);
void generated_worlds(Context& context);
void tunnelling(Context& context);

std::vector<Case> outer_convergence_cases(bool full);
std::vector<Case> stability_map_cases(bool full);
std::vector<Case> contraction_cases(bool full);
std::vector<Case> inner_convergence_cases(bool full);
std::vector<Case> dual_vs_primal_cases(bool full);
std::vector<Case> joints_cases(bool full);
std::vector<Case> work_precision_cases(bool full);

}  // namespace pbdcheck
