"""Are contact problems with friction solved whose answer was planted?"""

import numpy as np

from common import curve_points, figure, footnote, panels, shared_legend
from styles import style
from selecting import drawable, failed, text_number, tightest

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


@figure("cone_problems", "profiles", table="solves")
def profiles(frame):
    """The share of problems solved within a multiple of the fastest time, a panel a law and tolerance."""
    groups = [(law, tolerance, rows) for law, rows in frame.groupby("law", sort=False) for tolerance in TOLERANCES]
    fig, axes = panels(len(groups), columns=2, height=2.0, sharey=True)
    for ax, (law, tolerance, rows) in zip(axes, groups):
        drawn = performance(rows, tolerance)
        finite = [ratios[np.isfinite(ratios)] for ratios in drawn.values()]
        end = 1.5 * max([10.0, *(ratios[-1] for ratios in finite if len(ratios))])
        for name, ratios in drawn.items():
            share = np.arange(1, len(ratios) + 1) / len(ratios)
            inside = np.isfinite(ratios)
            x = np.concatenate([[1], ratios[inside], [end]])
            y = np.concatenate([[0], share[inside], [inside.sum() / len(ratios)]])
            look = style(name) | {"marker": "none"}
            ax.plot(x, y, drawstyle="steps-post", label=name, **look)
        ax.set(xscale="log", xlim=(1, end), ylim=(-0.02, 1.05), title=f"law {law}, residual {text_number(tolerance)}")
    fig.supxlabel("time over that of the fastest", fontsize=8)
    fig.supylabel("share of problems solved", fontsize=8)
    shared_legend(fig, axes)
    partly = sorted(set(frame["relaxation"]) - set.intersection(*[set(performance(rows, 1)) for _, _, rows in groups]))
    footnote(fig, f"Left out where it was not given every problem: {', '.join(partly)}." if partly else "")
    return fig


@figure("cone_problems", "large", table="large")
def large(frame):
    """Seconds to the smallest tolerance over the number of contacts, a panel a law and family, a marker a problem."""
    groups = list(tightest(frame).groupby(["law", "family"], sort=False))
    fig, axes = panels(len(groups), columns=2, height=2.0, sharex=True, sharey=True)
    for ax, ((law, family), rows) in zip(axes, groups):
        for name, solves in rows.groupby("relaxation", sort=False):
            curve_points(ax, solves, "contacts", "wall_s", name, style(name) | {"linestyle": "none"})
        ax.set(xscale="log", yscale="log", title=f"law {law}, {family}")
        ax.set_xticks(sorted(set(frame["contacts"])), [f"{n:.0f}" for n in sorted(set(frame["contacts"]))])
        ax.minorticks_off()
    fig.supxlabel("contacts", fontsize=8)
    fig.supylabel("wall time (s)", fontsize=8)
    shared_legend(fig, axes)
    missed = len(failed(tightest(frame), "wall_s"))
    footnote(fig, f"Crossed: {missed} solves that missed their tolerance." if missed else "")
    return fig
