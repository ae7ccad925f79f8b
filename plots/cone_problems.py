"""Are contact problems with friction solved whose answer was planted?"""

import numpy as np

from common import figure, footnote, panels, shared_legend
from finding import MOST_SERIES, fewer, finding
from styles import RELAXATIONS, style
from selecting import drawable, failed, good, text_number, tightest
from wording import counted, joined, number, share

TOLERANCES = (1e-4, 1e-8)


def performance(frame, tolerance):
    """Dolan and More's profile: for each relaxation that was given every problem, the ratios of its times to the fastest's,
    ascending, infinite where none of its solves is within the tolerance."""
    key = ["family", "number"]
    solved = frame[drawable(frame, ["natural_residual", "wall_s"]) & (frame["natural_residual"] <= tolerance)]
    times = solved.pivot_table(index=key, columns="relaxation", values="wall_s", aggfunc="min")
    given = frame.groupby("relaxation", sort=False).apply(lambda rows: len(rows[key].drop_duplicates()))
    problems = frame[key].drop_duplicates()
    complete = [name for name, count in given.items() if count == len(problems)]
    times = times.reindex(index=list(map(tuple, problems.to_numpy())), columns=complete)
    fastest = times.min(axis="columns")
    return {name: np.sort(np.where(times[name].isna(), np.inf, times[name] / fastest)) for name in complete}


def most_solved(frame):
    """At most seven relaxations, the solver's own and of the others those that solve the largest shares, and a sentence on the
    rest."""
    return chosen({name: [part] for name, part in frame["status"].eq("ok").groupby(frame["relaxation"], sort=False).mean().items()})


def chosen(solved):
    """The relaxations that are drawn, by the shares of problems that each one solves, and a sentence on those that are not."""
    ranked = sorted(solved, key=lambda name: (name not in RELAXATIONS, -np.mean(solved[name])))
    others = [f"{name} (solves {min(solved[name]):.0%} to {max(solved[name]):.0%})" for name in ranked[MOST_SERIES:]]
    return ranked[:MOST_SERIES], f"Not drawn: {', '.join(others)}. " if others else ""


@figure("cone_problems", "profiles", table="solves")
def profiles(frame):
    """The share of problems solved within a multiple of the fastest time, a panel a law and tolerance."""
    groups, left = fewer((law, tolerance, rows) for law, rows in frame.groupby("law", sort=False) for tolerance in TOLERANCES)
    if not groups:
        return None
    kept, others = drawn_profiles(groups)
    fig, axes = panels(len(groups), columns=2, height=1.9, sharey=True)
    said = []
    for ax, (law, tolerance, rows) in zip(axes, groups):
        every = performance(rows, tolerance)
        shown = {name: ratios for name, ratios in every.items() if name in kept}
        end = 1.5 * max([10.0, *(ratios[np.isfinite(ratios)].max(initial=1) for ratios in shown.values())])
        for name, ratios in shown.items():
            part = np.arange(1, len(ratios) + 1) / len(ratios)
            inside = np.isfinite(ratios)
            x = np.concatenate([[1], ratios[inside], [end]])
            y = np.concatenate([[0], part[inside], [inside.sum() / len(ratios)]])
            ax.plot(x, y, drawstyle="steps-post", label=name, **style(name) | {"marker": "none"})
        ax.set(xscale="log", xlim=(1, end), ylim=(-0.02, 1.05), title=f"law {law}, residual {text_number(tolerance)}")
        solved = {name: np.isfinite(ratios).mean() for name, ratios in every.items()}
        if solved and tolerance == TOLERANCES[-1]:
            said.append(f"law {law}: {max(solved, key=solved.get)} {max(solved.values()):.0%}, "
                        f"{min(solved, key=solved.get)} {min(solved.values()):.0%}")
    fig.supxlabel("time over that of the fastest", fontsize=8)
    fig.supylabel("share of problems solved", fontsize=8)
    shared_legend(fig, axes)
    finding(fig, f"Most and fewest problems solved to {number(TOLERANCES[-1])} by " + "; ".join(said) if said else
            f"No relaxation was given all of {counted(len(frame[['family', 'number']].drop_duplicates()), 'problem')}")
    partly = sorted(set(frame["relaxation"]) - set.intersection(*[set(performance(rows, 1)) for _, _, rows in groups]))
    footnote(fig, left + others + (f"Left out where it was not given every problem: {', '.join(partly)}." if partly else ""))
    return fig


def drawn_profiles(groups):
    """What `chosen` says of the relaxations of all panels."""
    solved = {}
    for _, tolerance, rows in groups:
        for name, ratios in performance(rows, tolerance).items():
            solved.setdefault(name, []).append(np.isfinite(ratios).mean())
    return chosen(solved)


@figure("cone_problems", "large", table="large")
def large(frame):
    """Seconds to the smallest tolerance over the number of contacts, a panel a law and family: the slowest problem of each size
    that was solved. How many were is told beside the name."""
    frame = tightest(frame)
    groups, left = fewer(frame.groupby(["law", "family"], sort=False))
    if not groups:
        return None
    kept, others = most_solved(frame)
    fig, axes = panels(len(groups), columns=2, height=2.0, sharex=True, sharey=True)
    for ax, ((law, family), rows) in zip(axes, groups):
        for name, solves in rows[rows["relaxation"].isin(kept)].groupby("relaxation", sort=False):
            slowest = good(solves, "wall_s").groupby("contacts")["wall_s"].max()
            ax.plot(slowest.index, slowest, label=name, markerfacecolor="white", **style(name))
        missed = failed(rows, "wall_s")["relaxation"].value_counts()
        ax.text(0.98, 0.98, "\n".join(["missed:"] + [f"{name} {count}" for name, count in missed.items()]) if len(missed) else
                "all solved", transform=ax.transAxes, ha="right", va="top", fontsize=5.5)
        ax.set(xscale="log", yscale="log", xlim=(None, 4 * frame["contacts"].max()))  # with room for the list
        ax.set(title=f"law {law}, {family}: {share(len(rows) - missed.sum(), len(rows))} solved")
        ax.set_xticks(sorted(set(frame["contacts"])), [f"{n:.0f}" for n in sorted(set(frame["contacts"]))])
        ax.minorticks_off()
    fig.supxlabel("contacts", fontsize=8)
    fig.supylabel("wall time (s)", fontsize=8)
    shared_legend(fig, axes)
    ok = frame["status"].eq("ok").groupby(frame["relaxation"], sort=False)
    whole = [name for name, solved in ok.all().items() if solved]
    finding(fig, f"{share(len(good(frame, 'wall_s')), len(frame))} solves of large problems reach their tolerance" +
            (f"; {joined(whole)} miss{'es' if len(whole) == 1 else ''} none" if whole else "; every relaxation misses some"))
    footnote(fig, left + others)
    return fig
