"""How accurately do joints carry mechanisms, and what does a chain of bodies cost?"""

import numpy as np
from matplotlib.ticker import NullFormatter

from common import (BLACK, curve_points, figure, footnote, on_log, order_triangles, panels, shared_legend, slope_triangle,
                    style, ticks)
from reading import failed, good, reasons_note, rule_names


@figure("joints", "accuracy", table="accuracy")
def accuracy(frame):
    """Error at the end over the step, one column a mechanism, and below it the largest error of a joint in any step."""
    mechanisms = list(frame.groupby("mechanism", sort=False))
    fig, axes = panels(2 * len(mechanisms), columns=len(mechanisms), width=7.5, height=1.9, sharex="col")
    for (mechanism, here), above, below in zip(mechanisms, axes, axes[len(mechanisms):]):
        for name, rows in here.assign(rule=rule_names(here)).groupby("rule", sort=False):
            curve_points(above, rows, "step_s", "error", name, style(name))
            curve_points(below, rows, "step_s", "joint_error", name, style(name))
        if falls(good(here, "error")):
            order_triangles(above, here, "step_s", "error")
        above.set_title(mechanism)
        for ax in (above, below):
            ax.set(xscale="log", yscale="log")
            ax.tick_params(axis="y", labelsize=6, pad=1)
            show_whole_decades(ax)
        ticks(below, [here["step_s"].min(), here["step_s"].max()])
    axes[0].set_ylabel("error at the end,\nrelative")
    axes[len(mechanisms)].set_ylabel("largest error of a joint\n(m or rad)")
    fig.supxlabel("step (s)", fontsize=8)
    shared_legend(fig, axes)
    footnote(fig, reasons_note(failed(frame, "error", "joint_error")))
    return fig


def show_whole_decades(ax):
    """Limits of y at powers of ten: two labels at least, however near to each other the values are."""
    low, high = ax.dataLim.intervaly
    if 0 < low <= high:
        ax.set_ylim(10.0 ** np.floor(np.log10(0.8 * low)), 10.0 ** np.ceil(np.log10(1.25 * high)))
    ax.yaxis.set_minor_formatter(NullFormatter())


def falls(rows):
    """Whether a finer step brings a smaller error at all: not where it is rounding alone."""
    finest, coarsest = (rows[rows["step_s"] == step]["error"].max() for step in (rows["step_s"].min(), rows["step_s"].max()))
    return finest < coarsest / 1.5


@figure("joints", "lengths", table="lengths")
def lengths(frame):
    """Seconds a step and a sweep over the number of bodies."""
    fig, axes = panels(2, columns=2, height=2.6)
    for ax, column, title in zip(axes, ("cpu_s_per_step", "cpu_s_per_sweep"), ("a step of four linearisations", "a sweep")):
        for relaxation, rows in frame.groupby("relaxation", sort=False):
            curve_points(ax, rows, "bodies", column, relaxation, style(relaxation))
        ok = good(frame, "bodies", column)
        fewest = ok[ok["bodies"] == ok["bodies"].min()]
        if len(fewest):
            slope_triangle(ax, 3 * fewest["bodies"].iloc[0], 0.9 * on_log(fewest[column].min()), 1, BLACK)
        ax.set(xscale="log", yscale="log", title=title, xlabel="bodies")
        ticks(ax, frame["bodies"], "{:.0f}".format)
    axes[0].set_ylabel("processor time (s)")
    shared_legend(fig, axes)
    footnote(fig, reasons_note(failed(frame, "cpu_s_per_step", "cpu_s_per_sweep")))
    return fig
