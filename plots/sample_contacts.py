"""Made-up tables of the experiments on contact: none of the numbers means anything."""

from sample_files import write
from tables import columns

NAN = float("nan")
RELAXATIONS = ("gauss_seidel", "jacobi", "nesterov_jacobi", "conjugate_gradients", "direct")
LAWS = ("coulomb", "cone", "box", "disc")


def _write(directory, experiment, table, rows):
    write(directory, experiment, table, " ".join(columns(experiment, table)), rows)


def _answers(directory, experiment, quantities, laws=("coulomb",)):
    rows = []
    for i, (quantity, unit, bound) in enumerate(quantities):
        for k, relaxation in enumerate(RELAXATIONS):
            for j, law in enumerate(laws):
                lost, spent = (i, k, j) == (1, 2, 0), (i, k) == (0, 1)
                error = NAN if lost else bound * 10.0 ** (2 - k - 0.3 * j)
                rows.append((quantity, f"scene {i}", "implicit_euler", "auto", relaxation, law, 0.01, NAN if lost else 1 + error, 1.0,
                             unit, error, bound, 1000 * (k + 1), 100, 3 if spent else 0,
                             *(("diverged", "not finite") if lost else
                               ("not_converged", "outer iterations spent") if spent else ("ok", ""))))
    _write(directory, experiment, "answers", rows)


def incline(directory):
    _answers(directory, "incline", (("creep", "m/s over 10 s", 1e-9), ("threshold", "relative", 1e-5),
                                    ("acceleration", "relative", 1e-9), ("mass", "relative", 1e-9)), LAWS)


def stopping(directory):
    _answers(directory, "stopping", (("distance", "m", 1e-9), ("offset", "a h^2/8", 1.001), ("lift", "m", 1e-10), ("spin_down", "relative", 1e-9),
                                     ("pushed_row", "m", 1e-9)), LAWS)


def friction_isotropy(directory):
    rows = []
    for relaxation in ("conjugate_gradients", "direct"):
        for law in LAWS:
            for k in range(36):
                lost = (law, k) == ("disc", 7)
                share = NAN if lost else 1 + 0.4 * (law == "box") * (k % 9) / 9
                rows.append((relaxation, law, 0.01, 10.0 * k, share, share, NAN if lost else 1e-12 * (k + 1), 1e-13 * k,
                             NAN if lost else 1e-13 * (k + 1), *(("diverged", "not finite") if lost else ("ok", ""))))
    _write(directory, "friction_isotropy", "headings", rows)


def convex_gap(directory):
    rows = []
    for k, relaxation in enumerate(RELAXATIONS):
        for law in LAWS:
            for h in (1 / 60, 1 / 120, 1 / 240):
                spent = (k, law) == (1, "disc")
                expected = 0.4 * h if law == "cone" else 0.0
                rows.append((relaxation, law, h, 1.0, expected + 1e-12, expected, 1e-9, 1000, 5 if spent else 0,
                             *(("not_converged", "outer iterations spent") if spent else ("ok", ""))))
    _write(directory, "convex_gap", "gaps", rows)


def restitution(directory):
    _answers(directory, "restitution", (("heights", "of what a step allows", 1.0), ("energy", "relative", 1e-10),
                                        ("cradle", "of the speed", 1e-9)))
    _write(directory, "restitution", "heights",
           [(relaxation, h, e, n, e ** (2 * n) * (1 + h), e ** (2 * n), 10 * h, "ok", "")
            for relaxation in RELAXATIONS for h in (0.004, 0.001) for e in (0.5, 0.8) for n in range(1, 9)])


def coupling(directory):
    _answers(directory, "coupling", (("momentum", "of the lighter one's", 1e-10), ("sag", "relative", 1e-6), ("weight", "relative", 1e-8), ("hard_weight", "relative", 1e-8),
                                     ("capstan_holds", "m/s", 1e-9), ("capstan_slides", "of the least way", 1.0)))


def stack(directory):
    _answers(directory, "stack", (("weight", "relative", 1e-9), ("joints", "relative", 1e-8), ("penetration", "of the size", 1e-8),
                                   ("redundant_motion", "m", 1e-9), ("redundant_force", "relative", 1e-9),
                                   ("permuted_motion", "m", 1e-9), ("permuted_force", "of the mean", 1e-8)))
    rows = []
    for relaxation in ("conjugate_gradients", "direct"):
        for structure, counts, shares in (("overhang", (2, 3, 5), (0.999, 1.001)), ("arch", (7, 15), (1.01, 0.99))):
            for count in counts:
                for share, outcome in zip(shares, ("stands", "falls")):
                    lost = (relaxation, count, outcome) == ("direct", 15, "falls")
                    rows.append((structure, count, share, "auto", relaxation, "coulomb", 0.01, 3.0,
                                 NAN if lost else 1e-9 if outcome == "stands" else 1.5, outcome, 0 if lost else 1, 5000 * count,
                                 0, *(("diverged", "not finite") if lost else ("ok", ""))))
    _write(directory, "stack", "thresholds", rows)
