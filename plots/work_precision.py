"""Which method gives which accuracy for which work?"""

import matplotlib.pyplot as plt

from common import draw_failed, figure, footnote, on_log, panels
from styles import BLACK, style
from selecting import failed, good, reasons_note, scene_text, step_text

RELAXATION_MARKERS = {"gauss_seidel": "o", "jacobi": "s", "nesterov_jacobi": "^", "conjugate_gradients": "P", "direct": "D"}
REFERENCE = {"color": BLACK, "marker": "*", "linestyle": "none", "markersize": 7, "markerfacecolor": BLACK}
LEAST_ERROR = 1e-9  # differences in accuracy below are not worth work


def method_name(row):
    """`outer, relaxation`; judges and rivals by their names, outer iterations that relax nothing alone."""
    if row["outer"] in ("judge", "rival"):
        return f"{row['outer']} {row['relaxation']}"
    if row["relaxation"] == "none":
        return row["outer"]
    return f"{row['outer']}, {row['relaxation']}"


def method_style(row):
    """Colour and line tell the outer iteration, the marker the relaxation."""
    look = style(row["outer"])
    return look | {"marker": RELAXATION_MARKERS.get(row["relaxation"], look["marker"])}


def quickest(frame, x):
    """Of each scene and outer iteration the relaxation that comes with least work to within ten times the least error that any
    reaches; one that reaches nothing only where all others do not either."""
    kept = []
    for (outer, *_), rows in frame.groupby(["outer", "scene", "step_s", "integrator", "friction"], sort=False):
        reached = good(rows, x, "error")
        near = reached[reached["error"] <= max(10 * reached["error"].min(), LEAST_ERROR)] if len(reached) else rows
        best = near.sort_values(x)["relaxation"].iloc[0]
        kept.append(rows if outer in ("judge", "rival") else rows[rows["relaxation"] == best])
    return frame.loc[sorted(index for rows in kept for index in rows.index)]


def with_work(frame, x):
    """The runs that have a place on an axis of this work. Judges do none of it, a method or a run that relaxes nothing
    updates no row; what was skipped stays where its method has a place in another panel."""
    works = frame.groupby("outer")[x].transform("max") > 0
    return frame[works & (frame["outer"] != "judge") & ((frame[x] > 0) | frame["status"].eq("skipped"))]


def is_reference(points):
    """Whether these are the solution that errors are measured against: its error is 0 because it is its own."""
    return (points["error"] == 0).all() and (points["sweeps"] == 0).all()


def mark_reference(ax, points, x):
    """The reference has a cost but no error: a star on the lower edge."""
    for place in points[x][points[x] > 0]:
        ax.plot([place], [0], clip_on=False, zorder=5, transform=ax.get_xaxis_transform(), **REFERENCE)


def front(ax, points, x, look):
    """Every run as a marker, crossed where it is not ok; a staircase through those that none beats in both work and
    error."""
    rows = good(points, x, "error").sort_values([x, "error"])
    ax.plot(rows[x], on_log(rows["error"]), **look | {"linestyle": "none", "markerfacecolor": "white"})
    best = rows[rows["error"] == rows["error"].cummin()]
    ax.plot(best[x], on_log(best["error"]), drawstyle="steps-post", **look | {"marker": "none"})
    draw_failed(ax, failed(points, x, "error"), x, "error", look)


def families_legend(fig, frame, references):
    """Outer iterations by colour and line, then relaxations by marker."""
    entries = {}
    for row in frame.drop_duplicates(["outer", "relaxation"]).to_dict("records"):
        look, name = method_style(row), method_name(row)
        if name in (f"judge {reference}" for reference in references):
            entries[f"{name}, the reference itself"] = REFERENCE
        elif row["outer"] in ("judge", "rival") or row["relaxation"] == "none":
            entries[name] = look
        else:
            entries[row["outer"]] = look | {"marker": "none"}
    for relaxation, marker in RELAXATION_MARKERS.items():
        if relaxation in set(frame["relaxation"]):
            entries[relaxation] = {"color": "#777777", "marker": marker, "linestyle": "none"}
    handles = [plt.Line2D([], [], **{"markerfacecolor": "white"} | look) for look in entries.values()]
    fig.legend(handles, entries, loc="upper center", bbox_to_anchor=(0.5, 0), ncol=4)


def relaxations_legend(fig, frame, references):
    """Relaxations and judges by their own looks."""
    entries = {f"judge {name}, the reference itself" if name in references else name: REFERENCE if name in references else
               style(name) for name in frame["relaxation"].unique()}
    handles = [plt.Line2D([], [], **{"markerfacecolor": "white"} | look) for look in entries.values()]
    fig.legend(handles, entries, loc="upper center", bbox_to_anchor=(0.5, 0), ncol=4)


def draw_methods(frame, x, label, by=["outer", "relaxation"], look=method_style, legend=families_legend, columns=2, height=2.4):
    """Error against work, one panel a scene, step, integrator and friction; a line is the least error for that work.
    Curves are what the columns `by` tell apart."""
    judges = frame[frame["outer"] == "judge"]
    names = [judge for judge, points in judges.groupby("relaxation", sort=False) if is_reference(points)]
    if x != "wall_s":
        frame = with_work(frame, x)
    groups = list(frame.groupby(["scene", "step_s", "integrator", "friction"], sort=False))
    fig, axes = panels(len(groups), columns=columns, height=height)
    for ax, ((scene, step, integrator, friction), rows) in zip(axes, groups):
        for _, points in rows.groupby(by, sort=False):
            first = points.iloc[0]
            if is_reference(points):
                mark_reference(ax, points, x)
            else:
                front(ax, points, x, look(first))
        title = f"{scene_text(scene)}, {integrator}, h = {step_text(step)}"
        if frame["friction"].nunique() > 1:
            title = f"{scene_text(scene)}, {friction}, h = {step_text(step)}"
        ax.set(xscale="log", yscale="log", title=title)
        ax.title.set_fontsize(7)
    fig.supxlabel(label, fontsize=8)
    fig.supylabel(f"error against {' and '.join(names) or 'the judge'}, relative", fontsize=8)
    legend(fig, frame, names)
    bad = failed(frame, x, "error")
    beside = "Beside the right edge: methods that were skipped at tighter tolerances, or altogether. " if \
        bad["status"].eq("skipped").any() else ""
    footnote(fig, beside + reasons_note(bad))
    return fig


@figure("work_precision", "seconds", table="points")
def seconds(frame):
    return draw_methods(quickest(frame, "wall_s"), "wall_s", "wall time (s)")


@figure("work_precision", "row_updates", table="points")
def row_updates(frame):
    return draw_methods(quickest(frame[frame["relaxation"] != "direct"], "row_updates"), "row_updates", "row updates")


@figure("work_precision", "outer_iterations", table="points")
def outer_iterations(frame):
    return draw_methods(quickest(frame, "outer_iterations"), "outer_iterations", "outer iterations")


def draw_contacts(frame, x, label):
    return draw_methods(frame, x, label, by="relaxation", look=lambda row: style(row["relaxation"]), legend=relaxations_legend,
                        columns=4, height=1.7)


@figure("work_precision", "contact_seconds", table="contacts")
def contact_seconds(frame):
    return draw_contacts(frame, "wall_s", "wall time (s)")


@figure("work_precision", "contact_row_updates", table="contacts")
def contact_row_updates(frame):
    return draw_contacts(frame[frame["relaxation"] != "direct"], "row_updates", "row updates")
