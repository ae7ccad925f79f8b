"""Writes a made-up table or run record; the relaxations that made-up tables name."""

import csv
import json
from pathlib import Path

RELAXATIONS = ("gauss_seidel", "jacobi", "nesterov_jacobi", "direct")


def write(directory, experiment, table, columns, rows):
    path = Path(directory) / experiment / f"{table}.csv"
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns.split())
        writer.writerows([repr(float(c)) if isinstance(c, float) else c for c in row] for row in rows)


def write_run(directory, experiment, holds=0, fails=0):
    """The run.json of a complete run."""
    run = {"commit": "0123456789abcdef", "dirty": True, "version": "0.1.0", "compiler": "g++ 12.2.0",
           "flags": "-O3 -march=native", "processor": "Made-up CPU", "date": "2026-01-02T03:04:05Z", "load": 1.5, "threads": 2, "seed": 1, "tier": "quick",
           "settings": {}, "libraries": {"Eigen": "3.4.0", "CHOLMOD": "5.12.0"}, "wall_s": 12.5,
           "verdicts": {"holds": holds, "fails": fails}, "status": "complete"}
    (Path(directory) / experiment / "run.json").write_text(json.dumps(run), encoding="utf-8")
