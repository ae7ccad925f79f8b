"""Writes made-up result tables in the shape the experiments give them: for the tests of the plots and the report.

None of the numbers means anything.
"""

import numpy as np

from command import command
from reading import InputError
from sample_bodies import joints, redundant, rotation
from sample_bench import contact_hard_cases, simbenchmark
from sample_cones import cone_problems, friction_cone
from sample_contacts import convex_gap, friction_isotropy, incline, restitution, stack, stopping
from sample_files import write, write_run
from sample_motion import damping, direction
from sample_time import energy, time_order

RELAXATIONS = ("gauss_seidel", "jacobi", "nesterov_jacobi", "direct")
RATES = {"gauss_seidel": 0.95, "jacobi": 0.985, "nesterov_jacobi": 0.9, "direct": 1e-6}


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
            behaviour = "converged" if rate < 0.6 else "converging" if rate < 1 else "oscillating" if rate < 30 else "diverging"
            rates.append((scene, step, ratio, outer, rate, rate * 1.01 if rate < 30 else float("nan"), behaviour,
                          float(trace[-1]), status, reason))
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


def inner_convergence(directory):
    scenes = ("chain20", "cantilever", "cloth")
    errors = [(s, r, k, 1e-5 * k * (4 if r == "direct" else 1), max(1e-15, RATES[r] ** k), "ok", "")
              for s in scenes for r in RELAXATIONS for k in range(0, 400, 4)]
    write(directory, "inner_convergence", "errors", "scene relaxation sweep wall_s error status reason", errors)
    theory = {"gauss_seidel": "spectral radius of the sweep", "jacobi": "1 - 1/condition", "direct": "0",
              "nesterov_jacobi": "1 - 1/sqrt(condition)"}
    rates = [(s, r, RATES[r], RATES[r] * 1.002 if r != "direct" else float("nan"), theory[r],
              "ok" if r != "direct" else "skipped", "" if r != "direct" else "exact after one sweep")
             for s in scenes for r in RELAXATIONS]
    write(directory, "inner_convergence", "rates",
          "scene relaxation predicted_rate measured_rate theory status reason", rates)


def conditioning(directory):
    rows = []
    for scene, parameter, values in (("chain20", "mass_ratio", (1.0, 100.0, 1e4)), ("cantilever", "young_pa", (1e3, 1e6, 1e9)),
                                     ("cantilever", "poisson", (0.0, 0.45, 0.4999))):
        for k, value in enumerate(values):
            for relaxation in RELAXATIONS:
                bad = relaxation == "jacobi" and k == 2
                sweeps = 10000 if bad else int(10 ** (k + 1) / -np.log(RATES[relaxation]))
                rows.append((scene, parameter, value, 10.0 ** (2 * k), relaxation, sweeps, 1e-3 if bad else 1e-7,
                             "not_converged" if bad else "ok", "sweeps spent" if bad else ""))
    write(directory, "conditioning", "sweeps", "scene parameter value condition relaxation sweeps residual status reason", rows)


def inexact(directory):
    rows = []
    for relaxation in ("gauss_seidel", "conjugate_gradients"):
        for step in (1 / 60, 1 / 240):
            for ratio in (1, 10, 100):
                for share, times in ((0.003, 1), (1e-10, 3)):
                    bad = relaxation == "gauss_seidel" and ratio == 100 and step > 1 / 100
                    sweeps = int(times * 1e4 * step * ratio)
                    rows.append(("chain20", step, ratio, "auto", relaxation, share, 20, sweeps, 20 * sweeps, 1e-3 if bad else 1e-9,
                                 "not_converged" if bad else "ok", "outer iterations spent" if bad else ""))
    write(directory, "inexact", "solves", "scene step_s mass_ratio outer relaxation inner_tolerance outer_iterations sweeps "
          "row_updates error status reason", rows)


def dual_vs_primal(directory):
    columns = "scene elements young_pa poisson strain outer relaxation sweeps error wall_s status reason"
    traces, final = [], []
    for young in (1e5, 1e6, 1e7):
        for poisson in (0.3, 0.45):
            for strain in ("green", "corotational"):
                for outer, relaxation in (("plain", "gauss_seidel"), ("plain", "nesterov_jacobi"),
                                          ("incremental", "gauss_seidel")):
                    rate = 1 - 0.03 * 1e5 / young
                    floor = 4e-2 if outer == "incremental" else 1e-11
                    bad = young == 1e7 and poisson > 0.4
                    status, reason = ("not_converged", "budget of 3000 sweeps spent") if bad else ("ok", "")
                    for sweeps in range(0, 3001, 100):
                        error = max(floor, 0.5 * rate ** sweeps)
                        traces.append(("cantilever", 192, young, poisson, strain, outer, relaxation, sweeps, error,
                                       1e-4 * sweeps, status, reason))
                    final.append(traces[-1])
    write(directory, "dual_vs_primal", "errors", columns, traces)
    write(directory, "dual_vs_primal", "final", columns, final)


def mesh_refinement(directory):
    rows = []
    for model, order, floor in (("tet_p1 reference", 1.8, 0.0), ("tet_p1", 1.8, 0.0), ("springs", 1.8, 0.2)):
        for quantity, reference in (("compliance_j", 1.3e-3), ("frequency_hz", 4.1), ("axial_j", 1e-5)):
            if model == "tet_p1" and quantity == "frequency_hz":
                continue
            for n in (1, 2, 4, 8):
                error = 0.7 * n ** -order + floor
                bad = n == 8 and model == "springs"
                value = float("nan") if bad else reference * (1 - error)
                rows.append((model, n, 5 * n ** 3 * 8, 0.25 / n, quantity, value, reference * 0.99, reference,
                             float("nan") if bad else abs(error - 0.01), float("nan") if bad else error,
                             "diverged" if bad else "ok", "non-finite positions" if bad else ""))
    write(directory, "mesh_refinement", "beam", "model n elements h_m quantity value reference_mesh reference_beam "
          "error_mesh error_beam status reason", rows)
    write(directory, "mesh_refinement", "mms", "n h_m error_l2 error_h1 order_l2 order_h1",
          [(n, 1 / n, 0.3 / n ** 2, 0.8 / n, float("nan") if n == 2 else 2.0, float("nan") if n == 2 else 1.0)
           for n in (2, 4, 8, 16)])


METHOD_COLUMNS = ("scene step_s integrator outer relaxation friction tolerance outer_iterations sweeps row_updates "
                  "wall_s error status reason")


def method_points(tolerance):
    rows = []
    for scene in ("chain20", "cantilever"):
        for outer, relaxation, speed in (("plain", "gauss_seidel", 1), ("plain", "nesterov_jacobi", 0.5),
                                         ("proximal", "gauss_seidel", 1.5), ("incremental", "gauss_seidel", 0.8),
                                         ("quasi_newton", "none", 0.4), ("rival", "newton", 0.1),
                                         ("judge", "primal_newton", 0.3)):
            for t in (1e-2, 1e-4, 1e-6, 1e-8):
                bad = outer in ("plain", "quasi_newton") and t < 1e-5 and scene == "chain20"
                work = int(20 * speed * np.log10(t) ** 2)
                error = float("nan") if bad and outer == "plain" else max(t * 0.4, 4e-3 if outer == "incremental" else 0)
                sweeps = 0 if outer in ("quasi_newton", "rival", "judge") else 10 * work
                rows.append((scene, 1 / 60, "implicit_euler", outer, relaxation, "coulomb", *([t] if tolerance else []),
                             work, sweeps, 19 * sweeps, 2e-6 * 190 * work, error,
                             "not_converged" if bad else "ok", "budget of 200 outer iterations spent" if bad else ""))
    return rows


def contact_points():
    rows = []
    for scene in ("incline", "arch"):
        for law in ("coulomb", "box"):
            for k, relaxation in enumerate((*RELAXATIONS, "cone_interior_point", "cone_ipopt")):
                judge = relaxation.startswith("cone_")
                for t in (0,) if judge else (1e-2, 1e-6, 1e-10):
                    bad = (scene, relaxation, t) == ("arch", "jacobi", 1e-10)
                    sweeps = 0 if judge else 10 * (k + 1) * int(1 - np.log10(t))
                    error = 0 if relaxation == "cone_interior_point" else 1e-11 if judge else max(t, 0.1 * (law == "box"))
                    rows.append((scene, 0.01, "implicit_euler", "judge" if judge else "auto", relaxation, law, t, 5, sweeps,
                                 3 * sweeps, 0.01 if judge else 1e-5 * sweeps, error,
                                 "not_converged" if bad else "ok", "outer iterations spent" if bad else ""))
    return rows


def work_precision(directory):
    write(directory, "work_precision", "points", METHOD_COLUMNS, method_points(True))
    write(directory, "work_precision", "contacts", METHOD_COLUMNS, contact_points())


def rival_newton(directory):
    times, traces = [], []
    for elements in (192, 1536, 31944):
        for young in (1e5, 1e6, 1e7):
            for poisson in (0.3, 0.49):
                for method, seconds, rate, most in (("quasi_newton", 3e-7, 0.7 if poisson < 0.4 else 0.95, 200),
                                                    ("newton", 3e-7 * elements ** 0.3, 1e-3, 4)):
                    key = ("cantilever", elements, young, poisson, method)
                    bad = young == 1e7 and method == "quasi_newton" and poisson > 0.4
                    status, reason = ("not_converged", "outer iterations spent") if bad else ("ok", "")
                    traces += [(*key, k, seconds * elements * k, rate ** k, status, reason) for k in range(most)]
                    for target in (1e-3, 1e-6, 1e-10):
                        count = int(np.ceil(np.log(target) / np.log(rate)))
                        times.append((*key, target, count, 1e-5 * elements, seconds * elements * count, target / 2,
                                      *((status, reason) if target < 1e-8 else ("ok", ""))))
    write(directory, "rival_newton", "times", "scene elements young_pa poisson method error_target iterations setup_s wall_s "
          "error status reason", times)
    write(directory, "rival_newton", "traces", "scene elements young_pa poisson method iteration wall_s error status reason",
          traces)


def effects_cost(directory):
    write(directory, "effects_cost", "costs", "scene effect rows bytes wall_s wall_s_per_step",
          [(s, e, rows, rows * b, 1e-7 * rows, 5e-9 * rows) for s, rows in (("cloth", 5000), ("cantilever", 9000))
           for e, b in (("distance", 120), ("tet_strain", 410), ("bending", 190), ("anchor", 60))]
          + [("cloth", "outside effects", 0, 0, 1e-3, 5e-5)])
    rows = [("cantilever", r, n, n // 6, 1e-8 * n * (2 if r == "jacobi" else 1), 1.01, "ok", "")
            for r in RELAXATIONS[:3] for n in (1000, 10000, 100000)]
    write(directory, "effects_cost", "scaling", "scene relaxation rows elements wall_s_per_sweep exponent status reason",
          rows + [("cantilever", "direct", 100000, 16666, float("nan"), 1.7, "skipped", "too large for the quick tier")])


def judges(directory):
    write(directory, "judges", "agreement", "scene nodes step_s reference_a reference_b difference residual_a "
          "residual_b wall_s_a wall_s_b status reason",
          [("pendulum", 2, 0.05, "primal_newton", "ode", 3e-14, 1e-15, 1e-13, 1e-5, 1e-3, "ok", ""),
           ("chain20", 21, 1 / 60, "primal_newton", "ipopt", 2e-11, 1e-15, 1e-11, 1e-4, 2e-2, "ok", ""),
           ("cantilever", 135, 1 / 60, "primal_newton", "ipopt", 4e-10, 1e-14, 1e-10, 1e-3, 0.4, "ok", ""),
           ("cloth", 400, 1 / 60, "primal_newton", "ipopt", float("nan"), 1e-14, float("nan"), 1e-3, 9.0,
            "not_converged", "Ipopt: iteration limit")])


def point_hard_cases(directory):
    rows, frontiers = [], []
    for scene, relaxation, bad in (("heavy rope", "gauss_seidel", True), ("heavy rope", "direct", False),
                                   ("twisted rod", "gauss_seidel", False)):
        status, reason = ("not_converged", "3 of 20 steps not ok; worst: outer iterations spent") if bad else ("ok", "")
        for gate, measured, bound in (("finite", 0.0, 0.0), ("energy", 0.3 if bad else -2.0, 0.01), ("claims", 0.2, 1.0)):
            rows.append((scene, 1 / 60, "implicit_euler", "auto", relaxation, 20, gate, measured, bound,
                         float(measured <= bound), status, reason))
        rows.append((scene, 1 / 60, "implicit_euler", "auto", relaxation, 20, "settles", 0.1, 1e-6, float("nan"), "skipped",
                     "settles in 4000 steps only, more than 300"))
        step, sweeps = (float("nan"),) * 2 if bad else (0.2, 30.0)
        frontiers.append((scene, "auto", relaxation, step, step / 2, sweeps, 0 if bad else 7, 9, status, reason))
    write(directory, "point_hard_cases", "gates",
          "scene step_s integrator outer relaxation steps gate measured bound holds status reason", rows)
    write(directory, "point_hard_cases", "frontier", "scene outer relaxation largest_step_s largest_solved_step_s "
          "fewest_sweeps runs_passed runs status reason", frontiers)


def generated_scenes(directory):
    spent = "outer iterations spent"
    write(directory, "generated_scenes", "outcomes", "relaxation steps claim_largest status reason",
          [(r, steps, claim, status, reason) for r in RELAXATIONS for steps, claim, status, reason in
           ((300, 0.6, "ok", ""), (150, 3e7, "not_converged", spent), (50, 0.0, "diverged", "not finite"))])
    rows = []
    for i in range(0, 500, 50):
        for k, relaxation in enumerate(RELAXATIONS):
            bad = (i + k) % 4 == 0
            claim = 1e3 * (k + 1) if bad else 0.1 * (k + 1)
            rows.append((f"generated {i}", 2 + i % 19, 0.01, "auto", relaxation, 10 + k, 100 * k, 1e-8 * claim, 1e-8 * claim,
                         claim, 1e-7 * claim, "ok", "not_converged" if bad else "ok", spent if bad else ""))
    write(directory, "generated_scenes", "sample", "scene nodes step_s outer relaxation outer_iterations sweeps residual "
          "residual_judged claim error reference_status status reason", rows)


VERDICTS = [("outer_convergence.rate", "The fixed point contracts at the predicted rate", "relative difference", 0.01, 0.05, "holds"),
            ("outer_convergence.all", "The plain iteration converges everywhere", "share not converged", 0.4, 0.0, "fails")]


def write_all(directory):
    for experiment in (outer_convergence, stability_map, contraction, inner_convergence, conditioning, inexact, dual_vs_primal,
                       mesh_refinement, time_order, energy, direction, damping, rotation, joints, redundant, incline, stopping,
                       friction_isotropy, convex_gap, restitution, stack, simbenchmark, contact_hard_cases, friction_cone, cone_problems,
                       work_precision, rival_newton,
                       effects_cost, point_hard_cases, generated_scenes, judges):
        experiment(directory)
        name = experiment.__name__
        write(directory, name, "verdicts", "id statement quantity measured bound verdict", VERDICTS)
        write_run(directory, name, holds=1, fails=1)
    write(directory, ".", "compare", METHOD_COLUMNS.replace("tolerance ", "") + " method",
          [(*row, row[4] if row[3] == "judge" else f"outer={row[3]} relaxation={row[4]}") for row in method_points(False)])


def main(directory):
    """Writes DIR, which must not hold anything: made-up numbers do not go among measured ones."""
    if directory.exists() and any(directory.iterdir()):
        raise InputError(f"{directory}: got a folder with files in it; allowed: a new or empty one")
    write_all(directory)


if __name__ == "__main__":
    command(main, "Writes made-up results, for trying the plots and the report: none of the numbers means anything.")
