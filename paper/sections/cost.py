"""What accuracy, threads and larger scenes cost."""

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
    return Table("Which method to take: the quickest one that reaches an error, and its wall time of a step in ms. `rival` is "
                 "Newton's method with CHOLMOD or vertex block descent (`vbd`), for scenes without hard constraints.",
                 ["scene", "step", *(f"error {number(level)}" for level in SHOWN)], rows, first=True)


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
                   "threads."),
            Figure("threads_roofline", "What a sweep over each effect's rows does a second, beside what memory and arithmetic allow.")])
    section.tell(results.table("threads", "sweeps"), sweeps_text, sweeps_table)
    section.tell(results.table("threads", "steps"), steps_table)
    return section.tell(results.table("threads", "roofline"), roofline_text, roofline_table)


def roofline_text(roofline):
    """Which effects' sweeps come near to what the machine allows, and which do not."""
    one = roofline[(roofline["threads"] == 1) & (roofline["relaxation"] == "gauss_seidel")].sort_values("share_of_roof")
    least, most = one.iloc[0], one.iloc[-1]
    return (f"By Gauss-Seidel on one thread sweeps do {span(one['share_of_roof'])} of what memory and arithmetic allow: least over the rows of "
            f"`{least['effect']}`, most over those of `{most['effect']}`. {number(int((one['share_of_roof'] < 0.6).sum()))} of {len(one)} kinds of rows "
            "stay below six tenths.")


def roofline_table(roofline):
    return Table("Sweeps over rows of each effect, alone.", ["effect", "relaxation", "threads", "bytes", "operations", "ns a constraint", "share of the roof"],
                 [[f"`{r['effect']}`", f"`{r['relaxation']}`", f"{r['threads']:.0f}", number(r["bytes"] / r["constraints"]),
                   number(r["flops"] / r["constraints"]), number(1e9 * r["wall_s_per_sweep"] / r["constraints"]), number(r["share_of_roof"])]
                  for _, r in roofline.iterrows()], first=True)


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
