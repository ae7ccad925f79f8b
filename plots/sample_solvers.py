"""Made-up tables of linear solvers and of accuracy; none of the numbers means anything."""

import numpy as np

from sample_files import RELAXATIONS, write
from tables import columns

RATES = {"gauss_seidel": 0.95, "jacobi": 0.985, "nesterov_jacobi": 0.9, "direct": 1e-6}


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


def contact_convergence(directory):
    rates = RATES | {"conjugate_gradients": 0.8, "ista": 0.99, "fista": 0.95, "fista_restarted": 0.9, "power_law": 0.97}
    traces, gaps, bounds, budgets = [], [], [], []
    deformables = [(scene, law, name, 12, 300, k, rates[name] ** k, rates[name] ** k, "not_converged" if bad else "ok",
                    "sweeps spent" if bad else "")
                   for scene in ("box at rest on a soft block", "box strikes a cloth") for law in ("cone", "coulomb", "box")
                   for name in (*RELAXATIONS, "conjugate_gradients") for bad in [name == "jacobi"] for k in range(1, 400, 9)]
    for scene in ("column of 10", "sliding column"):
        for law in ("cone", "coulomb"):
            for name in (*RELAXATIONS, "conjugate_gradients"):
                bad = name == "jacobi"
                traces += [(scene, law, name, k, rates[name] ** k, rates[name] ** k, 1e-4 * rates[name] ** k,
                            "not_converged" if bad else "ok", "sweeps spent" if bad else "") for k in range(1, 400, 9)]
        for name, rate in rates.items():
            first, second = name in ("ista", "jacobi"), name in ("fista", "nesterov_jacobi")
            limit = [80 / k if first else 3200 / k ** 2 if second else float("nan") for k in range(1, 400, 9)]
            gaps += [(scene, name, k, rate ** k, bound, "ok", "") for k, bound in zip(range(1, 400, 9), limit)]
            bounds.append((scene, name, 6.0, 0.3 if first or second else float("nan"), -20 * np.log(rate),
                           {"fista": 300, "fista_restarted": 2}.get(name, 0), 400, "ok", ""))
            budgets += [(scene, name, k, rate ** k, rate ** k, 1e-4 * rate ** k, "ok", "") for k in (10, 100, 400)]
    for table, rows in (("traces", traces), ("gaps", gaps), ("bounds", bounds), ("budgets", budgets), ("deformables", deformables)):
        write(directory, "contact_convergence", table, " ".join(columns("contact_convergence", table)), rows)


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
                                          ("incremental", "gauss_seidel"), ("rival", "xpbd"), ("rival", "vbd")):
                    rate = 1 - 0.3 * 1e5 / young
                    floor = 4e-2 if outer == "incremental" else 6e-2 if relaxation == "xpbd" else 1e-11
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
        for quantity, reference in (("compliance_j", 1.3e-3), ("frequency_hz", 4.1), ("axial_j", 1e-5), ("poisson", 0.3)):
            if model == "tet_p1 reference" and quantity == "poisson":
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
    write(directory, "mesh_refinement", "locking", " ".join(columns("mesh_refinement", "locking")),
          [(n, 60 * n ** 3, nu, value, value, 4e-3, 1e-9, abs(value / 4e-3 - 1), *end)
           for n in (1, 2, 4) for nu in (0.0, 0.3, 0.49, 0.4999)
           for value in [4e-3 * (1 - 0.7 / n) * (1 - nu) ** 4]
           for end in [("not_converged", "outer iterations spent") if (n, nu) == (4, 0.4999) else ("ok", "")]])
    write(directory, "mesh_refinement", "mms", "n h_m error_l2 error_h1 order_l2 order_h1",
          [(n, 1 / n, 0.3 / n ** 2, 0.8 / n, float("nan") if n == 2 else 2.0, float("nan") if n == 2 else 1.0)
           for n in (2, 4, 8, 16)])
