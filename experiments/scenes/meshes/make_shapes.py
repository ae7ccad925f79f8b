#!/usr/bin/env python3
"""Makes the animals of the scenes: surfaces of blended ellipsoids, so that nobody's model is needed.

    python3 experiments/scenes/meshes/make_shapes.py        # needs numpy and python3-vtk9

bunny.off       a closed surface, about 0.2 m high
cow.msh         a lattice of tetrahedra, the cubes of 1/32 m that the cow reaches into, cut into six
cow.off         the cow's surface, for pictures: the lattice carries it
"""
import pathlib

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

FOLDER = pathlib.Path(__file__).resolve().parent

# Centres, half axes (m), and the turn about the y axis (rad) of ellipsoids; x is forward, z up.
BUNNY = [
    ((-0.020, 0, 0.075), (0.075, 0.058, 0.070), 0.2),
    ((0.055, 0, 0.140), (0.045, 0.040, 0.038), 0.2),
    ((0.025, 0.024, 0.200), (0.018, 0.014, 0.050), -0.35),
    ((0.025, -0.024, 0.200), (0.018, 0.014, 0.050), -0.35),
    ((-0.095, 0, 0.070), (0.024, 0.024, 0.024), 0),
    ((0.045, 0.034, 0.024), (0.032, 0.018, 0.022), 0),
    ((0.045, -0.034, 0.024), (0.032, 0.018, 0.022), 0),
    ((-0.030, 0.050, 0.030), (0.048, 0.022, 0.030), 0),
    ((-0.030, -0.050, 0.030), (0.048, 0.022, 0.030), 0),
]
COW = [
    ((0, 0, 0.62), (0.46, 0.20, 0.22), 0),
    ((0.38, 0, 0.70), (0.20, 0.13, 0.17), 0.5),
    ((0.60, 0, 0.84), (0.17, 0.10, 0.10), 0.45),
    ((0.72, 0, 0.78), (0.08, 0.075, 0.07), 0.3),
    ((0.50, 0.14, 0.90), (0.05, 0.09, 0.035), 0),
    ((0.50, -0.14, 0.90), (0.05, 0.09, 0.035), 0),
    ((0.54, 0.07, 0.97), (0.035, 0.035, 0.08), 0),
    ((0.54, -0.07, 0.97), (0.035, 0.035, 0.08), 0),
    ((0.30, 0.12, 0.27), (0.075, 0.065, 0.29), 0),
    ((0.30, -0.12, 0.27), (0.075, 0.065, 0.29), 0),
    ((-0.32, 0.12, 0.27), (0.085, 0.07, 0.29), 0),
    ((-0.32, -0.12, 0.27), (0.085, 0.07, 0.29), 0),
    ((-0.18, 0, 0.40), (0.10, 0.09, 0.08), 0),
    ((-0.49, 0, 0.56), (0.035, 0.035, 0.24), 0.12),
]


def distance(ellipsoids, blend, x):
    """About the distance from the blended ellipsoids (m), negative inside; x of shape (..., 3)."""
    total = np.zeros(x.shape[:-1])
    for centre, axes, turn in ellipsoids:
        own = x - np.array(centre)
        cosine, sine = np.cos(turn), np.sin(turn)
        own = np.stack([cosine * own[..., 0] - sine * own[..., 2], own[..., 1],
                        sine * own[..., 0] + cosine * own[..., 2]], axis=-1) / np.array(axes)
        total += np.exp(-(np.linalg.norm(own, axis=-1) - 1) * min(axes) / blend)
    return -blend * np.log(np.maximum(total, 1e-300))


def grid_about(ellipsoids, cell):
    centres, axes = np.array([e[0] for e in ellipsoids]), np.array([e[1] for e in ellipsoids])
    reach = axes.max(axis=1)[:, None] + 2 * cell
    low = cell * np.floor((centres - reach).min(axis=0) / cell)
    counts = np.ceil(((centres + reach).max(axis=0) - low) / cell).astype(int) + 1
    lines = [low[k] + cell * np.arange(counts[k]) for k in range(3)]
    return low, counts, np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1)


def surface(ellipsoids, blend, cell):
    """Nodes and triangles of the surface, anticlockwise from outside."""
    low, counts, x = grid_about(ellipsoids, cell)
    value = distance(ellipsoids, blend, x)
    # Nothing passes so near a node of the grid that it makes a sliver there.
    near = np.abs(value) < 0.2 * cell
    value[near] = np.where(value[near] < 0, -0.2 * cell, 0.2 * cell)
    image = vtk.vtkImageData()
    image.SetDimensions(*counts)
    image.SetSpacing(cell, cell, cell)
    image.SetOrigin(*low)
    image.GetPointData().SetScalars(numpy_to_vtk(value.ravel(order="F"), deep=True))
    contour = vtk.vtkFlyingEdges3D()
    contour.SetInputData(image)
    contour.SetValue(0, 0)
    largest = vtk.vtkPolyDataConnectivityFilter()
    largest.SetInputConnection(contour.GetOutputPort())
    largest.SetExtractionModeToLargestRegion()
    clean = vtk.vtkCleanPolyData()
    clean.SetInputConnection(largest.GetOutputPort())
    clean.Update()
    found = clean.GetOutput()
    nodes = vtk_to_numpy(found.GetPoints().GetData()).astype(float)
    triangles = vtk_to_numpy(found.GetPolys().GetData()).reshape(-1, 4)[:, 1:]
    a, b, c = (nodes[triangles[:, k]] for k in range(3))
    if np.einsum("ij,ij->", a, np.cross(b, c)) < 0:
        triangles = triangles[:, ::-1]
    return nodes, triangles


def lattice(ellipsoids, blend, cell):
    """Nodes and tetrahedra of the cubes whose middle is inside."""
    low, _, x = grid_about(ellipsoids, cell)
    inside = distance(ellipsoids, blend, x + cell / 2) < 0
    cubes = np.argwhere(inside)
    offsets = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1], [1, 1, 1]])
    six = np.array([[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]])
    corners = cubes[:, None, :] + offsets[None]
    unique, number = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    number = number.reshape(-1, 8)
    return low + cell * unique, number[:, six].reshape(-1, 4)


def write_off(name, nodes, triangles):
    with open(FOLDER / name, "w", encoding="utf-8") as out:
        out.write(f"OFF\n{len(nodes)} {len(triangles)} 0\n")
        out.writelines(f"{x:.6g} {y:.6g} {z:.6g}\n" for x, y, z in nodes)
        out.writelines(f"3 {a} {b} {c}\n" for a, b, c in triangles)


def write_msh(name, nodes, tetrahedra):
    with open(FOLDER / name, "w", encoding="utf-8") as out:
        out.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{len(nodes)}\n")
        out.writelines(f"{i + 1} {x:.8g} {y:.8g} {z:.8g}\n" for i, (x, y, z) in enumerate(nodes))
        out.write(f"$EndNodes\n$Elements\n{len(tetrahedra)}\n")
        out.writelines(f"{i + 1} 4 0 {' '.join(str(k + 1) for k in t)}\n" for i, t in enumerate(tetrahedra))
        out.write("$EndElements\n")


def main():
    nodes, triangles = surface(BUNNY, 0.006, 0.0125)
    write_off("bunny.off", nodes, triangles)
    print("bunny", len(nodes), "nodes", len(triangles), "triangles")
    nodes, tetrahedra = lattice(COW, 0.02, 1 / 16)
    write_msh("cow.msh", nodes, tetrahedra)
    print("cow", len(nodes), "nodes", len(tetrahedra), "tetrahedra")
    nodes, triangles = surface(COW, 0.02, 1 / 32)
    write_off("cow.off", nodes, triangles)
    print("cow's surface", len(nodes), "nodes", len(triangles), "triangles")


if __name__ == "__main__":
    main()
