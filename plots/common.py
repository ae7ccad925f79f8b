"""What every figure shares: the register of figures, the style, drawing what failed, saving."""

import textwrap
import zlib
from types import MappingProxyType
from typing import Callable, NamedTuple

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import pandas as pd  # noqa: E402
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter  # noqa: E402

from command import replacing  # noqa: E402
from reading import LARGEST, TEXT, drawable, failed, good, text_number  # noqa: E402

ZERO_DRAWN_AT = 1e-17  # an exact zero on a logarithmic axis, below the resolution of any relative error

# Okabe and Ito's colours, told apart by colour-blind readers; marker and line tell them apart in grey.
BLACK, ORANGE, SKY, GREEN, YELLOW, BLUE, RED, PURPLE = (
    "#000000", "#E69F00", "#56B4E9", "#009E73", "#F0E442", "#0072B2", "#D55E00", "#CC79A7")
STYLES = {
    "gauss_seidel": (BLUE, "o", "-"), "jacobi": (ORANGE, "s", "--"), "nesterov_jacobi": (GREEN, "^", "-."),
    "conjugate_gradients": (PURPLE, "P", (0, (5, 1))),
    "direct": (BLACK, "D", ":"),
    "cone_interior_point": (SKY, "*", "-"), "cone_ipopt": (RED, "v", (0, (3, 1, 1, 1, 1, 1))),
    "plain": (RED, "o", "-"), "incremental": (SKY, "s", "--"), "proximal": (GREEN, "^", "-."),
    "quasi_newton": (PURPLE, "v", (0, (3, 1, 1, 1, 1, 1))), "frozen": (ORANGE, "P", ":"), "auto": (BLUE, "D", "-"),
    "judge": (BLACK, "*", ":"), "rival": (BLACK, "s", "--"), "newton": (BLACK, "s", "--"),
    "pendulum": (BLUE, "o", "-"), "chain20": (RED, "s", "--"), "cantilever": (GREEN, "^", "-."),
    "implicit_euler": (BLACK, "o", "-"), "bdf2": (GREEN, "^", "-."), "midpoint": (SKY, "s", "--"),
    "symplectic_euler": (PURPLE, "v", (0, (3, 1, 1, 1, 1, 1))), "generalised_alpha": (BLUE, "P", (0, (5, 1))),
    "newmark 0.5": (RED, "D", ":"), "newmark 0.52": ("#888888", "X", "-"), "newmark 0.55": (ORANGE, "*", "--"),
    "newmark 0.6": ("#8c564b", "h", "-."), "newmark 1": (BLACK, "o", ":"),
    "coulomb": (BLUE, "o", "-"), "cone": (RED, "s", "--"), "box": (ORANGE, "D", "-."), "disc": (GREEN, "^", ":"),
    "tet_p1": (BLUE, "o", "-"), "tet_p1 reference": (BLACK, "^", ":"), "springs": (RED, "s", "--"),
}
FALLBACK = [(BLUE, "o", "-"), (RED, "s", "--"), (GREEN, "^", "-."), (PURPLE, "v", ":"), (ORANGE, "D", "-"),
            (SKY, "P", "--"), (BLACK, "X", "-.")]

plt.rcParams.update({
    "font.size": 8, "axes.titlesize": 8, "axes.titlepad": 9, "axes.labelsize": 8,
    "xtick.labelsize": 7, "ytick.labelsize": 7, "legend.fontsize": 7, "legend.frameon": False,
    "legend.handlelength": 2.6, "figure.titlesize": 9, "axes.spines.top": False, "axes.spines.right": False,
    "axes.grid": True, "grid.color": "#dddddd", "grid.linewidth": 0.5, "axes.axisbelow": True,
    "lines.linewidth": 1.2, "lines.markersize": 3.5,
    "figure.constrained_layout.use": True, "svg.hashsalt": "pbdcheck", "svg.fonttype": "path", "pdf.fonttype": 42,
    "savefig.dpi": 200,
})

KINDS = {"png": {"Software": None}, "svg": {"Date": None}, "pdf": {"CreationDate": None}}  # and what they keep quiet

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


def style(name):
    """Colour, marker and line of a method, the same in every figure."""
    color, marker, line = STYLES.get(name) or FALLBACK[zlib.crc32(name.encode()) % len(FALLBACK)]
    return {"color": color, "marker": marker, "linestyle": line}


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


def panels(count, columns=3, width=6.5, height=2.1, **keywords):
    """A figure with `count` axes in a grid; unused axes are removed."""
    columns = min(columns, max(count, 1))
    rows = -(-max(count, 1) // columns)
    width = width if columns > 1 else 4.5
    figure, axes = plt.subplots(rows, columns, figsize=(width, height * rows + 0.7), squeeze=False, **keywords)
    for ax in axes.flat[count:]:
        ax.remove()
    for ax in axes.flat[max(count - columns, 0):count]:  # also those above a removed one
        ax.tick_params(labelbottom=True)
    return figure, list(axes.flat[:count])


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
    """Small text under the figure and its legend; `save` puts the footnotes in their places."""
    if text:
        characters = int(figure.get_figwidth() * 72 / (0.48 * size))
        figure.text(0.01, 0, textwrap.fill(text, characters), fontsize=size, color="#555555", va="top",
                    gid="footnote")


def _place_footnotes(figure):
    renderer = figure.canvas.get_renderer()
    figure.draw_without_rendering()
    height = figure.bbox.height
    bottom = min([0, *(legend.get_window_extent(renderer).y0 for legend in figure.legends)])
    for text in figure.texts:
        if text.get_gid() == "footnote":
            text.set_y((bottom - 4) / height)
            bottom = text.get_window_extent(renderer).y0


# ----------------------------------------------------------------------------------------------------------- saving

def _give_empty_axes_limits(figure):
    """A logarithmic axis without a single number to draw has no limits of its own."""
    for ax in figure.axes:
        if ax.get_xscale() == "log" and not np.isfinite(ax.dataLim.minposx):
            ax.set_xlim(1e-3, 1)
        if ax.get_yscale() == "log" and not np.isfinite(ax.dataLim.minposy):
            ax.set_ylim(1e-16, 1)


def power_text(value):
    """A power of ten or a multiple of it, as on the axes."""
    digit, exponent = f"{value:.0e}".split("e")
    times = "" if digit == "1" else digit + r"\cdot"
    return f"${times}10^{{{int(exponent)}}}$"


def _label_log_axes(figure):
    """Two labels at least on every logarithmic axis without labels of its own: powers of ten alone, else with 3 times
    each, else with 2 and 5 times; an axis that is too short for that grows."""
    for axis in (axis for ax in figure.axes for axis in (ax.xaxis, ax.yaxis)):
        if axis.get_scale() != "log" or not isinstance(axis.get_major_locator(), LogLocator):
            continue
        low, high = sorted(axis.get_view_interval())
        decades = np.arange(np.floor(np.log10(low)) - 1, np.ceil(np.log10(high)) + 2)
        for factors in ((1,), (1, 3), (1, 2, 5)):
            places = np.sort(np.outer(factors, 10.0 ** decades).ravel())
            if ((low <= places) & (places <= high)).sum() >= 2:
                break
        else:
            lowest, highest = places[places < low].max(), places[places > high].min()
            if ((low <= places) & (places <= high)).any():  # one more will do
                lowest, highest = (lowest, high) if low / lowest < highest / high else (low, highest)
            (axis.axes.set_xlim if axis.axis_name == "x" else axis.axes.set_ylim)(
                *((highest, lowest) if axis.get_inverted() else (lowest, highest)))
        if factors != (1,):
            axis.set_major_locator(LogLocator(subs=factors))
            plain = 1e-3 <= low and high <= 1e4
            axis.set_major_formatter(FuncFormatter(lambda v, _, plain=plain: f"{v:g}" if plain else power_text(v)))
        axis.set_minor_formatter(NullFormatter())


def _on_floor(figure):
    """Whether a marker stands at the floor of logarithmic axes."""
    return any((np.asarray(data, dtype=float) == ZERO_DRAWN_AT).any() for ax in figure.axes for line in ax.lines
               for data in line.get_data(orig=False))


def save(figure, directory, name, foot):
    """Writes DIR/name.{png,svg,pdf} with the provenance at the foot; the same input gives the same bytes."""
    directory.mkdir(parents=True, exist_ok=True)
    _give_empty_axes_limits(figure)
    _label_log_axes(figure)
    if _on_floor(figure):
        footnote(figure, f"Values below {text_number(ZERO_DRAWN_AT)}, and 0, stand there.")
    footnote(figure, foot.replace("$", r"\$"), size=4.5)
    _place_footnotes(figure)
    figure.set_layout_engine("none")  # laid out by now
    area = figure.get_tightbbox(figure.canvas.get_renderer()).padded(0.05)
    for kind, facts in KINDS.items():
        with replacing(directory / f"{name}.{kind}") as partial:
            figure.savefig(partial, format=kind, metadata=facts, bbox_inches=area)
    plt.close(figure)
