"""What passes through what, pair by pair, with continuous detection and without."""

import numpy as np

from common import figure, panels
from finding import finding
from wording import share

LOOKS = ((0, "passed_ok", "steps_ok", "ends alone:\nsolved steps that pass"),
         (1, "passed_ok", "steps_ok", "continuous:\nsolved steps that pass"),
         (1, "passed_missed", "steps_missed", "continuous:\nmissed steps that pass"))


def counts(ax, rows, passed, steps, title):
    """How many steps pass of how many, a cell for each pair of kinds, and dark by their share."""
    first, second = (list(dict.fromkeys(rows[column])) for column in ("first", "second"))
    shares = np.full((len(first), len(second)), np.nan)
    for _, row in rows.iterrows():
        at = first.index(row["first"]), second.index(row["second"])
        shares[at] = row[passed] / max(row[steps], 1)
        ax.text(at[1], at[0], f"{row[passed]:.0f}", ha="center", va="center", fontsize=5.5, color="white" if shares[at] > 0.5 else "black")
    ax.imshow(shares, cmap="Oranges", vmin=0, vmax=1, aspect="auto")
    ax.set_xticks(range(len(second)), second, rotation=90)
    ax.set_yticks(range(len(first)), first)
    ax.set_title(title, fontsize=8)
    ax.grid(False)


@figure("tunnelling", "pairs", table="pairs")
def pairs(frame):
    """Three tables of cells: steps that pass, of those that are solved without and with continuous detection, and missed ones."""
    fig, axes = panels(len(LOOKS), height=2.6, sharey=True)
    for ax, (continuous, passed, steps, title) in zip(axes, LOOKS):
        counts(ax, frame[frame["continuous"] == continuous], passed, steps, title)
    told = [frame[frame["continuous"] == continuous][[passed, steps]].sum() for continuous, passed, steps, _ in LOOKS]
    without, solved, missed = (share(int(each.iloc[0]), int(each.iloc[1])) for each in told)
    finding(fig, f"With continuous detection {solved} solved steps pass, without it {without}; of missed steps {missed} pass all the same")
    return fig
