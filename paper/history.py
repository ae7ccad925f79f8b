"""What changed since the last comparable run: verdicts, accuracy, work and time, from the line a run of history.jsonl."""

import json
import math

from content import Section, Table, counted, joined, number
from failed import TIMED
from reading import COMPLETE

MACHINE = ("tier", "processor", "threads")  # runs that differ in these are not compared
PROGRAM = ("commit", "changes")
LINE = {"date": str, "commit": str, "tier": str, "processor": str, "threads": int, "experiments": dict}
ENTRY = {"status": str, "run_s": (int, float), "work": dict, "verdicts": list}
SHOWN = 12  # numbers that stand in the PDF, too
MOVED = 1.01  # a number that grows or shrinks by less is not shown


def read_history(path):
    """The lines that are whole, oldest first, and the numbers of those that are not."""
    lines, bad = [], []
    if path.exists():
        for number_, text in enumerate(path.read_bytes().split(b"\n"), start=1):
            if text.strip():
                line = parsed(text)
                lines.append(line) if line else bad.append(number_)
    return lines, bad


def parsed(text):
    """A line as an object, None if it is not one."""
    try:
        line = json.loads(text)
        whole = isinstance(line, dict) and has(line, LINE) and all(entry_is_whole(e) for e in line["experiments"].values())
    except (ValueError, RecursionError):
        return None
    return line if whole else None


def has(record, keys):
    return isinstance(record, dict) and all(isinstance(record.get(key), kind) for key, kind in keys.items())


def entry_is_whole(entry):
    return has(entry, ENTRY) and all(has(v, {"id": str, "verdict": str}) and all(key in v and isinstance(v[key], (int, float, type(None)))
                                                                             for key in ("measured", "bound")) for v in entry["verdicts"])


def last_two(lines, experiment):
    """The last complete run of an experiment and the one before it by another program on the same machine, None if there is none."""
    runs = [line for line in lines if line["experiments"].get(experiment, {}).get("status") == COMPLETE]
    if not runs:
        return None
    now = runs[-1]
    before = [line for line in runs if all(line[key] == now[key] for key in MACHINE) and any(line.get(key) != now.get(key) for key in PROGRAM)]
    return (before[-1], now) if before else None


def ratio(after, before):
    """after / before; 1 of two numbers that are the same, NaN where one is missing."""
    if after is None or before is None:
        return 1.0 if after is before else math.nan
    if after == before:
        return 1.0
    return after / before if before > 0 else math.inf


def turned(experiment, before, after):
    """Rows of the verdicts that are not what they were."""
    old, new = ({v["id"]: v["verdict"] for v in entry["verdicts"]} for entry in (before, after))
    return [[f"`{name}`", words(old.get(name)), words(new.get(name)), f"[#{experiment}]"]
            for name in dict.fromkeys([*old, *new]) if old.get(name) != new.get(name)]


def words(verdict):
    return verdict.replace("_", " ") if verdict else "not there"


def share_of_bound(verdict):
    return verdict["measured"] / verdict["bound"] if verdict["measured"] is not None and verdict["bound"] else verdict["measured"]


def moved(experiment, before, after):
    """(factor, row) of the numbers of verdicts, times aside, that are not what they were."""
    old = {v["id"]: v for v in before["verdicts"]}
    for verdict in after["verdicts"]:
        if verdict["id"] not in old or verdict["id"].startswith(TIMED):
            continue
        was, now = share_of_bound(old[verdict["id"]]), share_of_bound(verdict)
        factor = ratio(now, was)
        if not 1 / MOVED <= factor <= MOVED:
            yield factor, [f"`{verdict['id']}`", written(was), written(now), factor_text(factor), f"[#{experiment}]"]


def written(value):
    return "not a number" if value is None else number(value)


def factor_text(factor):
    return "not a number" if math.isnan(factor) else f"{factor:.3g}"


def distance(factor):
    """How far from 1, in either direction."""
    return math.inf if math.isnan(factor) or factor <= 0 else abs(math.log(factor))


def costs(experiment, before, after):
    work = [ratio(after["work"].get(key), before["work"].get(key)) for key in ("outer_iterations", "sweeps", "row_updates")]
    return [f"[#{experiment}]", *map(factor_text, work), number(after["run_s"]), factor_text(ratio(after["run_s"], before["run_s"]))]


def history_section(results, experiments):
    """What the last commit changed."""
    lines, bad = read_history(results.directory / "history.jsonl")
    pairs = {name: pair for name in experiments if (pair := last_two(lines, name))}
    section = Section("What changed", "What did the last change of the program change?", name="changes")
    if bad:
        section.paragraphs.append(f"Of `history.jsonl` {counted(len(bad), 'line')} cannot be read and {'is' if len(bad) == 1 else 'are'} left "
                                  f"alone: {joined(map(str, bad))}.")
    if not pairs:
        section.paragraphs.append("No earlier run by another program, on the same machine with the same tier and threads, is in "
                                  "`history.jsonl`: there is nothing to compare with. To get one, run the experiments by both programs into "
                                  "the same folder, one after the other: each run adds a line.")
        return section
    entries = [(name, before["experiments"][name], now["experiments"][name]) for name, (before, now) in pairs.items()]
    turns = [row for entry in entries for row in turned(*entry)]
    moves = sorted((pair for entry in entries for pair in moved(*entry)), key=lambda pair: -distance(pair[0]))
    worse = sum(not factor <= 1 for factor, _ in moves)
    section.paragraphs.append(
        f"{counted(len(pairs), 'experiment')} compared, {joined(sorted({programs(*pair) for pair in pairs.values()}))}: "
        f"{counted(len(turns), 'verdict')} turned; of the numbers, times aside, {worse} grew and {len(moves) - worse} shrank by more than "
        f"{100 * (MOVED - 1):.0f} %.")
    if turns:
        section.tables.append(Table("Verdicts that turned.", ["verdict", "was", "is", "see"], turns))
    header, rows = ["verdict", "was", "is", "factor", "see"], [row for _, row in moves]
    if rows:
        section.tables.append(Table("Numbers over their bounds, the largest changes first.", header, rows[:SHOWN]))
    if len(rows) > SHOWN:
        section.tables.append(Table("Numbers over their bounds, all that changed.", header, rows, detail=True))
    section.tables.append(Table(
        "Work and time beside the earlier run: 1 is no change.",
        ["see", "outer iterations, factor", "sweeps, factor", "row updates, factor", "run (s)", "run, factor"],
        [costs(*entry) for entry in entries]))
    return section


def programs(before, now):
    def named(line):
        return f"`{line['commit'][:10]}`" + (" with changes" if line.get("dirty") else "") + f" ({line['date'][:10]})"
    return f"{named(now)} beside {named(before)}"
