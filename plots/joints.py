"""How accurately do joints carry mechanisms, and what does a chain of bodies cost?"""

from common import curve_points, figure, footnote, on_log, order_triangles, panels, shared_legend, slope_triangle, ticks
from finding import MOST_PANELS, finding, guide
from styles import BLACK, style
from selecting import drawable, failed, good, missed_note, reasons_note, rule_names
from wording import number, share, span

BOUND = 1e-10  # of the joints' errors, of the verdicts


@figure("joints", "accuracy", table="accuracy")
def accuracy(frame):
    """Error at the end over the step, one column a mechanism, and below it the largest error of a joint in any step. The
    thin line runs through the crossed points, too. Those with most failures are drawn."""
    lost = failed(frame, "error", "joint_error")["mechanism"].value_counts()
    kept = sorted(frame["mechanism"].unique(), key=lambda name: -lost.get(name, 0))[:MOST_PANELS // 2]
    mechanisms = list(frame[frame["mechanism"].isin(kept)].groupby("mechanism", sort=False))
    left = [name for name in frame["mechanism"].unique() if name not in kept]
    fig, axes = panels(2 * len(mechanisms), columns=len(mechanisms), height=1.8, sharex="col", sharey="row")
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
        guide(below, BOUND, "bound")
    axes[0].set_ylabel("error at the end,\nrelative")
    axes[len(mechanisms)].set_ylabel("largest error of a joint\n(m or rad)")
    fig.supxlabel("step (s)", fontsize=8)
    shared_legend(fig, axes, columns=5)
    tight = (good(frame, "joint_error")["joint_error"] <= BOUND).sum()
    shown = good(frame, "error")
    finding(fig, f"Joints are met to {number(BOUND)} in {share(tight, len(frame))} runs" +
            (f"; the motion is {span(shown[shown['step_s'] == shown.groupby('mechanism')['step_s'].transform('min')]['error'])} off at "
             "the smallest steps" if len(shown) else ""))
    footnote(fig, (f"In the table alone: {', '.join(left)}. " if left else "") + missed_note(frame) +
             reasons_note(failed(frame, "error", "joint_error")))
    return fig


def falls(rows):
    """Whether a finer step brings a smaller error at all: not where it is rounding alone."""
    finest, coarsest = (rows[rows["step_s"] == step]["error"].max() for step in (rows["step_s"].min(), rows["step_s"].max()))
    return finest < coarsest / 1.5


@figure("joints", "lengths", table="lengths")
def lengths(frame):
    """Seconds a step and a sweep over the number of bodies."""
    fig, axes = panels(2, columns=2, height=2.4)
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
    finding(fig, f"From {frame['bodies'].min():.0f} to {frame['bodies'].max():.0f} bodies the time of a step grows with the powers " +
            ", ".join(f"{exponent:.2f} ({name})" for name, exponent in frame.groupby("relaxation", sort=False)["exponent_step"].max()
                      .dropna().items()))
    footnote(fig, reasons_note(failed(frame, "cpu_s_per_step", "cpu_s_per_sweep")))
    return fig
