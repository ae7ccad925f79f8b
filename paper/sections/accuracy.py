"""Do solutions agree with the references, and with the continuum?"""

from content import Figure, Section, Table, counted, number, share, span
from selecting import failed, good, step_text


def judges(results):
    section = Section(
        "Do the judges agree?",
        "Two references solve the same step: Newton's method with sparse factorisations, and an interior point method. "
        "They share the statement of masses, energies and constraints, and nothing of the solver under test. How far apart "
        "are their solutions? Where rigid bodies are joined, the solver's own step stands beside them.",
        figures=[Figure("judges_agreement", "Relative difference of the positions found by the references, by the experiment "
                        "that the step is of. The table has the residual that each claims, too.")])
    frame = results.table("judges", "agreement")
    if frame is not None:
        rows = good(frame, "difference")
        section.paragraphs.append(
            f"{len(rows)} of {counted(len(frame), 'pair')} could be compared. Their differences are "
            f"{span(rows['difference'])}, relative to the largest displacement of the step; an error measured against a "
            "judge means nothing below these numbers.")
        section.tables.append(Table(
            "Agreement of the judges, one step each.",
            ["scene", "nodes", "step", "first", "second", "difference", "residuals", "seconds", "status"],
            [[f"`{r['scene']}`", f"{r['nodes']:.0f}", step_text(r["step_s"]), f"`{r['reference_a']}`",
              f"`{r['reference_b']}`", number(r["difference"]), f"{number(r['residual_a'])}, {number(r['residual_b'])}",
              f"{number(r['wall_s_a'])}, {number(r['wall_s_b'])}", f"`{r['status']}`"] for _, r in frame.iterrows()]))
    return section


def dual_vs_primal(results):
    section = Section(
        "Is the dual solution the primal one?",
        "Regularised constraints [@servin2006interactive] are the dual form of an elasticity problem. Does relaxation "
        "reach the minimum of the incremental potential, found by Newton's method on the energy?",
        paragraphs=["`xpbd` is a rival: XPBD as engines do it [@macklin2016xpbd]. It begins without multipliers, and has one row sqrt(2 U) a "
                    "tetrahedron where `incremental` has six strains. It ends beside the solution, since its corrections were made along the "
                    "directions of all places on the way.",
                    "`vbd` is a rival on the primal side: vertex block descent [@chen2024vbd], a Newton step of the energy by one node after the "
                    "other. It has no multipliers: its sweeps are block Gauss-Seidel's on the energy, and where they end is the solution, "
                    "but for rounding: the stiffer the solid, the more sweeps it takes."],
        figures=[
            Figure("dual_vs_primal_errors", "Error against the primal Newton solution, relative to the largest displacement "
                   "of the step, over the sweeps, at the middle stiffness of each mesh and strain."),
            Figure("dual_vs_primal_final", "Final error of every method and material; a cross marks a status other than "
                   "`ok`.")])
    frame = results.table("dual_vs_primal", "final")
    if frame is not None:
        section.tables.append(Table("Final errors over all materials.", ["outer", "relaxation", "ok", "error"], [
            [f"`{outer}`", f"`{relaxation}`", share(len(group) - len(failed(group, "error")), len(group)), span(group["error"])]
            for (outer, relaxation), group in frame.groupby(["outer", "relaxation"], sort=False)]))
    return section


def mesh_refinement(results):
    section = Section(
        "Do the solids approach the continuum?",
        "A clamped beam is refined. It is made of linear tetrahedra, or of a mass-spring network on the same mesh, whose one "
        "stiffness is fitted to both load cases on each mesh. Both are compared with Timoshenko's beam and with the rod. A manufactured "
        "solution gives the order of convergence [@roache1994perspective].",
        figures=[
            Figure("mesh_refinement_beam", "Relative error of bending compliance and first frequency against Timoshenko's "
                   "beam, of axial compliance against the rod, of lateral over axial strain against nu."),
            Figure("mesh_refinement_locking", "Deflection of linear tetrahedra over that of beam theory as nu tends to 1/2 (to the left)."),
            Figure("mesh_refinement_mms", "Manufactured solution, error against the exact displacement; triangles show the "
                   "expected orders.")])
    beam, mms = results.table("mesh_refinement", "beam"), results.table("mesh_refinement", "mms")
    if beam is not None:
        section.tables.append(Table("Errors on the finest mesh that is ok.", ["quantity", "model", "mesh n", "error"], [
            finest(quantity, model, rows) for (quantity, model), rows in beam.groupby(["quantity", "model"], sort=False)]))
        section.paragraphs.append(nearer_text(beam))
    if mms is not None:
        last = mms.sort_values("n").iloc[-1]
        section.paragraphs.append(f"The manufactured solution converges with order {last['order_l2']:.2f} in the L2 norm and "
                                  f"{last['order_h1']:.2f} in the H1 seminorm at n = {last['n']:.0f}.")
    return section.tell(results.table("mesh_refinement", "locking"), locking_text)


def locking_text(frame):
    """How much of the beam's deflection each mesh keeps."""
    parts = [f"{span(rows['value'] / rows['reference_beam'])} (n = {n:.0f})" for n, rows in frame.groupby("n")]
    return (f"From nu = {frame['poisson'].min():g} to {frame['poisson'].max():g} linear tetrahedra bend by these shares of beam theory: "
            f"{', '.join(parts)}. {len(good(frame, 'error_mesh'))} of {counted(len(frame), 'equilibrium')} are ok; they differ from the mesh's "
            f"own by {span(frame['error_mesh'])}.".replace("equilibriums", "equilibria"))


def nearer_text(beam):
    """In how many meshes the network is nearer to theory than the tetrahedra, per quantity that both have."""
    parts = []
    for quantity, rows in good(beam, "error_beam").groupby("quantity", sort=False):
        tets = rows[rows["model"].str.startswith("tet_p1")].groupby("n")["error_beam"].max()
        both = rows[rows["model"] == "springs"].set_index("n")["error_beam"].to_frame("springs").join(tets, how="inner")
        if len(both):
            parts.append(f"in `{quantity}` on {(both['error_beam'] < both['springs']).sum()} of {len(both)}")
    return ("The tetrahedra are nearer to theory than the fitted network, on so many meshes: " + ", ".join(parts) + ".") if parts \
        else "Tetrahedra and network have no mesh in common."


def finest(quantity, model, rows):
    ok = good(rows, "error_beam").sort_values("n")
    last = [f"{ok['n'].iloc[-1]:.0f}", number(ok["error_beam"].iloc[-1])] if len(ok) else ["", "unknown"]
    return [f"`{quantity}`", f"`{model}`", *last]
