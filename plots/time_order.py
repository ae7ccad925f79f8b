"""At which order does each integrator approach motions in continuous time, those of particles and of rotating bodies?"""

from common import curve_points, draw_failed, figure, footnote, order_triangles, panels, shared_legend
from finding import MOST_PANELS, finding, guide
from styles import style
from selecting import failed, good, reasons_note, rule_names
from wording import counted, share, some

NEAR = 0.1  # of an observed order to the expected one, as the verdicts ask


def hardest(frame):
    """At most six motions in their order, those with failures before the others, and what is left out."""
    scenes = list(frame["scene"].unique())
    lost = failed(frame, "error")["scene"].value_counts()
    kept = sorted(scenes, key=lambda scene: -lost.get(scene, 0))[:MOST_PANELS]
    left = [scene for scene in scenes if scene not in kept]
    return [scene for scene in scenes if scene in kept], f"In the table alone: {', '.join(left)}. " if left else ""


@figure("time_order", "errors", table="errors")
@figure("rotation", "errors", table="errors")
def errors(frame):
    """Error over the step, one panel a motion, with triangles of the two orders under the curves."""
    scenes, left = hardest(frame)
    fig, axes = panels(len(scenes), columns=2 if len(scenes) == 4 else 3, height=2.1)
    for ax, scene in zip(axes, scenes):
        here = frame[frame["scene"] == scene]
        for name, rows in here.assign(rule=rule_names(here)).groupby("rule", sort=False):
            curve_points(ax, rows, "step_s", "error", name, style(name))
        ax.set(xscale="log", yscale="log", title=scene)
        order_triangles(ax, here, "step_s", "error")
    fig.supxlabel("step (s)", fontsize=8)
    fig.supylabel("error against continuous time, of the motion", fontsize=8)
    shared_legend(fig, axes, columns=4)
    finding(fig, least(frame))
    footnote(fig, left + reasons_note(failed(frame, "error")))
    return fig


def least(frame):
    """Which integrator has the least error at the smallest step of each motion."""
    shown = good(frame, "error")
    if shown.empty:
        return f"None of {counted(len(frame), 'run')} ended well"
    shown = shown.assign(rule=rule_names(shown))
    finest = shown[shown["step_s"] == shown.groupby("scene")["step_s"].transform("min")]
    winners = finest.loc[finest.groupby("scene")["error"].idxmin(), "rule"].value_counts()
    bad = len(frame) - len(shown)
    return ("Least error at the smallest step: " + ", ".join(f"{name} in {count}" for name, count in winners.items()) +
            f" of {counted(frame['scene'].nunique(), 'motion')}" + (f"; {bad} of {len(frame)} runs did not end well" if bad else ""))


@figure("time_order", "orders", table="orders")
@figure("rotation", "orders", table="orders")
def orders(frame):
    """Observed orders, one column a motion, the integrators beside each other."""
    fig, (ax,) = panels(1, height=2.4)
    scenes = list(frame["scene"].unique())
    placed = frame.assign(column=frame["scene"].map(scenes.index) + 1.0, rule=rule_names(frame))
    rules = list(placed["rule"].unique())
    for name, rows in placed.groupby("rule", sort=False):
        rows = rows.assign(column=rows["column"] + 0.08 * (rules.index(name) - (len(rules) - 1) / 2))
        look = style(name) | {"linestyle": "none", "markerfacecolor": "white"}
        shown = good(rows, "order")
        ax.plot(shown["column"], shown["order"], label=name, **look)
        draw_failed(ax, failed(rows, "order").assign(order=float("nan")), "column", "order", look)
    for order in (1, 2):
        guide(ax, order, linestyle="-", linewidth=0.5)
    ax.set(ylim=(0, 2.5), ylabel="observed order")
    ax.set_xticks(range(1, len(scenes) + 1), scenes, rotation=15, ha="right")
    shared_legend(fig, [ax])
    expected = frame[frame["order_expected"].notna()]
    near = expected["status"].eq("ok") & (abs(expected["order"] - expected["order_expected"]) <= NEAR)
    off = expected["scene"][~near] + ": " + placed.loc[expected.index, "rule"][~near]
    finding(fig, f"{share(near.sum(), len(expected))} orders are the expected ones, to {NEAR:g}" +
            (f"; not: {some(off, 2)}" if len(off) else ""))
    footnote(fig, reasons_note(failed(frame, "order")))
    return fig
