"""Made-up tables of the experiments on contact: none of the numbers means anything."""

from sample_files import write

NAN = float("nan")


def simbenchmark(directory):
    rows = []
    for name, floor in (("rolling_xy", 1e-9), ("rolling_y", 1e-9), ("bouncing", 1e-20), ("666", 1e-12), ("elastic_666", 1e2)):
        for k, h in enumerate((1e-2, 1e-3)):
            bad = name == "elastic_666" and k == 0
            rows.append((name, "pbdcheck", h, "newmark", 0.5, "auto", "conjugate_gradients", "coulomb", NAN if bad else floor * h ** 2, 10.0,
                         3 if bad else 0, 0.1 / h, NAN,
                         *(("diverged", "not finite") if bad else ("ok", ""))))
            for engine, error in (("RaiSim", 1e-4), ("ODE quick", 1e-2), ("Bullet", 1.0), ("DART", 10.0), ("MuJoCo Newton", 3.0)):
                rows.append((name, engine, h, "", NAN, "", "", "", error * h ** 2, NAN, NAN, NAN, 1.0 if k else NAN, "ok", ""))
    write(directory, "simbenchmark", "accuracy", "benchmark solver step_s integrator alpha outer relaxation friction error simulated_s "
          "missed_steps wall_s cpu_s status reason", rows)


def contact_hard_cases(directory):
    gates, frontier = [], []
    for scene in ("heavy cube on a small one", "house of cards", "coin"):
        for relaxation in ("direct", "conjugate_gradients", "gauss_seidel"):
            bad = relaxation == "gauss_seidel" and scene == "house of cards"
            end = ("not_converged", "outer iterations spent") if bad else ("ok", "")
            for gate, bound in (("finite", 0.0), ("energy", 0.01), ("penetration", 0.01)):
                measured = 0.0 if bound == 0 else 0.02 if bad else 1e-6
                gates.append((scene, 0.01, "implicit_euler", "auto", relaxation, "coulomb", 100, 90 if bad else 100, 5000, gate,
                              measured, bound, int(measured <= bound), *end))
        frontier.append((scene, "auto", "direct", "coulomb", NAN if scene == "coin" else 0.04, 10.0, "ok", ""))
    write(directory, "contact_hard_cases", "gates", "scene step_s integrator outer relaxation friction steps steps_ok sweeps gate "
          "measured bound holds status reason", gates)
    write(directory, "contact_hard_cases", "frontier", "scene outer relaxation friction largest_step_s fewest_sweeps status reason",
          frontier)
