"""Made-up tables of what accuracy costs; none of the numbers means anything."""

import numpy as np

from sample_files import RELAXATIONS, write
import tables

METHOD_COLUMNS = ("scene step_s integrator outer relaxation friction tolerance outer_iterations sweeps row_updates "
                  "wall_s error status reason")


def method_points(tolerance):
    rows = []
    for scene in ("chain20", "cantilever"):
        for outer, relaxation, speed in (("plain", "gauss_seidel", 1), ("plain", "nesterov_jacobi", 0.5),
                                         ("proximal", "gauss_seidel", 1.5), ("incremental", "gauss_seidel", 0.8),
                                         ("quasi_newton", "none", 0.4), ("rival", "newton", 0.1),
                                         ("judge", "primal_newton", 0.3)):
            for t in (1e-2, 1e-4, 1e-6, 1e-8, 1e-10):
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
        for law in ("coulomb", "cone", "box"):
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


RUN_COLUMNS = ("scene duration_s step_s integrator outer relaxation friction tolerance count outer_iterations sweeps row_updates "
               "missed_steps bytes wall_s memory_mb error error_bar energy_error penetration_m truth status reason")


def trajectories(directory):
    rows = []
    for scene, friction, bar, truth in (("pendulum", "none", 1e-14, "ODE of order 8"),
                                        ("pile", "coulomb", 1e-4, "640 steps by newmark, auto, direct, tolerance 1e-10")):
        for integrator, order in (("implicit_euler", 1), ("newmark", 1), ("bdf2", 2)):
            for outer, relaxation, count in (("auto", "direct", 0), ("auto", "conjugate_gradients", 0), ("incremental", "gauss_seidel", 10)):
                for step in (0.1, 0.01, 0.001, 0.0001):
                    for tolerance in (0,) if count else (1e-2, 1e-8):
                        skipped = integrator == "bdf2" and friction != "none"
                        wall = 1e-5 / step * (1 if count else 1 - np.log10(tolerance))
                        memory = 0.02 if relaxation == "gauss_seidel" else 0.05 if relaxation == "direct" else 0.03
                        error = float("nan") if skipped else 0.5 * step ** order + 0.1 * tolerance
                        rows.append((scene, 1, step, integrator, outer, relaxation, friction, tolerance, count, 100, 200, 300, 0, 4000,
                                     float("nan") if skipped else wall, float("nan") if skipped else memory, error, bar, error, 0, truth,
                                     "skipped" if skipped else "ok", "not with contact" if skipped else ""))
    write(directory, "trajectories", "runs", RUN_COLUMNS, rows)


def advice(directory):
    rows = [("spring", 1, 0.01, 0.02, "bdf2", "auto", "direct", 1e-4, 50, 0.004, 1e-6, 0.01, 0.01, "ok", ""),
            ("dominoes", 1, 0.01, 0.01, "implicit_euler", "auto", "direct", 1e-4, 9, float("nan"), 0.1, float("nan"), float("nan"),
             "skipped", "no setting found")]
    write(directory, "advice", "recommended", "scene duration_s error_asked step_s integrator outer relaxation tolerance settings error "
          "error_bar wall_s wall_s_other status reason", rows)


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
    write(directory, "effects_cost", "absent", tables.TABLES["effects_cost", "absent"],
          [(e, state, presence, 1 + d, 0.99 + d, 1.01 + d, 10 * d, 1, differ) for e, state, presence, d, differ in (
              ("none", "the same scene", "control", 0, 0), ("gravity", "empty", "empty", 0.001, 0), ("bending", "empty", "empty", -0.002, 0),
              ("contact", "never touches", "never touches", 0.15, 0), ("contact", "never touches itself", "never touches", 0.5, 0),
              ("distance", "damping 0", "idle", 0.02, 0), ("gyroscopic", "equal moments", "idle", 0.2, 12),
              ("body_distance", "limit never reached", "idle", 0.3, 0), ("probes", "empty", "empty", 0.004, 0),
              ("probes", "each kind but of joints", "used", 0.1, 0))])
    write(directory, "effects_cost", "stripped", tables.TABLES["effects_cost", "stripped"],
          [(f"{n} links", n, 1e-8 * n, 1.2e-8 * n, 0.83, 0.82, 0.84, 1e-16) for n in (100, 100000)])
    rows = [("cantilever", r, n, n // 6, 1e-8 * n * (2 if r == "jacobi" else 1), 1.01, "ok", "")
            for r in RELAXATIONS[:3] for n in (1000, 10000, 100000)]
    write(directory, "effects_cost", "scaling", "scene relaxation rows elements wall_s_per_sweep exponent status reason",
          rows + [("cantilever", "direct", 100000, 16666, float("nan"), 1.7, "skipped", "too large for the quick tier")])


def threads(directory):
    names = ("gauss_seidel", "coloured_gauss_seidel", "jacobi", "nesterov_jacobi", "conjugate_gradients")
    write(directory, "threads", "sweeps", tables.TABLES["threads", "sweeps"],
          [(s, r, t, 1000, 1000, 88000, 2e-5 / t, 1.9e-5 / t, 2.2e-5 / t, 4e9 * t, 4e10, 0.1 * t, 0.9 * t + 0.1, 1, "ok", "")
           for s in ("cloth", "solid") for r in names for t in (1, 2) if (r, t) != ("gauss_seidel", 2)])
    write(directory, "threads", "steps", tables.TABLES["threads", "steps"],
          [(s, "implicit_euler", "auto", r, t, 40, 5, 1e-2 / t, 9e-3 / t, 1.1e-2 / t, 0.8 * t + 0.2, 1, "ok", "")
           for s, r in (("boxes_on_ground", names[1]), ("flexible_cow", names[4])) for t in (1, 2)])
    write(directory, "threads", "roofline", tables.TABLES["threads", "roofline"],
          [(e, r, t, 1000, b, f, b / 1e10 / t, b / 1.1e10 / t, b / 9e9 / t, 1.2e10 * t, 5e10 * t, 0.8, "ok", "")
           for e, b, f in (("distance, 1 x 6", 88000, 43000), ("tet_strain, 6 x 12", 1300000, 474000), ("contact, 3 x 12", 700000, 190000))
           for r, t in (("gauss_seidel", 1), ("coloured_gauss_seidel", 2), ("nesterov_jacobi", 1), ("nesterov_jacobi", 2))])


def large_scenes(directory):
    rows = [(scene, unit, size, 3 * size, method, target, -np.log10(target), 1e-5 * size, 1e-6 * size * factor, 1e-3 * size, target / 2,
             *(("not_converged", "memory spent") if method == "newton" and size > 1e5 else ("ok", "")))
            for scene, unit in (("solid", "tetrahedra"), ("cloth", "cells")) for size in (1e4, 9e4, 3e5)
            for method, factor in (("quasi_newton", 1), ("newton", 5)) for target in (1e-3, 1e-6)]
    rows += [("columns", "boxes", 1e4, 6e4, "auto", target, 1, 0.1, 0.2, 50, target / 2, "ok", "") for target in (1e-3, 1e-6)]
    write(directory, "large_scenes", "steps", tables.TABLES["large_scenes", "steps"], rows)


def frame_scaling(directory):
    rows = [(scene, part, size, 20, 1 if size > 500 else 0, 2.5 * size, 9.0 * size, 3 * size ** power, 1e-4 * size ** (1 + power), 1e-5 * size,
             3e-5 * size, "not_converged" if size > 500 else "ok", "1 of 20 frames missed" if size > 500 else "")
            for scene, power in (("boxes_on_ground", 0.4), ("bunnies_on_cloth", 0.1), ("flexible_cow", 0.0))
            for size in (16, 125, 1000) for part in ("falls", "strikes")]
    write(directory, "frame_scaling", "frames", "scene part size frames missed_frames contacts rows iterations frame_cpu_s begin_cpu_s "
          "iteration_cpu_s status reason", rows)
    write(directory, "frame_scaling", "exponents", "scene part quantity exponent low high",
          [("boxes_on_ground", part, quantity, 1.3, 1.2, 1.4) for part in ("falls", "strikes")
           for quantity in ("frame", "until the first iterate", "iterations", "an iteration", "rows")])
