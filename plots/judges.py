"""Do independent references agree on the same step?"""

from common import BLUE, GREEN, RED, figure, footnote, on_log, panels, shared_legend
from reading import failed, good, reasons_note

SERIES = (("difference", "difference of the two", BLUE, "o"), ("residual_a", "residual of the first", RED, "s"),
          ("residual_b", "residual of the second", GREEN, "^"))


@figure("judges", "agreement", table="agreement")
def agreement(frame):
    """Difference and residuals of each pair, one line a scene."""
    frame = frame.reset_index(drop=True)
    frame["place"] = frame.index.astype(float)
    fig, (ax,) = panels(1, height=0.24 * max(len(frame), 3) + 0.7)
    for column, label, color, marker in SERIES:
        rows = good(frame, column)
        ax.plot(on_log(rows[column]), rows["place"], marker, color=color, label=label, markerfacecolor="white",
                markersize=5)
    for _, row in failed(frame, "difference").iterrows():
        ax.plot([0.98], [row["place"]], "X", color=BLUE, markersize=6, markerfacecolor="none",
                transform=ax.get_yaxis_transform(), clip_on=False)
    names = frame["scene"] + ": " + frame["reference_a"] + " / " + frame["reference_b"]
    ax.set_yticks(frame["place"], names)
    ax.invert_yaxis()
    ax.set(xscale="log", xlabel="relative difference, relative residual")
    shared_legend(fig, [ax], columns=3)
    footnote(fig, reasons_note(failed(frame, "difference")))
    return fig
