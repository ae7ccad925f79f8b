"""Draws the table of a comparison."""

from itertools import cycle

from command import command
from common import FALLBACK, literal, save
from reading import InputError, read_table
from tables import columns
from work_precision import draw_methods, method_name


def draw(frame):
    """Each method by the text that was given, with a look of its own."""
    looks = dict(zip(frame["method"].unique(), cycle(FALLBACK)))
    return draw_methods(frame, "wall_s", "wall time (s)", by="method", columns=1,
                        name=lambda row: method_name(row) if row["outer"] == "judge" else row["method"],
                        look=lambda row: dict(zip(("color", "marker", "linestyle"), looks[row["method"]])))


def main(directory):
    """Writes DIR/figures/compare_seconds."""
    path = directory / "compare.csv"
    frame = read_table(path, columns(".", "compare"))
    if frame.empty:
        raise InputError(f"{path}: got no rows; at least one is needed")
    save(draw(literal(frame)), directory / "figures", "compare_seconds", f"pbdcheck compare: {path}")


if __name__ == "__main__":
    command(main, "Draws DIR/compare.csv, as `pbdcheck compare` writes it: DIR/figures/compare_seconds.{png,svg,pdf}.")
