"""What do mass ratio, stiffness and near incompressibility do to each relaxation?"""

import numpy as np

from common import curve_points, figure, footnote, panels, shared_legend
from finding import fewer, finding
from styles import style
from selecting import failed, good, reasons_note
from wording import share

PANELS = {"mass_ratio": "mass ratio, tip to other nodes", "young_pa": "Young's modulus (Pa)", "poisson": "1 - 2 nu"}


@figure("conditioning", "sweeps", table="sweeps")
def sweeps(frame):
    """Sweeps over the parameter, one panel a parameter; what spends its sweeps stands at the upper edge."""
    frame = frame.assign(value=frame["value"].where(frame["parameter"] != "poisson", 1 - 2 * frame["value"]),
                         sweeps=frame["sweeps"].where(frame["status"] == "ok", np.nan))
    groups, left = fewer(frame.groupby("parameter", sort=False))
    fig, axes = panels(len(groups), columns=3, height=2.3, sharey=True)
    for ax, (parameter, rows) in zip(axes, groups):
        for relaxation, points in rows.groupby("relaxation", sort=False):
            curve_points(ax, points, "value", "sweeps", relaxation, style(relaxation))
        ax.set(xscale="log", yscale="log", xlabel=PANELS.get(parameter, parameter), title=rows["scene"].iloc[0])
        ax.margins(y=0.2)
        if parameter == "poisson":
            ax.invert_xaxis()
    axes[0].set_ylabel("sweeps to a residual of 1e-6")
    shared_legend(fig, axes, columns=5)
    solved = {relaxation: (len(good(rows, "sweeps")), len(rows)) for relaxation, rows in frame.groupby("relaxation", sort=False)}
    finding(fig, "Problems solved: " + ", ".join(f"{name} {share(*solved[name])}" for name in
                                                 sorted(solved, key=lambda name: -solved[name][0])))
    footnote(fig, left + reasons_note(failed(frame, "sweeps")))
    return fig
