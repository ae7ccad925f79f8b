"""What do the directions of constraints do to stability, constraints and energy, beside velocity time stepping?"""

import numpy as np

from common import curve_points, draw_failed, figure, footnote, panels, shared_legend
from styles import BLACK, BLUE, GREEN, ORANGE, PURPLE, RED, SKY
from selecting import failed, good, reasons_note, step_text

GREY = "#777777"
BLENDS = {0: (RED, "o"), 0.25: (ORANGE, "s"), 0.5: (GREEN, "^"), 0.75: (SKY, "D"), 1: (BLUE, "v")}
SHARES = {0: (BLACK, "P", ":"), 0.2: (GREY, "p", "--"), 1: (PURPLE, "*", "-.")}
TWIN = "symplectic_euler"  # has the numbers of a blend of 0 where all is hard


def look_of(row):
    """Label and look of a scheme: the blend of `position`, the stabilisation of `velocity`."""
    if row["family"] == "velocity":
        color, marker, line = SHARES.get(row["stabilisation"], (BLACK, ".", ":"))
        return f"velocity, stabilised {row['stabilisation']:g}", {"color": color, "marker": marker, "linestyle": line}
    color, marker = BLENDS.get(row["direction_blend"], (BLACK, "o"))
    name = "symplectic_euler" if row["integrator"] == TWIN else f"b = {row['direction_blend']:g}"
    return name, {"color": color, "marker": marker, "linestyle": "--" if row["integrator"] == TWIN else "-"}


def schemes(frame):
    """(label, look, rows) of every scheme."""
    keys = ["family", "integrator", "outer", "direction_blend", "stabilisation"]
    for _, rows in frame.groupby(keys, sort=False, dropna=False):
        yield (*look_of(rows.iloc[0]), rows)


@figure("direction", "largest_steps", table="largest_steps")
def largest_steps(frame):
    """One panel a scene, one line a scheme: the largest stable step, and the predicted one as a bar."""
    groups = list(frame.groupby("scene", sort=False))
    fig, axes = panels(len(groups), columns=2, height=2.7, sharey=True, sharex=True)
    for ax, (_, rows) in zip(axes, groups):
        names = []
        for place, (label, look, one) in enumerate(schemes(rows)):
            names.append(label if one["family"].iloc[0] == "velocity" else f"{label}, {one['outer'].iloc[0]}")
            one = one.assign(place=float(place))
            at = good(one, "largest_step_s")
            ax.plot(at["largest_step_s"], at["place"], **{"markerfacecolor": "white"} | look | {"linestyle": "none"})
            predicted = one["predicted_step_s"].iloc[0]
            if 0 < predicted < np.inf:
                ax.plot([predicted], [place], "|", color=BLACK, markersize=10, label="predicted")
            draw_failed(ax, failed(one, "largest_step_s"), "largest_step_s", "place", look)
        ax.set(xscale="log", xlim=(1e-3, 1), title=rows["scene"].iloc[0])
        ax.set_yticks(range(len(names)), names)
        ax.set_ylim(len(names) - 0.5, -0.5)
    fig.supxlabel("largest stable step (s)", fontsize=8)
    shared_legend(fig, axes)
    footnote(fig, reasons_note(failed(frame, "largest_step_s")))
    return fig


@figure("direction", "modes", table="modes")
def modes(frame):
    """What a step leaves of a mode's energy over the blend, measured and predicted."""
    fig, (ax,) = panels(1, height=2.6)
    blends = np.linspace(0, 1, 50)
    ax.plot(blends, 1 / (1 + blends), color=BLACK, linewidth=0.8, label="1/(1 + b), predicted")
    position = frame[frame["family"] == "position"]
    for (mode, rows), (color, marker) in zip(position.groupby("mode"), BLENDS.values()):
        points = good(rows, "measured_left")
        ax.plot(points["direction_blend"], points["measured_left"], color=color, marker=marker, linestyle="none",
                markerfacecolor="none", markersize=3 + 2 * list(BLENDS.values()).index((color, marker)), label=f"mode {mode:g}")
        bad = failed(rows, "measured_left")
        draw_failed(ax, bad.assign(direction_blend=bad["direction_blend"].clip(lower=1e-3)), "direction_blend", "measured_left",
                    {"color": color, "marker": marker})
    ax.set(xlabel="blend b of directions (0: begin of the step, 1: end)", ylabel="energy left by a step at h w = 1",
           ylim=(0, 1.1))
    shared_legend(fig, [ax])
    footnote(fig, reasons_note(failed(position, "measured_left")))
    return fig


@figure("direction", "energy", table="energy")
def energy(frame):
    """The pendulum's energy over time: all schemes, and those that keep it."""
    fig, axes = panels(2, columns=2, height=2.6)
    for label, look, rows in schemes(frame):
        if label == TWIN:
            continue
        rows = rows.sort_values("time_s")
        for ax in axes:
            ax.plot(rows["time_s"], rows["energy_j"], label=label, markevery=max(1, len(rows) // 8),
                    **{"markerfacecolor": "white"} | look)
        draw_failed(axes[0], failed(rows, "time_s").tail(1), "time_s", "energy_j",
                    {"color": look["color"], "marker": look["marker"]})
    axes[0].set(ylabel="energy (J); m g l = 9.81 J")
    axes[1].set(ylim=(-0.5, 0.5))
    fig.supxlabel(f"time (s), steps of {step_text(frame['step_s'].iloc[0])}", fontsize=8)
    shared_legend(fig, axes)
    footnote(fig, reasons_note(failed(frame, "time_s")))
    return fig


@figure("direction", "equal_work", table="equal_work")
def equal_work(frame):
    """Largest violation over row updates a simulated second, one panel a scene."""
    groups = list(frame.groupby("scene", sort=False))
    fig, axes = panels(len(groups), columns=2, height=2.5)
    for ax, (scene, rows) in zip(axes, groups):
        for label, look, points in schemes(rows):
            if label != TWIN:
                curve_points(ax, points, "row_updates_per_s", "error", label, look)
        ax.set(xscale="log", yscale="log", title=scene)
    fig.supxlabel("row updates a simulated second", fontsize=8)
    fig.supylabel("largest violation, of a link's length", fontsize=8)
    shared_legend(fig, axes)
    footnote(fig, reasons_note(failed(frame[frame["integrator"] != TWIN], "row_updates_per_s", "error")))
    return fig


CONTENDERS = {("velocity", "frozen"): ("directions of the step's begin", BLACK, "P"), ("position", "plain"): ("refreshed directions", RED, "o"),
              ("stiffness, one linearisation", "proximal"): ("stiffness in M, one linearisation", ORANGE, "s"),
              ("stiffness", "proximal"): ("stiffness in M, solved", GREEN, "^")}


@figure("direction", "contenders", table="contenders")
def contenders(frame):
    """The taut chain's largest energy, and the share of steps that miss, over the step in units of the explicit limit."""
    fig, (energy, missed) = panels(2, columns=2, height=2.6, sharex=True)
    frame = frame.assign(missed_share=frame["missed_steps"] / frame["steps"])
    for key, rows in frame.groupby(["family", "outer"], sort=False):
        label, color, marker = CONTENDERS[key]
        look = {"color": color, "marker": marker, "linestyle": "-"}
        curve_points(energy, rows.assign(status=rows["status"].replace("not_converged", "ok")), "of_explicit_limit", "energy_highest", label, look)
        rows = rows.sort_values("of_explicit_limit")
        if key[1] != "frozen":
            missed.plot(rows["of_explicit_limit"], rows["missed_share"], label=label, markerfacecolor="white", **look)
    energy.set(xscale="log", yscale="log", ylabel="largest energy over the first one")
    missed.set(xscale="log", ylim=(-0.05, 1.05), ylabel="share of steps that miss their tolerance")
    for ax in (energy, missed):
        ax.axvline(1, color=BLACK, linestyle="--", linewidth=0.6)
    fig.supxlabel("step over the explicit limit", fontsize=8)
    shared_legend(fig, [energy, missed], columns=2)
    footnote(fig, reasons_note(frame[frame["status"] == "diverged"]))
    return fig


@figure("direction", "contact", table="contact")
def contact(frame):
    """Largest overlap or stretch over work, a panel a scene, a line a scheme."""
    groups = list(frame.groupby("scene", sort=False))
    fig, axes = panels(len(groups), columns=3, height=2.4)
    for ax, (scene, rows) in zip(axes, groups):
        for label, look, one in schemes(rows):
            label = label if one["family"].iloc[0] == "velocity" else "refreshed directions"
            curve_points(ax, one, "row_updates_per_s", "error", label, look)
        ax.set(xscale="log", yscale="log", title=scene)
    fig.supxlabel("row updates a simulated second", fontsize=8)
    axes[0].set_ylabel("largest violation, relative")
    shared_legend(fig, axes)
    footnote(fig, reasons_note(failed(frame, "error")))
    return fig
