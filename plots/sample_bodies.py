"""Made-up tables of the experiments on rigid bodies: none of the numbers means anything."""

from sample_files import write
from sample_time import RULES, order_tables

NAN = float("nan")


def rotation(directory):
    order_tables(directory, "rotation", ("free body", "free body, explicit torque", "heavy top on a spring", "heavy top"))
    series, tumbling = [], []
    for integrator, alpha, order in (*RULES, ("midpoint", NAN, 2)):
        method = (integrator, alpha, "auto", "direct")
        for torque, sign in (("implicit", -1), ("explicit", 1)):
            bad = torque == "explicit" and alpha == 0.5
            for k in range(1, 31):
                time = 20 * k / 50 if bad else 20 * k / 30
                slow = 1e-15 if integrator == "midpoint" and sign < 0 else 0.01 if order == 1 else 1e-6
                change = 1e-3 * 1.5 ** k if bad else sign * slow * time
                series.append((torque, *method, 0.02, time, change, 0.1 * abs(change) + 1e-16, 0.05 * change, "ok", ""))
            if bad:
                series.append((torque, *method, 0.02, 12.02, NAN, NAN, NAN, "diverged", "energy grew a thousandfold"))
        for k, disturbance in enumerate((1e-2, 1e-3, 1e-6) if order == 2 else ()):
            for h in (0.04, 0.02):
                bad = alpha == 0.5 and k == 2 and h > 0.03
                error = NAN if bad else (0.2 + alpha if alpha > 0 else 0.4) * h ** 2
                exact = 20 + 8.0 * k
                tumbling.append((disturbance, *method, h, exact * (1 + error), exact, error,
                                 *(("not_converged", "outer iterations spent") if bad else ("ok", ""))))
    write(directory, "rotation", "series", "torque integrator alpha outer relaxation step_s time_s energy_change momentum_change "
          "momentum_length_change status reason", series)
    write(directory, "rotation", "tumbling", "disturbance_rad_s integrator alpha outer relaxation step_s period_s exact_s error "
          "status reason", tumbling)


def joints(directory):
    accuracy = []
    for mechanism, first, levels in (("A01 pendulum", 5e-3, 5), ("A02 four-bar chain", 4e-3, 3), ("A03 squeezer", 5e-5, 4),
                                     ("slider-crank", 5e-3, 2)):
        for integrator, alpha, order in (rule for rule in RULES if rule[1] != 0.5):
            for k in range(levels):
                exact = mechanism == "slider-crank"
                bad = mechanism == "A02 four-bar chain" and k == 0
                lost = bad and integrator == "bdf2"
                status, reason = ("diverged", "a joint came apart") if lost else \
                    ("not_converged", "outer iterations spent") if bad else ("ok", "")
                accuracy.append((mechanism, integrator, alpha, "auto", "direct", first / 2 ** k,
                                 NAN if lost else 1e-13 if exact else 0.03 * 2.0 ** (-order * k),
                                 NAN if k == 0 else float(order), 1.0 if lost else 1e-12 * 2.0 ** k, 3 if bad else 0,
                                 0.1 * 2 ** k, status, reason))
    write(directory, "joints", "accuracy", "mechanism integrator alpha outer relaxation step_s error order joint_error "
          "missed_steps wall_s status reason", accuracy)
    write(directory, "joints", "lengths", "relaxation bodies cpu_s_per_step cpu_s_per_sweep exponent_step exponent_sweep status "
          "reason",
          [(relaxation, count, 40 * cost * count, cost * count, 1.01, 1.0, "ok", "")
           for relaxation, cost in (("gauss_seidel", 1e-7), ("jacobi", 1.3e-7), ("nesterov_jacobi", 1.8e-7),
                                    ("conjugate_gradients", 2.2e-7), ("direct", 1e-6))
           for count in (50, 200, 800, 3200)])


def redundant(directory):
    rows = []
    for relaxation, floor, split in (("direct", 1e-14, 0.1), ("conjugate_gradients", 1e-12, 0.15), ("nesterov_jacobi", 1e-10, 0.15),
                                     ("gauss_seidel", 1e-9, 1.2)):
        for extra in range(4):
            spent = relaxation == "gauss_seidel" and extra in (0, 2)
            rows.append((relaxation, extra, 0.004, floor * extra, 10 * floor * extra, split * (extra > 0), 1000 * (1 + extra),
                         42000 * (1 + extra), 12 if spent else 0,
                         *(("not_converged", "outer iterations spent") if spent else ("ok", ""))))
    rows[7] = (*rows[7][:3], NAN, NAN, NAN, *rows[7][6:9], "diverged", "not finite")
    write(directory, "redundant", "motion", "relaxation redundant_joints step_s position_difference_m net_force_difference split "
          "sweeps row_updates missed_steps status reason", rows)
