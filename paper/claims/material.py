"""Claims about viscoelasticity and finite elements."""

from claims.claim import Claim, Finding, judge, some, verdict_rows, worst
from content import joined, number, share, span
from selecting import good


def dual(final):
    ours = some(final[(final["outer"] == "plain") & (final["relaxation"] == "nesterov_jacobi")], "run of `plain`, `nesterov_jacobi`")
    solved = ours[ours["status"] == "ok"]
    near = good(ours, "error")
    near = near[near["error"] <= 1e-8]
    others = final[final["outer"] == "incremental"]
    xpbd, vbd = (final[final["relaxation"] == rival] for rival in ("xpbd", "vbd"))
    return Finding(
        judge(len(near) == len(ours), len(near) == len(solved) > 0, f"steps that are solved, {share(len(solved), len(ours))}"),
        f"`plain` with `nesterov_jacobi`, the paper's method, ends at the primal minimum to {span(near['error'])} in "
        f"{share(len(near), len(ours))} runs. `incremental` ends at {span(others['error'])}, XPBD with one row a tetrahedron at "
        f"{span(xpbd['error'])} after {span(xpbd['sweeps'])} sweeps, vertex block descent at {span(vbd['error'])} after "
        f"{span(vbd['sweeps'])}.",
        share(len(near), len(ours)), f"{len(ours)} of {len(ours)} within 1e-8")


def stiffness(stretches, motion, meshes):
    solved = some(stretches[stretches["variant"] == "converged"], "chain that is solved to the end")
    right = (solved["status"] == "ok") & (solved["error"] <= 1e-6)
    classic = stretches[(stretches["variant"] == "classic") & (stretches["factor"] < 1)].groupby(["factor", "sweeps"])["stretch_m"]
    times = classic.max() / classic.min()
    springs = verdict_rows(motion, "time_order.spring.", "time_order.compliant_links.")
    statics = verdict_rows(meshes[meshes["id"].str.endswith(".solver")], "mesh.")
    held = [(rows["verdict"] == "holds") for rows in (springs, statics)]
    return Finding(
        judge(False, right.all() and all(rows.all() for rows in held), "linear problems solved to the end"),
        f"A compliant chain that is solved to the end hangs longer by the sum of m g A to {number(solved['error'].max(skipna=False))} of it at "
        f"h = {span(solved['step_s'])} s; classic PBD's relaxation factor stretches {span(times)} times as far at the longest as at the "
        f"shortest step. The static equilibrium of solids is the mesh's own to {number(worst(statics)['measured'])}, and springs approach their motion "
        f"at the integrator's order in {share(held[0].sum(), len(springs))} cases.",
        number(worst(statics)["measured"]), number(worst(statics)["bound"]))


def damped(verdicts):
    held = verdicts["verdict"] == "holds"
    row = worst(verdicts)
    return Finding(judge(held.all(), held.any(), f"{share(held.sum(), len(held))} verdicts"),
                   "Decrements, orders, limits, and rigid motion that is left alone: "
                   f"{share(held.sum(), len(held))} verdicts hold; nearest to its bound is `{row['id']}` ({row['quantity']}).",
                   number(row["measured"]), number(row["bound"]))


def continuum(verdicts, beam):
    rows = verdict_rows(verdicts, "mesh.")
    held = rows["verdict"] == "holds"
    order = worst(verdict_rows(verdicts, "mesh.mms"))
    bending = good(beam[(beam["model"] == "tet_p1") & (beam["quantity"] == "compliance_j")], "error_beam").sort_values("n")
    last = some(bending, "beam of tetrahedra").iloc[-1]
    falls = bending["error_beam"].is_monotonic_decreasing
    return Finding(
        judge(held.all() and falls, held.all(), "a manufactured solution, not the beam"),
        f"The manufactured solution converges at orders at most {number(order['measured'])} from 2 (L2) and 1 (H1). In bending the error "
        f"falls to {number(last['error_beam'])} on the finest mesh, n = {number(last['n'])}.",
        number(order["measured"]), number(order["bound"]))


def nearer(beam):
    """Of each quantity that both have: errors of network and tetrahedra, mesh by mesh; NaN where one is not ok."""
    found = {}
    for quantity, rows in beam.groupby("quantity", sort=False):
        sides = {model: good(rows[rows["model"] == model], "error_beam").set_index("n")["error_beam"] for model in ("springs", "tet_p1")}
        meshes = sorted(set(rows.loc[rows["model"] == "springs", "n"]) & set(rows.loc[rows["model"] == "tet_p1", "n"]))
        if meshes:
            found[quantity] = sides["springs"].reindex(meshes), sides["tet_p1"].reindex(meshes)
    return some(found, "mesh of both tetrahedra and springs")


def beats_springs(beam):
    words = {"compliance_j": "in bending", "axial_j": "in tension", "frequency_hz": "in the first frequency", "poisson": "in lateral contraction"}
    parts, whole, lost = [], [], []
    for quantity, (springs, tets) in nearer(beam).items():
        word = words.get(quantity, quantity)
        theirs, ours = (springs < tets).sum(), (tets < springs).sum()
        errors = " against ".join(", ".join(number(error) for error in side) for side in (springs, tets))
        text = f"{word} the springs are nearer on {share(theirs, len(springs))} meshes, the FEM constraint on {ours} " \
               f"(errors {errors})"
        parts.append(text)
        (whole if ours == len(tets) else lost).append(word)
    count, text = len(whole), "; ".join(parts)
    return Finding(
        judge(not lost, whole, joined(word.removeprefix("in ") for word in whole)),
        f"Beside the FEM constraint on the same meshes, against theory: {text}. The springs have one stiffness, fitted to both load cases.",
        f"{share(count, len(parts))} load cases", f"{len(parts)} of {len(parts)}", f"Against theory, {text}." if lost else "")


def incompressible(sweeps, locking):
    rows = some(sweeps[(sweeps["parameter"] == "poisson") & (sweeps["relaxation"] != "direct")], "case of Poisson's ratio")
    solved = {name: (len(good(group, "sweeps")), len(group)) for name, group in rows.groupby("relaxation", sort=False)}
    nesterov = solved.get("nesterov_jacobi", (0, 0))
    exact = good(locking, "error_mesh")["error_mesh"] <= 1e-6
    finest = some(locking[locking["n"] == locking["n"].max()], "deflection").sort_values("poisson")
    shares = finest["value"] / finest["reference_beam"]
    locks = shares.iloc[-1] < shares.max() / 2
    told = (f"at n = {finest['n'].iloc[0]:.0f} cells across, linear tetrahedra bend by {number(shares.max())} of beam theory at best and by "
            f"{number(shares.iloc[-1])} at nu = {finest['poisson'].iloc[-1]:g}")
    directly = exact.all() and len(exact) == len(locking)
    return Finding(
        judge(directly and all(done == total for done, total in solved.values()),
              directly and any(done == total for done, total in solved.values()),
              joined(f"`{name}`" for name, (done, total) in solved.items() if done == total)),
        f"Up to nu = {rows['value'].max():g} the linearised step of a cantilever is solved in "
        + ", ".join(f"{share(*counts)} cases by `{name}`" for name, counts in solved.items())
        + f". Equilibria up to nu = {locking['poisson'].max():g}, solved directly, are the mesh's own to 1e-6 in {share(exact.sum(), len(locking))} "
        f"cases. But {told}.", share(*nesterov), f"{nesterov[1]} of {nesterov[1]}",
        f"The elements lock: {told}." if locks else "")


CLAIMS = (
    Claim(20, "Constraint solving is the dual of an elasticity problem.",
          "our constraint solving problem is just the dual variables formulation of an equivalent elasticity problem",
          ("dual_vs_primal/final",), dual, "dual_vs_primal_final"),
    Claim(21, "Regularised constraints have the physical stiffness.", "by employing regularization of nonlinear constraints [...] we bridge constraint-based methods to traditional force-based methods",
          ("softness/stretches", "time_order/verdicts", "mesh_refinement/verdicts"), stiffness, "softness_steps"),
    Claim(22, "Damping is that of its coefficient.", "to incorporate soft constraints, damping and FEM into PBD", ("damping/verdicts",),
          damped, "damping_decrements"),
    Claim(23, "The FEM constraint follows the continuum.",
          "in a physically correct manner using the theory of continua and the finite element method",
          ("mesh_refinement/verdicts", "mesh_refinement/beam"), continuum, "mesh_refinement_mms"),
    Claim(24, "It is more accurate than mass-spring systems.", "that is more accurate than PBD mass-spring systems",
          ("mesh_refinement/beam",), beats_springs, "mesh_refinement_beam"),
    Claim(25, "The dual form stays solvable as nu tends to 1/2.", "", ("conditioning/sweeps", "mesh_refinement/locking"), incompressible, "conditioning_sweeps"),
)
