"""What does a step of a large scene cost in time and memory, beside Newton's method?"""

from common import curve_points, figure, footnote, panels, shared_legend
from finding import finding
from rival_newton import CONTRASTED, look
from selecting import failed, reasons_note, text_number
from wording import counted, span

COSTS = (("wall_s", "wall time of a step (s)"), ("memory_mb", "memory (MB)"))


@figure("large_scenes", "costs", table="steps")
def costs(frame):
    """Time of a step to the smallest error, and memory, over the number of unknowns, one column a kind of scene."""
    target = frame["error_target"].min()
    frame = frame[frame["error_target"] == target]
    kinds = list(dict.fromkeys(frame["scene"]))
    fig, axes = panels(len(COSTS) * len(kinds), columns=max(len(kinds), 1), height=2.0, sharex=True, sharey="row")
    for ax, (kind, (column, label)) in zip(axes, [(kind, cost) for cost in COSTS for kind in kinds]):
        for method, points in frame[frame["scene"] == kind].groupby("method", sort=False):
            curve_points(ax, points, "unknowns", column, CONTRASTED.get(method, method), look(method))
        ax.set(xscale="log", yscale="log", title=kind if column == COSTS[0][0] else "")
        if kind == kinds[0]:
            ax.set_ylabel(label, fontsize=8)
    fig.supxlabel("unknowns", fontsize=8)
    shared_legend(fig, axes)
    finding(fig, times_as_long(frame))
    footnote(fig, f"To an error of {text_number(target)} of the step's displacement; of columns of boxes to such a residual. Without "
             "what a scene's first step takes alone. " + reasons_note(failed(frame, "wall_s")))
    return fig


def times_as_long(frame):
    """What Newton takes over what quasi_newton does, on the largest scene of each kind that both solve."""
    told = []
    for kind, rows in frame.groupby("scene", sort=False):
        both = rows.pivot_table("wall_s", "size", "method", dropna=False)
        if set(CONTRASTED) <= set(both):
            ratio = (both["newton"] / both["quasi_newton"]).dropna()
            told.append(f"{kind} {span(ratio)}" if len(ratio) else f"{kind} 0 of {counted(len(both), 'size')} solved by both")
    return "Newton's time over quasi_newton's: " + "; ".join(told)
