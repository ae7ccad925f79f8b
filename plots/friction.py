"""Contact beside known answers: the errors of every quantity, friction over the heading, and the convex law's gap."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

from common import curve_points, draw_failed, figure, footnote, on_log, panels, shared_legend, ticks
from finding import beyond, finding, guide, name_lines
from selecting import failed, good, reasons_note, text_number
from strips import EDGES, strip, strips, verdict
from styles import BLACK, style
from wording import counted, number, share, some, span

ALLOWED = 1e-6  # of the deceleration and of the heading, as the verdicts ask


def answers(frame):
    """Every error over its bound, a row a quantity; what has no bound is told in the title."""
    judged, free = frame[frame["bound"].notna()], good(frame[frame["bound"].isna()], "error")
    rows = judged.assign(row=judged["quantity"], ratio=judged["error"] / judged["bound"], who=judged["friction"] + " law",
                         holds=judged["status"].eq("ok") & (judged["error"] <= judged["bound"]))
    unjudged = [f"{quantity.replace('_', ' ')} by {friction}, up to {number(here['error'].max())} {here['unit'].iloc[0]}"
                for (quantity, friction), here in free.groupby(["quantity", "friction"], sort=False)]
    lost = frame[frame["bound"].isna()].drop(free.index)
    return strips(rows, "error", reasons_note(failed(judged, "error")),
                  extra=("Without a bound: " + some(unjudged) if unjudged else "") +
                  (f"{counted(len(lost), 'run')} without a bound did not end well" if len(lost) and not unjudged else ""))


for experiment in ("incline", "stopping", "restitution", "stack", "coupling"):
    figure(experiment, "answers", table="answers")(answers)


@figure("friction_isotropy", "headings", table="headings")
def headings(frame):
    """Left the deceleration over the heading, as a polar curve; right the errors over their bounds."""
    fig = plt.figure(figsize=(6.5, 3.3), layout="none")
    polar, ax = fig.add_axes([0.02, 0.05, 0.4, 0.66], projection="polar"), fig.add_axes([0.62, 0.3, 0.22, 0.3])
    shown = good(frame, "heading_deg", "deceleration_share")
    sizes = {law: 7 - 1.5 * k for k, law in enumerate(dict.fromkeys(frame["friction"]))}
    for law, rows in shown.groupby("friction", sort=False):
        rows = rows.drop_duplicates("heading_deg").sort_values("heading_deg")
        polar.plot(np.deg2rad(rows["heading_deg"]), rows["deceleration_share"], label=law,
                   **style(law) | {"linestyle": "none", "markerfacecolor": "none", "markersize": sizes[law]})
    largest = shown["deceleration_share"].max() if len(shown) else 1.0
    polar.set(rlim=(0, 1.15 * largest))
    polar.set_title("deceleration over mu g, by heading", pad=4)
    polar.tick_params(pad=-2)
    polar.set_rgrids([0.5, 1], angle=80)
    checks = checked(frame)
    strip(ax, checks)
    shared_legend(fig, [polar])
    spreads = [f"{law} {span_of(rows)}" for law, rows in shown.groupby("friction", sort=False)]
    finding(fig, f"Over {counted(frame['heading_deg'].nunique(), 'heading')} friction slows by these shares of mu g: " +
            "; ".join(spreads) if spreads else f"None of {counted(len(frame), 'run')} ended well", verdict(checks, "error"))
    footnote(fig, EDGES + reasons_note(failed(frame, "share_error", "heading_error_rad")))
    return fig


def span_of(rows):
    """Smallest and largest share, to a hundredth."""
    low, high = rows["deceleration_share"].min(), rows["deceleration_share"].max()
    return f"{low:.2f}" if round(low, 2) == round(high, 2) else f"{low:.2f} to {high:.2f}"


def checked(frame):
    """Errors of deceleration and heading as rows of a strip."""
    parts = []
    for column, what in (("share_error", "deceleration"), ("heading_error_rad", "heading")):
        for law, rows in frame.groupby("friction", sort=False):
            parts.append(rows[["friction", column, "status"]].assign(
                row=f"error of {what}", ratio=rows[column] / ALLOWED, who=law,
                holds=rows["status"].eq("ok") & (rows[column] <= ALLOWED)))
    return pd.concat(parts, ignore_index=True)


@figure("convex_gap", "gaps", table="gaps")
def gaps(frame):
    """The largest gap of any relaxation over the step, a line a law; solid h mu v."""
    fig, (ax,) = panels(1, height=2.6)
    shown = good(frame, "gap_m")
    line = frame[frame["expected_m"] > 0].drop_duplicates("step_s").sort_values("step_s")
    ax.plot(line["step_s"], line["expected_m"], color=BLACK, linewidth=0.8, label="h mu v")
    for law, rows in shown.groupby("friction", sort=False):
        worst = rows.groupby("step_s", as_index=False)["gap_m"].max()
        ax.plot(worst["step_s"], on_log(worst["gap_m"]), label=law, markerfacecolor="none",
                **style(law) | {"linestyle": "none", "markersize": 5})
    draw_failed(ax, failed(frame, "gap_m"), "step_s", "gap_m")
    ax.set(xscale="log", yscale="log", xlabel="step (s)", ylabel="gap (m), largest of all relaxations")
    ticks(ax, frame["step_s"], lambda h: f"1/{1 / h:.0f}")
    name_lines(ax)
    convex, others = shown[shown["friction"] == "cone"], shown[shown["friction"] != "cone"]
    finding(fig, f"By the convex law a sliding box hovers by h mu v, {span(convex['gap_m'])} m, to {number(convex['error'].max())}"
            f" of it; by the other laws by at most {number(others['gap_m'].max())} m" if len(convex) and len(others) else
            f"{share(len(shown), len(frame))} runs ended well")
    footnote(fig, reasons_note(failed(frame, "gap_m")))
    return fig


@figure("restitution", "heights", table="heights")
def heights(frame):
    """Height of each bounce, one panel a coefficient of restitution; solid the known ones."""
    frame = frame[frame["relaxation"] == "direct"]
    if frame.empty:
        return None
    coefficients = list(frame.groupby("restitution", sort=True))[:6]
    fig, axes = panels(len(coefficients), columns=2, height=2.2, sharey=True)
    for ax, (restitution, here) in zip(axes, coefficients):
        for h, rows in here.groupby("step_s", sort=False):
            look = style(f"step {h}") | {"linestyle": "none"}
            curve_points(ax, rows, "bounce", "height_m", f"h = {text_number(h)} s", look)
        exact = here.drop_duplicates("bounce").sort_values("bounce")
        ax.plot(exact["bounce"], exact["expected_m"], color=BLACK, linewidth=0.8, label="restitution^(2 n) m")
        ax.set(yscale="log", title=f"restitution {restitution:g}", xlabel="bounce n")
        ax.set_xticks(exact["bounce"])
    axes[0].set_ylabel("height (m)")
    shared_legend(fig, axes)
    shown = good(frame, "height_m")
    off = abs(shown["height_m"] - shown["expected_m"])
    inside = off <= shown["allowed_m"]
    finding(fig, f"{share(inside.sum(), len(frame))} bounces are as high as the known ones, within what a step allows" +
            (f"; the farthest is {number(off.max())} m off" if len(off) else ""))
    footnote(fig, reasons_note(failed(frame, "height_m")))
    return fig


STANDS, FALLS = 1e-4, 0.1  # of the size: below it stands, above it falls; the verdicts ask for one of the two


@figure("stack", "thresholds", table="thresholds")
def thresholds(frame):
    """Largest displacement of structures just inside and just outside of their limits; between the lines none stands or
    falls."""
    groups = list(frame.groupby("structure", sort=False))[:6]
    fig, axes = panels(len(groups), columns=2, height=2.4, sharey=True)
    for ax, (structure, here) in zip(axes, groups):
        counts = sorted(here["count"].unique())
        beyond(ax, STANDS, FALLS)
        for (relaxation, outcome), rows in here.groupby(["relaxation", "outcome"], sort=False):
            shift = 0.1 if relaxation == "direct" else -0.1
            placed = rows.assign(place=[counts.index(count) + 1 + shift for count in rows["count"]])
            look = style(relaxation) | {"linestyle": "none"}
            look |= {"markerfacecolor": look["color"] if outcome == "falls" else "white"}
            curve_points(ax, placed, "place", "moved", f"{relaxation}: should fall" if outcome == "falls" else
                         f"{relaxation}: should stand", look)
        guide(ax, FALLS, "fell")
        guide(ax, STANDS, "stood below")
        ax.set_xticks(range(1, len(counts) + 1), [f"{count:.0f}" for count in counts])
        ax.set(yscale="log", title=structure, xlim=(0.5, len(counts) + 0.5), xlabel="bricks or stones")
    axes[0].set_ylabel("largest displacement over the size")
    shared_legend(fig, axes)
    right = frame["right"] == 1
    finding(fig, f"{share(right.sum(), len(frame))} structures beside their limit stand or fall as the limit says" +
            (f"; not: {some(frame['structure'][~right] + ' of ' + frame['count'][~right].map('{:.0f}'.format))}" if not right.all()
             else ""))
    footnote(fig, reasons_note(failed(frame, "moved")))
    return fig
