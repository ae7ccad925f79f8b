"""Made-up tables of scenes that solvers fail on; none of the numbers means anything."""

from sample_files import RELAXATIONS, write


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


def generated_worlds(directory):
    write(directory, "generated_worlds", "refuted", "world variant step check what number bound",
          [(3, "as it is", 2, "momentum", "node 4", 2e-5, 1e-6), (7, "turned", 0, "depth", "colliders 1 and 2", 3e-3, 1e-6)])
    write(directory, "generated_worlds", "broken", "world kind reason", [(5, "refused", "mass of node 0: got 0; allowed: above 0")])
    write(directory, "generated_worlds", "ends", "status steps", [("ok", 3900), ("not_converged", 80), ("diverged", 12)])
    write(directory, "generated_worlds", "apart", "world variant difference turn_rad outcome",
          [(20, "other order", 0.12, 0.57, "another solution"), (449, "other linear solver", 0.99, 6.2, "not told")])
    write(directory, "generated_worlds", "judged", "world step step_s tolerance error_of_scale nearest_start nearest_error_m "
          "nearest_error_of_scale allowed reference_status reference_residual status reason",
          [(3, 1, 0.01, 1e-8, 2e-9, "own", 1e-9, 2e-9, 4e-7, "ok", 1e-12, "ok", ""),
           (9, 2, 0.02, 1e-8, 0.1, "claim", 1e-3, 1e-2, 4e-7, "ok", 1e-12, "ok", ""),
           (12, 3, 0.02, 1e-8, float("nan"), "own", float("nan"), float("nan"), float("nan"), "", float("nan"), "not_converged", "spent")])
    write(directory, "generated_worlds", "agreement", "variant first_steps outcome",
          [(variant, count, outcome) for variant in ("turned", "mirrored", "other order") for count, outcome in
           ((450, "the same"), (10, "told apart by the tolerance alone"), (3, "another solution"), (2, "not told"), (20, "one missed"))])


def tunnelling(directory):
    rows = [(*kinds, continuous, 30, 28, 20, 12, 2, passed if not continuous else 0, 1, passed, "ok", "")
            for continuous in (1, 0) for kinds, passed in ((("sphere", "box"), 7), (("box", "box"), 3), (("sphere", "cloth"), 12))]
    write(directory, "tunnelling", "pairs", "first second continuous scenes hits steps_ok steps_missed steps_turned passed_ok "
          "passed_in_touch passed_missed status reason", rows)
    write(directory, "tunnelling", "passed", "first second scene step_status", [("box", "box", 6, "ok, from touch"), ("sphere", "cloth", 3, "missed")])
