"""Do the impulses of a step's contacts obey the law of friction?"""

import numpy as np

from common import draw_failed, figure, footnote, on_log, panels, shared_legend
from styles import style
from selecting import failed, good, reasons_note

ERRORS = {"complementarity_share": "complementarity", "dissipation_share": "dissipation", "velocity_share": "velocity"}


@figure("friction_cone", "plane", table="contacts")
def plane(frame):
    """Impulses in the plane of the cone, a panel a law: what sticks is inside, what slides on its boundary."""
    frame = frame.assign(tangent=np.hypot(frame["tangent1_n_s"], frame["tangent2_n_s"]) / frame["coefficient"])
    shown = np.isfinite(frame["tangent"]) & np.isfinite(frame["normal_n_s"])
    groups = list(frame[shown].groupby("law", sort=False))
    fig, axes = panels(len(groups), columns=2, height=2.8)
    for ax, (law, rows) in zip(axes, groups):
        end = 1.1 * max([1e-3, *rows["normal_n_s"], *rows["tangent"]])
        ax.plot([0, end], [0, end], color="#888888", linewidth=0.8, label="boundary of the cone")
        for place, (name, found) in enumerate(rows.groupby("relaxation", sort=False)):
            look = style(name) | {"linestyle": "none", "markerfacecolor": "none", "markersize": 3 + place / 2}
            ax.plot(found["tangent"], found["normal_n_s"], label=name, markeredgewidth=0.6, **look)
        ax.set(title=f"law {law}", xlim=(-0.03 * end, end), ylim=(-0.03 * end, end))
    fig.supxlabel("tangential impulse over friction coefficient (N s)", fontsize=8)
    fig.supylabel("normal impulse (N s)", fontsize=8)
    shared_legend(fig, axes)
    footnote(fig, f"Contacts without numbers: {(~shown).sum()}." if not shown.all() else "")
    return fig


@figure("friction_cone", "errors", table="solves")
def errors(frame):
    """Errors as shares of what the tolerance allows, a panel a law."""
    groups = list(frame.groupby("law", sort=False))
    fig, axes = panels(len(groups), columns=2, height=2.8, sharey=True)
    for ax, (law, rows) in zip(axes, groups):
        rows = rows.assign(place=np.arange(1.0, len(rows) + 1))
        ax.axhline(1, color="#888888", linewidth=0.8)
        for column, name in ERRORS.items():
            if column == "velocity_share" and law != "cone":
                continue  # Coulomb's law may have several solutions
            look = style(name) | {"linestyle": "none"}
            fine = good(rows, "place", column)
            ax.plot(fine["place"], on_log(fine[column]), label=name, markerfacecolor="white", **look)
            draw_failed(ax, failed(rows, column), "place", column, {"color": look["color"], "marker": look["marker"]})
        ax.set_xticks(rows["place"], rows["relaxation"], rotation=40, ha="right")
        ax.set(yscale="log", title=f"law {law}")
    fig.supylabel("error over what the tolerance allows", fontsize=8)
    shared_legend(fig, axes)
    footnote(fig, reasons_note(failed(frame, "dissipation_share")))
    return fig
