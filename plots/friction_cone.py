"""Do the impulses of a step's contacts obey the law of friction?"""

import numpy as np
import pandas as pd

from common import figure, footnote, panels, shared_legend
from finding import fewer, finding
from strips import strips
from styles import style
from selecting import failed, reasons_note
from wording import share

SLACK = 1e-6  # of the largest impulse: rounding and tolerance of what stands on the boundary
ERRORS = {"complementarity_share": "complementarity", "dissipation_share": "dissipation", "velocity_share": "velocity"}


@figure("friction_cone", "plane", table="contacts")
def plane(frame):
    """Impulses in the plane of the cone, a panel a law: what sticks is inside, what slides on its boundary."""
    frame = frame.assign(tangent=np.hypot(frame["tangent1_n_s"], frame["tangent2_n_s"]) / frame["coefficient"])
    shown = np.isfinite(frame["tangent"]) & np.isfinite(frame["normal_n_s"])
    groups, left = fewer(frame[shown].groupby("law", sort=False))
    if not groups:
        return None
    fig, axes = panels(len(groups), columns=2, height=2.8)
    for ax, (law, rows) in zip(axes, groups):
        end = 1.1 * max([1e-3, *rows["normal_n_s"], *rows["tangent"]])
        ax.plot([0, end], [0, end], color="#888888", linewidth=0.8)
        ax.text(0.97 * end, 0.93 * end, "boundary", fontsize=6.5, ha="right", color="#666666")
        for place, (name, found) in enumerate(rows.groupby("relaxation", sort=False)):
            look = style(name) | {"linestyle": "none", "markerfacecolor": "none", "markersize": 3 + place / 2}
            ax.plot(found["tangent"], found["normal_n_s"], label=name, markeredgewidth=0.6, **look)
        ax.set(title=f"law {law}", xlim=(-0.03 * end, end), ylim=(-0.03 * end, end))
    fig.supxlabel("tangential impulse over friction coefficient (N s)", fontsize=8)
    fig.supylabel("normal impulse (N s)", fontsize=8)
    shared_legend(fig, axes)
    inside = frame["tangent"] <= frame["normal_n_s"] + SLACK * frame["normal_n_s"].max()
    slides = inside & (frame["slip_m_per_s"] > 0) & (frame["tangent"] >= (1 - 1e-3) * frame["normal_n_s"])
    finding(fig, f"{share(inside.sum(), len(frame))} impulses are in the cone, {slides.sum()} of them on its boundary")
    footnote(fig, left + f"Contacts without numbers: {(~shown).sum()}." if not shown.all() else left)
    return fig


@figure("friction_cone", "errors", table="solves")
def errors(frame):
    """Errors over what the tolerance allows, a row a law and error."""
    parts = []
    for law, rows in frame.groupby("law", sort=False):
        for column, name in ERRORS.items():
            if column == "velocity_share" and law != "cone":
                continue  # Coulomb's law may have several solutions
            parts.append(rows[["status"]].assign(row=f"{name}, {law}", ratio=rows[column], who=rows["relaxation"],
                                                 holds=rows["status"].eq("ok") & (rows[column] <= 1)))
    checks = pd.concat(parts, ignore_index=True).dropna(subset="ratio") if parts else frame[:0]
    return strips(checks, "error", reasons_note(failed(frame, "dissipation_share")), "error over what the tolerance allows")
