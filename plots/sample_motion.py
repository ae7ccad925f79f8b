"""Made-up tables of the experiments on motion: none of the numbers means anything."""

import numpy as np

from sample_files import write
from tables import columns

SCHEME = "scene family integrator outer relaxation direction_blend stabilisation "
SCHEMES = [("position", "implicit_euler", "auto", "direct", blend, float("nan")) for blend in (0.0, 0.25, 0.5, 0.75, 1.0)] + \
    [("position", "symplectic_euler", "auto", "direct", 0.0, float("nan"))] + \
    [("velocity", "implicit_euler", "frozen", "direct", 0.0, share) for share in (0.0, 0.2, 1.0)]


def direction(directory):
    spent, grew = ("not_converged", "outer iterations spent"), ("diverged", "energy grew")
    steps, modes, energy, work = [], [], [], []
    for scheme in SCHEMES:
        explicit = scheme[4] < 0.5
        for scene in ("taut chain20", "pendulum"):
            predicted = float("nan") if scene == "pendulum" else 0.007 if explicit else float("inf")
            steps.append((scene, *scheme, 0.007 if explicit else 0.07, predicted, 0.001, 400, 3, 50, "energy grew",
                          *(spent if scheme[4] == 0.75 else ("ok", ""))))
            for count in (1, 2, 4, 8):
                bad = grew if explicit and count < 4 and scene != "pendulum" else spent if count == 1 else ("ok", "")
                work.append((scene, *scheme, count, 1 / 60, 2.0, 100.0 * count, 1e-3 * 10.0 ** -count, 1e-4, 0.1, 3, 120, *bad))
        for mode in (5, 20):
            modes.append(("taut chain20", *scheme, mode, 0.003, 1 / (1 + scheme[4]), 1 / (1 + scheme[4]), 1e-9, 20, "ok", ""))
        for time in np.linspace(0, 10, 50):
            energy.append(("pendulum", *scheme, 1 / 60, float(time), -scheme[4] * float(time), 200.0, "ok", ""))
    write(directory, "direction", "largest_steps", SCHEME + "largest_step_s predicted_step_s error steps missed_steps "
          "most_outer_iterations limit status reason", steps)
    write(directory, "direction", "modes", SCHEME + "mode step_s predicted_left measured_left error row_updates status reason", modes)
    write(directory, "direction", "energy", SCHEME + "step_s time_s energy_j row_updates_per_s status reason", energy)
    write(directory, "direction", "equal_work", SCHEME + "linearisations_per_frame step_s duration_s row_updates_per_s error "
          "violation_rms energy_change missed_steps steps status reason", work)
    heavy, plain = ("stiffness", "implicit_euler", "proximal", "direct", 1.0, float("nan")), SCHEMES[4][:2] + ("plain",) + SCHEMES[4][3:]
    once = ("stiffness, one linearisation",) + heavy[1:]
    write(directory, "direction", "contenders", " ".join(columns("direction", "contenders")),
          [("taut chain20", *scheme, 0.007 * share, share, 1.0, 0.5, 1e-6, 500.0, 0 if share <= limit else 40, 100,
            *(("ok", "") if share <= limit else grew if scheme[0] == "velocity" else spent))
           for scheme, limit in ((SCHEMES[-1], 0.9), (plain, 0.45), (once, 8), (heavy, 8)) for share in (0.25, 0.45, 0.9, 1.1, 8.0)])
    write(directory, "direction", "contact", " ".join(columns("direction", "contact")),
          [("ball rolls off a ball", *scheme, count, 1 / 60, 1.0, 100.0 * count, error / 10.0 ** count, 1e-4, 3, 60, "ok", "")
           for scheme, error in ((plain, 1e-3), *((velocity, 1e-2) for velocity in SCHEMES[-3:])) for count in (1, 2, 4)])


def damping(directory):
    rules = (("implicit_euler", 1), ("bdf2", 2), ("newmark 0.55", 1))
    method = ("plain", "gauss_seidel")
    rows = []
    for scene in ("springs", "tetrahedron, breathing"):
        for rule, order in rules:
            for sweeps in (10, 1000):
                for h in (0.04, 0.02, 0.01):
                    bad = rule == "bdf2" and h == 0.04
                    rows.append((scene, rule, *method, sweeps, h, 0.01, 0.3, 0.3, 0.5 * (1 + (10 * h) ** order), 0.5, order,
                                 float("nan") if bad else 1e-12, 200, "not_converged" if bad else "ok",
                                 "outer iterations spent" if bad else ""))
    write(directory, "damping", "decrements", "scene integrator outer relaxation max_sweeps step_s retardation_s decrement "
          "predicted_decrement decay_per_s expected_decay_per_s order error row_updates status reason", rows)
    write(directory, "damping", "rotation", "scene integrator outer relaxation step_s retardation_s time_s vibration_j rotation_j "
          "drift_j row_updates status reason",
          [(scene, rule, *method, 0.001, damper, float(t), 5e-3 * float(np.exp(-800 * damper * t)), 1.0, 9.0, 10,
            "diverged" if rule == "bdf2" else "ok", "not finite" if rule == "bdf2" else "")
           for scene in ("vibrating", "steady") for rule, _ in rules for damper in (0.025, 0.0) for t in np.linspace(0, 1, 40)])
