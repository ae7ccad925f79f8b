"""Is each effect's contraction of the plain iteration the predicted one?"""

import numpy as np

from common import figure, footnote, panels
from finding import beyond, finding, guide
from styles import BLUE, RED
from selecting import drawable, failed, good, reasons_note, stiffens
from wording import counted, number, share

LEAST = 1e-3  # of rates that are compared
STEADY = (0.01, 0.95)  # radii whose rate can be measured to a part, as the verdicts ask
COMPUTED = 0.7  # above this bound the solver computes its prediction
RATIOS = (("predicted_rate", "the dense spectral radius", 0.01), ("predicted_contraction", "the solver's prediction", 0.05),
          ("bound", "the effect's bound", None))  # and the part that they may differ by, as the verdicts ask


def name(row):
    return row["effect"].replace("_", " ") + (f", {row['strain']}" if row["strain"] else "")


@figure("contraction", "effects", table="rates")
def rates(frame):
    """Measured rates over what they are compared with, a panel each, a row an effect; filled where stiffening decides the rate,
    open where compression does."""
    frame = frame.assign(row=frame.apply(name, axis=1), stiff=stiffens(frame))
    rows = list(frame["row"].unique())
    fig, axes = panels(3, columns=3, height=0.24 * len(rows) + 0.7, sharey=True)
    compared = good(frame[drawable(frame, ["predicted_rate"]) & (frame["predicted_rate"] >= LEAST)], "measured_rate")
    compared = compared[compared["measured_rate"] >= LEAST]
    said = []
    for ax, (column, title, apart) in zip(axes, RATIOS):
        here = compared[compared["predicted_rate"].between(*STEADY)] if apart else compared
        here = here[here["bound"] > COMPUTED] if column == "predicted_contraction" else here
        here = here[drawable(here, [column]) & (here[column] > 0)]
        ratio = here["measured_rate"] / here[column]
        high = 1 + (apart or 1e-6)
        held = (ratio <= high) & ((ratio >= 1 - apart) if apart else True)
        limits = (1 - 4 * apart, 1 + 4 * apart) if apart else (0.03, 3)
        panel(ax, here, ratio.clip(*limits), held, rows)
        beyond(ax, high, limits[1], horizontal=False)
        if apart:
            beyond(ax, limits[0], 1 - apart, horizontal=False)
        guide(ax, 1, horizontal=False)
        ax.set(xscale="linear" if apart else "log", xlim=limits)
        ax.set_title(f"over {title}", fontsize=7.5)
        said.append(f"{share(held.sum(), len(here))} within {100 * apart:g} % of {title}" if apart else
                    f"{share(held.sum(), len(here))} below {title}")
    axes[0].set_yticks(range(len(rows)), rows)
    axes[0].set_ylim(len(rows) - 0.5, -0.5)
    fig.supxlabel("measured rate over what it is compared with", fontsize=8)
    fell = len(failed(frame, "measured_rate"))
    finding(fig, "Rates of plain: " + ", ".join(said))
    footnote(fig, f"Filled: stiffening decides; open: compression; red cross: outside. {len(frame) - len(compared)} of "
             f"{counted(len(frame), 'case')} are not compared: {fell} have no measured rate, the others are below {number(LEAST)}; radius and prediction are compared where the radius is from 0.01 to 0.95. "
             f"What is beyond a panel stands on its edge. " + reasons_note(failed(frame, "measured_rate")))
    return fig


def panel(ax, here, ratio, held, rows):
    place = here["row"].map(rows.index) + np.where(here["stiff"], -0.15, 0.15)
    for stiff in (True, False):
        chosen = held & (here["stiff"] == stiff)
        ax.plot(ratio[chosen], place[chosen], "o", color=BLUE, markersize=3, markeredgewidth=0.7,
                markerfacecolor=BLUE if stiff else "white")
    ax.plot(ratio[~held], place[~held], "x", color=RED, markersize=5)
