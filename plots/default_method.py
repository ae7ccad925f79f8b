"""Is the default method the one to begin with? Beside all other pairs of outer iteration and relaxation."""

import numpy as np

from common import figure, footnote, panels, profile_line, shared_legend
from finding import finding
from selecting import drawable, scene_text
from styles import BLACK, FALLBACK
from wording import joined, number, share

DEFAULT = "auto conjugate_gradients"
DEFORMED = ("bunnies_on_cloth", "flexible_cow")  # in contact
MOST_OTHERS = 6
TASK = ["scene", "step_s", "tolerance"]


def pair_times(runs):
    """Wall time (s) of each pair, a row a pair, a column a task: a motion by implicit Euler and Coulomb's law with that step, solved
    to that tolerance. inf: failed; NaN: not tried."""
    alike = runs[(runs["integrator"] == "implicit_euler") & runs["friction"].isin(("none", "coulomb")) & (runs["count"] == 0)]
    solved = (alike["status"] == "ok") & drawable(alike, ["wall_s"])
    relaxation = (" " + alike["relaxation"]).where(alike["relaxation"] != "none", "")
    alike = alike.assign(pair=alike["outer"] + relaxation, wall_s=alike["wall_s"].where(solved, np.inf))
    return alike.pivot_table("wall_s", "pair", TASK, aggfunc="min")


def ratios_to_quickest(times):
    """Times over the least of each task's; inf: failed, also where all do; NaN: not tried."""
    least = times.min()
    return times.div(least.where(np.isfinite(least), 1), axis=1)


def kinds_of(runs):
    """The scenes of each kind, in their order."""
    kinds = {"no contact": [], "bodies in contact": [], **{scene: [] for scene in DEFORMED}}
    for scene, rows in runs.groupby("scene", sort=False):
        touches = rows["friction"].ne("none").any()
        kinds[scene if scene in DEFORMED else "bodies in contact" if touches else "no contact"].append(scene)
    return {kind: scenes for kind, scenes in kinds.items() if scenes}


@figure("trajectories", "default", table="runs")
def default_beside_pairs(runs):
    """Dolan and More's performance profiles of pairs, a panel a kind of scene: those that were given all its tasks."""
    ratios = ratios_to_quickest(pair_times(runs))
    if DEFAULT not in ratios.index:
        return None
    kinds = kinds_of(runs)
    others = (1 / ratios.drop(index=DEFAULT)).sum(axis=1).sort_values(ascending=False, kind="stable").index
    looks = {DEFAULT: {"color": BLACK, "linewidth": 2.2}}
    looks |= {name: {"color": FALLBACK[k][0], "linestyle": FALLBACK[k][2]} for k, name in enumerate(others[:MOST_OTHERS])}
    chart, axes = panels(len(kinds), columns=4, sharey=True, height=2.3)
    for ax, (kind, scenes) in zip(axes, kinds.items()):
        given = ratios[scenes].dropna(how="any")
        given = given.loc[[name for name in looks if name in given.index]]
        end = 2 * np.max(given.to_numpy(), initial=5, where=np.isfinite(given.to_numpy()))
        for name in given.index:
            profile_line(ax, given.loc[name].to_numpy(), given.shape[1], end, label=name, **looks[name])
        ax.set(xscale="log", title=f"{scene_text(kind)} ({given.shape[1]})", ylim=(-0.03, 1.03))
    chart.supxlabel("time over the least of all pairs", fontsize=8)
    chart.supylabel("share of tasks solved", fontsize=8)
    shared_legend(chart, axes, columns=3)
    own = ratios.loc[DEFAULT]
    solved, tasks = np.isfinite(own).sum(), len(own)
    finding(chart, f"The default, {DEFAULT}, solves {share(solved, tasks)} tasks, {slowness(own)}", better(ratios))
    footnote(chart, "In brackets: how many tasks. A task: a scene's motion by implicit Euler and Coulomb's law with one step, each step solved "
             "to one tolerance. What fails takes for ever. Not drawn: slower pairs, and in a panel those that were not given all its tasks.")
    return chart


def slowness(own):
    """How much longer than the quickest pair the default takes."""
    finite = own[np.isfinite(own)]
    if finite.empty:
        return "and none within any time"
    return (f"in {number(finite.median(), 2)} times the least time of all pairs (median), at most {number(finite.max(), 2)} times "
            f"({scene_text(finite.idxmax()[0])})")


def better(ratios):
    """Which pairs beat the default on what both were given: by tasks solved, or by median time where both solve all."""
    found = []
    for name in ratios.index.drop(DEFAULT):
        both = ratios.loc[[DEFAULT, name]].dropna(axis=1)
        solved = np.isfinite(both).sum(axis=1)
        if solved[name] > solved[DEFAULT]:
            found.append(f"{name} solves {solved[name] - solved[DEFAULT]} more")
        elif solved[name] == solved[DEFAULT] > 0:
            gain = (both.loc[DEFAULT] / both.loc[name])[np.isfinite(both).all()].median()
            if gain > 1.1:
                found.append(f"{name} solves as many, {number(gain, 2)} times as fast")
    return f"What beats it where both were tried: {joined(found)}" if found else "No pair solves as many and is a tenth faster"
