"""How fast does each relaxation solve the linearised problem?"""

import re

import numpy as np

from common import curve, draw_failed, figure, footnote, panels, shared_legend
from finding import fewer, finding, first_and_last
from styles import BLACK, style
from selecting import failed, good, reasons_note
from wording import counted, number, share

REACHED = 1e-10  # an error that counts as solved
STATIONARY = ("gauss_seidel", "jacobi")  # iterations that have a rate: the spectral radius of a matrix


def traces(frame, x, label, said):
    """Error over x, a panel a problem: of a family that grows, the smallest and the largest."""
    problems = frame["scene"].unique()
    scenes, _ = fewer(first_and_last(problems, lambda scene: re.sub(r"[\d.e]+", "", scene)))
    fig, axes = panels(len(scenes), columns=3, height=1.9, sharey=True)
    for ax, scene in zip(axes, scenes):
        for relaxation, rows in frame[frame["scene"] == scene].groupby("relaxation", sort=False):
            curve(ax, rows, x, "error", relaxation, style(relaxation))
        ax.set(xscale="log", yscale="log", title=scene)
    fig.supxlabel(label, fontsize=8)
    fig.supylabel("error against the dense solution, relative", fontsize=8)
    shared_legend(fig, axes, columns=5)
    ends = frame.sort_values("sweep").groupby(["scene", "relaxation"], sort=False).tail(1)
    finding(fig, said, f"{share(len(least_work(frame, x)), len(ends))} runs reach {number(REACHED)}")
    footnote(fig, f"Drawn: {len(scenes)} of {counted(len(problems), 'problem')}. " + reasons_note(failed(ends, "error")))
    return fig


def least_work(frame, x):
    """The least work of each run that reaches the error."""
    return frame[frame["error"] <= REACHED].groupby(["scene", "relaxation"], sort=False)[x].min()


def ranking(frame, x, what):
    """In how many problems each relaxation is the first to reach the error, '' if none reaches it."""
    least = least_work(frame, x)
    if least.empty:
        return ""
    winners = least.groupby("scene").idxmin().map(lambda key: key[1]).value_counts()
    first = ", ".join(f"{name} in {count}" for name, count in winners.items())
    return f"{what} to {number(REACHED)}: {first} of {counted(frame['scene'].nunique(), 'problem')}"


@figure("inner_convergence", "sweeps", table="errors")
def sweeps(frame):
    """The sweeps of `direct` are factorisations, which no sweep of an iteration compares with."""
    frame = frame[frame["sweep"] > 0]
    return traces(frame, "sweep", "sweeps", ranking(frame[frame["relaxation"] != "direct"], "sweep", "Fewest sweeps of an iteration"))


@figure("inner_convergence", "seconds", table="errors")
def seconds(frame):
    frame = frame[frame["wall_s"] != 0]
    return traces(frame, "wall_s", "wall time (s)", ranking(frame, "wall_s", "Least time"))


@figure("inner_convergence", "rates", table="rates")
def rates(frame):
    """1 - rate, so that slow and very slow are told apart. Only iterations with one matrix have a rate; those of the others are
    bounds, or mean nothing, and stand in the table."""
    frame = frame[frame["relaxation"].isin(STATIONARY)]
    if frame.empty:
        return None
    frame = frame.assign(predicted=1 - frame["predicted_rate"], measured=1 - frame["measured_rate"])
    fig, (ax,) = panels(1, height=2.6)
    rows = good(frame, "predicted", "measured")
    for relaxation, group in rows.groupby("relaxation", sort=False):
        ax.plot(group["predicted"], group["measured"], label=relaxation, markerfacecolor="white",
                **style(relaxation) | {"linestyle": "none"})
    for relaxation, group in failed(frame, "predicted", "measured").groupby("relaxation", sort=False):
        draw_failed(ax, group, "predicted", "measured", style(relaxation))
    drawn = rows[["predicted", "measured"]].to_numpy()
    low = drawn[drawn > 0].min() if (drawn > 0).any() else 1e-3
    line = np.array([low / 2, 1.0])
    ax.plot(line, line, color=BLACK, linewidth=0.8)
    ax.text(line[-1], line[-1], "measured = predicted", fontsize=6.5, ha="right", va="bottom")
    ax.set(xscale="log", yscale="log", xlabel="1 - predicted rate (spectral radius)", ylabel="1 - measured rate, a sweep")
    shared_legend(fig, [ax], columns=3)
    off = abs(rows["measured_rate"] / rows["predicted_rate"] - 1)
    finding(fig, f"Gauss-Seidel and Jacobi contract as their spectral radii say, to {100 * off.max():.2g} % in "
            f"{share(len(rows), len(frame))} solved problems" if len(rows) else
            f"Gauss-Seidel and Jacobi solve none of {counted(len(frame), 'problem')}")
    footnote(fig, reasons_note(failed(frame, "predicted", "measured")))
    return fig
