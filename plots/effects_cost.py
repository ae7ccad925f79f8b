"""What does each effect cost, and does the cost grow with the rows?"""

from common import curve_points, figure, footnote, panels
from finding import fewer, finding, name_lines
from styles import BLUE, style
from selecting import failed, good, reasons_note, text_number
from wording import counted, number, share, span


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


@figure("effects_cost", "bytes", table="costs")
def bytes_per_row(frame):
    """Memory of an effect's rows."""
    return bars(frame.assign(value=frame["bytes"] / frame["rows"]), "bytes per row", "A row takes")


@figure("effects_cost", "seconds", table="costs")
def seconds_per_row(frame):
    """Time an effect's rows took in one step of the run."""
    return bars(frame.assign(value=frame["wall_s_per_step"] / frame["rows"] * 1e6), "wall time per row and step (µs)", "A row and step take")


def bars(frame, label, said):
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
    ends = len(rows) and f" ({rows.loc[rows['value'].idxmin(), 'name']}) to {number(rows['value'].max())} ({rows.loc[rows['value'].idxmax(), 'name']})"
    finding(fig, f"{said} from {number(rows['value'].min())}{ends} {label.split(' per ')[0] if 'bytes' in label else 'µs'}" if len(rows)
            else f"None of {counted(len(frame), 'effect')} has a number")
    missing = ", ".join(bad["effect"] + " in " + bad["scene"])
    footnote(fig, f"Not drawn, no number: {missing}" if missing else "")
    return fig
