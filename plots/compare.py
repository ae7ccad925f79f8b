"""Draws the table of a comparison."""

from itertools import cycle

import numpy as np

from command import command
from common import literal
from saving import save
from styles import FALLBACK
from reading import InputError, read_table
from tables import columns
from work_precision import draw_methods


def draw(frame):
    """Each method by the text that was given, with a look of its own."""
    looks = {method: dict(zip(("color", "marker", "linestyle"), look))
             for method, look in zip(frame["method"].unique(), cycle(FALLBACK))}
    return draw_methods(frame, "wall_s", "wall time (s)", frame["method"], lambda row: looks[row["method"]])


def main(directory):
    """Writes DIR/figures/compare_seconds."""
    path = directory / "compare.csv"
    frame = read_table(path, columns(".", "compare"))
    if frame.empty:
        raise InputError(f"{path}: got no rows; at least one is needed")
    for i, row in frame.iterrows():
        if row["status"] == "ok" and not np.isfinite(row["error"]):
            raise InputError(f"{path}: line {i + 2}: column 'error': got {row['error']}; allowed where the status is ok: "
                             "a finite number")
    save(draw(literal(frame)), directory / "figures", "compare_seconds", f"pbdcheck compare: {path}")


if __name__ == "__main__":
    command(main, "Draws DIR/compare.csv, as `pbdcheck compare` writes it: DIR/figures/compare_seconds.{png,svg,pdf}.")
