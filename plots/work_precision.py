"""Which method gives which accuracy for which work?"""

from common import figure, footnote, on_log, panels, shared_legend
from finding import MOST_PANELS, MOST_SERIES, fewer, finding
from styles import BLACK, style
from selecting import good, reasons_note, failed, scene_text, step_text
from wording import counted, number

REFERENCE = {"color": BLACK, "marker": "*", "linestyle": "none", "markersize": 7, "markerfacecolor": BLACK}
LEAST_ERROR = 1e-9  # differences in accuracy below are not worth work
ASKED = 1e-6  # the error of the title
STEP = ["scene", "step_s", "integrator", "friction"]


def method_name(row):
    """The outer iteration; judges and rivals by their names."""
    return f"{row['outer']} {row['relaxation']}" if row["outer"] in ("judge", "rival") else row["outer"]


def method_look(row):
    return style(row["relaxation" if row["outer"] == "rival" else "outer"])


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
    for place in points[x][points[x] > 0].head(1):
        ax.plot([place], [0], clip_on=False, zorder=5, transform=ax.get_xaxis_transform(), **REFERENCE)


def front(ax, points, x, name, look):
    """A staircase through the solved runs that none beats in both work and error."""
    rows = good(points, x, "error").sort_values([x, "error"])
    best = rows[rows["error"] == rows["error"].cummin()]
    ax.plot(best[x], on_log(best["error"]), drawstyle="steps-post", label=name, **{"markerfacecolor": "white"} | look)


def first_to_reach(frame, x):
    """In how many steps each method is the first to reach the error that is asked for, of those with a solution of their own."""
    reached = good(frame, x, "error")
    reached = reached[(reached["error"] <= ASKED) & (reached["outer"] != "judge")]
    first = reached.loc[reached.groupby(STEP)[x].idxmin()]["name"].value_counts()
    return ", ".join(f"{name} in {count}" for name, count in first.items())


def draw_methods(frame, x, label, names, look):
    """Error against work, one panel a scene, step, integrator and friction: where there are many, those of the largest step.
    `names` tells the curves apart. Methods that do not reach the error asked for are named in the panel."""
    references = [name for name, points in frame[frame["outer"] == "judge"].groupby("relaxation", sort=False)
                  if is_reference(points)]
    frame = frame.assign(name=names)
    if x != "wall_s":
        frame = with_work(frame, x)
    groups = list(frame.groupby(STEP, sort=False))
    steps = len(groups)
    if not groups:
        return None
    if steps > MOST_PANELS:
        groups = [(key, rows) for key, rows in groups if key[1] == frame["step_s"].max()]
    groups, _ = fewer(groups)
    theirs = frame[~((frame["outer"] == "judge") & (frame["error"] == 0))]
    reach = (theirs["status"].eq("ok") & (theirs["error"] <= ASKED)).groupby(theirs["name"], sort=False).sum()
    kept = list(reach.sort_values(ascending=False, kind="stable").index[:MOST_SERIES])
    fig, axes = panels(len(groups), columns=2 if len(groups) == 4 else 3, height=1.8, sharey=True)
    for ax, ((scene, step, integrator, friction), rows) in zip(axes, groups):
        missing = []
        for name, points in rows.groupby("name", sort=False):
            if is_reference(points):
                mark_reference(ax, points, x)
            elif name in kept:
                front(ax, points, x, name, look(points.iloc[0]))
                if not (good(points, x, "error")["error"] <= ASKED).any():
                    missing.append(name)
        if missing:
            ax.text(0.02, 0.02, "not to " + number(ASKED) + ":\n" + "\n".join(missing), transform=ax.transAxes, fontsize=5.5,
                    va="bottom", color="#555555")
        told = "".join(f", {value}" for column, value in (("friction", friction), ("integrator", integrator))
                       if frame[column].nunique() > 1)
        ax.set(xscale="log", yscale="log", title=f"{scene_text(scene)}{told}, h = {step_text(step)}")
        ax.title.set_fontsize(7)
    fig.supxlabel(label, fontsize=8)
    fig.supylabel(f"error against {' and '.join(references) or 'the judge'}, relative", fontsize=8)
    shared_legend(fig, axes)
    first = first_to_reach(frame, x)
    finding(fig, f"First to an error of {number(ASKED)} by {label}: {first}, of {counted(steps, 'step')}" if first else
            f"No method reaches an error of {number(ASKED)} in {counted(steps, 'step')}")
    others = [name for name in theirs["name"].unique() if name not in kept]
    footnote(fig, "Star: the judge that errors are measured against. " +
             (f"Drawn: {len(groups)} of {steps} steps. " if len(groups) < steps else "") +
             (f"In the table alone: {', '.join(others)}. " if others else "") +
             reasons_note(failed(frame, x, "error")).replace("Crossed, not ok", "Not drawn, not ok"))
    return fig


def draw_points(frame, x, label):
    frame = quickest(frame, x)
    return draw_methods(frame, x, label, frame.apply(method_name, axis=1), method_look)


@figure("work_precision", "seconds", table="points")
def seconds(frame):
    return draw_points(frame, "wall_s", "wall time (s)")


@figure("work_precision", "row_updates", table="points")
def row_updates(frame):
    return draw_points(frame[frame["relaxation"] != "direct"], "row_updates", "row updates")


@figure("work_precision", "outer_iterations", table="points")
def outer_iterations(frame):
    return draw_points(frame, "outer_iterations", "outer iterations")


def draw_contacts(frame, law, x, label):
    frame = frame[frame["friction"] == law]
    return draw_methods(frame, x, label, frame["relaxation"], lambda row: style(row["relaxation"]))


@figure("work_precision", "contact_seconds", table="contacts")
def contact_seconds(frame):
    return draw_contacts(frame, "coulomb", "wall_s", "wall time (s)")


@figure("work_precision", "contact_cone_seconds", table="contacts")
def contact_cone_seconds(frame):
    return draw_contacts(frame, "cone", "wall_s", "wall time (s)")


@figure("work_precision", "contact_row_updates", table="contacts")
def contact_row_updates(frame):
    return draw_contacts(frame[frame["relaxation"] != "direct"], "coulomb", "row_updates", "row updates")
