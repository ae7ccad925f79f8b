"""Claims about the solver of the linearised step."""

from claims.claim import Claim, Finding, judge, some, verdict_rows, worst
from content import compared, number, share, span
from sections.cost import quickest, rival_wins
from sections.relaxations import sweeps_to

TARGET = 1e-6


def accelerates(errors):
    sweeps = sweeps_to(errors, TARGET).unstack("relaxation")
    sweeps = sweeps.dropna(subset=["nesterov_jacobi", "jacobi"], how="all") if {"nesterov_jacobi", "jacobi"} <= set(sweeps) else []
    some(sweeps, f"scene on which `jacobi` or `nesterov_jacobi` reaches {number(TARGET)}")
    faster = ~(sweeps["jacobi"] <= sweeps["nesterov_jacobi"]) & sweeps["nesterov_jacobi"].notna()
    saved = (sweeps["jacobi"] / sweeps["nesterov_jacobi"]).dropna()
    return Finding(
        judge(faster.all(), faster.any(), f"{share(faster.sum(), len(faster))} scenes"),
        f"To an error of {number(TARGET)} `nesterov_jacobi` needs fewer sweeps than `jacobi` on {share(faster.sum(), len(faster))} scenes, "
        + (f"by a factor of {span(saved)} where both come there. " if len(saved) else "with none on which both come there. ")
        + "Orders in the number of sweeps are not fitted.",
        f"{share(faster.sum(), len(faster))} scenes", f"{len(faster)} of {len(faster)}")


def overhead(points, verdicts):
    growth = verdict_rows(verdicts, "effects.linear")
    steepest = worst(growth)
    linear = (growth["verdict"] == "holds").all()
    rows = quickest(points)
    wins, entered = rival_wins(points)
    firsts = {name: ((rows["outer"] == "plain") & (rows["relaxation"] == name)).sum() for name in ("gauss_seidel", "nesterov_jacobi")}
    against = (f"Newton's method with CHOLMOD is the quickest in {share(wins, entered)} rows of small scenes that it enters; `plain` with "
               f"`gauss_seidel` is in {share(firsts['gauss_seidel'], len(rows))}, `plain` with `nesterov_jacobi`, the paper's method, in "
               f"{firsts['nesterov_jacobi']}.")
    lost = wins > 0 or sum(firsts.values()) < len(rows)
    return Finding(
        judge(linear and not wins and sum(firsts.values()) > 0, linear, "the time of a sweep, linear in the rows"),
        f"Over the rows the time of a sweep grows with an exponent that is off 1 by {compared(steepest['measured'], steepest['bound'])[0]} at "
        f"most. {against}",
        *compared(steepest["measured"], steepest["bound"]), against if lost else "")


CLAIMS = (
    Claim(26, "The accelerated method converges faster than Jacobi's.", "the accelerated Jacobi solver suitable for parallel architectures",
          ("inner_convergence/errors",), accelerates, "inner_convergence_sweeps"),
    Claim(27, "The solver suits parallel machines.", "based on both the Jacobi and the Nesterov methods so it can be parallelized",
          untested="The solver works in one thread; no experiment runs a sweep on several."),
    Claim(28, "It is matrix-free, with little overhead beside other methods.",
          "to keep the computational overhead to a minimum compared to existing methods",
          ("work_precision/points", "effects_cost/verdicts"), overhead, "work_precision_seconds"),
    Claim(29, "Restart removes the ripple of the accelerated method.", "",
          untested="`nesterov_jacobi` always restarts; no experiment runs it without."),
)
