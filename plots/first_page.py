"""The figures of the report's first page."""

import matplotlib.pyplot as plt
import numpy as np

from common import figure
from finding import finding
from point_hard_cases import gates
from selecting import good, scene_text
from styles import BLACK, BLUE, FALLBACK
from wording import number, span

SIZE = (4.2, 2.6)
LOW, HIGH = 1e-2, 1e-10  # errors between which the title compares
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
    ax.set(xscale="log", yscale="log", xlabel="error reached", ylabel="wall time of a step (s)")
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
    return gates(direct) if len(direct) else None


@figure("effects_cost", "answer", table="costs")
def parts_of_a_step(costs):
    """What each effect of the scene of everything costs a step."""
    mixed = good(costs[costs["scene"] == costs["scene"].iloc[0]], "wall_s_per_step")
    if mixed.empty:
        return None
    chart, ax = plt.subplots(figsize=SIZE)
    ax.barh([name.replace("_", " ") for name in mixed["effect"]], 1e3 * mixed["wall_s_per_step"], color=BLUE, height=0.6)
    ax.set(xlabel="ms a step")
    ax.invert_yaxis()
    dearest = mixed.loc[mixed["wall_s_per_step"].idxmax()]
    part = dearest["wall_s_per_step"] / mixed["wall_s_per_step"].sum()
    finding(chart, f"The dearest part of a step is {dearest['effect'].replace('_', ' ')}: {100 * part:.0f} % of "
            f"{1e3 * mixed['wall_s_per_step'].sum():.2g} ms")
    return chart
