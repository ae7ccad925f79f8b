"""How accurate and how fast is contact, beside five engines' published figures?"""

from common import BLACK, BLUE, GREEN, ORANGE, PURPLE, RED, curve_points, figure, footnote, panels, shared_legend
from reading import reasons_note

LOOKS = {"RaiSim": (ORANGE, "s", ":"), "Bullet": (RED, "^", ":"), "ODE": (GREEN, "D", ":"), "DART": (PURPLE, "v", ":"),
         "MuJoCo": (BLACK, "X", ":")}
UNITS = {"rolling_xy": "velocity error² (m²/s²)", "rolling_y": "velocity error² (m²/s²)",
         "bouncing": "energy error² (J²)", "666": "overlap² (m²)", "elastic_666": "energy error² (J²)"}


def look(engine):
    """Of an engine, whatever solver of it was measured."""
    color, marker, line = LOOKS[engine.split()[0]]
    return {"color": color, "marker": marker, "linestyle": line, "markerfacecolor": "none"}


def benchmarks(frame):
    return [name for name in UNITS if name in set(frame["benchmark"])]


@figure("simbenchmark", "accuracy", table="accuracy")
def accuracy(frame):
    """Error over the step, one panel a benchmark."""
    names = benchmarks(frame)
    fig, axes = panels(len(names), columns=3, height=2.2)
    for ax, name in zip(axes, names):
        rows = frame[frame["benchmark"] == name]
        curve_points(ax, rows, "step_s", "error", "pbdcheck",
                     {"color": BLUE, "marker": "o", "linestyle": "-"})
        ax.set(xscale="log", yscale="log", title=name, xlabel="step (s)", ylabel=UNITS[name])
    shared_legend(fig, axes)
    footnote(fig, reasons_note(frame[frame["status"] != "ok"]))
    return fig


@figure("simbenchmark", "published", table="published")
def published(frame):
    """What five engines were published to reach."""
    names = benchmarks(frame)
    fig, axes = panels(len(names), columns=3, height=2.2)
    for ax, name in zip(axes, names):
        for engine, rows in frame[frame["benchmark"] == name].groupby("engine", sort=False):
            rows = rows.sort_values("step_s")
            ax.plot(rows["step_s"], rows["error"], label=engine.split()[0], **look(engine))
        ax.set(xscale="log", yscale="log", title=name, xlabel="step (s)", ylabel=UNITS[name])
    shared_legend(fig, axes)
    return fig
