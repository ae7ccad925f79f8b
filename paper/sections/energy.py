"""What the integrators do to energy and momentum."""

import numpy as np

from content import Figure, Section, Table, counted, listed, number, span
from selecting import good, rule_names, step_text

MARGINAL = (
    "Why the trapezoidal rule blows up with hard constraints. Let alpha be the weight of the step's end. A hard constraint with fixed "
    "directions J requires J (alpha v' + (1 - alpha) v) = 0. Each step therefore multiplies an error J v by -r, r = (1 - alpha)/alpha. It "
    "multiplies an error of the multiplier by -r, too, and adds the first error to it, so that -r is a double eigenvalue. At alpha = 1/2 it "
    "is -1, which is marginal.",
    "Where directions turn by theta = h w a step, the two errors mix. For a mass that circles on a link, disturbances along and across the "
    "link have constant coefficients in the turning frame. Their factors are the roots of a quartic equation; for a hard link and small "
    "theta they are -r (1 ± theta). With alpha = 1/2 a disturbance grows by 1 + h w a step, or exp(w t) in a time t, however small the "
    "step. It decays where alpha > (1 + theta)/(2 + theta), which is about 1/2 + h w/4: alpha = 0.55 allows turns of 0.22 rad a step.",
    "For a link of compliance A and frequency w' = 1/sqrt(A m) at rest, a step multiplies the stiff mode by a factor whose modulus tends to r "
    "as h w' grows. There alpha = 1/2 is unstable where h w' tan(h w/2) > 2, about where w' > 4/(h² w). The equation is exact for "
    "alpha = 1/2. For a larger alpha the circling itself slows down, and the roots are those of its rate at the start. `midpoint` has "
    "r = 1 as well: a position that violates a constraint comes back mirrored.")
ANGULAR = (
    "Linear momentum is kept because internal forces cancel, whatever their size. Angular momentum is kept only if forces act at the "
    "positions that define their directions. `symplectic_euler` (at the step's start) and `midpoint` do that. Implicit Euler changes it by "
    "h sum m v' x v a step. `newmark` with alpha = 1/2 keeps L + h²/4 sum m v x q, with q the accelerations, so that L only oscillates; with "
    "any other alpha it loses more. `bdf2` changes a sum over two steps by that of - m d²x x d²v, an error of third order over a given time. "
    "The part of the measured change that these expressions leave unexplained is listed beside it.")


def energy(results):
    section = Section(
        "Do the integrators keep energy and momentum?",
        "Springs, pendulums, cloth and a free beam move for 10 s. Which integrators keep energy and momentum, and where does Newmark's rule "
        "blow up?",
        figures=[
            Figure("energy_series", "Change of the total energy relative to its scale: kinetic and elastic energy at "
                   "the start and weight times extent. Crossed: runs that end badly or have a step that is not solved, at the axis' edge where they leave it."),
            Figure("energy_free_momentum", "Linear and angular momentum of the free beam."),
            Figure("energy_drift", "Largest change of the energy over 10 s by the two rules that keep that of a linear spring."),
            Figure("energy_momentum", "Largest change of momentum of free bodies in 1000 steps, worst of all relaxations where steps "
                   "are stopped after one outer iteration of three sweeps. Linear: of the largest sum of m |v|. Angular: of "
                   "the start's sum of m |v| |x|."),
            Figure("energy_blow_up", "A mass circling on a link: predicted growth rate of a disturbance, and where the simulation "
                   "blows up within 10 s."),
            Figure("energy_frontier", "The smallest alpha above which disturbances are predicted to decay, and the smallest of the map "
                   "from which on no simulation blew up.")])
    section.tell(results.table("energy", "series"), change_table)
    section.tell(results.table("energy", "drift"), drift_text)
    section.tell(results.table("energy", "momentum"), lambda frame: ANGULAR, momentum_text, stopped_text)
    section.tell(results.table("energy", "map"), *(lambda frame, text=text: text for text in MARGINAL), map_text)
    return section.tell(results.table("energy", "frontier"), frontier_text)


def change_table(frame):
    """Energy change at the end of each run, one row an integrator, one column a scene, at the largest step."""
    named = frame.assign(rule=rule_names(frame), change=np.nan)
    named = named[named["step_s"] == named["step_s"].max()]
    scenes = list(named["scene"].unique())
    rows = []
    for rule, group in named.groupby("rule", sort=False):
        cells = {}
        for scene, run in group.groupby("scene", sort=False):
            change = (run["energy_j"].iloc[-1] - run["energy_j"].iloc[0]) / run["scale_j"].iloc[0]
            status = run["status"].iloc[0]
            cells[scene] = (f"{change:+.2g}" if np.isfinite(change) else "not a number") + ("" if status == "ok" else f", {status}")
        rows.append([f"`{rule}`", *(cells.get(scene, "") for scene in scenes)])
    return Table(f"Change of the energy at the end, relative to its scale, h = {step_text(named['step_s'].iloc[0])}.",
                 ["integrator", *scenes], rows, first=True)


def drift_text(frame):
    return ("The rules that keep the energy of a linear spring do not keep that of nonlinear ones. Their error is of second order: "
            "halving the step divides the largest error over 10 s by " + "; ".join(
                f"{span(rows['ratio'])} (`{name}`, {scene.replace('_', ' ')})"
                for (scene, name), rows in frame.assign(rule=rule_names(frame)).groupby(["scene", "rule"], sort=False))
            + ". This is seen only where the step resolves the phases of the modes that move: h² w³ t/12 is the error of a phase.")


def momentum_text(frame):
    solved = good(frame[frame["max_outer"] > 1], "angular_unexplained")
    return (f"The linear momentum changes by at most {number(frame['linear_error'].max())} in {counted(len(frame), 'run')}, of which "
            f"{int((frame['status'] == 'ok').sum())} solve every step. The angular momentum of the solved ones changes by "
            + ", ".join(f"{span(rows['angular_error'])} with `{name}`" 
                        for name, rows in solved.groupby(rule_names(solved), sort=False))
            + f"; the expressions leave at most {number(solved['angular_unexplained'].max())} of it unexplained.")


def stopped_text(frame):
    """Which integrators do not survive steps that are not solved."""
    lost = frame[frame["status"] == "diverged"]
    if lost.empty:
        return "No run of a free body diverges, however early its steps are stopped."
    return "Stopped after three sweeps a step, these diverge, their linear momentum still that of the start to rounding: " \
        + "; ".join(
        f"`{name}` on {scene} with {listed(rows['relaxation'])}"
        for (scene, name), rows in lost.assign(rule=rule_names(lost)).groupby(["scene", "rule"], sort=False)) + "."


def map_text(frame):
    blown = frame["status"] != "ok"
    grows = frame["predicted_growth"] > 1 + 1e-9
    return (f"{int(blown.sum())} of {counted(len(frame), 'simulation')} of the circling mass blow up. A disturbance is "
            f"predicted to grow in {int(grows.sum())}, of which {int((blown & grows).sum())} blow up within 10 s; where it is predicted to decay, "
            f"{int((blown & ~grows).sum())} do. Growth is too slow to be seen where alpha is within a little of the limit.")


def frontier_text(frame):
    hard = frame[frame["compliance_m_per_n"] == 0].sort_values("step_s")
    above = frame[frame["safe_alpha"] > frame["predicted_alpha"]]
    soft = frame[frame["predicted_alpha"] <= 0.5]
    text = "Hard links need an alpha of " + ", ".join(
        f"{row['predicted_alpha']:.4f} at {step_text(row['step_s'])}" for _, row in hard.iterrows()) + " by theory. "
    text += f"alpha = 1/2 is predicted to be safe in {len(soft)} of {counted(len(frame), 'combination')} of compliance and step. "
    if above.empty:
        return text + "No smallest safe alpha of the map lies above the predicted one."
    return text + (f"The smallest safe alpha of the map lies at most {number((above['safe_alpha'] - above['predicted_alpha']).max())} "
                   "above the predicted one, the map's spacing included.")
