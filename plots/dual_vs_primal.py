"""Does the dual (constraint) solution equal the minimum of the primal (elastic) energy?"""

import numpy as np
from matplotlib.colors import LogNorm

from common import curve, figure, footnote, on_log, panels, shared_legend
from finding import fewer, finding
from styles import PURPLE, SKY, style
from reading import LARGEST
from selecting import failed, reasons_note, text_number
from wording import number, share

REACHED = 1e-8  # an error that counts as the solution
METHOD = ["outer", "relaxation"]
MATERIAL = ["scene", "strain", "young_pa", "poisson"]


def look(outer, relaxation):
    """That of the relaxation; where the outer iteration is incremental, one of its own."""
    if outer != "incremental":
        return style(relaxation)
    return {"direct": {"color": PURPLE, "marker": "*", "linestyle": ":"}}.get(
        relaxation, {"color": SKY, "marker": "v", "linestyle": "--"})


@figure("dual_vs_primal", "errors", table="errors")
def errors(frame):
    """One panel a mesh and strain, at the middle stiffness of each and the smallest Poisson's ratio."""
    frame = frame[frame["poisson"] == frame["poisson"].min()]
    frame = frame[frame["young_pa"] == frame.groupby(["scene", "strain"])["young_pa"].transform(middle)]
    groups, left = fewer(frame.groupby(["scene", "strain", "young_pa"]))
    if not groups:
        return None
    fig, axes = panels(len(groups), columns=3, height=1.9, sharex=True, sharey=True)
    for ax, ((scene, strain, young), rows) in zip(axes, groups):
        for (outer, relaxation), trace in rows.groupby(METHOD, sort=False):
            curve(ax, trace, "sweeps", "error", f"{outer}, {relaxation}", look(outer, relaxation))
            if (outer == "incremental" or relaxation == "xpbd") and (trace["status"] != "ok").all():
                draw_floor(ax, trace)
        ax.set_xscale("symlog", linthresh=1)
        ax.set(xlim=(-0.3, None), yscale="log", title=f"{scene}, {strain}, E = {text_number(young)} Pa")
        ax.title.set_fontsize(7)
    fig.supxlabel("sweeps", fontsize=8)
    fig.supylabel("error against Newton on the energy, relative", fontsize=8)
    shared_legend(fig, axes)
    ends = frame.sort_values("sweeps").groupby(MATERIAL + ["elements"] + METHOD, sort=False).tail(1)
    finding(fig, f"Traces that end within {number(REACHED)} of the energy's minimum: " + solved_by(ends))
    footnote(fig, f"Poisson's ratio {text_number(frame['poisson'].min())}; grey: where incremental and xpbd stay. {left}" +
             reasons_note(failed(ends, "error")))
    return fig


def middle(values):
    there = sorted(set(values))
    return there[len(there) // 2]


def solved_by(ends):
    """In how many cases each outer iteration, and each rival, ends at the solution, whether it says so or not."""
    names = ends["outer"].where(ends["outer"] != "rival", ends["relaxation"])
    near = names[ends["error"] <= REACHED]
    return ", ".join(f"{name} {share(near.eq(name).sum(), len(rows))}" for name, rows in ends.groupby(names, sort=False))


def draw_floor(ax, trace):
    """A line where a trace stays: its second half no better than its middle."""
    half = trace["error"].iloc[len(trace) // 2:]
    floor = half.min()
    if np.isfinite(floor) and half.iloc[0] < 1.1 * floor:
        ax.axhline(on_log(floor), color="#888888", linewidth=0.6)


@figure("dual_vs_primal", "final", table="final")
def final(frame):
    """Final error of every method and material as a table of colours; the cells with a cross are not ok."""
    frame = frame.assign(row=frame.apply(material, axis=1), column=frame["outer"] + "\n" + frame["relaxation"])
    rows, columns = list(frame["row"].unique()), list(frame["column"].unique())
    fig, (ax,) = panels(1, height=0.18 * len(rows) + 0.8)
    values = np.full((len(rows), len(columns)), np.nan)
    for _, cell in frame.iterrows():
        i, j = rows.index(cell["row"]), columns.index(cell["column"])
        values[i, j] = on_log(cell["error"]) if cell["error"] <= LARGEST else np.nan
        label = text_number(cell["error"]) if np.isfinite(cell["error"]) else "none"
        dark = np.isfinite(values[i, j]) and values[i, j] < 1e-8
        ax.text(j, i, label + ("" if cell["status"] == "ok" else "×"), ha="center", va="center", fontsize=5.5,
                color="white" if dark else "black")
    image = ax.imshow(values, norm=LogNorm(1e-12, 1), cmap="cividis", aspect="auto")
    ax.set_facecolor("#dddddd")
    ax.set_xticks(range(len(columns)), [name.replace("_", "_\n") for name in columns], fontsize=5)
    ax.set_yticks(range(len(rows)), rows, fontsize=6)
    ax.grid(False)
    fig.colorbar(image, ax=ax, label="error against Newton, relative", extend="both")
    finding(fig, f"Runs within {number(REACHED)} of the energy's minimum: " + solved_by(frame))
    footnote(fig, "In brackets the number of elements. " + reasons_note(failed(frame, "error")))
    return fig


def material(row):
    return (f"{row['scene']} ({row['elements']:.0f}), {row['strain']}, E {text_number(row['young_pa'])} Pa, "
            f"ν {text_number(row['poisson'])}")
