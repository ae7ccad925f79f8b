"""What the report says about each experiment: one function each, every number read from the tables.

A function gets the results and returns a Section without its verdicts, which are the same for all experiments.
"""

import numpy as np

from content import Figure, Section, Table, counted, listed, number, span
from reading import CONTRACTING, failed, good, step_text, stiffens

NO_TABLE = "The run left no table."


def judges(results):
    section = Section(
        "Do the judges agree?",
        "Two references solve the same step: Newton's method with sparse factorisations, and an interior point method. "
        "They share the statement of masses, energies and constraints, and nothing of the solver under test. How far apart "
        "are their solutions?",
        figures=[Figure("judges_agreement", "Relative difference of the positions found by the references, and the residual "
                        "each claims, by family of scenes. The table has every step.")])
    frame = results.table("judges", "agreement")
    if frame is not None:
        rows = good(frame, "difference")
        section.paragraphs.append(
            f"{len(rows)} of {counted(len(frame), 'pair')} could be compared. Their differences are "
            f"{span(rows['difference'])}, relative to the largest displacement of the step; an error measured against a "
            "judge means nothing below these numbers.")
        section.tables.append(Table(
            "Agreement of the judges, one step each.",
            ["scene", "nodes", "step", "first", "second", "difference", "residuals", "seconds", "status"],
            [[f"`{r['scene']}`", f"{r['nodes']:.0f}", step_text(r["step_s"]), f"`{r['reference_a']}`",
              f"`{r['reference_b']}`", number(r["difference"]), f"{number(r['residual_a'])}, {number(r['residual_b'])}",
              f"{number(r['wall_s_a'])}, {number(r['wall_s_b'])}", f"`{r['status']}`"] for _, r in frame.iterrows()]))
    return section


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
            Figure("outer_convergence_map", "Measured rate of `plain` over step and mass ratio. Grey: the error does not "
                   "fall near the solution, so there is no rate. Dashed: where the predicted spectral radius is 1."),
            Figure("outer_convergence_predicted_rate", "Measured rate of `plain` against the predicted spectral radius, all "
                   "cases. Crossed under the upper edge: the cases that do not contract, at their predicted rate."),
            Figure("outer_convergence_pendulum", "Rate of `plain` on the pendulum, measured and predicted; the spectral "
                   "radius is h² T/(m l) there.")])
    errors, rates = results.table("outer_convergence", "errors"), results.table("outer_convergence", "map")
    if errors is not None and not set(errors["outer"]) <= {"plain", "incremental", "frozen"}:
        section.figures.insert(1, Figure("outer_convergence_proximal", "The same cases with the other outer iterations that "
                                         "keep the fixed point of `plain`."))
    if rates is not None:
        section.paragraphs.append(rates_text(rates))
        section.tables.append(behaviour_table(rates))
    if errors is not None:
        section.paragraphs.append(floor_text(errors))
    return section


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


def stability_map(results):
    section = Section(
        "Where does each outer iteration find the step?",
        "A swinging chain over step and mass ratio, a cantilever released from rest over step and stiffness; every linear "
        "problem is solved directly, so that the outer iteration alone is seen. Where does it find the step, in how many "
        "iterations, and does the solver's own prediction tell where `plain` converges?",
        figures=[
            Figure("stability_map_chain", "Outer iterations until the error against Newton is 1e-8, chain of 20 links. Marks "
                   "stand where that is not reached. Dashed: where the solver predicts a contraction of 1 for `plain`."),
            Figure("stability_map_cantilever", "The same for the cantilever, over Young's modulus."),
            Figure("stability_map_predictions", "The solver's prediction of the contraction of `plain`, made at the end of the "
                   "step by `auto`, against the dense spectral radius. Where its bound is at most 0.7 it is not refined.")])
    for table, value in (("chain20", "mass_ratio"), ("cantilever", "young_pa")):
        frame = results.table("stability_map", table)
        if frame is not None:
            section.paragraphs.append(solved_text(table, frame, [value, "step_s"]))
    predictions = results.table("stability_map", "predictions")
    if predictions is not None:
        section.paragraphs.append(predictions_text(predictions))
    return section


def solved_text(scene, frame, cell):
    """In how many cells each method finds the step, in how many iterations, and where its claim is not true."""
    parts, claims = [], 0
    for (outer, memory), rows in frame.groupby(["outer", "memory"], sort=False):
        reached = rows["iterations"].notna()
        claims += (rows["status"].eq("ok") & ~reached).sum()
        name = f"`{outer}`" + (" without acceleration" if outer == "proximal" and memory == 0 else "")
        counts = f" in {span(rows['iterations'])} iterations" if reached.any() else ""
        parts.append(f"{name} {reached.sum()}{counts}")
    text = f"Of {counted(len(frame[cell].drop_duplicates()), 'cell')} of `{scene}` these find the step: {'; '.join(parts)}."
    return text + (f" In {counted(claims, 'run')} the step says `ok` and is farther than 1e-8 from Newton's." if claims else "")


def predictions_text(frame):
    """How often the solver's prediction and plain itself agree, and how near prediction and spectral radius are."""
    agree = (frame["predicted_contraction"] < 1) == frame["behaviour"].isin(CONTRACTING)
    agree &= frame["predicted_contraction"].notna()
    large = frame[frame["predicted_rate"] > 0.7]
    difference = abs(large["predicted_contraction"] / large["predicted_rate"] - 1)
    return (f"In {agree.sum()} of {counted(len(frame), 'cell')} the solver predicts rightly whether `plain` returns to the "
            f"solution from beside it. Where the spectral radius exceeds 0.7, the prediction differs from it by "
            f"{span(difference)} (relative).")


def contraction(results):
    section = Section(
        "Is each effect's contraction the predicted one?",
        "Small bodies of one effect each, loaded so that their geometric stiffness matters. The rate of `plain`, measured "
        "beside the solution, is compared with the dense spectral radius, with the solver's own prediction, and with its bound "
        "for the effect.",
        figures=[Figure("contraction_effects", "Rates over the dense spectral radius. Filled: the stiffening part of the "
                        "geometric stiffness decides (tension); open: the softening part (compression), which the bound "
                        "leaves out. Where the bound is at most 0.7 it is the solver's prediction. Corotational rows hold their "
                        "rotation fixed, which the dense radius, from exact derivatives, does not.")])
    frame = results.table("contraction", "rates")
    if frame is not None:
        section.paragraphs.append(
            "Where stiffening decides and a rate of at least 0.001 was measured, the table compares: measured over the dense "
            "radius, the bound over measured, and, where the bound exceeds 0.7 and a prediction is computed, predicted over "
            "measured.")
        section.paragraphs.append(compression_text(frame))
        section.tables.append(effects_table(frame))
    return section


def measured_rates(frame, stiffening):
    """The rows with a rate, those where the stiffening part decides it or the others."""
    rows = good(frame, "measured_rate")
    rows = rows[rows["measured_rate"] > 0]
    return rows[stiffens(rows) == stiffening]


def compression_text(frame):
    rows = measured_rates(frame, stiffening=False)
    above = rows[rows["measured_rate"] > rows["predicted_contraction"]]
    return (f"Compression decides in {counted(len(rows), 'case')}; in {len(above)} of them the measured rate, "
            f"{span(above['measured_rate'])}, is above the solver's prediction, which counts tension only.")


def effects_table(frame):
    rows = []
    for (effect, strain), group in frame.groupby(["effect", "strain"], sort=False):
        tense = measured_rates(group, stiffening=True)
        computed = tense[tense["bound"] > 0.7]
        rows.append([f"`{effect}`" + (f", {strain}" if strain else ""), f"{len(tense)} of {len(group)}",
                     span(tense["measured_rate"] / tense["predicted_rate"]), span(tense["bound"] / tense["measured_rate"]),
                     span(computed["predicted_contraction"] / computed["measured_rate"])])
    return Table("Rates where stiffening decides.", ["effect", "cases", "measured/radius", "bound/measured", "predicted/measured"], rows)


def inner_convergence(results):
    section = Section(
        "How fast are the relaxations?",
        "The same linearised problem is solved by each relaxation, the accelerated Jacobi method [@nesterov1983method] with "
        "adaptive restart [@odonoghue2015adaptive] among them. Which rate per sweep, and is it the predicted one?",
        figures=[
            Figure("inner_convergence_sweeps", "Error of the velocities over the sweeps, against a dense factorisation of "
                   "the same rows."),
            Figure("inner_convergence_seconds", "The same traces over wall time, set-up included."),
            Figure("inner_convergence_rates", "One minus the rate, measured against predicted; above the line is faster. "
                   "For `nesterov_jacobi` and `conjugate_gradients` the prediction is a bound, not a rate.")])
    errors, rates = results.table("inner_convergence", "errors"), results.table("inner_convergence", "rates")
    if errors is not None:
        section.paragraphs.append(fastest_text(errors))
    if rates is not None:
        section.paragraphs.append(decay_text(rates))
        section.tables.append(Table(
            "Linear rates per sweep.", ["scene", "relaxation", "theory", "predicted", "measured", "status"],
            [[f"`{r['scene']}`", f"`{r['relaxation']}`", r["theory"], f"{r['predicted_rate']:.5g}",
              f"{r['measured_rate']:.5g}", f"`{r['status']}`"] for _, r in rates.iterrows()]))
    return section


def decay_text(rates):
    """How well each relaxation's decay per sweep, 1 - rate, is predicted where it reached the solution."""
    iterative = rates[rates["relaxation"] != "direct"]
    parts = []
    for relaxation, group in iterative.groupby("relaxation", sort=False):
        both = good(group, "predicted_rate", "measured_rate")
        ratio = (1 - both["measured_rate"]) / (1 - both["predicted_rate"])
        parts.append(f"`{relaxation}` {span(ratio)} ({len(both)} of {counted(len(group), 'case')})")
    return ("Decay per sweep, one minus the rate, over the predicted one, where the relaxation reached the solution: "
            + "; ".join(parts) + ".") if parts else "No relaxation with a rate was run."


def fastest_text(errors, target=1e-6):
    """Sweeps each relaxation needs to a given error, per scene."""
    parts = []
    for scene, rows in errors.groupby("scene", sort=False):
        reached = []
        for relaxation, trace in rows.groupby("relaxation", sort=False):
            first = trace.loc[trace["error"] <= target, "sweep"].min()
            reached.append(f"`{relaxation}` " + ("never" if np.isnan(first) else f"{first:.0f}"))
        parts.append(f"`{scene}`: {', '.join(reached)}")
    return f"Sweeps until the error first falls to {number(target)}. {'; '.join(parts)}."


def dual_vs_primal(results):
    section = Section(
        "Is the dual solution the primal one?",
        "Regularised constraints [@servin2006interactive] are the dual form of an elasticity problem. Does relaxation "
        "reach the minimum of the incremental potential, found by Newton's method on the energy?",
        figures=[
            Figure("dual_vs_primal_errors", "Error against the primal Newton solution, relative to the largest displacement "
                   "of the step, over the sweeps."),
            Figure("dual_vs_primal_final", "Final error of every method and material; a cross marks a status other than "
                   "`ok`.")])
    frame = results.table("dual_vs_primal", "final")
    if frame is not None:
        section.paragraphs.append("Final errors, over all materials: " + "; ".join(
            f"{listed(name)} {span(group['error'])} ({counted(len(failed(group, 'error')), 'case')} of {len(group)} not ok)"
            for name, group in frame.groupby(["outer", "relaxation"], sort=False)) + ".")
    return section


def mesh_refinement(results):
    section = Section(
        "Do the solids approach the continuum?",
        "A clamped beam is refined, with linear tetrahedra and with a mass-spring network on the same mesh whose one "
        "stiffness is fitted to both load cases on each mesh, and compared with Timoshenko's beam and with the rod; a manufactured "
        "solution gives the order of convergence [@roache1994perspective].",
        figures=[
            Figure("mesh_refinement_beam", "Relative error of bending compliance and first frequency against Timoshenko's "
                   "beam, of axial compliance against the rod."),
            Figure("mesh_refinement_mms", "Manufactured solution, error against the exact displacement; triangles show the "
                   "expected orders.")])
    beam, mms = results.table("mesh_refinement", "beam"), results.table("mesh_refinement", "mms")
    if beam is not None:
        section.paragraphs.append("On the finest mesh that is ok, the error is " + "; ".join(
            finest_text(model, quantity, rows) for (model, quantity), rows in beam.groupby(["model", "quantity"], sort=False))
            + ".")
        section.paragraphs.append(nearer_text(beam))
    if mms is not None:
        last = mms.sort_values("n").iloc[-1]
        section.paragraphs.append(f"The manufactured solution converges with order {last['order_l2']:.2f} in the L2 norm and "
                                  f"{last['order_h1']:.2f} in the H1 seminorm at n = {last['n']:.0f}.")
    return section


def nearer_text(beam):
    """In how many meshes the network is nearer to theory than the tetrahedra, per quantity that both have."""
    parts = []
    for quantity, rows in good(beam, "error_beam").groupby("quantity", sort=False):
        tets = rows[rows["model"].str.startswith("tet_p1")].groupby("n")["error_beam"].max()
        both = rows[rows["model"] == "springs"].set_index("n")["error_beam"].to_frame("springs").join(tets, how="inner")
        if len(both):
            parts.append(f"in `{quantity}` on {(both['error_beam'] < both['springs']).sum()} of {len(both)}")
    return ("Meshes on which the tetrahedra are nearer to theory than the fitted network: " + ", ".join(parts) + ".") if parts \
        else "Tetrahedra and network have no mesh in common."


def finest_text(model, quantity, rows):
    ok = good(rows, "error_beam").sort_values("n")
    name = f"`{model}` in `{quantity}`"
    return f"{number(ok['error_beam'].iloc[-1])} for {name} (n = {ok['n'].iloc[-1]:.0f})" if len(ok) else f"unknown for {name}"


def work_precision(results):
    section = Section(
        "Which accuracy for which work?",
        "The same step to the same tolerances with every method, timed in one run on one thread. Comparisons follow the "
        "practice of benchmarking optimisation software [@dolan2002benchmarking]: work is shown beside time, failures stay in "
        "the picture.",
        figures=[
            Figure("work_precision_seconds", "Error against the judge over wall time. The judge that errors are measured "
                   "against stands on the lower edge. Of each outer iteration, the relaxation "
                   "that is quickest. Crossed: not solved to its tolerance."),
            Figure("work_precision_row_updates", "The same runs over row updates, which do not depend on the machine."),
            Figure("work_precision_outer_iterations", "The same runs over outer iterations.")])
    frame = results.table("work_precision", "points")
    if frame is not None:
        section.tables.append(fastest_table(frame))
        bad = failed(frame, "error")
        tried = frame[frame["status"] != "skipped"]
        section.paragraphs.append(f"{len(frame) - len(bad)} of {counted(len(tried), 'run')} are ok; {len(frame) - len(tried)} "
                                  "more were skipped because the method had missed a looser tolerance, or does not do the scene. "
                                  "The table gives the quickest "
                                  "method of each scene and step at three levels of error.")
    return section


def fastest_table(frame, levels=(1e-3, 1e-6, 1e-9)):
    rows = []
    for (scene, step), group in good(frame, "error", "wall_s").groupby(["scene", "step_s"], sort=False):
        for level in levels:
            reached = group[group["error"] <= level].sort_values("wall_s")
            first = f"`{reached['outer'].iloc[0]}`, `{reached['relaxation'].iloc[0]}`" if len(reached) else "none"
            rows.append([f"`{scene}`", step_text(step), number(level), first, number(reached["wall_s"].iloc[0]) if len(reached) else ""])
    return Table("Quickest run with at most the given error.", ["scene", "step", "error", "method", "wall time (s)"], rows)


def rival_newton(results):
    section = Section(
        "When is the constraint solver faster than Newton's method?",
        "Where every constraint is compliant, Newton's method on the incremental potential does the same step. `newton` is one "
        "written for speed that shares no code with the solver or the judges: it factors the stiffness at each of its few "
        "iterates. `quasi_newton` factors one constant matrix a scene [@liu2017quasi] and does many cheap iterations. One step "
        "of a falling cantilever, as in a running simulation: what only a scene's first step takes is listed as set-up.",
        figures=[
            Figure("rival_newton_elements", "Wall time of a step until the error first falls to a target, over the size of "
                   "the mesh. Crossed: not reached."),
            Figure("rival_newton_seconds", "Error over wall time on the largest mesh.")])
    frame = results.table("rival_newton", "times")
    if frame is not None:
        section.paragraphs.append(
            "Small and middle meshes are judged by `primal_newton`. On the largest mesh of a run the reference is `newton` itself, "
            "converged as far as rounding allows: it and `quasi_newton` share no code, so that the error `quasi_newton` ends "
            "with there is a check of both.")
        section.paragraphs.append(ratios_text(frame))
        section.tables.append(rival_table(frame))
    return section


def paired(frame):
    """One row a problem and target that both methods reached: wall times side by side, and their ratio."""
    keys = ["elements", "young_pa", "poisson", "error_target"]
    both = good(frame, "wall_s").pivot_table(index=keys, columns="method", values="wall_s", sort=False).reset_index()
    if not {"newton", "quasi_newton"} <= set(both):
        return both.iloc[:0].assign(ratio=[])
    both = both.dropna()
    return both.assign(ratio=both["quasi_newton"] / both["newton"])


def ratios_text(frame):
    """Ratio of the times on the largest mesh, by target and Poisson's ratio."""
    both = paired(frame)
    both = both[both["elements"] == both["elements"].max()]
    parts = [f"{span(rows['ratio'])} to {number(target)} at nu = {poisson:g}"
             for (poisson, target), rows in both.groupby(["poisson", "error_target"], sort=False)]
    return (f"On {both['elements'].iloc[0]:.0f} tetrahedra, the time of `quasi_newton` over that of `newton` is "
            + "; ".join(parts) + ". Below 1 the constraint solver is the faster one.") if parts else \
        "No problem was solved by both methods."


def rival_table(frame):
    largest = frame[frame["elements"] == frame["elements"].max()]
    return Table("Time to an error on the largest mesh.",
                 ["tetrahedra", "E (Pa)", "nu", "method", "to", "iterations", "set-up (s)", "wall time (s)", "status"],
                 [[f"{r['elements']:.0f}", number(r["young_pa"]), f"{r['poisson']:g}", f"`{r['method']}`",
                   number(r["error_target"]), f"{r['iterations']:.0f}", number(r["setup_s"]), number(r["wall_s"]),
                   f"`{r['status']}`"] for _, r in largest.iterrows()])


def effects_cost(results):
    section = Section(
        "What does each effect cost?",
        "Does an effect that a scene does not call for cost nothing, and one that it does in proportion to its rows?",
        figures=[
            Figure("effects_cost_scaling", "Wall time of one sweep over the number of rows."),
            Figure("effects_cost_bytes", "Memory of each effect's rows."),
            Figure("effects_cost_seconds", "Wall time of each effect per row and step, linearising and relaxing.")])
    scaling, costs = results.table("effects_cost", "scaling"), results.table("effects_cost", "costs")
    if scaling is not None:
        section.paragraphs.append("Exponents of the time per sweep over the rows: " + "; ".join(
            f"`{name}` {span(group['exponent'])}" for name, group in scaling.groupby("relaxation", sort=False))
            + ". An exponent of 1 is cost in proportion to the rows.")
    if costs is not None:
        section.tables.append(Table(
            "Cost of each effect.", ["scene", "effect", "rows", "bytes per row", "wall time (s)"],
            [[f"`{r['scene']}`", f"`{r['effect']}`", f"{r['rows']:.0f}",
              number(r["bytes"] / r["rows"]) if r["rows"] else "", number(r["wall_s"])] for _, r in costs.iterrows()]))
    return section


def point_hard_cases(results):
    section = Section(
        "Which hard scenes does one method survive?",
        "Heavy and long ropes, stiffness in series, a wide grid, Young's moduli and steps over many decades, cubes that start "
        "scrambled, flat, collapsed or mirrored, nearly incompressible solids, slivers, a strain energy beyond its limit point, "
        "other units. One method, the default, no setting for any case; `conjugate_gradients` and `direct` stand beside it where there are sweeps to do. "
        "Which of the same few gates hold?",
        figures=[
            Figure("point_hard_cases_gates", "Every gate of every case, with the number measured. Green holds, red fails, grey was "
                   "not asked."),
            Figure("point_hard_cases_frontier", "Largest step and fewest sweeps an outer iteration at which all gates still hold.")])
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


SECTIONS = {function.__name__: function for function in (
    judges, outer_convergence, stability_map, contraction, inner_convergence, dual_vs_primal, mesh_refinement, work_precision,
    rival_newton, effects_cost, point_hard_cases, generated_scenes)}


def section_of(results, experiment):
    """The section of an experiment: its own if there is one, else what can be said of any."""
    section = SECTIONS[experiment](results) if experiment in SECTIONS else \
        Section(experiment.replace("_", " ").capitalize(), paragraphs=["No text is written for this experiment."])
    shortfall = results.shortfall(experiment)
    if shortfall:
        section.notice = f"No result is shown: {shortfall}."
    if shortfall or not (section.paragraphs or section.tables):
        section.paragraphs, section.figures = [] if shortfall else [NO_TABLE], []
    for figure in section.figures:
        figure.drawn = results.drawn(experiment, figure.name)
    return section
