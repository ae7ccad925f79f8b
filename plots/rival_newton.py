"""When is the constraint solver faster than Newton's method?"""

from common import curve, curve_points, figure, footnote, panels, shared_legend
from styles import style
from selecting import failed, reasons_note, text_number

CONTRASTED = {"quasi_newton": "quasi_newton", "newton": "newton, the rival"}


def material_text(young, poisson):
    return f"E = {text_number(young)} Pa, nu = {poisson:g}"


def look(method):
    """As in the other figures, and filled for quasi_newton so that grey print tells them apart."""
    return style(method) | ({"markerfacecolor": style(method)["color"]} if method == "quasi_newton" else {})


@figure("rival_newton", "elements", table="times")
def elements(frame):
    """Seconds to each error over the size of the mesh, one panel a target and Poisson's ratio, at one stiffness."""
    young = middle(frame["young_pa"])
    frame = frame[frame["young_pa"] == young]
    groups = list(frame.groupby(["poisson", "error_target"], sort=False))
    fig, axes = panels(len(groups), columns=max(1, frame["error_target"].nunique()), height=2.0)
    for ax, ((poisson, target), rows) in zip(axes, groups):
        for method, points in rows.groupby("method", sort=False):
            curve_points(ax, points, "elements", "wall_s", CONTRASTED.get(method, method), look(method))
        ax.set(xscale="log", yscale="log", title=f"to {text_number(target)}, nu = {poisson:g}")
    fig.supxlabel("tetrahedra", fontsize=8)
    fig.supylabel("wall time of a step (s)", fontsize=8)
    shared_legend(fig, axes)
    footnote(fig, f"E = {text_number(young)} Pa. " + reasons_note(failed(frame, "wall_s")))
    return fig


@figure("rival_newton", "seconds", table="traces")
def seconds(frame):
    """Error over time on the largest mesh, one panel a material."""
    largest = frame["elements"].max()
    frame = frame[frame["elements"] == largest]
    groups = list(frame.groupby(["poisson", "young_pa"], sort=True))
    fig, axes = panels(len(groups), columns=3, height=2.0, sharey=True)
    for ax, ((poisson, young), rows) in zip(axes, groups):
        for method, points in rows.groupby("method", sort=False):
            moving = points[points["wall_s"] > 0]
            curve(ax, moving[moving["error"] != 0], "wall_s", "error", CONTRASTED.get(method, method), look(method))
        ax.set(xscale="log", yscale="log", title=material_text(young, poisson))
    fig.supxlabel("wall time (s)", fontsize=8)
    fig.supylabel("error, relative", fontsize=8)
    shared_legend(fig, axes)
    footnote(fig, f"Cantilever of {largest:.0f} tetrahedra. Exact zeros, where a method's own end is the reference, are "
             "left out. " + reasons_note(failed(frame.drop_duplicates(["young_pa", "poisson", "method", "status"]), "error")))
    return fig


def middle(values):
    """The middle one of the values there are."""
    there = sorted(set(values))
    return there[len(there) // 2]
