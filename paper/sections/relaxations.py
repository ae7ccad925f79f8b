"""How the relaxations solve a linearised step."""

import numpy as np

from content import Figure, Section, Table, counted, number, span
from selecting import good


def inner_convergence(results):
    section = Section(
        "How fast are the relaxations?",
        "Each relaxation solves the same linearised problem; one of them is the accelerated Jacobi method [@nesterov1983method] with "
        "adaptive restart [@odonoghue2015adaptive]. At which rate does the error fall per sweep, and does theory predict that rate?",
        figures=[
            Figure("inner_convergence_sweeps", "Error of the velocities over the sweeps, against a dense factorisation of "
                   "the same rows."),
            Figure("inner_convergence_seconds", "The same traces over wall time, set-up included."),
            Figure("inner_convergence_rates", "One minus the rate, measured against predicted; above the line is faster. "
                   "`nesterov_jacobi` and `conjugate_gradients` have bounds, not rates: they are in the table.")])
    section.tell(results.table("inner_convergence", "errors"), fastest_table)
    return section.tell(results.table("inner_convergence", "rates"), decay_text, rates_table)


def rates_table(rates):
    return Table("Linear rates per sweep.", ["scene", "relaxation", "theory", "predicted", "measured", "status"],
                 [[f"`{r['scene']}`", f"`{r['relaxation']}`", r["theory"], f"{r['predicted_rate']:.5g}",
                   f"{r['measured_rate']:.5g}", f"`{r['status']}`"] for _, r in rates.iterrows()])


def decay_text(rates):
    """How well each relaxation's decay per sweep, 1 - rate, is predicted where it reached the solution."""
    iterative = rates[rates["relaxation"] != "direct"]
    parts = []
    for relaxation, group in iterative.groupby("relaxation", sort=False):
        both = good(group, "predicted_rate", "measured_rate")
        ratio = (1 - both["measured_rate"]) / (1 - both["predicted_rate"])
        parts.append(f"`{relaxation}` {span(ratio)} ({len(both)} of {counted(len(group), 'case')})")
    return ("The decay per sweep is one minus the rate. Where a relaxation reached the solution, the measured decay over the predicted "
            f"one is: {'; '.join(parts)}.") if parts else "No relaxation with a rate was run."


def sweeps_to(errors, target):
    """The first sweep at which the error is at most the target, by scene and relaxation; NaN where it never is."""
    return errors["sweep"].where(errors["error"] <= target).groupby([errors["scene"], errors["relaxation"]], sort=False).min()


def fastest_table(errors, target=1e-6):
    """Sweeps each relaxation needs to a given error, one row a scene, one column a relaxation."""
    reached = sweeps_to(errors, target)
    names = list(errors["relaxation"].unique())
    rows = [[f"`{scene}`", *("never" if np.isnan(reached.get((scene, name), np.nan)) else f"{reached[scene, name]:.0f}" for name in names)]
            for scene in errors["scene"].unique()]
    return Table(f"Sweeps until the error first falls to {number(target)}.", ["scene", *names], rows, first=True)


def conditioning(results):
    section = Section(
        "What makes a relaxation slow?",
        "One linearised step from smooth velocities: `chain20`, whose tip gets heavier, a cantilever that gets "
        "stiffer, and one that gets nearly incompressible. In how many sweeps does each relaxation bring the residual to 1e-6 of its start?",
        figures=[Figure("conditioning_sweeps", "Sweeps over mass ratio, Young's modulus and distance from incompressibility. Crossed "
                        "under the upper edge: the residual is not reached in the sweeps allowed.")])
    return section.tell(results.table("conditioning", "sweeps"), conditioned_text, conditioning_table)


def conditioned_text(frame):
    """What each relaxation solves, and how its sweeps compare with those of conjugate gradients."""
    reached = good(frame, "sweeps").pivot_table("sweeps", ["parameter", "value"], "relaxation", sort=False)
    best = reached.get("conjugate_gradients", reached.max(axis=1))
    cases = len(frame.drop_duplicates(["parameter", "value"]))
    ratios = reached.drop(columns=["conjugate_gradients", "direct"], errors="ignore").div(best, axis=0)
    parts = [f"`{name}` {ratio.count()}, in {span(ratio)} times as many" for name, ratio in ratios.items()]
    fewest = not (ratios < 1).any(axis=None)
    return (f"The condition of the preconditioned matrix D^-1 N is {span(frame['condition'])}. Of {counted(cases, 'case')} "
            f"`conjugate_gradients` solve {best.count()}, in {span(best)} sweeps; {'; '.join(parts)}. "
            + ("Conjugate gradients need the fewest sweeps in each of them. " if fewest else "Others need fewer sweeps in some of them. ")
            + "A sweep of them costs as much as one of Jacobi's, and nothing is factored.")


def conditioning_table(frame):
    """What each relaxation needs, per parameter, and what it leaves where it does not get there."""
    rows = []
    for (parameter, relaxation), group in frame.groupby(["parameter", "relaxation"], sort=False):
        reached = good(group, "sweeps")
        missed = group.drop(reached.index)
        rows.append([f"`{parameter}` {group['value'].min():g} to {group['value'].max():g}", f"`{relaxation}`", f"{len(reached)} of {len(group)}",
                     span(reached["sweeps"]) if len(reached) else "", span(missed["residual"]) if len(missed) else ""])
    return Table("Sweeps to the residual, and the residual left where the sweeps were spent before.",
                 ["parameter", "relaxation", "solved", "sweeps", "residual left"], rows)


def inexact(results):
    section = Section(
        "How accurately must a linear problem be solved?",
        "An outer iteration stops its sweeps when the linear residual has fallen to a given share of the nonlinear one. One step of the "
        "swinging chain is solved to its tolerance. How much work does the default share save, compared with solving every linear "
        "problem to a tenth of that tolerance?",
        figures=[Figure("inexact_row_updates", "Row updates until the step is solved: those with linear problems to the default share of "
                        "the nonlinear residual over those with each to a tenth of the step's tolerance.")])
    return section.tell(results.table("inexact", "solves"), saving_text)


def saving_text(frame):
    """Row updates of exact over inexact solves, cell by cell, and what inexact ones do to the error."""
    shares = sorted(frame["inner_tolerance"].unique())
    solved = good(frame, "row_updates")
    both = solved.pivot_table(["row_updates", "error"], ["relaxation", "step_s", "mass_ratio"], "inner_tolerance", sort=False)
    if not all(("row_updates", share) in both for share in shares):
        return "No step is solved both ways."
    ratio = (both["row_updates"][shares[0]] / both["row_updates"][shares[-1]]).dropna()
    parts = [f"{span(values)} times with `{name}` ({counted(len(values), 'cell')})"
             for name, values in ratio.groupby("relaxation", sort=False)]
    return (f"Exact linear solves take these multiples of the row updates of inexact ones: {'; '.join(parts)}. The errors of the "
            f"steps are {span(both['error'][shares[0]])} with exact, {span(both['error'][shares[-1]])} with inexact ones. "
            "On a chain conjugate gradients finish after as many sweeps as there are links, so that little can be saved.")
