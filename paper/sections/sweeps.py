"""What sweeps make of a step: of its contacts, of its stiffness, and of its friction."""

from content import Figure, Section, Table, joined, listed, number, share, span
from sections.relaxations import sweeps_to
from selecting import step_text

GRADIENTS = (
    "The convex law makes the step's impulses the minimum of F(p) = p.W p/2 + q.p over the cones. With a_i = trace(W_ii)/3 and L the "
    "largest eigenvalue of D^-1 W, Jacobi's method with the step 1/L (`ista`) comes to F - F* <= L |p*|_D^2/(2 k) in k sweeps, and with "
    "Nesterov's momentum (`fista`) to 2 L |p*|_D^2/(k + 1)^2 [@beck2009fast]. `mass_splitting` [@tonge2012mass] needs no L: its a_i are "
    "large enough for L = 1. `power_law` is what the paper's authors did before [@francu2014improved]: steps of 0.1 and the momentum "
    "(k/(K - 1))^0.6 for K sweeps that are chosen before; how it is projected is our choice. These five are contenders, written for this "
    "experiment; they know L, which the solver's `jacobi` and `nesterov_jacobi` estimate by sweeps that count.")


def contact_convergence(results):
    section = Section(
        "How do sweeps solve the contacts of a step?",
        "One linearised step of cubes at rest, sliding and piled, of masses 1 to 100, and a planted problem. The natural residual needs "
        "no other solution; error and dual gap are those to a judge's, an interior point method, or to the planted one. Then steps of small "
        "deformable bodies at rest, sliding and struck, in which elastic rows stand beside those of contacts, scaled so that the diagonal of W "
        "is 1 in the mean of each contact and each other row.",
        figures=[
            Figure("contact_convergence_residual", "Natural residual over the sweeps, convex law. Crossed: not solved to 1e-10."),
            Figure("contact_convergence_residual_coulomb", "The same under Coulomb's law.", detail=True),
            Figure("contact_convergence_deformables", "Deformables: natural residual of contacts and elastic rows over the sweeps, Coulomb's "
                   "law. Crossed: not solved to 1e-10."),
            Figure("contact_convergence_gaps", "Dual gap over the sweeps, convex law; black: what theory allows `ista` and `fista`."),
            Figure("contact_convergence_penetration", "How deep the step ends, Coulomb's law.", detail=True)])
    section.tell(results.table("contact_convergence", "traces"), sweeps_table)
    section.tell(results.table("contact_convergence", "deformables"), deformables_text, deformables_table)
    section.tell(results.table("contact_convergence", "bounds"), lambda frame: GRADIENTS, orders_table, bounds_table)
    return section.tell(results.table("contact_convergence", "budgets"), nearest_table, budgets_table)


def deformables_text(frame):
    """What is in the steps, and who solves them."""
    sizes = joined(f"{scene}: {number(rows['contacts'].iloc[0])} contacts in {number(rows['rows'].iloc[0])} rows"
                   for scene, rows in frame.groupby("scene", sort=False))
    runs = frame.groupby(["relaxation", "law", "scene"], sort=False)["natural_residual"].last() <= 1e-10
    found = joined(f"`{name}` {share(solved.sum(), len(solved))}" for name, solved in runs.groupby("relaxation", sort=False))
    return f"Deformables ({sizes}), by three laws; solved to 1e-10: {found}."


def deformables_table(frame):
    return sweeps_table(frame, what="Steps of deformables")


def sweeps_table(frame, target=1e-6, what="Scenes"):
    """Sweeps to a residual, over the scenes, and what is not solved."""
    laws = list(frame["law"].unique())
    reached = {law: sweeps_to(rows.assign(error=rows["natural_residual"]), target).unstack("scene") for law, rows in frame.groupby("law", sort=False)}
    rows = [[f"`{name}`", *(f"{share(sweeps.notna().sum(), len(sweeps))}, in {span(sweeps)}" for sweeps in (reached[law].loc[name] for law in laws))]
            for name in frame["relaxation"].unique()]
    return Table(f"{what} in which the natural residual falls to {number(target)}, and in how many sweeps.",
                 ["relaxation", *(f"law `{law}`" for law in laws)], rows)


def orders_table(frame):
    bounded = frame[frame["bound_share"].notna()]
    return Table("Largest dual gap over its bound (of `jacobi` that of `ista`, of `nesterov_jacobi` that of `fista`), and the power of k by "
                 "which it falls in ten-fold sweeps from where the bound of `fista` is 1. The bounds are proven for steps of at most 1/L "
                 "without restart.", ["method", "gap over bound", "power of k"],
                 [[f"`{name}`", span(rows["bound_share"]), span(-rows["exponent"])] for name, rows in bounded.groupby("relaxation", sort=False)])


def bounds_table(frame):
    return Table("Dual gap over its bound, exponent, and sweeps after which the objective was larger than before.",
                 ["scene", "method", "L", "gap over bound", "exponent", "rises", "sweeps"],
                 [[f"`{r['scene']}`", f"`{r['relaxation']}`", number(r["lipschitz"]), number(r["bound_share"]), number(r["exponent"]),
                   number(r["rises"]), number(r["sweeps"], 5)] for _, r in frame.iterrows()], detail=True)


def nearest(frame):
    """Of each budget of sweeps: which method's gap is smallest, in how many scenes."""
    found = {}
    for budget, rows in frame[frame["gap"].notna()].groupby("budget"):
        best = rows.loc[rows.groupby("scene", sort=False)["gap"].idxmin(), "relaxation"]
        found[budget] = best.value_counts()
    return found


def nearest_table(frame):
    """Which method without a factorisation comes nearest, by budget."""
    sweeping = frame[frame["relaxation"].isin(("gauss_seidel", "jacobi", "nesterov_jacobi", "power_law", "mass_splitting"))]
    names, found = list(sweeping["relaxation"].unique()), nearest(sweeping)
    return Table("Scenes in which each method has the smallest dual gap, by the sweeps it may take.", ["sweeps", *(f"`{name}`" for name in names)],
                 [[number(budget), *(str(best.get(name, 0)) for name in names)] for budget, best in found.items()], detail=True)


def budgets_table(frame):
    budgets = sorted(frame["budget"].unique())
    table = frame.pivot_table("gap", ["scene", "relaxation"], "budget", sort=False, dropna=False)
    return Table("Dual gap after so many sweeps.", ["scene", "method", *(f"{budget:.0f}" for budget in budgets)],
                 [[f"`{scene}`", f"`{name}`", *(number(row[budget]) if row[budget] == row[budget] else "" for budget in budgets)] for (scene, name), row in table.iterrows()],
                 detail=True)


CHAIN = (
    "A chain of ten links hangs straight and at rest. Each step begins with the first link opened by h^2 g more, and n sweeps from zero "
    "impulses leave c = F c~ of what is open, F = I - N (N + Sigma)^-1 (I - E^n) with Gauss-Seidel's E = I - (N + Sigma) B^-1; so the "
    "chain rests at c = (I - F)^-1 F h^2 g e_1. A relaxation factor k, classic PBD's stiffness [@mueller2007position], divides B's "
    "diagonal. Of one mass on one link this is a stiffness of (m/h^2) (1 - (1 - k)^n)/(1 - k)^n: it depends on the step and the sweeps. A "
    "compliance A whose step is solved to the end stretches by the sum of m g A.")


def softness(results):
    section = Section(
        "How soft do constraints get where the solver is stopped early?",
        "A chain and a cloth hang at rest. The solver makes n sweeps a step from zero impulses (`incremental`, no warm start), as classic "
        "PBD does; then it solves each step to the end.",
        figures=[
            Figure("softness_sweeps", "Stretch at rest over the sweeps of a step of 1/60 s. Crossed: did not come to rest."),
            Figure("softness_steps", "Stretch at rest over the step: a relaxation factor, and a compliance. Crossed: did not come to rest.")])
    return section.tell(results.table("softness", "stretches"), lambda frame: CHAIN, softness_text, softness_table)


def softness_text(frame):
    parts = [f"{variant} {span(rows['error'])}" for variant, rows in frame[frame["scene"] == "chain"].groupby("variant", sort=False)]
    restless = frame[frame["status"] != "ok"]
    text = f"Relative differences from the formulas: {'; '.join(parts)}. {share(len(restless), len(frame))} runs did not come to rest"
    return text + (f", by {listed(restless['relaxation'].unique())}." if len(restless) else ".")


def softness_table(frame):
    return Table("Stretch at rest.", ["scene", "variant", "relaxation", "step", "sweeps", "A (m/N)", "k", "stretch (m)", "formula (m)",
                                      "equilibrium (m)", "status"],
                 [[r["scene"], r["variant"], f"`{r['relaxation']}`", number(r["step_s"]), number(r["sweeps"]), number(r["compliance_m_per_n"]),
                   number(r["factor"]), number(r["stretch_m"]), number(r["expected_m"]) if r["expected_m"] == r["expected_m"] else "",
                   number(r["physical_m"]), r["status"]] for _, r in frame.iterrows()], detail=True)


FRICTION_AT_END = (
    "With friction at the end of the step, normal impulses without friction move the bodies, and then the slip of each contact is braked "
    "once, one after the other, by at most mu times its normal impulse. Velocities are changed, positions keep what they slid: what "
    "friction holds creeps at h a if it never turns, a the acceleration that friction would balance, and faster where bodies turn. The "
    "contender is ours, made of the solver's rows; a box with infinite inertia, which never turns, obeys the formula to rounding. The "
    "threshold is the friction, or the push, at which a body begins to slide, over what Coulomb's law says; it is measured to a hundredth.")


LATE = {"within": "within the step", "end": "at the end of the step"}


def late_friction(results):
    section = Section(
        "What does friction at the end of the step do?",
        "A box on an incline of 20 degrees and a pushed stack, held by friction a tenth and two times larger than needed; where they begin "
        "to slide; an arch a fifth thicker than it has to be. Friction is solved together with the normal impulses, or after them.",
        figures=[Figure("late_friction_creep", "Creep of what friction holds, over the step.")])
    return section.tell(results.table("late_friction", "motions"), lambda frame: FRICTION_AT_END, late_text, late_table)


def late_text(frame):
    parts = []
    for (scene, quantity), rows in frame[frame["quantity"] != "creep"].groupby(["scene", "quantity"], sort=False):
        sides = [f"{number(r['measured'])}{' m' if r['unit'] == 'm' else ''} with friction {LATE[r['variant']]}" for _, r in rows.iterrows()]
        parts.append(f"The {quantity} of the {scene} is {' and '.join(sides)}.")
    return " ".join([*parts, late_cost(frame)])


def late_cost(motions):
    """What each kind of friction costs, in Newton iterations of `direct`, where both solve a run of the same scene."""
    runs = motions[motions["quantity"] != "threshold"].assign(solved=motions["status"] == "ok").set_index(["scene", "step_s", "variant"])
    runs = runs[runs.groupby(level=[0, 1])["solved"].transform("all")]
    if runs.empty:
        return "No scene is solved by both, so that their costs cannot be compared."
    work = runs.groupby("variant")[["sweeps", "steps"]].sum()
    each = work["sweeps"] / work["steps"]
    return (f"Where both solve every step, a step takes {number(each['within'])} iterations of `direct` with friction within it, "
            f"{number(each['end'])} with friction at its end (for the normal impulses).")


def late_table(frame):
    return Table("Friction within the step and at its end. Expected: by Coulomb's law, but of what creeps with friction at the end h a. Natural "
                 "residual: of Coulomb's law, the largest of the run.",
                 ["scene", "friction", "step", "quantity", "measured", "expected", "unit", "natural residual", "overlap (m)", "sweeps a step", "status"],
                 [[r["scene"], LATE[r["variant"]], step_text(r["step_s"]), r["quantity"], number(r["measured"]), number(r["expected"]), r["unit"],
                   number(r["natural_residual"]), number(r["penetration_m"]), number(r["sweeps"] / r["steps"]), r["status"]]
                  for _, r in frame.iterrows()], detail=True)
