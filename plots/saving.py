"""Writing a figure: limits and labels of logarithmic axes, footnotes in their places, the files."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from command import replacing
from common import ZERO_DRAWN_AT, footnote
from selecting import text_number

KINDS = {"png": {"Software": None}, "svg": {"Date": None}, "pdf": {"CreationDate": None}}  # and what they keep quiet


def _place_footnotes(figure):
    renderer = figure.canvas.get_renderer()
    figure.draw_without_rendering()
    height = figure.bbox.height
    bottom = min([0, *(legend.get_window_extent(renderer).y0 for legend in figure.legends)])
    for text in figure.texts:
        if text.get_gid() == "footnote":
            text.set_y((bottom - 4) / height)
            bottom = text.get_window_extent(renderer).y0


def give_empty_axes_limits(figure):
    """A logarithmic axis without a single number to draw, nor one that shares it, has no limits of its own."""
    for ax in figure.axes:
        if ax.get_xscale() == "log" and not any(np.isfinite(other.dataLim.minposx) for other in
                                                ax.get_shared_x_axes().get_siblings(ax)):
            ax.set_xlim(1e-3, 1)
        if ax.get_yscale() == "log" and not any(np.isfinite(other.dataLim.minposy) for other in
                                                ax.get_shared_y_axes().get_siblings(ax)):
            ax.set_ylim(1e-16, 1)


def power_text(value):
    """A power of ten or a multiple of it, as on the axes."""
    digit, exponent = f"{value:.0e}".split("e")
    times = "" if digit == "1" else digit + r"\cdot"
    return f"${times}10^{{{int(exponent)}}}$"


def label_log_axes(figure):
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
    give_empty_axes_limits(figure)
    label_log_axes(figure)
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
