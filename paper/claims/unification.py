"""Claims about one solver for everything."""

import pandas as pd

from claims.claim import Claim, Finding, judge, some, verdict_rows, worst
from content import compared, joined, number, share


def one_solver(ends, agreement, told, coupled):
    steps = ends.groupby("status")["steps"].sum()
    solved = int(steps.get("ok", 0))
    some(range(solved), "step that says ok")
    refuted = told[told["id"] == "worlds.refuted"]
    row = worst(some(refuted, "verdict worlds.refuted"))
    known = verdict_rows(coupled, "coupling.")
    held = int((known["verdict"] == "holds").sum())
    sound = row["verdict"] == "holds" and not known["verdict"].isin(["fails", "not_decided"]).any()
    other = agreement[agreement["outcome"] == "another solution"]["first_steps"].sum()
    return Finding(
        judge(sound and held == len(known) and solved == steps.sum(), sound,
              f"steps that say ok, {share(solved, int(steps.sum()))}"),
        f"In random scenes of rigid and soft bodies, cloth, joints and contact in one solve, {solved} steps say ok; {row['quantity']}: "
        f"{number(row['measured'])}. Of the same scenes in other words {int(other)} first steps end elsewhere. "
        f"Of momentum in impacts, sag, weight and a rope's friction beside known answers {share(held, len(known))} verdicts hold" + (
            f"; not `{'`, `'.join(known[known['verdict'] != 'holds']['id'])}`." if held < len(known) else "."),
        number(row["measured"]), number(row["bound"]))


def three_scenes(verdicts, scenes):
    rows = verdict_rows(verdicts, "figure_1.finite", "figure_1.claims", "figure_1.energy")
    goals = verdict_rows(verdicts, "figure_1.").query("verdict == 'missed'")
    against = "" if goals.empty else "Of the paper's three scenes these goals are missed: " + "; ".join(
        f"`{row['id']}`, {row['quantity']} {' against '.join(compared(row['measured'], row['bound']))}" for _, row in goals.iterrows()) + "."
    stable = bool((rows["verdict"] == "holds").all())
    steps, ok = int(scenes["steps"].sum()), int(scenes["steps_ok"].sum())
    some(range(steps), "step")
    return Finding(
        judge(stable and ok == steps, stable, f"steps that meet their tolerance, {share(ok, steps)}"),
        f"{share(int((rows['verdict'] == 'holds').sum()), len(rows))} verdicts on finite states, on energy and on steps that say ok hold, and "
        f"{share(ok, steps)} steps meet their tolerance, of stand-ins for the paper's meshes: its sizes, steps and iterations are not known. "
        f"{against}".strip(), share(ok, steps), f"{steps} of {steps}", against)


def rigid(stack, hard, bench, answers, gates, accuracy):
    rigid_alone = hard[~hard["id"].str.startswith("contact_hard.soft.")]
    held = {name: rows["verdict"] == "holds" for name, rows in (("stack", stack), ("contact_hard_cases", rigid_alone), ("simbenchmark", bench))}
    count, total = sum(rows.sum() for rows in held.values()), sum(map(len, held.values()))
    outers, laws = (joined(f"`{name}`" for name in pd.unique(pd.concat([frame[column] for frame in (answers, gates, accuracy)])) if name)
                    for column in ("outer", "friction"))
    papers = "`plain`" in outers and "`cone`" in laws
    missed = pd.concat([stack, rigid_alone, bench]).query("verdict != 'holds'")
    against = "" if missed.empty else "Of rigid bodies with contact and friction there do not hold: " + "; ".join(
        f"`{row['id']}` ({row['class']}), {' against '.join(compared(row['measured'], row['bound']))}" for _, row in missed.iterrows()) + "."
    return Finding(
        judge(papers and count == total, count == total, f"{outers} and {laws}, not the paper's method"),
        "Stacks, arches, hard contacts and the scenes of SimBenchmark: " + joined(
            f"{share(rows.sum(), len(rows))} verdicts of `{name}` hold" for name, rows in held.items())
        + f". They are by {outers} with {laws}. {against}".rstrip(), share(count, total), f"{total} of {total}", against)


CLAIMS = (
    Claim(30, "One solver simulates rigid and deformable bodies, coupled both ways.",
          "how the same solver can be used to simulate both rigid and deformable solids with two way coupling",
          ("generated_worlds/ends", "generated_worlds/agreement", "generated_worlds/verdicts", "coupling/verdicts"), one_solver, "generated_worlds_agreement"),
    Claim(31, "Boxes on the ground, bunnies on cloth and a cow on the ground run stably.",
          "rigid boxes falling on ground, bunnies falling on a piece of cloth, a flexible cow falling on ground",
          ("figure_1/verdicts", "figure_1/scenes"), three_scenes, "figure_1_series"),
    Claim(32, "Position based dynamics is usable for rigid bodies with contact and friction.",
          "thus it is almost never used for rigid body simulations", ("stack/verdicts", "contact_hard_cases/verdicts", "simbenchmark/verdicts",
                                                        "stack/answers", "contact_hard_cases/gates", "simbenchmark/accuracy"),
          rigid, "contact_hard_cases_gates"),
)
