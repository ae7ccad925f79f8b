"""What the report says about each experiment: one function each, every number read from the tables.

A function gets the results and returns a Section without its verdicts, which are the same for all experiments.
"""

from content import Section
from sections.accuracy import dual_vs_primal, judges, mesh_refinement
from sections.bodies import joints, redundant, rotation
from sections.bench import contact_hard_cases, simbenchmark
from sections.cones import cone_problems, friction_cone
from sections.contacts import convex_gap, coupling, friction_isotropy, incline, restitution, stack, stopping
from sections.cost import frame_scaling, threads, work_precision
from sections.effects import effects_cost
from sections.elements import fem_vs_springs
from sections.energy import energy
from sections.motion import damping, direction
from sections.outer import contact_contraction, contraction, outer_convergence, stability_map
from sections.relaxations import conditioning, inexact, inner_convergence
from sections.sweeps import contact_convergence, late_friction, softness
from sections.rivals import large_scenes, rival_newton
from sections.robustness import generated_scenes, generated_worlds, point_hard_cases, tunnelling
from sections.scenes import contact_scenes, figure_1, judged_frames
from sections.time import time_order
from sections.trajectories import advice, trajectories

NO_TABLE = "The run left no table."

SECTIONS = {function.__name__: function for function in (
    figure_1, contact_scenes, judges, judged_frames, outer_convergence, stability_map, contraction, contact_contraction, inner_convergence, contact_convergence, conditioning, inexact, dual_vs_primal,
    mesh_refinement, fem_vs_springs, softness, time_order, energy, direction, damping, rotation, joints, redundant, incline, stopping,
    friction_isotropy, convex_gap, late_friction, restitution, stack, coupling, simbenchmark, contact_hard_cases, friction_cone, cone_problems,
    work_precision, trajectories, advice, rival_newton, large_scenes,
    effects_cost, frame_scaling, threads, point_hard_cases, generated_scenes, generated_worlds, tunnelling)}


def section_of(results, experiment):
    """The section of an experiment: its own if there is one, else what can be said of any."""
    section = SECTIONS[experiment](results) if experiment in SECTIONS else \
        Section(experiment.replace("_", " ").capitalize(), paragraphs=["No text is written for this experiment."])
    section.name = experiment
    shortfall = results.shortfall(experiment)
    if shortfall:
        section.notice = f"No result is shown: {shortfall}."
    if shortfall or not (section.paragraphs or section.tables):
        section.paragraphs, section.figures = [] if shortfall else [NO_TABLE], []
    for figure in section.figures:
        figure.drawn = results.drawn(experiment, figure.name)
    return section
