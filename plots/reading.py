"""Reading result files, for the figures and the report.

Tables are tidy CSV files, one observation a row. Text columns are those named in TEXT, all others are numbers written
with 17 digits, `nan`, `inf` or `-inf`.
"""

import csv
import json
from pathlib import Path

import numpy as np
import pandas as pd

CONTRACTING = ("converged", "converging")  # the error falls steadily
BEHAVIOURS = (*CONTRACTING, "oscillating", "diverging")
STATUSES = ("ok", "not_converged", "diverged", "skipped")
VERDICTS = ("holds", "fails", "missed", "not_decided")  # missed: a goal
CLASSES = ("code", "theory", "paper", "robustness", "goal")
COMPLETE = "complete"  # the status of a run that came to its end
LARGEST = 1e100  # what is larger is no more a result than infinity, and would overflow on an axis
SETTINGS = {"step_s", "mass_ratio", "young_pa", "poisson", "elements", "n", "h_m", "rows", "nodes", "iteration", "sweep",
            "sweeps", "outer_iterations", "row_updates", "memory", "error_target", "inner_tolerance",
            "disturbance_rad_s", "bodies", "redundant_joints", "contacts", "budget", "most_contacts",
            "most_rows"}  # chosen or counted: numbers
RUN = {"commit": str, "dirty": bool, "version": str, "compiler": str, "flags": str, "processor": str, "threads": int,
       "seed": int, "tier": str, "libraries": dict, "wall_s": (int, float), "verdicts": dict}  # of a complete run
TEXT = {"benchmark", "nearest_start", "reference_reason", "solver", "scene", "outer", "relaxation", "integrator", "friction", "status", "reason", "behaviour",
        "theory", "model", "quantity", "effect", "strain", "reference", "reference_a", "reference_b", "tolerance_kind", "id", "statement",
        "verdict", "class", "method", "case", "name", "unit", "gate", "reference_status",
        "parameter", "family", "limit", "torque", "mechanism", "structure", "outcome", "law", "variant",
        "check", "what", "kind", "truth", "first", "second", "step_status", "part", "presence"}


class InputError(Exception):
    """A result file that cannot be read: names the file, the place in it, and what is allowed."""


def read_table(path, columns=()):
    """A table as a DataFrame; raises InputError unless it has `columns`, every row that its run counted, and every cell
    is well formed."""
    header, rows = _read_cells(Path(path))
    _check_count(Path(path), len(rows))
    missing = [c for c in columns if c not in header]
    if missing:
        raise InputError(f"{path}: column '{missing[0]}' is missing; needed: {', '.join(columns)}; "
                         f"found: {', '.join(header)}")
    cells = {name: [row[i] for row in rows] for i, name in enumerate(header)}
    frame = pd.DataFrame({name: _column(path, name, values, name in columns) for name, values in cells.items()},
                         columns=header)
    _check_words(path, frame, "status", STATUSES)
    _check_words(path, frame, "behaviour", BEHAVIOURS)
    for column in columns:
        if column in SETTINGS:
            _check_setting(path, frame, column)
    return frame


def read_verdicts(path, columns):
    """A table of verdicts, each word of which is what the numbers beside it say."""
    frame = read_table(path, columns)
    _check_words(path, frame, "verdict", VERDICTS)
    _check_words(path, frame, "class", CLASSES)
    for i, row in frame.iterrows():
        if not np.isfinite(row["bound"]):
            raise InputError(f"{path}: line {i + 2}: column 'bound': got {row['bound']}; allowed: a finite number")
        truth = _ruling(row)
        if row["verdict"] != truth:
            raise InputError(f"{path}: line {i + 2}: column 'verdict': got '{row['verdict']}'; allowed: '{truth}', for "
                             f"measured = {row['measured']:.17g} and bound = {row['bound']:.17g}")
    return frame


def _ruling(row):
    """What a verdict's numbers say: a size within its bound holds, one that is not a number or negative never does."""
    low, value, high, bound = (row[name] for name in ("measured_low", "measured", "measured_high", "bound"))
    if 0 <= low <= value <= high <= bound:
        return "holds"
    if 0 <= low <= bound and low <= value <= high:
        return "not_decided"
    return "missed" if row["class"] == "goal" else "fails"


def _read_cells(path):
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = [row for row in csv.reader(file, strict=True)]
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"{path}: cannot be read as CSV: {error}") from error
    for line, row in enumerate(rows, start=1):
        for cell in row:
            if not cell.isprintable():
                raise InputError(f"{path}: line {line}: got {cell[:40]!r}; allowed: printable characters")
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


def _check_count(path, found):
    """Whether the table is whole: a file that is cut at a row's end looks like one that is."""
    record = path.with_name("run.json")
    counts = _read_record(record).get("rows", {}) if record.exists() else {}
    if not isinstance(counts, dict):
        raise InputError(f"{record}: key 'rows': got {json.dumps(counts)[:40]}; allowed: an object")
    counted = counts.get(path.stem, found)
    if counted != found:
        raise InputError(f"{path}: got {found} rows; allowed: {json.dumps(counted)[:40]}, as {record.name} says")


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


def _check_setting(path, frame, column):
    smallest = 1 / LARGEST if column == "step_s" else 0.0
    for i, value in enumerate(frame[column]):
        if not smallest <= value <= LARGEST:
            raise InputError(f"{path}: line {i + 2}: column '{column}': got {value:g}; allowed: {smallest:g} to {LARGEST:g}")


def read_run(directory):
    """The run.json of an experiment, {} if there is none: then the run did not come to its end."""
    path = Path(directory) / "run.json"
    if not path.exists():
        return {}
    run = _read_record(path)
    needed = {"status": str} | (RUN if run.get("status") == COMPLETE else {})
    for key, kind in needed.items():
        value = run.get(key)
        if not isinstance(value, kind) or isinstance(value, bool) != (kind is bool) or value != value:
            name = {str: "a text", bool: "true or false", dict: "an object"}.get(kind, "a number")
            raise InputError(f"{path}: key '{key}': got {json.dumps(value)[:40] if key in run else 'nothing'}; "
                             f"allowed: {name}")
    return run


def _read_record(path):
    try:
        run = json.loads(path.read_text(encoding="utf-8"))
        json.dumps(run, ensure_ascii=False).encode()  # half a character can be escaped, never written
    except (ValueError, RecursionError) as error:
        raise InputError(f"{path}: cannot be read as JSON: {error}") from error
    if not isinstance(run, dict):
        raise InputError(f"{path}: got {json.dumps(run)[:40]}; allowed: an object")
    return run


def shortfall(run):
    """Why a run is not complete, '' if it is."""
    if not run:
        return "no run.json, the run did not come to its end"
    if run["status"] == COMPLETE:
        return ""
    return run["status"] + (f": {run['reason']}" if run.get("reason") else "")


def provenance(run):
    """One line saying what produced the result of a complete run."""
    commit = run["commit"][:10] + (" (modified)" if run["dirty"] else "")
    return " | ".join([f"pbdcheck {run['version']}", f"commit {commit}", f"tier {run['tier']}", run["compiler"],
                       run["processor"], f"{run['threads']} thread(s)"])


NEXT_TO_SOLUTION, ALLOWED_RESIDUAL = 1e-6, 1e-9  # of the scale, and of the judge's equations, as the program has them


def solves_as_it_is(frame):
    """Of each step whether it is a solution by the judge's equations, next to none that the judge finds."""
    return (~(frame["nearest_error_of_scale"] <= NEXT_TO_SOLUTION) & (frame["claim_residual"] <= ALLOWED_RESIDUAL)).to_numpy()
