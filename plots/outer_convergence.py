"""Does the outer iteration reach the solution of the step, and at which rate?"""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LogNorm

from common import curve, draw_failed, figure, footnote, on_log, panels, shared_legend
from finding import fewer, finding, first_and_last, guide
from styles import BLACK, BLUE, RED, style
from reading import CONTRACTING, LARGEST
from selecting import drawable, failed, good, reasons_note, scene_text, step_text, text_number
from wording import counted, number, share, span

REACHED = 1e-8  # an error against Newton that counts as the solution
CASE = ["scene", "step_s", "mass_ratio"]


def cases(frame):
    """(title, rows) of the first and the last case of each scene: its smallest and its largest step and mass ratio."""
    several = frame.groupby("scene")["mass_ratio"].nunique() > 1
    found = []
    for (scene, step, ratio), rows in frame.groupby(CASE):
        mass = f", mass ratio {text_number(ratio)}" if several[scene] else ""
        found.append((scene, f"{scene_text(scene)}\nh = {step_text(step)}{mass}", rows))
    return [case[1:] for case in first_and_last(found, lambda case: case[0])]


def last_rows(frame, keys):
    return frame.sort_values(keys[-1]).groupby(keys[:-1], sort=False).tail(1)


def look(outer, relaxation):
    """Colour tells the outer iteration; marker and line tell whether sweeps solve its problems."""
    chosen = style(outer)
    if relaxation == "gauss_seidel":
        chosen |= {"marker": "v", "linestyle": (0, (1, 1)), "color": BLUE if outer == "incremental" else chosen["color"]}
    if relaxation == "nesterov_jacobi":
        chosen |= {"marker": "x", "linestyle": (0, (1, 1))}
    return chosen


def error_curves(frame, names):
    """Error against outer iteration for some outer iterations, one panel a case."""
    frame = frame[frame["outer"].isin(names)]
    if frame.empty:
        return None
    chosen, left = fewer(cases(frame))
    fig, axes = panels(len(chosen), columns=3, height=1.8, sharey=True)
    for ax, (title, rows) in zip(axes, chosen):
        for (outer, relaxation), trace in rows.groupby(["outer", "relaxation"], sort=False):
            curve(ax, trace, "iteration", "error", f"{outer}, {relaxation}", look(outer, relaxation))
        ax.set(yscale="log", title=title)
        ax.title.set_fontsize(7)
    fig.supxlabel("outer iteration", fontsize=8)
    fig.supylabel("error against Newton, relative", fontsize=8)
    shared_legend(fig, axes)
    ends = last_rows(frame, [*CASE, "outer", "relaxation", "iteration"])
    reached = []
    for (outer, relaxation), rows in ends.groupby(["outer", "relaxation"], sort=False):
        name = f"{outer} with {relaxation}" if ends[ends["outer"] == outer]["relaxation"].nunique() > 1 else outer
        reached.append(f"{name} {share((good(rows, 'error')['error'] <= REACHED).sum(), len(rows))}")
    finding(fig, f"Cases brought to within {number(REACHED)} of Newton's step: " + ", ".join(reached))
    footnote(fig, f"Drawn: {len(chosen)} of {counted(len(ends[CASE].drop_duplicates()), 'case')}, each scene's mildest and "
             f"hardest. {left}" + reasons_note(failed(ends, "error")))
    return fig


@figure("outer_convergence", "errors", table="errors")
def errors(frame):
    return error_curves(frame, ["plain", "incremental", "frozen"])


@figure("outer_convergence", "proximal", table="errors")
def proximal(frame):
    keeping = ["plain", "proximal", "auto"]
    frame = frame[frame["relaxation"] != "nesterov_jacobi"]
    compared = frame.groupby(CASE)["outer"].transform(lambda names: names.isin(keeping[1:]).any())
    return error_curves(frame[compared], keeping)


def contracts(frame):
    """How many cases contract, and how many of these theory predicts."""
    falls = frame["behaviour"].isin(CONTRACTING)
    below = frame["predicted_rate"] < 1
    return (f"plain converges in {share(falls.sum(), len(frame))} cases: in {share((falls & below).sum(), below.sum())} of a "
            f"predicted rate below 1, in {share((falls & ~below).sum(), (~below).sum())} of the others")


@figure("outer_convergence", "map", table="map")
def rate_map(frame):
    """Measured rate of the plain iteration over step and mass ratio, with the line where theory predicts 1."""
    frame = frame[(frame["outer"] == "plain") & (frame["mass_ratio"] > 0)]
    sizes = frame.groupby("scene")[["step_s", "mass_ratio"]].nunique().min(axis=1)
    scenes, left = fewer(sizes.index[sizes > 1])
    if not scenes:
        return None
    fig, axes = panels(len(scenes), columns=2, height=2.4)
    for ax, scene in zip(axes, scenes):
        mesh = map_panel(ax, frame[frame["scene"] == scene])
        ax.set(title=scene, xlabel="step", ylabel="mass ratio, heaviest to lightest node")
    fig.colorbar(mesh, ax=axes, label="measured rate, error per iteration", extend="both")
    handles = [plt.Line2D([], [], color=BLACK, linestyle="--"), plt.Line2D([], [], color=BLACK, marker="x", linestyle="")]
    fig.legend(handles, ["predicted rate = 1", "error does not fall steadily; grey: no rate to measure"],
               loc="upper center", bbox_to_anchor=(0.5, 0), ncol=2)
    finding(fig, f"On {' and '.join(scenes)} " + contracts(frame[frame["scene"].isin(scenes)]))
    footnote(fig, left + reasons_note(failed(frame, "measured_rate")))
    return fig


def map_panel(ax, rows):
    measured = rows.pivot_table("measured_rate", "mass_ratio", "step_s", dropna=False)
    predicted = rows.pivot_table("predicted_rate", "mass_ratio", "step_s", dropna=False).reindex_like(measured)
    measured = measured.where(measured <= LARGEST)
    x, y = measured.columns.to_numpy(), measured.index.to_numpy()
    mesh = ax.pcolormesh(edges(x), edges(y), on_log(measured.to_numpy()), norm=LogNorm(0.05, 1), cmap="cividis")
    ax.set(xscale="log", yscale="log", facecolor="#bbbbbb")
    ax.set_xticks(x, [step_text(step) for step in x])
    ax.set_yticks(y, [text_number(ratio) for ratio in y])
    ax.minorticks_off()
    ax.grid(False)
    known = predicted.where((predicted > 0) & (predicted <= LARGEST))
    if (known < 1).any(axis=None) and (known > 1).any(axis=None):
        ax.contour(x, y, np.log(known), levels=[0.0], colors=BLACK, linestyles="--")
    for (i, j), rate in np.ndenumerate(measured.to_numpy()):
        if np.isfinite(rate):
            ax.text(x[j], y[i], f"{rate:.2g}", ha="center", va="center", fontsize=6, color="white" if rate < 0.2 else BLACK)
    bad = rows[~rows["behaviour"].isin(CONTRACTING)]
    ax.plot(bad["step_s"], bad["mass_ratio"], "x", color=BLACK, markersize=4, markeredgewidth=0.8)
    return mesh


def edges(centres):
    """Cell edges around centres on a logarithmic axis."""
    middles = np.sqrt(centres[1:] * centres[:-1])
    return np.concatenate([[centres[0] ** 2 / middles[0]], middles, [centres[-1] ** 2 / middles[-1]]])


@figure("outer_convergence", "predicted_rate", table="map")
def predicted_rate(frame):
    """Measured against predicted rate, every case of the plain iteration."""
    frame = frame[frame["outer"] == "plain"]
    fig, (ax,) = panels(1, height=2.7)
    rows = good(frame, "predicted_rate", "measured_rate")
    for scene, group in rows.groupby("scene"):
        look = style(scene) | {"linestyle": "none"}
        ax.plot(group["predicted_rate"], on_log(group["measured_rate"]), label=scene, markerfacecolor="white", **look)
    draw_failed(ax, failed(frame, "predicted_rate", "measured_rate"), "predicted_rate", "measured_rate")
    ends = rows["predicted_rate"].replace(0, np.nan).dropna()
    line = np.array([ends.min() * 0.7, ends.max() * 1.4]) if len(ends) else np.array([0.1, 10])
    ax.plot(line, line, color=BLACK, linewidth=0.5)
    ax.fill_between(line, 0.95 * line, 1.05 * line, color="#cccccc", linewidth=0, label="measured = predicted, within 5 %")
    ax.set(xscale="log", yscale="log", xlabel="predicted rate, spectral radius", ylabel="measured rate")
    guide(ax, 1, "predicted rate = 1", horizontal=False)
    shared_legend(fig, [ax], columns=3)
    off = abs(rows["measured_rate"] / rows["predicted_rate"] - 1)[rows["predicted_rate"] > 0]
    finding(fig, contracts(frame)[0].upper() + contracts(frame)[1:],
            f"Where a rate is measured it is the predicted one to {100 * off.max():.2g} %" if len(off) else "")
    footnote(fig, reasons_note(failed(frame, "predicted_rate", "measured_rate")))
    return fig


@figure("outer_convergence", "residuals", table="residuals")
def residuals(frame):
    """What each end leaves of its step's equations: one line a scene, a mark an outer iteration."""
    scenes = list(frame["scene"].unique())
    fig, (ax,) = panels(1, height=0.3 * len(scenes) + 0.6)
    for (outer, relaxation), rows in frame.groupby(["outer", "relaxation"], sort=False):
        rows = rows.assign(place=rows["scene"].map(scenes.index) + 1)
        seen, chosen = good(rows, "residual_share"), look(outer, relaxation) | {"linestyle": "none"}
        ax.plot(on_log(seen["residual_share"]), seen["place"], markerfacecolor="white", label=f"{outer}, {relaxation}", **chosen)
        draw_failed(ax, failed(rows, "residual_share"), "residual_share", "place", chosen)
    ax.set(xscale="log", xlabel="|v - v_free| that no impulses explain, as part of it", ylim=(0.5, len(scenes) + 0.5))
    ax.set_yticks(range(1, len(scenes) + 1), scenes)
    shared_legend(fig, [ax])
    finding(fig, "Of a step's correction the impulses at its end leave open " + ", ".join(
        f"{span(rows['residual_share'])} by {outer}"
        for outer, rows in frame[drawable(frame, ["residual_share"])].groupby("outer", sort=False))
        if drawable(frame, ["residual_share"]).any() else f"None of {counted(len(frame), 'end')} is known")
    footnote(fig, reasons_note(failed(frame, "residual_share")))
    return fig


@figure("outer_convergence", "pendulum", table="map")
def pendulum(frame):
    """The pendulum's rates, measured and predicted, over the step."""
    frame = frame[(frame["outer"] == "plain") & (frame["scene"] == "pendulum")].sort_values("step_s")
    if frame.empty:
        return None
    fig, (ax,) = panels(1, height=2.2)
    rows = good(frame, "measured_rate")
    ax.plot(frame["step_s"], frame["predicted_rate"], "--", color=BLACK, label="predicted, h² T/(m l)")
    ax.plot(rows["step_s"], on_log(rows["measured_rate"]), "o", color=RED, markersize=6, markerfacecolor="none",
            label="measured")
    for _, row in rows.iterrows():
        ax.annotate(f"{row['measured_rate']:.4g}", (row["step_s"], row["measured_rate"]), xytext=(6, -8),
                    textcoords="offset points", fontsize=7)
    draw_failed(ax, failed(frame, "measured_rate"), "step_s", "measured_rate")
    ax.set(xscale="log", yscale="log", xlabel="step (s)", ylabel="rate, error per outer iteration")
    ax.set_xticks(frame["step_s"].unique(), [text_number(step) for step in frame["step_s"].unique()])
    ax.set_xticks([], minor=True)
    ax.margins(0.15)
    shared_legend(fig, [ax])
    off = abs(rows["measured_rate"] / rows["predicted_rate"] - 1)
    finding(fig, f"On the pendulum plain contracts as h² T/(m l) says, to {100 * off.max():.2g} % at {counted(len(rows), 'step')}"
            if len(rows) else f"plain contracts at none of {counted(len(frame), 'step')} of the pendulum")
    footnote(fig, reasons_note(failed(frame, "measured_rate")))
    return fig
