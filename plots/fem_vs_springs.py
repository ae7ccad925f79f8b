"""Elements against springs on the same mesh: in motion, in contact, and over the step."""

import numpy as np

from common import curve_points, draw_failed, figure, footnote, panels, shared_legend, ticks, trace
from finding import finding, guide
from reading import LARGEST
from selecting import failed, good, reasons_note
from styles import BLACK, FALLBACK, style
from wording import counted, joined, number, span

MODELS = {"tet_p1": "elements", "springs": "springs"}


@figure("fem_vs_springs", "courses", table="courses")
def courses(frame):
    """The tip of a bar that is let go, over its way by beam theory at the start; one panel a model, one line a mesh."""
    models = list(frame["model"].unique())
    fig, axes = panels(len(models), columns=2, height=2.3, sharey=True)
    for ax, model in zip(axes, models):
        here = frame[frame["model"] == model]
        for n, rows in here.groupby("n"):
            trace(ax, rows.sort_values("time_s"), in_starts(rows.sort_values("time_s"), "tip_m"), f"n = {n:.0f}")
        beam = here[here["n"] == here["n"].max()].sort_values("time_s")
        ax.plot(beam["time_s"], in_starts(beam, "beam_m"), color=BLACK, linewidth=0.8, linestyle="--", label="beam theory")
        ax.set(xlabel="time (s)", title=MODELS.get(model, model))
    axes[0].set_ylabel("tip over beam theory's\nfirst deflection")
    shared_legend(fig, axes)
    finding(fig, *(f"{MODELS.get(model, model).capitalize()} swing {joined(shares)} times as far as beam theory says"
                   for model, shares in deflections(frame).items()))
    footnote(fig, reasons_note(failed(frame, "time_s")))
    return fig


def in_starts(rows, column):
    return (rows[column] / rows["beam_m"].iloc[0]).to_numpy()


def deflections(frame):
    """Of each model: the share of beam theory's deflection at the start, for each mesh."""
    found = {}
    for (model, n), rows in frame.groupby(["model", "n"], sort=False):
        found.setdefault(model, []).append(f"{number(in_starts(rows.sort_values('time_s'), 'tip_m')[0], 2)} (n = {n:.0f})")
    return found


@figure("fem_vs_springs", "steps", table="bars")
def steps(frame):
    """Error of the tip's course against continuous time over the step, and what is predicted of the first mode."""
    frame = frame[frame["error"].notna() | frame["status"].ne("ok")]
    if frame.empty:
        return None
    models = list(frame["model"].unique())
    fig, axes = panels(len(models), columns=2, height=2.3, sharey=True)
    for ax, model in zip(axes, models):
        for integrator, rows in frame[frame["model"] == model].groupby("integrator", sort=False):
            look = style("newmark 0.5" if integrator == "newmark" else integrator)
            curve_points(ax, rows, "step_s", "error", integrator, look)
            told = good(rows, "predicted_error").sort_values("step_s")
            ax.plot(told["step_s"], told["predicted_error"], color=look["color"], linewidth=0.8, linestyle=":",
                    label=f"{integrator}, formula of the first mode")
        ax.set(xscale="log", yscale="log", xlabel="step (s)", title=MODELS.get(model, model))
        ticks(ax, frame["step_s"], lambda h: number(h, 2))
    axes[0].set_ylabel("largest error of the tip's course,\nover its way at the start")
    shared_legend(fig, axes, columns=2)
    shortest = good(frame, "error")
    shortest = shortest[shortest["step_s"] == shortest["step_s"].min()]
    finding(fig, "At the shortest step the course is off by " + joined(
        f"{span(rows['error'])} ({integrator})" for integrator, rows in shortest.groupby("integrator", sort=False))
        if len(shortest) else f"None of {counted(len(frame), 'run')} ended well")
    footnote(fig, reasons_note(failed(frame, "error")))
    return fig


@figure("fem_vs_springs", "cubes", table="cubes")
def cubes(frame):
    """The bulge of a cube pressed by a plate over the Poisson's ratio that is asked for."""
    frame = frame[frame["scene"] == "plate"]
    groups = list(frame.groupby("friction_coefficient"))
    if not groups:
        return None
    fig, axes = panels(len(groups), columns=2, height=2.4, sharey=True)
    for ax, (friction, here) in zip(axes, groups):
        lines = here.groupby(["model", "n"], sort=False)
        for ((model, n), rows), (_, marker, _) in zip(lines, FALLBACK):
            draw_bulge(ax, rows, f"{MODELS.get(model, model)}, n = {n:.0f}", style(model) | {"marker": marker})
        formula = good(here, "bulge_expected").drop_duplicates("poisson").sort_values("poisson")
        if len(formula):
            ax.plot(formula["poisson"], formula["bulge_expected"], color=BLACK, linewidth=0.8, linestyle="--", label="nu times strain")
        guide(ax, 0, linewidth=0.4, linestyle="-")
        ax.set(xlabel="Poisson's ratio asked for", title=f"friction {friction:g}")
    axes[0].set_ylabel("bulge over the width")
    shared_legend(fig, axes)
    finding(fig, *told(frame))
    footnote(fig, reasons_note(frame[frame["status"] != "ok"]))
    return fig


def draw_bulge(ax, rows, label, look):
    """A bulge may be negative, where a mesh draws in."""
    ok = rows[rows["status"].eq("ok") & (rows["bulge"].abs() <= LARGEST)].sort_values("poisson")
    ax.plot(ok["poisson"], ok["bulge"], label=label, markerfacecolor="white", **look)
    draw_failed(ax, rows.drop(ok.index), "poisson", "bulge", look)


def told(frame):
    """How far off each model bulges where there is a formula, over the strain."""
    done = good(frame[frame["friction_coefficient"] == 0], "sag_expected_m", "bulge_expected")
    scale = done["bulge_expected"][done["poisson"] > 0] / done["poisson"][done["poisson"] > 0]
    if done.empty or not len(scale):
        return (f"None of {counted(len(frame), 'run')} has a formula",)
    off = (done["bulge"] - done["bulge_expected"]).abs() / scale.iloc[0]
    return ("Without friction the lateral contraction is off by at most "
            + joined(f"{number(np.max(off[rows.index]), 2)} ({MODELS.get(model, model)})" for model, rows in done.groupby("model", sort=False)),)


@figure("fem_vs_springs", "networks", table="networks")
def networks(frame):
    """Lateral contraction of cubes of springs over the mesh, beside what their lattice makes of it."""
    fig, (ax,) = panels(1, height=2.3)
    curve_points(ax, frame, "n", "poisson", "springs, cube pulled by little", style("springs"))
    lattice, isotropic = frame["lattice_poisson"].iloc[0], frame["isotropic_poisson"].iloc[0]
    guide(ax, lattice, f"this lattice, {number(lattice)}")
    guide(ax, isotropic, f"isotropic network, {number(isotropic)}", linestyle=":")
    ax.set(xscale="log", ylim=(0, None), xlabel="cells along an edge, n", ylabel="lateral over axial strain")
    ticks(ax, frame["n"], "{:.0f}".format)
    finest = good(frame, "n", "poisson").sort_values("n").tail(1)
    finding(fig, *(f"A network of n = {row['n']:.0f} has Poisson's ratio {number(row['poisson'])}, and tends to {number(lattice)}, whatever is asked"
                   for _, row in finest.iterrows()), "" if len(finest) else f"None of {counted(len(frame), 'run')} ended well")
    footnote(fig, reasons_note(failed(frame, "n", "poisson")))
    return fig


@figure("fem_vs_springs", "cost", table="cost")
def cost(frame):
    """Time of a step over its rows, one panel a scene; one line a relaxation, from springs to elements."""
    scenes = list(frame["scene"].unique())
    fig, axes = panels(len(scenes), columns=2, height=2.3)
    for ax, scene in zip(axes, scenes):
        for relaxation, rows in frame[frame["scene"] == scene].groupby("relaxation", sort=False):
            curve_points(ax, rows, "rows", "wall_s", relaxation, style(relaxation))
        here = good(frame[frame["scene"] == scene], "rows", "wall_s")
        for model, rows in here.groupby("model", sort=False):
            ax.annotate(MODELS.get(model, model), (rows["rows"].iloc[0], 0.02), xycoords=("data", "axes fraction"), ha="center", fontsize=6.5)
        ax.set(xscale="log", yscale="log", xlabel="rows", title=scene)
        ax.margins(x=0.2, y=0.25)
    axes[0].set_ylabel("time of a step (s)")
    shared_legend(fig, axes)
    both = good(frame, "rows", "wall_s").pivot_table("wall_s", ["scene", "n", "relaxation"], "model")
    known = {"tet_p1", "springs"} <= set(both)
    finding(fig, f"A step of elements takes {span(both['tet_p1'] / both['springs'])} times as long as one of springs" if known
            else f"Not both were solved in {counted(len(frame), 'run')}")
    footnote(fig, reasons_note(failed(frame, "rows", "wall_s")))
    return fig
