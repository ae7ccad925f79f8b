"""Contact with friction: are the problems of one step solved?"""

from content import Figure, Section, Table, counted, number, share, span
from selecting import tightest

AGREEMENT = 1e-6  # m/s


def cone_problems(results):
    section = Section(
        "Who solves contact problems with friction?",
        "One step's contacts are a problem in impulses r and velocities u = W r + q. The convex law `cone` asks for r in the cone "
        "|r_T| <= mu r_N, for u in the dual cone, and for r . u = 0; Coulomb's law asks the same of u + mu |u_T| n. A random solution is drawn "
        "first and q is computed from it, in eight families, so that the velocity sought is known. A problem counts as solved by the natural "
        "residual |r - P(r - u)| / |q| alone. The solver's relaxations see the same problem as rows whose response is a column of W; "
        "they are timed to 1e-4 and to 1e-8, the judges to the one answer they give. Under Coulomb's law three solvers of Siconos "
        "[@acary2018solving] are run as well, with as many iterations allowed; its Newton method gets 1000 at most.",
        figures=[
            Figure("cone_problems_profiles", "Performance profiles: the share of the problems solved to a residual, over the time "
                   "taken as a multiple of the fastest's, by law."),
            Figure("cone_problems_large", "Wall time of problems with many contacts, crossed where 1e-8 was not reached; `hard` "
                   "has masses from 1 to 1e4 kg, more rows "
                   "than coordinates, and contacts with neither impulse nor velocity.")])
    solves = results.table("cone_problems", "solves")
    section.tell(solves, solves_text, rivals_text, reached_table, solves_table, apart_text)
    if solves is not None and len(apart(solves)):
        section.tell(solves, apart_table)
    return section.tell(results.table("cone_problems", "large"), large_table)


def solves_text(frame):
    return (f"Solves that missed 1e-8 ended after {span(frame[frame['status'] != 'ok']['sweeps'])} iterations. Under Coulomb's law a "
            "problem may have several solutions, so the planted velocity is not expected there.")


def reached_table(frame):
    return Table("Natural residuals reached on the planted problems.", ["law", "solver", "within 1e-8", "natural residual"],
                 [[f"`{law}`", f"`{solver}`", share(int((rows["status"] == "ok").sum()), len(rows)), span(rows["natural_residual"])]
                  for (law, solver), rows in tightest(frame).groupby(["law", "relaxation"], sort=False)], first=True)


def rivals_text(frame):
    """The solver's relaxations beside Siconos', under the law that both know."""
    rows = tightest(frame[(frame["law"] == "coulomb") & ~frame["relaxation"].str.startswith("cone_")])
    within = rows[rows["natural_residual"] <= rows["tolerance"]]
    solved = within.groupby("relaxation", sort=False).size().sort_values(ascending=False, kind="stable")
    times = within.pivot_table(index=["family", "number"], columns="relaxation", values="wall_s")
    theirs = times.columns.str.startswith("siconos_")
    by_them, by_us = times.loc[:, theirs].notna().any(axis="columns"), times.loc[:, ~theirs].notna().any(axis="columns")
    by_all = times.dropna()
    return (f"Of {len(rows[['family', 'number']].drop_duplicates())} problems under Coulomb's law, within {number(rows['tolerance'].min())}: "
            + ", ".join(f"`{name}` {count}" for name, count in solved.items())
            + f". Siconos alone solves {int((by_them & ~by_us).sum())} of them, our relaxations alone {int((by_us & ~by_them).sum())}"
            + f". Median ms on the {len(by_all)} that all of these solve: "
            + ", ".join(f"`{name}` {number(1e3 * median)}" for name, median in by_all.median().sort_values().items()) + ".")


def solves_table(frame):
    rows = []
    for (law, relaxation, family), group in tightest(frame).groupby(["law", "relaxation", "family"], sort=False):
        rows.append([f"`{law}`", f"`{relaxation}`", f"`{family}`", f"{len(group)}", number(group["natural_residual"].max()),
                     f"{int((group['status'] == 'ok').sum())}", number(group["gap"].max()), number(group["error_m_per_s"].max()),
                     number(group["sweeps"].median()),
                     number(group["wall_s"].median())])
    return Table("Planted problems: largest natural residual, relative gap and error of the velocity (m/s), median of iterations "
                 "and seconds.", ["law", "solver", "family", "problems", "residual", "solved", "gap", "error", "iterations", "seconds"], rows)


def apart(frame):
    """A judge's solves whose velocity is not the first judge's, under the law with only one."""
    return frame[(frame["law"] == "cone") & frame["relaxation"].str.startswith("cone_") & ~(frame["difference_m_per_s"] <= AGREEMENT)]


def apart_text(frame):
    listing = " They are listed." if len(apart(frame)) else ""
    return (f"{counted(len(apart(frame)), 'solve')} of the convex law by a judge ended more than {number(AGREEMENT)} m/s from the velocity of "
            f"`cone_interior_point`.{listing}")


def apart_table(frame):
    return Table("Solves of the convex law that disagree with `cone_interior_point`.",
                 ["family", "problem", "solver", "difference, m/s", "natural residual", "status", "reason"],
                 [[f"`{r['family']}`", f"{r['number']:.0f}", f"`{r['relaxation']}`", number(r["difference_m_per_s"]),
                   number(r["natural_residual"]), f"`{r['status']}`", r["reason"]] for _, r in apart(frame).iterrows()])


def large_table(frame):
    return Table("Large problems: natural residuals and wall times.", ["law", "family", "solver", "natural residual", "wall time (s)"],
                 [[f"`{law}`", f"`{family}`", f"`{solver}`", span(rows["natural_residual"]), span(rows["wall_s"])]
                  for (law, family, solver), rows in tightest(frame).groupby(["law", "family", "relaxation"], sort=False)])


def friction_cone(results):
    section = Section(
        "Are the impulses of a pile in the cone of friction?",
        "One step of a pile: cubes that rest on each other and on the ground, a slab and a cube that slide, a cube that leaves the ground, "
        "a ball that spins. Its rows, linearised where the step begins, are solved by each relaxation and given to the judges as a "
        "contact problem. From a natural map of norm e follow bounds for every contact: |r_N u_N| (complementarity) and "
        "|mu r_N |u_T| + r_T . u_T| (maximum dissipation) are at most (1 + (1 + mu^2)^(1/2)) e (|r| + |u~| + e), with u_N less "
        "mu |u_T| under the convex law; and its velocity, which is unique, is known within the largest eigenvalue of W times e times "
        "the difference of the solutions.",
        figures=[
            Figure("friction_cone_plane", "Impulses of the contacts in the plane of the cone: inside what sticks, on the boundary what "
                   "slides, at the origin what separates; each law has its own scale, since the convex one pushes apart what "
                   "slides. Contacts of one face share their load as the relaxation leaves it."),
            Figure("friction_cone_errors", "Largest errors of the contacts over what the tolerance 1e-8 allows; of the convex law also "
                   "the squared distance of the velocities from the first judge's.")])
    return section.tell(results.table("friction_cone", "solves"), shares_table)


def shares_table(frame):
    return Table("Errors as shares of what the tolerance allows.", ["law", "solver", "complementarity", "dissipation", "sweeps", "status"],
                 [[f"`{r['law']}`", f"`{r['relaxation']}`", number(r["complementarity_share"]), number(r["dissipation_share"]),
                   f"{r['sweeps']:.0f}", f"`{r['status']}`"] for _, r in frame.iterrows()])
