"""The frames that an experiment leaves of its scenes, as surfaces with colours."""

import re
import tomllib
from pathlib import Path

import numpy as np

SCENES = Path(__file__).resolve().parent.parent / "experiments" / "scenes"
LINE, TRIANGLE, TETRAHEDRON = 3, 5, 10  # VTK's types of cells
COLORS = ((0.33, 0.53, 0.76), (0.89, 0.58, 0.27), (0.42, 0.67, 0.45), (0.80, 0.42, 0.42), (0.60, 0.52, 0.75))
CLOTH, COW, HELD, GROUND = (0.80, 0.74, 0.62), (0.72, 0.55, 0.42), (0.72, 0.72, 0.70), (0.90, 0.90, 0.88)


def series(path):
    """Times (s) and files of a collection, none if it is not there."""
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    return [(float(time), path.parent / name) for time, name in re.findall(r'timestep="(\S+)" file="(\S+)"', text)]


def numbers(text, name, kind=float):
    """Of the data array called `name` of a .vtu file as `pbdcheck` writes it."""
    found = re.search(rf'<DataArray[^>]*Name="{name}"[^>]*>\s*(.*?)\s*</DataArray>', text, re.DOTALL)
    return np.array(found.group(1).split(), dtype=kind)


def read_points(path, name="points"):
    """Positions (m) of a frame, or another vector at its points."""
    return numbers(path.read_text(encoding="utf-8"), name).reshape(-1, 3)


def read_cells(path):
    """Cells as arrays of nodes by VTK's type."""
    text = path.read_text(encoding="utf-8")
    connectivity, offsets = numbers(text, "connectivity", int), numbers(text, "offsets", int)
    cells = {}
    for kind, begin, end in zip(numbers(text, "types", int), np.concatenate([[0], offsets[:-1]]), offsets):
        cells.setdefault(int(kind), []).append(connectivity[begin:end])
    return {kind: np.array(nodes) for kind, nodes in cells.items()}


def read_off(path):
    words = path.read_text(encoding="utf-8").split()[1:]
    nodes, triangles = int(words[0]), int(words[1])
    x = np.array(words[3:3 + 3 * nodes], dtype=float).reshape(-1, 3)
    cells = np.array(words[3 + 3 * nodes:3 + 3 * nodes + 4 * triangles], dtype=int).reshape(-1, 4)
    return x, cells[:, 1:]


def read_msh(path):
    """Nodes and tetrahedra of a mesh as make_shapes.py writes it."""
    text = path.read_text(encoding="utf-8")
    nodes = text.split("$Nodes")[1].split("$EndNodes")[0].split()
    x = np.array(nodes[1:], dtype=float).reshape(-1, 4)[:, 1:]
    cells = np.array(text.split("$Elements")[1].split("$EndElements")[0].split()[1:], dtype=int).reshape(-1, 7)
    return x, cells[:, 3:] - 1


class Carried:
    """A surface that a lattice of tetrahedra carries: each of its nodes by the tetrahedron it is in, or is nearest to."""

    def __init__(self, surface, lattice):
        x, self.triangles = read_off(surface)
        nodes, cells = read_msh(lattice)
        corners = nodes[cells]
        inverse = np.linalg.inv((corners[:, 1:] - corners[:, :1]).transpose(0, 2, 1))
        self.cells = np.empty((len(x), 4), dtype=int)
        self.weights = np.empty((len(x), 4))
        for i, place in enumerate(x):
            own = np.einsum("nij,nj->ni", inverse, place - corners[:, 0])
            weights = np.column_stack([1 - own.sum(axis=1), own])
            best = np.argmax(weights.min(axis=1))
            self.cells[i], self.weights[i] = cells[best], weights[best]

    def at(self, nodes):
        return np.einsum("nk,nkj->nj", self.weights, nodes[self.cells])


def skin(tetrahedra):
    """Triangles that one tetrahedron alone has."""
    faces = np.concatenate([np.delete(tetrahedra, k, axis=1) for k in range(4)])
    _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    return faces[first[count == 1]]


def connected(triangles, count):
    """The number of its component for each node; components are counted along the nodes."""
    label = np.arange(count)
    while True:
        least = label[triangles].min(axis=1)
        before = label.copy()
        for k in range(3):
            np.minimum.at(label, triangles[:, k], least)
        if np.array_equal(label, before):
            return np.unique(label, return_inverse=True)[1]


def vector(body, key):
    """What a scene file says of a body, zero unless it does."""
    return np.array(body.get(key, (0, 0, 0)), dtype=float)


def turned(direction, rotation):
    """A direction turned by a rotation vector (rad)."""
    angle = np.linalg.norm(rotation)
    axis = rotation / (angle or 1)
    return direction * np.cos(angle) + np.cross(axis, direction) * np.sin(angle) + axis * (axis @ direction) * (1 - np.cos(angle))


class Frames:
    """A scene's frames: `times` (s), and of each the surfaces and contacts; `grounds` are planes, each by a point (m) and its normal."""

    def __init__(self, folder):
        self.scene = folder.name
        self.nodes, self.bodies, self.contacts = (series(folder / f"{name}.pvd") for name in ("simulation", "bodies", "contacts"))
        self.times = [time for time, _ in self.nodes]
        self.carried = Carried(SCENES / "meshes" / "cow.off", SCENES / "meshes" / "cow.msh") if self.scene == "flexible_cow" else None
        stated = tomllib.loads((SCENES / f"{self.scene}.toml").read_text(encoding="utf-8")).get("rigid_body", [])
        self.grounds = [(vector(body, "position_m"), turned(np.array([0.0, 0, 1]), vector(body, "rotation_rad")))
                        for body in stated if body.get("shape") == "half_space"]
        self.held = [body.get("held") == "fixed" for body in stated if body.get("shape") != "half_space"
                     for _ in range(int(np.prod(body.get("copies", [1]))))]
        self.patches = list(self.colored())
        cells, none = read_cells(self.nodes[0][1]), np.empty((0, 2), dtype=int)
        self.links = none if {TRIANGLE, TETRAHEDRON} & cells.keys() else cells.get(LINE, none)

    def colored(self):
        """What is drawn: (whether it is of bodies, colour, triangles, whether their edges are seen)."""
        cells = read_cells(self.nodes[0][1])
        if self.carried:
            yield False, COW, self.carried.triangles, False
        elif {TRIANGLE, TETRAHEDRON} & cells.keys():
            triangles = cells[TRIANGLE] if TRIANGLE in cells else skin(cells[TETRAHEDRON])
            label = connected(triangles, triangles.max() + 1)[triangles[:, 0]]
            for k in np.unique(label):
                yield False, COLORS[-1 - k % len(COLORS)] if TETRAHEDRON in cells else CLOTH, triangles[label == k], True
        if self.bodies:
            triangles = read_cells(self.bodies[0][1])[TRIANGLE]
            label = connected(triangles, triangles.max() + 1)[triangles[:, 0]]
            held = np.array(self.held)[label]
            yield True, HELD, triangles[held], False
            for k, color in enumerate(COLORS):
                yield True, color, triangles[~held & (label % len(COLORS) == k)], False

    def surfaces(self, k):
        """Of frame k: (x, triangles, colour, whether edges are seen)."""
        nodes = read_points(self.nodes[k][1])
        x = {False: self.carried.at(nodes) if self.carried else nodes}
        if self.bodies:
            x[True] = read_points(self.bodies[k][1])
        return [(x[of_bodies], triangles, color, edges) for of_bodies, color, triangles, edges in self.patches if len(triangles)]

    def ropes(self, k):
        """Of frame k: (x, links), none where a surface is drawn of the nodes."""
        return read_points(self.nodes[k][1]), self.links

    def forces(self, k):
        """Points of contacts of frame k that press, and their forces (N) on the upper one of both."""
        if not self.contacts:
            return np.empty((0, 3)), np.empty((0, 3))
        place, force = (read_points(self.contacts[k][1], name) for name in ("points", "force"))
        pressing = np.linalg.norm(force, axis=1) > 0
        return place[pressing], (force * np.where(force[:, 2:] < 0, -1, 1))[pressing]
