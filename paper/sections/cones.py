"""Contact with friction: are the problems of one step solved?"""

from content import Figure, Section, Table, counted, listed, number, span

AGREEMENT = 1e-6  # m/s


def cone_problems(results):
    section = Section(
        "Contact problems with friction",
        "One step's contacts are a problem in impulses r and velocities u = W r + q. The convex law `cone` asks for r in the cone "
        "|r_T| <= mu r_N and u in its dual, perpendicular; Coulomb's law asks the same of u + mu |u_T| n. Solutions are drawn first "
        "and q is made to fit, in eight families, so that the velocity sought is known. Who solves them is certified by the natural "
        "residual |r - P(r - u)| / |q| alone.",
        figures=[
            Figure("cone_problems_profiles", "Performance profiles: the share of the problems solved to a residual, over the time "
                   "taken as a multiple of the fastest's, by law."),
            Figure("cone_problems_large", "Wall time of problems with many contacts; `hard` has masses from 1 to 1e4 kg, more rows "
                   "than coordinates, and contacts with neither impulse nor velocity.")])
    solves = results.table("cone_problems", "solves")
    section.tell(solves, solves_text, solves_table, apart_text)
    if solves is not None and len(apart(solves)):
        section.tell(solves, apart_table)
    return section.tell(results.table("cone_problems", "large"), large_text)


def solves_text(frame):
    return "Natural residuals reached: " + "; ".join(
        f"{listed(key)} {span(rows['natural_residual'])} on {counted(len(rows), 'problem')}, "
        f"{int((rows['status'] == 'ok').sum())} of them within 1e-8"
        for key, rows in frame.groupby(["law", "relaxation"], sort=False)) + \
        ". Under Coulomb's law a problem may have several solutions, so the planted velocity is not expected there."


def solves_table(frame):
    rows = []
    for (law, relaxation, family), group in frame.groupby(["law", "relaxation", "family"], sort=False):
        rows.append([f"`{law}`", f"`{relaxation}`", f"`{family}`", f"{len(group)}", number(group["natural_residual"].max()),
                     number(group["gap"].max()), number(group["error_m_per_s"].max()), number(group["sweeps"].median()),
                     number(group["wall_s"].median())])
    return Table("Planted problems: largest natural residual, relative gap and error of the velocity (m/s), median of iterations "
                 "and seconds.", ["law", "solver", "family", "problems", "residual", "gap", "error", "iterations", "seconds"], rows)


def apart(frame):
    """Solves whose velocity is not the first judge's, under the law with only one."""
    return frame[(frame["law"] == "cone") & ~(frame["difference_m_per_s"] <= AGREEMENT)]


def apart_text(frame):
    listing = " They are listed." if len(apart(frame)) else ""
    return (f"{counted(len(apart(frame)), 'solve')} of the convex law ended more than {number(AGREEMENT)} m/s from the velocity of "
            f"`cone_interior_point`.{listing}")


def apart_table(frame):
    return Table("Solves of the convex law that disagree with `cone_interior_point`.",
                 ["family", "problem", "solver", "difference, m/s", "natural residual", "status", "reason"],
                 [[f"`{r['family']}`", f"{r['number']:.0f}", f"`{r['relaxation']}`", number(r["difference_m_per_s"]),
                   number(r["natural_residual"]), f"`{r['status']}`", r["reason"]] for _, r in apart(frame).iterrows()])


def large_text(frame):
    return "Large problems: " + "; ".join(
        f"`{family}` with {contacts:.0f} contacts to {span(rows['natural_residual'])} in {span(rows['wall_s'])} s"
        for (family, contacts), rows in frame.groupby(["family", "contacts"], sort=False)) + "."
