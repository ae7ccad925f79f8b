"""Does damping take what its coefficient says, and nothing of rigid motion?"""

import numpy as np

from common import curve_points, draw_failed, figure, footnote, on_log, panels, shared_legend
from styles import BLACK, FALLBACK
from selecting import drawable, failed, good, reasons_note


def looks(frame):
    """A look for each integrator, in the order of the table."""
    return {name: {"color": color, "marker": marker, "linestyle": line}
            for name, (color, marker, line) in zip(dict.fromkeys(frame["integrator"]), [*FALLBACK, ("#777777", "*", "-")])}


@figure("damping", "decrements", table="decrements")
def decrements(frame):
    """The decrement's error against the integrator's own matrix, over the step, one panel a scene."""
    groups = list(frame.groupby("scene", sort=False))
    fig, axes = panels(len(groups), columns=2, height=2.4, sharey=True)
    for ax, (scene, rows) in zip(axes, groups):
        for integrator, look in looks(frame).items():
            points = rows[rows["integrator"] == integrator]
            fine = good(points, "error")
            ax.plot(fine["step_s"], on_log(fine["error"]), label=integrator, markerfacecolor="none",
                    **look | {"linestyle": "none"})
            draw_failed(ax, failed(points, "error"), "step_s", "error", look)
        ax.axhline(1e-8, color=BLACK, linewidth=0.8, linestyle=":")
        ax.set(xscale="log", yscale="log", title=scene)
    fig.supxlabel("step (s); 10 and 1000 sweeps at most", fontsize=8)
    fig.supylabel("|decrement/predicted - 1|", fontsize=8)
    shared_legend(fig, axes)
    footnote(fig, reasons_note(failed(frame, "error")))
    return fig


@figure("damping", "order", table="decrements")
def order(frame):
    """The decay rate's distance from c/(2 m) over the step, beside slopes of 1 and 2."""
    first = frame[(frame["scene"] == frame["scene"].iloc[0]) & (frame["max_sweeps"] == frame["max_sweeps"].max())]
    rows = first.assign(distance=abs(first["decay_per_s"] / first["expected_decay_per_s"] - 1))
    fig, (ax,) = panels(1, height=2.9)
    for integrator, look in looks(frame).items():
        curve_points(ax, rows[rows["integrator"] == integrator], "step_s", "distance", integrator, look)
    steps = np.array([rows["step_s"].min(), rows["step_s"].max()])
    for power, line in ((1, "--"), (2, ":")):
        ax.plot(steps, (10 * steps) ** power, color="#888888", linestyle=line, linewidth=0.8, label=f"(h w)^{power}")
    ax.set(xscale="log", yscale="log", xlabel="step (s)", ylabel="|decay rate/(c/2m) - 1|")
    shared_legend(fig, [ax])
    footnote(fig, reasons_note(failed(rows, "distance")))
    return fig


@figure("damping", "rotation", table="rotation")
def rotation(frame):
    """Energy of vibration of the spinning pair over time, with and without damping."""
    rows = frame[frame["scene"] == "vibrating"]
    fig, axes = panels(2, columns=2, height=2.6)
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
    footnote(fig, reasons_note(rows[rows["status"] != "ok"]))
    return fig
