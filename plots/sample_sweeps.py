"""Made-up tables of sweeps that are stopped and of friction that comes late; none of the numbers means anything."""

from sample_files import write
from tables import columns

NAN = float("nan")


def softness(directory):
    rows = []
    for h in (1 / 30, 1 / 60, 1 / 240):
        for compliance in (0.0, 1e-3):
            physical = 54 * compliance
            for name in ("gauss_seidel", "jacobi", "nesterov_jacobi"):
                for n in (1, 10, 100):
                    restless = (name, n) == ("nesterov_jacobi", 10)
                    stretch = physical + 40 * h * h / n
                    rows.append(("chain", "stopped", name, h, n, compliance, 1.0, stretch, stretch if name == "gauss_seidel" else NAN,
                                 physical, 1e-9 if name == "gauss_seidel" else NAN,
                                 *(("not_converged", "not at rest") if restless else ("ok", ""))))
        for factor in (0.1, 0.5):
            for n in (1, 5):
                rows.append(("chain", "classic", "gauss_seidel", h, n, 0.0, factor, h * h / factor / n, h * h / factor / n, 0.0, 1e-9, "ok", ""))
        rows += [("chain", "converged", name, h, 0, 1e-3, 1.0, 0.054, 0.054, 0.054, 1e-9, "ok", "") for name in ("gauss_seidel", "nesterov_jacobi")]
    rows += [("cloth", "stopped", "gauss_seidel", 1 / 60, n, 1e-5, 1.0, 0.1 / n, 1e-3, 1e-3, 100.0 / n - 1, "ok", "") for n in (1, 10)]
    write(directory, "softness", "stretches", " ".join(columns("softness", "stretches")), rows)


def late_friction(directory):
    rows = []
    for variant, late in (("within", 0.0), ("end", 1.0)):
        for scene in ("box on an incline", "pushed stack"):
            rows += [(scene, variant, h, "creep", 3.3 * h * late, 3.3 * h * late, 0.0, "m/s", 1e-14 + 0.2 * late, 1e-5 * late, 300 - 100 * late, 100, "ok", "")
                     for h in (1 / 60, 0.01, 0.001)]
            rows.append((scene, variant, 0.01, "threshold", 1 + 0.1 * late, 1.0, 0.01, "of tan a", 1e-14 + 0.2 * late, 0.0, 300 - 100 * late, 100, "ok", ""))
        rows.append(("arch", variant, 0.01, "displacement", late, 0.0, 0.0, "m", 1e-14 + 0.2 * late, 0.01 * late, 300 - 100 * late, 100, "ok", ""))
    write(directory, "late_friction", "motions", " ".join(columns("late_friction", "motions")), rows)
