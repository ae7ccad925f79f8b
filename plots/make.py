"""Draws every figure of a result folder."""

import sys
from concurrent.futures import ProcessPoolExecutor
from functools import partial

import conditioning  # noqa: F401  (each of these registers its figures)
import cone_problems  # noqa: F401
import contact_contraction  # noqa: F401
import contact_convergence  # noqa: F401
import contraction  # noqa: F401
import damping  # noqa: F401
import default_method  # noqa: F401
import direction  # noqa: F401
import dual_vs_primal  # noqa: F401
import effects_cost  # noqa: F401
import energy  # noqa: F401
import fem_vs_springs  # noqa: F401
import judged_frames  # noqa: F401
import first_page  # noqa: F401
import frame_scaling  # noqa: F401
import friction  # noqa: F401
import friction_cone  # noqa: F401
import generated_scenes  # noqa: F401
import inexact  # noqa: F401
import inner_convergence  # noqa: F401
import joints  # noqa: F401
import large_scenes  # noqa: F401
import late_friction  # noqa: F401
import judges  # noqa: F401
import mesh_refinement  # noqa: F401
import outer_convergence  # noqa: F401
import point_hard_cases  # noqa: F401
import redundant  # noqa: F401
import rival_newton  # noqa: F401
import rotation  # noqa: F401
import scenes  # noqa: F401
import simbenchmark  # noqa: F401
import softness  # noqa: F401
import stability_map  # noqa: F401
import threads  # noqa: F401
import time_order  # noqa: F401
import trajectories  # noqa: F401
import tunnelling  # noqa: F401
import work_precision  # noqa: F401
from command import command
from common import FIGURES, literal
from saving import KINDS, save
from reading import InputError, provenance, read_run, read_table, shortfall
from tables import OWN_TABLES, columns


def say(text):
    print(text, file=sys.stderr)


def draw(entry, directory):
    """Draws one figure in place of an older one and returns whether it did; says so if its run is not complete or there is
    nothing to draw."""
    name = f"{entry.experiment}_{entry.name}"
    for kind in KINDS:
        (directory / "figures" / f"{name}.{kind}").unlink(missing_ok=True)
    path = directory / entry.experiment / f"{entry.table}.csv"
    if not path.exists():
        say(f"skipped: {name}: no {path}")
        return False
    run = read_run(path.parent)
    if shortfall(run):
        say(f"skipped: {name}: {path.parent}: {shortfall(run)}")
        return False
    frame = literal(read_table(path, columns(entry.experiment, entry.table)))
    frame.attrs["folder"] = path.parent
    drawn = entry.draw(frame) if len(frame) else None
    if drawn is None:
        say(f"skipped: {name}: nothing to draw in {path}")
        return False
    save(drawn, directory / "figures", name, provenance(run))
    return True


def without_figure(directory):
    """Result tables no figure reads."""
    read = {(entry.experiment, entry.table) for entry in FIGURES}
    return [path for path in sorted(directory.glob("*/*.csv"))
            if path.parent.name != "figures" and path.stem not in OWN_TABLES
            and (path.parent.name, path.stem) not in read]


def main(directory):
    """Writes DIR/figures."""
    if not directory.is_dir():
        raise InputError(f"{directory}: got no folder; allowed: a result folder, as written by `pbdcheck run`")
    with ProcessPoolExecutor() as pool:
        drawn = list(pool.map(partial(draw, directory=directory), FIGURES))
    for path in without_figure(directory):
        say(f"warning: {path}: no figure reads this table")
    if not any(drawn):
        raise InputError(f"{directory}: got no result to draw; allowed: a result folder with a complete run of an experiment")


if __name__ == "__main__":
    command(main, "Draws every figure of a result folder, as `pbdcheck run` writes it: DIR/figures/*.{png,svg,pdf}.")
