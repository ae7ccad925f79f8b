"""What was run, and what produced the results."""

from content import Section, Table, joined, listed, number
from reading import COMPLETE


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


def provenance_section(results, experiments):
    section = Section("What was run, and by what", name="provenance")
    rows = []
    for name in experiments:
        shortfall = results.shortfall(name)
        holds = 0 if shortfall else results.run(name)["verdicts"].get("holds", 0)
        total = 0 if shortfall else len(results.verdicts(name))
        rows.append([f"`{name}`", shortfall or COMPLETE, f"{holds} of {total} hold" if total else "",
                     "" if shortfall else number(results.run(name)["wall_s"])])
    section.tables.append(Table("Experiments.", ["experiment", "run", "verdicts", "wall time (s)"], rows))
    section.tables += [Table(f"Provenance of {listed(names)}.", ["fact", "value"], list(facts))
                       for facts, names in results.producers(experiments).items()]
    return section
