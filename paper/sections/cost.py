"""What accuracy and effects cost."""

import pandas as pd

from content import Figure, Section, Table, counted, number, span
from selecting import failed, good, step_text

LEVELS = (1e-3, 1e-6, 1e-9)  # of the error
SHOWN = (1e-2, 1e-4, 1e-6, 1e-9)  # in the table to choose a method by


def work_precision(results):
    section = Section(
        "What does accuracy cost: which method for which error?",
        "Every method does the same step to the same tolerances, timed on one thread. Comparisons follow the "
        "practice of benchmarking optimisation software [@dolan2002benchmarking]: work is shown beside time, and failures are "
        "named.",
        figures=[
            Figure("work_precision_seconds", "Error against the judge over wall time. The judge that errors are measured "
                   "against stands on the lower edge. Of each outer iteration, the relaxation "
                   "that is quickest. The stairs join the runs that no other run of the method beats in both time and error; methods "
                   "that do not come to 1e-6 are named."),
            Figure("work_precision_row_updates", "The same runs over row updates, which do not depend on the machine, without "
                   "`direct`, which factors."),
            Figure("work_precision_outer_iterations", "The same runs over outer iterations."),
            Figure("work_precision_contact_seconds", "One step of bodies in contact from a cold start, by every relaxation under "
                   "Coulomb's law. `incline`: a box that slides askew; `stack` and `arch`: their top is struck; `pile`: bodies that "
                   "stick, slide and leave each other. The judges of contact problems solve the rows that the solver linearises "
                   "at the judges' own iterates. The table has the other laws, too: `box` and "
                   "`disc` are beside the solution by Coulomb's law, and keep their law's error."),
            Figure("work_precision_contact_cone_seconds", "The same by the convex law, beside its own solution."),
            Figure("work_precision_contact_row_updates", "The runs under Coulomb's law over row updates, without `direct`, which factors.")])
    frame = results.table("work_precision", "points")
    if frame is not None:
        section.tables.append(fastest_table(frame))
        bad = failed(frame, "error")
        tried = frame[frame["status"] != "skipped"]
        section.paragraphs.append(f"{len(frame) - len(bad)} of {counted(len(tried), 'run')} are ok; {len(frame) - len(tried)} "
                                  "more were skipped because the method had missed a looser tolerance, or cannot do the scene. "
                                  "The first table names the quickest method.")
    section.tell(results.table("work_precision", "contacts"), contacts_table)
    return section


def contacts_table(frame):
    rows = []
    for (scene, law), group in frame.groupby(["scene", "friction"], sort=False):
        runs = good(group, "error", "wall_s")
        judged = good(frame[(frame["scene"] == scene) & (frame["friction"] == ("cone" if law == "cone" else "coulomb"))], "wall_s")
        cells = []
        for level in LEVELS:
            reached = runs[(runs["error"] <= level) & (runs["outer"] != "judge")].sort_values("wall_s")
            cells.append(f"`{reached['relaxation'].iloc[0]}` {number(reached['wall_s'].iloc[0])}" if len(reached) else "none")
        judge = judged[judged["relaxation"] == "cone_interior_point"]["wall_s"]
        rows.append([f"`{scene}`", f"`{law}`", *cells, number(judge.iloc[0]) if len(judge) else "none"])
    return Table("Contact: the quickest relaxation with at most the given error and its wall time (s), and the judge's.",
                 ["scene", "law", *(number(level) for level in LEVELS), "judge"], rows)


def quickest(frame, levels=LEVELS):
    """The quickest run with at most each level of error, one row a scene, step and level; outer is '' where there is none."""
    rows = []
    for (scene, step), group in frame.groupby(["scene", "step_s"], sort=False):
        runs = good(group, "error", "wall_s")
        for level in levels:
            reached = runs[runs["error"] <= level].sort_values("wall_s")
            first = reached[["outer", "relaxation", "wall_s"]].iloc[0] if len(reached) else ("", "", float("nan"))
            rows.append((scene, step, level, *first))
    return pd.DataFrame(rows, columns=["scene", "step_s", "level", "outer", "relaxation", "wall_s"])


def rival_wins(frame):
    """In how many rows a rival is the quickest of all, and how many are of scenes that one solves."""
    rows = quickest(frame)
    entered = rows[rows["scene"].isin(good(frame[frame["outer"] == "rival"], "error", "wall_s")["scene"])]
    return int((entered["outer"] == "rival").sum()), len(entered)


def fastest_table(frame):
    rows = [[f"`{scene}`", step_text(step), *(f"`{r['outer']}`, `{r['relaxation']}`: {number(1e3 * r['wall_s'])}" if r["outer"] else "none"
                                              for _, r in group.iterrows())]
            for (scene, step), group in quickest(frame, SHOWN).groupby(["scene", "step_s"], sort=False)]
    return Table("Which method to take: the quickest one that reaches an error, and its wall time of a step in ms. `rival` is Newton's "
                 "method with CHOLMOD, for scenes without hard constraints.",
                 ["scene", "step", *(f"error {number(level)}" for level in SHOWN)], rows, first=True)


def rival_newton(results):
    section = Section(
        "When is the constraint solver faster than Newton's method?",
        "Where every constraint is compliant, Newton's method on the incremental potential does the same step. `newton` is one "
        "written for speed that shares no code with the solver or the judges: it factors the stiffness at each of its few "
        "iterates. `quasi_newton` factors one constant matrix a scene [@liu2017quasi] and does many cheap iterations. One step "
        "of a falling cantilever, as in a running simulation: what only a scene's first step takes is listed as set-up.",
        figures=[
            Figure("rival_newton_elements", "Wall time of a step until the error first falls to a target, over the size of "
                   "the mesh. Crossed: not reached."),
            Figure("rival_newton_seconds", "Error over wall time on the largest mesh.")])
    frame = results.table("rival_newton", "times")
    if frame is not None:
        section.paragraphs.append(
            "Small and middle meshes are judged by `primal_newton`. On the largest mesh of a run the reference is `newton` itself, "
            "converged as far as rounding allows: it and `quasi_newton` share no code, so that the error `quasi_newton` ends "
            "with there is a check of both.")
        section.paragraphs.append(ratios_text(frame))
        section.tables.append(rival_table(frame))
    return section


def paired(frame):
    """One row a problem and target that both methods reached: wall times side by side, and their ratio."""
    keys = ["elements", "young_pa", "poisson", "error_target"]
    both = good(frame, "wall_s").pivot_table(index=keys, columns="method", values="wall_s", sort=False).reset_index()
    if not {"newton", "quasi_newton"} <= set(both):
        return both.iloc[:0].assign(ratio=[])
    both = both.dropna()
    return both.assign(ratio=both["quasi_newton"] / both["newton"])


def ratios_text(frame):
    """Ratio of the times on the largest mesh, by target and Poisson's ratio."""
    both = paired(frame)
    both = both[both["elements"] == both["elements"].max()]
    parts = [f"{span(rows['ratio'])} to {number(target)} at nu = {poisson:g}"
             for (poisson, target), rows in both.groupby(["poisson", "error_target"], sort=False)]
    return (f"On {both['elements'].iloc[0]:.0f} tetrahedra, the time of `quasi_newton` over that of `newton` is "
            + "; ".join(parts) + ". Below 1 the constraint solver is the faster one.") if parts else \
        "No problem was solved by both methods."


def rival_table(frame):
    largest = frame[frame["elements"] == frame["elements"].max()]
    return Table("Time to an error on the largest mesh.",
                 ["tetrahedra", "E (Pa)", "nu", "method", "to", "iterations", "set-up (s)", "wall time (s)", "status"],
                 [[f"{r['elements']:.0f}", number(r["young_pa"]), f"{r['poisson']:g}", f"`{r['method']}`",
                   number(r["error_target"]), f"{r['iterations']:.0f}", number(r["setup_s"]), number(r["wall_s"]),
                   f"`{r['status']}`"] for _, r in largest.iterrows()])


def effects_cost(results):
    section = Section(
        "What does each effect cost?",
        "Does an effect that a scene does not use cost nothing? Does one that it uses cost time in proportion to its rows?",
        figures=[
            Figure("effects_cost_scaling", "Wall time of one sweep and row over the number of rows: level where cost is in proportion."),
            Figure("effects_cost_absent", "Change of a step's time by an effect that is listed and that nothing uses."),
            Figure("effects_cost_stripped", "A sweep over links beside the least loop that does the same."),
            Figure("effects_cost_bytes", "Memory of each effect's rows."),
            Figure("effects_cost_seconds", "Wall time of each effect per row and step, linearising and relaxing.")])
    scaling, costs = results.table("effects_cost", "scaling"), results.table("effects_cost", "costs")
    section.tell(results.table("effects_cost", "absent"), absent_text)
    section.tell(results.table("effects_cost", "stripped"), stripped_text)
    if scaling is not None:
        section.paragraphs.append("Exponents of the time per sweep over the rows: " + "; ".join(
            f"`{name}` {span(group['exponent'])}" for name, group in scaling.groupby("relaxation", sort=False))
            + ". An exponent of 1 is cost in proportion to the rows.")
    if costs is not None:
        section.tables.append(Table(
            "Cost of each effect.", ["scene", "effect", "rows", "bytes per row", "wall time (s)"],
            [[f"`{r['scene']}`", f"`{r['effect']}`", f"{r['rows']:.0f}",
              number(r["bytes"] / r["rows"]) if r["rows"] else "", number(r["wall_s"])] for _, r in costs.iterrows()], first=True))
    return section


def absent_text(absent):
    """What effects cost that nothing uses."""
    change = (absent["time_ratio"] - 1).abs().where(absent["case"] == "empty")
    idle = absent[absent["case"].str.startswith("never touches")]
    noise = absent[absent["effect"] == "none"]
    control = f" The same scene measured against itself differs by {number(100 * (noise['time_ratio'] - 1).abs().max())} %." if len(noise) else ""
    told = (f"Each effect that is listed and empty changes the time of a step by {number(100 * change.max())} % at most." + control +
            f" Together they change {absent['entries_that_differ'].sum():.0f} numbers of the result.")
    if len(idle):
        told += (f" Contact of nodes that never touch the ground takes {span(100 * (idle['time_ratio'] - 1))} % more of a step that does little "
                 "else: boxes are made and compared.")
    return told


def stripped_text(stripped):
    """What a sweep takes beside the least loop over one kind of rows."""
    return ("A sweep of Gauss-Seidel over links, beside a loop that knows links alone: " + "; ".join(
        f"{r['scene']} {number(1e9 * r['wall_s_per_sweep'] / r['rows'])} ns a link beside {number(1e9 * r['stripped_s_per_sweep'] / r['rows'])} ns, "
        f"{number(r['ratio'])} times as long" for _, r in stripped.iterrows()) + ".")


def threads(results):
    section = Section(
        "What do threads gain?",
        "Sweeps and whole steps on one thread and on several. Loops are divided into parts that do not depend on how many threads there "
        "are, so that the results must not either. `coloured_gauss_seidel` goes over chunks of constraints by colours: those of one colour "
        "share no node that moves.",
        figures=[
            Figure("threads_gain", "How many times as fast a sweep is on all threads."),
            Figure("threads_steps", "How many times as fast whole steps are on all threads."),
            Figure("threads_bandwidth", "The bytes a second that a sweep moves at least, as a share of what copying memory moves on as many "
                   "threads.")])
    section.tell(results.table("threads", "sweeps"), sweeps_text, sweeps_table)
    return section.tell(results.table("threads", "steps"), steps_table)


def sweeps_text(sweeps):
    """What several threads gain, which sweeps stay far below copying, and what the chunks cost one thread."""
    several, one = (sweeps[rows] for rows in (sweeps["threads"] > 1, sweeps["threads"] == 1))
    least = one.loc[one["share_of_copy"].idxmin()]
    times = one.pivot_table("wall_s_per_sweep", "scene", "relaxation", sort=False)
    chunks = (f" On one thread `coloured_gauss_seidel` takes {span(times['coloured_gauss_seidel'] / times['gauss_seidel'])} times as long as "
              "`gauss_seidel`." if {"coloured_gauss_seidel", "gauss_seidel"} <= set(times) else "")
    return ((f"Several threads sweep {span(several['speedup'])} times as fast as one. " if len(several) else "")
            + f"One thread moves its bytes at {span(one['share_of_copy'])} of the speed of copying; the slowest is `{least['relaxation']}` in "
            f"`{least['scene']}`.{chunks}")


def sweeps_table(sweeps):
    return Table(
        "Sweeps.", ["scene", "relaxation", "threads", "ms", "million constraints/s", "share of copying", "times as fast", "same bits"],
        [[f"`{r['scene']}`", f"`{r['relaxation']}`", f"{r['threads']:.0f}", number(1e3 * r["wall_s_per_sweep"]),
          number(1e-6 * r["constraints"] / r["wall_s_per_sweep"]), number(r["share_of_copy"]), number(r["speedup"]),
          yes(r["same_bits"])] for _, r in sweeps.iterrows()], first=True)


def steps_table(steps):
    return Table("Whole steps.", ["scene", "method", "threads", "ms a step", "times as fast", "same bits"],
                 [[f"`{r['scene']}`", f"`{r['outer']}`, `{r['relaxation']}`", f"{r['threads']:.0f}", number(1e3 * r["wall_s_per_step"]),
                   number(r["speedup"]), yes(r["same_bits"])] for _, r in steps.iterrows()], first=True)


def yes(flag):
    return "yes" if flag == 1 else "no"


def large_scenes(results):
    section = Section(
        "What does a step of a large scene cost in time and memory, beside Newton's method?",
        "A cantilever of tetrahedra and a sheet let go, by `quasi_newton` and by `newton`, the rival: seconds of the second step from rest until the "
        "error first falls to a target, and the memory that each takes at most, the scene itself left out. Of a solid `quasi_newton` factors one "
        "constant matrix; of a sheet, whose stiffness across itself is its tension, that of the current shape, as Newton's method does. "
        "Columns of boxes that slide are solved by `auto`, to tolerances of the residual, which stand for the error.",
        figures=[Figure("large_scenes_costs", "Time of a step and memory over the number of unknowns.")])
    return section.tell(results.table("large_scenes", "steps"), largest_text, large_table)


def largest_text(steps):
    """On which scenes quasi_newton takes more than half of Newton's time, and whether one of the two fails."""
    times = good(steps, "wall_s").pivot_table("wall_s", ["scene", "size", "error_target"], "method", sort=False)
    if not {"newton", "quasi_newton"} <= set(times):
        return ""
    ratio = (times["quasi_newton"] / times["newton"]).dropna()
    told = [f"`{scene}`: `quasi_newton` takes {span(rows)} of Newton's time" for scene, rows in ratio.groupby(level="scene", sort=False)]
    lost = steps[(steps["status"] != "ok")]
    told += [f"`{r['method']}` does not reach {number(r['error_target'])} on {r['size']:.0f} {r['unit']} ({r['reason']})"
             for _, r in lost.iterrows()]
    return "; ".join(told) + "."


def large_table(steps):
    return Table("Steps of large scenes.", ["scene", "size", "unknowns", "method", "to", "iterations", "set-up (s)", "a step (s)", "MB"],
                 [[f"`{r['scene']}`", f"{r['size']:.0f} {r['unit']}", f"{r['unknowns']:.0f}", f"`{r['method']}`", number(r["error_target"]),
                   f"{r['iterations']:.0f}", number(r["setup_s"]), number(r["wall_s"]) if r["status"] == "ok" else r["reason"],
                   number(r["memory_mb"])] for _, r in steps.iterrows()], first=True)


def frame_scaling(results):
    section = Section(
        "Does a frame's time grow linearly with the scene?",
        "The paper's three scenes from an eighth of their size to eight times it: more columns and layers of boxes; a wider cloth of the "
        "same cells with more bunnies; a cow of smaller tetrahedra. The time is that of the processor, apart for the first frame, the fall, what "
        "follows the first touch and rest. If a frame takes more than in proportion, is it by more iterations or by longer ones?",
        figures=[Figure("frame_scaling_growth", "Times for each unit of size, and iterations a frame, over those of the smallest scene. "
                        "Until the first iterate contacts are found and rows are made.")])
    section.tell(results.table("frame_scaling", "exponents"), growth_text, exponents_table)
    return section.tell(results.table("frame_scaling", "frames"), frames_table)


def growth_text(exponents):
    """Which frames grow faster than the power 1.1, and by what."""
    told = exponents.pivot_table(index=["scene", "part"], columns="quantity", values="exponent", sort=False)
    beyond = told[told["frame"] > 1.1]
    if not len(beyond):
        return f"No frame's time grows faster than the power 1.1; the largest exponent is {number(told['frame'].max())}."
    return ("Faster than the power 1.1 grows a frame's time of " + "; ".join(
        f"`{scene}` where it {part} ({number(row['frame'])}: {number(row['iterations'])} by the number of iterations, "
        f"{number(row['an iteration'])} by the time of one)" for (scene, part), row in beyond.iterrows()) + ".")


def exponents_table(exponents):
    return Table("Exponents over the scene's size, with twice their standard error.", ["scene", "part", "of", "exponent", "from", "to"],
                 [[f"`{r['scene']}`", r["part"], r["quantity"], number(r["exponent"]), number(r["low"]), number(r["high"])]
                  for _, r in exponents.iterrows()])


def frames_table(frames):
    return Table("Means over the frames of each part.", ["scene", "part", "size", "frames", "missed", "contacts", "rows", "iterations",
                                                         "a frame (s)", "until the first iterate (s)", "an iteration (s)"],
                 [[f"`{r['scene']}`", r["part"], *(f"{r[c]:.0f}" for c in ("size", "frames", "missed_frames")),
                   *(number(r[c]) for c in ("contacts", "rows", "iterations", "frame_cpu_s", "begin_cpu_s", "iteration_cpu_s"))]
                  for _, r in frames.iterrows()], detail=True)
