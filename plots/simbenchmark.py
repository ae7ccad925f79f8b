"""How accurate and how fast is contact, beside five engines' published figures?"""

import numpy as np

from common import curve_points, figure, footnote, on_log, panels, shared_legend
from finding import finding
from styles import BLACK, BLUE, GREEN, ORANGE, PURPLE, RED
from selecting import good, reasons_note
from wording import counted, share, some, span

OURS = "pbdcheck"
LOOKS = {OURS: (BLUE, "o", "-"), "RaiSim": (ORANGE, "s", ":"), "Bullet": (RED, "^", ":"),
         "ODE": (GREEN, "D", ":"), "DART": (PURPLE, "v", ":"), "MuJoCo": (BLACK, "X", ":")}
UNITS = {"rolling_xy": "velocity error² (m²/s²)", "rolling_y": "velocity error² (m²/s²)",
         "bouncing": "energy error² (J²)", "666": "overlap² (m²)", "elastic_666": "energy error² (J²)"}


def look(solver):
    """Of an engine, whatever solver of it was measured."""
    color, marker, line = LOOKS[solver.split()[0]]
    return {"color": color, "marker": marker, "linestyle": line, "markerfacecolor": "none"}


def best(frame, column):
    """The engine with the least of a column in each benchmark and step that ours and others were run at; where ours did not end
    well, it is another."""
    found = []
    for (name, step), runs in frame.groupby(["benchmark", "step_s"], sort=False):
        rows = good(runs, column)
        if OURS in set(runs["solver"]) and (rows["solver"] != OURS).any():
            found.append((name, step, rows.loc[rows[column].idxmin(), "solver"].split()[0]))
    return found


def beaten(found):
    """'4 of 5 benchmarks', and where not."""
    lost = [f"{name} at {step:g} s ({winner})" for name, step, winner in found if winner != OURS]
    return share(sum(winner == OURS for _, _, winner in found), len(found)) + " pairs of benchmark and step" + \
        (f"; not: {some(lost)}" if lost else "")


@figure("simbenchmark", "accuracy", table="accuracy")
def accuracy(frame):
    """Error over the step, one panel a benchmark."""
    names = [name for name in UNITS if name in set(frame["benchmark"])]
    fig, axes = panels(len(names), columns=3, height=2.0)
    for ax, name in zip(axes, names):
        for solver, rows in frame[frame["benchmark"] == name].groupby("solver", sort=False):
            curve_points(ax, rows, "step_s", "error", solver.split()[0], look(solver))
        ax.set(xscale="log", yscale="log", title=name, xlabel="step (s)", ylabel=UNITS[name])
    shared_legend(fig, axes, columns=6)
    finding(fig, f"{OURS} has the least error in " + beaten(best(frame, "error")))
    footnote(fig, reasons_note(frame[frame["status"] != "ok"]))
    return fig


@figure("simbenchmark", "cost", table="accuracy")
def cost(frame):
    """Time of the run, a row a benchmark, at the steps whose times were published; engines by those times."""
    frame = frame.assign(seconds=frame["wall_s"].where(frame["solver"] == OURS, frame["cpu_s"]))
    published = frame[(frame["solver"] != OURS) & frame["seconds"].notna()]
    same = frame.merge(published[["benchmark", "step_s"]].drop_duplicates(), on=["benchmark", "step_s"])
    names = [name for name in UNITS if name in set(same["benchmark"])]
    if not names:
        return None
    fig, (ax,) = panels(1, height=0.3 * len(names) + 0.6)
    for engine, rows in same.groupby(same["solver"].str.split().str[0], sort=False):
        rows = rows[rows["benchmark"].isin(names)]
        there = good(rows, "seconds")
        ax.plot(on_log(there["seconds"]), [names.index(name) for name in there["benchmark"]], label=engine,
                **look(engine) | {"linestyle": "none", "markersize": 5})
    ours = set(good(same[same["solver"] == OURS], "seconds")["benchmark"])
    for place, name in enumerate(names):
        if name not in ours:
            ax.text(1.02, place, f"no {OURS} at this step", transform=ax.get_yaxis_transform(), va="center", fontsize=6.5, color=RED)
    steps = same.groupby("benchmark")["step_s"].first()
    ax.set_yticks(range(len(names)), [f"{name}, h = {steps[name]:g} s" for name in names])
    ax.set(xscale="log", xlabel="time of the run (s)", ylim=(len(names) - 0.5, -0.5))
    shared_legend(fig, [ax], columns=6)
    quickest = best(same, "seconds")
    ratios = [slower(same[same["benchmark"] == name]) for name, _, _ in quickest]
    finding(fig, f"{OURS} is the quickest in {beaten(quickest)}" +
            (f"; it takes {span(ratios)} times as long as the quickest engine" if np.isfinite(ratios).any() else ""))
    footnote(fig, "Engines: times as published, on another machine. In the table: "
             f"{counted(len(frame) - len(same), 'run')} at steps without a published time. " + reasons_note(same[same["status"] != "ok"]))
    return fig


def slower(rows):
    """Our time over the least of the engines'."""
    shown = good(rows, "seconds")
    ours = shown["solver"] == OURS
    return shown["seconds"][ours].min() / shown["seconds"][~ours].min()
