"""Reading result files, for the figures and the report.

Tables are tidy CSV files, one observation a row. Text columns are those named in TEXT, all others are numbers written
with 17 digits, `nan`, `inf` or `-inf`. A row whose `status` is not `ok`, or whose value cannot be drawn, stays visible:
`good` and `failed` split a table so that every row is in one of the two.
"""

import csv
import json
import sys
from pathlib import Path

import numpy as np
import pandas as pd

CONTRACTING = ("converged", "converging")  # the error falls steadily
BEHAVIOURS = (*CONTRACTING, "oscillating", "diverging")
STATUSES = ("ok", "not_converged", "diverged", "skipped")
TEXT = {"scene", "outer", "relaxation", "integrator", "friction", "status", "reason", "behaviour", "theory", "model",
        "quantity", "effect", "strain", "reference", "reference_a", "reference_b", "tolerance_kind", "id", "statement",
        "verdict", "method", "case", "name"}


class InputError(Exception):
    """A result file that cannot be read: names the file, the place in it, and what is allowed."""


def fail(error):
    """Ends the program as every bad input does."""
    print(f"error: {error}", file=sys.stderr)
    sys.exit(2)


def read_table(path, columns=()):
    """A table as a DataFrame; raises InputError unless it has `columns` and every cell is well formed."""
    header, rows = _read_cells(Path(path))
    missing = [c for c in columns if c not in header]
    if missing:
        raise InputError(f"{path}: column '{missing[0]}' is missing; needed: {', '.join(columns)}; "
                         f"found: {', '.join(header)}")
    cells = {name: [row[i] for row in rows] for i, name in enumerate(header)}
    frame = pd.DataFrame({name: _column(path, name, values, name in columns) for name, values in cells.items()},
                         columns=header)
    _check_words(path, frame, "status", STATUSES)
    _check_words(path, frame, "behaviour", BEHAVIOURS)
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


def _column(path, name, values, needed):
    if name in TEXT:
        return values
    try:
        return _numbers(path, name, values)
    except InputError:
        if needed:
            raise
        return values  # a column nobody asked for may hold words


def _numbers(path, name, values):
    numbers = np.empty(len(values))
    for i, text in enumerate(values):
        try:
            numbers[i] = float(text) if text else np.nan
        except ValueError:
            raise InputError(f"{path}: line {i + 2}: column '{name}': got '{text}'; "
                             "allowed: a number, nan, inf, -inf or nothing") from None
    return numbers


def _check_words(path, frame, column, allowed):
    for i, word in enumerate(frame.get(column, ())):
        if word not in allowed:
            raise InputError(f"{path}: line {i + 2}: column '{column}': got '{word}'; allowed: {', '.join(allowed)}")


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


def drawable(frame, columns):
    """Which rows have finite, not negative numbers in all `columns`."""
    values = frame[list(columns)].to_numpy(dtype=float)
    return pd.Series((np.isfinite(values) & (values >= 0)).all(axis=1), index=frame.index)


def good(frame, *columns):
    """The rows that are ok and whose `columns` are finite and not negative."""
    ok = frame["status"].eq("ok") if "status" in frame else True
    return frame[ok & drawable(frame, columns)]


def failed(frame, *columns):
    """The rows `good` leaves out."""
    return frame.drop(good(frame, *columns).index)


def why(row):
    """Short text of what is wrong with a row of `failed`."""
    status = row.get("status", "ok")
    if status == "ok":
        return "ok, but not a number"
    return f"{status}: {row['reason']}" if row.get("reason") else status


def reasons_note(rows, limit=4):
    """The commonest reasons of failed rows with their counts, '' if there is none."""
    if rows.empty:
        return ""
    counts = rows.apply(why, axis=1).value_counts()
    lines = [f"{count} x {reason[:90]}" for reason, count in counts.head(limit).items()]
    if len(counts) > limit:
        lines.append(f"and {counts.iloc[limit:].sum()} more for {len(counts) - limit} other reasons")
    return "Crossed, not ok: " + "; ".join(lines)


def text_number(value):
    """A number with three digits: 0.004, 1e6."""
    return f"{value:.3g}".replace("e+0", "e").replace("e+", "e").replace("e-0", "e-")


def step_text(step):
    """A step size in seconds as the fraction people use."""
    inverse = 1 / step
    return f"1/{inverse:.0f} s" if inverse > 20.5 and abs(inverse - round(inverse)) < 1e-6 * inverse else f"{step:g} s"
