"""The result folder that a report is about."""

import hashlib
import sys
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "plots"))
import reading  # noqa: E402
import tables  # noqa: E402

PRODUCERS = ("commit", "dirty", "changes", "version", "compiler", "flags", "march", "system", "processor", "cores", "threads", "seed",
             "tier", "libraries")


class File(NamedTuple):
    name: str
    lines: int
    sha256: str


class Animation(NamedTuple):
    scene: str
    path: Path
    rendered: bool  # from these very frames


LEDGER = "verify"  # the folder of `make verify`, no experiment's


class Results:
    """Only complete runs are read: beside them, a table may stem from an earlier run."""

    def __init__(self, directory):
        self.directory = Path(directory)

    def experiments(self):
        return sorted(p.name for p in self.directory.iterdir()
                      if p.is_dir() and p.name != LEDGER and (any(p.glob("*.csv")) or (p / "run.json").exists()))

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
        frame = self.verdicts(experiment) if table == "verdicts" else \
            reading.read_table(path, tables.columns(experiment, table))
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

    def files(self, experiment):
        """The tables and the record of a complete run."""
        folder = self.directory / experiment
        if self.shortfall(experiment):
            return []
        contents = {path.name: path.read_bytes() for path in [*sorted(folder.glob("*.csv")), folder / "run.json"]}
        return [File(name, data.count(b"\n"), hashlib.sha256(data).hexdigest()) for name, data in contents.items()]

    def drawn(self, experiment, name):
        """Whether a figure was drawn after the run ended."""
        paths = [self.directory / "figures" / f"{name}.{kind}" for kind in ("png", "svg", "pdf")]
        record = self.directory / experiment / "run.json"
        return record.is_file() and all(path.is_file() and path.stat().st_mtime >= record.stat().st_mtime for path in paths)

    def animations(self, experiment):
        """Of the scenes that left frames."""
        frame = self.table(experiment, "scenes")
        found = []
        for scene in frame["scene"].unique() if frame is not None else ():
            frames, path = (self.directory / experiment / scene / name for name in ("simulation.pvd", "animation.webp"))
            if frames.is_file():
                found.append(Animation(scene, path, path.is_file() and path.stat().st_mtime >= frames.stat().st_mtime))
        return found

    def producers(self, experiments):
        """What produced each complete run, as (key, value): the experiments."""
        found = {}
        for experiment in experiments:
            if not self.shortfall(experiment):
                run = self.run(experiment)
                found.setdefault(tuple((key, fact_text(run[key])) for key in PRODUCERS if key in run), []).append(experiment)
        return found


def fact_text(value):
    if isinstance(value, dict):
        return ", ".join(f"{key} {item}" for key, item in value.items())
    return {True: "yes", False: "no"}.get(value, str(value)) if isinstance(value, bool) else str(value)
