"""Scene files as a whole: the paper's three, and those with contact."""

from content import Figure, Section, Table, counted, joined, listed, number, share, span
from reading import ALLOWED_RESIDUAL, solves_as_it_is
from reading import NEXT_TO_SOLUTION as NEAR
from selecting import AT_REST, scene_gates, step_text

MODELS = (
    "The paper shows three scenes in its first figure and tells no more of them. Here they are 125 boxes that fall on the ground, five "
    "rigid bunnies that fall on a cloth held at its corners, and a flexible cow that falls on the ground. Bunny and cow are surfaces of "
    "blended ellipsoids: stand-ins for the paper's models. The cow is a lattice of corotational tetrahedra that carries its surface in "
    "the pictures; the ground is touched by the lattice's nodes.")
GATES = (
    "The gates: each step meets its tolerance, and none that says so is refuted. The deepest overlap is at most a hundredth of a body's "
    "least size, at the end a thousandth. Constraints that give no way are met to a thousandth; a scene without any has an error of 0. "
    "Energy never rises above the start's, unless the scene is driven: that has no such gate. Which scenes are not at rest at their end, the kinetic energy below 1e-6 of m g and a body's least size, is told.")
TILTING = (
    "Where a body tilts over an edge, implicit Euler may gain the work that the curvature of the gap brings: of the first order in the "
    "step. The checks of each step allow that and no more.")


def figure_1(results):
    section = Section(
        "Are rigid and flexible bodies simulated by one solver?",
        "The paper's three scenes, each from its file in experiments/scenes, which names the linear solver: what they cost, how deep bodies overlap, whether energy rises, "
        "and whether each step that says ok is true.",
        paragraphs=[MODELS],
        figures=[
            Figure("figure_1_pictures", "The scenes at the start, after 40 % and 70 % of the time, and at its end."),
            Figure("figure_1_series", "Energy since the start, deepest overlap and time a step over time. Crossed: steps that missed their "
                   "tolerance."),
            Figure("figure_1_distance", "Small versions of the scenes: distance of sampled steps from the nearest solution that the judge "
                   "finds, over time.", detail=True)])
    section.tell(results.table("figure_1", "scenes"), scenes_text, sizes_table, gates_table)
    return section.tell(results.table("figure_1", "frames"), small_text, frames_text, frames_table)


def small_text(frame):
    sizes = joined(f"`{scene}` with {counted(int(rows['nodes'].iloc[0]), 'node')}" for scene, rows in frame.groupby("scene", sort=False))
    return (f"The judge is asked about small versions, bodies counted as nodes: {sizes}. The cow touches the ground with its nodes alone. "
            f"They are solved by `direct` to {number(frame['tolerance'].min())}. Distances are as in [#judged_frames].")


def contact_scenes(results):
    section = Section(
        "Do whole scenes keep what must hold?",
        "The scene files with contact and some mechanisms, each by its own method, step and duration, in the full tier at half the step, too. Which gates hold?",
        paragraphs=[GATES],
        figures=[
            Figure("contact_scenes_pictures", "The scenes at the start, after 40 % and 70 % of the time, and at its end. Arrows, drawn over "
                   "what would hide them: forces of contacts, on the upper of both; the largest of each picture has the same length."),
            Figure("contact_scenes_gates", "Every gate of every scene, measured over its bound. Crossed: it does not hold.")])
    return section.tell(results.table("contact_scenes", "scenes"), scenes_text, gates_text, sizes_table, gates_table)


def gates_text(frame):
    gates = scene_gates(frame)
    bad = gates[~gates["holds"]]
    text = f"{share(int(gates['holds'].sum()), len(gates))} gates hold."
    for gate, rows in bad.groupby("gate", sort=False):
        told = joined(f"of `{r['scene']}` at h = {step_text(r['step_s'])} ({number(r['measured'])})" for _, r in rows.iterrows())
        text += f" Beyond {number(rows['bound'].iloc[0])}: {gate}, {told}."
    gain = bad[bad["gate"] == "energy above the start's"]
    return text + (f" {TILTING}" if len(gain) else "") + "".join(map(gain_text, gain.groupby("scene", sort=False)))


def gain_text(gain):
    """How a scene's gain of energy grows with the step, where it was simulated by several."""
    scene, rows = gain
    rows = rows.sort_values("step_s")
    (short, least), (long, most) = rows[["step_s", "measured"]].iloc[[0, -1]].to_numpy()
    return f" At {number(long / short)} times the step `{scene}` gains {number(most / least)} times as much." if len(rows) > 1 else ""


def scenes_text(frame):
    bad = frame[frame["status"] != "ok"]
    moving = frame.loc[~(frame["rest_share"] <= AT_REST), "scene"].unique()
    steps, ok = frame["steps"].sum(), frame["steps_ok"].sum()
    text = (f"{share(int(ok), int(steps))} steps meet their tolerance, and {counted(int(frame['refuted_steps'].sum()), 'step')} of "
            f"{int(frame['judged_steps'].sum())} that say so are refuted. A frame takes {span(frame['frame_wall_s'])} s. The deepest "
            f"overlap is {span(frame['overlap_share'])} of a body's least size, at the end {span(frame['overlap_share_at_end'])}. "
            + (f"Still in motion where they are stopped are {listed(moving)}. " if len(moving) else "All are at rest at the end. "))
    if bad.empty:
        return text + "Every run is ok."
    return text + "Not ok: " + "; ".join(f"`{r['scene']}` at h = {step_text(r['step_s'])} ({r['status']}: {r['reason']}, "
                                         f"{int(r['steps'] - r['steps_ok'])} steps)" for _, r in bad.iterrows()) + "."


def sizes_table(frame):
    return Table("The scenes: what is in them, and what a frame takes. Sweeps: of a step.",
                 ["scene", "step", "time (s)", "bodies", "elements", "contacts", "rows", "frame (s)", "sweeps"],
                 [[f"`{r['scene']}`", step_text(r["step_s"]), number(r["duration_s"]), number(r["bodies"]), number(r["elements"]),
                   number(r["most_contacts"]), number(r["most_rows"]), number(r["frame_wall_s"], 2), number(r["sweeps"] / r["steps"])]
                  for _, r in frame.iterrows()])


def gates_table(frame):
    return Table("What stays true of the scenes. Overlap, and overlap at the end: over a body's least size. Energy: largest excess over the "
                 "start's, over m g L. Rest: kinetic energy at the end over m g and a body's least size.",
                 ["scene", "step", "overlap", "at the end", "bilateral", "energy", "rest", "refuted", "ok"],
                 [[f"`{r['scene']}`", step_text(r["step_s"]), number(r["overlap_share"]), number(r["overlap_share_at_end"]),
                   number(r["bilateral_error_m"]), "driven" if r["driven"] else number(r["excess_share"]), number(r["rest_share"]), number(r["refuted_steps"]),
                   share(int(r["steps_ok"]), int(r["steps"]))] for _, r in frame.iterrows()])


def judged_frames(results):
    section = Section(
        "Do steps of whole scenes end where a judge finds them to end?",
        "Scenes of bodies, cloth and solids with contact, friction and damping. Sampled steps are solved anew, from where each begins, by a "
        "judge that states gaps by its own corners, edges and faces and solves everything but the contacts by a sparse factorisation, the "
        "contacts by an interior point method. Told is the distance of the end velocities, in the metric of masses, over the scale that the "
        "solver's tolerance refers to.",
        figures=[Figure("judged_frames_distance", "Distance of sampled steps from the nearest solution that the judge finds, over time, for "
                        "three tolerances of the solver.")])
    return section.tell(results.table("judged_frames", "frames"), frames_text, frames_table)


def frames_text(frame):
    ok = frame[frame["status"] == "ok"]
    unknown = ok[ok["reference_status"] == "not_judged"]
    as_they_are = solves_as_it_is(ok)
    missed, unsolved = len(frame) - len(ok), int(ok["nearest_error_of_scale"].isna().sum()) - len(unknown)
    itself = ok["reference_status"] == "ok"
    other = int(((ok["nearest_start"] != "own") & itself).sum())
    helped = int((ok["nearest_error_of_scale"].notna() & ~itself).sum())
    last = ok[ok["tolerance"] == frame["tolerance"].min()]
    far = last[~(last["nearest_error_of_scale"] <= NEAR) & ~solves_as_it_is(last)]
    text = (f"{counted(len(frame), 'step')} were sampled. {missed or 'None'} missed the solver's tolerance. Of the others the judge "
            f"{unknown_text(unknown)}left {unsolved or 'none'} unsolved, solved {helped or 'none'} only from what the solver claims, and found "
            f"{other or 'none'} beside another solution of its own: Coulomb's law may have several. ")
    if as_they_are.any():
        text += (f"{int(as_they_are.sum())} end next to no solution that it finds, and are solutions by its own equations, to "
                 f"{number(ALLOWED_RESIDUAL)}: where solutions lie beside each other its way leads to another one. ")
    if far.empty:
        return text + f"At the least tolerance every {'other ' if as_they_are.any() else ''}step ends within {number(NEAR)} of a solution."
    known = far[far["nearest_error_of_scale"].notna()]
    text += (f"At the least tolerance {len(far)} of {counted(len(last), 'step')} {'are' if len(far) > 1 else 'is'} not seen to end within "
             f"{number(NEAR)} of a solution")
    if known.empty:
        return text + "."
    worst = known.loc[known["nearest_error_of_scale"].idxmax()]
    return text + (f", the worst by {number(worst['nearest_error_of_scale'])} (`{worst['scene']}`, step {int(worst['step'])}). Such a distance "
                   "is a fault of the solver or of the judge, or comes from how each states what touches.")


def unknown_text(unknown):
    """What the judge does not know, and why."""
    return f"does not know {len(unknown)} ({joined(unknown['reference_reason'].unique())}), " if len(unknown) else ""


def frames_table(frame):
    rows = []
    for (scene, tolerance), own in frame.groupby(["scene", "tolerance"], sort=False):
        ok = own[own["status"] == "ok"]
        rows.append([f"`{scene}`", number(tolerance), f"{len(ok)} of {len(own)}", f"{int(ok['nearest_error_of_scale'].notna().sum())}",
                     number(ok["nearest_error_of_scale"].median()), number(ok["nearest_error_of_scale"].max()), number(ok["error_of_scale"].max()),
                     f"{int((ok['nearest_start'] != 'own').sum())}", number(own["reference_wall_s"].median())])
    return Table("Distance of judged steps from the judge's solutions, over the step's scale. Judged: steps that are ok for which the judge "
                 "found a solution. Others: steps at another solution than the judge's own.",
                 ["scene", "tolerance", "ok", "judged", "median", "worst", "worst from its own", "others", "judge (s)"], rows)
