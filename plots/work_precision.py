"""Which method gives which accuracy for which work?"""

from common import BLACK, ORANGE, SKY, curve_points, figure, footnote, panels, shared_legend, style
from reading import failed, reasons_note, step_text

RELAXATION_MARKERS = {"gauss_seidel": "o", "jacobi": "s", "nesterov_jacobi": "^", "conjugate_gradients": "P", "direct": "D"}
FILLINGS = {"incremental": {"fillstyle": "left", "markerfacecolor": SKY, "markerfacecoloralt": "white"},
            "frozen": {"markerfacecolor": ORANGE}}


def method_name(row):
    """`outer, relaxation`; judges by the name of the reference."""
    if row["outer"] == "judge":
        return f"judge {row['relaxation']}"
    return f"{row['outer']}, {row['relaxation']}"


def method_style(row):
    """Colour, line and filling tell the outer iteration, the marker the relaxation."""
    look = style(row["outer"])
    return look | {"marker": RELAXATION_MARKERS.get(row["relaxation"], look["marker"])} | FILLINGS.get(row["outer"], {})


def is_reference(points):
    """Whether these are the solution that errors are measured against: its error is 0 because it is its own."""
    return (points["error"] == 0).all() and (points["sweeps"] == 0).all()


def mark_reference(ax, points, x, name):
    """The reference has a cost but no error: a star on the lower edge."""
    for place in points[x][points[x] > 0]:
        ax.plot([place], [0], "*", color=BLACK, markersize=7, transform=ax.get_xaxis_transform(), clip_on=False, zorder=5,
                label=f"{name}, the reference itself")


def draw_methods(frame, x, label):
    """Error against work, one panel a scene, step, integrator and friction. Judges have a place on the axis of seconds
    only."""
    judges = frame[frame["outer"] == "judge"]
    names = [name for name, points in judges.groupby("relaxation", sort=False) if is_reference(points)]
    if x != "wall_s":
        frame = frame.drop(judges.index)
    groups = list(frame.groupby(["scene", "step_s", "integrator", "friction"], sort=False))
    fig, axes = panels(len(groups), columns=2, height=2.4)
    for ax, ((scene, step, integrator, friction), rows) in zip(axes, groups):
        for _, points in rows.groupby(["outer", "relaxation"], sort=False):
            first = points.iloc[0]
            if is_reference(points):
                mark_reference(ax, points, x, method_name(first))
            else:
                curve_points(ax, points, x, "error", method_name(first), method_style(first))
        extra = f", {friction}" if frame["friction"].nunique() > 1 else ""
        ax.set(xscale="log", yscale="log", title=f"{scene}, {integrator}, h = {step_text(step)}{extra}")
        ax.title.set_fontsize(7)
    fig.supxlabel(label, fontsize=8)
    fig.supylabel(f"error against {' and '.join(names) or 'the judge'}, relative", fontsize=8)
    shared_legend(fig, axes, columns=3)
    bad = failed(frame, x, "error")
    beside = "Beside the right edge: methods whose tighter tolerances were skipped. " if \
        bad["status"].eq("skipped").any() else ""
    footnote(fig, beside + reasons_note(bad))
    return fig


@figure("work_precision", "seconds", table="points")
def seconds(frame):
    return draw_methods(frame, "wall_s", "wall time (s)")


@figure("work_precision", "row_updates", table="points")
def row_updates(frame):
    return draw_methods(frame, "row_updates", "row updates")


@figure("work_precision", "outer_iterations", table="points")
def outer_iterations(frame):
    return draw_methods(frame, "outer_iterations", "outer iterations")
