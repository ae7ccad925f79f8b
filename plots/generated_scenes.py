"""How do random scenes end, is every step that says ok one, and is its answer the only one?"""

import numpy as np

from common import draw_failed, figure, footnote, on_log, panels, shared_legend
from finding import MOST_SERIES, finding, guide
from styles import FALLBACK, style
from selecting import failed, good, reasons_note
from wording import share

# Of a variant's first step beside that of the scene as it is.
OUTCOMES = ("the same", "told apart by the tolerance alone", "another solution", "not told", "one missed")


def stacked(counts, kinds, xlabel, said):
    """One bar for each row of a table of counts, in the order of its index, with a part for each kind."""
    fig, (ax,) = panels(1, height=0.25 * len(counts) + 0.6)
    left = np.zeros(len(counts))
    for k, kind in enumerate(kinds):
        width = counts[kind].to_numpy() if kind in counts else np.zeros(len(counts))
        ax.barh(list(counts.index), width, left=left, height=0.6, label=kind, color=FALLBACK[k % len(FALLBACK)][0],
                hatch="" if k < len(FALLBACK) else "//")
        left += width
    ax.invert_yaxis()
    ax.grid(axis="y", visible=False)
    ax.set(xlabel=xlabel)
    shared_legend(fig, [ax], columns=2)
    finding(fig, said)
    return fig


def summed(frame, row, kind, count):
    """Sums of `count`, rows in the table's order, a column for each kind."""
    return frame.assign(kind=kind).pivot_table(index=row, columns="kind", values=count, aggfunc="sum", fill_value=0, sort=False)


@figure("generated_scenes", "outcomes", table="outcomes")
def outcomes(frame):
    """Bars of the steps of each relaxation by outcome and reason."""
    counts = summed(frame, "relaxation", frame["status"] + frame["reason"].map(lambda text: f": {text}" if text else ""), "steps")
    total, ok = counts.sum(axis="columns"), counts["ok"] if "ok" in counts else counts.sum(axis="columns") * 0
    kinds = sorted(counts, key=lambda kind: (kind != "ok", -counts[kind].sum()))
    if len(kinds) > MOST_SERIES:
        rest = kinds[MOST_SERIES - 1:]
        counts = counts.assign(**{"other reasons": counts[rest].sum(axis="columns")})
        kinds = [*kinds[:MOST_SERIES - 1], "other reasons"]
    return stacked(counts, kinds, "steps", "Steps of random scenes that are solved: " + ", ".join(
        f"{name} {share(int(ok[name]), int(total[name]))}" for name in counts.index))


@figure("generated_scenes", "sample", table="sample")
def sample(frame):
    """The error against Newton's method over the judge's residual, as part of what ok allows."""
    fig, (ax,) = panels(1, height=2.8)
    for relaxation, rows in frame.groupby("relaxation", sort=False):
        look = style(relaxation)
        shown = good(rows, "claim", "error")
        ax.plot(on_log(shown["claim"]), on_log(shown["error"]), look["marker"], color=look["color"], label=relaxation,
                markerfacecolor="none", markersize=4)
        draw_failed(ax, failed(rows[rows["claim"] > 0], "claim", "error"), "claim", "error",
                    {"color": look["color"], "marker": look["marker"]})
    guide(ax, 1, "what ok allows", horizontal=False)
    ax.set(xscale="log", yscale="log", xlabel="judge's residual over what status ok allows",
           ylabel="error against Newton, relative")
    shared_legend(fig, [ax])
    said = frame[frame["status"] == "ok"]
    finding(fig, f"{share((said['claim'] <= 1).sum(), len(said))} steps that say ok meet their tolerance by the judge's residual; "
            f"{len(frame) - len(said)} of {len(frame)} do not say ok")
    footnote(fig, reasons_note(failed(frame, "claim", "error")))
    return fig


@figure("generated_worlds", "agreement", table="agreement")
def agreement(frame):
    """Bars of the first steps of each variant by what became of them beside the scene as it is."""
    counts = summed(frame, "variant", frame["outcome"], "first_steps")
    same, missed, told = ((frame["first_steps"][frame["outcome"] == kind]).sum() for kind in (OUTCOMES[0], OUTCOMES[4], OUTCOMES[2]))
    return stacked(counts, OUTCOMES, "first steps", f"{share(int(same), int(frame['first_steps'].sum()))} first steps are the same in other words; "
                   f"{missed:.0f} are missed, {told:.0f} are another solution")
