"""Where does each outer iteration find the step, and does the solver predict where `plain` converges?"""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.colors import LogNorm

from common import curve, draw_failed, figure, footnote, on_log, panels, shared_legend
from finding import MOST_PANELS, fewer, finding, guide
from styles import BLACK, BLUE, RED, style
from outer_convergence import edges
from reading import CONTRACTING, LARGEST
from selecting import cost_ratios, failed, good, reasons_note, step_text, text_number
from wording import counted, number, share

MARKS = {"not_converged": "x", "diverged": "^", "skipped": "_", "ok": "o"}  # of a cell that is not solved, by status
MEANING = {"ok": "ok, but farther than 1e-8"}
ALLOWED = 1e-10  # error of a solved step, as the verdicts ask
DEARER = 1.2  # what auto may cost of plain, as the verdicts ask
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
    """Errors over stiffness, a panel a solid, a colour a method, a line a step."""
    groups, left = fewer(frame.groupby("scene", sort=False))
    if not groups:
        return None
    fig, axes = panels(len(groups), columns=2, height=2.1, sharex=True, sharey=True)
    steps = sorted(frame["step_s"].unique())
    for ax, (scene, solid) in zip(axes, groups):
        for (outer, relaxation, step), rows in solid.groupby(["outer", "relaxation", "step_s"], sort=False):
            look = style(relaxation) | {"linestyle": STEP_LINES[steps.index(step) % len(STEP_LINES)]}
            label = f"{outer}, {relaxation}" if step == steps[0] else "_"
            curve(ax, rows, "young_pa", "error_final", label, look)
            draw_failed(ax, failed(rows, "error_final"), "young_pa", "error_final", look)
        guide(ax, ALLOWED, "1e-10")
        ax.set(xscale="log", yscale="log", title=scene)
    fig.supxlabel(AXES["young_pa"], fontsize=8)
    fig.supylabel("error against Newton", fontsize=8)
    shared_legend(fig, axes, columns=2)
    near = good(frame, "error_final")
    near = near[near["error_final"] <= ALLOWED]
    finding(fig, "To 1e-10 of Newton's step come " + ", ".join(
        f"{outer} with {relaxation} {share(near.index.isin(rows.index).sum(), len(rows))}"
        for (outer, relaxation), rows in frame.groupby(["outer", "relaxation"], sort=False)))
    lines = ", ".join(f"{name} {step_text(step)}" for name, step in zip(("solid", "dashed", "dotted"), steps))
    footnote(fig, f"Steps: {lines}. Crossed: not ok. {left}" + reasons_note(failed(frame, "error_final")))
    return fig


def maps(frame, value):
    """A panel for each method that finds a step; the cells' colour and number are iterations, a mark stands where it does
    not. Methods that find none are named in the title alone."""
    found = {key: (len(rows) - len(unsolved(rows)), rows) for key, rows in frame.groupby(["outer", "memory"], sort=False)}
    if not found:
        return None
    cells = max(len(rows) for _, rows in found.values())
    ranked = sorted(found, key=lambda key: -found[key][0])
    chosen = [key for key in found if key in ranked[:MOST_PANELS] and (found[key][0] or key == ranked[0])]
    fig, axes = panels(len(chosen), columns=3, height=1.75, sharex=True, sharey=True)
    most = max(10, frame["iterations"].where(frame["iterations"] <= LARGEST).max(skipna=True) or 0)
    for ax, key in zip(axes, chosen):
        solved, rows = found[key]
        mesh = map_panel(ax, rows, value, most)
        ax.set_title(f"{method_name(*key)}: {share(solved, len(rows))}")
    fig.supxlabel("step (s)", fontsize=8)
    fig.supylabel(AXES[value], fontsize=8)
    fig.colorbar(mesh, ax=axes, label="outer iterations to 1e-8", extend="max")
    drawn = pd.concat([found[key][1] for key in chosen])
    met = [status for status in MARKS if unsolved(drawn)["status"].eq(status).any()]
    handles = [plt.Line2D([], [], color=BLACK, marker=MARKS[status], linestyle="", markerfacecolor="none") for status in met]
    labels = [MEANING.get(status, status) for status in met]
    if chosen[0][0] == "plain" and draw_limit(axes[0], frame, value):
        handles.append(plt.Line2D([], [], color=RED, linestyle="--"))
        labels.append("predicted contraction of plain = 1")
    fig.legend(handles, labels, loc="upper center", bbox_to_anchor=(0.5, 0), ncol=5)
    counts = [f"{method_name(*key)} {found[key][0]}" for key in ranked]
    finding(fig, f"Of {counted(cells, 'cell')} of {frame['scene'].iloc[0]} the step is found in: " + ", ".join(counts))
    hidden = [method_name(*key) for key in found if key not in chosen]
    footnote(fig, ("Not drawn: " + ", ".join(hidden) + ". " if hidden else "") + reasons_note(failed(frame, "iterations")))
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
    fig, (ax,) = panels(1, height=2.7)
    rows = good(frame, "predicted_rate", "predicted_contraction")
    for converges, color, marker, label in ((True, BLUE, "o", "plain converges"), (False, RED, "s", "plain does not converge")):
        group = rows[rows["behaviour"].isin(CONTRACTING) == converges]
        ax.plot(on_log(group["predicted_rate"]), on_log(group["predicted_contraction"]), marker, color=color, label=label,
                markerfacecolor=color if converges else "white")
    line = np.array([0.1, 1000.0])
    ax.plot(line, line, color=BLACK, linewidth=0.5, label="both are equal")
    ax.set(xscale="log", yscale="log", xlabel="dense spectral radius", ylabel="solver's predicted contraction")
    guide(ax, 1, "radius = 1", horizontal=False)
    guide(ax, 1)
    agree = (frame["predicted_contraction"] < 1) == frame["behaviour"].isin(CONTRACTING)
    finding(fig, f"In {share((agree & frame['predicted_contraction'].notna()).sum(), len(frame))} cells of the chain the solver "
            "predicts rightly whether plain converges")
    fig.legend(loc="upper center", bbox_to_anchor=(0.5, 0), ncol=3)
    missing = len(frame) - len(rows)
    footnote(fig, f"{missing} cells without a prediction are not drawn." if missing else "")
    return fig


@figure("stability_map", "cost", table="cost")
def cost(frame):
    """What auto costs of plain's cost, one panel a map, one mark a step and relaxation."""
    ratios = cost_ratios(frame)
    groups, left = fewer(ratios.groupby("scene", sort=False))
    if not groups:
        return None
    fig, axes = panels(len(groups), columns=3, height=2.4, sharey=True)
    for ax, (scene, cells) in zip(axes, groups):
        for relaxation, rows in cells.groupby("relaxation", sort=False):
            look = style(relaxation) | {"linestyle": "none", "markerfacecolor": "none"}
            shown = good(rows, "ratio")
            ax.plot(shown["value"], shown["ratio"], label=relaxation, **look)
            draw_failed(ax, failed(rows, "ratio"), "value", "ratio", look)
        guide(ax, 1, linestyle="-")
        guide(ax, DEARER, f"{DEARER:g}: allowed")
        parameter = cells["parameter"].iloc[0]
        ax.set(xscale="log", yscale="log", title=f"{scene}, {'wall time' if cells['timed'].all() else 'row updates'}",
               xlabel=AXES.get(parameter, parameter))
    axes[0].set_ylabel("cost of auto over that of plain")
    shared_legend(fig, axes, columns=5)
    solved = good(ratios, "ratio")
    unsolved_by_plain = (frame["outer"].eq("plain") & frame["status"].ne("ok")).sum()
    finding(fig, f"auto costs at most {DEARER:g} times what plain does in {share((solved['ratio'] <= DEARER).sum(), len(ratios))} "
            "runs that plain solves" + (f", {number(solved['ratio'].min())} to {number(solved['ratio'].max())} times" if len(solved)
                                        else ""))
    footnote(fig, f"{unsolved_by_plain} runs that plain does not solve are left out. {left}" + reasons_note(failed(ratios, "ratio")))
    return fig
