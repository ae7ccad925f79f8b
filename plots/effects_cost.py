"""What does each effect cost, and does the cost grow with the rows?"""

import numpy as np

from common import curve_points, figure, footnote, on_log, panels
from styles import BLACK, BLUE, style
from selecting import failed, good, reasons_note, text_number


@figure("effects_cost", "scaling", table="scaling")
def scaling(frame):
    """Time of a sweep over the number of rows, against a line of slope 1."""
    scenes = list(frame["scene"].unique())
    fig, axes = panels(len(scenes), columns=2, height=2.5)
    for ax, scene in zip(axes, scenes):
        here = frame[frame["scene"] == scene]
        for relaxation, points in here.groupby("relaxation", sort=False):
            exponent = points["exponent"].dropna()
            label = f"{relaxation}, exponent {exponent.iloc[-1]:.2f}" if len(exponent) else relaxation
            curve_points(ax, points, "rows", "wall_s_per_sweep", label, style(relaxation))
        slope_one(ax, good(here, "rows", "wall_s_per_sweep"))
        ax.set(xscale="log", yscale="log", title=scene, xlabel="rows", ylabel="wall time per sweep (s)")
        ax.legend(loc="upper left")
    footnote(fig, reasons_note(failed(frame, "rows", "wall_s_per_sweep")))
    return fig


def slope_one(ax, rows):
    if len(rows) > 1:
        x = np.array([rows["rows"].min(), rows["rows"].max()])
        y = rows["wall_s_per_sweep"].min() / 2 * x / x[0]
        ax.plot(x, on_log(y), ":", color=BLACK, linewidth=0.8, label="slope 1")


@figure("effects_cost", "bytes", table="costs")
def bytes_per_row(frame):
    """Memory of an effect's rows."""
    return bars(frame.assign(value=frame["bytes"] / frame["rows"]), "bytes per row")


@figure("effects_cost", "seconds", table="costs")
def seconds_per_row(frame):
    """Time an effect's rows took in one step of the run."""
    return bars(frame.assign(value=frame["wall_s_per_step"] / frame["rows"] * 1e6), "wall time per row and step (µs)")


def bars(frame, label):
    frame = frame[frame["rows"] > 0]  # what is outside the effects has no rows
    rows = good(frame, "value").assign(name=lambda rows: rows["effect"] + ", " + rows["scene"])
    bad = failed(frame, "value")
    fig, (ax,) = panels(1, height=0.2 * max(len(rows), 2) + 0.6)
    ax.barh(rows["name"], rows["value"], color=BLUE, height=0.6)
    for i, value in enumerate(rows["value"]):
        ax.text(value, i, " " + text_number(value), va="center", fontsize=7)
    ax.invert_yaxis()
    ax.grid(axis="y", visible=False)
    ax.set(xlabel=label)
    missing = ", ".join(bad["effect"] + " in " + bad["scene"])
    footnote(fig, f"Not drawn, no number: {missing}" if missing else "")
    return fig
