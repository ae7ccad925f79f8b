"""What was run, and what produced the results: enough to cite them, and to tell whether a file is the one cited."""

import re
import sys

import jinja2
import matplotlib
import numpy
import pandas

from content import Section, Table, joined, listed, number
from reading import COMPLETE
from results import HERE

UNRECORDED = "not recorded"
TIMES = ("Times are wall-clock times of one process. A step by one method is timed three times after a first run that is thrown away, and the "
         "tables hold the least; they do not hold the spread. The load is the mean number of busy processes in the last minute of a "
         "run, its own threads included: far above the number of threads, other work slowed it.")


def notice(results, experiments):
    """What a reader must know before any number, '' if nothing."""
    missing = [f"`{name}` ({results.shortfall(name)})" for name in experiments if results.shortfall(name)]
    text = f"This report is incomplete. No result is shown of {', '.join(missing)}. " if missing else ""
    if len(results.producers(experiments)) > 1:
        text += "The results stem from different programs, machines or settings, see [#provenance]."
    return text


def limits(results, experiments):
    """The tiers and machines that the numbers are of."""
    facts = [dict(facts) for facts in results.producers(experiments)]
    def all_of(key):
        return joined(sorted({f[key] for f in facts if key in f}))
    if not facts:
        return "Nothing was run to its end."
    return (f"Limits: the tier that was run is {all_of('tier')}, on {all_of('processor')}, {all_of('threads')} threads at most, "
            f"by commit {joined(sorted({f['commit'][:10] for f in facts}))}"
            + (" with changes" if any(f["dirty"] == "yes" for f in facts) else "")
            + ". " + ("The quick tier runs small scenes and few random ones. " if "quick" in all_of("tier") else "")
            + "Times are of this machine.")


def citation(results, experiments):
    """How to cite, as CITATION.cff and the runs say."""
    text = (HERE.parent / "CITATION.cff").read_text(encoding="utf-8")
    title, version = (re.search(rf'^{key}: "?(.*?)"?$', text, re.M)[1] for key in ("title", "version"))
    commits = sorted({dict(facts)["commit"] for facts in results.producers(experiments)})
    return (f"To cite these results, name the program ({title}, version {version}, commit {joined(commits) or UNRECORDED}; `CITATION.cff` "
            "in its repository), the tier, the date of the run, and the paper whose method is measured [@francu2017position]. Whether a table is the "
            "one cited, its SHA-256 tells.")


def provenance_section(results, experiments):
    section = Section("What was run, by which program and machine", name="provenance", appendix=True, paragraphs=[citation(results, experiments), TIMES])
    rows = []
    for name in experiments:
        shortfall = results.shortfall(name)
        run = {} if shortfall else results.run(name)
        counts = run.get("verdicts", {})
        holds, total = counts.get("holds", 0), sum(counts.values())
        rows.append([f"`{name}`", shortfall or COMPLETE, f"{holds} of {total} hold" if total else "", str(run.get("date", UNRECORDED)),
                     number(run["load"]) if "load" in run else UNRECORDED, number(run["wall_s"]) if run else ""])
    section.tables.append(Table("Experiments.", ["experiment", "run", "verdicts", "ended (UTC)", "load", "wall time (s)"], rows,
                                detail=True))
    section.tables += [Table(f"Provenance of {listed(names)}.", ["fact", "value"], list(facts))
                       for facts, names in results.producers(experiments).items()]
    used = {"Python": sys.version.split()[0], **{module.__name__: module.__version__ for module in (matplotlib, numpy, pandas, jinja2)}}
    section.tables.append(Table("What drew the figures and wrote this report.", ["program", "version"], [list(entry) for entry in used.items()]))
    section.tables.append(Table("Files and their SHA-256.", ["file", "lines", "SHA-256"], [
        [f"`{name}/{file.name}`", str(file.lines), file.sha256] for name in experiments for file in results.files(name)], detail=True))
    return section
