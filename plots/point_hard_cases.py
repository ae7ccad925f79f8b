"""Which gates hold on the hard cases, and how far step and budget can be pushed?"""

import numpy as np

from common import WIDTH, figure, panels, shared_legend, footnote
from finding import MOST_SERIES, finding
from strips import strips, within
from styles import style
from selecting import drawable, step_text
from wording import counted, joined, share, some

UNSWEPT = "quasi-Newton, no sweeps"


def row_names(frame):
    """The scene, with the relaxation where the scene was tried with several."""
    several = frame.groupby("scene")["relaxation"].transform("nunique") > 1
    return frame["scene"].where(~several, frame["scene"] + ", " + frame["relaxation"])


@figure("point_hard_cases", "gates", table="gates")
@figure("contact_hard_cases", "gates", table="gates")
def gates(frame, width=WIDTH):
    """Every case over the bound of each gate, a row a gate; cases that were skipped are told below."""
    frame = frame.assign(case=row_names(frame))
    asked = frame[frame["status"] != "skipped"]
    skipped = frame[frame["status"] == "skipped"].drop_duplicates("case")
    runs = asked.drop_duplicates("case")
    unsolved = runs[runs["status"] != "ok"]
    note = f"In {share(len(unsolved), len(runs))} simulations some steps say that they are not solved" + \
        (f": {some(unsolved['case'])}. " if len(unsolved) else ". ")
    why = skipped["reason"].map(lambda reason: reason.partition(" in ")[0]).value_counts()
    return strips(asked.assign(row=asked["gate"], ratio=within(asked, "measured", "bound"), who=asked["case"],
                               holds=asked["holds"] == 1), "gate",
                  note + ("Skipped: " + "; ".join(f"{count} x {reason}" for reason, count in why.items()) + "." if len(why) else ""), width=width)


@figure("point_hard_cases", "frontier", table="frontier")
@figure("contact_hard_cases", "frontier", table="frontier")
def frontier(frame):
    """How many cases pass all gates at a step, and with a budget of sweeps, a staircase a relaxation."""
    swept = frame.assign(kind=frame["relaxation"].where(frame["fewest_sweeps"] != 0, UNSWEPT))
    kinds = list(swept.groupby("kind", sort=False))[:MOST_SERIES]
    fig, axes = panels(2, columns=2, height=2.3)
    for kind, rows in kinds:
        look = style(kind) | {"marker": "none"}
        label = f"{kind}: {counted(len(rows), 'case')}"
        stairs(axes[0], rows, "largest_step_s", label, look, falling=True)
        if kind != UNSWEPT:
            told = drawable(rows, ["fewest_sweeps"]) | ~drawable(rows, ["largest_step_s"])
            stairs(axes[1], rows[told], "fewest_sweeps", label, look, falling=False)
    axes[0].set(xscale="log", xlabel="step (s)", ylabel="% of cases in which all gates hold", ylim=(0, 105))
    axes[1].set(xscale="log", xlabel="sweeps an outer iteration", ylabel="% of those whose budget is told", ylim=(0, 105))
    shared_legend(fig, axes[:1])
    never = swept[~drawable(swept, ["largest_step_s"])]
    steps = swept.groupby("kind", sort=False)["largest_step_s"].median().dropna()
    longest = swept["largest_step_s"].max()
    halves = {step: joined(steps.index[steps == step]) for step in steps.unique()}
    finding(fig, f"Half of the cases pass at steps of {joined(('at least ' if step == longest else '') + step_text(step) + f' ({of})' for step, of in halves.items())}"
            if len(steps) else f"None of {counted(len(frame), 'case')} passes at any step",
            f"{share(len(never), len(frame))} pass at none: {some(row_names(frame)[never.index])}" if len(never) else "")
    untold = drawable(swept, ["largest_step_s"]) & ~drawable(swept, ["fewest_sweeps"])
    footnote(fig, "All cases are in the table. " + (f"Of {share(untold.sum(), len(frame))} no budget of sweeps is told. " if untold.any() else "") + ("Without sweeps: every row is compliant. " if (swept["kind"] == UNSWEPT).any() else ""))
    return fig


def stairs(ax, rows, column, label, look, falling):
    """The share of cases whose largest step is at least x, or whose fewest sweeps are at most x."""
    values = rows[column][drawable(rows, [column])].to_numpy()
    places = np.unique(values)
    part = np.array([100 * ((values >= x) if falling else (values <= x)).sum() / len(rows) for x in places])
    ax.plot(places, part, drawstyle="steps-pre" if falling else "steps-post", label=label, **look)
    ax.plot(*((places[-1:], part[-1:]) if falling else (places[:1], part[:1])), "o", color=look["color"], markersize=3)
