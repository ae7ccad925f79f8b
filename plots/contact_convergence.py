"""How do sweeps solve the contacts of a step?"""

from common import curve, figure, footnote, on_log, panels, shared_legend
from finding import fewer, finding
from selecting import drawable, failed, good, reasons_note
from styles import BLACK, style
from wording import counted, number, share

BOUNDED = {"jacobi": "the bound of ista, 1/k", "nesterov_jacobi": "the bound of fista, 1/k²"}
SHOWN = ("jacobi", "nesterov_jacobi", "power_law", "fista", "fista_restarted")


def sweeping(frame, column, label):
    """One panel a scene, over the sweeps; the figure, and what it leaves to the table."""
    scenes, left = fewer(frame["scene"].unique())
    fig, axes = panels(len(scenes), columns=3, height=2.1, sharey=True)
    for ax, scene in zip(axes, scenes):
        for relaxation, rows in frame[frame["scene"] == scene].groupby("relaxation", sort=False):
            curve(ax, rows, "sweep", column, relaxation, style(relaxation))
        ax.set(xscale="log", yscale="log", title=scene)
    fig.supxlabel("sweeps, set-up included", fontsize=8)
    fig.supylabel(label, fontsize=8)
    shared_legend(fig, axes, columns=5)
    return fig, left


def ends(frame):
    """The last sweep of each run."""
    return frame.sort_values("sweep").groupby(["scene", "law", "relaxation"], sort=False).tail(1)


def reached(last, column, low):
    """Of each relaxation, how many runs end at most at `low`."""
    return ", ".join(f"{name} {share((good(rows, column)[column] <= low).sum(), len(rows))}" for name, rows in last.groupby("relaxation", sort=False))


def traces(frame, law, column, label, low, what):
    """The scenes by one law; counts those in which each relaxation's last value is at most `low`."""
    frame = frame[frame["law"] == law]
    fig, left = sweeping(frame, column, label)
    finding(fig, f"Scenes {what} {number(low)} by the law {law}: {reached(ends(frame), column, low)}")
    footnote(fig, left + reasons_note(failed(ends(frame), column)))
    return fig


@figure("contact_convergence", "residual", table="traces")
def residual(frame):
    return traces(frame, "cone", "natural_residual", "natural residual, of |q|", 1e-10, "solved to")


@figure("contact_convergence", "residual_coulomb", table="traces")
def residual_coulomb(frame):
    return traces(frame, "coulomb", "natural_residual", "natural residual, of |q|", 1e-10, "solved to")


@figure("contact_convergence", "penetration", table="traces")
def penetration(frame):
    return traces(frame, "coulomb", "penetration_m", "deepest overlap at the step's end (m)", 1e-9, "that overlap by at most (m)")


@figure("contact_convergence", "deformables", table="deformables")
def deformables(frame):
    """The scenes by Coulomb's law; counts over all laws who is solved."""
    fig, left = sweeping(frame[frame["law"] == "coulomb"], "natural_residual", "natural residual, of |q|")
    last = ends(frame)
    finding(fig, f"Steps of deformables solved to 1e-10, of {counted(last['scene'].nunique(), 'scene')} by {counted(last['law'].nunique(), 'law')}: "
            f"{reached(last, 'natural_residual', 1e-10)}")
    footnote(fig, left + reasons_note(failed(last, "natural_residual")))
    return fig


@figure("contact_convergence", "gaps", table="gaps")
def gaps(frame):
    """The dual gap over the sweeps with the bounds of theory, one panel a scene."""
    scenes, left = fewer(frame["scene"].unique())
    fig, axes = panels(len(scenes), columns=3, height=2.1, sharey=True)
    for ax, scene in zip(axes, scenes):
        here = frame[frame["scene"] == scene]
        for relaxation in SHOWN:
            curve(ax, here[here["relaxation"] == relaxation], "sweep", "gap", relaxation, style(relaxation))
        for relaxation, label in BOUNDED.items():
            rows = here[here["relaxation"] == relaxation]
            ax.plot(rows["sweep"], on_log(rows["bound"]), color=BLACK, linewidth=0.8, label=label,
                    linestyle="--" if relaxation == "jacobi" else "-")
        ax.set(xscale="log", yscale="log", title=scene, ylim=(1e-12, 10))
    fig.supxlabel("sweeps, set-up included", fontsize=8)
    fig.supylabel("dual gap (F - F*)/(F(0) - F*) (law cone)", fontsize=8)
    shared_legend(fig, axes)
    of_bound = {name: (rows["gap"] / rows["bound"]).max() for name, rows in frame[drawable(frame, ["gap", "bound"])].groupby("relaxation")}
    finding(fig, "The dual gap of " + ", that of ".join(
        f"{name} is at most {number(of_bound[name])} of {label}" for name, label in BOUNDED.items() if name in of_bound)
        if set(BOUNDED) & set(of_bound) else f"No gap of {counted(len(scenes), 'scene')} can be drawn beside its bound")
    footnote(fig, left + reasons_note(failed(frame, "gap")))
    return fig
