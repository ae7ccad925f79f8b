"""Does the plain iteration contract in contact at the predicted rate?"""

from common import draw_failed, figure, footnote, on_log, panels, shared_legend
from finding import finding
from selecting import drawable, failed, good, reasons_note
from styles import BLACK, style
from wording import number, share

LEAST = 1e-3  # smaller rates are not drawn


@figure("contact_contraction", "radii", table="rates")
def radii(frame):
    """Radius of the solver's map over that of the judge's, a panel a state of the contacts, a mark a law; filled where plain does
    not return to the solution."""
    drawn = frame[drawable(frame, ["predicted_rate"]) & (frame["predicted_rate"] >= LEAST)]
    if drawn.empty:
        return None
    states = [(title, drawn[(drawn["sliding"] > 0) == slides]) for title, slides in (("contacts stick", False), ("contacts slide", True))]
    states = [(title, rows) for title, rows in states if len(rows)]
    fig, axes = panels(len(states), columns=2, height=2.7, sharex=True, sharey=True)
    for ax, (title, rows) in zip(axes, states):
        for law, own in rows.groupby("friction", sort=False):
            look = style(law)
            points = good(own, "measured_rate")
            for returns, face in ((1, "white"), (0, look["color"])):
                seen = points[points["returns"] == returns]
                ax.plot(seen["predicted_rate"], on_log(seen["measured_rate"]), markerfacecolor=face,
                        label=f"{law}, plain {'returns' if returns else 'does not return'}", **look | {"linestyle": "none"})
            draw_failed(ax, failed(own, "measured_rate"), "predicted_rate", "measured_rate", look | {"linestyle": "none"})
        line = [LEAST, drawn["predicted_rate"].max()]
        ax.plot(line, line, color=BLACK, linewidth=0.5, label="equal to the radius")
        ax.axvline(1, color=BLACK, linestyle="--", linewidth=0.6)
        ax.set(xscale="log", yscale="log", title=title)
    fig.supxlabel("spectral radius of the judge's map, error per iteration", fontsize=8)
    fig.supylabel("of the solver's map", fontsize=8)
    shared_legend(fig, axes, columns=3)
    seen = good(drawn, "measured_rate")
    beyond = seen["predicted_rate"] > 1
    finding(fig, f"The solver's radius differs from the judge's by at most {number(abs(seen['measured_rate'] / seen['predicted_rate'] - 1).max())}",
            f"plain returns in {share(int(seen.loc[~beyond, 'returns'].sum()), int((~beyond).sum()))} cases below 1, in "
            f"{share(int(seen.loc[beyond, 'returns'].sum()), int(beyond.sum()))} above")
    footnote(fig, reasons_note(failed(frame, "predicted_rate", "measured_rate")))
    return fig
