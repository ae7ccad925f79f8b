"""Made-up tables of elements beside springs; none of the numbers means anything."""

import math

from sample_files import write
from tables import columns

NAN = float("nan")
OK = ("ok", "")
MODELS = (("tet_p1", 1.3), ("springs", 1.1))


def fem_vs_springs(directory):
    bars, courses, cubes = [], [], []
    for model, stiff in MODELS:
        for n in (1, 2):
            for integrator, order in (("implicit_euler", 1), ("newmark", 2)):
                for h in (0.02, 0.01, 0.005):
                    error = (20 * h) ** order if n == 1 else NAN
                    bars.append((model, n, integrator, h, 1e-3 / stiff, 1e-3, 2 * stiff, 2 * stiff, 2 * stiff, 2.0, 0.9, 0.9, error,
                                 (20 * h) ** order, 0.03, *OK))
            courses += [(model, n, 0.01, t / 100, 1e-3 / stiff * math.cos(stiff * t / 5), 1e-3 * math.cos(t / 5), *OK) for t in range(40)]
            for scene in ("plate", "own weight"):
                for friction in (0.0, 0.5):
                    for nu in (0.0, 0.25, 0.3, 0.45):
                        known = friction == 0
                        bulge = 0.06 * (nu if model == "tet_p1" else 0.1)
                        bad = (model, n, nu, friction) == ("tet_p1", 2, 0.45, 0.5)
                        cubes.append((model, n, scene, friction, nu, 0.012, 0.012 if known else NAN, bulge, 0.06 * nu if known else NAN,
                                      278.0, 278.0, 1e-9, 1e-6, 6, 332, 113,
                                      *(("not_converged", "outer iterations spent") if bad else OK)))
    write(directory, "fem_vs_springs", "bars", " ".join(columns("fem_vs_springs", "bars")), bars)
    write(directory, "fem_vs_springs", "courses", " ".join(columns("fem_vs_springs", "courses")), courses)
    write(directory, "fem_vs_springs", "cubes", " ".join(columns("fem_vs_springs", "cubes")), cubes)
    write(directory, "fem_vs_springs", "networks", " ".join(columns("fem_vs_springs", "networks")),
          [(n, 0.8 - 0.6 / n, 0.1 + 0.2 / n, 0.1, 0.25, *OK) for n in (2, 4, 8)])
    write(directory, "fem_vs_springs", "cost", " ".join(columns("fem_vs_springs", "cost")),
          [(scene, model, 2, relaxation, 1e-8, 0.01, 900 * rows, 9, 5 * rows, 1e-3 * rows, *OK)
           for scene in ("bar", "cube") for model, rows in (("tet_p1", 3), ("springs", 1)) for relaxation in ("conjugate_gradients", "direct")])
