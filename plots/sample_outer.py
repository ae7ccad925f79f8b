"""Made-up tables of outer iterations; none of the numbers means anything."""

import numpy as np

from sample_files import RELAXATIONS, write


def outer_convergence(directory):
    errors, rates = [], []
    for scene, step, ratio in [("pendulum", h, 1) for h in (0.2, 0.1, 0.05)] + \
            [("chain20", h, r) for r in (1, 100, 1000) for h in (1 / 30, 1 / 60, 1 / 240)]:
        kappa = 0.4 * (step / 0.2) ** 2 if scene == "pendulum" else 0.14 * (240 * step) ** 2 * ratio ** 0.45
        for outer, rate in (("plain", kappa), ("incremental", 0.1), ("proximal", kappa / (1 + kappa))):
            floor = 3e-3 if outer == "incremental" else 1e-15
            status = "ok" if rate < 1 else "diverged" if rate > 30 else "not_converged"
            reason = "" if rate < 1 else "budget of 60 outer iterations spent" if rate < 30 else "non-finite velocity"
            trace = np.minimum(1e3, np.maximum(floor, 0.3 * rate ** np.arange(60)))
            errors += [(scene, step, ratio, outer, "direct", k, float(e) if rate < 30 or k < 20 else float("nan"),
                        status, reason) for k, e in enumerate(trace)]
            if outer == "plain" and scene == "chain20":
                errors += [(scene, step, ratio, outer, "nesterov_jacobi", k, 0.5 * 0.9 ** k, "not_converged", "outer iterations spent") for k in range(60)]
            behaviour = "converged" if rate < 0.6 else "converging" if rate < 1 else "oscillating" if rate < 30 else "diverging"
            rates.append((scene, step, ratio, outer, rate, rate * 1.01 if rate < 30 else float("nan"), behaviour,
                          float(trace[-1]), status, reason))
    write(directory, "outer_convergence", "residuals", "scene step_s outer relaxation residual_share outer_iterations status reason",
          [(scene, 1 / 60, outer, relaxation, value, 9, *(("ok", "") if outer == "plain" else ("not_converged", "stalled away from the solution")))
           for scene in ("chain2", "tetrahedron green") for outer, relaxation, value in
           (("plain", "direct", 1e-13), ("incremental", "direct", 0.046), ("incremental", "gauss_seidel", 0.021), ("frozen", "direct", 0.1))])
    write(directory, "outer_convergence", "errors",
          "scene step_s mass_ratio outer relaxation iteration error status reason", errors)
    write(directory, "outer_convergence", "map",
          "scene step_s mass_ratio outer predicted_rate measured_rate behaviour error_final status reason", rates)


MAP_METHODS = (("plain", 20), ("proximal", 0), ("proximal", 20), ("quasi_newton", 20), ("auto", 20), ("incremental", 20),
               ("frozen", 20))


def map_row(outer, memory, rate, hard):
    """Integrator to reason of one cell, with a status of every kind among them."""
    method = ("implicit_euler", outer, "direct", memory)
    if outer == "quasi_newton" and hard:
        return (*method, float("nan"), float("nan"), float("nan"), 0, 0, "skipped", "hard rows")
    if outer in ("incremental", "frozen") or outer == "plain" and rate >= 1:
        wild = rate > 30
        return (*method, float("nan") if wild else rate, float("nan"), float("nan") if wild else 1e-3, 200, 200,
                "diverged" if wild else "not_converged", "not finite" if wild else "outer iterations spent")
    close = outer != "quasi_newton" or rate < 3
    count = int(4 + 10 * rate ** 0.5)
    return (*method, rate, float(count) if close else float("nan"), 1e-13 if close else 1e-7, count, count, "ok", "")


def stability_map(directory):
    columns = ("integrator outer relaxation memory predicted_contraction iterations error_final outer_iterations sweeps "
               "status reason")
    steps = (1 / 30, 1 / 60, 1 / 120, 1 / 240, 1 / 480)
    for table, value, values in (("chain20", "mass_ratio", (1, 10, 100, 1000)), ("rods10", "mass_ratio", (1, 30, 1000)),
                                 ("cantilever", "young_pa", (1e4, 1e6, 1e8))):
        write(directory, "stability_map", table, f"scene step_s {value} {columns}",
              [(table, h, v, *map_row(outer, memory, (60 * h) ** 2 * (v / values[0]) ** 0.4, value == "mass_ratio"))
               for v in values for h in steps for outer, memory in MAP_METHODS])
    write(directory, "stability_map", "cantilevers", f"scene step_s young_pa {columns}",
          [(scene, h, young, "implicit_euler", outer, relaxation, 20, 0.5, 9.0, *end)
           for scene in ("cantilever192 green", "cantilever1536 green") for young in (1e4, 1e6, 1e8) for h in steps[::2]
           for outer, relaxation, end in (("auto", "direct", (1e-13 * young ** 0.2, 9, 0, "ok", "")),
                                          ("proximal", "nesterov_jacobi",
                                           (1e-11, 20, 4000, "ok", "") if young < 1e8 else
                                           (1e-5 * h, 100, 100000, "not_converged", "outer iterations spent")))])
    write(directory, "stability_map", "predictions",
          "scene step_s mass_ratio predicted_rate predicted_contraction behaviour",
          [("chain20", h, r, k, 1.01 * k, "converged" if k < 1 else "oscillating")
           for r in (1, 10, 100) for h in steps for k in [(60 * h) ** 2 * r ** 0.4]])
    rows = []
    for scene, parameter, values in (("chain20", "mass_ratio", (1.0, 100.0)), ("cantilever", "young_pa", (1e4, 1e8))):
        for value in values:
            for relaxation in RELAXATIONS:
                bad = value == 1e8 and relaxation == "jacobi"
                key = (scene, 1 / 240, parameter, value, 0.3)
                for outer, updates, seconds in (("plain", 1000, 1e-3), ("auto", 800 if scene == "chain20" else 0, 9e-4)):
                    rows.append((*key, outer, relaxation, 9, updates // 20, updates, seconds, 1e-9,
                                 *(("not_converged", "outer iterations spent") if bad and outer == "plain" else ("ok", ""))))
    write(directory, "stability_map", "cost", "scene step_s parameter value measured_rate outer relaxation outer_iterations "
          "sweeps row_updates wall_s error status reason", rows)


def contraction(directory):
    kinds = (("distance", "", "N/m"), ("bending", "", "N m/rad"), ("triangle_strain", "", "Pa"),
             ("tet_strain", "green", "Pa"), ("tet_strain", "corotational", "Pa"), ("anchor", "", "N/m"),
             ("point_joint", "", "N/m"), ("axis_joint", "", "N m/rad"))
    rows = []
    for effect, strain, unit in kinds:
        for load in (-50, 50, 500):
            for h in (1 / 15, 1 / 30, 1 / 60):
                rate = 0.0 if effect == "anchor" else abs(load) * 5 * h ** 2
                tense, bad = load > 0, rate >= 1
                rows.append((effect, strain, h, 1e4, unit, load, rate, rate if tense else 0.0, rate if tense else 0.0,
                             1.5 * rate if tense else 0.0, float("nan") if bad else 0.99 * rate,
                             "not_converged" if bad else "ok", "the error does not fall" if bad else ""))
    write(directory, "contraction", "rates", "effect strain step_s stiffness unit load_n predicted_rate stiffening "
          "predicted_contraction bound measured_rate status reason", rows)


def contact_contraction(directory):
    rows = []
    for scene, slides, order in (("ball at rest on a ball", False, 2), ("ball rolls on a ball", False, 1), ("ball slides on a ball", True, 2)):
        for law in ("coulomb", "cone"):
            for h in (1 / 15, 1 / 30, 1 / 60):
                rate = 1.5 * (15 * h) ** order
                rows.append((scene, law, h, int(not slides), int(slides), 0.5, rate, 1.2 * rate, 0.999 * rate, int(rate < 1), "ok", ""))
    rows.append((scene, law, 1 / 120, 1, 0, 0.0, float("nan"), 1.2, float("nan"), 0, "not_converged", "a contact changes its state"))
    write(directory, "contact_contraction", "rates", "scene friction step_s sticking sliding margin predicted_rate "
          "predicted_contraction measured_rate returns status reason", rows)
