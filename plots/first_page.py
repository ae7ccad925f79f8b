"""The figures of the report's first page."""

import matplotlib.pyplot as plt
import numpy as np

from common import figure, on_log
from selecting import good, scene_text
from styles import BLACK, BLUE, FALLBACK, RED

SIZE = (3.6, 2.3)
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
    return chart


@figure("contact_hard_cases", "answer", table="gates")
def margins(gates):
    """How far from its bound each gate of each case is."""
    asked = gates[(gates["status"] != "skipped") & (gates["relaxation"] == "direct")]
    if asked.empty:
        return None
    names = list(asked["gate"].unique())
    chart, ax = plt.subplots(figsize=SIZE)
    held = asked["holds"] == 1
    # A gate with the bound 0 allows nothing: it is met at 0, and missed at its edge else.
    ratio = (asked["measured"] / asked["bound"]).where(asked["bound"] > 0, np.where(held, 0.0, np.inf))
    shown = on_log(np.clip(ratio.fillna(np.inf), 0, 1e3))
    place = asked["gate"].map(names.index)
    for which, color, marker in ((held, BLUE, "o"), (~held, RED, "x")):
        ax.plot(shown[which], place[which], marker, color=color, markersize=3, markerfacecolor="none", clip_on=False)
    ax.axvline(1, color=BLACK, linewidth=0.8)
    ax.set(xscale="log", xlabel="measured over its bound")
    ax.set_yticks(range(len(names)), [name.replace("_", " ") for name in names])
    ax.invert_yaxis()
    return chart


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
    return chart
