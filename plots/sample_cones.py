"""Made-up solves of contact problems: every way a solver may fail."""

from sample_files import write
from tables import CONES, columns

NAN = float("nan")
MISSED = ("not_converged", "natural residual 1e-05, asked for 1e-08")


def cone_problems(directory):
    solves, large = [], []
    for law in ("cone", "coulomb"):
        for family, scale in (("full_rank", 1.0), ("wedge", 3.0)):
            for i in range(1, 6):
                first = (family, i, 10, 30.0 * scale, law)
                solves.append((*first, "cone_interior_point", 1e-8, 1e-15, 1e-16, 1e-16, 1e-14, 0.0, 18 + i, 1e-3 * scale * i, "ok", ""))
                if law == "cone" or i == 1:
                    missed = i == 3
                    solves.append((*first, "cone_ipopt", 1e-8, 1e-5 if missed else 1e-11, 1e-12, 1e-12, 1e-9,
                                   2e-3 if missed else 1e-9, 90, 0.03 * scale / i, *(MISSED if missed else ("ok", ""))))
                for k, relaxation in enumerate(("gauss_seidel", "jacobi", "direct") + ("siconos_nsgs",) * (law == "coulomb")):
                    for tolerance in (1e-4, 1e-8):
                        missed = (k, i, tolerance) == (1, 2, 1e-8)
                        solves.append((*first, relaxation, tolerance, 1e-5 if missed else 0.9 * tolerance, 1e-12, 1e-12, tolerance,
                                       tolerance, 100 * (k + 1), 2e-4 * (k + 1) * i, *(MISSED if missed else ("ok", ""))))
    solves[4] = (*solves[4][:7], NAN, NAN, NAN, NAN, NAN, 500, 1.0, "diverged", "not finite")
    for law in ("cone", "coulomb"):
        for family, scale in (("regular", 1.0), ("hard", 4.0)):
            for contacts in (450, 900, 3000):
                first = (family, 1, contacts, NAN, law)
                if law == "cone":
                    large.append((*first, "cone_interior_point", 1e-8, 1e-15, 1e-16, 1e-16, 1e-14, 0.0, 25, 1e-4 * scale * contacts, "ok", ""))
                large.append((*first, "direct", 1e-8, 1e-9, 1e-16, 1e-16, 1e-9, NAN, 7, 3e-5 * scale * contacts, "ok", ""))
                large.append((*first, "jacobi", 1e-8, 1e-5, 1e-8, 1e-8, 1e-4, NAN, 2000, 3e-4 * contacts, *MISSED))
    write(directory, "cone_problems", "solves", CONES, solves)
    write(directory, "cone_problems", "large", CONES, large)


def friction_cone(directory):
    contacts, solves = [], []
    for law in ("cone", "coulomb"):
        for k, relaxation in enumerate(("cone_interior_point", "cone_ipopt", "gauss_seidel", "jacobi", "direct")):
            lost = (law, relaxation) == ("coulomb", "cone_ipopt")
            for i in range(1, 9):
                normal = 0.1 * (i - 1)
                share = 1.0 if i > 5 else 0.2 * i
                contacts.append((law, relaxation, i, 0.5, NAN if lost else normal, 0.5 * share * normal, 0.0, float(share == 1),
                                 1e-12 * i, 1e-13 * i, 1e-9))
            solves.append((law, relaxation, 8, NAN if lost else 1e-9, NAN if lost else 10.0 ** (-k), 0.0 if k == 0 else 10.0 ** (-k - 1),
                           3.0 if k == 3 else 1e-3, 20 + k, 1e-3, *(("diverged", "not finite") if lost else MISSED if k == 3 else
                                                                    ("ok", ""))))
    for table, rows in (("contacts", contacts), ("solves", solves)):
        write(directory, "friction_cone", table, " ".join(columns("friction_cone", table)), rows)
