"""What every figure shares: reading tables, the style, drawing what failed, provenance, saving.

Tables are tidy CSV files, one observation a row. Text columns are those named in TEXT, all others are numbers written
with 17 digits, `nan`, `inf` or `-inf`. A row whose `status` is not `ok`, or whose value cannot be drawn, stays visible:
`good` and `failed` split a table so that every row is in one of the two.
"""

import csv
import json
import os
import sys
import textwrap
import zlib
from pathlib import Path
from typing import Callable, NamedTuple

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import pandas as pd  # noqa: E402

STATUSES = ("ok", "not_converged", "diverged", "skipped")
TEXT = {"scene", "outer", "relaxation", "integrator", "friction", "status", "reason", "behaviour", "theory", "model",
        "quantity", "effect", "strain", "reference", "reference_a", "reference_b", "tolerance_kind", "id", "statement",
        "verdict", "method", "case", "name"}
ZERO_DRAWN_AT = 1e-17  # an exact zero on a logarithmic axis, below the resolution of any relative error

# Okabe and Ito's colours, told apart by colour-blind readers; marker and line tell them apart in grey.
BLACK, ORANGE, SKY, GREEN, YELLOW, BLUE, RED, PURPLE = (
    "#000000", "#E69F00", "#56B4E9", "#009E73", "#F0E442", "#0072B2", "#D55E00", "#CC79A7")
STYLES = {
    "gauss_seidel": (BLUE, "o", "-"), "jacobi": (ORANGE, "s", "--"), "nesterov_jacobi": (GREEN, "^", "-."),
    "direct": (BLACK, "D", ":"),
    "plain": (RED, "o", "-"), "incremental": (SKY, "s", "--"), "proximal": (GREEN, "^", "-."),
    "quasi_newton": (PURPLE, "v", (0, (3, 1, 1, 1, 1, 1))), "frozen": (ORANGE, "P", ":"), "auto": (BLUE, "D", "-"),
    "judge": (BLACK, "*", ":"),
    "pendulum": (BLUE, "o", "-"), "chain20": (RED, "s", "--"), "cantilever": (GREEN, "^", "-."),
    "tet_p1": (BLUE, "o", "-"), "springs": (RED, "s", "--"),
}
FALLBACK = [(BLUE, "o", "-"), (RED, "s", "--"), (GREEN, "^", "-."), (PURPLE, "v", ":"), (ORANGE, "D", "-"),
            (SKY, "P", "--"), (BLACK, "X", "-.")]

plt.rcParams.update({
    "font.size": 8, "axes.titlesize": 8, "axes.labelsize": 8, "xtick.labelsize": 7, "ytick.labelsize": 7,
    "legend.fontsize": 7, "legend.frameon": False, "legend.handlelength": 2.6, "figure.titlesize": 9,
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.color": "#dddddd",
    "grid.linewidth": 0.5, "axes.axisbelow": True, "lines.linewidth": 1.2, "lines.markersize": 3.5,
    "figure.constrained_layout.use": True, "svg.hashsalt": "pbdcheck", "svg.fonttype": "path", "pdf.fonttype": 42,
    "savefig.dpi": 200,
})


class InputError(Exception):
    """A result file that cannot be read: names the file, the place in it, and what is allowed."""


def fail(error):
    """Ends the program as every bad input does."""
    print(f"error: {error}", file=sys.stderr)
    sys.exit(2)


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


# ---------------------------------------------------------------------------------------------------------- reading

def read_table(path, columns=()):
    """A table as a DataFrame; raises InputError unless it has `columns` and every cell is well formed."""
    header, rows = _read_cells(Path(path))
    missing = [c for c in columns if c not in header]
    if missing:
        raise InputError(f"{path}: column '{missing[0]}' is missing; needed: {', '.join(columns)}; "
                         f"found: {', '.join(header)}")
    cells = {name: [row[i] for row in rows] for i, name in enumerate(header)}
    frame = pd.DataFrame({name: values if name in TEXT else _numbers(path, name, values)
                          for name, values in cells.items()}, columns=header)
    _check_status(path, frame)
    return frame


def _read_cells(path):
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = [row for row in csv.reader(file, strict=True)]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"{path}: cannot be read as CSV: {error}") from error
    if not rows or not any(rows[0]):
        raise InputError(f"{path}: line 1: got nothing; a header row is needed")
    header = rows[0]
    repeated = {c for c in header if header.count(c) > 1}
    if repeated:
        raise InputError(f"{path}: line 1: column '{min(repeated)}' stands twice; allowed: once")
    for line, row in enumerate(rows[1:], start=2):
        if len(row) != len(header):
            raise InputError(f"{path}: line {line}: got {len(row)} cells; allowed: {len(header)}, one a column")
    return header, rows[1:]


def _numbers(path, name, values):
    numbers = np.empty(len(values))
    for i, text in enumerate(values):
        try:
            numbers[i] = float(text) if text else np.nan
        except ValueError:
            raise InputError(f"{path}: line {i + 2}: column '{name}': got '{text}'; "
                             "allowed: a number, nan, inf, -inf or nothing") from None
    return numbers


def _check_status(path, frame):
    for i, status in enumerate(frame.get("status", ())):
        if status not in STATUSES:
            raise InputError(f"{path}: line {i + 2}: column 'status': got '{status}'; allowed: {', '.join(STATUSES)}")


def read_run(directory):
    """The run.json of an experiment, {} if there is none."""
    path = Path(directory) / "run.json"
    if not path.exists():
        return {}
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise InputError(f"{path}: cannot be read as JSON: {error}") from error


def provenance(run):
    """One line saying what produced a result."""
    if not run:
        return "provenance unknown: no run.json"
    commit = str(run.get("commit", "unknown"))[:10] + (" (modified)" if run.get("dirty") else "")
    parts = [f"pbdcheck {run.get('version', '?')}", f"commit {commit}", f"tier {run.get('tier', '?')}",
             f"{run.get('compiler', 'compiler ?')}", f"{run.get('processor', 'processor ?')}",
             f"{run.get('threads', '?')} thread(s)"]
    return " | ".join(parts)


# ------------------------------------------------------------------------------------------------- what can be drawn

def _drawable(frame, columns):
    """Which rows have finite, not negative numbers in all `columns`."""
    values = frame[list(columns)].to_numpy(dtype=float)
    return pd.Series((np.isfinite(values) & (values >= 0)).all(axis=1), index=frame.index)


def good(frame, *columns):
    """The rows that are ok and whose `columns` are finite and not negative."""
    ok = frame["status"].eq("ok") if "status" in frame else True
    return frame[ok & _drawable(frame, columns)]


def failed(frame, *columns):
    """The rows `good` leaves out."""
    return frame.drop(good(frame, *columns).index)


def on_log(values):
    """Values for a logarithmic axis: exact zeros are drawn at ZERO_DRAWN_AT."""
    return np.maximum(values, ZERO_DRAWN_AT)


def why(row):
    """Short text of what is wrong with a row of `failed`."""
    status = row.get("status", "ok")
    if status == "ok":
        return "ok, but not a number"
    return f"{status}: {row['reason']}" if row.get("reason") else status


def draw_failed(ax, rows, x, y, color=BLACK):
    """Hollow crossed markers: at the value where there is one, above the axes where there is none."""
    for _, row in rows.iterrows():
        at_value = np.isfinite(row[y]) and row[y] >= 0
        place = on_log(row[x]) if np.isfinite(row[x]) and row[x] >= 0 else None
        height = on_log(row[y]) if at_value else 1.03
        transform = ax.transData if at_value and place is not None else (
            ax.get_xaxis_transform() if place is not None else ax.transAxes)
        if place is None:
            place, height = 0.98, 1.03
        for marker, size in (("o", 6), ("x", 4)):
            ax.plot([place], [height], marker, color=color, markersize=size, markerfacecolor="none",
                    markeredgewidth=0.8, transform=transform, clip_on=False, zorder=5)


def reasons_note(rows, limit=4):
    """The commonest reasons of failed rows with their counts, '' if there is none."""
    if rows.empty:
        return ""
    counts = rows.apply(why, axis=1).value_counts()
    lines = [f"{count} x {reason[:90]}" for reason, count in counts.head(limit).items()]
    if len(counts) > limit:
        lines.append(f"and {counts.iloc[limit:].sum()} more for {len(counts) - limit} other reasons")
    return "Crossed, not ok: " + "; ".join(lines)


# ---------------------------------------------------------------------------------------------------------- drawing

def style(name):
    """Colour, marker and line of a method, the same in every figure."""
    color, marker, line = STYLES.get(name) or FALLBACK[zlib.crc32(name.encode()) % len(FALLBACK)]
    return {"color": color, "marker": marker, "linestyle": line}


def curve(ax, frame, x, y, label, look):
    """The trace of one run: a line through every value there is, crossed where it ends badly or leaves the numbers."""
    rows = frame.sort_values(x)
    drawable = _drawable(rows, [x, y])
    ax.plot(rows[x][drawable], on_log(rows[y][drawable]), label=label, markerfacecolor="white",
            markevery=max(1, drawable.sum() // 8), **look)
    ends = rows[drawable].tail(1)
    draw_failed(ax, pd.concat([ends[ends["status"] != "ok"], rows[~drawable].head(1)]), x, y, look["color"])


def curve_points(ax, points, x, y, label, look):
    """A line through the good points in the order of x; all others crossed."""
    rows = good(points, x, y).sort_values(x)
    ax.plot(on_log(rows[x]), on_log(rows[y]), label=label, markerfacecolor="white", **look)
    draw_failed(ax, failed(points, x, y), x, y, look["color"])


def panels(count, columns=3, width=6.5, height=2.1, **keywords):
    """A figure with `count` axes in a grid; unused axes are removed."""
    columns = min(columns, max(count, 1))
    rows = -(-max(count, 1) // columns)
    width = width if columns > 1 else 4.5
    figure, axes = plt.subplots(rows, columns, figsize=(width, height * rows + 0.7), squeeze=False, **keywords)
    for ax in axes.flat[count:]:
        ax.remove()
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


def text_number(value):
    """A short number for a label: 0.004, 1e6, 1/60 is left to the caller."""
    return f"{value:.3g}".replace("e+0", "e").replace("e+", "e").replace("e-0", "e-")


def step_text(step):
    """A step size in seconds as the fraction people use."""
    inverse = 1 / step
    return f"1/{inverse:.0f} s" if inverse > 20.5 and abs(inverse - round(inverse)) < 1e-6 * inverse else f"{step:g} s"


# ----------------------------------------------------------------------------------------------------------- saving

def _give_empty_axes_limits(figure):
    """A logarithmic axis without a single number to draw has no limits of its own."""
    for ax in figure.axes:
        if ax.get_xscale() == "log" and not np.isfinite(ax.dataLim.minposx):
            ax.set_xlim(1e-3, 1)
        if ax.get_yscale() == "log" and not np.isfinite(ax.dataLim.minposy):
            ax.set_ylim(1e-16, 1)


def save(figure, directory, name, foot):
    """Writes DIR/name.{png,svg,pdf} with the provenance at the foot; the same input gives the same bytes."""
    directory = Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    _give_empty_axes_limits(figure)
    footnote(figure, foot, size=4.5)
    _place_footnotes(figure)
    figure.set_layout_engine("none")  # laid out by now
    metadata = {"png": {"Software": None}, "svg": {"Date": None}, "pdf": {"CreationDate": None}}
    for kind, facts in metadata.items():
        partial = directory / f".{name}.partial.{kind}"
        figure.savefig(partial, format=kind, metadata=facts, bbox_inches="tight", pad_inches=0.05)
        os.replace(partial, directory / f"{name}.{kind}")
    plt.close(figure)
