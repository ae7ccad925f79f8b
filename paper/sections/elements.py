"""Elements beside springs on the same mesh."""

import numpy as np

from content import Figure, Section, Table, counted, joined, listed, number, share, span
from selecting import good

MODELS = {"tet_p1": "elements", "springs": "springs"}


def fem_vs_springs(results):
    section = Section(
        "Do elements move and touch as the solid does, and springs?",
        "Corotational tetrahedra beside springs along the edges of the same mesh. One number fits the springs to Young's modulus on each "
        "mesh; the elements are fitted to nothing. A clamped bar is bent and let go; a soft cube stands on the ground, under a plate and by "
        "itself, with and without friction.",
        figures=[
            Figure("fem_vs_springs_courses", "The tip of a bar that is let go, over beam theory's deflection; the trapezoidal rule."),
            Figure("fem_vs_springs_steps", "Error of the tip's course against the same mesh in continuous time, n = 1. Dotted: what the "
                   "integrator's formula makes of the first mode."),
            Figure("fem_vs_springs_cubes", "Widening at half the height of a cube under a plate. Dashed: the formula where nothing holds its faces.")])
    section.tell(results.table("fem_vs_springs", "bars"), bars_text, bars_table)
    section.tell(results.table("fem_vs_springs", "networks"), networks_text)
    section.tell(results.table("fem_vs_springs", "cubes"), cubes_text, cubes_table)
    return section.tell(results.table("fem_vs_springs", "cost"), cost_text, cost_table)


def told(value):
    """Nothing where there is nothing to compare with."""
    return "" if np.isnan(value) else number(value)


def against(model, true):
    return f"Against {model}. " if true else ""


def off(value, expected):
    return (value / expected - 1).abs()


def bars_text(frame):
    """Which of the two is nearer to beam theory in its first frequency, on how many meshes."""
    errors = frame.assign(error=off(frame["mesh_hz"], frame["beam_hz"])).pivot_table("error", "n", "model")
    if not {"tet_p1", "springs"} <= set(errors):
        return "Elements and springs have no mesh in common."
    nearer = (errors["springs"] < errors["tet_p1"]).sum()
    solved = frame[frame["status"] == "ok"]
    return (f"{against('elements', nearer > 0)}Springs are nearer to beam theory's first frequency on {share(nearer, len(errors))} meshes, off by "
            f"{span(errors['springs'])}, the elements by {span(errors['tet_p1'])}. They are fitted to a bending bar, and coarse linear elements lock. "
            f"What moves is the mesh: the measured frequency is that of the mesh by the integrator's formula to "
            f"{number(off(solved['frequency_hz'], solved['predicted_hz']).max(), 2)}, and what is left of the amplitude after a period to "
            f"{number(off(solved['left'], solved['predicted_left']).max(), 2)}.")


def bars_table(frame):
    return Table("Bars that are let go: the tip's first way and the frequency over those of beam theory, and what is left of the amplitude after a "
                 "period.", ["model", "mesh n", "integrator", "step", "way", "frequency", "left", "error of the course", "status"],
                 [[f"`{r['model']}`", f"{r['n']:.0f}", f"`{r['integrator']}`", f"{number(r['step_s'])} s", number(r["tip_m"] / r["tip_beam_m"]),
                   number(r["frequency_hz"] / r["beam_hz"]), number(r["left"]), told(r["error"]), f"`{r['status']}`"]
                  for _, r in frame.iterrows()], detail=True)


def networks_text(frame):
    last = frame.sort_values("n").iloc[-1]
    return (f"Springs pull along themselves alone. Moduli of such a network are symmetric in all four indices, so that an isotropic one has "
            f"Poisson's ratio {last['isotropic_poisson']:g} [@love1927treatise], and the lattice of this mesh, which is not isotropic, "
            f"{number(last['lattice_poisson'])}, whatever is asked. Cubes of n = {frame['n'].min():.0f} to {last['n']:.0f} cells, pulled by little, have "
            f"{number(frame.sort_values('n')['poisson'].iloc[0])} to {number(last['poisson'])}: the springs of their faces count the less the finer they are.")


def cubes_text(frame):
    """Where there is a formula: how far off sag and bulge are; and what became of the weight and the judge."""
    pressed = good(frame[(frame["scene"] == "plate") & (frame["friction_coefficient"] == 0)], "sag_expected_m", "bulge_expected")
    asked = pressed[pressed["poisson"] > 0]
    parts = [f"{MODELS.get(model, model)} widen by {span(rows['bulge'] / rows['bulge_expected'])} of what the formula says and sag by "
             f"{span(rows['sag_m'] / rows['sag_expected_m'])} of it" for model, rows in asked.groupby("model", sort=False)]
    done = frame[frame["status"] == "ok"]
    judged = frame[frame["judged_steps"] > 0]
    worst = off(asked["bulge"], asked["bulge_expected"]).groupby(asked["model"]).max()
    return (f"{against('springs', worst.get('springs', 0) > worst.get('tet_p1', np.inf))}Under a plate without friction {joined(parts) or 'nothing was solved'}, for nu = {span(asked['poisson'])}. "
            f"The ground carries the weight to {number(off(done['ground_n'], done['weight_n']).max(), 2)} in {share(len(done), len(frame))} cases. "
            f"Of {counted(int(judged['judged_steps'].sum()), 'step')} that the judge solved both models end where it does: in all off by {span(judged['off_judge'])} of the sag, where the tolerance allows "
            f"{span(judged['allowed_off_judge'])}.")


def cubes_table(frame):
    return Table("Cubes at rest: sag and bulge, and over the formula's where there is one.",
                 ["model", "mesh n", "load", "friction", "nu asked", "sag (mm)", "over formula", "bulge", "expected", "off the judge", "status"],
                 [[f"`{r['model']}`", f"{r['n']:.0f}", r["scene"], f"{r['friction_coefficient']:g}", f"{r['poisson']:g}", number(1e3 * r["sag_m"]),
                   told(r["sag_m"] / r["sag_expected_m"]), number(r["bulge"]), told(r["bulge_expected"]), told(r["off_judge"]),
                   f"`{r['status']}`"] for _, r in frame.iterrows()], detail=True)


def cost_text(frame):
    """Elements over springs, in rows and time."""
    keys = ["scene", "n", "relaxation"]
    both = good(frame, "wall_s").pivot_table(["rows", "wall_s", "sweeps"], keys, "model").dropna()
    if both.empty or not {"tet_p1", "springs"} <= set(both["rows"]):
        return "No step was solved by both."
    ratio = {column: both[column]["tet_p1"] / both[column]["springs"] for column in ("rows", "wall_s")}
    slower = (ratio["wall_s"] > 1).sum()
    return (f"{against('elements', 2 * slower > len(both))}At the same tolerance a step of elements has {span(ratio['rows'])} times the rows of one of springs and takes {span(ratio['wall_s'])} times as "
            f"long (by {listed(frame['relaxation'].unique())}); it is the slower one in {share(slower, len(both))} cases.")


def cost_table(frame):
    return Table("A step of each, mean of the first ones.", ["scene", "model", "mesh n", "relaxation", "rows", "outer iterations", "sweeps", "ms a step", "status"],
                 [[r["scene"], f"`{r['model']}`", f"{r['n']:.0f}", f"`{r['relaxation']}`", f"{r['rows']:.0f}", f"{r['outer_iterations']:.0f}",
                   f"{r['sweeps']:.0f}", number(1e3 * r["wall_s"]), f"`{r['status']}`"] for _, r in frame.iterrows()])
