"""Where does each outer iteration find the step, and does the solver predict where `plain` converges?"""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LogNorm

from common import curve, draw_failed, figure, footnote, on_log, panels, shared_legend
from styles import BLACK, BLUE, RED, style
from outer_convergence import edges
from reading import CONTRACTING, LARGEST
from selecting import cost_ratios, failed, good, reasons_note, step_text, text_number

MARKS = {"not_converged": "x", "diverged": "^", "skipped": "_", "ok": "o"}  # of a cell that is not solved, by status
MEANING = {"ok": "ok, but farther than 1e-8"}
STEP_LINES = ("-", "--", ":")
AXES = {"mass_ratio": "mass ratio, tip to other nodes", "young_pa": "Young's modulus (Pa)"}


def method_name(outer, memory):
    return f"{outer}, not accelerated" if outer == "proximal" and memory == 0 else outer


@figure("stability_map", "chain", table="chain20")
def chain(frame):
    return maps(frame, "mass_ratio")


@figure("stability_map", "rods", table="rods10")
def rods(frame):
    return maps(frame, "mass_ratio")


@figure("stability_map", "cantilever", table="cantilever")
def cantilever(frame):
    return maps(frame, "young_pa")


@figure("stability_map", "cantilevers", table="cantilevers")
def cantilevers(frame):
    """Errors over stiffness, a panel a solid, a line a method and step."""
    groups = list(frame.groupby("scene", sort=False))
    fig, axes = panels(len(groups), columns=2, height=2.1, sharex=True, sharey=True)
    for ax, (scene, solid) in zip(axes, groups):
        for (outer, relaxation, step), rows in solid.groupby(["outer", "relaxation", "step_s"], sort=False):
            look = style(relaxation) | {"linestyle": STEP_LINES[sorted(solid["step_s"].unique()).index(step) % len(STEP_LINES)]}
            curve(ax, rows, "young_pa", "error_final", f"{outer}, {relaxation}, {step_text(step)}", look)
            draw_failed(ax, failed(rows, "error_final"), "young_pa", "error_final", look)
        ax.axhline(1e-10, color=BLACK, linewidth=0.6, linestyle="--")
        ax.set(xscale="log", yscale="log", title=scene)
    fig.supxlabel(AXES["young_pa"], fontsize=8)
    fig.supylabel("error against Newton", fontsize=8)
    shared_legend(fig, axes, columns=2)
    footnote(fig, "Crossed: not ok. " + reasons_note(failed(frame, "error_final")))
    return fig


def maps(frame, value):
    """A panel for each method; the cells' colour and number are iterations, a mark stands where it does not solve."""
    chosen = list(frame.groupby(["outer", "memory"], sort=False))
    fig, axes = panels(len(chosen), columns=4, width=7.5, height=1.95, sharex=True, sharey=True)
    most = max(10, frame["iterations"].where(frame["iterations"] <= LARGEST).max(skipna=True) or 0)
    for ax, ((outer, memory), rows) in zip(axes, chosen):
        mesh = map_panel(ax, rows, value, most)
        ax.set_title(method_name(outer, memory))
    fig.supxlabel("step (s)", fontsize=8)
    fig.supylabel(AXES[value], fontsize=8)
    fig.colorbar(mesh, ax=axes, label="outer iterations to an error of 1e-8", extend="max")
    met = [status for status in MARKS if unsolved(frame)["status"].eq(status).any()]
    handles = [plt.Line2D([], [], color=BLACK, marker=MARKS[status], linestyle="", markerfacecolor="none") for status in met]
    labels = [MEANING.get(status, status) for status in met]
    if draw_limit(axes[0], frame, value):
        handles.append(plt.Line2D([], [], color=RED, linestyle="--"))
        labels.append("predicted contraction of plain = 1")
    fig.legend(handles, labels, loc="upper center", bbox_to_anchor=(0.5, 0), ncol=5)
    footnote(fig, f"{frame['scene'].iloc[0]}, error against Newton. " + reasons_note(failed(frame, "iterations")))
    return fig


def unsolved(rows):
    return rows[~(rows["iterations"] <= LARGEST)]


def map_panel(ax, rows, value, most):
    counts = rows.pivot_table("iterations", value, "step_s", dropna=False)
    x, y = counts.columns.to_numpy(), counts.index.to_numpy()
    counts = counts.where(counts <= LARGEST).to_numpy()
    mesh = ax.pcolormesh(edges(x), edges(y), np.maximum(counts, 1), norm=LogNorm(1, most), cmap="cividis")
    ax.set(xscale="log", yscale="log", facecolor="#dddddd")
    ax.set_xticks(x, [step_text(step).removesuffix(" s") for step in x], rotation=90)
    ax.set_yticks(y, [text_number(number) for number in y])
    ax.minorticks_off()
    ax.grid(False)
    for (i, j), count in np.ndenumerate(counts):
        if np.isfinite(count):
            ax.text(x[j], y[i], f"{count:.0f}", ha="center", va="center", fontsize=5.5,
                    color="white" if count < most ** 0.55 else BLACK)
    for status, bad in unsolved(rows).groupby("status"):
        ax.plot(bad["step_s"], bad[value], MARKS[status], color=BLACK, markersize=4, markeredgewidth=0.8, markerfacecolor="none")
    return mesh


def draw_limit(ax, frame, value):
    """The line where the solver predicts that plain stops converging, by an iteration that solves by the same rows; false
    if it does not run through the map."""
    rows = frame[(frame["outer"] == "proximal") & (frame["memory"] > 0)]
    predicted = rows.pivot_table("predicted_contraction", value, "step_s", dropna=False)
    known = predicted.where((predicted > 0) & (predicted <= LARGEST))
    crosses = min(known.shape) > 1 and (known < 1).any(axis=None) and (known > 1).any(axis=None)
    if crosses:
        ax.contour(known.columns, known.index, np.log(known), levels=[0.0], colors=RED, linestyles="--", linewidths=1.2)
    return crosses


@figure("stability_map", "predictions", table="predictions")
def predictions(frame):
    """The solver's own prediction against the dense spectral radius, filled where plain converges."""
    fig, (ax,) = panels(1, height=2.9)
    rows = good(frame, "predicted_rate", "predicted_contraction")
    for converges, color, marker, label in ((True, BLUE, "o", "plain converges"), (False, RED, "s", "plain does not converge")):
        group = rows[rows["behaviour"].isin(CONTRACTING) == converges]
        ax.plot(on_log(group["predicted_rate"]), on_log(group["predicted_contraction"]), marker, color=color, label=label,
                markerfacecolor=color if converges else "white")
    line = np.array([0.1, 1000.0])
    ax.plot(line, line, color=BLACK, linewidth=0.5, label="both are equal")
    ax.axvline(1, color=BLACK, linestyle="--", linewidth=0.8)
    ax.axhline(1, color=BLACK, linestyle="--", linewidth=0.8)
    ax.set(xscale="log", yscale="log", xlabel="dense spectral radius", ylabel="solver's predicted contraction",
           title="Swinging chain, every cell of the map")
    fig.legend(loc="upper center", bbox_to_anchor=(0.5, 0), ncol=3)
    missing = len(frame) - len(rows)
    footnote(fig, f"{missing} cells without a prediction are not drawn." if missing else "")
    return fig


@figure("stability_map", "cost", table="cost")
def cost(frame):
    """What auto costs of plain's cost, one panel a map, one mark a step and relaxation."""
    ratios = cost_ratios(frame)
    groups = list(ratios.groupby("scene", sort=False))
    fig, axes = panels(len(groups), columns=2, height=2.4)
    for ax, (scene, cells) in zip(axes, groups):
        for relaxation, rows in cells.groupby("relaxation", sort=False):
            look = style(relaxation) | {"linestyle": "none", "markerfacecolor": "none"}
            shown = good(rows, "ratio")
            ax.plot(shown["value"], shown["ratio"], label=relaxation, **look)
            draw_failed(ax, failed(rows, "ratio"), "value", "ratio", look)
        for level, line in ((1, "-"), (1.2, "--")):
            ax.axhline(level, color=BLACK, linewidth=0.8, linestyle=line, label=f"{level:g} times plain's")
        parameter = cells["parameter"].iloc[0]
        ax.set(xscale="log", yscale="log", title=scene, xlabel=AXES.get(parameter, parameter),
               ylabel=f"{'wall time' if cells['timed'].all() else 'row updates'}, auto over plain")
    shared_legend(fig, axes, columns=5)
    unsolved_by_plain = (frame["outer"].eq("plain") & frame["status"].ne("ok")).sum()
    footnote(fig, f"{unsolved_by_plain} runs that plain does not solve are left out. " + reasons_note(failed(ratios, "ratio")))
    return fig
