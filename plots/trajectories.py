"""Which method reaches the end of a motion with which error in which time and memory?"""

import numpy as np
import pandas as pd
from matplotlib.colors import LogNorm

from common import figure, footnote, on_log, panels, profile_line, shared_legend
from finding import beyond, finding, guide
from selecting import UNTOLD, failed, good, reasons_note, scene_text, tellable, told_runs
from styles import FALLBACK, style
from wording import counted, joined, number, share, some, span

ACCURACIES = (1e-2, 1e-4, 1e-6)
DIGITS = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
MOST_METHODS = 6
STYLE_OF = {"newmark": "newmark 0.55"}  # its default
STEPS_SHOWN = ("pendulum", "chain", "cantilever", "incline", "stack", "boxes_on_ground")


def least_times(runs, accuracy, by="name"):
    """The least wall time (s) of each method to an accuracy, a row a method, a column a scene that tells it; inf: not reached."""
    runs = runs[runs["scene"].isin(tellable(runs, accuracy))]
    reached = good(runs, "told", "wall_s")
    reached = reached[reached["told"] <= accuracy]
    times = reached.pivot_table("wall_s", by, "scene", aggfunc="min")
    return times.reindex(index=runs[by].unique(), columns=runs["scene"].unique()).fillna(np.inf)


def most_reaching(runs, most=MOST_METHODS):
    """The methods with the smallest times over the best ones, over all scenes and accuracies."""
    score = 0
    for accuracy in ACCURACIES:
        times = least_times(runs, accuracy)
        ratios = times.div(times.min().where(np.isfinite(times.min())), axis=1)
        score = score + (1 / ratios).fillna(0).sum(axis=1).reindex(runs["name"].unique()).fillna(0)
    return list(score.sort_values(ascending=False, kind="stable").index[:most])


@figure("trajectories", "profile", table="runs")
def profile(runs):
    """Dolan and More's performance profiles: the share of scenes that a method brings to an accuracy within a multiple of the
    least time of any."""
    runs = told_runs(runs)
    chart, axes = panels(len(ACCURACIES), sharey=True)
    names, firsts = most_reaching(runs), []
    for ax, accuracy in zip(axes, ACCURACIES):
        times = least_times(runs, accuracy)
        scenes, least = times.shape[1], times.min()
        ratios = times.div(least.where(np.isfinite(least)), axis=1)
        finite = ratios.reindex(names).to_numpy()
        end = 2 * finite[np.isfinite(finite)].max(initial=5)
        for k, name in enumerate(names):
            own = ratios.loc[name].to_numpy() if name in ratios.index else np.array([])
            profile_line(ax, own, scenes, end, label=name, color=FALLBACK[k][0], linestyle=FALLBACK[k][2])
        reached = np.isfinite(times.reindex(names)).sum(axis=1)
        if scenes and reached.max() > 0:
            first = reached.idxmax()
            firsts.append(f"to {number(accuracy)} {first}, {share(reached.max(), scenes)}")
        else:
            firsts.append(f"to {number(accuracy)} none in {counted(scenes, 'scene')}")
        ax.set(xscale="log", title=f"error {number(accuracy)}: {counted(scenes, 'scene')}", ylim=(-0.03, 1.03))
    chart.supxlabel("time over the least of all methods", fontsize=8)
    chart.supylabel("share of scenes", fontsize=8)
    shared_legend(chart, axes, columns=3)
    finding(chart, f"What brings most scenes to an error: {'; '.join(firsts)}")
    blunt = {accuracy: [scene for scene in runs["scene"].unique() if scene not in tellable(runs, accuracy)] for accuracy in ACCURACIES}
    footnote(chart, " ".join(f"Left out at {number(accuracy)}, whose truth cannot tell it: {joined(map(scene_text, scenes))}."
                             for accuracy, scenes in blunt.items() if scenes) +
             " A run that misses a step's tolerance, diverges or ends with a larger error takes for ever. Each method at its best step and "
             "tolerance.")
    return chart


def front(ax, rows, look, name):
    """The runs that no other of the method beats in both time and error."""
    rows = rows.sort_values(["wall_s", "told"])
    best = rows[rows["told"] == rows["told"].cummin()]
    ax.plot(best["wall_s"], on_log(best["told"]), drawstyle="steps-post", label=name, **look)


def fronts(runs):
    """Error over time, one panel a scene with a true end; what that does not tell is shaded."""
    runs = told_runs(runs)
    endless = list(runs.loc[runs["error_bar"].isna(), "scene"].unique())
    runs = runs[~runs["scene"].isin(endless)]
    scenes = list(runs["scene"].unique())
    if not scenes:
        return None
    names, wins = most_reaching(runs), []
    chart, axes = panels(len(scenes), height=1.8)
    for ax, scene in zip(axes, scenes):
        rows = runs[runs["scene"] == scene]
        reached = good(rows, "told", "wall_s")
        for k, name in enumerate(names):
            color, marker, line = FALLBACK[k]
            front(ax, reached[reached["name"] == name],
                  {"color": color, "marker": marker, "linestyle": line, "markerfacecolor": "white"}, name)
        least = UNTOLD * rows["error_bar"].iloc[0]
        if len(reached) and least > 0.1 * reached["told"].min():
            beyond(ax, 0.1 * least, least)
        ax.set(xscale="log", yscale="log", title=scene_text(scene))
        sharp = reached[reached["told"] <= 2 * reached["told"].min()]
        if len(sharp):
            wins.append(f"{scene_text(scene)} {number(sharp['told'].min(), 2)}")
    chart.supxlabel("wall time (s)", fontsize=8)
    chart.supylabel("error at the end", fontsize=8)
    shared_legend(chart, axes, columns=3)
    finding(chart, f"Least error told: {'; '.join(wins)}" if wins else f"No run of {counted(len(scenes), 'scene')} is ok",
            f"No true end of {joined(map(scene_text, endless))}: finest runs miss their tolerance" if endless else "")
    others = [name for name in runs["name"].unique() if name not in names]
    footnote(chart, "Shaded: below three error bars of the truth, which tells no error there. " +
             (f"In the table alone: {some(others)}. " if others else "") + reasons_note(failed(runs[runs["status"] != "skipped"], "told", "wall_s")).replace(
                 "Crossed, not ok", "Not drawn, not ok"))
    return chart


def own_truth(runs):
    """Whether the truth is a finer run of the solver's own, for want of an ODE or a closed form."""
    return runs["truth"].str.contains(" steps by ")


@figure("trajectories", "fronts", table="runs")
def fronts_to_known_truths(runs):
    return fronts(runs[~own_truth(runs)])


@figure("trajectories", "contact_fronts", table="runs")
def fronts_to_finest_runs(runs):
    return fronts(runs[own_truth(runs)])


@figure("trajectories", "steps", table="runs")
def steps(runs):
    """Error over step, its time as the colour, of the integrators by solved steps."""
    solved = good(runs[(runs["outer"] == "auto") & (runs["relaxation"] == "direct") & runs["friction"].isin(["none", "coulomb"])],
                  "error", "wall_s")
    solved = solved[solved["tolerance"] == runs.loc[runs["tolerance"] > 0, "tolerance"].min()]
    scenes = [scene for scene in runs["scene"].unique() if scene in STEPS_SHOWN] or list(runs["scene"].unique()[:6])
    chart, axes = panels(len(scenes), height=1.8)
    norm = LogNorm(solved["wall_s"].min(), solved["wall_s"].max()) if len(solved) > 1 else None
    shown, points = [], None
    for ax, scene in zip(axes, scenes):
        for integrator, rows in solved[solved["scene"] == scene].groupby("integrator", sort=False):
            rows = rows.sort_values("step_s")
            look = style(STYLE_OF.get(integrator, integrator))
            ax.plot(rows["step_s"], on_log(rows["error"]), color="#bbbbbb", linewidth=0.6, linestyle=look["linestyle"], zorder=1)
            points = ax.scatter(rows["step_s"], on_log(rows["error"]), c=rows["wall_s"], norm=norm, cmap="viridis",
                                marker=look["marker"], s=16, label=integrator, zorder=2)
        least = UNTOLD * runs.loc[runs["scene"] == scene, "error_bar"].iloc[0]
        shown.append(least)
        if np.isfinite(least) and least > 1e-8:
            guide(ax, least)
        ax.set(xscale="log", yscale="log", title=scene_text(scene))
    chart.supxlabel("step (s)", fontsize=8)
    chart.supylabel("error at the end", fontsize=8)
    shared_legend(chart, axes, columns=4)
    if points is not None and norm:
        chart.colorbar(points, ax=axes, label="wall time (s)", shrink=0.8)
    worse = [scene_text(scene) for scene in scenes if not_falling(solved[solved["scene"] == scene])]
    best = least_error_by_integrator(solved)
    finding(chart, f"With the shortest step {best}" if best else f"No run of {counted(len(scenes), 'scene')} is ok",
            f"Newmark's error does not fall with the step in {joined(worse)}" if worse else "")
    footnote(chart, "By auto and direct, solved to the tightest tolerance. Dashed: three error bars of the truth, where that is above 1e-8.")
    return chart


def not_falling(rows):
    """Whether newmark's error with the shortest step is no smaller than a half of that with the longest."""
    rows = rows[rows["integrator"] == "newmark"].sort_values("step_s")
    return len(rows) > 1 and not rows["error"].iloc[0] < 0.5 * rows["error"].iloc[-1]


def least_error_by_integrator(solved):
    """The integrator of the least error in most scenes, in how many, of those whose truth tells these errors."""
    solved = solved[solved["error"] >= UNTOLD * solved["error_bar"]]
    finest = solved[solved["step_s"] == solved.groupby("scene")["step_s"].transform("min")]
    if finest.empty:
        return ""
    first = finest.loc[finest.groupby("scene")["error"].idxmin(), "integrator"].value_counts()
    return joined(f"{name} is the most accurate in {share(count, finest['scene'].nunique())}" if k == 0 else f"{name} in {count}"
                  for k, (name, count) in enumerate(first.items()))


def memories(runs, accuracy):
    """The memory (MB) of the quickest run to an accuracy, and the least one of any run to it, a row a scene that one reaches."""
    reached = good(runs[runs["scene"].isin(tellable(runs, accuracy))], "told", "wall_s", "memory_mb")
    reached = reached[reached["told"] <= accuracy]
    quickest = reached.loc[reached.groupby("scene")["wall_s"].idxmin()].set_index("scene")["memory_mb"]
    return pd.DataFrame({"quickest": quickest, "least": reached.groupby("scene")["memory_mb"].min()})


@figure("trajectories", "memory", table="runs")
def error_over_memory(runs):
    """The memory that each error takes, a row a scene: from the least of any run to that of the quickest one."""
    runs = told_runs(runs)
    scenes = list(runs["scene"].unique())
    chart, (ax,) = panels(1, width=6.5, height=0.3 * len(scenes) + 0.4)
    found = [memories(runs, accuracy) for accuracy in ACCURACIES]
    for k, (accuracy, memory) in enumerate(zip(ACCURACIES, found)):
        color, marker, _ = FALLBACK[k]
        rows = np.array([scenes.index(scene) for scene in memory.index]) + 0.22 * (k - 1)
        ax.hlines(rows, memory["least"], memory["quickest"], color=color, linewidth=0.8)
        ax.plot(memory["least"], rows, color=color, marker=marker, linestyle="none", markerfacecolor="white")
        ax.plot(memory["quickest"], rows, color=color, marker=marker, linestyle="none", label=f"error {number(accuracy)}")
    ax.set(xscale="log", xlabel="memory (MB)", ylim=(len(scenes) - 0.5, -0.5))
    ax.set_yticks(range(len(scenes)), [scene_text(scene) for scene in scenes])
    shared_legend(chart, [ax])
    finding(chart, *dearer_memory(found, len(scenes)))
    footnote(chart, "Open: the least of all runs to the error. Filled: the quickest run to it. Where a marker is missing, no run reaches the error, "
             "or the truth cannot tell it.")
    return chart


def dearer_memory(found, scenes):
    """What the quickest run takes over the least, and what the smallest error takes over the largest one."""
    ratios = pd.concat([memory["quickest"] / memory["least"] for memory in found])
    if ratios.empty:
        return [f"No run of {counted(scenes, 'scene')} reaches an error of {number(ACCURACIES[0])}"]
    finer = (found[-1]["least"] / found[0]["least"]).dropna()
    return [f"The quickest run to an error takes {span(ratios)} times the least memory (median {number(ratios.median(), 2)})",
            f"An error of {number(ACCURACIES[-1])} takes {span(finer)} times the least memory of {number(ACCURACIES[0])}"
            if len(finer) else ""]


@figure("trajectories", "digit", table="runs")
def cost_of_a_digit(runs):
    """How much longer the quickest method of all takes for a tenth of the error, a row a scene."""
    runs = told_runs(runs)
    scenes = list(runs["scene"].unique())
    least = np.array([least_times(runs, accuracy).min().reindex(scenes).replace(np.inf, np.nan) for accuracy in DIGITS])
    finite = (least[1:] / least[:-1]).T
    chart, (ax,) = panels(1, width=6.5, height=0.24 * len(scenes) + 0.6)
    ax.imshow(finite, cmap="Oranges", norm=LogNorm(1, 100), aspect="auto")
    for row, scene in enumerate(scenes):
        for column, fine in enumerate(DIGITS[1:]):
            value = finite[row, column]
            text = f"x {value:.2g}" if np.isfinite(value) else "not told" if scene not in tellable(runs, fine) else "not reached"
            ax.text(column, row, text, ha="center", va="center", fontsize=7, color="#777777" if np.isnan(value) else
                    "white" if value > 20 else "black")
    ax.set_xticks(range(len(DIGITS) - 1), [f"{number(coarse)} to {number(fine)}" for coarse, fine in zip(DIGITS, DIGITS[1:])])
    ax.set_yticks(range(len(scenes)), [scene_text(scene) for scene in scenes])
    ax.grid(False)
    known = finite[np.isfinite(finite)]
    finding(chart, f"One more digit takes {number(np.median(known), 2)} times as long (median; {span(known)})" if len(known) else
            f"In none of {counted(len(scenes), 'scene')} is one more digit reached")
    footnote(chart, "Time of the quickest method to the smaller error over that of the quickest one to the larger error.")
    return chart
