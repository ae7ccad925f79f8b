"""What constraints do to the motion: their directions and their damping."""

from content import Figure, Section, Table, counted, number, share, span
from selecting import failed, good, step_text


def direction(results):
    section = Section(
        "How do the directions of constraints affect the motion?",
        "Impulses act along the directions at a step's end, at its start (SHAKE), or at a blend b of both. Velocity time "
        "stepping solves one linearisation at the start, with or without stabilisation. Linear problems are solved directly. How "
        "long may a step be, what happens to the energy, and how far are constraints violated at equal work?",
        figures=[
            Figure("direction_largest_steps", "Largest stable step. On the taut chain it is predicted: 2/(w sqrt(1 - 2 b)) with w "
                   "of the fastest mode, without bound from b = 1/2 on. `auto` may end at a folded solution of a long step."),
            Figure("direction_modes", "A mode of the taut chain with h w = 1: what a step leaves of its energy."),
            Figure("direction_energy", "A hard pendulum released horizontally: schemes, and the same enlarged."),
            Figure("direction_contenders", "The taut chain: directions of the step's begin, refreshed ones (`plain`), and refreshed ones with a bound "
                   "of the geometric stiffness added to the mass matrix (`proximal`, ours). Dashed: the explicit limit 2/w."),
            Figure("direction_contact", "Overlap of shapes over 0.1 m, or stretch of a rope, over work: linearisations of one step of 1/60 s, or "
                   "shorter steps of velocity time stepping; 20 sweeps of Gauss-Seidel each."),
            Figure("direction_equal_work", "Largest violation of a link over work. Position: more linearisations of a step of 1/60 s; "
                   "velocity: as many shorter steps. Solved runs alone are drawn, and counted above. A step of velocity "
                   "time stepping does not claim to be solved.")])
    section.tell(results.table("direction", "largest_steps"), steps_text, steps_table)
    section.tell(results.table("direction", "energy"), energy_table)
    return section.tell(results.table("direction", "equal_work"), equal_work_ratios_table, equal_work_table)


def scheme_text(row):
    """A scheme in a table of the report."""
    name = f"`{row['integrator']}`, `{row['outer']}`"
    return name + (f", stabilised {number(row['stabilisation'])}" if row["family"] == "velocity" else
                   f", b = {number(row['direction_blend'])}")


def steps_text(frame):
    """What the longest stable steps of a claimed solution take."""
    position = frame[(frame["family"] == "position") & (frame["steps"] > 0)]
    solved, missed = position[position["missed_steps"] == 0], position[position["missed_steps"] > 0]
    parts = [f"At the largest stable step {len(missed)} of {counted(len(position), 'run')} that claim solved steps missed some."]
    if len(solved):
        worst = solved.loc[solved["most_outer_iterations"].idxmax()]
        parts += [f"A long step may take many outer iterations: of those that missed none, one on `{worst['scene']}` by "
                  f"{scheme_text(worst)} took {worst['most_outer_iterations']:.0f}."]
    return " ".join(parts)


def steps_table(frame):
    rows = [[f"`{r['scene']}`", scheme_text(r), number(r["largest_step_s"]),
             number(r["predicted_step_s"]) if r["predicted_step_s"] > 0 else "", f"{r['missed_steps']:.0f} of {r['steps']:.0f}",
             r["limit"], f"`{r['status']}`", r["reason"]] for _, r in frame.iterrows()]
    return Table("Largest stable steps (s), and why longer ones are not.",
                 ["scene", "scheme", "largest", "predicted", "missed steps", "beyond it", "status", "reason"], rows)


def energy_table(frame):
    rows = []
    for _, run in frame.groupby(["integrator", "outer", "direction_blend", "stabilisation"], sort=False, dropna=False):
        last = run.sort_values("time_s").iloc[-1]
        rows.append([scheme_text(last), number(last["energy_j"]), span(run["energy_j"]), f"`{last['status']}`", last["reason"]])
    steps, times = frame["step_s"].iloc[0], frame["time_s"].max()
    return Table(f"Energy of the pendulum (J) after {number(times)} s in steps of {step_text(steps)}; it begins at 0.",
                 ["scheme", "at the end", "range", "status", "reason"], rows)


def equal_work_ratios(frame):
    """(scene, stabilisation, ratios): the violation of velocity time stepping over that of each solved run with implicit
    directions, where it works as much or the next more."""
    velocity = good(frame[frame["family"] == "velocity"], "error")
    position = good(frame[(frame["family"] == "position") & (frame["direction_blend"] == 1)], "error")
    for scene, solved in position.groupby("scene", sort=False):
        for stabilisation, others in velocity[velocity["scene"] == scene].groupby("stabilisation"):
            ratios = []
            for _, run in solved[solved["error"] > 0].iterrows():
                dearer = others[others["row_updates_per_s"] >= run["row_updates_per_s"]].sort_values("row_updates_per_s")
                ratios += [dearer["error"].iloc[0] / run["error"]] if len(dearer) else []
            if ratios:
                yield scene, stabilisation, ratios


def equal_work_ratios_table(frame):
    return Table("Violation of links by velocity time stepping, as a multiple of that by implicit directions, where these solve every step. "
                 "Velocity time stepping does as many row updates, or the next larger number that was tried.",
                 ["scene", "stabilisation", "times as large"],
                 [[f"`{scene}`", number(stabilisation), span(ratios)] for scene, stabilisation, ratios in equal_work_ratios(frame)])


def equal_work_table(frame):
    most = frame[frame["linearisations_per_frame"] == frame["linearisations_per_frame"].max()]
    rows = [[f"`{r['scene']}`", scheme_text(r), number(r["row_updates_per_s"]), number(r["error"]), number(r["violation_rms"]),
             number(r["energy_change"]), f"{r['missed_steps']:.0f} of {r['steps']:.0f}", f"`{r['status']}`", r["reason"]]
            for _, r in most.iterrows()]
    return Table(f"At most {number(most['linearisations_per_frame'].max())} linearisations a frame of 1/60 s, over "
                 f"{number(frame['duration_s'].max())} s: violations of a link's length, energy at the end over its scale.",
                 ["scene", "scheme", "row updates a second", "largest", "rms", "energy", "missed steps", "status", "reason"], rows)


def damping(results):
    section = Section(
        "Is damping that of its coefficient?",
        "Constraints are damped as in a Kelvin-Voigt body, c + T dc/dt + A gamma = 0 [@servin2006interactive]; solids have damping "
        "moduli of their own. Do oscillators decay as the coefficient says, however many sweeps are allowed, and does rigid motion "
        "stay undamped?",
        figures=[
            Figure("damping_decrements", "The decrement's distance from that of the matrix that an integrator's step makes of the "
                   "oscillator. Dashed: the bound of the verdict."),
            Figure("damping_order", "The decay rate approaches c/(2 m) as the step shrinks; 1 kg, 100 N/m, 1 N s/m."),
            Figure("damping_rotation", "Two masses on a spring, spinning and vibrating: the energy beside that of the steady rotation "
                   "with the same angular momentum.")])
    section.tell(results.table("damping", "decrements"), decrements_by_sweeps, decrements_table)
    return section.tell(results.table("damping", "rotation"), rotation_text)


def decrements_by_sweeps(frame):
    found = []
    for scene, rows in frame.groupby("scene", sort=False):
        few, many = (good(rows[rows["max_sweeps"] == count], "error") for count in
                     (rows["max_sweeps"].min(), rows["max_sweeps"].max()))
        found.append([f"`{scene}`", span(few["error"]), span(many["error"])])
    least, most = number(frame["max_sweeps"].min()), number(frame["max_sweeps"].max())
    return Table(f"Relative error of the decrement. {share(len(frame) - len(failed(frame, 'error')), len(frame))} runs solve every step.",
                 ["oscillator", f"at most {least} sweeps", f"at most {most} sweeps"], found)


def decrements_table(frame):
    fine = frame[(frame["scene"] == frame["scene"].iloc[0]) & (frame["max_sweeps"] == frame["max_sweeps"].max())]
    fine = fine[fine["step_s"] == fine["step_s"].min()]
    return Table(f"Decrement of 1 kg, 100 N/m, 1 N s/m at {step_text(fine['step_s'].min())}; 0.314552702 in continuous time.",
                 ["integrator", "decrement", "decay rate (1/s)", "status", "reason"],
                 [[f"`{r['integrator']}`", f"{r['decrement']:.9f}", f"{r['decay_per_s']:.9f}", f"`{r['status']}`", r["reason"]]
                  for _, r in fine.iterrows()])


def rotation_text(frame):
    last = frame[frame["scene"] == "vibrating"].sort_values("time_s").groupby(["integrator", "retardation_s"], sort=False).tail(1)
    damped, free = last[last["retardation_s"] > 0], last[last["retardation_s"] == 0]
    return (f"After {number(last['time_s'].max())} s the energy beside the rotation is {span(abs(damped['vibration_j']))} J with "
            f"damping, {span(abs(free['vibration_j']))} J without; the rotation has {span(damped['rotation_j'])} J and "
            f"{span(free['rotation_j'])} J.")
