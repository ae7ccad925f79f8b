"""Claims about energy and momentum."""

import numpy as np
import pandas as pd

from claims.claim import Claim, Finding, all_at_most, judge, some, verdict_rows, worst
from content import listed, number, share
from selecting import rule_names


def ends(series):
    """One row a run at the largest step: status, and the change of the energy over its scale, at the end and the most."""
    series = series[series["step_s"] == series["step_s"].max()]
    rows = []
    for keys, run in series.assign(rule=rule_names(series)).groupby(["scene", "rule"], sort=False):
        run = run.sort_values("time_s")
        change = (run["energy_j"] - run["energy_j"].iloc[0]) / run["scale_j"].iloc[0]
        rows.append((*keys, run["alpha"].iloc[0], change.iloc[-1], change.abs().max(), *run[["status", "reason"]].iloc[-1]))
    return pd.DataFrame(rows, columns=["scene", "rule", "alpha", "change", "most", "status", "reason"])


def conservative(series):
    runs = ends(series)
    euler = runs[(runs["rule"] == "implicit_euler") & (runs["status"] == "ok")].set_index("scene")["change"].abs()
    newmark = runs[(runs["alpha"] > 0.5) & (runs["alpha"] < 1) & runs["scene"].isin(euler.index)]
    some(newmark, "run of `newmark` between alpha 1/2 and 1 beside one of implicit Euler")
    better = (newmark["status"] == "ok") & (newmark["change"].abs() < newmark["scene"].map(euler))
    scenes = [scene for scene, held in better.groupby(newmark["scene"], sort=False) if held.all()]
    missed = newmark[~better]
    return Finding(
        judge(better.all(), scenes, f"{listed(scenes)}, not on {listed(missed['scene'].unique())}"),
        f"`newmark` with alpha from {number(newmark['alpha'].min())} to {number(newmark['alpha'].max())} solves all and changes the energy "
        f"less than implicit Euler in {share(better.sum(), len(newmark))} runs."
        + ("" if better.all() else " The others: " + "; ".join(
            f"`{row['rule']}` on `{row['scene']}` ({row['reason'] or 'changes more'})" for _, row in missed.iterrows()) + "."),
        share(better.sum(), len(newmark)), f"{len(newmark)} of {len(newmark)}")


def conserving(verdicts, series):
    spring = worst(verdict_rows(verdicts, "energy.spring.newmark"))
    runs = ends(series)
    lost = runs[(runs["rule"] == "newmark 0.5") & ~((runs["status"] == "ok") & np.isfinite(runs["change"]))]
    against = "" if lost.empty else "Newmark's rule with alpha = 1/2 fails: " + "; ".join(
        f"on `{row['scene']}` it " + ("diverges" if row["status"] == "diverged" else "does not solve every step")
        + f" ({row['reason']}; the energy moves by up to {number(row['most'])} of its scale)"
        for _, row in lost.iterrows()) + "."
    holds = spring["verdict"] == "holds"
    return Finding(
        judge(holds and lost.empty, holds, "linear springs"),
        f"With alpha = 1/2 the energy of a linear spring is kept over 10 s to {number(spring['measured'])}. {against}".strip(),
        number(spring["measured"]), number(spring["bound"]), against)


def predicted_loss(verdicts):
    row = worst(verdict_rows(verdicts, "energy.spring.implicit_euler"))
    return Finding(judge(row["verdict"] == "holds"),
                   "What implicit Euler leaves of a linear spring's energy differs from (1 + (w h)²) to the power -N by "
                   f"{number(row['measured'])}, relative.", number(row["measured"]), number(row["bound"]))


def momentum(verdicts, runs):
    linear, angular = (worst(verdict_rows(verdicts, name)) for name in ("energy.linear_momentum", "energy.angular_momentum.loss"))
    solved = runs[(runs["max_outer"] > 1)]
    keeps = all_at_most(solved["angular_error"], 1e-10) and len(solved) > 0
    held = linear["verdict"] == "holds"
    changing = solved[~(solved["angular_error"] <= 1e-10)]
    return Finding(
        judge(held and keeps, held, "linear momentum, angular momentum with some integrators alone"),
        f"Linear momentum changes by at most {number(linear['measured'])}, also where steps are stopped early. Angular momentum changes by "
        f"more than 1e-10 with {listed(rule_names(changing).unique())}, by the derived amounts to "
        f"{number(angular['measured'])}.", number(linear["measured"]), number(linear["bound"]))


CLAIMS = (
    Claim(8, "The method can be made more conservative and stay stable.",
          "how it can be made more conservative while maintaining its stability properties", ("energy/series",), conservative,
          "energy_series"),
    Claim(9, "Newmark's integrator conserves energy.", "the energy conserving Newmark integrator",
          ("energy/verdicts", "energy/series"), conserving, "energy_series"),
    Claim(10, "Implicit Euler damps linear modes by the theoretical factor.", "", ("energy/verdicts",), predicted_loss,
          "energy_series"),
    Claim(11, "Linear and angular momentum are conserved without external force.", "", ("energy/verdicts", "energy/momentum"),
          momentum, "energy_momentum"),
)
