"""Do the finite elements approach the continuum, and do mass-spring systems?"""

from common import curve_points, draw_failed, figure, footnote, on_log, panels, shared_legend, slope_triangle, ticks
from finding import fewer, finding, name_lines
from styles import BLACK, BLUE, FALLBACK, RED, style
from selecting import failed, good, reasons_note
from wording import counted, number, share

QUANTITIES = {"compliance_j": "bending compliance", "frequency_hz": "first frequency", "axial_j": "axial compliance", "poisson": "lateral contraction"}
MODELS = {"tet_p1": "linear tetrahedra, constraint solver", "tet_p1 reference": "linear tetrahedra, finite element judge",
          "springs": "mass-spring network"}


@figure("mesh_refinement", "beam", table="beam")
def beam(frame):
    """Relative error to beam and rod theory over the refinement. The judge is drawn where the solver has no curve of its
    own; elsewhere the two would cover each other."""
    quantities, left = fewer(frame["quantity"].unique())
    fig, axes = panels(len(quantities), columns=3, height=2.2, sharex=True, sharey=True)
    for ax, quantity in zip(axes, quantities):
        here = frame[frame["quantity"] == quantity]
        if (here["model"] == "tet_p1").any():
            here = here[here["model"] != "tet_p1 reference"]
        for model, rows in here.groupby("model", sort=False):
            curve_points(ax, rows, "n", "error_beam", MODELS.get(model, model), style(model))
        ax.set(xscale="log", yscale="log", xlabel="cells across the beam, n", title=QUANTITIES.get(quantity, quantity))
        ticks(ax, frame["n"], "{:.0f}".format)
    axes[0].set_ylabel("error against Timoshenko's beam\n(axial: the rod), relative")
    shared_legend(fig, axes, columns=2)
    finding(fig, *[nearer(frame[frame["quantity"] == quantity], QUANTITIES.get(quantity, quantity)) for quantity in quantities])
    footnote(fig, left + reasons_note(failed(frame, "error_beam")))
    return fig


def nearer(here, quantity):
    """On how many meshes springs or tetrahedra are the nearer to theory; without springs, how near the finest mesh comes."""
    errors = good(here, "error_beam").pivot_table("error_beam", "n", "model")
    if {"springs", "tet_p1"} <= set(errors):
        both = errors[["springs", "tet_p1"]].dropna()
        return f"{quantity}: springs are nearer to theory than tetrahedra on {share((both['springs'] < both['tet_p1']).sum(), len(both))}" \
               " meshes"
    if errors.empty:
        return f"{quantity}: none of {counted(len(here), 'run')} ended well"
    return f"{quantity}: {number(errors.loc[errors.index.max()].min())} off on the finest mesh"


@figure("mesh_refinement", "locking", table="locking")
def locking(frame):
    """The deflection over that of beam theory, over the distance of Poisson's ratio from 1/2, one line a mesh."""
    fig, (ax,) = panels(1, height=2.6)
    frame = frame.assign(left=1 - 2 * frame["poisson"], share=frame["value"] / frame["reference_beam"])
    for (n, rows), (color, marker, line) in zip(frame.groupby("n"), FALLBACK):
        curve_points(ax, rows, "left", "share", f"n = {n:.0f}", {"color": color, "marker": marker, "linestyle": line})
    ax.axhline(1, color=BLACK, linewidth=0.5)
    ax.set(xscale="log", ylim=(0, 1.1), xlabel="1 - 2 nu", ylabel="deflection over beam theory")
    shared_legend(fig, [ax])
    done = good(frame, "share")
    finding(fig, *[f"nu = {nu:g}: at best {number(rows['share'].max())} of beam theory's deflection, with n = "
                   f"{rows.loc[rows['share'].idxmax(), 'n']:.0f}" for nu, rows in done.groupby("poisson") if nu == done["poisson"].max()]
            or [f"No equilibrium of {len(frame)} is ok"])
    footnote(fig, reasons_note(failed(frame, "share")))
    return fig


@figure("mesh_refinement", "mms", table="mms")
def manufactured(frame):
    """Errors of a manufactured solution with triangles of the expected slopes."""
    fig, (ax,) = panels(1, height=2.5)
    for column, label, order, (color, marker, line) in (
            ("error_l2", "displacement, L2 norm", 2, (BLUE, "o", "-")),
            ("error_h1", "strain, H1 seminorm", 1, (RED, "s", "--"))):
        rows = good(frame, "h_m", column).sort_values("h_m")
        ax.plot(rows["h_m"], on_log(rows[column]), color=color, marker=marker, linestyle=line, markerfacecolor="white",
                label=label)
        draw_failed(ax, failed(frame, "h_m", column), "h_m", column, {"color": color, "marker": marker})
        if len(rows) > 1:
            slope_triangle(ax, rows["h_m"].iloc[0], 0.55 * on_log(rows[column].iloc[0]), order, color)
    ax.set(xscale="log", yscale="log", xlabel="element size h (m)", ylabel="error against the exact solution")
    name_lines(ax)
    finest = frame.sort_values("h_m").iloc[0]
    finding(fig, f"Between the two finest of {len(frame)} meshes errors fall with order "
            f"{number(finest['order_l2'])} (L2, expected 2) and {number(finest['order_h1'])} (H1, expected 1)")
    footnote(fig, reasons_note(failed(frame, "error_l2", "error_h1")))
    return fig
