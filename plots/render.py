"""Draws the frames that an experiment leaves of its scenes as pictures, by VTK and without a window."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np

SIZE = (720, 540)  # pixels
MESHES = Path(__file__).resolve().parent.parent / "experiments" / "scenes" / "meshes"
#: By scene: where the camera looks from and at (m), and what the ground is.
VIEWS = {
    "boxes_on_ground": {"from": (4.6, -6.0, 3.2), "at": (0, 0, 0.85), "ground": True},
    "bunnies_on_cloth": {"from": (1.9, -3.0, 1.7), "at": (0, 0, 0.4), "ground": False},
    "flexible_cow": {"from": (2.4, -3.9, 1.5), "at": (0.05, 0, 0.5), "ground": True},
}
COLORS = ((0.33, 0.53, 0.76), (0.89, 0.58, 0.27), (0.42, 0.67, 0.45), (0.80, 0.42, 0.42), (0.60, 0.52, 0.75))
CLOTH, COW, GROUND = (0.80, 0.74, 0.62), (0.72, 0.55, 0.42), (0.90, 0.90, 0.88)


def missing():
    """What rendering lacks here, or ''."""
    try:
        import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
    except ImportError:
        return "python3-vtk9"
    if not os.environ.get("DISPLAY") and not shutil.which("xvfb-run"):
        return "xvfb, and xauth"
    return ""


def numbers(text, name, kind=float):
    """Of the data array called `name` of a .vtu file as `pbdcheck` writes it."""
    found = re.search(rf'<DataArray[^>]*Name="{name}"[^>]*>\s*(.*?)\s*</DataArray>', text, re.DOTALL)
    return np.array(found.group(1).split(), dtype=kind)


def read_frame(path):
    """Positions, and cells as lists of nodes by VTK's type."""
    text = path.read_text(encoding="utf-8")
    points = re.search(r"<Points>\s*<DataArray[^>]*>\s*(.*?)\s*</DataArray>", text, re.DOTALL)
    x = np.array(points.group(1).split(), dtype=float).reshape(-1, 3)
    connectivity, offsets = numbers(text, "connectivity", int), numbers(text, "offsets", int)
    types = numbers(text, "types", int)
    cells = {}
    for kind, begin, end in zip(types, np.concatenate([[0], offsets[:-1]]), offsets):
        cells.setdefault(int(kind), []).append(connectivity[begin:end])
    return x, {kind: np.array(nodes) for kind, nodes in cells.items()}


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
        return np.einsum("nk,nkj->nj", self.weights, nodes[self.cells]), self.triangles


def connected(triangles, count):
    """The number of its component for each node."""
    label = np.arange(count)
    while True:
        least = label[triangles].min(axis=1)
        before = label.copy()
        for k in range(3):
            np.minimum.at(label, triangles[:, k], least)
        if np.array_equal(label, before):
            return np.unique(label, return_inverse=True)[1]


def surfaces(folder, scene, instant, carried):
    """What to draw: (x, triangles, colour)."""
    x, cells = read_frame(folder / "frames" / f"frame_{instant:06}.vtu")
    if scene == "flexible_cow":
        yield (*carried.at(x), COW)
    elif 5 in cells:
        yield x, cells[5], CLOTH
    bodies = folder / "frames" / f"bodies_{instant:06}.vtu"
    if not bodies.exists():
        return
    x, cells = read_frame(bodies)
    label = connected(cells[5], len(x))
    for k in range(label.max() + 1):
        yield x, cells[5][label[cells[5][:, 0]] == k], COLORS[k % len(COLORS)]


def actor(x, triangles, color, smooth):
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper
    points, polygons, data = vtkPoints(), vtkCellArray(), vtkPolyData()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(x), deep=True))
    rows = np.column_stack([np.full(len(triangles), 3), triangles]).astype(np.int64).ravel()
    polygons.SetCells(len(triangles), numpy_to_vtkIdTypeArray(rows, deep=True))
    data.SetPoints(points)
    data.SetPolys(polygons)
    normals = vtkPolyDataNormals()
    normals.SetInputData(data)
    normals.SetFeatureAngle(50 if smooth else 1)
    mapper, made = vtkPolyDataMapper(), vtkActor()
    mapper.SetInputConnection(normals.GetOutputPort())
    made.SetMapper(mapper)
    look = made.GetProperty()
    look.SetColor(color)
    look.SetAmbient(0.25)
    look.SetDiffuse(0.75)
    return made


def draw(folder, scene, instant, path, carried):
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
    from vtkmodules.vtkIOImage import vtkPNGWriter
    from vtkmodules.vtkRenderingCore import vtkLight, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter
    view = VIEWS[scene]
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for x, triangles, color in surfaces(folder, scene, instant, carried):
        renderer.AddActor(actor(x, triangles, color, smooth=scene != "boxes_on_ground"))
    if view["ground"]:
        corners = np.array([(-4, -4, 0), (4, -4, 0), (4, 4, 0), (-4, 4, 0)], dtype=float)
        renderer.AddActor(actor(corners, np.array([(0, 1, 2), (0, 2, 3)]), GROUND, smooth=False))
    light = vtkLight()
    light.SetPosition(-3, -4, 8)
    light.SetIntensity(0.9)
    renderer.AddLight(light)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(view["from"])
    camera.SetFocalPoint(view["at"])
    camera.SetViewUp(0, 0, 1)
    camera.SetViewAngle(28)
    renderer.ResetCameraClippingRange()
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(8)
    window.SetSize(*SIZE)
    window.AddRenderer(renderer)
    window.Render()
    image, writer = vtkWindowToImageFilter(), vtkPNGWriter()
    image.SetInput(window)
    writer.SetInputConnection(image.GetOutputPort())
    writer.SetFileName(str(path))
    writer.Write()


def main(directory):
    """Renders what has frames in DIR/figure_1 and no newer pictures."""
    carried = None
    for folder in sorted((directory / "figure_1").glob("*_60")):
        scene = folder.name.rsplit("_", 1)[0]
        if scene not in VIEWS:
            continue
        if scene == "flexible_cow":
            carried = Carried(MESHES / "cow.off", MESHES / "cow.msh")
        for frame in sorted((folder / "frames").glob("frame_*.vtu")):
            instant = int(frame.stem.split("_")[1])
            picture = folder / f"instant_{instant}.png"
            if not picture.exists() or picture.stat().st_mtime < frame.stat().st_mtime:
                draw(folder, scene, instant, picture, carried)


if __name__ == "__main__":
    lack = missing()
    if lack:
        print(f"no pictures of scenes: {lack} is not installed", file=sys.stderr)
    elif os.environ.get("DISPLAY"):
        main(Path(sys.argv[1]))
    else:  # VTK of Debian draws through an X server alone
        if subprocess.run(["xvfb-run", "-a", sys.executable, *sys.argv], check=False).returncode != 0:
            print("no pictures of scenes: VTK ended badly under xvfb-run", file=sys.stderr)
