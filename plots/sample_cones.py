"""Made-up solves of contact problems: every way a solver may fail."""

from sample_files import write
from tables import CONES

NAN = float("nan")


def cone_problems(directory):
    solves, large = [], []
    for law in ("cone", "coulomb"):
        for family, scale in (("full_rank", 1.0), ("wedge", 3.0)):
            for i in range(1, 6):
                solves.append((family, i, 10, law, "cone_interior_point", 1e-15, 1e-16, 1e-16, 1e-14, 0.0, 18 + i, 1e-3 * scale * i,
                               "ok", ""))
                if law == "cone" or i == 1:
                    missed = i == 3
                    solves.append((family, i, 10, law, "cone_ipopt", 1e-5 if missed else 1e-11, 1e-12, 1e-12, 1e-9,
                                   2e-3 if missed else 1e-9, 90, 0.03 * scale / i, *(
                                       ("not_converged", "natural residual 1e-05, asked for 1e-08") if missed else ("ok", ""))))
    solves[3] = (*solves[3][:5], NAN, NAN, NAN, NAN, NAN, 500, 1.0, "diverged", "not finite")
    for family, scale in (("regular", 1.0), ("hard", 4.0)):
        for contacts in (450, 900, 3000):
            large.append((family, 1, contacts, "cone", "cone_interior_point", 1e-15, 1e-16, 1e-16, 1e-14, 0.0, 25,
                          1e-4 * scale * contacts, "ok", ""))
    write(directory, "cone_problems", "solves", CONES, solves)
    write(directory, "cone_problems", "large", CONES, large)
