"""The words of the report, on one page."""

from content import Section, Table

WORDS = {
    "step": "what one time step computes: velocities and positions at its end",
    "row": "one scalar constraint of a step; effects are made of rows",
    "effect": "what acts in a scene: gravity, links, strain, joints, contact, damping",
    "multiplier, impulse": "how hard a row pushes, times the step or not",
    "compliance": "the inverse of a constraint's stiffness; 0 is a hard constraint",
    "`plain`": "the paper's outer iteration: whole multipliers along directions that are refreshed",
    "`proximal`": "`plain` with a mass matrix raised by a bound of the geometric stiffness; ours",
    "`quasi_newton`": "one constant matrix a scene and a memory of past iterates; for compliant rows",
    "`auto`": "the default: `quasi_newton` for compliant solids, else `plain` where it is predicted to contract, else `proximal`",
    "`incremental`": "classic position based dynamics: increments along the directions of their iteration, much as XPBD's",
    "`frozen`": "one linearisation a step: velocity time stepping",
    "relaxation": "what solves the linearised step, by sweeps over its rows or by a factorisation",
    "`gauss_seidel`": "one row or block after the other, each at once in force",
    "`jacobi`": "all rows at once, damped",
    "`nesterov_jacobi`": "`jacobi` accelerated by Nesterov's momentum, with restart; the paper's",
    "`conjugate_gradients`": "on the dual problem, with the impulses that bounds and laws leave free",
    "`direct`": "factors the rows; with contact a semismooth Newton method, and an augmented Lagrangian to fall back on",
    "`coulomb`": "Coulomb's law of friction",
    "`cone`": "its convex relaxation: what slides also lifts; the paper's",
    "`box`": "friction bounded along each of two axes; the paper's box LCP variant",
    "`disc`": "`box` with a disc in the place of the box",
    "`implicit_euler`": "forces and directions of the step's end; first order, damps",
    "`newmark`": "alpha weighs the step's end: 1/2 is the trapezoidal rule, 1 implicit Euler",
    "`chain20`": "20 hard links over 1 m, 0.1 kg a node; the mass ratio is that of the last node to the others",
    "`cloth10`": "a sheet of 1 m by 1 m in 10 x 10 squares (121 nodes), held along one edge",
    "`cantilever`": "a beam of 1 m by 1/4 m by 1/4 m, clamped at one end, in tetrahedra; E is Young's modulus",
    "contraction, spectral radius": "the factor by which an iteration shrinks its error; it converges below 1",
    "residual": "by how much the equations of a step are not met",
    "error": "the distance to a reference, over the largest displacement of the step unless a unit is given",
    "judge": "a reference solver that shares no code with the solver",
    "rival": "another method, written for speed, to compare with",
    "gate": "a bound that a simulation of a hard case must keep",
    "verdict": "a size beside its bound: it holds if it lies from 0 to the bound, and never if it is not a number. A time is not decided if its repeats lie on both "
               "sides of the bound, a goal is missed, and neither is a failure",
    "`ok`, `not_converged`, `diverged`, `skipped`": "how a solve ended: solved, tolerance missed, residual or energy grew without bound, not tried",
    "tier": "`quick` or `full`: how large and how many the cases of a run are",
}


def glossary_section():
    return Section("Glossary", name="words", page=True, tables=[
        Table("The words of this report.", ["word", "what it means"], [list(entry) for entry in WORDS.items()])])
