"""Writing a table in the shape the experiments give it."""

import csv
from pathlib import Path


def write(directory, experiment, table, columns, rows):
    path = Path(directory) / experiment / f"{table}.csv"
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns.split())
        writer.writerows([repr(float(c)) if isinstance(c, float) else c for c in row] for row in rows)
