"""Draws every figure of a result folder:  /usr/bin/python3 plots/make.py DIR  writes DIR/figures."""

import sys
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

import dual_vs_primal  # noqa: F401  (each of these registers its figures)
import effects_cost  # noqa: F401
import inner_convergence  # noqa: F401
import judges  # noqa: F401
import mesh_refinement  # noqa: F401
import outer_convergence  # noqa: F401
import work_precision  # noqa: F401
from common import FIGURES, save
from reading import InputError, fail, provenance, read_run, read_table
from tables import OWN_TABLES, columns


def say(text):
    print(text, file=sys.stderr)


def draw(entry, directory):
    """Draws one figure; says so if its table is missing or holds nothing to draw."""
    path = directory / entry.experiment / f"{entry.table}.csv"
    if not path.exists():
        say(f"skipped: {entry.experiment}_{entry.name}: no {path}")
        return
    frame = read_table(path, columns(entry.experiment, entry.table))
    drawn = entry.draw(frame) if len(frame) else None
    if drawn is None:
        say(f"skipped: {entry.experiment}_{entry.name}: nothing to draw in {path}")
        return
    save(drawn, directory / "figures", f"{entry.experiment}_{entry.name}", provenance(read_run(path.parent)))


def without_figure(directory):
    """Result tables no figure reads."""
    read = {(entry.experiment, entry.table) for entry in FIGURES}
    return [path for path in sorted(directory.glob("*/*.csv"))
            if path.parent.name != "figures" and path.stem not in OWN_TABLES
            and (path.parent.name, path.stem) not in read]


def main(directory):
    if not directory.is_dir():
        raise InputError(f"{directory}: got no folder; allowed: a result folder, as written by `pbdcheck run`")
    with ProcessPoolExecutor() as pool:
        list(pool.map(partial(draw, directory=directory), FIGURES))
    for path in without_figure(directory):
        say(f"warning: {path}: no figure reads this table")


if __name__ == "__main__":
    try:
        main(Path(sys.argv[1] if len(sys.argv) > 1 else "results"))
    except InputError as error:
        fail(error)
