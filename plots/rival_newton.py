"""When is the constraint solver faster than Newton's method?"""

from common import curve, curve_points, figure, footnote, panels, shared_legend
from finding import fewer, finding
from styles import style
from selecting import failed, reasons_note, text_number
from wording import counted, share, span

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
    groups, left = fewer(frame.groupby(["poisson", "error_target"], sort=False))
    fig, axes = panels(len(groups), columns=3, height=1.8, sharex=True, sharey=True)
    for ax, ((poisson, target), rows) in zip(axes, groups):
        for method, points in rows.groupby("method", sort=False):
            curve_points(ax, points, "elements", "wall_s", CONTRASTED.get(method, method), look(method))
        ax.set(xscale="log", yscale="log", title=f"to {text_number(target)}, nu = {poisson:g}")
    fig.supxlabel("tetrahedra", fontsize=8)
    fig.supylabel("wall time of a step (s)", fontsize=8)
    shared_legend(fig, axes)
    finding(fig, quicker(frame))
    footnote(fig, f"E = {text_number(young)} Pa. {left}" + reasons_note(failed(frame, "wall_s")))
    return fig


def quicker(frame):
    """In how many rows quasi_newton needs less time than Newton, and the ratio of their times."""
    times = frame.assign(wall_s=frame["wall_s"].where(frame["status"] == "ok")).pivot_table(
        "wall_s", ["elements", "poisson", "error_target"], "method", dropna=False)
    if not set(CONTRASTED) <= set(times):
        return f"{counted(len(frame), 'run')}, none of both methods"
    both = (times["newton"] / times["quasi_newton"]).dropna()
    return (f"Set-up apart, quasi_newton is quicker than Newton in {share((both > 1).sum(), len(both))} rows that both solve" +
            (f"; Newton takes {span(both)} times as long" if len(both) else ""))


@figure("rival_newton", "seconds", table="traces")
def seconds(frame):
    """Error over time on the largest mesh, one panel a material."""
    largest = frame["elements"].max()
    frame = frame[frame["elements"] == largest]
    groups, left = fewer(frame.groupby(["poisson", "young_pa"], sort=True))
    fig, axes = panels(len(groups), columns=3, height=2.0, sharey=True)
    for ax, ((poisson, young), rows) in zip(axes, groups):
        for method, points in rows.groupby("method", sort=False):
            moving = points[points["wall_s"] > 0]
            curve(ax, moving[moving["error"] != 0], "wall_s", "error", CONTRASTED.get(method, method), look(method))
        ax.set(xscale="log", yscale="log", title=material_text(young, poisson))
    fig.supxlabel("wall time (s)", fontsize=8)
    fig.supylabel("error, relative", fontsize=8)
    shared_legend(fig, axes)
    ends = frame.sort_values("iteration").groupby(["young_pa", "poisson", "method"], sort=False).tail(1)
    finding(fig, f"On {largest:.0f} tetrahedra these end at the solution: " + ", ".join(
        f"{CONTRASTED.get(method, method)} {share(rows['status'].eq('ok').sum(), len(rows))}" +
        (f" in {span(rows['wall_s'][rows['status'] == 'ok'])} s" if rows["status"].eq("ok").any() else "")
        for method, rows in ends.groupby("method", sort=False)))
    footnote(fig, left + f"Cantilever of {largest:.0f} tetrahedra. Exact zeros, where a method's own end is the reference, are "
             "left out. " + reasons_note(failed(frame.drop_duplicates(["young_pa", "poisson", "method", "status"]), "error")))
    return fig


def middle(values):
    """The middle one of the values there are."""
    there = sorted(set(values))
    return there[len(there) // 2]
