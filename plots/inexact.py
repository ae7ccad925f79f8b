"""What is saved where linear problems are solved no further than the step can use?"""

from common import curve_points, figure, footnote, panels, shared_legend
from finding import fewer, finding, guide
from styles import BLACK, BLUE, GREEN, ORANGE, RED
from selecting import failed, good, reasons_note, step_text
from wording import counted, number, share

LOOKS = ((BLUE, "o"), (ORANGE, "s"), (GREEN, "^"), (RED, "D"), (BLACK, "P"))
CASE = ["scene", "outer", "relaxation", "step_s", "mass_ratio"]


def saved(frame):
    """Row updates of each case solved inexactly over those of the same case solved exactly; the status is the worse of the two."""
    loosest, tightest = frame["inner_tolerance"].max(), frame["inner_tolerance"].min()
    loose, tight = (frame[frame["inner_tolerance"] == part] for part in (loosest, tightest))
    both = loose.merge(tight[[*CASE, "row_updates", "status", "reason"]], on=CASE, suffixes=("", "_exact"))
    bad = both["status"].eq("ok") & both["status_exact"].ne("ok")
    return both.assign(ratio=both["row_updates"] / both["row_updates_exact"], status=both["status"].where(~bad, both["status_exact"]),
                       reason=both["reason"].where(~bad, both["reason_exact"]))


@figure("inexact", "row_updates", table="solves")
def row_updates(frame):
    """Row updates of the inexact solves over those of the exact ones over the mass ratio, a line a step."""
    ratios = saved(frame)
    groups, left = fewer(ratios.groupby("relaxation", sort=False))
    if not groups:
        return None
    fig, axes = panels(len(groups), columns=2, height=2.4, sharey=True)
    for ax, (relaxation, rows) in zip(axes, groups):
        for k, (step, cells) in enumerate(list(rows.groupby("step_s"))[:7]):
            color, marker = LOOKS[k % len(LOOKS)]
            curve_points(ax, cells, "mass_ratio", "ratio", f"h = {step_text(step)}", {"color": color, "marker": marker})
        guide(ax, 1, "as exact")
        ax.set(xscale="log", yscale="log", title=relaxation)
    fig.supxlabel("mass ratio, tip to other nodes", fontsize=8)
    fig.supylabel("row updates, inexact over exact", fontsize=8)
    shared_legend(fig, axes, columns=4)
    solved = good(ratios, "ratio")
    finding(fig, f"Inexact linear solves cost less than exact ones in {share((solved['ratio'] < 1).sum(), len(ratios))} cases" +
            (f": {number(solved['ratio'].min())} to {number(solved['ratio'].max())} of their row updates" if len(solved) else ""))
    footnote(fig, f"{left}Row updates of {counted(len(frame), 'run')} are in the table. " + reasons_note(failed(frame, "row_updates")))
    return fig
