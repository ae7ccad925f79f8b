"""What effects cost."""

from content import Figure, Section, Table, number, span


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
    change = (absent["time_ratio"] - 1).abs().where(absent["case"] == "empty")
    idle = absent[absent["case"].str.startswith("never touches")]
    noise = absent[absent["effect"] == "none"]
    control = f" The same scene measured against itself differs by {number(100 * (noise['time_ratio'] - 1).abs().max())} %." if len(noise) else ""
    told = (f"Each effect that is listed and empty changes the time of a step by {number(100 * change.max())} % at most." + control +
            f" Together they change {absent['entries_that_differ'].sum():.0f} numbers of the result.")
    if len(idle):
        told += (f" Contact of nodes that never touch the ground takes {span(100 * (idle['time_ratio'] - 1))} % more of a step that does little "
                 "else: how far all went since it was seen to be far apart.")
    return told


def stripped_text(stripped):
    """What a sweep takes beside the least loop over one kind of rows."""
    return ("A sweep of Gauss-Seidel over rows of one kind, beside a loop that knows this kind alone: " + "; ".join(
        f"{r['scene']} {number(1e9 * r['wall_s_per_sweep'] / r['rows'])} ns a row beside {number(1e9 * r['stripped_s_per_sweep'] / r['rows'])} ns, "
        f"{number(r['ratio'])} times as long" for _, r in stripped.iterrows()) + ".")
