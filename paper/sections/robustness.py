"""Which scenes the methods survive."""

from content import Figure, Section, Table, counted, listed, number, span
from selecting import good, step_text


def point_hard_cases(results):
    section = Section(
        "Which hard scenes does one method survive?",
        "Heavy and long ropes, stiffness in series, a wide grid, Young's moduli and steps over many decades, cubes that start "
        "scrambled, flat, collapsed or mirrored, nearly incompressible solids, slivers, a strain energy beyond its limit point, "
        "other units. The default method runs all of them, without a setting for any case; the verdicts are about it. `direct` and `gauss_seidel` "
        "run the cases that need sweeps. Which gates hold? The gates are the same for all cases.",
        figures=[
            Figure("point_hard_cases_gates", "Every gate of every case, measured over its bound. Crossed: the gate fails; those cases "
                   "are named."),
            Figure("point_hard_cases_frontier", "The share of cases in which all gates hold, over the step and over the sweeps of an outer "
                   "iteration. `quasi_newton` solves some without a sweep.")])
    gates, frontier = results.table("point_hard_cases", "gates"), results.table("point_hard_cases", "frontier")
    if gates is not None:
        section.paragraphs.append(gates_text(gates))
        section.tables += failed_gates(gates)
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
            f"{gates['scene'].nunique()} cases; {len(gates) - len(asked)} more do not apply. "
            f"In {counted(len(unsolved), 'simulation')} a step reports that it missed its tolerance"
            + (f": {listed(unsolved['scene'] + ', ' + unsolved['relaxation'])}." if len(unsolved) else "."))


def failed_gates(gates):
    """A table of them, if there are any."""
    bad = gates[(gates["status"] != "skipped") & (gates["holds"] != 1)]
    return [Table("Gates that fail.", ["scene", "relaxation", "steps", "gate", "measured", "bound", "status", "reason"],
                 [[f"`{r['scene']}`", f"`{r['relaxation']}`", f"{r['steps']:.0f} of {step_text(r['step_s'])}", f"`{r['gate']}`",
                   number(r["measured"]), number(r["bound"]), f"`{r['status']}`", r["reason"]] for _, r in bad.iterrows()])] if len(bad) else []


def generated_scenes(results):
    section = Section(
        "Does a step that says ok tell the truth?",
        "Random points under random combinations of all effects, masses and stiffness over eight decades, hard rows that "
        "may contradict each other. How do the steps end? Where a step says it is solved, is the residual small that the judge computes "
        "from its end state, as the least over all impulses?",
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
        section.paragraphs.append("Largest residual that the judge finds after a step with status `ok`, as a share of what that status "
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


def generated_worlds(results):
    section = Section(
        "Is each step that says ok right, and is its answer the only one?",
        "Random scenes with bodies of all shapes, joints with limits and motors, cloth, solids, ropes, damping and contact by all laws. "
        "A random method solves each. Code that shares nothing with the solver's rows judges each step that says ok. The first step is "
        "repeated for variants that have the same answer: the scene turned, mirrored, in other units, in another order, and solved by other methods.",
        figures=[Figure("generated_worlds_agreement", "The first step of each variant beside that of the original scene, where both say "
                        "ok. Told apart by the tolerance alone: at 1e-11 both agree. Another solution: at 1e-11 they still differ, and the judge "
                        "refutes neither.")])
    ends, refuted = results.table("generated_worlds", "ends"), results.table("generated_worlds", "refuted")
    agreement, broken = results.table("generated_worlds", "agreement"), results.table("generated_worlds", "broken")
    apart = results.table("generated_worlds", "apart")
    if ends is not None:
        steps = ends.set_index("status")["steps"]
        scenes = refuted["world"].nunique() if refuted is not None else 0
        section.paragraphs.append(
            (f"{counted(scenes, 'scene')} have steps that say ok and are refuted. " if scenes else "No step that says ok is refuted. ")
            + f"Of {counted(int(steps.sum()), 'step')} {int(steps.get('ok', 0))} end as ok, {int(steps.get('not_converged', 0))} as not "
            f"converged and {int(steps.get('diverged', 0))} as diverged.")
    if broken is not None and len(broken):
        section.tables.append(Table("Scenes that were refused, threw or ceased to be finite.", ["world", "kind", "reason"],
                                    [[f"{r['world']:.0f}", r["kind"], r["reason"]] for _, r in broken.iterrows()]))
    if agreement is not None:
        told = agreement.groupby("outcome")["first_steps"].sum()
        section.paragraphs.append(
            f"{int(told.get('the same', 0))} first steps of variants end where that of the original scene does. "
            f"{int(told.get('told apart by the tolerance alone', 0))} more do so at a tighter tolerance. "
            f"{int(told.get('another solution', 0))} end elsewhere at a tighter tolerance, too, and the judge refutes neither end: either the step "
            f"has more than one solution, or the judge cannot tell the right one. {int(told.get('not told', 0))} differ and miss the tighter "
            "tolerance, so that nothing can be said of them.")
    if apart is not None and len(apart):
        section.tables.append(Table(
            "First steps that end apart, the first 20: by how much of the step's scale, and how far a body turns.",
            ["world", "variant", "difference", "largest turn, rad", "outcome"],
            [[f"{r['world']:.0f}", r["variant"], number(r["difference"]), number(r["turn_rad"]), r["outcome"]]
             for _, r in apart.head(20).iterrows()]))
    if refuted is not None and len(refuted):
        worst = refuted.drop_duplicates(["world", "check"]).head(20)
        section.tables.append(Table(
            "What is refuted, the first 20.", ["world", "variant", "step", "check", "number", "bound", "what"],
            [[f"{r['world']:.0f}", r["variant"], f"{r['step']:.0f}", r["check"], number(r["number"]), number(r["bound"]), r["what"]]
             for _, r in worst.iterrows()]))
    return section.tell(results.table("generated_worlds", "judged"), judged_text, judged_table)


def judged_text(judged):
    """How near steps that say ok are to what the judge finds."""
    said = judged[judged["status"] == "ok"]
    told = said[said["nearest_error_of_scale"].notna()]
    beyond = told[told["nearest_error_of_scale"] > told["allowed"]]
    return (f"Of {counted(len(judged), 'scene')} that the judge of contact takes, one step each: {len(said)} say ok, and the judge finds a solution "
            f"of {len(told)}. {len(told) - len(beyond)} of these are as near to it as their tolerance lets linear rows be, "
            f"{len(beyond)} are not; the farthest is off by {number(told['nearest_error_of_scale'].max())} of the step's scale.")


def judged_table(judged):
    said = judged[judged["status"] == "ok"]
    worst = said.assign(over=said["nearest_error_of_scale"] / said["allowed"]).sort_values("over", ascending=False).head(10)
    return Table("Judged steps, the ten farthest from a solution beside what is allowed.",
                 ["world", "step", "tolerance", "error over scale", "allowed", "nearest start", "the judge's residual", "the judge"],
                 [[f"{r['world']:.0f}", f"{r['step']:.0f}", number(r["tolerance"]), number(r["nearest_error_of_scale"]), number(r["allowed"]),
                   r["nearest_start"], number(r["reference_residual"]), r["reference_status"]] for _, r in worst.iterrows()])


def tunnelling(results):
    section = Section(
        "Does anything pass through anything?",
        "Two things are thrown at each other by 1 to 100 times their size a step: bodies of all shapes, thin ones too, nodes, cloth, the "
        "ground. Fixed, light and heavy ones are hit in the middle or grazed. A judge that shares no code with the solver's search of contacts follows "
        "the way from each step's begin to its end. Do the cores of the two, nine tenths of their shapes, meet on it?",
        figures=[Figure("tunnelling_pairs", "Steps that pass, pair by pair; dark by their share. A missed step is one that says it missed its "
                        "tolerance.")])
    section.tell(results.table("tunnelling", "pairs"), passages_text, touch_text, passages_table)
    return section.tell(results.table("tunnelling", "passed"), passed_table)


def passages_text(pairs):
    """What passes with continuous detection, in steps that say ok and in others, and that the judge sees it without."""
    said, alone = (pairs[pairs["continuous"] == kind].sum(numeric_only=True) for kind in (1, 0))
    return (f"Of {int(said['scenes'])} scenes {int(said['hits'])} would pass if nothing stopped them. With continuous detection "
            f"{int(said['passed_ok'])} of {counted(int(said['steps_ok']), 'solved step')} pass. Without it {int(alone['passed_ok'])} of "
            f"{int(alone['steps_ok'])} do, so that the judge sees what passes. But {counted(int(said['steps_missed']), 'step')} miss their tolerance, and "
            f"{int(said['passed_missed'])} of these lead through: what would pass in a missed step is held back on its way, so that it meets later than it should.")


def touch_text(pairs):
    said = pairs[pairs["continuous"] == 1].sum(numeric_only=True)
    return (f"Ways are looked at for what begins a step apart. {int(said['passed_in_touch'])} solved steps that begin in touch pass. "
            f"{int(said['steps_turned'])} solved steps turn a body by more than half a turn; their ways are followed round, as the spin tells.")


def passages_table(pairs):
    said = pairs[pairs["continuous"] == 1]
    return Table("Continuous detection, pair by pair.",
                 ["first", "second", "scenes", "would pass", "solved steps", "that pass", "that pass, begun in touch", "missed steps", "that pass"],
                 [[r["first"], r["second"], *(f"{r[c]:.0f}" for c in ("scenes", "hits", "steps_ok", "passed_ok", "passed_in_touch", "steps_missed",
                                                                   "passed_missed"))] for _, r in said.iterrows()], detail=True)


def passed_table(passed):
    order = {"ok": 0, "ok, from touch": 1, "missed": 2}
    worst = passed.sort_values("step_status", key=lambda column: column.map(order), kind="stable").head(20)
    return Table("Scenes with a step that passes, the first 20, solved steps first.", ["first", "second", "scene", "step"],
                 [list(row) for row in worst[["first", "second", "scene", "step_status"]].astype(str).to_numpy()], detail=True)
