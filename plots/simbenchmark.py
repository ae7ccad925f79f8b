"""How accurate and how fast is contact, beside five engines' published figures?"""

from common import curve_points, figure, footnote, panels, shared_legend
from styles import BLACK, BLUE, GREEN, ORANGE, PURPLE, RED
from selecting import reasons_note

LOOKS = {"pbdcheck": (BLUE, "o", "-"), "RaiSim": (ORANGE, "s", ":"), "Bullet": (RED, "^", ":"),
         "ODE": (GREEN, "D", ":"), "DART": (PURPLE, "v", ":"), "MuJoCo": (BLACK, "X", ":")}
UNITS = {"rolling_xy": "velocity error² (m²/s²)", "rolling_y": "velocity error² (m²/s²)",
         "bouncing": "energy error² (J²)", "666": "overlap² (m²)", "elastic_666": "energy error² (J²)"}


def look(solver):
    """Of an engine, whatever solver of it was measured."""
    color, marker, line = LOOKS[solver.split()[0]]
    return {"color": color, "marker": marker, "linestyle": line, "markerfacecolor": "none"}


def draw(frame, x, label):
    """Error over x, one panel a benchmark."""
    names = [name for name in UNITS if name in set(frame["benchmark"])]
    fig, axes = panels(len(names), columns=3, height=2.2)
    for ax, name in zip(axes, names):
        for solver, rows in frame[frame["benchmark"] == name].groupby("solver", sort=False):
            curve_points(ax, rows, x, "error", solver.split()[0], look(solver))
        ax.set(xscale="log", yscale="log", title=name, xlabel=label, ylabel=UNITS[name])
    shared_legend(fig, axes)
    footnote(fig, reasons_note(frame[frame["status"] != "ok"]))
    return fig


@figure("simbenchmark", "accuracy", table="accuracy")
def accuracy(frame):
    return draw(frame, "step_s", "step (s)")


@figure("simbenchmark", "cost", table="accuracy")
def cost(frame):
    """Engines by the seconds that were published, where they were."""
    frame = frame.assign(seconds=frame["wall_s"].where(frame["solver"] == "pbdcheck", frame["cpu_s"]))
    return draw(frame[frame["seconds"].notna() | (frame["solver"] == "pbdcheck")], "seconds", "time of the run (s)")
