"""Does a frame's time grow linearly with the scene, and if not, by more iterations or by longer ones?"""

import numpy as np

from common import figure, footnote, panels
from finding import finding, guide, name_lines
from styles import FALLBACK
from wording import number

ALLOWED = 1.1  # exponent of a frame's time, as the verdicts ask
LINES = (("frame_cpu_s", "a frame", True), ("begin_cpu_s", "until the first iterate", True), ("iterations", "iterations", False),
         ("iteration_cpu_s", "an iteration", True))  # column, label, whether it is per size


def of_smallest(rows, column, per_size):
    """A column, a time for each unit of the scene's size, over what it is in the smallest scene."""
    values = rows[column].to_numpy() / (rows["size"].to_numpy() if per_size else 1)
    return values / values[0]


def exponent_of(x, y):
    """The slope of log y over log x; not a number without two of each."""
    known = np.isfinite(x) & np.isfinite(y) & (x > 0) & (y > 0)
    if len(set(x[known])) < 2:
        return np.nan
    return np.polyfit(np.log(x[known]), np.log(y[known]), 1)[0]


@figure("frame_scaling", "growth", table="frames")
def growth(frame):
    """Of each scene and part, times for each unit of size and the number of iterations over the size, relative to the smallest scene."""
    scenes = list(dict.fromkeys(frame["scene"]))
    parts = [part for part in dict.fromkeys(frame["part"]) if part in ("falls", "strikes")]
    if not parts:
        return None
    fig, axes = panels(len(scenes) * len(parts), columns=len(scenes), height=2.0)
    slowest = []
    for ax, (part, scene) in zip(axes, [(part, scene) for part in parts for scene in scenes]):
        rows = frame[(frame["scene"] == scene) & (frame["part"] == part)].sort_values("size")
        for (column, label, per_size), (color, marker, line) in zip(LINES, FALLBACK):
            ax.plot(rows["size"], of_smallest(rows, column, per_size), color=color, marker=marker, linestyle=line, label=label,
                    markerfacecolor="white", markersize=4)
        reach = rows["size"].to_numpy() / rows["size"].min()
        ax.plot(rows["size"], reach ** (ALLOWED - 1), ":", color="black", linewidth=0.8)
        guide(ax, 1)
        ax.set(xscale="log", yscale="log", title=f"{scene}: {part}", xlabel="size")
        if part == parts[-1]:
            slowest.append(f"{scene} {number(exponent_of(reach, rows['frame_cpu_s'].to_numpy()))}")
    for ax in axes[len(scenes) - 1::len(scenes)]:
        name_lines(ax)
    axes[0].set_ylabel("over that of the smallest scene")
    finding(fig, f"A frame's time is to grow with the power {ALLOWED:g} of the scene at most. Where it strikes: {', '.join(slowest)}")
    footnote(fig, "Times for each box, cell of cloth or tetrahedron; level: linear; dotted: the power 1.1.")
    return fig
