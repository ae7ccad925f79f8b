"""Made-up tables about the motion in time: none of the numbers means anything."""

from sample_write import write

RULES = (("implicit_euler", float("nan"), 1), ("newmark", 0.5, 2), ("newmark", 0.55, 1), ("bdf2", float("nan"), 2))


def time_order(directory):
    errors, orders = [], []
    for scene in ("spring", "hard pendulum"):
        for integrator, alpha, order in RULES:
            method = (scene, integrator, alpha, "auto", "direct")
            bad = scene == "hard pendulum" and alpha == 0.5
            status, reason = ("diverged", "the error exceeds the motion") if bad else ("ok", "")
            for k in range(5):
                error = 30.0 if bad else 0.1 * 2.0 ** (-order * k)
                errors.append((*method, 0.01 / 2 ** k, error, float("nan") if k == 0 else float(order), 1e-10, 1e-12, status, reason))
            orders.append((*method, 0.0 if bad else float(order), order, 4, 0.01 / 16, error, "diverging" if bad else "converging",
                           status, reason))
    write(directory, "time_order", "errors", "scene integrator alpha outer relaxation step_s error order error_solve "
          "error_reference status reason", errors)
    write(directory, "time_order", "orders", "scene integrator alpha outer relaxation order order_expected levels step_s error "
          "behaviour status reason", orders)
