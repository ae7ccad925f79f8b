"""Claims about the solver of the linearised step."""

import numpy as np

from claims.claim import Claim, Finding, judge, some, verdict_rows, worst
from content import compared, listed, number, share, span
from sections.cost import quickest, rival_wins
from sections.relaxations import sweeps_to

TARGET = 1e-6
ROUNDING = 1e-12  # of a dual gap, what the judge's residual leaves of it


def orders(bounds):
    """Whether the gaps lie within their bounds, the accelerated one's smaller, and its exponents are the larger ones."""
    share_of, exponent = (bounds.pivot_table(column, "scene", "relaxation", sort=False, dropna=False) for column in ("bound_share", "exponent"))
    methods = ["ista", "fista", "jacobi", "nesterov_jacobi"]
    some(share_of if set(methods) <= set(share_of) & set(exponent) else [], f"bound of {listed(methods)}")
    within = (share_of[methods] <= 1).all(axis=None)
    steeper = (exponent["fista"] > exponent["ista"]) & (exponent["fista"] >= 2)
    text = (f"On contact steps of the convex law the dual gap of `nesterov_jacobi` is at most {number(share_of['nesterov_jacobi'].max(skipna=False))} of "
            f"2 L |p*|^2/(k + 1)^2, that of `jacobi` {number(share_of['jacobi'].max(skipna=False))} of L |p*|^2/(2 k); without restart the gap falls "
            f"as k to the power {span(-exponent['fista'])}, by Jacobi's method {span(-exponent['ista'])}.")
    return within and steeper.all(), text


def by_budget(budgets):
    """Dual gaps by scene and sweeps that may be taken."""
    gaps = budgets.pivot_table("gap", ["scene", "budget"], "relaxation", sort=False, dropna=False)
    return some(gaps if {"nesterov_jacobi", "jacobi", "gauss_seidel", "power_law"} <= set(gaps) else [],
                "budget of `nesterov_jacobi` and others")


def ahead(gaps):
    """Whether at the most sweeps the accelerated method is nearer than Jacobi's, or both are at rounding."""
    last = gaps[gaps.index.get_level_values("budget") == gaps.index.get_level_values("budget").max()]
    return (last["nesterov_jacobi"] <= np.maximum(last["jacobi"], ROUNDING)).all()


def early(gaps):
    """Where others come nearer in as many sweeps."""
    ours = gaps["nesterov_jacobi"].fillna(np.inf)  # set-up takes more sweeps
    nearer = {name: gaps[name] < ours for name in ("gauss_seidel", "power_law")}
    if not any(near.any() for near in nearer.values()):
        return ""
    return (f"With as many sweeps, set-up included, `gauss_seidel` comes nearer than `nesterov_jacobi` in {share(nearer['gauss_seidel'].sum(), len(gaps))} "
            f"cases, and the authors' step-size heuristic of 2014 does in {share(nearer['power_law'].sum(), len(gaps))}. With at most 50 sweeps it is "
            + " and ".join(share(near[few].sum(), few.sum()) for near in nearer.values()
                           for few in [near.index.get_level_values("budget") <= 50]) + ".")


def accelerates(bounds, budgets, errors):
    ordered, text = orders(bounds)
    gaps = by_budget(budgets)
    against, ordered = early(gaps), ordered and ahead(gaps)
    sweeps = sweeps_to(errors, TARGET).unstack("relaxation")
    sweeps = sweeps.dropna(subset=["nesterov_jacobi", "jacobi"], how="all") if {"nesterov_jacobi", "jacobi"} <= set(sweeps) else []
    some(sweeps, f"scene on which `jacobi` or `nesterov_jacobi` reaches {number(TARGET)}")
    faster = ~(sweeps["jacobi"] <= sweeps["nesterov_jacobi"]) & sweeps["nesterov_jacobi"].notna()
    saved = (sweeps["jacobi"] / sweeps["nesterov_jacobi"]).dropna()
    return Finding(
        judge(ordered and faster.all(), ordered and faster.any(), f"{share(faster.sum(), len(faster))} scenes"),
        f"To an error of {number(TARGET)} `nesterov_jacobi` needs fewer sweeps than `jacobi` on {share(faster.sum(), len(faster))} scenes, "
        + (f"by a factor of {span(saved)} where both come there. " if len(saved) else "with none on which both come there. ")
        + f"{text} {against}".strip(),
        f"{share(faster.sum(), len(faster))} scenes", f"{len(faster)} of {len(faster)}", against)


def ripples(bounds, budgets):
    rises = bounds.pivot_table("rises", "scene", "relaxation", sort=False, dropna=False)
    last = budgets[budgets["budget"] == budgets["budget"].max()].pivot_table("gap", "scene", "relaxation", sort=False, dropna=False)
    some(rises if {"fista", "fista_restarted"} <= set(rises) & set(last) else [], "run with restart and without")
    off, on = rises["fista"], rises["fista_restarted"]
    none, nearer = on == 0, last["fista_restarted"] <= last["fista"]
    fewer = (on < off) | none
    return Finding(
        judge(none.all() and nearer.all(), fewer.all() and nearer.all(), f"{share(none.sum(), len(on))} scenes; elsewhere it is less"),
        f"Without restart {span(off)} sweeps of a run raise the dual objective, with restart {span(on)}. After {number(budgets['budget'].max())} "
        f"sweeps the gap with restart is smaller in {share(nearer.sum(), len(on))} scenes: {span(last['fista_restarted'])} against "
        f"{span(last['fista'])}. Both were written for this experiment. With `nesterov_jacobi`, which always restarts, "
        f"{span(rises['nesterov_jacobi']) if 'nesterov_jacobi' in rises else 'an unknown number of'} sweeps raise it.",
        f"{number(on.max(skipna=False))} rises", "0")


def overhead(points, verdicts):
    growth = verdict_rows(verdicts, "effects.linear")
    steepest = worst(growth)
    linear = (growth["verdict"] == "holds").all()
    rows = quickest(points)
    wins, entered = rival_wins(points)
    firsts = {name: ((rows["outer"] == "plain") & (rows["relaxation"] == name)).sum() for name in ("gauss_seidel", "nesterov_jacobi")}
    against = (f"Newton's method with CHOLMOD is the quickest in {share(wins, entered)} rows of small scenes that it enters; `plain` with "
               f"`gauss_seidel` is in {share(firsts['gauss_seidel'], len(rows))}, `plain` with `nesterov_jacobi`, the paper's method, in "
               f"{firsts['nesterov_jacobi']}.")
    lost = wins > 0 or sum(firsts.values()) < len(rows)
    return Finding(
        judge(linear and not wins and sum(firsts.values()) > 0, linear, "the time of a sweep, linear in the rows"),
        f"Over the rows the time of a sweep grows with an exponent that is off 1 by {compared(steepest['measured'], steepest['bound'])[0]} at "
        f"most. {against}",
        *compared(steepest["measured"], steepest["bound"]), against if lost else "")


def parallel(sweeps, steps):
    """Whether several threads are faster in every sweep and step, and end in the same bits."""
    several = {name: some(table[table["threads"] > 1], f"run on several threads in `{name}`") for name, table in (("sweeps", sweeps), ("steps", steps))}
    same = all((rows["same_bits"] == 1).all() for rows in several.values())
    gains = np.concatenate([rows["speedup"] for rows in several.values()])
    jacobi = several["sweeps"][several["sweeps"]["relaxation"] != "coloured_gauss_seidel"]["speedup"]
    coloured = several["sweeps"][several["sweeps"]["relaxation"] == "coloured_gauss_seidel"]["speedup"]
    most = int(several["sweeps"]["threads"].max())
    slower = [f"`{row['relaxation']}` in `{row['scene']}`" for rows in several.values() for _, row in rows.iterrows() if not row["speedup"] > 1]
    alone = sweeps[sweeps["threads"] == 1]["share_of_copy"]
    against = f"No faster on several threads: {listed(slower)}." if slower else ""
    return Finding(
        judge(same and not slower, same and len(slower) < len(gains), "some of its sweeps"),
        f"{number(most)} threads sweep the family of Jacobi {span(jacobi)} times and Gauss-Seidel by colours {span(coloured)} times as fast as one, "
        f"and do a whole step of the scenes {span(several['steps']['speedup'])} times as fast. {'All' if same else 'Not all'} of "
        f"{len(gains)} runs end in the same bits as on one thread. One thread moves its rows at {span(alone)} of the speed of copying memory, "
        f"which threads share. {against}".strip(),
        number(np.min(gains)), "more than 1", against)


CLAIMS = (
    Claim(26, "The accelerated method converges faster than Jacobi's.", "the accelerated Jacobi solver suitable for parallel architectures",
          ("contact_convergence/bounds", "contact_convergence/budgets", "inner_convergence/errors"), accelerates, "contact_convergence_gaps"),
    Claim(27, "The solver suits parallel machines.", "based on both the Jacobi and the Nesterov methods so it can be parallelized",
          ("threads/sweeps", "threads/steps"), parallel, "threads_gain"),
    Claim(28, "It is matrix-free, with little overhead beside other methods.",
          "to keep the computational overhead to a minimum compared to existing methods",
          ("work_precision/points", "effects_cost/verdicts"), overhead, "work_precision_seconds"),
    Claim(29, "Restart removes the ripple of the accelerated method.", "",
          ("contact_convergence/bounds", "contact_convergence/budgets"), ripples, "contact_convergence_gaps"),
)
