"""Claims about contact and friction."""

import numpy as np

from claims.claim import Claim, Finding, all_at_most, judge, some, verdict_rows
from content import joined, listed, number, share, span
from sections.sweeps import LATE, late_cost
from selecting import good

LAWS = ("coulomb", "disc", "box", "cone")


def within(answers, *quantities):
    """Of these quantities, or all that are judged: which answers are ok and within their bounds, and the answers."""
    rows = answers[answers["bound"].notna()]
    rows = rows[rows["quantity"].isin(quantities)] if quantities else rows
    some(rows, f"answer about {joined(quantities) or 'anything'}")
    return (rows["status"] == "ok") & (rows["error"] <= rows["bound"]), rows


def ends(traces):
    """The last row of each run."""
    return traces.sort_values("sweep").groupby(["scene", "law", "relaxation"], sort=False).tail(1)


def nothing_overlaps(traces, answers, solves):
    swept = ends(traces)
    paper = some(swept[(swept["relaxation"] == "nesterov_jacobi") & (swept["law"] == "cone")], "run of `nesterov_jacobi` by `cone`")
    reached = paper["status"] == "ok"
    left = swept.loc[swept["status"] == "ok", "penetration_m"]
    missed = swept[(swept["relaxation"] == "nesterov_jacobi") & (swept["law"] == "coulomb") & (swept["status"] != "ok")]
    against = "" if missed.empty else (
        f"Under Coulomb's law `nesterov_jacobi` does not solve {listed(missed['scene'])} in {number(missed['sweep'].max())} sweeps; "
        f"the residual is still {span(missed['natural_residual'])}.")
    held, rows = within(answers, "penetration")
    rules = solves[~solves["relaxation"].str.startswith("cone_")]
    solved = (rules["status"] == "ok") & (rules["complementarity_share"] <= 1)
    deepest = rows["error"].max(skipna=False)
    return Finding(
        judge(held.all() and solved.all() and reached.all() and all_at_most(left, 1e-9),
              held.all() and solved.any() and reached.any() and all_at_most(left, 1e-9),
              f"{share(solved.sum(), len(rules))} relaxations and laws"),
        f"One step's contacts by the convex law are solved by `nesterov_jacobi` in {share(reached.sum(), len(paper))} scenes, in "
        f"{span(paper.loc[reached, 'sweep'])} sweeps; what is solved overlaps by at most {number(left.max(skipna=False))} m. "
        + (f"{against} " if against else "")
        + f"Columns, pyramids and slabs at rest overlap by at most {number(deepest)} of their size; in {share(solved.sum(), len(rules))} solves "
        "of a pile impulse times gap speed is within the tolerance.", number(deepest), number(rows["bound"].iloc[0]), against)


def coulomb(stopping, incline, headings):
    held, total = dict.fromkeys(LAWS, 0), dict.fromkeys(LAWS, 0)
    for answers in (incline, stopping):
        inside, rows = within(answers)
        for law in LAWS:
            held[law] += inside[rows["friction"] == law].sum()
            total[law] += (rows["friction"] == law).sum()
    for law, rows in headings.groupby("friction"):
        straight = (rows["share_error"] <= 1e-8) & (rows["heading_error_rad"] <= 1e-8) & (abs(rows["deceleration_share"] - 1) <= 1e-8)
        held[law] += (straight & (rows["status"] == "ok")).sum()
        total[law] += len(rows)
    some(range(total["coulomb"]), "answer by `coulomb`")
    lift = good(stopping[(stopping["quantity"] == "lift") & (stopping["friction"] == "cone")], "measured")["measured"].max()
    lifts = lift > 1e-6
    against = f"Under the convex law `cone`, the paper's, a sliding cube lifts by {number(lift)} m." if lifts else ""
    true = held["coulomb"] == total["coulomb"]
    return Finding(
        judge(true and held["cone"] == total["cone"] and not lifts, true, "Coulomb's law (`coulomb`, ours), not by the paper's laws"),
        f"Thresholds, accelerations, stopping distances, a ring's spin, a pushed row and {headings['heading_deg'].nunique()} headings are within their bounds in "
        + ", ".join(f"{share(held[law], total[law])} with `{law}`" for law in LAWS if total[law]) + f", of those that a law has a bound for. {against}",
        share(held["coulomb"], total["coulomb"]), f"{total['coulomb']} of {total['coulomb']}", against)


def convex(solves, verdicts):
    rows = solves[(solves["law"] == "cone") & (solves["tolerance"] <= 1e-8)]
    ours = some(rows[~rows["relaxation"].str.startswith(("cone_", "siconos_"))], "solve of the convex law")
    solved = good(ours, "error_m_per_s")
    farthest = solved["error_m_per_s"].max() if len(solved) else float("nan")
    judges = verdict_rows(verdicts, "cone_problems.ipopt", "cone_problems.velocity")
    agree = (judges["verdict"] == "holds").all()
    true = agree and farthest <= 1e-3
    return Finding(
        judge(true and len(solved) == len(ours), true, f"solves that meet their tolerance, {share(len(solved), len(ours))}"),
        f"Velocities of the convex law lie at most {number(farthest)} m/s from the planted ones in the {share(len(solved), len(ours))} "
        "solves that meet a residual of 1e-8; the judges, an interior point method and Ipopt, "
        + ("agree." if agree else "do not agree."),
        f"{number(farthest)} m/s", "0.001 m/s")


def hovers(gaps):
    convex_law = some(gaps[gaps["friction"] == "cone"], "run by `cone`")
    others = gaps[gaps["friction"] != "cone"]
    formula = (convex_law["status"] == "ok") & (convex_law["error"] <= 1e-6)
    flat = others["gap_m"] <= 1e-9
    highest = convex_law["gap_m"].max()
    against = f"Under the convex law `cone`, the paper's, a box that slides steadily hovers by {number(1e3 * highest)} mm " \
        f"at the largest step." if highest > 1e-6 else ""
    return Finding(
        judge(formula.all() and flat.all()),
        f"{against} The gap is h mu v to {number(convex_law['error'].max(skipna=False))} of it; by the other laws it is at most "
        f"{number(others['gap_m'].max())} m.".strip(), number(convex_law["error"].max(skipna=False)), "1e-6", against)


def box_lcp(headings, incline, stopping):
    held = {}
    for law in ("box", "disc"):
        judged = [(inside[rows["friction"] == law]) for inside, rows in map(within, (incline, stopping))]
        some(judged[0], f"answer by `{law}`")
        held[law] = all(inside.all() for inside in judged)
    shares = {law: good(headings[headings["friction"] == law], "deceleration_share")["deceleration_share"] for law in held}
    straight = {law: len(shares[law]) and all_at_most(abs(shares[law] - 1), 1e-8) for law in held}
    most = shares["box"].max()
    along = "motion along an axis (`box`)" + (" or a disc in the place of the box (`disc`)" if held["disc"] and straight["disc"] else "")
    return Finding(
        judge(held["box"] and straight["box"], held["box"], along),
        f"With per-axis bounds (`box`) planes and stops are {'' if held['box'] else 'not '}within their bounds, and a box that slides "
        f"askew is slowed by up to {number(most)} mu g; with a disc (`disc`) by {number(shares['disc'].max())} mu g.",
        f"{number(most)} mu g", "1 mu g", "" if straight["box"] else
        f"Friction of the box law is not the same in every direction: it slows a box by up to {number(most)} mu g.")


def unique_motion(answers):
    names = ("redundant_motion", "redundant_force", "permuted_motion", "permuted_force")
    held, rows = within(answers, *names)
    worst = {name: some(rows.loc[rows["quantity"] == name, "error"], f"answer about {name}").max(skipna=False) for name in names}
    return Finding(
        judge(held.all(), held.any(), f"{share(held.sum(), len(rows))} answers"),
        f"However many balls carry a slab, it moves the same to {number(worst['redundant_motion'])} m, and they carry its weight to "
        f"{number(worst['redundant_force'])} of it. A pile whose bodies and contacts stand in the opposite order moves the same to "
        f"{number(worst['permuted_motion'])} m; balls that give way carry the same to {number(worst['permuted_force'])} of the mean.",
        f"{share(held.sum(), len(rows))}", f"{len(rows)} of {len(rows)}")


def statics(answers, thresholds):
    held, rows = within(answers, "weight", "joints")
    right = thresholds["right"] == 1
    return Finding(
        judge(held.all() and right.all(), held.all() and right.any(), f"{share(right.sum(), len(right))} structures at their limits"),
        f"The ground carries the weight and each joint of a column what is above in {share(held.sum(), len(held))} answers; overhangs "
        f"and arches just inside and outside of their limits stand and fall as they should in {share(right.sum(), len(right))} runs.",
        share(right.sum(), len(right)), f"{len(right)} of {len(right)}")


def late(motions):
    some(motions if {"within", "end"} <= set(motions["variant"]) else [], "run with friction within the step and at its end")
    lawful = motions["expected"].where(motions["quantity"] == "threshold", 0)  # by Coulomb's law what creeps or moves stays
    off = np.maximum(abs(motions["measured"] - lawful), motions["resolved"]).where(motions["status"] == "ok")
    table = motions.assign(off=off).set_index(["scene", "step_s", "quantity", "variant"])["off"].unstack("variant")
    table = table[table["end"].notna()]  # an unsolved run of the rival is no measurement
    nearer, alike = table["within"] < table["end"], table["within"] == table["end"]
    creep = motions[motions["quantity"] == "creep"].groupby("variant")["measured"]
    violated = motions.groupby("variant")["natural_residual"]
    unsolved = motions[motions["status"] != "ok"]
    return Finding(
        judge((nearer | alike).all() and nearer.any(), nearer.any(), cases(table[nearer | alike])),
        f"What friction holds creeps by {span(creep.get_group('end'))} m/s where friction comes at the end of the step, by at most "
        f"{number(creep.get_group('within').max())} m/s where it is solved within the step. The natural residual of Coulomb's law is "
        f"{span(violated.get_group('end'))} at the end, and {number(violated.get_group('within').max())} at most within. Friction within the step "
        f"is nearer to Coulomb's law in {share(nearer.sum(), len(table))} cases that friction at the end solves, in {alike.sum()} both are as "
        "near as is measured."
        + "".join(f" On the {r['scene']} friction {LATE[r['variant']]} does not solve every step." for _, r in unsolved.iterrows())
        + f" {late_cost(motions)}",
        share((nearer | alike).sum(), len(table)), share(len(table), len(table)))


def cases(table):
    """Which quantities of which scenes."""
    return joined(f"{quantity} of the {scene}" for scene, quantity in dict.fromkeys((key[0], key[2]) for key in table.index))


CLAIMS = (
    Claim(12, "Contact is accurate: nothing overlaps once it is solved.", "an accurate contact and Coulomb friction model",
          ("contact_convergence/traces", "stack/answers", "friction_cone/solves"), nothing_overlaps, "contact_convergence_residual"),
    Claim(13, "Friction is Coulomb's.", "an accurate contact and Coulomb friction model",
          ("stopping/answers", "incline/answers", "friction_isotropy/headings"),
          coulomb, "stopping_answers"),
    Claim(14, "The step with contacts is a convex minimisation.", "a convex minimization formulation",
          ("cone_problems/solves", "cone_problems/verdicts"), convex, "cone_problems_profiles"),
    Claim(15, "The convex law makes a sliding contact hover by h mu v.", "", ("convex_gap/gaps",), hovers, "convex_gap_gaps"),
    Claim(16, "The method can be recast as a fixed point iteration of a box LCP solver.",
          "can also be recast as a fixed point iteration of a box LCP solver",
          ("friction_isotropy/headings", "incline/answers", "stopping/answers"),
          box_lcp, "friction_isotropy_headings"),
    Claim(17, "Redundant contacts leave forces open, and the motion unique.", "", ("stack/answers",), unique_motion, "stack_answers"),
    Claim(18, "Stacks and piles carry their weight, and fall where theory says.", "", ("stack/answers", "stack/thresholds"), statics,
          "stack_thresholds"),
    Claim(19, "Friction within the step is better than at the end of the step.",
          "approximate friction at the end of the step",
          ("late_friction/motions",), late, "late_friction_creep"),
)
