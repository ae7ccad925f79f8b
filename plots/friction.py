"""Contact beside known answers: the errors of every quantity, friction over the heading, and the convex law's gap."""

from common import curve_points, draw_failed, figure, footnote, on_log, panels, shared_legend, ticks
from styles import BLACK, style
from selecting import failed, good, reasons_note, text_number

SHORT = {"gauss_seidel": "GS", "jacobi": "J", "nesterov_jacobi": "NJ", "conjugate_gradients": "CG", "direct": "direct"}


def answers(frame):
    """Largest error of each quantity, relaxation and law, one panel a quantity; dashed the bound."""
    quantities = list(frame.groupby("quantity", sort=False))
    names = list(dict.fromkeys(frame["relaxation"]))
    frictions = list(dict.fromkeys(frame["friction"]))
    fig, axes = panels(len(quantities), columns=3, height=2.2)
    for ax, (quantity, here) in zip(axes, quantities):
        for friction, rows in here.groupby("friction", sort=False):
            shift = 0.16 * (frictions.index(friction) - (len(frictions) - 1) / 2)
            placed = rows.assign(place=[names.index(name) + 1 + shift for name in rows["relaxation"]])
            look = style(friction)
            ok = good(placed, "error")
            ax.plot(ok["place"], on_log(ok["error"]), label=friction, **look | {"linestyle": "none", "markersize": 3})
            draw_failed(ax, failed(placed, "error"), "place", "error", {key: look[key] for key in ("color", "marker")})
        bound = here["bound"].dropna()
        if len(bound):
            ax.axhline(bound.iloc[0], color=BLACK, linestyle="--", linewidth=0.8)
        ax.set_xticks(range(1, len(names) + 1), [SHORT.get(name, name) for name in names])
        ax.set(yscale="log", title=quantity.replace("_", " "), xlim=(0.5, len(names) + 0.5))
        ax.set_ylabel(f"error ({here['unit'].iloc[0]})", fontsize=7)
    shared_legend(fig, axes)
    footnote(fig, reasons_note(failed(frame, "error")))
    return fig


for experiment in ("incline", "stopping", "restitution", "stack"):
    figure(experiment, "answers", table="answers")(answers)


@figure("friction_isotropy", "headings", table="headings")
def headings(frame):
    """Deceleration over the heading, and the error of deceleration and heading."""
    fig, axes = panels(3, columns=3, height=2.4)
    for (friction, relaxation), rows in frame.groupby(["friction", "relaxation"], sort=False):
        label = friction if relaxation == "direct" else None
        for ax, column in zip(axes, ("deceleration_share", "share_error", "heading_error_rad")):
            curve_points(ax, rows, "heading_deg", column, label, style(friction) | {"linestyle": "none"})
    axes[0].set_ylabel("deceleration over mu g")
    axes[1].set(yscale="log", ylabel="error of that share")
    axes[2].set(yscale="log", ylabel="error of the heading (rad)")
    for ax in axes:
        ax.set_xlabel("heading (degrees)")
        ax.set_xticks(range(0, 361, 90))
    shared_legend(fig, axes)
    footnote(fig, reasons_note(failed(frame, "share_error", "heading_error_rad")))
    return fig


@figure("convex_gap", "gaps", table="gaps")
def gaps(frame):
    """Gap over the step, one panel a relaxation; solid h mu v."""
    relaxations = list(frame.groupby("relaxation", sort=False))
    fig, axes = panels(len(relaxations), columns=3, height=2.2, sharey=True)
    for ax, (relaxation, here) in zip(axes, relaxations):
        for friction, rows in here.groupby("friction", sort=False):
            curve_points(ax, rows, "step_s", "gap_m", friction, style(friction) | {"linestyle": "none"})
        line = here[here["expected_m"] > 0].sort_values("step_s")
        ax.plot(line["step_s"], line["expected_m"], color=BLACK, linewidth=0.8, label="h mu v")
        ax.set(xscale="log", yscale="log", title=relaxation, xlabel="step (s)")
        ticks(ax, here["step_s"], lambda h: f"1/{1 / h:.0f}")
    for ax in axes[::3]:
        ax.set_ylabel("gap (m)")
    shared_legend(fig, axes, columns=5)
    footnote(fig, reasons_note(failed(frame, "gap_m")))
    return fig


@figure("restitution", "heights", table="heights")
def heights(frame):
    """Height of each bounce, one panel a coefficient of restitution; solid the known ones."""
    coefficients = list(frame.groupby("restitution", sort=True))
    fig, axes = panels(len(coefficients), columns=2, height=2.4, sharey=True)
    for ax, (restitution, here) in zip(axes, coefficients):
        for (relaxation, h), rows in here.groupby(["relaxation", "step_s"], sort=False):
            if relaxation == "direct":
                look = style(f"step {h}") | {"linestyle": "none"}
                curve_points(ax, rows, "bounce", "height_m", f"h = {text_number(h)} s", look)
        exact = here.drop_duplicates("bounce").sort_values("bounce")
        ax.plot(exact["bounce"], exact["expected_m"], color=BLACK, linewidth=0.8, label="restitution^(2 n) m")
        ax.set(yscale="log", title=f"restitution {restitution:g}", xlabel="bounce n")
        ax.set_xticks(exact["bounce"])
    axes[0].set_ylabel("height (m)")
    shared_legend(fig, axes)
    footnote(fig, reasons_note(failed(frame, "height_m")))
    return fig


@figure("stack", "thresholds", table="thresholds")
def thresholds(frame):
    """Largest displacement of structures just inside and just outside of their limits; between the lines none stands or
    falls."""
    fig, axes = panels(len(frame["structure"].unique()), columns=2, height=2.6, sharey=True)
    for ax, (structure, here) in zip(axes, frame.groupby("structure", sort=False)):
        counts = sorted(here["count"].unique())
        for (relaxation, outcome), rows in here.groupby(["relaxation", "outcome"], sort=False):
            shift = 0.1 if relaxation == "direct" else -0.1
            placed = rows.assign(place=[counts.index(count) + 1 + shift for count in rows["count"]])
            look = style(relaxation) | {"linestyle": "none"}
            look |= {"markerfacecolor": look["color"] if outcome == "falls" else "white"}
            curve_points(ax, placed, "place", "moved", f"{relaxation}, {outcome}", look)
        for line in (1e-4, 0.1):
            ax.axhline(line, color=BLACK, linestyle="--", linewidth=0.8)
        ax.set_xticks(range(1, len(counts) + 1), [f"{count:.0f}" for count in counts])
        ax.set(yscale="log", title=structure, xlim=(0.5, len(counts) + 0.5), xlabel="bricks or stones")
    axes[0].set_ylabel("largest displacement over the size")
    shared_legend(fig, axes)
    footnote(fig, reasons_note(failed(frame, "moved")))
    return fig
