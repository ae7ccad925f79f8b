"""What steps cost beside Newton's method."""

from content import Figure, Section, Table, number, span
from selecting import good


def rival_newton(results):
    section = Section(
        "When is the constraint solver faster than Newton's method?",
        "Where every constraint is compliant, Newton's method on the incremental potential does the same step. `newton` is one "
        "written for speed that shares no code with the solver or the judges: it factors the stiffness at each of its few "
        "iterates. `quasi_newton` factors one constant matrix a scene [@liu2017quasi] and does many cheap iterations. One step "
        "of a falling cantilever, as in a running simulation: what only a scene's first step takes is listed as set-up.",
        figures=[
            Figure("rival_newton_elements", "Wall time of a step until the error first falls to a target, over the size of "
                   "the mesh. Crossed: not reached."),
            Figure("rival_newton_seconds", "Error over wall time on the largest mesh.")])
    frame = results.table("rival_newton", "times")
    if frame is not None:
        section.paragraphs.append(
            "Small and middle meshes are judged by `primal_newton`. On the largest mesh of a run the reference is `newton` itself, "
            "converged as far as rounding allows: it and `quasi_newton` share no code, so that the error `quasi_newton` ends "
            "with there is a check of both.")
        section.paragraphs.append(ratios_text(frame))
        section.tables.append(rival_table(frame))
    return section


def paired(frame):
    """One row a problem and target that both methods reached: wall times side by side, and their ratio."""
    keys = ["elements", "young_pa", "poisson", "error_target"]
    both = good(frame, "wall_s").pivot_table(index=keys, columns="method", values="wall_s", sort=False).reset_index()
    if not {"newton", "quasi_newton"} <= set(both):
        return both.iloc[:0].assign(ratio=[])
    both = both.dropna()
    return both.assign(ratio=both["quasi_newton"] / both["newton"])


def ratios_text(frame):
    """Ratio of the times on the largest mesh, by target and Poisson's ratio."""
    both = paired(frame)
    both = both[both["elements"] == both["elements"].max()]
    parts = [f"{span(rows['ratio'])} to {number(target)} at nu = {poisson:g}"
             for (poisson, target), rows in both.groupby(["poisson", "error_target"], sort=False)]
    return (f"On {both['elements'].iloc[0]:.0f} tetrahedra, the time of `quasi_newton` over that of `newton` is "
            + "; ".join(parts) + ". Below 1 the constraint solver is the faster one.") if parts else \
        "No problem was solved by both methods."


def rival_table(frame):
    largest = frame[frame["elements"] == frame["elements"].max()]
    return Table("Time to an error on the largest mesh.",
                 ["tetrahedra", "E (Pa)", "nu", "method", "to", "iterations", "set-up (s)", "wall time (s)", "status"],
                 [[f"{r['elements']:.0f}", number(r["young_pa"]), f"{r['poisson']:g}", f"`{r['method']}`",
                   number(r["error_target"]), f"{r['iterations']:.0f}", number(r["setup_s"]), number(r["wall_s"]),
                   f"`{r['status']}`"] for _, r in largest.iterrows()])


def large_scenes(results):
    section = Section(
        "What does a step of a large scene cost in time and memory, beside Newton's method?",
        "A cantilever of tetrahedra and a sheet let go, by `quasi_newton` and by `newton`, the rival: seconds of the second step from rest until the "
        "error first falls to a target, and the memory that each takes at most, the scene itself left out. Of a solid `quasi_newton` factors one "
        "constant matrix; of a sheet, whose stiffness across itself is its tension, that of the current shape, as Newton's method does. "
        "Columns of boxes that slide are solved by `auto`, to tolerances of the residual, which stand for the error.",
        figures=[Figure("large_scenes_costs", "Time of a step and memory over the number of unknowns.")])
    return section.tell(results.table("large_scenes", "steps"), largest_text, large_table)


def largest_text(steps):
    """On which scenes quasi_newton takes more than half of Newton's time, and whether one of the two fails."""
    times = good(steps, "wall_s").pivot_table("wall_s", ["scene", "size", "error_target"], "method", sort=False)
    if not {"newton", "quasi_newton"} <= set(times):
        return ""
    ratio = (times["quasi_newton"] / times["newton"]).dropna()
    told = [f"`{scene}`: `quasi_newton` takes {span(rows)} of Newton's time" for scene, rows in ratio.groupby(level="scene", sort=False)]
    lost = steps[steps["status"] != "ok"]
    told += [f"`{r['method']}` does not reach {number(r['error_target'])} on {r['size']:.0f} {r['unit']} ({r['reason']})"
             for _, r in lost.iterrows()]
    return "; ".join(told) + "."


def large_table(steps):
    return Table("Steps of large scenes.", ["scene", "size", "unknowns", "method", "to", "iterations", "set-up (s)", "a step (s)", "MB"],
                 [[f"`{r['scene']}`", f"{r['size']:.0f} {r['unit']}", f"{r['unknowns']:.0f}", f"`{r['method']}`", number(r["error_target"]),
                   f"{r['iterations']:.0f}", number(r["setup_s"]), number(r["wall_s"]) if r["status"] == "ok" else r["reason"],
                   number(r["memory_mb"])] for _, r in steps.iterrows()], first=True)
