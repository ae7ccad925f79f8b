"""What sweeps make of a step: of its contacts, of its stiffness, and of its friction."""

from content import Figure, Section, Table, listed, number, share, span
from sections.relaxations import sweeps_to

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
        "no other solution; error and dual gap are those to a judge's, an interior point method, or to the planted one.",
        figures=[
            Figure("contact_convergence_residual", "Natural residual over the sweeps, convex law. Crossed: not solved to 1e-10."),
            Figure("contact_convergence_residual_coulomb", "The same under Coulomb's law."),
            Figure("contact_convergence_gaps", "Dual gap over the sweeps, convex law; black: what theory allows `ista` and `fista`."),
            Figure("contact_convergence_penetration", "How deep the step ends, Coulomb's law.")])
    section.tell(results.table("contact_convergence", "traces"), residual_text)
    section.tell(results.table("contact_convergence", "bounds"), lambda frame: GRADIENTS, bounds_text, bounds_table)
    return section.tell(results.table("contact_convergence", "budgets"), budgets_text, budgets_table)


def residual_text(frame, target=1e-6):
    """Sweeps to a residual, over the scenes, and what is not solved."""
    parts = []
    for law, rows in frame.groupby("law", sort=False):
        reached = sweeps_to(rows.assign(error=rows["natural_residual"]), target).unstack("scene")
        parts += [f"`{name}` by `{law}` {share(sweeps.notna().sum(), len(sweeps))}, in {span(sweeps)}"
                  for name, sweeps in reached.iterrows()]
    return f"Scenes in which the natural residual falls to {number(target)}, and in how many sweeps: {'; '.join(parts)}."


def bounds_text(frame):
    bounded = frame[frame["bound_share"].notna()]
    parts = [f"`{name}` {span(rows['bound_share'])}, exponents {span(rows['exponent'])}"
             for name, rows in bounded.groupby("relaxation", sort=False)]
    return ("Largest gap over its bound, of `jacobi` over that of `ista` and of `nesterov_jacobi` over that of `fista`, and the fitted "
            f"exponent of the decrease with k: {'; '.join(parts)}. Fitted over the ten-fold sweeps from where the bound of `fista` falls to "
            "1; beyond them the decrease is no power any more but linear. The solver's two are beside bounds that are proven for steps of at "
            "most 1/L without restart.")


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


def budgets_text(frame):
    """Which method without a factorisation comes nearest, by budget."""
    sweeping = frame[frame["relaxation"].isin(("gauss_seidel", "jacobi", "nesterov_jacobi", "power_law", "mass_splitting"))]
    parts = [f"{number(budget)} sweeps: " + ", ".join(f"`{name}` in {count}" for name, count in best.items())
             for budget, best in nearest(sweeping).items()]
    names = listed(sweeping["relaxation"].unique())
    return f"Scenes in which each of {names} has the smallest dual gap, by the sweeps it may take: {'; '.join(parts)}."


def budgets_table(frame):
    budgets = sorted(frame["budget"].unique())
    table = frame.pivot_table("gap", ["scene", "relaxation"], "budget", sort=False, dropna=False)
    return Table("Dual gap after so many sweeps.", ["scene", "method", *(f"{budget:.0f}" for budget in budgets)],
                 [[f"`{scene}`", f"`{name}`", *(number(row[budget]) if row[budget] == row[budget] else "" for budget in budgets)] for (scene, name), row in table.iterrows()],
                 detail=True)
