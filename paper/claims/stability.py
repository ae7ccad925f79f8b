"""Claims about the fixed point iteration and its stability."""

import numpy as np

from claims.claim import Claim, Finding, Untested, judge, some, verdict_rows, worst
from content import counted, joined, listed, number, share, span
from direction import steady_step
from reading import CONTRACTING
from sections.motion import equal_work_ratios
from sections.outer import contact_orders
from selecting import drawable, good, step_text


def converges(rates, touching):
    plain = some(rates[rates["outer"] == "plain"], "run of `plain`")
    contact = some(touching[touching["status"] == "ok"], "contact that is judged")
    contact = contact.assign(returns=contact["returns"] == 1)
    held = contact["predicted_rate"] < 1
    done = plain["behaviour"].isin(CONTRACTING)
    below = plain["predicted_rate"] < 1
    text = f"`plain` converges in {share(done.sum(), len(plain))} cases of {listed(plain['scene'].unique())}"
    chain = plain["scene"] == "chain20"
    if chain.any() and not done[chain].all():
        text += (f", on `chain20` only for h <= {step_text(plain.loc[chain & done, 'step_s'].max())} and mass ratios of at most "
                 f"{number(plain.loc[chain & done, 'mass_ratio'].max())}"
                 if done[chain].any() else ", on `chain20` in none")
    return Finding(
        judge(done.all() and contact["returns"].all(), below.any() and done[below].all() and contact.loc[held, "returns"].all(),
              "a predicted spectral radius below 1"),
        f"{text}. Of the {below.sum()} cases with a predicted spectral radius below 1 it converges in {done[below].sum()}, of the "
        f"{(~below).sum()} others in {done[~below].sum()}. In contact it returns to the solution in {contact.loc[held, 'returns'].sum()} of "
        f"{held.sum()} cases with a radius below 1, in {contact.loc[~held, 'returns'].sum()} of {(~held).sum()} others.",
        share(done.sum(), len(plain)), share(len(plain), len(plain)), "" if done.all() else f"{text}.")


def contracts(outer, effects, rates, contacts, touching):
    rows = (verdict_rows(outer, "outer.pendulum_rate", "outer.chain_map.rate"), verdict_rows(effects, "contraction.radius"),
            verdict_rows(contacts, "contact_contraction."))
    holds = all((frame["verdict"] == "holds").all() for frame in rows)
    apart = max((worst(frame) for frame in rows), key=lambda row: row["measured"])
    pendulum = rates[(rates["outer"] == "plain") & (rates["scene"] == "pendulum")].sort_values("step_s").head(2)
    some(pendulum, "run of `plain` on the pendulum")
    slope = np.diff(np.log(pendulum["measured_rate"])) / np.diff(np.log(pendulum["step_s"]))
    order = slope[0] if len(slope) else float("nan")
    orders = list(contact_orders(some(touching, "contact")))
    powers = [power for *_, power in orders]
    falls = len(powers) > 0 and min(powers) > 0
    slower = [(scene, power) for scene, _, _, power in orders if power < 1.9]
    against = (f"In contact the contraction is not always of order h²: in {share(len(slower), len(orders))} cases the radius falls as h to the power "
               f"{span([power for _, power in slower])} ({joined(sorted({scene for scene, _ in slower}))}).") if slower else ""
    return Finding(
        judge(False, holds and falls and abs(order - 2) <= 0.1, "a spectral radius below 1"),
        f"The measured rate of `plain` differs from the dense spectral radius, where that is from 0.01 to 0.95, by at most "
        f"{number(apart['measured'])}; on the pendulum it falls as h to the power {number(order)}. In contact that sticks or slides a "
        f"judge's spectral radius agrees with the solver's and falls as h to the power {span(powers)}. Where the radius is 1 or more "
        f"there is no contraction. {against} The proof itself was not available.".replace("  ", " "),
        number(apart["measured"]), number(apart["bound"]), against)


def stable(steps):
    implicit = steps[(steps["family"] == "position") & (steps["direction_blend"] == 1)]
    velocity = steps[steps["family"] == "velocity"]
    ratios, at_most = {}, []
    for scene, rows in some(implicit, "run with implicit directions").groupby("scene", sort=False):
        ours, theirs = (good(frame, "largest_step_s")["largest_step_s"].max() for frame in
                        (rows[rows["missed_steps"] == 0], velocity[velocity["scene"] == scene]))
        ratios[scene] = ours / theirs
        if not ours < steps.loc[steps["scene"] == scene, "largest_step_s"].max():
            at_most.append(scene)
    longer = [scene for scene, ratio in ratios.items() if ratio > 1]
    return Finding(
        judge(len(longer) == len(ratios), longer, f"{share(len(longer), len(ratios))} scenes ({listed(longer)})"),
        f"The largest stable step with implicit directions, by {listed(implicit['outer'].unique())}, over that of the best velocity time "
        "stepping: " + "; ".join(f"{number(ratio)} on `{scene}`" for scene, ratio in ratios.items())
        + (f". On {listed(at_most)} that is the longest step tried" if at_most else "")
        + ("." if (implicit["outer"] == "plain").any() else ". `plain`, the paper's iteration, is not among these runs."),
        f"{span(list(ratios.values()))} times", "above 1")


def solved_of(runs, scene):
    own = runs[runs["scene"] == scene]
    return len(good(own, "error")), len(own)


def satisfied(work, contact):
    position, velocity = work[work["family"] == "position"], work[work["family"] == "velocity"]
    some(position, "position run"), some(velocity, "velocity run"), some(contact, "run with contact")
    ratios, touching = {}, {scene: [] for scene in contact["scene"].unique()}
    for scene, _, found in equal_work_ratios(work):
        ratios.setdefault(scene, []).extend(found)
    for scene, _, found in equal_work_ratios(contact):
        touching[scene].extend(found)
    scenes = list(position["scene"].unique())
    nearer = [scene for scene, found in (ratios | touching).items() if found and min(found) > 1]
    fewest = min(scenes, key=lambda scene: len(good(position[position["scene"] == scene], "error")))
    (solved, ours), (whole, theirs) = solved_of(position, fewest), solved_of(velocity, fewest)
    against = "" if not theirs or solved / ours >= whole / theirs else (
        f"On `{fewest}` position runs at equal work solved {share(solved, ours)}, where velocity stepping, which does not "
        f"claim to solve its steps, came through {share(whole, theirs)}.")
    told = [f"{span(found)} on `{scene}`, where {share(*solved_of(position, scene))} position runs and {share(*solved_of(velocity, scene))} "
            "others come through" for scene, found in ratios.items()]
    overlaps = [f"{span(found)} on `{scene}`" for scene, found in touching.items() if found and min(found) >= 1]
    less = {scene: (sum(ratio < 1 for ratio in found), len(found)) for scene, found in touching.items() if found and min(found) < 1}
    if less:
        against += " " * bool(against) + "In contact velocity stepping with as much work violates less in " + "; ".join(
            f"{share(*counts)} comparisons on `{scene}`" for scene, counts in less.items()) + "."
    total = len(scenes) + len(touching)
    return Finding(
        judge(len(nearer) == total, nearer, f"steps that are solved, on {listed(nearer)}"),
        (f"Where implicit directions solve every step, velocity stepping with as much work violates links more, by a factor of "
         f"{'; '.join(told)}. " if told else "No run with implicit directions solves every step. ")
        + (f"With contact, solved by Gauss-Seidel as far as the work goes, it overlaps or stretches more by a factor of {'; '.join(overlaps)}. "
           if overlaps else "") + against,
        f"{share(len(nearer), total)} scenes", f"{total} of {total}", against)


def directions_suffice(contenders, cells):
    found = cells["iterations"].notna()
    accelerated = cells["memory"] == cells["memory"].max()
    frozen, plain, inertia = (found[accelerated & (cells["outer"] == outer)].sum() for outer in ("frozen", "plain", "proximal"))
    if inertia <= frozen:
        raise Untested("`proximal` finds no step that `frozen` does not")
    part = (plain - frozen) / (inertia - frozen)
    total = len(cells[["mass_ratio", "step_s"]].drop_duplicates())
    longest = {key: steady_step(rows) for key, rows in contenders.groupby(["outer", "family"], sort=False)}
    kept, refreshed = (longest.get(key, 0.0) for key in (("frozen", "velocity"), ("plain", "position")))
    heavier = max((step for (outer, _), step in longest.items() if outer == "proximal"), default=0.0)
    once = longest.get(("proximal", "stiffness, one linearisation"), 0.0)
    against = "" if refreshed > kept else (
        f"On the taut chain refreshed directions alone (`plain`) are solved and stable up to {number(refreshed)} of the explicit limit of step, "
        f"frozen ones are stable up to {number(kept)}; `proximal`, with a bound of the geometric stiffness in the mass matrix, is up to {number(heavier)}.")
    return Finding(
        judge(part >= 0.5 and refreshed > kept),
        f"Of {total} cells of the chain's map, `frozen` (directions of the start) finds the step in {frozen}, `plain` (directions "
        f"refreshed) in {plain}, `proximal` (ours: refreshed, the mass matrix altered by a bound of the geometric stiffness) in "
        f"{inertia}. Refreshed directions alone are {number(100 * part)} % of what both gain. Simulated, the taut chain is stable and its steps "
        f"are solved up to {number(kept)} of the explicit limit with frozen directions, {number(refreshed)} with refreshed ones, {number(heavier)} "
        f"with a heavier mass matrix as well ({number(once)} if that is linearised once). {against}".strip(),
        f"{number(100 * part)} %", "at least 50 %", against)


def differ(errors, residuals):
    errors = errors[errors["relaxation"] != "nesterov_jacobi"]  # what sweeps leave over is no end of an outer iteration
    last = errors.sort_values("iteration").groupby(["scene", "step_s", "mass_ratio", "outer"], sort=False).tail(1)
    ends = last.pivot_table("error", ["scene", "step_s", "mass_ratio"], "outer", dropna=False)
    if not {"plain", "incremental"} <= set(ends):
        raise Untested("The table does not hold both `plain` and `incremental`")
    solved = good(last[last["outer"] == "plain"], "error").set_index(["scene", "step_s", "mass_ratio"]).index
    ends = some(ends.loc[ends.index.isin(solved)], "step that `plain` solves")
    far = ends["incremental"] > 1e3 * ends["plain"]
    apart, same = far.sum(), ends.index[~far].get_level_values("scene").unique()
    known = residuals[drawable(residuals, ["residual_share"])]  # where `incremental` ends is no solution, and says so
    shares = {outer: rows["residual_share"] for outer, rows in known.groupby("outer")}
    whole, part = (some(shares.get(outer, []), f"end of `{outer}`") for outer in ("plain", "incremental"))
    wider = whole.max() < part.min() / 1e3
    return Finding(
        judge(apart == len(ends) and wider, wider and apart, f"all that `plain` solves but {listed(same)}"),
        f"Where `plain` (whole multipliers) solves the step, at errors of {span(ends['plain'])}, `incremental` (classic PBD) ends at "
        f"{span(ends['incremental'])}" + (f"; on {listed(same)} both end at the same point." if len(same) else ".")
        + f" A judge finds that impulses along the directions at the end leave {span(100 * whole)} % of the step's correction unexplained with `plain`, "
        f"{span(100 * part)} % with `incremental`.", f"{share(apart, len(ends))} steps apart", f"{len(ends)} of {len(ends)}")


def stops_soft(stretches):
    stopped = some(stretches[stretches["variant"] == "stopped"], "run that is stopped early")
    soft, parts = [], []
    for (scene, compliance, relaxation, step), rows in stopped.groupby(["scene", "compliance_m_per_n", "relaxation", "step_s"], sort=False):
        rows = rows[rows["status"] == "ok"].sort_values("sweeps")
        beyond = rows["stretch_m"] - rows["physical_m"]
        soft.append(len(rows) > 1 and beyond.iloc[0] > max(0.01 * rows["physical_m"].iloc[0], 1e-9) and beyond.iloc[0] > beyond.iloc[-1])
        if scene == "chain" and not compliance and relaxation == "gauss_seidel" and len(rows):
            few, many = rows.iloc[0], rows.iloc[-1]
            parts.append(f"{number(few['stretch_m'])} m after {counted(int(few['sweeps']), 'sweep')} a step and {number(many['stretch_m'])} m after "
                         f"{number(many['sweeps'])} at h = {step_text(step)}")
    apart = stopped.loc[(stopped["relaxation"] == "gauss_seidel") & (stopped["scene"] == "chain"), "error"].max(skipna=False)
    count = sum(soft)
    return Finding(
        judge(count == len(soft) and apart <= 1e-6, count, f"{share(count, len(soft))} cases"),
        f"From zero impulses a hard chain of 1 m, swept by `gauss_seidel`, hangs longer by {'; '.join(parts)}, as the sweeps' "
        f"matrix says to {number(apart)} of it. Fewer sweeps stretch more in {share(count, len(soft))} cases of relaxation, stiffness and step.",
        f"{share(count, len(soft))} cases", f"{len(soft)} of {len(soft)}")


CLAIMS = (
    Claim(1, "The fixed point iteration converges.", "we introduce a fixed point iteration and prove it converges in Appendix A",
          ("outer_convergence/map", "contact_contraction/rates"), converges, "outer_convergence_map"),
    Claim(2, "It is a contraction for short steps; its rate goes as h².", "prove it converges in Appendix A",
          ("outer_convergence/verdicts", "contraction/verdicts", "outer_convergence/map", "contact_contraction/verdicts",
           "contact_contraction/rates"), contracts,
          "outer_convergence_predicted_rate"),
    Claim(3, "Implicit directions are more stable than velocity stepping.",
          "The implicit treatment of the constraint directions gives us improved stability over velocity based methods.",
          ("direction/largest_steps",), stable, "direction_largest_steps"),
    Claim(4, "They satisfy constraints better.", "better constraint satisfaction, improved stability",
          ("direction/equal_work", "direction/contact"), satisfied, "direction_equal_work"),
    Claim(5, "Updating the directions is what makes it robust, without altering the mass matrix.",
          "rely mostly on updating the constraint directions at every iteration, without altering the mass matrix",
          ("direction/contenders", "stability_map/chain20"), directions_suffice, "direction_contenders"),
    Claim(6, "Whole multipliers and increments end at different points.", "", ("outer_convergence/errors", "outer_convergence/residuals"), differ,
          "outer_convergence_errors"),
    Claim(7, "A solver that is stopped early makes constraints soft.",
          "iterative solvers are often not run to convergence and this makes the constraints soft",
          ("softness/stretches",), stops_soft, "softness_sweeps"),
)
