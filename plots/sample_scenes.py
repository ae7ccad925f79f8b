"""Made-up tables of whole scenes: none of the numbers means anything."""

import tables
from sample_files import write

SCENES = (("boxes_on_ground", 125, 126, 0), ("bunnies_on_cloth", 5, 1687, 0), ("flexible_cow", 0, 1047, 3552))


def figure_1(directory):
    scenes, series = [], []
    for name, bodies, nodes, elements in SCENES:
        bad = name == "bunnies_on_cloth"
        status = ("not_converged", "outer iterations spent") if bad else ("ok", "")
        scenes.append((name, 1 / 60, 2, bodies, nodes, elements, 900, 2700, 120, 117 if bad else 120, 900, 90000, 0.2, 0.004, 1e-5,
                       1e-4, 0, 0, 0.01, 117 if bad else 120, 0, *status))
        for k in range(1, 25):
            missed = bad and k == 7
            series.append((name, 1 / 60, k / 12, 10.0 / k, -3.0 * k, 100, 1e-4 / k, 1e-5, 9, 900, 1e-4, 0.2 + 0.01 * k,
                           *(status if missed else ("ok", ""))))
    write(directory, "figure_1", "scenes", tables.SCENES, scenes)
    write(directory, "figure_1", "series", tables.TABLES[("figure_1", "series")], series)
    write(directory, "figure_1", "frames", tables.FRAMES,
          [judged(name, 1e-10, k, known=(name, k) != ("bunnies_on_cloth", 2)) for name, *_ in SCENES for k in range(1, 5)])


def contact_scenes(directory):
    rows = []
    for name, bodies, excess, rest in (("stack", 4, 0.0, 1e-12), ("dominoes", 12, 1e-5, 1e-9), ("trampoline", 1, 0.0, 0.3), ("conveyor", 1, 0.2, 0.1)):
        for steps in (100, 200):
            rows.append((name, 1 / steps, 1, bodies, 30, 0, 40, 120, steps, steps, 300, 900, 1e-3, 1e-6, 1e-7, 0.0, int(name == "conveyor"), excess, rest,
                         steps, 0, "ok", ""))
    write(directory, "contact_scenes", "scenes", tables.SCENES, rows)


def judged(scene, tolerance, k, known=True):
    """The row of a sampled step, which the judge knows or not."""
    none = float("nan")
    errors = (tolerance, 3 * tolerance, "claim" if k == 3 else "own", 1e-3 * tolerance, tolerance / 2 if k != 4 else 1e-3)
    return (scene, 20, 0.01, 10 * k, k / 10, tolerance,
            *(("not_converged", "outer iterations spent") if k == 5 and scene == "trampoline" else ("ok", "")),
            *(errors if known else (none, none, "own", none, none)), "cone_interior_point",
            *(("ok", "", 1e-15, 0.1) if known else ("not_judged", "contacts act that met on the way", 0.0, 0.0)),
            1e-10 if k == 4 and scene == "trampoline" else none)


def judged_frames(directory):
    rows = [judged(scene, tolerance, k) for scene in ("incline", "trampoline") for tolerance in (1e-4, 1e-6, 1e-8) for k in range(1, 6)]
    write(directory, "judged_frames", "frames", tables.FRAMES, rows)
