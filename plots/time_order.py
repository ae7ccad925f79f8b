"""At which order does each integrator approach motions in continuous time, those of particles and of rotating bodies?"""

from common import curve_points, draw_failed, figure, footnote, order_triangles, panels, shared_legend
from styles import BLACK, style
from selecting import failed, good, reasons_note, rule_names


@figure("time_order", "errors", table="errors")
@figure("rotation", "errors", table="errors")
def errors(frame):
    """Error over the step, one panel a motion, with triangles of the two orders under the curves."""
    scenes = list(frame.groupby("scene", sort=False))
    fig, axes = panels(len(scenes), columns=2 if len(scenes) == 4 else 3, height=2.2)
    for ax, (scene, here) in zip(axes, scenes):
        for name, rows in here.assign(rule=rule_names(here)).groupby("rule", sort=False):
            curve_points(ax, rows, "step_s", "error", name, style(name))
        ax.set(xscale="log", yscale="log", title=scene)
        order_triangles(ax, here, "step_s", "error")
    fig.supxlabel("step (s)", fontsize=8)
    fig.supylabel("error against continuous time, of the motion", fontsize=8)
    shared_legend(fig, axes, columns=4)
    footnote(fig, reasons_note(failed(frame, "error")))
    return fig


@figure("time_order", "orders", table="orders")
@figure("rotation", "orders", table="orders")
def orders(frame):
    """Observed orders, one column a motion, the integrators beside each other."""
    fig, (ax,) = panels(1, height=2.7)
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
        ax.axhline(order, color=BLACK, linewidth=0.5)
    ax.set(ylim=(0, 2.5), ylabel="observed order")
    ax.set_xticks(range(1, len(scenes) + 1), scenes, rotation=25, ha="right")
    shared_legend(fig, [ax])
    footnote(fig, reasons_note(failed(frame, "order")))
    return fig
