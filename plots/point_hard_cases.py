"""Which gates hold on the hard cases, and how far step and budget can be pushed?"""

import textwrap

import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap

from common import crossed, figure, footnote, panels, shared_legend
from styles import BLUE, GREEN, RED, style
from selecting import drawable, text_number

HOLDS, FAILS, SKIPPED = 1.0, 0.0, 0.5
UNSWEPT = "quasi-Newton, no sweeps"
LOOK = {"gauss_seidel": (BLUE, "o"), "direct": ("#000000", "D"), UNSWEPT: ("#777777", "s")}


def row_names(frame):
    """The scene, with the relaxation where the scene was tried with several."""
    several = frame.groupby("scene")["relaxation"].transform("nunique") > 1
    return frame["scene"].where(~several, frame["scene"] + ", " + frame["relaxation"])


@figure("point_hard_cases", "gates", table="gates")
@figure("contact_hard_cases", "gates", table="gates")
def gates(frame):
    """A matrix of cases and gates: measured values, green where the gate holds, red where not."""
    frame = frame.assign(row=row_names(frame))
    rows, columns = list(frame["row"].unique()), list(frame["gate"].unique())
    colours = np.full((len(rows), len(columns)), np.nan)
    fig, (ax,) = panels(1, height=0.17 * len(rows) + 0.8)
    fig.set_figwidth(7.2)
    for _, cell in frame.iterrows():
        i, j = rows.index(cell["row"]), columns.index(cell["gate"])
        skipped = cell["status"] == "skipped"
        colours[i, j] = SKIPPED if skipped else HOLDS if cell["holds"] == 1 else FAILS
        text = "skipped" if skipped else text_number(cell["measured"]) if np.isfinite(cell["measured"]) else "none"
        ax.text(j, i, text, ha="center", va="center", fontsize=5, color="white" if colours[i, j] == FAILS else "black")
    ax.imshow(colours, cmap=ListedColormap([RED, "#dddddd", "#a8ddb5"]), norm=BoundaryNorm([-0.25, 0.25, 0.75, 1.25], 3),
              aspect="auto")
    bounds = frame.groupby("gate", sort=False)["bound"].first()
    ax.set_xticks(range(len(columns)), [f"{folded(name)}\n≤ {text_number(bounds[name])}" for name in columns], fontsize=6)
    ax.set_yticks(range(len(rows)), [name + unsolved_mark(frame[frame["row"] == name]) for name in rows], fontsize=5.5)
    ax.tick_params(top=True, labeltop=True, bottom=False, labelbottom=False)
    ax.grid(False)
    runs = frame[frame["status"] != "skipped"].drop_duplicates("row")
    skipped = frame[frame["status"] == "skipped"]["reason"].map(lambda reason: reason.partition(" in ")[0]).value_counts()
    unsolved = f"{(runs['status'] != 'ok').sum()} of {len(runs)}"
    footnote(fig, f"Red: the gate fails. * some steps say that they are not solved, in {unsolved} simulations. Skipped: " + ("; ".join(f"{count} x {reason}" for reason, count in skipped.items()) or "none") + ".")
    return fig


def folded(name):
    """A gate's name in lines of a column's width."""
    return textwrap.fill(name.replace("_", "_ "), 8, break_long_words=False).replace("_ ", "_")


def unsolved_mark(rows):
    return "" if rows["status"].isin(["ok", "skipped"]).all() else " *"


@figure("point_hard_cases", "frontier", table="frontier")
@figure("contact_hard_cases", "frontier", table="frontier")
def frontier(frame):
    """Left the largest step, right the fewest sweeps at which all gates hold; crossed where none does."""
    frame = frame.assign(row=row_names(frame))
    rows = list(frame["row"].unique())
    fig, axes = panels(2, columns=2, height=0.15 * len(rows) + 0.5, sharey=True)
    fig.set_figwidth(7.2)
    swept = frame["relaxation"].where(frame["fewest_sweeps"] != 0, UNSWEPT)
    for relaxation, group in frame.groupby(swept, sort=False):
        color, marker = LOOK.get(relaxation) or (style(relaxation)["color"], style(relaxation)["marker"])
        points(axes[0], group, rows, "largest_step_s", color, marker, f"{relaxation}: gates hold")
        if "largest_solved_step_s" in group:
            points(axes[0], group, rows, "largest_solved_step_s", GREEN, "|", "and every step is solved")
        points(axes[1], group, rows, "fewest_sweeps", color, marker, f"{relaxation}: gates hold")
    axes[0].set(xscale="log", xlabel="largest step (s)")
    axes[1].set(xscale="symlog", xlabel="fewest sweeps an outer iteration", xlim=(-0.5, 2000))
    axes[0].set_yticks(range(len(rows)), rows, fontsize=5.5)
    axes[0].set_ylim(len(rows) - 0.5, -0.5)
    shared_legend(fig, axes[:1])
    unswept = " No sweeps: every row is compliant." if (swept == UNSWEPT).any() else ""
    footnote(fig, "Crossed: a gate fails already at the mildest setting." + unswept)
    return fig


def points(ax, group, rows, column, color, marker, label):
    places = np.array([rows.index(name) for name in group["row"]])
    there = drawable(group, [column]).to_numpy()
    ax.plot(group[column][there], places[there], marker, color=color, label=label, markersize=4, markerfacecolor="none")
    if column != "largest_solved_step_s":
        for place in places[~there]:
            crossed(ax, 0.02, place, {"color": color, "marker": marker}, ax.get_yaxis_transform())
