"""Do the references agree on the same step?"""

import numpy as np

from common import figure, footnote, on_log, panels, shared_legend
from finding import finding, guide
from styles import BLUE, GREEN, RED
from selecting import failed, good, reasons_note
from wording import counted, number, share

ALLOWED = 1e-9  # of the step's largest displacement, as the verdicts ask
LOOKS = ((BLUE, "o"), (GREEN, "^"))


@figure("judges", "agreement", table="agreement")
def agreement(frame):
    """The difference of each pair on each step, a row the experiment that the step is of, a colour a pair; the residuals are
    in the table."""
    frame = frame.assign(pair=frame["reference_a"] + " and " + frame["reference_b"], row=frame["scene"].str.partition(":")[0])
    rows, pairs = list(frame["row"].unique()), list(frame["pair"].unique())
    fig, (ax,) = panels(1, height=0.27 * len(rows) + 0.5)
    shown = good(frame, "difference")
    apart = shown["difference"] > ALLOWED
    for k, pair in enumerate(pairs):
        here = shown[shown["pair"] == pair]
        color, marker = LOOKS[k % len(LOOKS)]
        ax.plot(on_log(here["difference"]), here["row"].map(rows.index) + 0.3 * (k - (len(pairs) - 1) / 2), marker, color=color,
                label=pair, markerfacecolor="none", markersize=3.5, markeredgewidth=0.7)
    ax.plot(shown["difference"][apart], shown["row"][apart].map(rows.index), "x", color=RED, markersize=6)
    guide(ax, ALLOWED, "allowed", horizontal=False)
    for i, name in enumerate(rows):
        here, missed = shown[shown["row"] == name], (frame["row"] == name).sum() - (shown["row"] == name).sum()
        ax.text(1.02, i, counted(len(here), "step") + (f", {missed} without" if missed else ""),
                transform=ax.get_yaxis_transform(), va="center", fontsize=6.5, color=RED if missed else "black")
    ax.set_yticks(range(len(rows)), [name.replace("_", " ") for name in rows])
    ax.set(xscale="log", ylim=(len(rows) - 0.5, -0.5), xlabel="difference of the two, of the step's largest displacement")
    shared_legend(fig, [ax])
    worst = f"the largest difference is {number(shown['difference'].max())} of the displacement" if len(shown) else ""
    finding(fig, f"References agree to {number(ALLOWED)} on {share(np.sum(~apart), len(frame))} steps" +
            (f"; {worst}" if worst else ""))
    footnote(fig, reasons_note(failed(frame, "difference")))
    return fig
