"""Does damping take what its coefficient says, and nothing of rigid motion?"""

import numpy as np

from common import curve_points, draw_failed, figure, footnote, on_log, panels, shared_legend
from finding import MOST_SERIES, fewer, finding, guide
from styles import FALLBACK
from selecting import drawable, failed, good, reasons_note
from wording import counted, number, share, span

ALLOWED = 1e-8  # of the decrement, as the verdicts ask


def looks(frame):
    """A look for each integrator, in the order of the table, at most seven: without the one that is implicit Euler again."""
    names = list(dict.fromkeys(frame["integrator"]))
    if len(names) > MOST_SERIES:
        names = [name for name in names if name != "newmark 1.00"][:MOST_SERIES]
    return {name: {"color": color, "marker": marker, "linestyle": line} for name, (color, marker, line) in zip(names, FALLBACK)}


def others(frame):
    left = [name for name in frame["integrator"].unique() if name not in looks(frame)]
    return f"In the table alone: {', '.join(left)}. " if left else ""


@figure("damping", "decrements", table="decrements")
def decrements(frame):
    """The decrement's error against the integrator's own matrix, over the step, one panel a scene."""
    groups, left = fewer(frame.groupby("scene", sort=False))
    if not groups:
        return None
    fig, axes = panels(len(groups), columns=2, height=1.8, sharex=True, sharey=True)
    for ax, (scene, rows) in zip(axes, groups):
        for integrator, look in looks(frame).items():
            points = rows[rows["integrator"] == integrator]
            fine = good(points, "error")
            ax.plot(fine["step_s"], on_log(fine["error"]), label=integrator, markerfacecolor="none",
                    **look | {"linestyle": "none"})
            draw_failed(ax, failed(points, "error"), "step_s", "error", look)
        guide(ax, ALLOWED, f"allowed: {number(ALLOWED)}")
        ax.set(xscale="log", yscale="log", title=scene)
    fig.supxlabel("step (s)", fontsize=8)
    fig.supylabel("|decrement/predicted - 1|", fontsize=8)
    shared_legend(fig, axes)
    near = good(frame, "error")["error"] <= ALLOWED
    finding(fig, f"{share(near.sum(), len(frame))} decrements are those of the integrator's matrix, to {number(ALLOWED)}, with at "
            f"most {span(frame['max_sweeps'])} sweeps")
    footnote(fig, left + others(frame) + reasons_note(failed(frame, "error")))
    return fig


@figure("damping", "order", table="decrements")
def order(frame):
    """The decay rate's distance from c/(2 m) over the step, beside slopes of 1 and 2."""
    first = frame[(frame["scene"] == frame["scene"].iloc[0]) & (frame["max_sweeps"] == frame["max_sweeps"].max())]
    rows = first.assign(distance=abs(first["decay_per_s"] / first["expected_decay_per_s"] - 1))
    fig, (ax,) = panels(1, height=2.4)
    for integrator, look in looks(frame).items():
        curve_points(ax, rows[rows["integrator"] == integrator], "step_s", "distance", integrator, look)
    steps = np.array([rows["step_s"].min(), rows["step_s"].max()])
    for power, line in ((1, "--"), (2, ":")):
        ax.plot(steps, (10 * steps) ** power, color="#888888", linestyle=line, linewidth=0.8)
        ax.text(steps[-1] * 1.05, (10 * steps[-1]) ** power, f"(h w)^{power}", fontsize=6.5, color="#888888", va="center")
    ax.set(xscale="log", yscale="log", xlabel="step (s)", ylabel="|decay rate/(c/2m) - 1|")
    shared_legend(fig, [ax])
    finest = good(rows[rows["step_s"] == rows["step_s"].min()], "distance")
    finding(fig, f"At {number(rows['step_s'].min())} s the decay rate is off by {number(finest['distance'].min())} "
            f"({finest.loc[finest['distance'].idxmin(), 'integrator']}) to {number(finest['distance'].max())} "
            f"({finest.loc[finest['distance'].idxmax(), 'integrator']}) of c/2m" if len(finest) else
            f"None of {counted(len(rows), 'run')} ended well at the smallest step")
    footnote(fig, others(frame) + reasons_note(failed(rows, "distance")))
    return fig


@figure("damping", "rotation", table="rotation")
def rotation(frame):
    """Energy of vibration of the spinning pair over time, with and without damping."""
    rows = frame[frame["scene"] == "vibrating"]
    if rows.empty:
        return None
    fig, axes = panels(2, columns=2, height=2.4, sharey=True)
    for damped, ax in zip((True, False), axes):
        for integrator, look in looks(frame).items():
            one = rows[(rows["integrator"] == integrator) & ((rows["retardation_s"] > 0) == damped)].sort_values("time_s")
            shown = one[drawable(one, ["time_s", "vibration_j"])]
            ax.plot(shown["time_s"], on_log(shown["vibration_j"]), label=integrator, markevery=max(1, len(shown) // 8),
                    **{"markerfacecolor": "white"} | look)
            draw_failed(ax, one[one["status"] != "ok"].tail(1), "time_s", "vibration_j", look)
        ax.set(yscale="log", title="damped" if damped else "not damped")
    axes[0].set_ylabel("energy beside the steady rotation's (J)")
    fig.supxlabel("time (s)", fontsize=8)
    shared_legend(fig, axes)
    left = {damped: left_of(rows[(rows["retardation_s"] > 0) == damped]) for damped in (True, False)}
    finding(fig, f"Of the vibration's energy damping leaves {span(left[True])}, no damping {span(left[False])}")
    footnote(fig, others(rows) + reasons_note(rows[rows["status"] != "ok"]))
    return fig


def left_of(rows):
    """The part of the vibration's energy that each run has at its end."""
    runs = rows.sort_values("time_s").groupby("integrator", sort=False)["vibration_j"]
    return runs.last() / runs.first()
