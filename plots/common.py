"""What every figure shares: the register of figures, drawing values and what failed."""

import textwrap
from types import MappingProxyType
from typing import Callable, NamedTuple

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

from reading import LARGEST, TEXT
from selecting import drawable, failed, good, text_number
from styles import BLACK, style

WIDTH = 6.5  # inches, of a whole figure
ZERO_DRAWN_AT = 1e-17  # an exact zero on a logarithmic axis, below the resolution of any relative error

FIGURES = []


class Figure(NamedTuple):
    experiment: str
    name: str
    table: str
    draw: Callable  # (DataFrame) -> matplotlib figure, None if there is nothing to draw


def figure(experiment, name, table):
    """Registers a function as the figure DIR/figures/<experiment>_<name> of DIR/<experiment>/<table>.csv."""
    def register(draw):
        FIGURES.append(Figure(experiment, name, table, draw))
        return draw
    return register


# ---------------------------------------------------------------------------------------------------------- drawing

def literal(frame):
    """The table with every $ in its texts as it stands, not as the begin of a formula."""
    return frame.assign(**{c: [text.replace("$", r"\$") for text in frame[c]] for c in TEXT & set(frame)})


def on_log(values):
    """Values for a logarithmic axis: exact zeros are drawn at ZERO_DRAWN_AT."""
    return np.maximum(values, ZERO_DRAWN_AT)


def draw_failed(ax, rows, x, y, look=MappingProxyType({"color": BLACK, "marker": "o"})):
    """Crossed markers: at the value where there is one, under the upper edge where only x is known. All rows
    that have no place at all are one marker in a column beside the right edge."""
    known = drawable(rows, [x]) & (rows[x] > 0)
    valued = drawable(rows, [x, y])
    for _, row in rows[valued].iterrows():
        crossed(ax, row[x], on_log(row[y]), look, ax.transData)
    for _, row in rows[known & ~valued].iterrows():
        crossed(ax, row[x], 0.97, look, ax.get_xaxis_transform())
    if (~known & ~valued).any():
        above = sum(artist.get_gid() == "no place" for artist in ax.lines)
        crossed(ax, 1.03, 0.97 - 0.08 * above, look, ax.transAxes, gid="no place")


def crossed(ax, x, y, look, transform, gid=None):
    """The marker of a method, larger, with a cross."""
    shared = {"markeredgewidth": 0.8, "transform": transform, "clip_on": False, "zorder": 5}
    ax.plot([x], [y], markersize=6, gid=gid, **{"markerfacecolor": "none"} | look | shared | {"linestyle": "none"})
    ax.plot([x], [y], "x", color=BLACK, markersize=4, **shared)


def curve(ax, frame, x, y, label, look):
    """The trace of one run: a line through every value there is, crossed where it ends badly or leaves the numbers."""
    rows = frame.sort_values(x)
    shown = drawable(rows, [x, y])
    ax.plot(rows[x][shown], on_log(rows[y][shown]), label=label, markevery=max(1, shown.sum() // 8),
            **{"markerfacecolor": "white"} | look)
    ends = rows[shown].tail(1)
    bad = pd.concat([ends[ends["status"] != "ok"], rows[~shown].head(1)])
    draw_failed(ax, bad, x, y, {"color": look["color"], "marker": look["marker"]})


def trace(ax, rows, values, name, low=-np.inf, high=np.inf):
    """A method's values over time, and a cross where a run ends that is not ok: at the last value there is, from `low` to
    `high`, or under the upper edge."""
    look = style(name)
    time = rows["time_s"].to_numpy()
    inside = np.isfinite(values) & (np.abs(values) <= LARGEST)
    every = max(1, inside.sum() // 6)
    start = len(ax.lines) % 8 * every // 8  # the markers of lines that cover each other stand apart
    ax.plot(time[inside], values[inside], label=name, markerfacecolor="white", markevery=(start, every), **look)
    if rows["status"].eq("ok").all():
        return
    look = {"color": look["color"], "marker": look["marker"]}
    if inside.any():
        crossed(ax, time[inside][-1], np.clip(values[inside][-1], low, high), look, ax.transData)
    else:
        crossed(ax, time[-1], 0.97, look, ax.get_xaxis_transform())


def curve_points(ax, points, x, y, label, look):
    """A line through the good points in the order of x; all others crossed."""
    rows = good(points, x, y).sort_values(x)
    ax.plot(on_log(rows[x]), on_log(rows[y]), label=label, **{"markerfacecolor": "white"} | look)
    draw_failed(ax, failed(points, x, y), x, y, look)


def slope_triangle(ax, x, y, order, color):
    """Where an error of this order would go from (x, y)."""
    right, top = 1.7 * x, y * 1.7 ** order
    ax.fill([x, right, right], [y, y, top], facecolor="none", edgecolor=color, linewidth=0.8)
    ax.text(right * 1.04, (y * top) ** 0.5, f"{order}", fontsize=7, color=color, va="center")


def ticks(ax, values, text=text_number):
    """Labels at these values of x alone."""
    values = sorted(set(values))
    ax.set_xticks(values, [text(value) for value in values])
    ax.set_xticks([], minor=True)


def order_triangles(ax, frame, x, y, orders=(1, 2)):
    """Triangles beside the finest level: of order 1 above the largest error there, of order 2 below the smallest."""
    finest = good(frame, x, y)
    finest = finest[finest[x] == finest[x].min()]
    for order in orders if len(finest) else ():
        error = 2.5 * finest[y].max() if order == 1 else 0.2 * finest[y].min()
        slope_triangle(ax, 1.6 * finest[x].iloc[0], on_log(error) * 1.6 ** order, order, BLACK)


def panels(count, columns=3, width=WIDTH, height=2.1, **keywords):
    """A figure with `count` axes in a grid; unused axes are removed."""
    columns = min(columns, max(count, 1))
    rows = -(-max(count, 1) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(width, height * rows + 0.7), squeeze=False, **keywords)
    for ax in axes.flat[count:]:
        ax.remove()
    for ax in axes.flat[max(count - columns, 0):count]:  # also those above a removed one
        ax.tick_params(labelbottom=True)
    return figure, list(axes.flat[:count])


def profile_line(ax, ratios, count, end, **look):
    """Dolan and More's performance profile: the share of `count` tasks that are solved within a multiple of the least time, up to
    `end`. `ratios` of times; inf and NaN: not solved."""
    own = np.sort(ratios[np.isfinite(ratios)])
    ax.step([1, *own, end], np.array([0, *range(1, len(own) + 1), len(own)]) / max(count, 1), where="post", **look)


def shared_legend(figure, axes, columns=4):
    """One legend under all axes, each label once."""
    entries = {}
    for ax in axes:
        for handle, label in zip(*ax.get_legend_handles_labels()):
            entries.setdefault(label, handle)
    if entries:
        figure.legend(entries.values(), entries.keys(), loc="upper center", bbox_to_anchor=(0.5, 0.0),
                      ncol=min(columns, len(entries)))


def footnote(figure, text, size=5.5):
    """Small text under the figure and its legend; `saving.save` puts the footnotes in their places."""
    if text:
        characters = int(figure.get_figwidth() * 72 / (0.48 * size))
        figure.text(0.01, 0, textwrap.fill(text, characters), fontsize=size, color="#555555", va="top",
                    gid="footnote")
