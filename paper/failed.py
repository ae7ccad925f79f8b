"""What failed: verdicts, how far they are off, and solves that are not ok."""

import re

import pandas as pd

from content import Section, Table, compared, joined, listed, number, share
from reading import CLASSES, VERDICTS
from selecting import why
from tables import SOLVES

NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(\.\d+)?(e[-+]?\d+)?(?![\w.]*[a-z_])")
METHOD = ("integrator", "outer", "relaxation", "method", "solver", "friction", "law")
ALONE = ("outer", "relaxation")  # of it where a table has one method
TIMED = ("effects.empty.free", "effects.idle", "effects.unused", "effects.removed", "effects.frictionless.cheaper", "effects.linear", "joints.linear", "rival.fine",
         "rival.coarse", "stability.auto_cost", "worlds.slowest")  # what these verdicts measure is a time
MEANINGS = {
    "code": "our solver against code that shares nothing with it",
    "theory": "a number, and how far the solver may be from it, that are derived",
    "paper": "a claim of the paper",
    "robustness": "the solver ends well: no throw, no false claim, no state that blows up",
    "goal": "a number that we chose; to miss it is no failure"}


def all_verdicts(results, experiments):
    """Every verdict of the complete runs, with its experiment."""
    frames = [results.verdicts(name).assign(experiment=name) for name in experiments if not results.shortfall(name)]
    return pd.concat(frames, ignore_index=True) if frames else pd.DataFrame(columns=["experiment", "verdict"])


def stripped(reason):
    """A reason without its numbers, which differ from solve to solve."""
    return NUMBER.sub("#", reason)


def solves(results, experiment):
    """One row a solve of any table with a status: table, method (what of it varies in the table), status, reason."""
    for name, frame in results.all_tables(experiment):
        if "status" not in frame:
            continue
        frame = frame.assign(reason=frame.get("reason", ""))
        if (experiment, name) in SOLVES:
            frame = frame.drop_duplicates([*SOLVES[experiment, name].split(), "status", "reason"])
        known = [column for column in METHOD if column in frame]
        telling = [column for column in known if frame[column].nunique() > 1] or [column for column in known if column in ALONE]
        method = frame[telling].agg(lambda row: ", ".join(f"`{cell}`" for cell in row if cell), axis=1) if telling else "all"
        yield pd.DataFrame({"table": name, "method": method, "status": frame["status"], "reason": frame["reason"].map(stripped)})


def failures(results, experiments):
    """One row an experiment, status and reason: how many of the solves, and a list of how many of each method."""
    rows = []
    for experiment in experiments:
        found = list(solves(results, experiment))
        if not found:
            continue
        frame = pd.concat(found, ignore_index=True)
        totals = frame.groupby("method", sort=False).size()
        bad = frame[frame["status"] != "ok"]
        groups = sorted(bad.groupby(["status", "reason"], sort=False), key=lambda group: -len(group[1]))
        for (status, reason), group in groups:
            counts = group["method"].value_counts()
            rows.append([f"`{experiment}`, [#{experiment}]", f"`{status}`", reason, share(len(group), len(frame)),
                         [f"{method} {share(count, totals[method])}" for method, count in counts.items()]])
    return rows


def cause(results, verdict):
    """How far off a verdict is, and what the rows of the scene that its quantity names say."""
    if verdict["verdict"] == "not_decided":
        return f"{verdict['reason']}."
    measured, bound, low, high = (verdict[name] for name in ("measured", "bound", "measured_low", "measured_high"))
    times = f"{compared(measured / bound, 1)[0]} times its bound" if bound > 0 else "above 0"
    if verdict["id"].startswith(TIMED):
        if low < high and low > bound:
            return f"A measured time, {times}; all repeats are above it, from {number(low)} to {number(high)}."
        return f"A measured time, {times}. Other work on the machine slows it; `make bench` repeats the measurement with nothing else running."
    frames = [frame for _, frame in results.all_tables(verdict["experiment"]) if {"scene", "status"} <= set(frame)]
    named = {name for frame in frames for name in frame["scene"].astype(str)
             if re.search(rf"(?<!\w){re.escape(name)}(?!\w)", verdict["quantity"])}
    rows = pd.concat([frame[frame["scene"].astype(str).isin(named)].assign(reason=lambda own: own.get("reason", ""))
                      for frame in frames]) if frames else []
    if not len(rows):
        return f"The number is {times}."
    scenes = listed(sorted(rows["scene"].unique()))
    bad = rows[~rows["status"].isin(["ok", "skipped"])]
    if bad.empty:
        return f"The number is {times}; no row of {scenes} is missed."
    reasons = bad.apply(why, axis=1)
    commonest = reasons.map(stripped).value_counts().index[0]
    return f"The number is {times}; of {scenes} {share(len(bad), len(rows))} rows are not ok, most often: {reasons[reasons.map(stripped) == commonest].iloc[0]}."


def classes_table(verdicts):
    """How many verdicts of each class hold."""
    counts = verdicts.groupby(["class", "verdict"]).size().unstack(fill_value=0).reindex(columns=VERDICTS, fill_value=0)
    return Table("Verdicts by what they rest on.", ["class", "what it is", "verdicts", "hold", "fail", "missed", "not decided"], [
        [name, MEANINGS[name], str(int(counts.loc[name].sum())), *(str(int(n)) for n in counts.loc[name])]
        for name in CLASSES if name in counts.index])


def counts_told(bad):
    """How many verdicts fail, miss a goal and are not decided."""
    counts = bad["verdict"].value_counts()
    return joined([f"{counts.get('fails', 0)} fail", f"{counts.get('missed', 0)} miss a goal", f"{counts.get('not_decided', 0)} are not decided"])


def failed_section(results, experiments):
    verdicts = all_verdicts(results, experiments)
    bad = verdicts[verdicts["verdict"] != VERDICTS[0]]
    section = Section("What failed", name="failed", paragraphs=[
        f"{share(len(verdicts) - len(bad), len(verdicts))} verdicts hold" + (f"; {counts_told(bad)}." if len(bad) else ".")])
    if len(verdicts):
        section.tables.append(classes_table(verdicts))
    for word, caption in (("fails", "Verdicts that fail."), ("missed", "Goals that are missed."),
                          ("not_decided", "Times that are not decided: repeats lie on both sides of the bound.")):
        rows = bad[bad["verdict"] == word]
        if len(rows):
            section.tables.append(Table(caption, ["verdict", "class", "what it says", "measured against bound", "how far off", "see"], [
                [f"`{row['id']}`", row["class"], f"{row['statement']} ({row['quantity']})",
                 " against ".join(compared(row["measured"], row["bound"])), cause(results, row),
                 f"`{row['experiment']}`, [#{row['experiment']}]"] for _, row in rows.iterrows()]))
    rows = failures(results, experiments)
    if not rows:
        section.paragraphs.append("No solve in any table has a status other than `ok`.")
        return section
    header = ["see", "status", "reason (# a number)", "solves", "of each method"]
    section.tables += [
        Table("Solves that are not ok: the two commonest reasons of each experiment. The failure of a method is a result, too; the "
              "figures show it as a crossed marker.", header, [[*row[:4], listing(row[4], 2)] for row in first_of_each(rows, 2)]),
        Table("Solves that are not ok, all of them.", header, [[*row[:4], listing(row[4], len(row[4]))] for row in rows], detail=True)]
    return section


def first_of_each(rows, most):
    """The first rows of each experiment."""
    seen = {}
    return [row for row in rows if seen.setdefault(row[0], []).append(row) or len(seen[row[0]]) <= most]


def listing(texts, most):
    return "; ".join(texts[:most]) + (f"; {len(texts) - most} more" if len(texts) > most else "")


def verdicts_section(results, experiments):
    """Every verdict, of all experiments."""
    verdicts = all_verdicts(results, experiments)
    return Section("All verdicts", name="verdicts", appendix=True, paragraphs=[
        "A verdict holds if the measured number is from 0 to its bound. The table is in `report.html`; each experiment has its own in "
        "`verdicts.csv`."], tables=[Table(
            f"{len(verdicts)} verdicts.", ["experiment", "id", "class", "statement", "quantity", "measured", "bound", "verdict"],
            [[f"[#{row['experiment']}]", f"`{row['id']}`", row["class"], row["statement"], row["quantity"], number(row["measured"]),
              number(row["bound"]), row["verdict"]] for _, row in verdicts.iterrows()], detail=True)])
