"""How fast does each relaxation solve the linearised problem?"""

import numpy as np

from common import curve, draw_failed, figure, footnote, panels, shared_legend
from styles import BLACK, style
from selecting import failed, good, reasons_note


def traces(frame, x, label):
    scenes = list(frame["scene"].unique())
    fig, axes = panels(len(scenes), columns=3, height=2.1)
    for ax, scene in zip(axes, scenes):
        for relaxation, rows in frame[frame["scene"] == scene].groupby("relaxation", sort=False):
            curve(ax, rows, x, "error", relaxation, style(relaxation))
        ax.set(xscale="log", yscale="log", title=scene)
    fig.supxlabel(label, fontsize=8)
    fig.supylabel("error against the dense solution, relative", fontsize=8)
    shared_legend(fig, axes)
    ends = frame.sort_values("sweep").groupby(["scene", "relaxation"], sort=False).tail(1)
    footnote(fig, reasons_note(failed(ends, "error")))
    return fig


@figure("inner_convergence", "sweeps", table="errors")
def sweeps(frame):
    return traces(frame, "sweep", "sweeps")


@figure("inner_convergence", "seconds", table="errors")
def seconds(frame):
    return traces(frame[frame["wall_s"] != 0], "wall_s", "wall time (s)")


@figure("inner_convergence", "rates", table="rates")
def rates(frame):
    """1 - rate, so that slow and very slow are told apart; above the line is faster than predicted. The prediction of
    nesterov_jacobi is a bound, and direct, which needs no second sweep, has no rate."""
    frame = frame[frame["relaxation"] != "direct"]
    frame = frame.assign(predicted=1 - frame["predicted_rate"], measured=1 - frame["measured_rate"])
    fig, (ax,) = panels(1, height=2.9)
    rows = good(frame, "predicted", "measured")
    for relaxation, group in rows.groupby("relaxation", sort=False):
        ax.plot(group["predicted"], group["measured"], label=relaxation, markerfacecolor="white",
                **style(relaxation) | {"linestyle": "none"})
    for relaxation, group in failed(frame, "predicted", "measured").groupby("relaxation", sort=False):
        draw_failed(ax, group, "predicted", "measured", style(relaxation))
    drawn = rows[["predicted", "measured"]].to_numpy()
    low = drawn[drawn > 0].min() if (drawn > 0).any() else 1e-3
    line = np.array([low / 2, 1.0])
    ax.plot(line, line, color=BLACK, linewidth=0.8, label="measured = predicted")
    ax.set(xscale="log", yscale="log", xlabel="1 - predicted rate", ylabel="1 - measured rate",
           title="Linear rate per sweep, error against the dense solution")
    shared_legend(fig, [ax], columns=3)
    footnote(fig, reasons_note(failed(frame, "predicted", "measured")))
    return fig
