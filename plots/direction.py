"""What do the directions of constraints do to stability, constraints and energy, beside velocity time stepping?"""

import numpy as np

from common import curve_points, draw_failed, figure, footnote, on_log, panels, shared_legend
from finding import fewer, finding
from styles import BLACK, BLUE, GREEN, ORANGE, PURPLE, RED, SKY
from selecting import failed, good, reasons_note, step_text
from wording import counted, joined, number, share

GREY = "#777777"
BLENDS = {0: (RED, "o"), 0.25: (ORANGE, "s"), 0.5: (GREEN, "^"), 0.75: (SKY, "D"), 1: (BLUE, "v")}
SHARES = {0: (BLACK, "P", ":"), 0.2: (GREY, "p", "--"), 1: (PURPLE, "*", "-.")}
TWIN = "symplectic_euler"  # has the numbers of a blend of 0 where all is hard


def look_of(row):
    """Label and look of a scheme: the blend of `position`, the stabilisation of `velocity`."""
    if row["family"] == "velocity":
        color, marker, line = SHARES.get(row["stabilisation"], (BLACK, ".", ":"))
        return f"velocity, stabilised {row['stabilisation']:g}", {"color": color, "marker": marker, "linestyle": line}
    color, marker = BLENDS.get(row["direction_blend"], (BLACK, "o"))
    name = "symplectic_euler" if row["integrator"] == TWIN else f"b = {row['direction_blend']:g}"
    return name, {"color": color, "marker": marker, "linestyle": "--" if row["integrator"] == TWIN else "-"}


def schemes(frame):
    """(label, look, rows) of every scheme."""
    keys = ["family", "integrator", "outer", "direction_blend", "stabilisation"]
    for _, rows in frame.groupby(keys, sort=False, dropna=False):
        yield (*look_of(rows.iloc[0]), rows)


OUTERS = {"proximal": ("o", "white"), "auto": ("D", "white"), "frozen": ("s", BLACK)}  # marks, and what fills them


@figure("direction", "largest_steps", table="largest_steps")
def largest_steps(frame):
    """One panel a scene, one line a scheme: the largest stable step by each outer iteration, and the predicted one as a bar. A
    red cross where steps were not solved."""
    groups, left = fewer(frame.groupby("scene", sort=False))
    if not groups:
        return None
    names = list(dict.fromkeys(label for label, _, _ in schemes(frame)))
    fig, axes = panels(len(groups), columns=2, height=0.17 * len(names) + 0.5, sharey=True, sharex=True)
    for ax, (scene, rows) in zip(axes, groups):
        for outer, here in rows.groupby("outer", sort=False):
            marker, fill = OUTERS.get(outer, ("o", "white"))
            stable = good(here, "largest_step_s")
            color = BLACK if outer == "frozen" else BLUE
            ax.plot(stable["largest_step_s"], places(stable, names), marker, color=color, markerfacecolor=fill, markersize=4.5,
                    label=f"{'velocity' if outer == 'frozen' else 'position'}, {outer}")
            missed = failed(here, "largest_step_s")
            ax.plot(missed["largest_step_s"].clip(lower=1e-3), places(missed, names), "x", color=RED,
                    label="steps not solved" if len(missed) else "_")
        known = rows[(rows["predicted_step_s"] > 0) & (rows["predicted_step_s"] < np.inf)]
        ax.plot(known["predicted_step_s"], places(known, names), "|", color=BLACK, markersize=11, label="predicted")
        ax.set(xscale="log", xlim=(1e-3, 1), title=scene)
        ax.set_yticks(range(len(names)), names)
        ax.set_ylim(len(names) - 0.5, -0.5)
    fig.supxlabel("largest stable step (s)", fontsize=8)
    shared_legend(fig, axes, columns=5)
    finding(fig, "Velocity stepping is stable up to these shares of the largest step of b = 1: " +
            steps_compared(frame) if steps_compared(frame) else f"No step is stable and solved in {counted(len(frame), 'run')} of both")
    footnote(fig, left + reasons_note(failed(frame, "largest_step_s")))
    return fig


def places(rows, names):
    return [names.index(look_of(row)[0]) for _, row in rows.iterrows()]


def steps_compared(frame):
    """Of each scene the largest step of velocity stepping over the largest with a blend of 1."""
    stable = good(frame, "largest_step_s")
    said = []
    for scene, rows in stable.groupby("scene", sort=False):
        ended = rows[(rows["family"] == "position") & (rows["direction_blend"] == 1)]["largest_step_s"].max()
        velocity = rows[rows["family"] == "velocity"]["largest_step_s"].max()
        if np.isfinite(ended) and np.isfinite(velocity):
            said.append(f"{scene} {number(velocity / ended, 2)}")
    return ", ".join(said)


@figure("direction", "modes", table="modes")
def modes(frame):
    """What a step leaves of a mode's energy over the blend, measured and predicted."""
    fig, (ax,) = panels(1, height=2.3)
    blends = np.linspace(0, 1, 50)
    ax.plot(blends, 1 / (1 + blends), color=BLACK, linewidth=0.8, label="1/(1 + b), predicted")
    position = frame[frame["family"] == "position"]
    for (mode, rows), (color, marker) in zip(position.groupby("mode"), BLENDS.values()):
        points = good(rows, "measured_left")
        ax.plot(points["direction_blend"], points["measured_left"], color=color, marker=marker, linestyle="none",
                markerfacecolor="none", markersize=3 + 2 * list(BLENDS.values()).index((color, marker)), label=f"mode {mode:g}")
        bad = failed(rows, "measured_left")
        draw_failed(ax, bad.assign(direction_blend=bad["direction_blend"].clip(lower=1e-3)), "direction_blend", "measured_left",
                    {"color": color, "marker": marker})
    ax.set(xlabel="blend b of directions (0: begin of the step, 1: end)", ylabel="energy left by a step at h w = 1",
           ylim=(0, 1.1))
    shared_legend(fig, [ax])
    shown = good(position, "measured_left")
    off = abs(shown["measured_left"] / shown["predicted_left"] - 1)
    finding(fig, f"A step at h w = 1 leaves 1/(1 + b) of a mode's energy, to {number(off.max())} of it in "
            f"{share(len(shown), len(position))} runs" if len(shown) else f"None of {counted(len(position), 'run')} ended well")
    footnote(fig, reasons_note(failed(position, "measured_left")))
    return fig


DRAWN = {("position", 0), ("position", 0.5), ("position", 1), ("velocity", 0), ("velocity", 0.2), ("velocity", 1)}


def drawn(frame):
    """The schemes that get a line; the blends between them are in the table."""
    number_of = frame["direction_blend"].where(frame["family"] == "position", frame["stabilisation"])
    chosen = [pair in DRAWN for pair in zip(frame["family"], number_of)]
    return frame[chosen & (frame["integrator"] != TWIN)]


@figure("direction", "energy", table="energy")
def energy(frame):
    """The pendulum's energy over time: all schemes, and those that keep it."""
    fig, axes = panels(2, columns=2, height=2.4)
    lost = {}
    for label, look, rows in schemes(drawn(frame)):
        rows = rows.sort_values("time_s")
        for ax in axes:
            ax.plot(rows["time_s"], rows["energy_j"], label=label, markevery=max(1, len(rows) // 8),
                    **{"markerfacecolor": "white"} | look)
        if rows["status"].eq("ok").all():
            lost[label] = rows["energy_j"].iloc[-1] - rows["energy_j"].iloc[0]
        draw_failed(axes[0], failed(rows, "time_s").tail(1), "time_s", "energy_j",
                    {"color": look["color"], "marker": look["marker"]})
    axes[0].set(ylabel="energy (J); m g l = 9.81 J", title="all")
    axes[1].set(ylim=(-0.5, 0.5), title="those that keep it")
    fig.supxlabel(f"time (s), steps of {step_text(frame['step_s'].iloc[0])}", fontsize=8)
    shared_legend(fig, axes)
    finding(fig, "Change of the pendulum's energy at the end (J): " + ", ".join(f"{name} {change:.2g}" for name, change in lost.items())
            if lost else f"None of {counted(len(list(schemes(frame))), 'scheme')} ended well")
    footnote(fig, reasons_note(failed(frame, "time_s")))
    return fig


@figure("direction", "equal_work", table="equal_work")
def equal_work(frame):
    """Largest violation over row updates a simulated second, one panel a scene; how many runs were solved is told, what was
    not is in the table."""
    groups, left = fewer(frame.groupby("scene", sort=False))
    if not groups:
        return None
    fig, axes = panels(len(groups), columns=2, height=2.0, sharey=True)
    for ax, (scene, rows) in zip(axes, groups):
        for label, look, points in schemes(drawn(rows)):
            solved = good(points, "row_updates_per_s", "error").sort_values("row_updates_per_s")
            ax.plot(solved["row_updates_per_s"], on_log(solved["error"]), label=label, **{"markerfacecolor": "white"} | look)
        ax.set(xscale="log", yscale="log")
        ax.set_title(f"{scene}; solved: {solved_of(rows, 'position')}, {solved_of(rows, 'velocity')}", fontsize=7)
    fig.supxlabel("row updates a simulated second", fontsize=8)
    fig.supylabel("largest violation, of a link's length", fontsize=8)
    shared_legend(fig, axes, columns=6)
    worst = min((rows for _, rows in groups), key=lambda rows: solved_share(rows, "position") - solved_share(rows, "velocity"))
    finding(fig, f"At equal work are solved: {solved_of(frame, 'position')}, {solved_of(frame, 'velocity')} runs; on "
            f"{worst['scene'].iloc[0]}: {solved_of(worst, 'position')}, {solved_of(worst, 'velocity')}")
    footnote(fig, "Solved runs alone are drawn. " + left + reasons_note(failed(frame, "row_updates_per_s", "error")))
    return fig


def solved_of(frame, family):
    rows = frame[frame["family"] == family]
    return f"{family} {share(len(good(rows, 'row_updates_per_s', 'error')), len(rows))}"


def solved_share(frame, family):
    rows = frame[frame["family"] == family]
    return len(good(rows, "row_updates_per_s", "error")) / max(1, len(rows))


CONTENDERS = {("velocity", "frozen"): ("directions of the step's begin", BLACK, "P"), ("position", "plain"): ("refreshed directions", RED, "o"),
              ("stiffness, one linearisation", "proximal"): ("stiffness in M, one linearisation", ORANGE, "s"),
              ("stiffness", "proximal"): ("stiffness in M, solved", GREEN, "^")}


def contender(family, outer):
    """Label, colour and marker."""
    return CONTENDERS.get((family, outer), (f"{family}, {outer}", BLACK, "o"))


@figure("direction", "contenders", table="contenders")
def contenders(frame):
    """The taut chain's largest energy, and the share of steps that miss, over the step in units of the explicit limit."""
    fig, (energy, missed) = panels(2, columns=2, height=2.6, sharex=True)
    frame = frame.assign(missed_share=frame["missed_steps"] / frame["steps"])
    for key, rows in frame.groupby(["family", "outer"], sort=False):
        label, color, marker = contender(*key)
        look = {"color": color, "marker": marker, "linestyle": "-"}
        curve_points(energy, rows.assign(status=rows["status"].replace("not_converged", "ok")), "of_explicit_limit", "energy_highest", label, look)
        rows = rows.sort_values("of_explicit_limit")
        if key[1] != "frozen":
            missed.plot(rows["of_explicit_limit"], rows["missed_share"], label=label, markerfacecolor="white", **look)
    energy.set(xscale="log", yscale="log", ylabel="largest energy over the first one")
    missed.set(xscale="log", ylim=(-0.05, 1.05), ylabel="share of steps that miss their tolerance")
    for ax in (energy, missed):
        ax.axvline(1, color=BLACK, linestyle="--", linewidth=0.6)
    fig.supxlabel("step over the explicit limit", fontsize=8)
    shared_legend(fig, [energy, missed], columns=2)
    finding(fig, "Stable, and solved where that is claimed, up to these parts of the explicit limit of step: " + ", ".join(
        f"{contender(*key)[0]} {number(steady_step(rows))}" for key, rows in frame.groupby(["family", "outer"], sort=False)))
    footnote(fig, reasons_note(frame[frame["status"] == "diverged"]))
    return fig


def steady_step(rows):
    """The longest step, in units s of the explicit limit, up to which every run is stable and solved; what freezes directions does not
    claim to solve its steps. The energy of a stable explicit scheme moves within (1 + s)/(1 - s) of itself; beyond the limit
    none is gained."""
    rows = rows.sort_values("of_explicit_limit")
    part = rows["of_explicit_limit"]
    bound = ((1 + part) / (1 - part)).where(part < 1, 1.01)
    steady = (rows["status"] == "ok") & (rows["energy_highest"] <= bound) & ((rows["missed_steps"] == 0) | (rows["outer"] == "frozen"))
    return rows.loc[steady.cummin(), "of_explicit_limit"].max() if steady.iloc[0] else 0.0


@figure("direction", "contact", table="contact")
def contact(frame):
    """Largest overlap or stretch over work, a panel a scene, a line a scheme."""
    groups = list(frame.groupby("scene", sort=False))
    fig, axes = panels(len(groups), columns=3, height=2.4)
    for ax, (scene, rows) in zip(axes, groups):
        for label, look, one in schemes(rows):
            label = label if one["family"].iloc[0] == "velocity" else "refreshed directions"
            curve_points(ax, one, "row_updates_per_s", "error", label, look)
        ax.set(xscale="log", yscale="log", title=scene)
    fig.supxlabel("row updates a simulated second", fontsize=8)
    axes[0].set_ylabel("largest violation, relative")
    shared_legend(fig, axes)
    most = most_work(frame)
    finding(fig, "With the most row updates of each scene and scheme the largest violation is " + "; ".join(
        f"{number(errors.min())} to {number(errors.max())} by {family} steps" for family, errors in most.items())
        if len(most) else f"No run of {len(frame)} came through")
    apart = [scene for scene, rows in groups if not overlaps(rows)]
    footnote(fig, (f"Both families have no work in common on {joined(apart)}: nothing is compared there. " if apart else "")
             + reasons_note(failed(frame, "error")))
    return fig


def most_work(frame):
    """By family, the violations of the runs with the most row updates, one a scene and scheme."""
    runs = good(frame, "error", "row_updates_per_s")
    keys = ["scene", "family", "direction_blend", "stabilisation"]
    last = runs.sort_values("row_updates_per_s").groupby(keys, sort=False, dropna=False).tail(1)
    return {family: rows["error"] for family, rows in last.groupby("family", sort=False)}


def overlaps(rows):
    """Whether the ranges of work of both families have some in common."""
    runs = good(rows, "error", "row_updates_per_s")
    position, velocity = (runs.loc[runs["family"] == family, "row_updates_per_s"] for family in ("position", "velocity"))
    return max(position.min(), velocity.min()) <= min(position.max(), velocity.max())
