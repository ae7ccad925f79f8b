"""What effects cost."""

from content import Figure, Section, Table, joined, number, span


def effects_cost(results):
    section = Section(
        "What does each effect cost?",
        "Does an effect that a scene does not use cost nothing? Does one that it uses cost time in proportion to its rows?",
        figures=[
            Figure("effects_cost_scaling", "Wall time of one sweep and row over the number of rows: level where cost is in proportion."),
            Figure("effects_cost_absent", "Change of a step's time by an effect that is listed and that nothing uses."),
            Figure("effects_cost_stripped", "Sweeps over links, joints and contacts beside the least loops that do the same."),
            Figure("effects_cost_bytes", "Memory of each effect's rows."),
            Figure("effects_cost_seconds", "Wall time of each effect per row and step, linearising and relaxing.")])
    scaling, costs = results.table("effects_cost", "scaling"), results.table("effects_cost", "costs")
    section.tell(results.table("effects_cost", "absent"), absent_text)
    section.tell(results.table("effects_cost", "stripped"), stripped_text)
    if scaling is not None:
        section.paragraphs.append("Exponents of the time per sweep over the rows: " + "; ".join(
            f"`{name}` {span(group['exponent'])}" for name, group in scaling.groupby("relaxation", sort=False))
            + ". An exponent of 1 is cost in proportion to the rows.")
    if costs is not None:
        section.tables.append(Table(
            "Cost of each effect.", ["scene", "effect", "rows", "bytes per row", "wall time (s)"],
            [[f"`{r['scene']}`", f"`{r['effect']}`", f"{r['rows']:.0f}",
              number(r["bytes"] / r["rows"]) if r["rows"] else "", number(r["wall_s"])] for _, r in costs.iterrows()], first=True))
    return section


def absent_text(absent):
    """What effects cost that nothing uses."""
    change = 100 * (absent["time_ratio"] - 1)
    there = {presence: absent[absent["presence"] == presence] for presence in ("control", "empty", "never touches", "idle", "used")}
    told = f"Each effect that is listed and empty changes the time of a step by {number(change[there['empty'].index].abs().max())} % at most."
    if len(there["control"]):
        told += f" The same scene measured against itself differs by {number(change[there['control'].index].abs().max())} %."
    if len(there["never touches"]):
        told += (" A step that does little else changes by " + listed(there["never touches"], change, "{effect} that {case}") + ": how far all went since "
                 "it was seen to be far apart.")
    if len(there["idle"]):
        told += (" What is listed without a consequence changes it by " + listed(there["idle"], change, "`{effect}` with {case}") +
                 ". A limit has a row, which each sweep visits, from where bodies may come to it within four steps, and up to 32 steps after that.")
    if len(there["used"]):
        told += f" Probes of each kind but those of joints take {span(change[there['used'].index])} % more of a step of small bodies, without writing them."
    differ = absent[absent["entries_that_differ"] > 0]
    return told + (" No number of the result changes." if differ.empty else
                   " Numbers of the result change with " + joined(f"`{row['effect']}`, {row['case']}" for _, row in differ.iterrows()) +
                   ". There rounding is another: products are subtracted, an impulse is cut to its bounds, or what rounding leaves of a speed "
                   "collides.")


def listed(rows, change, words):
    """What each row takes, %."""
    return joined(f"{number(change[i])} % ({words.format(**row)})" for i, row in rows.iterrows())


def stripped_text(stripped):
    """What a sweep takes beside the least loop over one kind of rows."""
    return ("A sweep of Gauss-Seidel over rows of one kind, beside a loop that knows this kind alone: " + "; ".join(
        f"{r['scene']} {number(1e9 * r['wall_s_per_sweep'] / r['rows'])} ns a row beside {number(1e9 * r['stripped_s_per_sweep'] / r['rows'])} ns, "
        f"{number(r['ratio'])} times as long" for _, r in stripped.iterrows()) + ".")
