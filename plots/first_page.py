"""The figures of the report's first page."""

import matplotlib.pyplot as plt
import numpy as np

from common import figure
from finding import finding
from point_hard_cases import gates
from selecting import good, scene_text
from styles import BLACK, BLUE, FALLBACK, GREEN
from wording import number, span

SIZE = (4.2, 2.6)
LOW, HIGH = 1e-3, 1e-9  # errors between which the page's answer compares
LEVELS = 10.0 ** -np.arange(1, 13)


@figure("work_precision", "answer", table="points")
def time_over_error(points):
    """The least time of any method of ours to each error, a line a scene and step."""
    runs = good(points[~points["outer"].isin(["judge", "rival"])], "error", "wall_s")
    if runs.empty:
        return None
    chart, ax = plt.subplots(figsize=SIZE)
    looks = dict(zip(runs["scene"].unique(), FALLBACK))
    for (scene, step), group in runs.groupby(["scene", "step_s"], sort=False):
        least = [group.loc[group["error"] <= level, "wall_s"].min() for level in LEVELS]
        color, marker, _ = looks.get(scene, (BLACK, "", ""))
        shortest = step == runs["step_s"].min()
        ax.plot(LEVELS, least, color=color, marker=marker, markersize=2.5, linestyle="-" if shortest else "--",
                label=scene_text(scene) if shortest else None)
    ax.set(xscale="log", yscale="log", xlabel="error of the step's solution", ylabel="wall time of a step (s)")
    ax.invert_xaxis()
    chart.legend(loc="upper center", bbox_to_anchor=(0.5, 0.0), ncol=2, fontsize=6)
    ends = runs.groupby(["scene", "step_s"]).apply(lambda rows: rows.loc[rows["error"] <= HIGH, "wall_s"].min() /
                                                   rows.loc[rows["error"] <= LOW, "wall_s"].min())
    finding(chart, f"From an error of {number(LOW)} to {number(HIGH)} the time grows {span(ends)} times"
            if ends.notna().any() else f"None of {len(ends)} steps is brought to {number(HIGH)}")
    return chart


@figure("contact_hard_cases", "answer", table="gates")
def margins(frame):
    """How far from its bound each gate of each case is."""
    direct = frame[frame["relaxation"] == "direct"]
    return gates(direct, SIZE[0]) if len(direct) else None


@figure("effects_cost", "answer", table="absent")
def unused(absent):
    """How much longer a step takes with effects that are listed and never act; those that are empty as one bar, the dearest."""
    rows = good(absent, "time_ratio")
    rows = rows.assign(change=100 * (rows["time_ratio"] - 1), name=rows["effect"].str.replace("_", " ") + ", " + rows["case"])
    empty, others = (rows[rows["presence"].isin(kinds)] for kinds in (["empty"], ["never touches", "idle"]))
    if empty.empty or others.empty:
        return None
    dearest = empty.loc[empty["change"].abs().idxmax()]
    chart, ax = plt.subplots(figsize=SIZE)
    changes = [dearest["change"], *others["change"]]
    bars = ax.barh([f"{len(empty)} effects, empty (the dearest)", *others["name"]], changes, height=0.6, color=[GREEN, *[BLUE] * len(others)])
    ax.bar_label(bars, [number(change) for change in changes], padding=2, fontsize=6)
    ax.set_xscale("symlog", linthresh=1)
    ax.margins(x=0.15)
    ax.set(xlabel="change of a step's time (%)")
    ax.xaxis.set_major_formatter("{x:g}")
    ax.tick_params(axis="y", labelsize=6)
    ax.invert_yaxis()
    finding(chart, f"What is empty changes the time by at most {number(abs(dearest['change']))} %, what never acts by up to {number(others['change'].abs().max())} %")
    return chart
