"""Draws DIR/compare.csv, as `pbdcheck compare` writes it:  /usr/bin/python3 plots/compare.py DIR"""

import sys
from pathlib import Path

from common import save
from reading import InputError, fail, provenance, read_run, read_table
from tables import columns
from work_precision import draw_methods


def main(directory):
    frame = read_table(directory / "compare.csv", columns(".", "compare"))
    if frame.empty:
        raise InputError(f"{directory / 'compare.csv'}: got no rows; at least one is needed")
    fig = draw_methods(frame, "wall_s", "wall time (s)")
    save(fig, directory / "figures", "compare_seconds", provenance(read_run(directory)))


if __name__ == "__main__":
    try:
        main(Path(sys.argv[1] if len(sys.argv) > 1 else "results"))
    except InputError as error:
        fail(error)
