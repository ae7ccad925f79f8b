"""How do random scenes end, is every step that says ok one, and is its answer the only one?"""

import numpy as np

from common import draw_failed, figure, footnote, on_log, panels, shared_legend
from styles import BLACK, FALLBACK, style
from selecting import failed, good, reasons_note

# Of a variant's first step beside that of the scene as it is.
OUTCOMES = ("the same", "told apart by the tolerance alone", "another solution", "not told", "one missed")


@figure("generated_scenes", "outcomes", table="outcomes")
def outcomes(frame):
    """Bars of the steps of each relaxation by outcome and reason."""
    kinds = frame.assign(kind=frame["status"] + frame["reason"].map(lambda text: f": {text}" if text else ""))
    relaxations = list(frame["relaxation"].unique())
    fig, (ax,) = panels(1, height=0.3 * len(relaxations) + 0.8)
    fig.set_figwidth(6.5)
    left = np.zeros(len(relaxations))
    for k, (kind, rows) in enumerate(sorted(kinds.groupby("kind"), key=lambda entry: entry[0] != "ok")):
        width = rows.groupby("relaxation")["steps"].sum().reindex(relaxations).fillna(0).to_numpy()
        ax.barh(relaxations, width, left=left, height=0.6, label=kind, color=FALLBACK[k % len(FALLBACK)][0],
                edgecolor="white", hatch="" if k < len(FALLBACK) else "//")
        left += width
    ax.invert_yaxis()
    ax.grid(axis="y", visible=False)
    ax.set(xlabel="steps")
    shared_legend(fig, [ax], columns=2)
    return fig


@figure("generated_scenes", "sample", table="sample")
def sample(frame):
    """The error against Newton's method over the judge's residual, as part of what ok allows."""
    fig, (ax,) = panels(1, height=2.8)
    for relaxation, rows in frame.groupby("relaxation", sort=False):
        look = style(relaxation)
        shown = good(rows, "claim", "error")
        ax.plot(on_log(shown["claim"]), on_log(shown["error"]), look["marker"], color=look["color"], label=relaxation,
                markerfacecolor="none", markersize=4)
        draw_failed(ax, failed(rows[rows["claim"] > 0], "claim", "error"), "claim", "error",
                    {"color": look["color"], "marker": look["marker"]})
    ax.axvline(1, color=BLACK, linewidth=0.8, linestyle=":", label="what ok allows")
    ax.set(xscale="log", yscale="log", xlabel="judge's residual over what status ok allows",
           ylabel="error against Newton, relative")
    shared_legend(fig, [ax])
    footnote(fig, reasons_note(failed(frame, "claim", "error")))
    return fig


@figure("generated_worlds", "agreement", table="agreement")
def agreement(frame):
    """Bars of the first steps of each variant by what became of them beside the scene as it is."""
    variants = list(frame["variant"].unique())
    fig, (ax,) = panels(1, height=0.3 * len(variants) + 0.8)
    fig.set_figwidth(6.5)
    left = np.zeros(len(variants))
    for k, outcome in enumerate(OUTCOMES):
        width = frame[frame["outcome"] == outcome].groupby("variant")["first_steps"].sum().reindex(variants).fillna(0).to_numpy()
        ax.barh(variants, width, left=left, height=0.6, label=outcome, color=FALLBACK[k][0], edgecolor="white")
        left += width
    ax.invert_yaxis()
    ax.grid(axis="y", visible=False)
    ax.set(xlabel="first steps")
    shared_legend(fig, [ax], columns=2)
    return fig
