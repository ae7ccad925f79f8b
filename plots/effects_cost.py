"""What does each effect cost, and does the cost grow with the rows?"""

import numpy as np

from common import curve_points, figure, footnote, panels
from finding import fewer, finding, name_lines
from styles import BLUE, style
from selecting import failed, good, reasons_note, text_number
from wording import counted, number, share, span


# How an effect of the table `absent` is there, and how a sentence says it.
PRESENCE = {"control": "", "empty": "empty {effect}", "never touches": "{effect} that {case}", "idle": "{effect} with {case}", "used": "{effect}"}
LINEAR = 3  # %, of the changes of a time

ALLOWED = 1.1  # exponent of the time of a sweep over the rows, as the verdicts ask


@figure("effects_cost", "scaling", table="scaling")
def scaling(frame):
    """Time of a sweep and row over the number of rows: level where the cost is linear; shaded what the exponent forbids."""
    frame = frame.assign(row_ns=1e9 * frame["wall_s_per_sweep"] / frame["rows"])
    scenes, left = fewer(frame["scene"].unique())
    fig, axes = panels(len(scenes), columns=2, height=2.2, sharey=True)
    for ax, scene in zip(axes, scenes):
        here = frame[frame["scene"] == scene]
        for relaxation, points in here.groupby("relaxation", sort=False):
            exponent = points["exponent"].dropna()
            label = f"{relaxation}: {exponent.iloc[-1]:.2f}" if len(exponent) else relaxation
            curve_points(ax, points, "rows", "row_ns", label, style(relaxation))
            fewest = good(points, "rows", "row_ns").sort_values("rows").head(1)
            for x, y in zip(fewest["rows"], fewest["row_ns"]):
                most = points["rows"].max()
                ax.plot([x, most], [y, y * (most / x) ** (ALLOWED - 1)], ":", color=style(relaxation)["color"], linewidth=0.8)
        ax.set(xscale="log", title=scene, xlabel="rows", ylim=(0, None))
        name_lines(ax)
    axes[0].set_ylabel("time of a sweep and row (ns)")
    exponents = frame.drop_duplicates(["scene", "relaxation"])["exponent"].dropna()
    finding(fig, f"The time of a sweep grows with the power {span(exponents)} of the rows; "
            f"{share((exponents <= ALLOWED).sum(), len(exponents))} exponents are at most {ALLOWED:g}")
    footnote(fig, "Beside the lines: exponents; dotted: as much as the bound allows from the smallest problem on. " + left +
             reasons_note(failed(frame, "rows", "wall_s_per_sweep")))
    return fig


@figure("effects_cost", "absent", table="absent")
def absent(frame):
    """Time of a step with an effect that nothing uses, over that of the scene without it, with the range of the repeats."""
    order = {presence: i for i, presence in enumerate(PRESENCE)}
    rows = good(frame, "time_ratio").sort_values("presence", key=lambda column: column.map(order), kind="stable")
    fig, (ax,) = panels(1, height=0.2 * max(len(rows), 2) + 0.6)
    names = rows["effect"] + ", " + rows["case"]
    change, low, high = (100 * (rows[column] - 1) for column in ("time_ratio", "time_low", "time_high"))
    ax.errorbar(change, names, xerr=[(change - low).clip(lower=0), (high - change).clip(lower=0)], fmt="o", color=BLUE, markersize=4, capsize=2)
    ax.axvline(0, color="black", linewidth=0.8)
    for row in np.flatnonzero(rows["presence"].to_numpy()[1:] != rows["presence"].to_numpy()[:-1]):
        ax.axhline(row + 0.5, color="black", linewidth=0.4)
    ax.invert_yaxis()
    ax.set_xscale("symlog", linthresh=LINEAR)
    ax.xaxis.set_major_formatter("{x:g}")
    ax.set(xlabel="change of a step's time (%)")
    told = [f"{number(of_all.max())} % by {said.format(**rows.loc[of_all.idxmax()])}" for presence, said in PRESENCE.items()
            if said and len(of_all := change[rows["presence"] == presence].abs())]
    finding(fig, f"The most that a step's time changes: {'; '.join(told)}" if told else f"None of {counted(len(frame), 'effect')} has a number")
    begun = good(rows, "first_longer_steps").query("first_longer_steps > 1").sort_values("first_longer_steps").tail(1)
    footnote(fig, "A sheet of 225 nodes falls, 64 balls rest on a ground, or a chain of 50 rods falls. Dots: median of the repeats; bars: their "
             f"range; logarithmic beyond {LINEAR} %. Without each run's first step" +
             "".join(f", which takes longer by up to {number(row['first_longer_steps'])} later steps ({row['effect']}, {row['case']})"
                     for _, row in begun.iterrows()) + ".")
    return fig


@figure("effects_cost", "stripped", table="stripped")
def stripped(frame):
    """Time of a sweep by the solver over that of the least loop that does the same."""
    rows = good(frame, "ratio")
    fig, (ax,) = panels(1, height=0.2 * max(len(rows), 2) + 0.6)
    ax.errorbar(rows["ratio"], rows["scene"], xerr=[(rows["ratio"] - rows["ratio_low"]).clip(lower=0), (rows["ratio_high"] - rows["ratio"]).clip(lower=0)],
                fmt="o", color=BLUE, markersize=4, capsize=2)
    ax.axvline(1, color="black", linewidth=0.8)
    ax.set(xlabel="time of a sweep over that of the least loop", xlim=(0, None))
    finding(fig, f"A sweep takes {span(rows['ratio'])} of the time of the least loop" if len(rows)
            else f"None of {counted(len(frame), 'scene')} has a number")
    footnote(fig, "The least loop knows one kind of rows and sums no residual. Bars: range of the repeats.")
    return fig


@figure("effects_cost", "bytes", table="costs")
def bytes_per_row(frame):
    """Memory of an effect's rows."""
    return bars(frame.assign(value=frame["bytes"] / frame["rows"]), "bytes per row", "bytes", "A row takes")


@figure("effects_cost", "seconds", table="costs")
def seconds_per_row(frame):
    """Time an effect's rows took in one step of the run."""
    return bars(frame.assign(value=frame["wall_s_per_step"] / frame["rows"] * 1e6), "wall time per row and step (µs)", "µs",
                "A row and step take")


def bars(frame, label, unit, said):
    frame = frame[frame["rows"] > 0]  # what is outside the effects has no rows
    rows = good(frame, "value").assign(name=lambda rows: rows["effect"] + ", " + rows["scene"])
    bad = failed(frame, "value")
    fig, (ax,) = panels(1, height=0.2 * max(len(rows), 2) + 0.6)
    ax.barh(rows["name"], rows["value"], color=BLUE, height=0.6)
    for i, value in enumerate(rows["value"]):
        ax.text(value, i, " " + text_number(value), va="center", fontsize=7)
    ax.invert_yaxis()
    ax.grid(axis="y", visible=False)
    ax.set(xlabel=label)
    if len(rows):
        low, high = (f"{number(rows['value'][k])} {unit} ({rows['name'][k]})" for k in (rows["value"].idxmin(), rows["value"].idxmax()))
    finding(fig, f"{said} from {low} to {high}" if len(rows) else f"None of {counted(len(frame), 'effect')} has a number")
    missing = ", ".join(bad["effect"] + " in " + bad["scene"])
    footnote(fig, f"Not drawn, no number: {missing}" if missing else "")
    return fig
