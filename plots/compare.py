"""Draws the table of a comparison, of a step or of motions."""

from itertools import cycle

import numpy as np

from command import command
from common import draw_failed, footnote, literal, on_log, panels, shared_legend
from finding import beyond, finding
from saving import save
from selecting import UNTOLD, failed, good, reasons_note, scene_text
from styles import FALLBACK
from reading import InputError, read_table
from tables import columns
from wording import number
from work_precision import draw_methods


def draw(frame):
    """Each method by the text that was given, with a look of its own."""
    looks = {method: dict(zip(("color", "marker", "linestyle"), look))
             for method, look in zip(frame["method"].unique(), cycle(FALLBACK))}
    if "duration_s" in frame:
        return draw_motions(frame, looks)
    return draw_methods(frame, "wall_s", "wall time (s)", frame["method"], lambda row: looks[row["method"]])


def draw_motions(frame, looks):
    """Error at the end over time, a mark a method; what the reference does not tell is shaded."""
    chart, (ax,) = panels(1, width=4.5, height=2.8)
    compared = frame[frame["outer"] != "reference"]
    reference, reached = frame[frame["outer"] == "reference"].iloc[0], good(compared, "error", "wall_s")
    for _, row in reached.iterrows():
        ax.plot([row["wall_s"]], [on_log(row["error"])], label=row["method"], **looks[row["method"]] | {"linestyle": "none"})
    for _, row in failed(compared, "error", "wall_s").iterrows():
        draw_failed(ax, compared[compared["method"] == row["method"]], "wall_s", "error", looks[row["method"]])
    least = UNTOLD * reference["error_bar"]
    told = reached.assign(told=np.maximum(reached["error"], least)).sort_values(["told", "wall_s"])
    shaded = len(reached) and least > 0.1 * reached["error"].min()
    if shaded:
        beyond(ax, 0.1 * least, least)
    ax.set(xscale="log", yscale="log", xlabel="wall time (s)", ylabel="error at the end, relative",
           title=f"{scene_text(reference['scene'])} to t = {reference['duration_s']:g} s")
    shared_legend(chart, [ax], columns=1)
    best = [f"Least error told: {number(row['told'], 2)} in {number(row['wall_s'], 2)} s by {row['method']}" for _, row in told.iterrows()]
    finding(chart, best[0] if best else "No method solves its steps to the end")
    footnote(chart, f"Reference: {reference['truth']}, error bar {number(reference['error_bar'], 2)}. "
                    + ("Shaded: below three of its error bars, where it tells no error. " if shaded else "") + reasons_note(failed(compared, "error", "wall_s")))
    return chart


def main(directory):
    """Writes DIR/figures/compare_seconds."""
    path = directory / "compare.csv"
    frame = read_table(path, columns(".", "compare"))
    if frame.empty:
        raise InputError(f"{path}: got no rows; at least one is needed")
    for i, row in frame.iterrows():
        if row["status"] == "ok" and not np.isfinite(row["error"]):
            raise InputError(f"{path}: line {i + 2}: column 'error': got {row['error']}; allowed where the status is ok: "
                             "a finite number")
    save(draw(literal(frame)), directory / "figures", "compare_seconds", f"pbdcheck compare: {path}")


if __name__ == "__main__":
    command(main, "Draws DIR/compare.csv, as `pbdcheck compare` writes it: DIR/figures/compare_seconds.{png,svg,pdf}.")
