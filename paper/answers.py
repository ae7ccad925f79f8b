"""The first page: what a user asks, each with one sentence, one number and one figure, all from the results; where to find more."""

from dataclasses import dataclass

import pandas as pd

from claims import kinds_counted
from content import Figure, counted, number, share, span
from failed import counts_told
from sections.cost import LEVELS, quickest, rival_wins
from selecting import told_runs
from trajectories import DIGITS, least_times


GUIDE = {
    "Which method is the quickest for a given error?": "work_precision",
    "What does accuracy cost over a whole motion?": "trajectories",
    "Which settings should my scene have?": "advice",
    "When is Newton's method quicker?": "rival_newton",
    "At which steps, masses and stiffnesses does an iteration converge?": "stability_map",
    "Does it keep energy and momentum?": "energy",
    "Does friction drift on a slope?": "incline",
    "Do stacks and arches stand?": "stack",
    "Which solver for contact with friction?": "cone_problems",
    "What does an effect cost?": "effects_cost",
    "Which claims of the paper hold?": "claims",
    "What failed, and why?": "failed",
    "What did the last change of the program change?": "changes",
    "What does a word mean?": "words",
    "Which machine and program, and how to cite?": "provenance",
}  # and the section that answers it


@dataclass
class Answer:
    question: str
    number: str
    unit: str
    sentence: str
    figure: Figure


def answers(results):
    found = [cost_of_accuracy(results), stability(results), only_what_is_used(results)]
    for answer in found:
        experiment = answer.figure.name.removesuffix("_answer")
        answer.figure.drawn = results.drawn(experiment, answer.figure.name)
    return found


def summary(found, verdicts):
    """What the tool settles, and what holds and does not, in three sentences."""
    kinds = [finding.kind() for _, finding in found]
    claims = kinds_counted(kinds)
    held = verdicts["verdict"] == "holds"
    return ("`pbdcheck` measures what position based dynamics can and cannot do: steps of rigid bodies, cloth and elastic solids with contact "
            "and friction, beside references that share no code with the solver. The paper's own method [@francu2017position] is `plain` with "
            "`nesterov_jacobi` and the law `cone`; \"ours\" on this page are all that the solver offers. "
            f"Of {len(found)} claims, quoted from the paper or inferred, these runs find {claims} ([#claims]); of {len(verdicts)} verdicts {held.sum()} hold, "
            f"{counts_told(verdicts[~held])} ([#failed]).")


def guide(sections):
    """Questions and the sections that answer them, of those that there are."""
    there = {section.name for section in sections}
    return [(question, name) for question, name in GUIDE.items() if name in there]


def answered(question, figure, results, names, tell):
    """The answer that `tell` makes of the tables `names`, or that one of them is missing."""
    tables = [results.table(*name.split("/")) for name in names]
    missing = [f"`{name}.csv`" for name, table in zip(names, tables) if table is None]
    made = ("not tested", "", f"{' and '.join(missing)} is missing.") if missing else tell(*tables)
    return Answer(question, *made, figure)


def cost_of_accuracy(results):
    return answered(
        "What does accuracy cost in time?",
        Figure("work_precision_answer", "Time of a step by our quickest method over the error of its solution; solid the shorter step, "
               "dashed the longer."),
        results, ["work_precision/points", "trajectories/runs"], accuracy_told)


def motion_told(runs):
    """What a tenth of the error of a whole motion takes."""
    runs = told_runs(runs)
    least = [least_times(runs, accuracy).min().replace(float("inf"), float("nan")) for accuracy in DIGITS]
    known = pd.concat([(fine / coarse).dropna() for coarse, fine in zip(least, least[1:])])
    if known.empty:
        return "Of no whole motion is a tenth of the error reached."
    return (f"Over a whole motion, where steps must be shorter, too, a tenth of the error takes {number(known.median(), 2)} times as long "
            f"({span(known)}; median over {len(known)} digits of {counted(known.index.nunique(), 'scene')}).")


def accuracy_told(points, runs):
    ours = quickest(points[~points["outer"].isin(["judge", "rival"])]).pivot_table("wall_s", ["scene", "step_s"], "level", dropna=False)
    ours = ours.reindex(columns=LEVELS)
    ratio = ours[LEVELS[-1]] / ours[LEVELS[0]]
    reached = int(ratio.notna().sum())
    wins, entered = rival_wins(points)
    if not reached:
        return "none", "", (f"In none of {counted(len(ours), 'scene')} does a method of ours come to an error of {number(LEVELS[-1])}. "
                            f"{motion_told(runs)}")
    return (number(ratio.median()), "times as long to solve a step a million times as accurately",
            f"To solve the equations of one step to an error of {number(LEVELS[-1])} our quickest method takes {number(ratio.median())} times as "
            f"long as to {number(LEVELS[0])} (median over {share(reached, len(ours))} pairs of scene and step; {span(ratio)}), "
            f"{span(1e3 * ours[LEVELS[-1]])} ms. {motion_told(runs)} Newton's method with CHOLMOD, set-up included, is quicker "
            f"than all our methods in {share(wins, entered)} rows that it enters. See [#work_precision] and [#trajectories].")


def stability(results):
    return answered(
        "Do hard cases stay numerically stable?",
        Figure("contact_hard_cases_answer", "Every gate of every hard contact case: the number measured over its bound."),
        results, ["point_hard_cases/gates", "contact_hard_cases/gates", "contact_hard_cases/frontier", "generated_worlds/ends",
                  "generated_worlds/verdicts", "generated_scenes/outcomes"], stability_told)


USED = "conjugate_gradients", "direct"  # on hard cases without contact, and with it
NONE_SOLVED = "no judged step has status ok"  # why the gate `claims` is skipped
FRAME = 1 / 60  # s


def stability_told(points, contacts, frontier, ends, verdicts, outcomes):
    held = cases = missing = 0
    unsolved = []
    for gates, relaxation in zip((points, contacts), USED):
        own = gates[gates["relaxation"] == relaxation]
        asked = own[own["status"] != "skipped"]
        none = set(own.loc[own["reason"].fillna("").str.contains(NONE_SOLVED) | (own.get("steps_ok", 1) == 0), "scene"])
        held += sum(holds and scene not in none for scene, holds in (asked["holds"] == 1).groupby(asked["scene"]).all().items())
        missing += own.loc[own["status"] == "not_converged", "scene"].nunique()
        unsolved += sorted(none)
        cases += gates["scene"].nunique()
    shorter = (~(frontier[frontier["relaxation"] == USED[1]].groupby("scene")["largest_step_s"].max() >= FRAME)).sum()
    steps, other = (frame.groupby("status")["steps"].sum() for frame in (ends, outcomes))
    refuted = verdicts.loc[verdicts["id"] == "worlds.refuted", "measured"].max()
    return (share(held, cases), "hard cases pass every gate",
            f"{share(held, cases)} hard cases pass every gate, ropes, grids and solids by `{USED[0]}`, the default, contacts by `{USED[1]}`, which is asked for. "
            f"{missing} of them miss their tolerance in some steps, and say so"
            + (f"; `{'`, `'.join(unsolved)}` in all that are judged, which does not count as passed" if unsolved else "")
            + f". {share(shorter, frontier['scene'].nunique())} cases with contact hold at no tried step of 1/60 s or more. "
            f"Of {int(steps.sum())} steps of random scenes {int(steps.get('ok', 0))} say they are solved, "
            f"{int(steps.get('not_converged', 0))} that they miss their tolerance, {int(steps.get('diverged', 0))} that they diverge; "
            f"the judge refutes {number(refuted)} of those that say they are solved. Of {int(other.sum())} steps of random scenes whose rows "
            f"may contradict each other {int(other.get('ok', 0))} are solved and {int(other.get('diverged', 0))} diverge. "
            "See [#point_hard_cases], [#contact_hard_cases], [#generated_worlds] and [#generated_scenes].")


def only_what_is_used(results):
    return answered(
        "Does a scene pay only for the effects it calls for?",
        Figure("effects_cost_answer", "Change of the time of steps after the first by effects that are listed and never act, logarithmic beyond 1 %."),
        results, ["effects_cost/verdicts", "effects_cost/absent"], effects_told)


def effects_told(verdicts, absent):
    found = verdicts.set_index("id")
    def percent(name, column="measured"):
        return f"{number(100 * found[column].get(name, float('nan')))} %"
    def word(name):
        return found["verdict"].get(name, "not measured").replace("_", " ")
    def against_goal(name):
        return f"the goal of {percent(name, 'bound')} is {'met' if word(name) == 'holds' else word(name)}"
    empty, idle, unused = "effects.empty.free", "effects.idle.free", "effects.unused.free"
    present = absent[absent["presence"].isin(["never touches", "idle"]) & (absent["time_low"] > 1)].sort_values("time_ratio", ascending=False)
    dear = "; ".join(f"{row['effect'].replace('_', ' ')}, {row['case']}: {number(100 * (row['time_ratio'] - 1))} %" for _, row in present.head(3).iterrows())
    cost = f"do cost ({dear})" if dear else "cost no more than repeats differ"
    begun = absent.loc[absent["first_longer_steps"].idxmax()] if absent["first_longer_steps"].notna().any() else None
    first = (f" Once, where a run begins, they cost up to {number(begun['first_longer_steps'])} steps more ({begun['effect'].replace('_', ' ')}, "
             f"{begun['case']})." if begun is not None and begun["first_longer_steps"] > 1 else "")
    return (percent(empty), "change of the time by effects that are listed and empty",
            f"Effects without a single entry change the time by at most {percent(empty)} ({against_goal(empty)}). Effects with entries that never "
            f"come to act {cost}: contact that never touches up to {percent(idle)} ({against_goal(idle)}), others up to "
            f"{percent(unused)} ({against_goal(unused)}).{first} Contacts without friction take "
            f"{percent('effects.frictionless.cheaper')} of the time of contacts with it. A scene without its solid's strain takes "
            f"{percent('effects.removed.cheaper')} of the time of the scene with it. See [#effects_cost].")
