"""How methods look, the same in every figure, and matplotlib's settings."""

import zlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

# Okabe and Ito's colours, told apart by colour-blind readers; marker and line tell them apart in grey.
BLACK, ORANGE, SKY, GREEN, YELLOW, BLUE, RED, PURPLE = (
    "#000000", "#E69F00", "#56B4E9", "#009E73", "#F0E442", "#0072B2", "#D55E00", "#CC79A7")
STYLES = {
    "gauss_seidel": (BLUE, "o", "-"), "jacobi": (ORANGE, "s", "--"), "nesterov_jacobi": (GREEN, "^", "-."),
    "coloured_gauss_seidel": (SKY, "X", "-"), "conjugate_gradients": (PURPLE, "P", (0, (5, 1))),
    "direct": (BLACK, "D", ":"),
    "siconos_nsgs": ("#888888", "X", "-"), "siconos_nsn_ac": ("#8c564b", "h", "--"), "siconos_admm": ("#bcbd22", "p", "-."),
    "cone_interior_point": (SKY, "*", "-"), "cone_ipopt": (RED, "v", (0, (3, 1, 1, 1, 1, 1))),
    "ista": (RED, "v", "--"), "fista": (SKY, "*", "-"), "fista_restarted": ("#8c564b", "h", "--"),
    "mass_splitting": ("#888888", "X", "-"), "power_law": ("#bcbd22", "p", "-."),
    "plain": (RED, "o", "-"), "incremental": (SKY, "s", "--"), "proximal": (GREEN, "^", "-."),
    "quasi_newton": (PURPLE, "v", (0, (3, 1, 1, 1, 1, 1))), "frozen": (ORANGE, "P", ":"), "auto": (BLUE, "D", "-"),
    "judge": (BLACK, "*", ":"), "rival": (BLACK, "s", "--"), "newton": (BLACK, "s", "--"), "xpbd": (RED, "X", "-."),
    "vbd": ("#8c564b", "^", "-."),
    "pendulum": (BLUE, "o", "-"), "chain20": (RED, "s", "--"), "cantilever": (GREEN, "^", "-."),
    "implicit_euler": (BLACK, "o", "-"), "bdf2": (GREEN, "^", "-."), "midpoint": (SKY, "s", "--"),
    "symplectic_euler": (PURPLE, "v", (0, (3, 1, 1, 1, 1, 1))), "generalised_alpha": (BLUE, "P", (0, (5, 1))),
    "newmark 0.5": (RED, "D", ":"), "newmark 0.52": ("#888888", "X", "-"), "newmark 0.55": (ORANGE, "*", "--"),
    "newmark 0.6": ("#8c564b", "h", "-."), "newmark 1": (BLACK, "o", ":"),
    "coulomb": (BLUE, "o", "-"), "cone": (RED, "s", "--"), "box": (ORANGE, "D", "-."), "disc": (GREEN, "^", ":"),
    "tet_p1": (BLUE, "o", "-"), "tet_p1 reference": (BLACK, "^", ":"), "springs": (RED, "s", "--"),
}
RELAXATIONS = ("gauss_seidel", "jacobi", "nesterov_jacobi", "conjugate_gradients", "direct")  # the solver's own
FALLBACK = [(BLUE, "o", "-"), (RED, "s", "--"), (GREEN, "^", "-."), (PURPLE, "v", ":"), (ORANGE, "D", "-"),
            (SKY, "P", "--"), (BLACK, "X", "-.")]

plt.rcParams.update({
    "font.size": 8, "axes.titlesize": 8, "axes.titlepad": 9, "axes.labelsize": 8,
    "xtick.labelsize": 7, "ytick.labelsize": 7, "legend.fontsize": 7, "legend.frameon": False,
    "legend.handlelength": 2.6, "figure.titlesize": 9, "axes.spines.top": False, "axes.spines.right": False,
    "axes.grid": True, "grid.color": "#dddddd", "grid.linewidth": 0.5, "axes.axisbelow": True,
    "lines.linewidth": 1.2, "lines.markersize": 3.5,
    "figure.constrained_layout.use": True, "svg.hashsalt": "pbdcheck", "svg.fonttype": "none", "pdf.fonttype": 42,
    "savefig.dpi": 200,
})


def style(name):
    """Colour, marker and line of a method, the same in every figure."""
    color, marker, line = STYLES.get(name) or FALLBACK[zlib.crc32(name.encode()) % len(FALLBACK)]
    return {"color": color, "marker": marker, "linestyle": line}
