"""Contact and friction."""

from content import Figure, Section, Table, counted, number, span
from selecting import step_text
from sections.robustness import failed_gates, gates_text

ENERGY = (
    "Why bouncing keeps its energy here. Newton's law of restitution takes the approaching speed of the step's start, u_n' = - e "
    "u_n. The trapezoidal rule changes a body's energy by p (u_n + u_n')/2 per contact of impulse p, which vanishes for e = 1, and "
    "keeps the energy of free fall; the body turns round at most one step's motion above the ground. Contacts that close only because of "
    "other contacts' impulses within the step follow the same law.")
EXACT = (
    "Why overlaps vanish. The rows constrain the gaps at the step's end, and the gap of two balls is an exact function of their centres. "
    "Only the tolerance is left as overlap. Engines that constrain velocities overlap by O(h^2) a step.")


def simbenchmark(results):
    section = Section(
        "How accurate and how fast is contact, compared with five engines?",
        "The scenes are those of SimBenchmark [@kang2018simbenchmark]: a pushed box with balls on it, which a box-shaped friction law would "
        "keep at rest; balls that bounce without loss; a cube of 216 balls that falls apart without friction, inelastic and elastic. An "
        "error is the mean over all steps of a squared quantity. The engines' numbers were published in 2018, for their versions of that "
        "year and on another machine.",
        figures=[
            Figure("simbenchmark_accuracy", "Error over the step, this solver (solid) and five engines as published. Crossed: a step "
                   "missed its tolerance, or the run diverged."),
            Figure("simbenchmark_cost", "The same over seconds: wall time here; for the engines processor time as published, on another machine.")])
    frame = results.table("simbenchmark", "accuracy")
    section.tell(None if frame is None else frame[frame["solver"] == "pbdcheck"], lambda frame: ENERGY, lambda frame: EXACT,
                 benchmark_text, benchmark_table)
    return section


def benchmark_text(frame):
    finest = frame[frame["step_s"] == frame.groupby("benchmark")["step_s"].transform("min")]
    return "Errors at the shortest step: " + "; ".join(
        f"`{r['benchmark']}` {number(r['error'])} at {step_text(r['step_s'])}" for _, r in finest.iterrows()) + (
        f". {counted(int((frame['missed_steps'] > 0).sum()), 'run')} of {len(frame)} missed the tolerance in some step.")


def benchmark_table(frame):
    return Table("Runs: mean squared error, wall time (s) and the time simulated (s), steps that missed their tolerance.",
                 ["benchmark", "step", "integrator", "error", "wall time", "simulated", "missed", "status"],
                 [[f"`{r['benchmark']}`", step_text(r["step_s"]), f"`{r['integrator']}`", number(r["error"]), number(r["wall_s"]),
                   number(r["simulated_s"]), number(r["missed_steps"]), f"`{r['status']}`"] for _, r in frame.iterrows()])


def contact_hard_cases(results):
    section = Section(
        "Which hard contacts does one method survive?",
        "Heavy bodies on light ones, boxes dropped, cards, arches, redundant contacts, the threshold of sliding, friction from none "
        "to next to infinite, a wrecking ball on a chain, rolling coins, a turntable. `direct` runs all of them with every other setting at its "
        "default and none for any case; the verdicts are about it. In the full tier `conjugate_gradients` and "
        "`gauss_seidel` run them, too, with at most 1000 sweeps a step.",
        figures=[
            Figure("contact_hard_cases_gates", "Every gate of every case, with the number measured. Green holds, red fails."),
            Figure("contact_hard_cases_frontier", "Largest step and fewest sweeps an outer iteration at which all gates still hold.")])
    gates, frontier = results.table("contact_hard_cases", "gates"), results.table("contact_hard_cases", "frontier")
    if gates is not None:
        section.paragraphs.append(gates_text(gates))
        section.tables += failed_gates(gates)
    if frontier is not None:
        section.paragraphs.append(
            f"All gates hold up to steps of {span(frontier['largest_step_s'])} s, in "
            f"{counted(int(frontier['largest_step_s'].isna().sum()), 'case')} of {len(frontier)} not even at the shortest one tried. "
            "A sweep of `direct` is an iteration of Newton's method.")
    return section
