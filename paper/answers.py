"""The first page: what a user asks, each with one sentence, one number and one figure, all from the results; where to find more."""

from dataclasses import dataclass

from content import Figure, counted, number, share, span
from sections.cost import LEVELS, quickest, rival_wins


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
        Figure("work_precision_answer", "Time of a step by our quickest method over the error reached; solid the shorter step, dashed the "
               "longer."),
        results, ["work_precision/points"], accuracy_told)


def accuracy_told(points):
    ours = quickest(points[~points["outer"].isin(["judge", "rival"])]).pivot_table("wall_s", ["scene", "step_s"], "level", dropna=False)
    ours = ours.reindex(columns=LEVELS)
    ratio = ours[LEVELS[-1]] / ours[LEVELS[0]]
    reached = int(ratio.notna().sum())
    wins, entered = rival_wins(points)
    if not reached:
        return "none", "", (f"In none of {counted(len(ours), 'scene')} does a method of ours come to an error of {number(LEVELS[-1])}.")
    return (number(ratio.median()), "times as long for an error a million times smaller",
            f"To reach an error of {number(LEVELS[-1])} our quickest method takes {number(ratio.median())} times as long as for "
            f"{number(LEVELS[0])}. That is the median over {share(reached, len(ours))} pairs of scene and step; the ratio ranges over {span(ratio)}. "
            f"A step takes {span(1e3 * ours[LEVELS[-1]])} ms. Newton's method with CHOLMOD is quicker than all our methods in "
            f"{share(wins, entered)} rows that it enters. See [#work_precision].")


def stability(results):
    return answered(
        "Do hard cases stay numerically stable?",
        Figure("contact_hard_cases_answer", "Every gate of every hard contact case: the number measured over its bound."),
        results, ["point_hard_cases/gates", "contact_hard_cases/gates", "generated_worlds/ends", "generated_worlds/verdicts"],
        stability_told)


def stability_told(points, contacts, ends, verdicts):
    held = cases = 0
    for gates, relaxation in ((points, "conjugate_gradients"), (contacts, "direct")):
        asked = gates[(gates["status"] != "skipped") & (gates["relaxation"] == relaxation)]
        passed = (asked["holds"] == 1).groupby(asked["scene"]).all()
        held, cases = held + passed.sum(), cases + gates["scene"].nunique()
    by_direct = contacts[contacts["relaxation"] == "direct"]
    missing = by_direct.loc[by_direct["steps_ok"] < by_direct["steps"], "scene"].nunique()
    steps = ends.groupby("status")["steps"].sum()
    refuted = verdicts.loc[verdicts["id"] == "worlds.refuted", "measured"].max()
    return (share(held, cases), "hard cases pass every gate",
            f"{share(held, cases)} hard cases pass every gate without a setting for any of them (ropes, grids and solids by "
            f"`conjugate_gradients`, contacts by `direct`); {share(missing, contacts['scene'].nunique())} of those with contact miss their tolerance in some steps, and say so. Of {int(steps.sum())} steps of random scenes {int(steps.get('ok', 0))} say they are solved, "
            f"{int(steps.get('not_converged', 0))} say they miss their tolerance, and {int(steps.get('diverged', 0))} say they diverge. "
            f"The judge refutes {number(refuted)} of those that say they are solved. See [#point_hard_cases], [#contact_hard_cases] and "
            "[#generated_worlds].")


def only_what_is_used(results):
    return answered(
        "Does a scene pay only for the effects it calls for?",
        Figure("effects_cost_answer", "A scene of everything: what each effect costs a step."),
        results, ["effects_cost/verdicts"], effects_told)


def effects_told(verdicts):
    found = verdicts.set_index("id")
    def measured(name):
        return found["measured"].get(name, float("nan"))
    free = found["verdict"].get("effects.empty.free", "not measured").replace("_", " ")
    bound = found["bound"].get("effects.empty.free", float("nan"))
    change = number(100 * measured("effects.empty.free"))
    return (f"{change} %", "change of the time by effects that nothing in the scene uses",
            f"Effects that are switched on and that nothing uses change {number(measured('effects.empty.bitwise'))} numbers of the result. They change "
            f"the time by {change} %; the goal is {number(100 * bound)} % ({free}). Contacts without friction take "
            f"{number(100 * measured('effects.frictionless.cheaper'))} % of the time of contacts with it. A scene without its solid's strain takes "
            f"{number(100 * measured('effects.removed.cheaper'))} % of the time of the scene with it. See [#effects_cost].")
