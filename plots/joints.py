"""How accurately do joints carry mechanisms, and what does a chain of bodies cost?"""

from common import curve_points, figure, footnote, on_log, order_triangles, panels, shared_legend, slope_triangle, ticks
from styles import BLACK, style
from selecting import drawable, failed, good, missed_note, reasons_note, rule_names

BOUND = 1e-10  # of the joints' errors, of the verdicts


@figure("joints", "accuracy", table="accuracy")
def accuracy(frame):
    """Error at the end over the step, one column a mechanism, and below it the largest error of a joint in any step. The
    thin line runs through the crossed points, too."""
    mechanisms = list(frame.groupby("mechanism", sort=False))
    fig, axes = panels(2 * len(mechanisms), columns=len(mechanisms), width=7.5, height=1.9, sharex="col", sharey="row")
    for (mechanism, here), above, below in zip(mechanisms, axes, axes[len(mechanisms):]):
        for name, rows in here.assign(rule=rule_names(here)).groupby("rule", sort=False):
            for ax, column in ((above, "error"), (below, "joint_error")):
                there = rows[drawable(rows, [column])].sort_values("step_s")
                ax.plot(there["step_s"], on_log(there[column]), color=style(name)["color"], linewidth=0.5)
                curve_points(ax, rows, "step_s", column, name, style(name))
        if falls(good(here, "error")):
            order_triangles(above, here, "step_s", "error")
        above.set_title(mechanism)
        for ax in (above, below):
            ax.set(xscale="log", yscale="log")
        below.axhline(BOUND, color=BLACK, linewidth=0.8, linestyle="--", label="bound of the joints")
    axes[0].set_ylabel("error at the end,\nrelative")
    axes[len(mechanisms)].set_ylabel("largest error of a joint\n(m or rad)")
    fig.supxlabel("step (s)", fontsize=8)
    shared_legend(fig, axes, columns=5)
    footnote(fig, missed_note(frame) + reasons_note(failed(frame, "error", "joint_error")))
    return fig


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
