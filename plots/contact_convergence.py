"""How do sweeps solve the contacts of a step?"""

from common import curve, figure, footnote, on_log, panels, shared_legend
from selecting import failed, reasons_note
from styles import BLACK, style

BOUNDED = {"ista": "bound of ista, 1/k", "fista": "bound of fista, 1/k^2"}
SHOWN = ("gauss_seidel", "jacobi", "nesterov_jacobi", "power_law", "ista", "fista", "fista_restarted")


def traces(frame, law, column, label):
    """One panel a scene, over the sweeps."""
    frame = frame[frame["law"] == law]
    scenes = list(frame["scene"].unique())
    fig, axes = panels(len(scenes), columns=3, height=2.1, sharey=True)
    for ax, scene in zip(axes, scenes):
        for relaxation, rows in frame[frame["scene"] == scene].groupby("relaxation", sort=False):
            curve(ax, rows, "sweep", column, relaxation, style(relaxation))
        ax.set(xscale="log", yscale="log", title=scene)
    fig.supxlabel("sweeps, set-up included", fontsize=8)
    fig.supylabel(label, fontsize=8)
    shared_legend(fig, axes, columns=5)
    ends = frame.sort_values("sweep").groupby(["scene", "relaxation"], sort=False).tail(1)
    footnote(fig, reasons_note(failed(ends, column)))
    return fig


@figure("contact_convergence", "residual", table="traces")
def residual(frame):
    return traces(frame, "cone", "natural_residual", "natural residual, of |q| (law cone)")


@figure("contact_convergence", "residual_coulomb", table="traces")
def residual_coulomb(frame):
    return traces(frame, "coulomb", "natural_residual", "natural residual, of |q| (law coulomb)")


@figure("contact_convergence", "penetration", table="traces")
def penetration(frame):
    return traces(frame, "coulomb", "penetration_m", "deepest overlap at the step's end (m, law coulomb)")


@figure("contact_convergence", "gaps", table="gaps")
def gaps(frame):
    """The dual gap over the sweeps with the bounds of theory, one panel a scene."""
    scenes = list(frame["scene"].unique())
    fig, axes = panels(len(scenes), columns=3, height=2.1, sharey=True)
    for ax, scene in zip(axes, scenes):
        here = frame[frame["scene"] == scene]
        for relaxation in SHOWN:
            curve(ax, here[here["relaxation"] == relaxation], "sweep", "gap", relaxation, style(relaxation))
        for relaxation, label in BOUNDED.items():
            rows = here[here["relaxation"] == relaxation]
            ax.plot(rows["sweep"], on_log(rows["bound"]), color=BLACK, linewidth=0.8, label=label,
                    linestyle="--" if relaxation == "ista" else "-")
        ax.set(xscale="log", yscale="log", title=scene, ylim=(1e-12, 10))
    fig.supxlabel("sweeps, set-up included", fontsize=8)
    fig.supylabel("dual gap (F - F*)/(F(0) - F*) (law cone)", fontsize=8)
    shared_legend(fig, axes)
    footnote(fig, reasons_note(failed(frame, "gap")))
    return fig
