"""What do the integrators do to energy and momentum, and where do they blow up?"""

import matplotlib.pyplot as plt
import numpy as np

from common import draw_failed, figure, footnote, on_log, panels, shared_legend, slope_triangle, trace
from finding import MOST_SERIES, fewer, finding
from styles import BLACK, BLUE, GREEN, ORANGE, RED, style
from reading import LARGEST
from selecting import drawable, failed, good, reasons_note, rule_names, step_text, text_number
from wording import counted, number, share, some

RUN = ["scene", "step_s", "rule"]
DRAWN = ("implicit_euler", "newmark 0.5", "newmark 0.55", "generalised_alpha", "bdf2", "midpoint", "symplectic_euler")


def runs(frame):
    """The traces by scene, at the largest step."""
    named = frame.assign(rule=rule_names(frame))
    return list(named[named["step_s"] == named["step_s"].max()].groupby("scene", sort=False))


def drawn(rules):
    """The rules that get a line, those of DRAWN first, and a sentence on the others."""
    rules = list(dict.fromkeys(rules))
    kept = sorted(rules, key=lambda rule: DRAWN.index(rule) if rule in DRAWN else len(DRAWN))[:MOST_SERIES]
    others = [rule for rule in rules if rule not in kept]
    return kept, f"In the table alone: {', '.join(others)}. " if others else ""


def last_rows(frame):
    return frame.assign(rule=rule_names(frame)).groupby(RUN, sort=False).tail(1)


@figure("energy", "series", table="series")
def series(frame):
    """Energy over time, one panel a scene."""
    scenes, left = fewer(runs(frame))
    kept, others = drawn(rule_names(frame))
    fig, axes = panels(len(scenes), columns=3, height=1.9, sharex=True)
    for ax, (scene, here) in zip(axes, scenes):
        here = here[here["rule"].isin(kept)]
        changes = {name: ((rows["energy_j"] - rows["energy_j"].iloc[0]) / rows["scale_j"]).to_numpy()
                   for name, rows in here.groupby("rule", sort=False)}
        well = [c for name, c in changes.items() if (here.loc[here["rule"] == name, "status"] == "ok").all()] or [np.zeros(1)]
        lowest, highest = min(c.min() for c in well), max(c.max() for c in well)
        margin = 0.1 * max(highest - lowest, 1e-3)
        low, high = lowest - margin, highest + 2 * margin
        for name, rows in here.groupby("rule", sort=False):
            trace(ax, rows, changes[name], name, low, high)
        ax.set(title=scene, ylim=(low, high))
    fig.supxlabel(f"time (s), in steps of {step_text(frame['step_s'].max())}", fontsize=8)
    fig.supylabel("change of the energy, of its scale", fontsize=8)
    shared_legend(fig, axes, columns=4)
    ends = last_rows(frame[frame["step_s"] == frame["step_s"].max()])
    bad = ends[ends["status"] != "ok"]
    blown = bad["rule"] + " on " + bad["scene"]
    finding(fig, f"{share(len(ends) - len(bad), len(ends))} runs end well at {step_text(frame['step_s'].max())}" +
            (f"; not {some(blown)}" if len(bad) else ""))
    footnote(fig, left + others + reasons_note(failed(last_rows(frame), "time_s")))
    return fig


@figure("energy", "free_momentum", table="series")
def free_momentum(frame):
    """Linear and angular momentum of the free body over time."""
    free = [(scene, here) for scene, here in runs(frame) if scene.startswith("free")]
    if not free:
        return None
    fig, axes = panels(2, columns=2, height=2.2)
    scene, here = free[0]
    kept, others = drawn(here["rule"])
    changes = {}
    for ax, column, title in ((axes[0], "momentum_kg_m_s", "linear"), (axes[1], "angular_momentum_kg_m2_s", "angular")):
        for name, rows in here[here["rule"].isin(kept)].groupby("rule", sort=False):
            change = (rows[column] / rows[column].iloc[0] - 1).to_numpy()
            trace(ax, rows, change, name, -1, 1)
            changes.setdefault(title, {})[name] = np.abs(change).max()
        ax.set(xlabel="time (s)", title=f"{title} momentum, {scene}")
    axes[0].set_ylabel("relative change")
    shared_legend(fig, axes, columns=4)
    ends = here.groupby("rule", sort=False).tail(1)
    well = set(ends[ends["status"] == "ok"]["rule"])
    linear, angular = ({name: value for name, value in changes[title].items() if name in well} for title in ("linear", "angular"))
    finding(fig, f"Linear momentum changes by at most {number(max(linear.values()))} of it, angular momentum by up to "
            f"{number(max(angular.values()))}, by {max(angular, key=angular.get)}; "
            f"{share(len(linear), len(changes['linear']))} runs end well" if linear else
            f"None of {counted(len(ends), 'run')} ended well")
    footnote(fig, others + reasons_note(failed(last_rows(here), "time_s")))
    return fig


@figure("energy", "drift", table="drift")
def drift(frame):
    """Largest error of the energy over the step."""
    fig, (ax,) = panels(1, height=2.4)
    for (scene, name), rows in frame.assign(rule=rule_names(frame)).groupby(["scene", "rule"], sort=False):
        look = style(name) | {"marker": "o" if scene == frame["scene"].iloc[0] else "s"}
        shown = good(rows, "step_s", "drift").sort_values("step_s")
        ax.plot(shown["step_s"], on_log(shown["drift"]), markerfacecolor="white",
                label=f"{scene.replace('_', ' ')}, {name}", **look)
        draw_failed(ax, failed(rows, "step_s", "drift"), "step_s", "drift", look)
    ok = good(frame, "step_s", "drift")
    if len(ok):
        lowest = ok.loc[ok["drift"].idxmin()]
        slope_triangle(ax, 1.6 * lowest["step_s"], 0.8 * lowest["drift"], 2, BLACK)
    ax.set(xscale="log", yscale="log", xlabel="step (s)", ylabel="largest change of the energy in 10 s,\nof its scale")
    shared_legend(fig, [ax], columns=2)
    ratios = ok["ratio"].dropna()
    finding(fig, f"Halving the step divides the drift of the energy by {number(ratios.min())} to {number(ratios.max())}; order 2 "
            "divides it by 4" if len(ratios) else f"{share(len(ok), len(frame))} runs have a drift of the energy to compare")
    footnote(fig, reasons_note(failed(frame, "drift")))
    return fig


@figure("energy", "momentum", table="momentum")
def momentum(frame):
    """Largest changes of momentum, one panel a body, one line an integrator."""
    named = frame.assign(rule=rule_names(frame))
    rules = list(named["rule"].unique())[::-1]
    bodies, left = fewer(named.groupby("scene", sort=False))
    fig, axes = panels(len(bodies), columns=2, height=2.0, sharex=True, sharey=True)
    kinds = (("linear, solved or not", "linear_error", None, BLUE, "o"),
             ("angular, stopped early", "angular_error", False, ORANGE, "s"),
             ("angular, solved", "angular_error", True, RED, "D"),
             ("the part of it that is not derived", "angular_unexplained", True, GREEN, "^"))
    for ax, (body, here) in zip(axes, bodies):
        for label, column, solved, color, marker in kinds:
            chosen = here if solved is None else here[(here["max_outer"] > 1) == solved]
            worst = chosen[chosen[column] <= LARGEST].groupby("rule")[column].max()
            ax.plot(on_log(worst.to_numpy()), [rules.index(name) for name in worst.index], marker, color=color, label=label,
                    markerfacecolor="white")
            lost = chosen[chosen["status"] == "diverged"]["rule"].unique()
            if solved is False:
                for name in lost:
                    ax.plot([1.02], [rules.index(name)], "x", color=BLACK, transform=ax.get_yaxis_transform(), clip_on=False,
                            label="a run that is stopped early diverges")
        ax.set(xscale="log", title=body)
        ax.set_yticks(range(len(rules)), rules)
    fig.supxlabel("largest relative change in 1000 steps", fontsize=8)
    shared_legend(fig, axes, columns=3)
    known = named[drawable(named, ["linear_error"])]
    kept = good(named[named["max_outer"] > 1], "angular_error")
    finding(fig, f"Linear momentum is kept to {number(known['linear_error'].max())} in {share(len(known), len(named))} runs" if
            len(known) else f"None of {counted(len(named), 'run')} has a momentum to compare",
            f"Angular momentum changes by up to {number(kept['angular_error'].max())} where every step is solved" if len(kept) else "")
    footnote(fig, left + reasons_note(failed(named[named["status"] == "diverged"], "linear_error")))
    return fig


def compliance_text(value):
    return "hard" if value == 0 else text_number(value)


@figure("energy", "blow_up", table="map")
def blow_up(frame):
    """Predicted growth of a disturbance in colour, a cross where the simulation blows up; one panel a step."""
    steps, left = fewer(frame.groupby("step_s", sort=False))
    fig, axes = panels(len(steps), columns=min(4, len(steps)), height=2.0, sharex=True, sharey=True)
    for ax, (step, rows) in zip(axes, steps):
        rate = rows.assign(rate=np.log(rows["predicted_growth"]) / step).pivot_table(
            "rate", "compliance_m_per_n", "alpha", dropna=False)
        mesh = ax.pcolormesh(np.arange(rate.shape[1] + 1), np.arange(rate.shape[0] + 1), rate.to_numpy(),
                             cmap="PuOr_r", vmin=-5, vmax=5)
        for _, row in rows[rows["status"] != "ok"].iterrows():
            column, line = rate.columns.get_loc(row["alpha"]), rate.index.get_loc(row["compliance_m_per_n"])
            ax.plot([column + 0.5], [line + 0.5], "x", color=BLACK)
        ax.set_xticks(np.arange(rate.shape[1]) + 0.5, [f"{alpha:g}" for alpha in rate.columns], rotation=90)
        ax.set_yticks(np.arange(rate.shape[0]) + 0.5, [compliance_text(value) for value in rate.index])
        ax.grid(False)
        ax.set_title(step_text(step))
    fig.supxlabel("alpha", fontsize=8)
    fig.supylabel("compliance (m/N)", fontsize=8)
    fig.colorbar(mesh, ax=axes, label="predicted growth rate (1/s)", extend="both")
    fig.legend([plt.Line2D([], [], color=BLACK, marker="x", linestyle="")], ["the simulation blows up"], loc="upper center",
               bbox_to_anchor=(0.5, 0))
    grows, blows = frame["predicted_growth"] > 1, frame["status"] != "ok"
    finding(fig, f"{share((grows & blows).sum(), blows.sum())} simulations that blow up are predicted to grow, and "
            f"{share((grows & ~blows).sum(), (~blows).sum())} of those that do not")
    footnote(fig, left + reasons_note(failed(frame, "energy_factor")))
    return fig


@figure("energy", "frontier", table="frontier")
def frontier(frame):
    """Smallest safe alpha over the step: predicted as lines, the smallest one of the map as marks."""
    fig, (ax,) = panels(1, height=2.5)
    values = sorted(frame["compliance_m_per_n"].unique())
    values = [values[k] for k in sorted({round(k) for k in np.linspace(0, len(values) - 1, min(5, len(values)))})]
    colors = plt.get_cmap("viridis")(np.linspace(0, 0.9, len(values)))
    for value, color, marker in zip(values, colors, "osD^vPX*hd"):
        rows = frame[frame["compliance_m_per_n"] == value].sort_values("step_s")
        ax.plot(rows["step_s"], rows["predicted_alpha"], color=color, linewidth=0.9)
        ax.plot(rows["step_s"], rows["safe_alpha"], marker, color=color, markerfacecolor="none", label=compliance_text(value))
    ax.set(xscale="log", xlabel="step", ylabel="smallest safe alpha")
    steps = sorted(frame["step_s"].unique())
    ax.set_xticks(steps, [step_text(step) for step in steps])
    ax.minorticks_off()
    fig.legend(loc="upper center", bbox_to_anchor=(0.5, 0), ncol=5, title="compliance (m/N); line: predicted")
    off = abs(frame["safe_alpha"] - frame["predicted_alpha"])
    finding(fig, f"The smallest alpha that stays bounded is the predicted one to {number(off.max())} in "
            f"{share(off.notna().sum(), len(frame))} cases")
    footnote(fig, f"In the table: all {counted(frame['compliance_m_per_n'].nunique(), 'value')} of the compliance.")
    return fig
