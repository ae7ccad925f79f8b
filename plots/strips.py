"""Checks beside their bounds: a row of marks for each kind of check, its bound at 1."""

import numpy as np

from common import WIDTH, footnote, panels
from finding import beyond, finding, guide
from styles import BLUE, RED
from wording import counted, number, some

LEAST, MOST = 1e-9, 1e4  # what is drawn of measured over bound: below is rounding, above it is lost

EDGES = f"On the left edge: {number(LEAST)} or less, on the right one: {number(MOST)} or more, or no number. "


def strip(ax, frame, xlabel="measured over its bound"):
    """Marks of `ratio` for each `row`: a ring where `holds`, a red cross where not; how many hold, and `who` does not,
    stands at the right. A ratio that is no number stands at the edge it fails on."""
    rows = list(dict.fromkeys(frame["row"]))
    ratio = frame["ratio"].fillna(np.inf).clip(LEAST, MOST)
    low = 10.0 ** np.floor(np.log10(min(0.1, ratio.min() if len(ratio) else 0.1)))
    high = 3 * max(1.0, ratio.max() if len(ratio) else 1.0)
    place = frame["row"].map(rows.index)
    held = frame["holds"]
    for chosen, mark, color, size in ((held, "o", BLUE, 3.5), (~held, "x", RED, 5)):
        ax.plot(ratio[chosen], place[chosen], mark, color=color, markersize=size, markerfacecolor="none", markeredgewidth=0.8,
                clip_on=False)
    beyond(ax, 1, high, horizontal=False)
    guide(ax, 1, "bound", horizontal=False, linestyle="-")
    for i, name in enumerate(rows):
        here = frame[frame["row"] == name]
        ax.text(1.02, i, told(here), transform=ax.get_yaxis_transform(), va="center", fontsize=6.5,
                color=RED if not here["holds"].all() else "black")
    ax.set_yticks(range(len(rows)), [name.replace("_", " ") for name in rows])
    ax.set(xscale="log", xlim=(low, high), ylim=(len(rows) - 0.5, -0.5), xlabel=xlabel)


def told(here):
    bad = here[~here["holds"]]
    missed = f"\nnot: {some(dict.fromkeys(bad['who']), 2)}" if len(bad) else ""
    return f"{len(here) - len(bad)} of {len(here)}{missed}"


def strips(frame, what, note="", xlabel="measured over its bound", extra="", width=WIDTH):
    """The figure of one strip: `what` names what is checked, as in '24 of 24 gates hold'; None without a row."""
    if frame.empty:
        return None
    frame = frame.assign(holds=frame["holds"].astype(bool) & frame["ratio"].notna())
    fig, (ax,) = panels(1, width=width, height=0.22 * frame["row"].nunique() + 0.5)
    strip(ax, frame, xlabel)
    finding(fig, verdict(frame, what), extra)
    footnote(fig, EDGES + note)
    return fig


def verdict(frame, what):
    """How many hold, and the worst of them."""
    held = frame["holds"]
    text = f"{held.sum()} of {counted(len(frame), what)} {'is' if len(frame) == 1 else 'are'} within bounds"
    if held.all():
        nearest = frame.loc[frame["ratio"].idxmax()]
        return text + (f"; nearest to its bound is {nearest['row'].replace('_', ' ')}, at {number(nearest['ratio'])} of it"
                       if nearest["ratio"] > 0 else "")
    return f"{text}; not: {some(dict.fromkeys(frame['row'][~held].str.replace('_', ' ')))}"


def within(frame, measured, bound):
    """Measured over bound; of a bound of 0, which allows nothing, 0 where it is met and infinity where not."""
    met = np.where(frame[measured] <= frame[bound], 0.0, np.inf)
    return (frame[measured] / frame[bound].where(frame[bound] > 0)).where(frame[bound] > 0, met)
