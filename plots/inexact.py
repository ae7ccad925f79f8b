"""What is saved where linear problems are solved no further than the step can use?"""

from common import curve_points, figure, footnote, panels, shared_legend
from styles import BLACK, BLUE, GREEN, ORANGE, RED
from selecting import failed, reasons_note, step_text

LOOKS = ((BLUE, "o"), (ORANGE, "s"), (GREEN, "^"), (RED, "D"), (BLACK, "P"))


@figure("inexact", "row_updates", table="solves")
def row_updates(frame):
    """Row updates over the mass ratio, one colour a step: filled and solid inexact, open and dashed exact."""
    groups = list(frame.groupby("relaxation", sort=False))
    fig, axes = panels(len(groups), columns=2, height=2.6)
    loosest = frame["inner_tolerance"].max()
    for ax, (relaxation, rows) in zip(axes, groups):
        for k, (step, cells) in enumerate(rows.groupby("step_s")):
            color, marker = LOOKS[k % len(LOOKS)]
            for share, points in cells.groupby("inner_tolerance", sort=False):
                inexact = share == loosest
                look = {"color": color, "marker": marker, "linestyle": "-" if inexact else "--",
                        "markerfacecolor": color if inexact else "white"}
                label = f"h = {step_text(step)}, {'inexact' if inexact else 'exact'}"
                curve_points(ax, points, "mass_ratio", "row_updates", label, look)
        ax.set(xscale="log", yscale="log", title=relaxation)
    fig.supxlabel("mass ratio, tip to other nodes", fontsize=8)
    fig.supylabel("row updates to the step's tolerance", fontsize=8)
    shared_legend(fig, axes, columns=4)
    footnote(fig, reasons_note(failed(frame, "row_updates")))
    return fig
