"""The first page: what a user asks, each with one sentence, one number and one figure, all from the results."""

from dataclasses import dataclass

from content import Figure, counted, number, share, span
from sections.cost import LEVELS, quickest, rival_wins


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
    return (number(ratio.median()), "times as long",
            f"An error of {number(LEVELS[-1])} takes our quickest method {number(ratio.median())} times as long as one of {number(LEVELS[0])} "
            f"in the median of the {share(reached, len(ours))} scenes and steps where both are reached ({span(ratio)} times; "
            f"{span(1e3 * ours[LEVELS[-1]])} ms a step); Newton's method with CHOLMOD is quicker than every other in "
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
    steps = ends.groupby("status")["steps"].sum()
    refuted = verdicts.loc[verdicts["id"] == "worlds.refuted", "measured"].max()
    return (share(held, cases), "hard cases pass every gate",
            f"With no setting for any of them, {share(held, cases)} hard cases pass every gate (ropes, grids and solids by "
            f"`conjugate_gradients`, contacts by `direct`); of {int(steps.sum())} steps of random scenes {int(steps.get('ok', 0))} are solved, "
            f"{int(steps.get('not_converged', 0))} miss their tolerance and say so, {int(steps.get('diverged', 0))} diverge and say so, and "
            f"the judge refutes {number(refuted)} of those that say ok. See [#point_hard_cases], [#contact_hard_cases] and "
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
    return (f"{change} %", "is what effects that are present and empty change of the time",
            f"Effects that are present and empty change {number(measured('effects.empty.bitwise'))} numbers of the result, and the time by "
            f"{change} % (at most {number(100 * bound)} % is asked for: {free}); contacts without friction take {number(100 * measured('effects.frictionless.cheaper'))} "
            f"% of the time of those with it, and a scene without its solid's strain {number(100 * measured('effects.removed.cheaper'))} % of "
            "that with it. See [#effects_cost].")
