"""Writes made-up result tables in the shape the experiments give them: for the tests of the plots and the report.

None of the numbers means anything.
"""

from command import command
from reading import InputError
from sample_bodies import joints, redundant, rotation
from sample_scenes import contact_scenes, figure_1, judged_frames
from sample_bench import contact_hard_cases, simbenchmark
from sample_cones import cone_problems, friction_cone
from sample_contacts import convex_gap, coupling, friction_isotropy, incline, restitution, stack, stopping
from sample_cost import METHOD_COLUMNS, advice, effects_cost, frame_scaling, large_scenes, method_points, rival_newton, threads, trajectories, work_precision
from sample_elements import fem_vs_springs
from sample_files import verdict, write, write_run
from sample_motion import damping, direction
from sample_outer import contact_contraction, contraction, outer_convergence, stability_map
from sample_robustness import generated_scenes, generated_worlds, point_hard_cases, tunnelling
from sample_solvers import conditioning, contact_convergence, dual_vs_primal, inexact, inner_convergence, mesh_refinement
from sample_sweeps import late_friction, softness
from sample_time import energy, time_order
import tables

def judges(directory):
    write(directory, "judges", "agreement", "scene nodes step_s reference_a reference_b difference residual_a "
          "residual_b wall_s_a wall_s_b status reason",
          [("pendulum", 2, 0.05, "primal_newton", "ode", 3e-14, 1e-15, 1e-13, 1e-5, 1e-3, "ok", ""),
           ("chain20", 21, 1 / 60, "primal_newton", "ipopt", 2e-11, 1e-15, 1e-11, 1e-4, 2e-2, "ok", ""),
           ("cantilever", 135, 1 / 60, "primal_newton", "ipopt", 4e-10, 1e-14, 1e-10, 1e-3, 0.4, "ok", ""),
           ("cloth", 400, 1 / 60, "primal_newton", "ipopt", float("nan"), 1e-14, float("nan"), 1e-3, 9.0,
            "not_converged", "Ipopt: iteration limit")])


CLAIMED = {  # ids of verdicts that the report's claims and answers read
    "outer_convergence": ("outer.pendulum_rate.0.20", "outer.chain_map.rate"), "contraction": ("contraction.radius",),
    "contact_contraction": ("contact_contraction.sticking", "contact_contraction.sliding", "contact_contraction.expanding"),
    "energy": ("energy.spring.newmark", "energy.spring.implicit_euler", "energy.linear_momentum", "energy.angular_momentum.loss"),
    "cone_problems": ("cone_problems.ipopt", "cone_problems.velocity"), "time_order": ("time_order.spring.bdf2",),
    "mesh_refinement": ("mesh.mms.l2", "mesh.n1.solver"), "generated_worlds": ("worlds.refuted",), "coupling": ("coupling.sag", "coupling.weight"),
    "figure_1": ("figure_1.finite", "figure_1.claims", "figure_1.energy", "figure_1.solved"),
    "effects_cost": ("effects.empty.free", "effects.empty.bitwise", "effects.removed.cheaper", "effects.frictionless.cheaper",
                     "effects.linear.chain")}
VERDICTS = [verdict("outer_convergence.rate", "The fixed point contracts at the predicted rate", "relative difference", 0.01, 0.05),
            verdict("outer_convergence.all", "The plain iteration converges everywhere", "share not converged", 0.4, 0.0)]


def write_all(directory):
    for experiment in (figure_1, contact_scenes, judged_frames, outer_convergence, stability_map, contraction, contact_contraction, inner_convergence, contact_convergence, conditioning, inexact, dual_vs_primal,
                       mesh_refinement, fem_vs_springs, softness, time_order, energy, direction, damping, rotation, joints, redundant, incline, stopping,
                       friction_isotropy, convex_gap, late_friction, restitution, stack, coupling, simbenchmark, contact_hard_cases, friction_cone, cone_problems,
                       work_precision, trajectories, advice, rival_newton, large_scenes,
                       effects_cost, frame_scaling, threads, point_hard_cases, generated_scenes, generated_worlds, tunnelling, judges):
        experiment(directory)
        name = experiment.__name__
        claimed = [verdict(claim, "It does", "share", 0.01, 0.05) for claim in CLAIMED.get(name, ())]
        write(directory, name, "verdicts", tables.VERDICTS, VERDICTS + claimed)
        write_run(directory, name, holds=1 + len(claimed), fails=1)
    write(directory, ".", "compare", METHOD_COLUMNS.replace("tolerance ", "") + " method",
          [(*row, row[4] if row[3] == "judge" else f"outer={row[3]} relaxation={row[4]}") for row in method_points(False)])


def main(directory):
    """Writes DIR, which must not hold anything: made-up numbers do not go among measured ones."""
    if directory.exists() and any(directory.iterdir()):
        raise InputError(f"{directory}: got a folder with files in it; allowed: a new or empty one")
    write_all(directory)


if __name__ == "__main__":
    command(main, "Writes made-up results, for trying the plots and the report: none of the numbers means anything.")
