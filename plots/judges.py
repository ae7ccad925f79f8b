"""Do the references agree on the same step?"""

import re

from common import draw_failed, figure, footnote, on_log, panels, shared_legend
from styles import BLUE, GREEN, RED
from selecting import failed, good, reasons_note

SERIES = (("difference", "difference of the two", BLUE, "o"), ("residual_a", "residual of the first", RED, "s"),
          ("residual_b", "residual of the second", GREEN, "^"))

LEFT_OUT = ("tip", "Pa", "N", "N/m", "m/rad")
NUMBER = re.compile(r"[-x]?(\d[\d.e+-]*|inf)")


def family(scene):
    """The scene's name without sizes and parameters: `cantilever green` of `cantilever8 green E=1e5 Pa`."""
    words = [word.rstrip(",") for word in scene.split() if "=" not in word]
    kept = [re.sub(r"(?<=[a-z])\d+$", "", word) for word in words if word not in LEFT_OUT and not NUMBER.fullmatch(word)]
    return " ".join(kept) or scene


@figure("judges", "agreement", table="agreement")
def agreement(frame):
    """Difference and residuals of each pair, one row a family of scenes, the three kinds of marker below each other."""
    pairs = frame["reference_a"] + " / " + frame["reference_b"]
    names = frame["scene"].map(family) + (": " + pairs if pairs.nunique() > 1 else "")
    places = {name: float(i) for i, name in enumerate(names.unique())}
    frame = frame.assign(place=names.map(places))
    fig, (ax,) = panels(1, height=0.3 * len(places) + 0.5)
    fig.set_figwidth(6.5)
    for shift, (column, label, color, marker) in zip((-0.25, 0, 0.25), SERIES):
        rows = good(frame, column)
        ax.plot(on_log(rows[column]), rows["place"] + shift, marker, color=color, label=label, markerfacecolor="none",
                markersize=4, markeredgewidth=0.8)
    draw_failed(ax, failed(frame, "difference"), "difference", "place", {"color": BLUE, "marker": "o"})
    counts = names.value_counts()
    ax.set_yticks(list(places.values()), [f"{name} ({counts[name]})" for name in places])
    ax.set_ylim(len(places) - 0.5, -0.5)
    ax.set(xscale="log", xlabel="relative difference, relative residual", title=" and ".join(pairs.unique()))
    shared_legend(fig, [ax], columns=3)
    zeros = int((good(frame, "difference")["difference"] == 0).sum())
    drawn_at = f" Differences that are exactly 0: {zeros}." if zeros else ""
    footnote(fig, f"In brackets the number of steps.{drawn_at} " + reasons_note(failed(frame, "difference")))
    return fig
