"""Made-up tables about the motion in time: none of the numbers means anything."""

from sample_files import write

RULES = (("implicit_euler", float("nan"), 1), ("newmark", 0.5, 2), ("newmark", 0.55, 1), ("bdf2", float("nan"), 2))


def order_tables(directory, experiment, scenes):
    """Tables of an order study; on the last scene the trapezoidal rule fails."""
    errors, orders = [], []
    for scene in scenes:
        for integrator, alpha, order in RULES:
            method = (scene, integrator, alpha, "auto", "direct")
            order = 1 if "explicit" in scene else order
            bad = scene == scenes[-1] and alpha == 0.5
            status, reason = ("diverged", "the error exceeds the motion") if bad else ("ok", "")
            for k in range(5):
                error = 30.0 if bad else 0.1 * 2.0 ** (-order * k)
                errors.append((*method, 0.01 / 2 ** k, error, float("nan") if k == 0 else float(order), 1e-10, 1e-12, status,
                               reason))
            orders.append((*method, 0.0 if bad else float(order), order, 4, 0.01 / 16, error, "diverging" if bad else "converging",
                           status, reason))
    write(directory, experiment, "errors", "scene integrator alpha outer relaxation step_s error order error_solve "
          "error_reference status reason", errors)
    write(directory, experiment, "orders", "scene integrator alpha outer relaxation order order_expected levels step_s error "
          "behaviour status reason", orders)


def time_order(directory):
    order_tables(directory, "time_order", ("spring", "hard pendulum"))


def energy(directory):
    nan = float("nan")
    series, drift, momentum, cells, frontier = [], [], [], [], []
    for integrator, alpha, order in RULES:
        for scene in ("hard pendulum", "free beam"):
            bad = scene == "hard pendulum" and alpha == 0.5
            status, reason = ("diverged", "energy grew by ten times its scale") if bad else ("ok", "")
            for k in range(20):
                change = 0.01 * 2.0 ** k if bad else -0.5 * k / 20
                series.append((scene, integrator, alpha, "auto", "direct", 1 / 60, 0.5 * k, 9.81 * change, 9.81, 1.0, 1 - 0.001 * k,
                               status, reason))
            for max_outer in (100, 1):
                momentum.append((scene, integrator, alpha, "auto", "direct", max_outer, 0.01, 100 if bad else 1000, 1000, 1e-15, 1e-3,
                                 nan if bad else 1e-14, status, reason))
        if order == 2:
            drift += [("spring_pendulum", integrator, alpha, "auto", "direct", 0.01 / 2 ** k, 1e-3 / 4 ** k, 4.0 if k else nan, "ok", "")
                      for k in range(3)]
    for compliance in (0.0, 1e-8, 1e-4):
        for step in (1 / 30, 1 / 120):
            frontier.append(("circling mass", compliance, step, 0.5 + step * (compliance < 1e-6), nan if step > 0.03 else 0.51))
            for alpha in (0.5, 0.51, 1.0):
                bad = compliance < 1e-6 and alpha == 0.5
                cells.append(("circling mass", "newmark", alpha, "auto", "direct", compliance, step, 1.1 if bad else 0.8,
                              2.0 if bad else 1.0, "diverged" if bad else "ok", "energy doubled" if bad else ""))
    write(directory, "energy", "series", "scene integrator alpha outer relaxation step_s time_s energy_j scale_j momentum_kg_m_s "
          "angular_momentum_kg_m2_s status reason", series)
    write(directory, "energy", "drift", "scene integrator alpha outer relaxation step_s drift ratio status reason", drift)
    write(directory, "energy", "momentum", "scene integrator alpha outer relaxation max_outer step_s steps steps_ok linear_error "
          "angular_error angular_unexplained status reason", momentum)
    write(directory, "energy", "map", "scene integrator alpha outer relaxation compliance_m_per_n step_s predicted_growth "
          "energy_factor status reason", cells)
    write(directory, "energy", "frontier", "scene compliance_m_per_n step_s predicted_alpha safe_alpha", frontier)
