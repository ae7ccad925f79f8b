"""Rigid bodies: how they turn, and what joints do to them."""

import numpy as np

from content import Figure, Section, Table, counted, listed, number, share, span
from selecting import failed, good, rule_names, step_text
from sections.time import lost_text, orders_table, resolved_text

GYROSCOPIC = (
    "What the gyroscopic torque does to energy. In a body's own axes I dw/dt = - w x I w, and the torque is normal to w. "
    "Implicit Euler with the implicit torque, I dw = - h w' x I w' with w' = w + dw, has w' . I dw = 0: a step loses 1/2 dw . I "
    "dw. With the explicit torque, taken at w, it is w . I dw that vanishes, and a step gains as much. `midpoint` takes the "
    "torque at (w + w')/2, normal to it, so that the energy stays; the torque is normal to I w, too, and so the length of "
    "the angular momentum stays. The explicit torque is that of the step's start, an error of first order that no "
    "integrator removes. On hard joints `newmark` with alpha = 1/2 and `midpoint` are marginal, as the section on energy "
    "derives; their orders on the hard top are shown, not judged.")
SINGULAR = (
    "Why the four-bar chain misses its tolerance at short steps. A chain of N loops has one degree of freedom, with all legs parallel. Where "
    "its legs lie along the couplers, the joints' rows depend on each other, and for that moment the chain has N + 1 degrees of freedom: any "
    "loop may fold into an antiparallelogram. The constraints alone do not say how the chain goes on; its velocity does. Near that "
    "place rounding limits a step: positions up to L from the origin are known to eps L, and the rates of constraints to eps L/h. The step "
    "changes velocities by g h, so that eps L/(g h²) of that may be left. At the shorter steps this exceeds the tolerance of 1e-12.")
MULTIPLIERS = (
    "Where rows depend on each other, the impulses p are not unique: all with the same J^T p are solutions. The motion and the net "
    "force of the joints of one place are unique. The part of p that has no effect depends on the relaxation. `direct` (whose shift "
    "of hard rows is refined away), `conjugate_gradients` and `nesterov_jacobi` only ever add D^-1 N q, with D the diagonal blocks of N "
    "(`direct`: the mean of a block's diagonal). Started from zero, they end at the impulses of least norm sqrt(p . D p). "
    "`gauss_seidel` adds to one joint after the other, and what each gets depends on their order. A warm start uses the "
    "impulses of the last step and keeps their part that has no effect.")


def rotation(results):
    section = Section(
        "How accurately do bodies rotate?",
        "At which order do the integrators approach the motion of rigid bodies? There are two: a free body, with the implicit and with the explicit "
        "gyroscopic torque, and a heavy top that precesses on a compliant or a hard joint. Both are compared with the judge `ode`, at points "
        "at the radii of gyration. Then a free body turns about its middle axis and tumbles. What happens to its energy and angular "
        "momentum, and how far is its period from that of elliptic integrals? The bound of that error is the estimate from two steps, "
        "|T(h) - T(2h)|/3 for an order of two, times a safety factor of 1.25 [@roache1994perspective].",
        figures=[
            Figure("rotation_errors", "Error of the worst point and time over the step, relative to the largest displacement. "
                   "Triangles show the orders 1 and 2. Crossed: the error exceeds the motion, or the simulation failed."),
            Figure("rotation_orders", "Observed orders of the four finest steps."),
            Figure("rotation_series", "A free body turning about its middle axis: changes since the start. The axis of the energy "
                   "is linear between -1e-6 and 1e-6. Crossed: the run ended badly, or a step of it was not solved."),
            Figure("rotation_tumbling", "Error of the period of tumbling, integrators of second order.")])
    section.tell(results.table("rotation", "errors"), lambda frame: GYROSCOPIC, resolved_text)
    section.tell(results.table("rotation", "orders"), lost_text, limited_text, orders_table)
    section.tell(results.table("rotation", "series"), change_text, change_table)
    return section.tell(results.table("rotation", "tumbling"), tumbling_text, tumbling_table)


def limited_text(orders):
    """The orders where less is expected than of the integrator elsewhere."""
    limited = orders[orders["order_expected"] < orders.groupby(rule_names(orders))["order_expected"].transform("max")]
    rows = good(limited, "order")
    if limited.empty:
        return "No motion limits the order of any integrator."
    return (f"On {listed(limited['scene'].unique())} the integrators of second order show orders of {span(rows['order'])} in "
            f"the {len(rows)} of {counted(len(limited), 'course')} that are ok.")


def ends(series):
    """The last row of each run, with the last changes there are and the run's status."""
    named = series.assign(rule=rule_names(series))
    return named.groupby(["torque", "rule"], sort=False).last().reset_index()  # of each column the last number


def change_text(series):
    last = ends(series).set_index(["torque", "rule"])
    parts = [f"{number(last.loc[(torque, rule), 'energy_change'])} with `{rule}` and the {torque} torque"
             for rule in ("implicit_euler", "midpoint") for torque in ("implicit", "explicit") if (torque, rule) in last.index]
    bad = last[last["status"] != "ok"]
    text = (f"Change of the energy after {number(series['time_s'].max())} s at h = {step_text(series['step_s'].max())}, of that at "
            f"the start: {'; '.join(parts)}. ")
    return text + ("Every run is ok." if bad.empty else "Not ok: " + "; ".join(
        f"`{rule}` with the {torque} torque ({row['status']}: {row['reason']})" for (torque, rule), row in bad.iterrows()) + ".")


def change_table(series):
    rows = [[r["torque"], f"`{r['rule']}`", number(r["time_s"]),
             *(f"{r[c]:+.2g}" if np.isfinite(r[c]) else "not a number"
               for c in ("energy_change", "momentum_change", "momentum_length_change")),
             f"`{r['status']}`"] for _, r in ends(series).iterrows()]
    return Table("Relative changes of energy, angular momentum and its length at the end, or the last ones there are.",
                 ["torque", "integrator", "time (s)", "energy", "momentum", "length", "status"], rows)


def tumbling_text(frame):
    """How the error of the period falls from the longer step to the shorter."""
    rows = good(frame, "error").assign(rule=lambda f: rule_names(f))
    errors = rows.pivot_table("error", ["disturbance_rad_s", "rule"], "step_s")
    fine = frame["step_s"].min()
    both = errors.dropna()
    text = f"At h = {step_text(fine)} the period is wrong by {span(rows.loc[rows['step_s'] == fine, 'error'])} of it"
    if len(errors.columns) < 2 or both.empty:
        return text + "; no period is known at both steps."
    ratios = both[both.columns.max()] / both[fine]
    return text + f"; the error at h = {step_text(both.columns.max())} is {span(ratios)} times as large, 4 by the second order."


def tumbling_table(frame):
    """Errors at the shortest step, one row an integrator, one column a disturbance."""
    fine = frame[frame["step_s"] == frame["step_s"].min()]
    disturbances = list(fine["disturbance_rad_s"].unique())
    rows = []
    for name, group in fine.groupby(rule_names(fine), sort=False):
        found = {r["disturbance_rad_s"]: number(r["error"]) + ("" if r["status"] == "ok" else f", {r['status']}")
                 for _, r in group.iterrows()}
        rows.append([f"`{name}`", *(found.get(value, "") for value in disturbances)])
    exact = "; ".join(f"{number(value)} s" for value in fine.groupby("disturbance_rad_s", sort=False)["exact_s"].first())
    return Table(f"Relative error of the period, h = {step_text(fine['step_s'].iloc[0])}. Exact periods: {exact}.",
                 ["integrator", *(f"{number(value)} rad/s" for value in disturbances)], rows)


def joints(results):
    section = Section(
        "How accurately do joints carry mechanisms?",
        "Mechanisms with known answers: the pendulum A01, the four-bar chain A02 and Andrews' squeezer A03 of the IFToMM library "
        "of benchmarks [@gonzalez2006benchmarking], and a slider-crank whose motor fixes its motion. The answers are a closed "
        "form (pendulum), the equation of the one degree of freedom integrated by the judge (chain), published reference values "
        "(squeezer) and geometry (slider-crank). `newmark` with alpha = 1/2 and `midpoint`, marginal with hard joints, and the "
        "explicit `symplectic_euler` are left out. Then chains of bodies of growing length: four linearisations of at most ten "
        "sweeps, whatever the residual, timed.",
        figures=[
            Figure("joints_accuracy", "Error at the end, relative to the mechanism's size (squeezer: of angles modulo a turn, to "
                   "the largest one), and below it the largest error of a joint in any step. Triangles show the orders 1 and 2. "
                   "Crossed: a step missed its tolerance, or a joint came apart; a thin line joins these, too. Dashed: the bound of "
                   "the joints' error. The motor fixes the slider at every step, so that "
                   "only the solve's error is left."),
            Figure("joints_lengths", "Processor time over the length of a chain, smallest of five repeats; the triangle is linear.")])
    section.tell(results.table("joints", "accuracy"), lambda frame: SINGULAR, accuracy_text, accuracy_table)
    return section.tell(results.table("joints", "lengths"), lengths_text, lengths_table)


def accuracy_text(frame):
    missed = frame[frame["missed_steps"] > 0]
    solved = good(frame, "joint_error")
    text = (f"The largest error of a joint in any step is {span(solved['joint_error'])} m or rad in the {len(solved)} of "
            f"{counted(len(frame), 'run')} that are ok. ")
    return text + ("No step misses its tolerance." if missed.empty else "Steps that miss their tolerance: " + "; ".join(
        f"{number(rows['missed_steps'].sum())} of `{mechanism}` in {counted(len(rows), 'run')}"
        for mechanism, rows in missed.groupby("mechanism", sort=False)) + ".")


def accuracy_table(frame):
    """The shortest step of each mechanism and integrator, with the order of its error from the one before."""
    finest = frame[frame["step_s"] == frame.groupby("mechanism")["step_s"].transform("min")]
    rows = [[f"`{r['mechanism']}`", f"`{name}`", step_text(r["step_s"]), number(r["error"]),
             f"{r['order']:.2f}" if np.isfinite(r["order"]) else "", number(r["joint_error"]), number(r["missed_steps"]),
             number(r["wall_s"]), f"`{r['status']}`"]
            for name, (_, r) in zip(rule_names(finest), finest.iterrows())]
    return Table("Finest steps: error at the end, its order from the last halving, largest error of a joint, steps that missed "
                 "their tolerance, wall time (s) of the run.",
                 ["mechanism", "integrator", "step", "error", "order", "joint", "missed", "time", "status"], rows)


def lengths_text(frame):
    first = frame.groupby("relaxation", sort=False).first()
    bodies = frame["bodies"]
    return (f"From {bodies.min():.0f} to {bodies.max():.0f} bodies the time of a step grows as the length to the power of "
            f"{span(first['exponent_step'])}, that of a sweep to {span(first['exponent_sweep'])}; 1 is linear. Bodies in a chain "
            "couple to their neighbours alone, so that a factor in the chain's order holds a bounded number of entries a body.")


def lengths_table(frame):
    longest = frame[frame["bodies"] == frame["bodies"].max()]
    return Table(f"A chain of {longest['bodies'].iloc[0]:.0f} bodies: processor time (s) and exponents of the length.",
                 ["relaxation", "a step", "a sweep", "exponent, step", "exponent, sweep", "status"],
                 [[f"`{r['relaxation']}`", number(r["cpu_s_per_step"]), number(r["cpu_s_per_sweep"]), f"{r['exponent_step']:.3f}",
                   f"{r['exponent_sweep']:.3f}", f"`{r['status']}`"] for _, r in longest.iterrows()])


def redundant(results):
    section = Section(
        "Do redundant joints change the motion?",
        "A chain of two four-bar linkages gets up to three more hinges, each on the axis of a hinge that it has already. Does it still move "
        "in the same way, and is the net force between a leg and a coupler the same, however the relaxation shares out the "
        "impulses? Steps are solved to 1e-12 of their scale.",
        figures=[Figure("redundant_motion", "Largest difference of positions and of net forces in the plane (of the largest force) "
                        "to the same relaxation without redundant joints, and largest difference of the impulses that joints of "
                        "one place share (of their sum). Dashed: the bounds. Crossed: some step was not solved, or the run "
                        "diverged; at the lower edge the run without redundant joints.")])
    return section.tell(results.table("redundant", "motion"), lambda frame: MULTIPLIERS, redundant_text, redundant_table)


def redundant_text(frame):
    more = frame[frame["redundant_joints"] > 0]
    bad = failed(more, "position_difference_m", "net_force_difference")
    return (f"{share(len(more) - len(bad), len(more))} runs with redundant joints solve every step. Positions then differ by "
            f"{span(more['position_difference_m'])} m and net forces by {span(more['net_force_difference'])} of the largest; what the "
            f"joints of one place carry each differs by {span(more['split'])} of their sum.")


def redundant_table(frame):
    return Table(f"Chains with redundant joints, h = {step_text(frame['step_s'].iloc[0])}: differences, work, and steps that missed "
                 "their tolerance.",
                 ["relaxation", "joints", "positions (m)", "forces", "shares", "sweeps", "missed", "status"],
                 [[f"`{r['relaxation']}`", number(r["redundant_joints"]), number(r["position_difference_m"]),
                   number(r["net_force_difference"]), number(r["split"]), f"{r['sweeps']:.0f}", number(r["missed_steps"]),
                   f"`{r['status']}`"] for _, r in frame.iterrows()])
