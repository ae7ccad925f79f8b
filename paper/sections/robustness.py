"""Which scenes the methods survive."""

from content import Figure, Section, Table, counted, listed, number, span
from selecting import good, step_text


def point_hard_cases(results):
    section = Section(
        "Which hard scenes does one method survive?",
        "Heavy and long ropes, stiffness in series, a wide grid, Young's moduli and steps over many decades, cubes that start "
        "scrambled, flat, collapsed or mirrored, nearly incompressible solids, slivers, a strain energy beyond its limit point, "
        "other units. One method, the default, no setting for any case; the verdicts are about it. `direct` and `gauss_seidel` stand beside it "
        "where there are sweeps to do. "
        "Which of the same few gates hold?",
        figures=[
            Figure("point_hard_cases_gates", "Every gate of every case, with the number measured. Green holds, red fails, grey was "
                   "not asked."),
            Figure("point_hard_cases_frontier", "Largest step and fewest sweeps an outer iteration at which all gates still hold. Squares: cases "
                   "that `quasi_newton` solves without a sweep.")])
    gates, frontier = results.table("point_hard_cases", "gates"), results.table("point_hard_cases", "frontier")
    if gates is not None:
        section.paragraphs.append(gates_text(gates))
        section.tables.append(failed_gates(gates))
    if frontier is not None:
        section.paragraphs.append("Largest step at which all gates hold: " + "; ".join(
            f"`{name}` {span(rows['largest_step_s'])} s, none in {counted(int(rows['largest_step_s'].isna().sum()), 'case')} of "
            f"{len(rows)}" for name, rows in frontier.groupby("relaxation", sort=False)) + ".")
    return section


def gates_text(gates):
    """How many gates hold, and how many simulations say that a step is not solved."""
    asked = gates[gates["status"] != "skipped"]
    runs = asked.drop_duplicates(["scene", "relaxation"])
    unsolved = runs[runs["status"] != "ok"]
    return (f"{int((asked['holds'] == 1).sum())} of {counted(len(asked), 'gate')} hold, in {counted(len(runs), 'simulation')} of "
            f"{gates['scene'].nunique()} cases; {len(gates) - len(asked)} more were not asked. "
            f"In {len(unsolved)} simulations some step says itself that it missed the tolerance: "
            f"{listed(unsolved['scene'] + ', ' + unsolved['relaxation'])}.")


def failed_gates(gates):
    bad = gates[(gates["status"] != "skipped") & (gates["holds"] != 1)]
    return Table("Gates that fail.", ["scene", "relaxation", "steps", "gate", "measured", "bound", "status", "reason"],
                 [[f"`{r['scene']}`", f"`{r['relaxation']}`", f"{r['steps']:.0f} of {step_text(r['step_s'])}", f"`{r['gate']}`",
                   number(r["measured"]), number(r["bound"]), f"`{r['status']}`", r["reason"]] for _, r in bad.iterrows()])


def generated_scenes(results):
    section = Section(
        "Does a step that says ok tell the truth?",
        "Random points under random combinations of all effects, masses and stiffness over eight decades, hard rows that "
        "may contradict each other. How do the steps end, and does the judge's own residual of their end, the least over all "
        "impulses, confirm each that says it is solved?",
        figures=[
            Figure("generated_scenes_outcomes", "Steps of each relaxation by outcome."),
            Figure("generated_scenes_sample", "A sample: error against Newton's method over the judge's residual. An error of "
                   "order one at a small residual is another minimum.")])
    outcomes, sample = results.table("generated_scenes", "outcomes"), results.table("generated_scenes", "sample")
    if outcomes is not None:
        section.tables.append(Table(
            "Outcomes.", ["relaxation", "status", "reason", "steps"],
            [[f"`{r['relaxation']}`", f"`{r['status']}`", r["reason"], f"{r['steps']:.0f}"] for _, r in outcomes.iterrows()]))
        ok = outcomes[outcomes["status"] == "ok"]
        section.paragraphs.append("Largest residual found by the judge after a step with status ok, as part of what that status "
                                  "allows: " + "; ".join(f"`{r['relaxation']}` {number(r['claim_largest'])} ({r['steps']:.0f} steps)"
                                                         for _, r in ok.iterrows()) + ".")
    if sample is not None:
        section.paragraphs.append(sample_text(sample))
    return section


def sample_text(sample):
    """What became of the sampled steps that Newton's method could solve, and of those that it could not."""
    sample = sample[sample["reference_status"] != ""]
    solvable = sample[sample["reference_status"] == "ok"]
    both = good(solvable, "claim", "error")
    other = sample[sample["reference_status"] != "ok"]
    return (f"Newton's method solved {len(solvable)} of {counted(len(sample), 'sampled step')} (each relaxation counts); of these "
            f"{len(both)} end as ok, {int((solvable['status'] == 'not_converged').sum())} as not converged, "
            f"{int((solvable['status'] == 'diverged').sum())} as diverged. The median of the relative errors of those that are ok "
            f"is {number(both['error'].median())}; {int((both['error'] > 1e-3).sum())} are larger than 1e-3. Of the "
            f"{len(other)} that Newton's method did not solve, {int((other['status'] == 'ok').sum())} end as ok.")
