"""Is each effect's contraction of the plain iteration the predicted one?"""

import numpy as np

from common import draw_failed, figure, footnote, on_log, panels, shared_legend
from styles import BLACK, BLUE, GREEN, RED
from selecting import drawable, failed, good, reasons_note, stiffens

LEAST, MOST = 1e-3, 1e3  # rates that are measured, and the largest drawn
SHOWN = (("bound", "bound of the effect", {"color": GREEN, "marker": "^"}),
         ("predicted_contraction", "predicted by the solver", {"color": BLUE, "marker": "D"}),
         ("measured_rate", "measured", {"color": RED, "marker": "o"}))


def name(effect, strain):
    return f"{effect}, {strain}" if strain else effect


@figure("contraction", "effects", table="rates")
def rates(frame):
    """Measured rate, the solver's prediction and the effect's bound over the dense spectral radius, a panel an effect."""
    drawn = frame[drawable(frame, ["predicted_rate"]) & (frame["predicted_rate"] >= LEAST)]
    if drawn.empty:
        return None
    groups = list(drawn.groupby(["effect", "strain"], sort=False))
    fig, axes = panels(len(groups), columns=3, height=2.0, sharex=True, sharey=True)
    for ax, ((effect, strain), rows) in zip(axes, groups):
        panel(ax, rows)
        ax.set_title(name(effect, strain))
    fig.supxlabel("dense spectral radius", fontsize=8)
    fig.supylabel("contraction, error per iteration", fontsize=8)
    shared_legend(fig, axes, columns=3)
    above = sum(int((drawn[column] > MOST).sum()) for column, *_ in SHOWN)
    high = f"Arrows on the upper edge: {above} values above {MOST:g}. " if above else ""
    absent = sorted(set(name(*key) for key in zip(frame["effect"], frame["strain"])) -
                    set(name(*key) for key, _ in groups))
    still = f"Always below {LEAST:g}: {', '.join(absent)}. " if absent else ""
    footnote(fig, f"{len(frame) - len(drawn)} cases with a radius below {LEAST:g} are not drawn, other values below stand on "
             "the lower edge. " + high + still + reasons_note(failed(drawn, "measured_rate")))
    return fig


def panel(ax, rows):
    """Filled markers: stiffening decides the rate; open ones: compression does."""
    stiff = stiffens(rows)
    for column, label, look in SHOWN:
        for filled in (True, False):
            points = good(rows[stiff == filled], column) if column == "measured_rate" else \
                rows[(stiff == filled) & drawable(rows, [column])]
            shown = points[points[column] <= MOST]
            ax.plot(shown["predicted_rate"], shown[column].clip(LEAST), linestyle="none", markersize=3,
                    markerfacecolor=look["color"] if filled else "white", markeredgewidth=0.7,
                    label=f"{label}, {'tension' if filled else 'compression'}", **look)
        high = rows[rows[column] > MOST]
        ax.plot(high["predicted_rate"], np.full(len(high), MOST), linestyle="none", marker=r"$\uparrow$", markersize=6,
                color=look["color"])
    draw_failed(ax, failed(rows, "measured_rate"), "predicted_rate", "measured_rate", dict(SHOWN[-1][2]))
    line = np.array([LEAST, on_log(rows["predicted_rate"]).max()])
    ax.plot(line, line, color=BLACK, linewidth=0.5, label="equal to the radius")
    ax.axvline(1, color=BLACK, linestyle="--", linewidth=0.6)
    ax.set(xscale="log", yscale="log")
