"""The report as data, the same for HTML and LaTeX, and the parts every experiment has.

Texts are plain: `code` between backticks and citations as [@key] are all the marking there is.
"""

import sys
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "plots"))
import reading  # noqa: E402
import selecting  # noqa: E402
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
    drawn: bool = False  # from these very results


@dataclass
class Section:
    title: str
    question: str = ""
    notice: str = ""  # what a reader must not overlook
    paragraphs: list = field(default_factory=list)
    figures: list = field(default_factory=list)
    tables: list = field(default_factory=list)

    def tell(self, frame, *parts):
        """Adds the text or Table that each of `parts` makes of a result table, if there is one."""
        for part in parts if frame is not None else ():
            made = part(frame)
            (self.tables if isinstance(made, Table) else self.paragraphs).append(made)
        return self


class Results:
    """A result folder. Only complete runs are read: beside them, a table may stem from an earlier run."""

    def __init__(self, directory):
        self.directory = Path(directory)

    def experiments(self):
        return sorted(p.name for p in self.directory.iterdir()
                      if p.is_dir() and (any(p.glob("*.csv")) or (p / "run.json").exists()))

    def run(self, experiment):
        return reading.read_run(self.directory / experiment)

    def shortfall(self, experiment):
        """Why there is no complete run, '' if there is."""
        return reading.shortfall(self.run(experiment)) if (self.directory / experiment).is_dir() else "not run"

    def table(self, experiment, table):
        """The table as a DataFrame, None if it was not written or is empty."""
        path = self.directory / experiment / f"{table}.csv"
        if self.shortfall(experiment) or not path.exists():
            return None
        frame = reading.read_table(path, tables.columns(experiment, table))
        return frame if len(frame) else None

    def verdicts(self, experiment):
        """The verdicts of a complete run, as many as it says it had."""
        path = self.directory / experiment / "verdicts.csv"
        frame = reading.read_verdicts(path, tables.VERDICTS.split())
        counted, said = frame["verdict"].value_counts().to_dict(), self.run(experiment)["verdicts"]
        for word in reading.VERDICTS:
            if said.get(word) != counted.get(word, 0):
                raise reading.InputError(f"{path.parent / 'run.json'}: key 'verdicts': got {word} = {said.get(word)}; "
                                         f"allowed: {counted.get(word, 0)}, as in {path.name}")
        return frame

    def all_tables(self, experiment):
        """(name, DataFrame) of every table of a complete run but the verdicts."""
        for path in sorted((self.directory / experiment).glob("*.csv")):
            if path.stem not in tables.OWN_TABLES and not self.shortfall(experiment):
                yield path.stem, reading.read_table(path, tables.columns(experiment, path.stem))

    def drawn(self, experiment, name):
        """Whether a figure was drawn after the run ended."""
        paths = [self.directory / "figures" / f"{name}.{kind}" for kind in ("png", "svg", "pdf")]
        ended = (self.directory / experiment / "run.json").stat().st_mtime
        return all(path.is_file() and path.stat().st_mtime >= ended for path in paths)


def number(value):
    """A number for a text or a table, with three digits."""
    if np.isnan(value):
        return "not a number"
    return selecting.text_number(value) if np.isfinite(value) else ("inf" if value > 0 else "-inf")


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
    frame = None if results.shortfall(experiment) else results.verdicts(experiment)
    if frame is None or frame.empty:
        return []
    rows = [[f"`{row['id']}`", row["statement"], row["quantity"], number(row["measured"]), number(row["bound"]),
             row["verdict"]] for _, row in frame.iterrows()]
    return [Table("Verdicts: holds if measured is at most bound.",
                  ["id", "statement", "quantity", "measured", "bound", "verdict"], rows)]


def failures(results, experiments, limit=60):
    """What did not go well, counted over all tables: solves, however many rows each has."""
    counts = {}
    for experiment in experiments:
        for name, frame in results.all_tables(experiment):
            if "status" in frame:
                bad = frame[frame["status"] != "ok"].assign(reason=frame.get("reason", ""))
                if (experiment, name) in tables.SOLVES:
                    bad = bad.drop_duplicates([*tables.SOLVES[experiment, name].split(), "status", "reason"])
                for (status, reason), rows in bad.groupby(["status", "reason"]):
                    counts[experiment, name, status, reason] = len(rows)
    ordered = sorted(counts.items(), key=lambda entry: (entry[0][0], entry[0][1], -entry[1]))
    rows = [[f"`{e}/{t}`", f"`{status}`", reason, str(count)] for (e, t, status, reason), count in ordered[:limit]]
    if len(ordered) > limit:
        rows.append(["", "", f"{len(ordered) - limit} more reasons", str(sum(c for _, c in ordered[limit:]))])
    return rows


def summary_section(results, experiments):
    """How many verdicts hold, which do not, and what is missing."""
    rows, bad, missing, total = [], [], [], 0
    for experiment in experiments:
        shortfall = results.shortfall(experiment)
        if shortfall:
            missing.append(f"`{experiment}` ({shortfall})")
            rows.append([f"`{experiment}`", shortfall, "", ""])
            continue
        frame = results.verdicts(experiment)
        holds = (frame["verdict"] == "holds").sum()
        total += len(frame)
        bad += [f"`{i}`" for i in frame.loc[frame["verdict"] != "holds", "id"]]
        rows.append([f"`{experiment}`", reading.COMPLETE, f"{holds} of {len(frame)} hold",
                     number(results.run(experiment)["wall_s"])])
    text = f"{total - len(bad)} of {counted(total, 'verdict')} hold." + \
        (f" Those that do not: {', '.join(bad)}." if bad else "")
    notice = f"This report is incomplete. No result is shown of {', '.join(missing)}. " if missing else ""
    if len(producers(results, experiments)) > 1:
        notice += "The results stem from different programs, machines or settings, see Provenance."
    return Section("Summary", notice=notice, paragraphs=[text],
                   tables=[Table("Experiments.", ["experiment", "run", "verdicts", "wall time (s)"], rows)])


def failure_section(results, experiments):
    rows = failures(results, experiments)
    if not rows:
        return Section("What failed", paragraphs=["No solve in any table has a status other than `ok`."])
    return Section("What failed", paragraphs=[
        "Every solve whose status is not `ok`, counted by table and reason. A failure of a method is a result, and stays in "
        "the figures as a crossed marker."],
        tables=[Table("Solves that are not ok.", ["table", "status", "reason", "solves"], rows)])


def producers(results, experiments):
    """What produced each complete run, as facts: the experiments."""
    keys = ("commit", "dirty", "changes", "version", "compiler", "flags", "processor", "threads", "seed", "tier", "libraries")
    found = {}
    for experiment in experiments:
        if not results.shortfall(experiment):
            run = results.run(experiment)
            found.setdefault(tuple((key, fact_text(run[key])) for key in keys if key in run), []).append(experiment)
    return found


def provenance_section(results, experiments):
    """What produced each result."""
    return Section("Provenance", tables=[Table(f"Provenance of {listed(names)}.", ["fact", "value"], list(facts))
                                         for facts, names in producers(results, experiments).items()])


def fact_text(value):
    if isinstance(value, dict):
        return ", ".join(f"{key} {item}" for key, item in value.items())
    return {True: "yes", False: "no"}.get(value, str(value)) if isinstance(value, bool) else str(value)
