"""How the outer iterations approach the step."""

from functools import partial

import numpy as np

from content import Figure, Section, Table, counted, listed, number, share, span
from reading import CONTRACTING
from selecting import cost_ratios, failed, good, step_text, stiffens


def outer_convergence(results):
    section = Section(
        "Does the outer iteration converge?",
        "The fixed point iteration of the method [@francu2017position] refreshes the constraint directions and solves the "
        "linearised problem again. Does it reach the solution of the implicit step, at the rate theory predicts, and does "
        "incremental PBD [@macklin2016xpbd] reach the same point?",
        figures=[
            Figure("outer_convergence_errors", "Error against Newton's method on the full system, relative to the largest "
                   "displacement of the step: the whole multiplier along the current directions (`plain`), multipliers that "
                   "keep their old directions (`incremental`), and one linearisation only (`frozen`)."),
            Figure("outer_convergence_proximal", "The same steps with the outer iterations that have the fixed points of `plain`."),
            Figure("outer_convergence_map", "Measured rate of `plain` over step and mass ratio. Grey: the error does not "
                   "fall near the solution, so there is no rate. Dashed: where the predicted spectral radius is 1."),
            Figure("outer_convergence_predicted_rate", "Measured rate of `plain` against the predicted spectral radius, all "
                   "cases. Crossed under the upper edge: the cases that do not contract, at their predicted rate."),
            Figure("outer_convergence_residuals", "Where each iteration ends: the share of a step's correction v - v_free that no "
                   "impulses along the directions there explain, as a judge finds it. Crossed: not solved.", detail=True),
            Figure("outer_convergence_pendulum", "Rate of `plain` on the pendulum, measured and predicted; the spectral "
                   "radius is h² T/(m l) there.")])
    section.tell(results.table("outer_convergence", "map"), rates_text, behaviour_table)
    errors = results.table("outer_convergence", "errors")
    section.tell(errors, paper_text)
    section.tell(errors if errors is None else errors[errors["relaxation"] != "nesterov_jacobi"], floor_text, rescued_text)
    return section.tell(results.table("outer_convergence", "residuals"), residuals_table)


def residuals_table(frame):
    """What each outer iteration leaves of the momentum equation."""
    return Table("Share of the step's correction v - v_free that no impulses along the directions at its end explain, by a judge.",
                 ["scene", "step", "outer", "relaxation", "share", "status"],
                 [[f"`{r['scene']}`", step_text(r["step_s"]), f"`{r['outer']}`", f"`{r['relaxation']}`", number(r["residual_share"]),
                   f"`{r['status']}`"] for _, r in frame.iterrows()])


def rates_text(rates):
    """How well prediction and measurement of the plain iteration agree, below and above 1."""
    plain = rates[rates["outer"] == "plain"]
    below, above = plain[plain["predicted_rate"] < 1], plain[plain["predicted_rate"] >= 1]
    both = good(below, "predicted_rate", "measured_rate")
    both = both[both["predicted_rate"] > 0]
    difference = abs(both["measured_rate"] / both["predicted_rate"] - 1)
    return (f"Of {counted(len(plain), 'case')} of `plain`, theory predicts contraction in {len(below)}; "
            f"{below['behaviour'].isin(CONTRACTING).sum()} of these converge. Where a rate could be measured, it differs from "
            f"the predicted one by {span(difference)} (relative). Of the {len(above)} cases with a predicted rate of 1 or "
            f"more, {above['behaviour'].isin(CONTRACTING).sum()} converge.")


def behaviour_table(rates):
    rows = []
    for outer, group in rates.groupby("outer", sort=False):
        counts = ", ".join(f"{count} {name or 'unnamed'}" for name, count in group["behaviour"].value_counts().items())
        rows.append([f"`{outer}`", str(len(group)), counts, span(group["error_final"])])
    return Table("Behaviour of each outer iteration over all cases.", ["outer", "cases", "behaviour", "final error"], rows)


def paper_text(errors):
    """What sweeps make of `plain`: the paper's method beside `plain` with direct solves."""
    keys = ["scene", "step_s", "mass_ratio"]
    last = errors[errors["outer"] == "plain"].sort_values("iteration").groupby([*keys, "relaxation"], sort=False).tail(1)
    swept = last[last["relaxation"] == "nesterov_jacobi"]
    solved = last[last["relaxation"] == "direct"].merge(swept[keys], on=keys)
    if swept.empty:
        return "`plain` was not traced with `nesterov_jacobi`."
    ends = []
    for (scene, ratio, step), row in swept.groupby(["scene", "mass_ratio", "step_s"], sort=False):
        mass = f" with mass ratio {number(ratio)}" if scene == "chain20" else ""
        ends.append(f"{scene}{mass} at h = {step_text(step)}: {number(row['error'].iloc[0])}" + ("" if row["status"].iloc[0] == "ok" else ", not ok"))
    return (f"The paper's own method, `plain` with `nesterov_jacobi`, is ok in {share(len(good(swept, 'error')), len(swept))} traced cases, "
            f"`plain` solved directly in {share(len(good(solved, 'error')), len(solved))}. "
            f"Its errors after at most 60 outer iterations: {'; '.join(ends)}.")


def floor_text(errors):
    """Where each outer iteration ends on the cases in which `plain` converges."""
    keys = ["scene", "step_s", "mass_ratio"]
    last = errors.sort_values("iteration").groupby([*keys, "outer", "relaxation"], sort=False).tail(1)
    converged = good(last[last["outer"] == "plain"], "error")[keys].drop_duplicates()
    parts = []
    for outer, group in last.merge(converged, on=keys).groupby("outer", sort=False):
        parts.append(f"`{outer}` at {span(group['error'])}")
    return f"In the {counted(len(converged), 'case')} where `plain` is ok, the traces end as follows: {'; '.join(parts)}." \
        if parts else "In no case is `plain` ok."


def rescued_text(errors):
    """What becomes of the traced cases in which `plain` is not ok."""
    keys = ["scene", "step_s", "mass_ratio"]
    last = errors.sort_values("iteration").groupby([*keys, "outer"], sort=False).tail(1)
    missed = failed(last[last["outer"] == "plain"], "error")
    rest = last.merge(missed[keys], on=keys)
    ends = [f"`{outer}` is ok in {len(good(rows, 'error'))} of them, after {span(good(rows, 'error')['iteration'])} iterations, at "
            f"an error of {span(good(rows, 'error')['error'])}"
            for outer, rows in rest[rest["outer"].isin(["proximal", "auto"])].groupby("outer", sort=False)]
    return (f"`plain` ends away from the step in {counted(len(missed), 'traced case')}, at an error of {span(missed['error'])}; "
            f"{'; '.join(ends)}.") if ends else "No other outer iteration was traced where `plain` is not ok."


def stability_map(results):
    section = Section(
        "Where does each outer iteration find the step?",
        "A swinging chain of links and one of rods with ball joints are stepped over a grid of step and mass ratio, a cantilever released from "
        "rest over step and stiffness. Every linear problem is solved directly, so that only the outer iteration matters. In which cells does "
        "it find the step, in how many iterations, and does the solver predict where `plain` converges?",
        figures=[
            Figure("stability_map_chain", "Outer iterations until the error against Newton is 1e-8, `chain20`. Marks "
                   "stand where that is not reached. Dashed: where the solver predicts a contraction of 1 for `plain`."),
            Figure("stability_map_rods", "The same for the chain of 10 rods."),
            Figure("stability_map_cantilever", "The same for the cantilever, over Young's modulus."),
            Figure("stability_map_cantilevers", "Cantilevers of 192 and 1536 tetrahedra (full tier): the error against Newton of "
                   "`auto`, and of an iterative relaxation after at most 1e5 sweeps. Dashed: 1e-10."),
            Figure("stability_map_predictions", "The solver's prediction of the contraction of `plain`, made at the end of the "
                   "step by `auto`, against the dense spectral radius. Where its bound is at most 0.7 it is not refined."),
            Figure("stability_map_cost", "What `auto` costs where `plain` contracts, in row updates of the chain and wall time of "
                   "the cantilever, where `auto` takes `quasi_newton`; the prediction that both make at the step's end included.")])
    section.tell(results.table("stability_map", "chain20"), partial(solved_text, cell=["mass_ratio", "step_s"]))
    section.tell(results.table("stability_map", "rods10"), partial(solved_text, cell=["mass_ratio", "step_s"]))
    section.tell(results.table("stability_map", "cantilever"), partial(solved_text, cell=["young_pa", "step_s"]))
    section.tell(results.table("stability_map", "cantilevers"), cantilevers_text)
    section.tell(results.table("stability_map", "predictions"), predictions_text)
    return section.tell(results.table("stability_map", "cost"), cost_table)


def solved_text(frame, cell):
    """In how many cells each method finds the step, in how many iterations, and where its claim is not true."""
    found, claims = [], 0
    for (outer, memory), rows in frame.groupby(["outer", "memory"], sort=False):
        reached = rows["iterations"].notna()
        claims += (rows["status"].eq("ok") & ~reached).sum()
        name = f"`{outer}`" + (" without acceleration" if outer == "proximal" and memory == 0 else "")
        found.append([name, f"{reached.sum()} of {len(frame[cell].drop_duplicates())}", span(rows["iterations"]) if reached.any() else ""])
    return Table(f"In how many cells of `{frame['scene'].iloc[0]}` each outer iteration finds the step, and in how many iterations."
                 + (f" In {counted(claims, 'run')} the step says `ok` and is farther than 1e-8 from Newton's." if claims else ""),
                 ["outer", "cells", "iterations"], found)


def cantilevers_text(frame):
    """The errors of each method on each solid, and how many of its steps are not ok."""
    parts = [f"`{scene}` by `{outer}` with `{relaxation}` {span(rows['error_final'])}"
             f" ({counted(len(failed(rows, 'error_final')), 'cell')} of {len(rows)} not ok)"
             for (scene, outer, relaxation), rows in frame.groupby(["scene", "outer", "relaxation"], sort=False)]
    return f"Errors at the end of the step: {'; '.join(parts)}."


def predictions_text(frame):
    """How often the solver's prediction and plain itself agree, and how near prediction and spectral radius are."""
    agree = (frame["predicted_contraction"] < 1) == frame["behaviour"].isin(CONTRACTING)
    agree &= frame["predicted_contraction"].notna()
    large = frame[frame["predicted_rate"] > 0.7]
    difference = abs(large["predicted_contraction"] / large["predicted_rate"] - 1)
    return (f"In {agree.sum()} of {counted(len(frame), 'cell')} the solver predicts rightly whether `plain` returns to the "
            f"solution from beside it. Where the spectral radius exceeds 0.7, the prediction differs from it by "
            f"{span(difference)} (relative).")


def cost_table(frame):
    """What auto costs where plain contracts with a rate below 0.9, at the default tolerance."""
    ratios = cost_ratios(frame)
    names = list(ratios["relaxation"].unique())
    rows = []
    for scene, cells in ratios.groupby("scene", sort=False):
        found = {relaxation: span(runs["ratio"]) for relaxation, runs in cells.groupby("relaxation")}
        rows.append([f"`{scene}`", "wall time" if cells["timed"].all() else "row updates", *(found.get(name, "") for name in names)])
    return Table(f"Cost of `auto` as a multiple of that of `plain`, where the measured rate of `plain` is below 0.9: {counted(len(ratios), 'run')} "
                 "to the default tolerance.", ["scene", "cost", *names], rows)


def contraction(results):
    section = Section(
        "Is each effect's contraction the predicted one?",
        "Small bodies with one effect each are loaded so that their geometric stiffness matters. For joints these are three rods on balls "
        "(`point_joint`) or on hinges with elastic axes (`axis_joint`). The rate of `plain` is measured near the solution. It is "
        "compared with the dense spectral radius, with the solver's own prediction, and with its bound for the effect; for rods the bound "
        "includes half the angle that they turn in the step. Corotational rows hold their rotation fixed, so that J is not dc/dx. The "
        "dense radius is that of what such rows leave out, d(J^T p)/dx + J^T A^-1 (J - dc/dx).",
        figures=[Figure("contraction_effects", "Measured rates over what they are compared with; shaded: not allowed. Filled: the stiffening part of the "
                        "geometric stiffness decides (tension); open: the softening part (compression). "
                        "Where the bound is at most 0.7 it is the solver's prediction.")])
    return section.tell(results.table("contraction", "rates"), effects_table)


def effects_table(frame):
    rows = []
    for (effect, strain), group in frame.groupby(["effect", "strain"], sort=False):
        for load, rates in (("tension", group[stiffens(group)]), ("compression", group[~stiffens(group)])):
            if rates.empty:
                continue
            measured = good(rates, "measured_rate")
            measured = measured[measured["measured_rate"] > 0]
            computed = measured[measured["bound"] > 0.7]
            rows.append([f"`{effect}`" + (f", {strain}" if strain else ""), load, f"{len(measured)} of {len(rates)}",
                         span(measured["measured_rate"] / measured["predicted_rate"]),
                         span(measured["bound"] / measured["measured_rate"]),
                         span(computed["predicted_contraction"] / computed["measured_rate"])])
    return Table("Rates of at least 0.001: measured over the dense radius, the bound over measured, and, where the bound exceeds "
                 "0.7 and a prediction is computed, predicted over measured.",
                 ["effect", "decided by", "cases", "measured/radius", "bound/measured", "predicted/measured"], rows)


def contact_contraction(results):
    section = Section(
        "Does the outer iteration contract in contact?",
        "Spheres and cubes that rest, roll, slide or tumble on what curves, or turn on an edge or a corner. Near a solution where no "
        "contact is about to open, to slide or to stick, the map of `plain` is differentiable: pressing contacts are equations, sliding "
        "ones with a force along their slip. A judge states these equations by itself and differentiates them. Its spectral radius is "
        "compared with that of the solver's own map, which is measured by single iterations of `plain` from either side of the solution.",
        figures=[Figure("contact_contraction_radii", "Spectral radius of the solver's map over that of the judge's. Filled: `plain` does "
                        "not return to the solution from 1e-6 of the step beside it. Dashed: a radius of 1.")])
    return section.tell(results.table("contact_contraction", "rates"), contact_rates_text, contact_orders_table)


def contact_rates_text(frame):
    """How near prediction and measurement are, where there is no contraction, and what the solver's own prediction says."""
    seen = good(frame, "predicted_rate", "measured_rate")
    beyond, seen = seen[seen["predicted_rate"] >= 1], seen[seen["predicted_rate"] >= 0.01]
    own = [rows["predicted_contraction"] / rows["measured_rate"] for rows in (seen[seen["sliding"] == 0], seen[seen["sliding"] > 0])]
    kinks = frame["reason"].str.contains("kink", na=False)
    left = (f"In {counted(kinks.sum(), 'case')} of {len(frame)}, all of {listed(frame.loc[kinks, 'scene'].unique())}, the map has a kink at the "
            "solution: nothing is predicted there. " if kinks.any() else "")
    return (f"{left}Where the radius is 0.01 or more ({counted(len(seen), 'case')}) the solver's map has {span(seen['measured_rate'] / seen['predicted_rate'])} "
            f"times the judge's. It is 1 or more in {counted(len(beyond), 'case')}; `plain` returns in {int(beyond['returns'].sum())} of them, "
            f"and in {int(frame.loc[frame['predicted_rate'] < 1, 'returns'].sum())} of {counted((frame['predicted_rate'] < 1).sum(), 'other')}. "
            f"The solver's own prediction, an upper bound below 0.7, is {span(own[0])} times the measured radius where all contacts stick, "
            f"{span(own[1])} times where some slide.")


def contact_orders(frame):
    """The power of h by which the rate falls between the two shortest steps, of each scene and law."""
    rows = good(frame, "measured_rate").sort_values("step_s")
    for (scene, law), own in rows.groupby(["scene", "friction"], sort=False):
        if len(own) > 1:
            first, second = own.iloc[0], own.iloc[1]
            order = np.log(second["measured_rate"] / first["measured_rate"]) / np.log(second["step_s"] / first["step_s"])
            yield scene, law, own["measured_rate"], order


def contact_orders_table(frame):
    return Table("Measured rates over all steps, and the power of h by which they fall between the two shortest ones.",
                 ["scene", "law", "rates", "power of h"],
                 [[scene, f"`{law}`", span(rates), number(order)] for scene, law, rates, order in contact_orders(frame)])
