"""What makes a figure readable: its finding as the title, made of its data, few panels, names beside the lines."""

import textwrap

import numpy as np

from styles import BLACK, RED
from wording import counted

MOST_PANELS, MOST_SERIES = 6, 7
TITLE = 9.0  # points


def finding(figure, *sentences):
    """What the data say, as the figure's title; empty sentences are left out."""
    characters = int(figure.get_figwidth() * 72 / (0.64 * TITLE))
    text = ". ".join(sentence for sentence in sentences if sentence) + "."
    figure.suptitle(textwrap.fill(text, characters), x=0.01, ha="left", fontsize=TITLE, fontweight="bold")


def fewer(groups, most=MOST_PANELS):
    """The first groups, one a panel, and a sentence on how many are left to the table."""
    groups = list(groups)
    left = len(groups) - most
    return groups[:most], f"In the table alone: {counted(left, 'more panel')}. " if left > 0 else ""


def first_and_last(cases, family):
    """The first and the last case of each family, in their order."""
    ends = {}
    for case in cases:
        ends.setdefault(family(case), []).append(case)
    kept = [id(case) for members in ends.values() for case in (members[0], members[-1])]
    return [case for case in cases if id(case) in kept]


def guide(ax, value, text="", horizontal=True, **look):
    """A bound or a level that marks are compared with, and its name beside the line."""
    line = ax.axhline if horizontal else ax.axvline
    line(value, **{"color": BLACK, "linewidth": 0.8, "linestyle": "--"} | look)
    if text and horizontal:
        ax.text(0.99, value, text, transform=ax.get_yaxis_transform(), ha="right", va="bottom", fontsize=6.5)
    elif text:
        ax.text(value, 1.0, text, transform=ax.get_xaxis_transform(), ha="center", va="bottom", fontsize=6.5)


def beyond(ax, low, high, horizontal=True):
    """Shades what a bound forbids."""
    (ax.axhspan if horizontal else ax.axvspan)(low, high, color=RED, alpha=0.1, linewidth=0)


def name_lines(ax, size=6.5):
    """The name of each labelled line at its last point, apart from the others; call it when all is drawn."""
    height = ax.get_position().height * ax.figure.get_figheight() * 72
    gap = 1.15 * size / height
    ends = []
    for line in ax.lines:
        x, y = (np.asarray(values, dtype=float) for values in line.get_data(orig=False))
        known = np.isfinite(x) & np.isfinite(y)
        if line.get_label().startswith("_") or not known.any():
            continue
        at = ax.transData.transform((x[known][-1], y[known][-1]))
        ends.append((ax.transAxes.inverted().transform(at)[1], line))
    ends.sort(key=lambda end: end[0])
    places = [np.clip(place, 0, 1) for place, _ in ends]
    for i in range(1, len(places)):
        places[i] = max(places[i], places[i - 1] + gap)
    excess = places[-1] - 1 if places else 0
    if excess > 0:
        places[-1] = 1
        for i in range(len(places) - 2, -1, -1):
            places[i] = min(places[i], places[i + 1] - gap)
    for place, (_, line) in zip(places, ends):
        ax.text(1.02, place, line.get_label(), transform=ax.transAxes, color=line.get_color(), fontsize=size, va="center",
                gid="name")
