"""What figures and report ask of the rows of a table. A row whose `status` is not `ok`, or whose value cannot be drawn, stays
visible: `good` and `failed` split a table so that every row is in one of the two."""

import re
import textwrap

import numpy as np
import pandas as pd

from reading import LARGEST


def drawable(frame, columns):
    """Which rows have numbers from 0 to LARGEST in all `columns`."""
    values = frame[list(columns)].to_numpy(dtype=float)
    return pd.Series(((values >= 0) & (values <= LARGEST)).all(axis=1), index=frame.index)


def good(frame, *columns):
    """The rows that are ok and whose `columns` are drawable."""
    ok = frame["status"].eq("ok") if "status" in frame else True
    return frame[ok & drawable(frame, columns)]


def failed(frame, *columns):
    """The rows `good` leaves out."""
    return frame.drop(good(frame, *columns).index)


def tightest(frame):
    """The rows of each relaxation's smallest tolerance; judges may be asked for another than the rest."""
    return frame[frame["tolerance"] == frame.groupby("relaxation")["tolerance"].transform("min")]


def rule_names(frame):
    """The integrator of each row, with newmark's alpha."""
    return frame["integrator"].where(frame["alpha"].isna(), frame["integrator"] + frame["alpha"].map(" {:g}".format))


def stiffens(frame):
    """The rows whose rate the stiffening part of the geometric stiffness decides, also where both parts are as large."""
    return frame["stiffening"] >= (1 - 1e-6) * frame["predicted_rate"]


UNTOLD = 3  # error bars of a true end, below which it tells no error


def told_runs(runs):
    """The runs with a `name` of their method, without step and tolerance, and the error that the truth can tell, `told`."""
    def name(row):
        parts = [row["outer"], *([row["relaxation"]] if row["relaxation"] not in ("none", row["outer"]) else [])]
        parts += [row["integrator"]] if row["integrator"] != "implicit_euler" else []
        parts += [row["friction"]] if row["friction"] not in ("coulomb", "none") else []
        return " ".join(parts + ([f"x{row['count']:.0f}"] if row["count"] > 0 else []))
    return runs.assign(name=[name(row) for _, row in runs.iterrows()],
                       told=np.maximum(runs["error"], UNTOLD * runs["error_bar"]).where(runs["error"].notna()))


def tellable(runs, accuracy):
    """The scenes whose truth is sharp enough to tell whether an accuracy is reached."""
    bars = runs.groupby("scene", sort=False)["error_bar"].first()
    return list(bars.index[UNTOLD * bars <= accuracy])


ENERGY_GATE = "energy above the start's"
SCENE_GATES = (  # what must hold of a scene: column, name, bound
    ("missed_steps", "steps that miss their tolerance", 0), ("refuted_steps", "refuted steps", 0), ("overlap_share", "overlap", 1e-2),
    ("overlap_share_at_end", "overlap at the end", 1e-3), ("bilateral_error_m", "bilateral error", 1e-3),
    ("excess_share", ENERGY_GATE, 1e-6))
AT_REST = 1e-6  # kinetic energy over m g and a body's least size


def scene_gates(frame):
    """A row for each scene, step and gate: `gate`, `measured`, `bound` and whether it `holds`; none of the energy of what is driven."""
    frame = frame.assign(missed_steps=frame["steps"] - frame["steps_ok"])
    gates = pd.concat([frame[["scene", "step_s", "driven"]].assign(gate=gate, measured=frame[column], bound=bound)
                       for column, gate, bound in SCENE_GATES], ignore_index=True)
    works = gates["gate"].eq(ENERGY_GATE) & gates["driven"].eq(1)
    return gates[~works].drop(columns="driven").assign(holds=gates["measured"] <= gates["bound"])


def cost_ratios(frame):
    """Row updates of `auto` over those of `plain`, or wall time where `auto` updates no row, one row for each run that `plain`
    solves; the status is that of `auto`."""
    keys = ["scene", "parameter", "value", "step_s", "measured_rate", "relaxation"]
    work = ["row_updates", "wall_s"]
    plain, auto = (frame[frame["outer"] == outer] for outer in ("plain", "auto"))
    both = auto.merge(plain[plain["status"] == "ok"][keys + work], on=keys, suffixes=("", "_plain"))
    timed = both["row_updates"] == 0
    ratio = (both["row_updates"] / both["row_updates_plain"]).where(~timed, both["wall_s"] / both["wall_s_plain"])
    return both.assign(timed=timed, ratio=ratio.where(both["status"] == "ok"))


def why(row):
    """Short text of what is wrong with a row of `failed`."""
    status = row.get("status", "ok")
    if status == "ok":
        return "ok, but no number that can be drawn"
    return f"{status}: {row['reason']}" if row.get("reason") else status


def reasons_note(rows, limit=4):
    """The commonest reasons of failed rows with their counts, '' if there is none."""
    if rows.empty:
        return ""
    counts = rows.apply(why, axis=1).value_counts()
    lines = [f"{count} x {textwrap.shorten(reason, 140, placeholder=' ...')}" for reason, count in counts.head(limit).items()]
    if len(counts) > limit:
        lines.append(f"and {counts.iloc[limit:].sum()} more for {len(counts) - limit} other reasons")
    return "Crossed, not ok: " + "; ".join(lines)


def missed_note(frame):
    """How many steps the runs missed that did not solve all, '' if all did."""
    missed = frame["missed_steps"][frame["missed_steps"] > 0]
    spanned = f"{missed.min():.0f} to {missed.max():.0f}" if len(missed) else ""
    return f"Of each crossed run {spanned} steps missed their tolerance. " if spanned else ""


def text_number(value, digits=3):
    """A number as text: 0.004, 1e-4, 1e6."""
    text = f"{value:.{digits}g}"
    if 0 < abs(value) < 1e-3 and "e" not in text:
        mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
        text = f"{mantissa.rstrip('0').rstrip('.') if '.' in mantissa else mantissa}e{exponent}"
    return text.replace("e+0", "e").replace("e+", "e").replace("e-0", "e-")


def scene_text(scene):
    """A scene's name with the numbers of its parameters as `text_number` writes them."""
    return re.sub(r"(?<==)\d+(\.\d*)?(e[-+]?\d+)?", lambda match: text_number(float(match[0])), scene)


def step_text(step):
    """A step size in seconds as the fraction people use."""
    inverse = 1 / step
    return f"1/{inverse:.0f} s" if inverse > 20.5 and abs(inverse - round(inverse)) < 1e-6 * inverse else f"{step:g} s"
