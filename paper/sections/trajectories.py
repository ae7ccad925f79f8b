"""What accuracy at the end of a motion costs, and what `pbdcheck advise` makes of it."""

from content import Figure, Section, Table, counted, joined, number, share, span
from selecting import good, step_text, tellable, told_runs

ACCURACIES = (1e-2, 1e-4, 1e-6)


def quickest(runs, scene, accuracy):
    """The quickest run of the quickest method to an accuracy, and how many times as long the second method takes (none: nan)."""
    reached = good(runs[runs["scene"] == scene], "told", "wall_s")
    reached = reached[reached["told"] <= accuracy]
    if reached.empty:
        return None, float("nan")
    best = reached.loc[reached.groupby("name")["wall_s"].idxmin()].sort_values("wall_s")
    return best.iloc[0], best["wall_s"].iloc[1] / best["wall_s"].iloc[0] if len(best) > 1 else float("nan")


def cell(runs, scene, accuracy):
    """Method, step, ms, memory and margin, or why there is none."""
    if scene not in tellable(runs, accuracy):
        return "not told"
    run, margin = quickest(runs, scene, accuracy)
    if run is None:
        return "not reached"
    return (f"`{run['name']}`, {step_text(float(f'{run.step_s:.3g}'))}: {number(1e3 * run['wall_s'] / run['duration_s'])} ms, "
            f"{number(run['memory_mb'], 2)} MB" + (f" (x {margin:.2f})" if margin > 0 else ""))


def choice(results):
    """The table of the report's first pages: which method for which accuracy; none without its results."""
    frame = results.table("trajectories", "runs")
    if frame is None:
        return []
    runs = told_runs(frame)
    return [Table("Which method for which accuracy at the end of a motion: outer iteration and relaxation, integrator and law unless they "
                  "are implicit Euler and Coulomb's, step, wall time of a simulated second, memory; in brackets how many times as long the "
                  "second best method takes. Not told: beyond the error bar of the true end.",
                  ["scene", *(f"error {number(accuracy)}" for accuracy in ACCURACIES)],
                  [[f"`{scene}`", *(cell(runs, scene, accuracy) for accuracy in ACCURACIES)] for scene in runs["scene"].unique()])]


def truths_table(runs):
    first = runs.groupby("scene", sort=False).first().reset_index()
    return Table("The true ends and their error bars, relative to how far things move.",
                 ["scene", "duration (s)", "true end", "error bar"],
                 [[f"`{r['scene']}`", number(r["duration_s"]), r["truth"], number(r["error_bar"])] for _, r in first.iterrows()])


def outcomes(runs):
    tried = runs[runs["status"] != "skipped"]
    ok = good(tried, "error", "wall_s")
    energy, deep = good(ok, "energy_error"), good(ok[ok["friction"] != "none"], "penetration_m")
    return (f"{share(len(ok), len(tried))} runs come to the end with every step solved, or with the number of iterations they were given; "
            f"{len(runs) - len(tried)} more were skipped because the scene does not allow the method or a looser tolerance was missed. "
            f"Their errors of energy are {span(energy['energy_error'])} of what the motion turns over, more than all of it in "
            f"{counted(int((energy['energy_error'] > 1).sum()), 'run')}; the deepest overlap of a step's end is "
            f"{number(deep['penetration_m'].max()) if len(deep) else 'no number of'} m.")


PRACTISED = {"incremental": "increments of positions from zero impulses, much as XPBD [@macklin2016xpbd] takes them (`incremental`, a sweep's rows linearised together),",
             "frozen": "velocity steps, as projected Gauss-Seidel takes them (`frozen`),"}


def practised(runs):
    """What becomes of few sweeps a step and short steps."""
    runs = told_runs(runs)
    told = []
    for outer, words in PRACTISED.items():
        found = []
        for accuracy in ACCURACIES:
            scenes = tellable(runs, accuracy)
            if not scenes:
                continue
            least = good(runs[(runs["told"] <= accuracy) & runs["scene"].isin(scenes)], "told", "wall_s").groupby("scene")["wall_s"].min()
            own = runs[(runs["outer"] == outer) & (runs["count"] > 0) & (runs["told"] <= accuracy) & runs["scene"].isin(scenes)]
            ratio = (good(own, "told", "wall_s").groupby("scene")["wall_s"].min() / least).dropna()
            found.append(f"an error of {number(accuracy)} in {share(len(ratio), len(scenes))} scenes that tell it" + (
                f" (as the quickest in {int((ratio <= 1).sum())}, in {number(ratio.median(), 2)} times the least time at the median)" if len(ratio) else ""))
        told.append(f"{words} reach {joined(found)}" if found else f"{words} are told in no scene")
    return f"Engines make one to ten sweeps a step, and their steps shorter instead. Of such runs {'; '.join(told)}."


def trajectories(results):
    section = Section(
        "What does accuracy cost over a whole motion?",
        "Where do things end up, how far from the truth, and after how much computing? Over integrator, outer iteration, relaxation, law "
        "of friction, step and tolerance.",
        paragraphs=[
            "The true end is an ODE's [@prince1981high] or a closed form's where there is one. Elsewhere it is that of a far finer run by "
            "`direct`, and its error bar the distance to the run of half as many steps. Of implicit Euler and `newmark` the one with the "
            "smaller bar is taken if both end at the same place, else implicit Euler. Errors below three bars are not counted. Piles and "
            "arches go separate ways soon, so that their motions are short. Of `incremental` and `frozen` a number of iterations is asked, no "
            "tolerance. The memory is what workspace and scene have allocated in a step from where the run ended, counted by the allocator: "
            "small scenes take less than the pages that a process grows by."],
        figures=[
            Figure("trajectories_profile", "Performance profiles [@dolan2002benchmarking]: the share of scenes that a method brings to an "
                   "error within a multiple of the least time of any method. What fails takes for ever."),
            Figure("trajectories_default", "The default, the pair of outer iteration and relaxation that runs unless another is asked for, "
                   "beside the others: the share of tasks solved within a multiple of the least time. A task is a motion by implicit Euler "
                   "with one step, solved to one tolerance."),
            Figure("trajectories_fronts", "Error at the end over wall time where the true end is known: the runs that no other run of the "
                   "method beats in both."),
            Figure("trajectories_contact_fronts", "The same beside finest runs."),
            Figure("trajectories_steps", "Error at the end over the step, with the time as colour."),
            Figure("trajectories_memory", "The memory of a step to three errors: the least of any run, and that of the quickest one."),
            Figure("trajectories_digit", "How many times as long a tenth of the error takes.")])
    return section.tell(results.table("trajectories", "runs"), outcomes, practised, truths_table)


def advice(results):
    section = Section(
        "Does `pbdcheck advise` find the settings?",
        "A pilot on scene files that are in no other part of this section, and its recommendation measured anew: beside a truth of twice as "
        "many steps, and beside all settings of its grid.")
    return section.tell(results.table("advice", "recommended"), advice_told, advice_table)


def advice_told(frame):
    found = good(frame, "error", "wall_s")
    met = found[found["error"] <= found["error_asked"]]
    quick = met[met["wall_s"] <= 1.5 * met["wall_s_other"]]
    return (f"A setting is found for {share(len(found), len(frame))} scenes. Measured anew, {share(len(met), len(found))} meet the error "
            f"asked, and {share(len(quick), len(met))} of these are within 1.5 times of the quickest setting that does.")


def advice_table(frame):
    return Table(f"What is recommended for {counted(len(frame), 'scene')}, and the error and times of a new measurement.",
                 ["scene", "asked", "integrator", "outer", "relaxation", "tolerance", "step", "error", "ms", "quickest other, ms"],
                 [[f"`{r['scene']}`", number(r["error_asked"]), *([f"`{r[c]}`" for c in ("integrator", "outer", "relaxation")] +
                   [number(r["tolerance"]), f"{r['step_s']:.3g} s"] if r["status"] == "ok" else ["none", "", "", "", ""]),
                   number(r["error"]), number(1e3 * r["wall_s"]), number(1e3 * r["wall_s_other"])] for _, r in frame.iterrows()])
