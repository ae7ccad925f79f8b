// The experiments, in the order of the report: one row each.
#include "studies/experiments.h"

namespace pbdcheck {

const std::vector<Experiment>& experiments() {
  static const std::vector<Experiment> list{
      {"judges", "Do the two reference solvers agree on every scene used below?", judges},
      {"outer_convergence",
       "How fast do the outer iterations approach the implicit Euler step, and when do they fail?",
       outer_convergence, outer_convergence_cases},
      {"stability_map",
       "Where does each outer iteration find the step, and does the solver predict where plain converges?",
       stability_map, stability_map_cases},
      {"contraction", "Is each effect's contraction of the plain outer iteration the predicted one?",
       contraction, contraction_cases},
      {"inner_convergence",
       "How fast do the relaxations solve the linearised step, and does theory predict it?",
       inner_convergence, inner_convergence_cases},
      {"conditioning", "Which relaxation survives mass ratio, stiffness and near incompressibility?",
       conditioning},
      {"inexact", "What does it save to solve the linear problems no further than the step can use?",
       inexact},
      {"dual_vs_primal", "Does the constraint solver reach the solution of the primal elasticity problem?",
       dual_vs_primal, dual_vs_primal_cases},
      {"mesh_refinement",
       "Is the finite element constraint more accurate than a mass-spring network on the same mesh?",
       mesh_refinement},
      {"time_order", "At which order does each integrator approach the motion in continuous time?",
       time_order},
      {"energy", "What do the integrators do to energy and momentum, and where do they blow up?", energy},
      {"direction",
       "What do the directions of constraints do to stability, constraints and energy, beside velocity time "
       "stepping?",
       direction},
      {"damping", "Does damping take what its coefficient says, and nothing of rigid motion?", damping},
      {"rotation", "What do the integrators and the gyroscopic torque make of rotating bodies?", rotation},
      {"joints", "How accurately do joints carry mechanisms, and what does a chain of bodies cost?", joints,
       joints_cases},
      {"redundant", "Does a mechanism move as before when joints hold what others hold already?", redundant},
      {"incline", "Does a box on a plane stick and slide as Coulomb's law says?", incline},
      {"stopping", "Do sliding bodies come to rest, or to roll, where they should?", stopping},
      {"friction_isotropy", "Is friction the same in every direction?", friction_isotropy},
      {"convex_gap", "How high does a sliding body hover by the convex law?", convex_gap},
      {"restitution", "Do bodies bounce as high and push each other as they should?", restitution},
      {"stack", "Do stacks, overhangs and arches stand and fall where they should?", stack},
      {"simbenchmark", "How accurate and how fast is contact, beside five engines' published figures?",
       simbenchmark},
      {"contact_hard_cases", "Does one method without settings survive the contacts that solvers fail on?",
       contact_hard_cases},
      {"friction_cone", "Do the impulses of a step's contacts obey the law of friction?", friction_cone},
      {"cone_problems", "Are contact problems with friction solved whose answer was planted?", cone_problems},
      {"work_precision", "What does accuracy cost in time, for every outer iteration and relaxation?",
       work_precision, work_precision_cases},
      {"rival_newton", "When is the constraint solver faster than Newton's method?", rival_newton},
      {"effects_cost", "What does each effect cost, and does an effect that is absent cost nothing?",
       effects_cost},
      {"point_hard_cases", "Does one method without settings survive the scenes that solvers fail on?",
       point_hard_cases},
      {"generated_scenes", "Does a step that says ok tell the truth, whatever the scene?", generated_scenes},
      {"generated_worlds",
       "Is a step of anything that says ok true, and the only one that the same scene in other words has?",
       generated_worlds},
  };
  return list;
}

}  // namespace pbdcheck
