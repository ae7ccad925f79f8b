"""What do the integrators and the two forms of the gyroscopic torque make of rotating bodies? The figures of its orders are
those of time_order."""

from common import curve_points, figure, footnote, on_log, order_triangles, panels, shared_legend, ticks, trace
from finding import MOST_PANELS, fewer, finding
from reading import LARGEST
from styles import style
from selecting import failed, good, reasons_note, rule_names, text_number
from wording import counted, number

LINEAR_BELOW = 1e-6  # changes of the energy, on an axis with both signs


@figure("rotation", "series", table="series")
def series(frame):
    """Change of energy and angular momentum over time, one column a form of the torque."""
    named = frame.assign(rule=rule_names(frame))
    torques, left = fewer(named.groupby("torque", sort=False), MOST_PANELS // 2)
    fig, axes = panels(2 * len(torques), columns=len(torques), height=2.3, sharex=True, sharey="row")
    for (torque, here), above, below in zip(torques, axes, axes[len(torques):]):
        for name, rows in here.groupby("rule", sort=False):
            trace(above, rows, rows["energy_change"].to_numpy(), name)
            trace(below, rows, on_log(rows["momentum_change"].to_numpy()), name)
        above.set_title(f"{torque} torque")
        above.set_yscale("symlog", linthresh=LINEAR_BELOW, linscale=0.6)
        below.set(yscale="log", xlabel="time (s)")
    limits = axes[0].get_ylim()
    axes[0].set_yticks([-1, -1e-2, -1e-4, -LINEAR_BELOW, 0, LINEAR_BELOW, 1e-4, 1e-2, 1, 100])
    axes[0].set_ylim(limits)
    axes[0].set_ylabel("change of the energy,\nrelative")
    axes[len(torques)].set_ylabel("change of the angular momentum,\nrelative")
    shared_legend(fig, axes)
    finding(fig, "Largest change of the energy: " + "; ".join(f"{torque} torque {energy_changes(here)}" for torque, here in torques))
    footnote(fig, left + reasons_note(failed(named.groupby(["torque", "rule"], sort=False).tail(1), "time_s")))
    return fig


def energy_changes(here):
    """The least and the most that any integrator changes the energy by, relative."""
    largest = here.groupby("rule")["energy_change"].agg(lambda values: values.abs().max())
    largest = largest[largest <= LARGEST]
    return f"{number(largest.min())} ({largest.idxmin()}) to {number(largest.max())} ({largest.idxmax()})" if len(largest) else \
        f"in none of {counted(here['rule'].nunique(), 'run')}"


@figure("rotation", "tumbling", table="tumbling")
def tumbling(frame):
    """Error of the period over the step, one panel a disturbance."""
    disturbances, left = fewer(frame.groupby("disturbance_rad_s", sort=False))
    fig, axes = panels(len(disturbances), columns=3, height=2.3, sharey=True)
    steps = sorted(frame["step_s"].unique())
    for ax, (disturbance, here) in zip(axes, disturbances):
        for name, rows in here.assign(rule=rule_names(here)).groupby("rule", sort=False):
            curve_points(ax, rows, "step_s", "error", name, style(name))
        order_triangles(ax, here, "step_s", "error", orders=(2,))
        ax.set(xscale="log", yscale="log", title=f"disturbance {text_number(disturbance)} rad/s", xlabel="step (s)",
               xlim=(steps[0] / 1.3, steps[-1] * 1.5))
        ticks(ax, steps)
    axes[0].set_ylabel("error of the period, relative")
    shared_legend(fig, axes)
    finding(fig, "Error of the tumbling period at the smallest step: " + period_errors(frame))
    footnote(fig, left + reasons_note(failed(frame, "error")))
    return fig


def period_errors(frame):
    """The largest error of each integrator at the smallest step."""
    shown = good(frame[frame["step_s"] == frame["step_s"].min()], "error")
    if shown.empty:
        return f"none of {counted(len(frame), 'run')} ended well"
    largest = shown.assign(rule=rule_names(shown)).groupby("rule", sort=False)["error"].max().sort_values()
    return ", ".join(f"{name} {number(error, 2)}" for name, error in largest.items())
