"""The three scenes of the paper's first figure."""

from content import Figure, Section, Table, counted, number, share, span
from selecting import step_text

MODELS = (
    "The paper shows three scenes in its first figure and tells no more of them. Here they are 125 boxes that fall on the ground, five "
    "rigid bunnies that fall on a cloth held at its corners, and a flexible cow that falls on the ground. Bunny and cow are surfaces of "
    "blended ellipsoids: stand-ins for the paper's models. The cow is a lattice of corotational tetrahedra that carries its surface in "
    "the pictures; the ground is touched by the lattice's nodes.")


def figure_1(results):
    section = Section(
        "Are rigid and flexible bodies simulated by one solver?",
        "The paper's three scenes, each from its file in experiments/scenes, which names the linear solver: what they cost, how deep bodies overlap, whether energy rises, "
        "and whether each step that says ok is true.",
        paragraphs=[MODELS],
        figures=[
            Figure("figure_1_pictures", "The scenes at the start, after 40 % and 70 % of the time, and at its end."),
            Figure("figure_1_series", "Energy since the start, deepest overlap and time a step over time. Crossed: steps that missed their "
                   "tolerance.")])
    return section.tell(results.table("figure_1", "scenes"), scenes_text, scenes_table)


def scenes_text(frame):
    bad = frame[frame["status"] != "ok"]
    steps, ok = frame["steps"].sum(), frame["steps_ok"].sum()
    text = (f"{share(int(ok), int(steps))} steps meet their tolerance, and {counted(int(frame['refuted_steps'].sum()), 'step')} of "
            f"{int(frame['judged_steps'].sum())} that say so are refuted. A frame takes {span(frame['frame_wall_s'])} s. The deepest "
            f"overlap is {span(frame['overlap_share'])} of a body's least size, at the end {span(frame['overlap_share_at_end'])}. ")
    if bad.empty:
        return text + "Every run is ok."
    return text + "Not ok: " + "; ".join(f"`{r['scene']}` at h = {step_text(r['step_s'])} ({r['status']}: {r['reason']}, "
                                         f"{int(r['steps'] - r['steps_ok'])} steps)" for _, r in bad.iterrows()) + "."


def scenes_table(frame):
    return Table("The scenes: what is in them, what a frame takes, and what stays true. Rest: kinetic energy at the end over m g and a "
                 "body's least size.",
                 ["scene", "step", "time (s)", "bodies", "tetrahedra", "contacts", "rows", "frame (s)", "sweeps a step", "overlap",
                  "at the end", "rest", "ok"],
                 [[f"`{r['scene']}`", step_text(r["step_s"]), number(r["duration_s"]), number(r["bodies"]), number(r["elements"]),
                   number(r["most_contacts"]), number(r["most_rows"]), number(r["frame_wall_s"]), number(r["sweeps"] / r["steps"]),
                   number(r["overlap_share"]), number(r["overlap_share_at_end"]), number(r["rest_share"]),
                   f"{r['steps_ok']:.0f} of {r['steps']:.0f}"] for _, r in frame.iterrows()])
