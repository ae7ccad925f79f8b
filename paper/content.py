"""The report as data, the same for HTML and LaTeX, and the parts every experiment has.

Texts are plain: `code` between backticks and citations as [@key] are all the marking there is.
"""

import sys
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "plots"))
import reading  # noqa: E402
import tables  # noqa: E402


@dataclass
class Table:
    caption: str
    header: list
    rows: list  # of texts


@dataclass
class Figure:
    name: str  # DIR/figures/<name>.{png,svg,pdf}
    caption: str


@dataclass
class Section:
    title: str
    question: str = ""
    paragraphs: list = field(default_factory=list)
    figures: list = field(default_factory=list)
    tables: list = field(default_factory=list)


class Results:
    """A result folder."""

    def __init__(self, directory):
        self.directory = Path(directory)

    def experiments(self):
        return sorted(p.name for p in self.directory.iterdir()
                      if p.is_dir() and (any(p.glob("*.csv")) or (p / "run.json").exists()))

    def table(self, experiment, table):
        """The table as a DataFrame, None if it was not written or is empty."""
        path = self.directory / experiment / f"{table}.csv"
        if not path.exists():
            return None
        frame = reading.read_table(path, tables.columns(experiment, table))
        return frame if len(frame) else None

    def verdicts(self, experiment):
        path = self.directory / experiment / "verdicts.csv"
        return reading.read_table(path, tables.VERDICTS.split()) if path.exists() else None

    def run(self, experiment):
        return reading.read_run(self.directory / experiment)

    def all_tables(self, experiment):
        """(name, DataFrame) of every table but the verdicts."""
        for path in sorted((self.directory / experiment).glob("*.csv")):
            if path.stem not in tables.OWN_TABLES:
                yield path.stem, reading.read_table(path)


def number(value):
    """A number for a text or a table, with three digits."""
    if np.isnan(value):
        return "not a number"
    return reading.text_number(value) if np.isfinite(value) else ("inf" if value > 0 else "-inf")


def span(values):
    """Smallest to largest of the finite values."""
    values = np.asarray(values, dtype=float)
    values = values[np.isfinite(values)]
    if not len(values):
        return "no finite number"
    low, high = number(values.min()), number(values.max())
    return low if low == high else f"{low} to {high}"


def listed(words):
    """`a`, `b` and `c`."""
    words = [f"`{word}`" for word in words]
    return words[0] if len(words) == 1 else ", ".join(words[:-1]) + " and " + words[-1] if words else "none"


def counted(count, noun):
    return f"{count} {noun}" + ("" if count == 1 else "s")


def verdict_table(results, experiment):
    """The verdicts of an experiment, [] if it has none."""
    frame = results.verdicts(experiment)
    if frame is None or frame.empty:
        return []
    rows = [[f"`{row['id']}`", row["statement"], row["quantity"], number(row["measured"]), number(row["bound"]),
             row["verdict"]] for _, row in frame.iterrows()]
    return [Table("Verdicts: holds if measured is at most bound.",
                  ["id", "statement", "quantity", "measured", "bound", "verdict"], rows)]


def failures(results, experiments, limit=60):
    """What did not go well, counted over all tables."""
    counts = {}
    for experiment in experiments:
        for name, frame in results.all_tables(experiment):
            if "status" in frame:
                for (status, reason), rows in frame[frame["status"] != "ok"].groupby(
                        ["status", frame.get("reason", frame["status"])]):
                    counts[experiment, name, status, reason] = len(rows)
    ordered = sorted(counts.items(), key=lambda entry: (entry[0][0], entry[0][1], -entry[1]))
    rows = [[f"`{e}/{t}`", f"`{status}`", reason, str(count)] for (e, t, status, reason), count in ordered[:limit]]
    if len(ordered) > limit:
        rows.append(["", "", f"{len(ordered) - limit} more reasons", str(sum(c for _, c in ordered[limit:]))])
    return rows


def summary_section(results, experiments):
    """How many verdicts hold, and which do not."""
    rows, bad, total = [], [], 0
    for experiment in experiments:
        frame = results.verdicts(experiment)
        if frame is None:
            rows.append([f"`{experiment}`", "no verdicts", ""])
            continue
        holds = (frame["verdict"] == "holds").sum()
        total += len(frame)
        bad += [f"`{i}`" for i in frame.loc[frame["verdict"] != "holds", "id"]]
        rows.append([f"`{experiment}`", f"{holds} of {len(frame)} hold", number(results.run(experiment).get("wall_s", np.nan))])
    text = f"{total - len(bad)} of {counted(total, 'verdict')} hold." + \
        (f" Those that do not: {', '.join(bad)}." if bad else "")
    return Section("Summary", "", [text], [], [Table("Experiments.", ["experiment", "verdicts", "wall time (s)"], rows)])


def failure_section(results, experiments):
    rows = failures(results, experiments)
    if not rows:
        return Section("What failed", "", ["No row of any table has a status other than `ok`."])
    return Section("What failed", "", ["Every row whose status is not `ok`, counted by table and reason. A failure of a "
                   "method is a result, and stays in the figures as a crossed marker. A trace carries the status of its run in "
                   "every row, so that tables of traces count points, not runs."], [],
                   [Table("Rows that are not ok.", ["table", "status", "reason", "rows"], rows)])


def provenance_section(results, experiments):
    """What produced each result."""
    keys = ("commit", "dirty", "version", "compiler", "flags", "processor", "threads", "seed", "tier", "libraries")
    blocks = {}
    for experiment in experiments:
        run = results.run(experiment)
        facts = tuple((key, fact_text(run[key])) for key in keys if key in run)
        blocks.setdefault(facts, []).append(experiment)
    shown = []
    for facts, names in blocks.items():
        rows = [[key, text] for key, text in facts] or [["run.json", "missing"]]
        shown.append(Table(f"Provenance of {listed(names)}.", ["fact", "value"], rows))
    return Section("Provenance", "", [], [], shown)


def fact_text(value):
    if isinstance(value, dict):
        return ", ".join(f"{key} {item}" for key, item in value.items())
    return {True: "yes", False: "no"}.get(value, str(value)) if isinstance(value, bool) else str(value)
