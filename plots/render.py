"""Draws the frames that experiments leave of their scenes as pictures and animations, by VTK and without a window."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np

from frames import CLOTH, GROUND, SCENES, Frames

SIZE = (640, 400)  # pixels
ANGLE = 28  # degrees, that the camera sees from bottom to top
#: By scene: whence the camera looks; it stands as far off as shows every frame.
SIDES = {"incline": (0.1, -1, 0.15), "boxes_at_edges": (0.45, -0.9, 0.3), "flexible_cow": (0.5, -0.8, 0.25)}
SIDE = (0.45, -0.8, 0.35)
SHARES = (0, 0.4, 0.7, 1)  # of the time, at which pictures are kept
WITH_FORCES = ("contact_scenes",)  # experiments whose pictures show the forces of contacts
FORCE = (0.80, 0.10, 0.10)


def missing():
    """What rendering lacks here, or ''."""
    try:
        import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
    except ImportError:
        return "python3-vtk9"
    if not os.environ.get("DISPLAY") and not shutil.which("xvfb-run"):
        return "xvfb, and xauth"
    return ""


def unit(vector):
    return np.asarray(vector, dtype=float) / np.linalg.norm(vector)


def mesh(x, triangles):
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    points, polygons, data = vtkPoints(), vtkCellArray(), vtkPolyData()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(x), deep=True))
    rows = np.column_stack([np.full(len(triangles), 3), triangles]).astype(np.int64).ravel()
    polygons.SetCells(len(triangles), numpy_to_vtkIdTypeArray(rows, deep=True))
    data.SetPoints(points)
    data.SetPolys(polygons)
    return data


def actor(source, color):
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper
    mapper, made = vtkPolyDataMapper(), vtkActor()
    mapper.SetInputConnection(source.GetOutputPort())
    mapper.ScalarVisibilityOff()
    made.SetMapper(mapper)
    look = made.GetProperty()
    look.SetColor(color)
    look.SetAmbient(0.25)
    look.SetDiffuse(0.75)
    return made


def surface(x, triangles, color, edges=False):
    """Smooth but for what turns by more than 50 degrees at an edge; `edges`: the triangles' are seen."""
    from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
    normals = vtkPolyDataNormals()
    normals.SetInputData(mesh(x, triangles))
    normals.SetFeatureAngle(50)
    made = actor(normals, color)
    made.GetProperty().SetEdgeVisibility(edges)
    made.GetProperty().SetEdgeColor(*(0.6 * np.array(color)))
    return made


def tubes(x, links, radius):
    """One for each link."""
    from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonDataModel import vtkCellArray
    from vtkmodules.vtkFiltersCore import vtkTubeFilter
    data, lines, tube = mesh(x, np.empty((0, 3), dtype=int)), vtkCellArray(), vtkTubeFilter()
    rows = np.column_stack([np.full(len(links), 2), links]).astype(np.int64).ravel()
    lines.SetCells(len(links), numpy_to_vtkIdTypeArray(rows, deep=True))
    data.SetLines(lines)
    tube.SetInputData(data)
    tube.SetRadius(radius)
    tube.SetNumberOfSides(8)
    return actor(tube, CLOTH)


def plane(point, normal, reach):
    """A square of the ground, of twice the edge `reach`."""
    along = unit(np.cross(normal, (0, 1, 0)))
    corners = [point + reach * (a * along + b * np.cross(normal, along)) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return surface(np.array(corners), np.array([(0, 1, 2), (0, 2, 3)]), GROUND)


def arrows(place, force, longest):
    """One for each force, the largest as long as `longest` (m)."""
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkFiltersCore import vtkGlyph3D
    from vtkmodules.vtkFiltersSources import vtkArrowSource
    data, arrow, glyphs = mesh(place, np.empty((0, 3), dtype=int)), vtkArrowSource(), vtkGlyph3D()
    arrow.SetTipLength(0.3)
    arrow.SetTipRadius(0.09)
    arrow.SetShaftRadius(0.03)
    data.GetPointData().SetVectors(numpy_to_vtk(np.ascontiguousarray(force), deep=True))
    glyphs.SetInputData(data)
    glyphs.SetSourceConnection(arrow.GetOutputPort())
    glyphs.SetScaleModeToScaleByVector()
    glyphs.SetScaleFactor(longest / np.linalg.norm(force, axis=1).max())
    return actor(glyphs, FORCE)


class Stage:
    """One window for all pictures; forces are drawn over what would hide them."""

    def __init__(self):
        import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
        from vtkmodules.vtkRenderingCore import vtkLight, vtkRenderer, vtkRenderWindow
        self.solid, self.over, self.window = vtkRenderer(), vtkRenderer(), vtkRenderWindow()
        light = vtkLight()
        light.SetPosition(-3, -4, 8)
        light.SetIntensity(0.9)
        self.solid.SetBackground(1, 1, 1)
        self.solid.AddLight(light)
        glow = vtkLight()
        glow.SetLightTypeToHeadlight()
        glow.SetIntensity(0.35)
        self.solid.AddLight(glow)
        self.over.SetLayer(1)
        self.over.SetActiveCamera(self.solid.GetActiveCamera())
        self.window.SetOffScreenRendering(True)
        self.window.SetMultiSamples(8)
        self.window.SetSize(*SIZE)
        self.window.SetNumberOfLayers(2)
        for renderer in (self.solid, self.over):
            self.window.AddRenderer(renderer)

    def look(self, side, points):
        """Looks from `side` at the middle of all points from as near as shows them; returns how far they reach."""
        low, high = points.min(axis=0), points.max(axis=0)
        middle, back = (low + high) / 2, unit(side)
        right = unit(np.cross((0, 0, 1), back))
        own, tangent = points - middle, 0.9 * np.tan(np.radians(ANGLE / 2))
        away = max((np.abs(own @ axis) / (tangent * wide) + own @ back).max()
                   for axis, wide in ((right, SIZE[0] / SIZE[1]), (np.cross(back, right), 1)))
        camera = self.solid.GetActiveCamera()
        camera.SetPosition(middle + away * back)
        camera.SetFocalPoint(middle)
        camera.SetViewUp(0, 0, 1)
        camera.SetViewAngle(ANGLE)
        return np.linalg.norm(high - low)

    def picture(self, actors, over=()):
        from PIL import Image
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter
        for renderer, shown in ((self.solid, actors), (self.over, over)):
            renderer.RemoveAllViewProps()
            for each in shown:
                renderer.AddActor(each)
        self.solid.ResetCameraClippingRange()
        self.window.Render()
        grabbed = vtkWindowToImageFilter()
        grabbed.SetInput(self.window)
        grabbed.Update()
        pixels = vtk_to_numpy(grabbed.GetOutput().GetPointData().GetScalars())
        return Image.fromarray(pixels.reshape(SIZE[1], SIZE[0], 3)[::-1])


def draw(stage, folder, with_forces):
    """Writes instant_<k>.png at SHARES of the time and animation.webp, which plays at the pace of the simulation."""
    frames = Frames(folder)
    shown = [frames.surfaces(k) for k in range(len(frames.times))]
    ropes = [frames.ropes(k) for k in range(len(frames.times))]
    points = np.concatenate([*(x[np.unique(triangles)] for surfaces in shown for x, triangles, *_ in surfaces),
                             *(x[np.unique(links)] for x, links in ropes)])
    reach = stage.look(SIDES.get(frames.scene, SIDE), points)
    ground = [plane(point, normal, 3 * reach) for point, normal in frames.grounds]
    scene = [[*ground, *(surface(*each) for each in surfaces), *([tubes(*rope, 0.004 * reach)] if len(rope[1]) else [])]
             for surfaces, rope in zip(shown, ropes)]
    pictures = [stage.picture(actors) for actors in scene]
    for number, share in enumerate(SHARES):
        k = int(np.argmin(np.abs(np.array(frames.times) - share * frames.times[-1])))
        place, force = frames.forces(k)
        over = [arrows(place, force, 0.2 * reach)] if with_forces and len(force) else []
        picture = stage.picture(scene[k], over) if over else pictures[k]
        picture.save(folder / f"instant_{number}.png")
    milliseconds = [*(int(round(1000 * step)) for step in np.diff(frames.times)), 1000]
    pictures[0].save(folder / "animation.webp", save_all=True, append_images=pictures[1:], duration=milliseconds, loop=0, quality=70)


def main(directory):
    """Renders what has frames in DIR/<experiment>/<scene> and no newer pictures."""
    stage = Stage()
    for collection in sorted(directory.glob("*/*/simulation.pvd")):
        folder = collection.parent
        drawn = folder / "animation.webp"
        known = (SCENES / f"{folder.name}.toml").exists()
        if known and (not drawn.exists() or drawn.stat().st_mtime < collection.stat().st_mtime):
            draw(stage, folder, folder.parent.name in WITH_FORCES)


if __name__ == "__main__":
    lack = missing()
    if lack:
        print(f"no pictures of scenes: {lack} is not installed", file=sys.stderr)
    elif os.environ.get("DISPLAY"):
        main(Path(sys.argv[1]))
    else:  # VTK of Debian draws through an X server alone
        if subprocess.run(["xvfb-run", "-a", sys.executable, *sys.argv], check=False).returncode != 0:
            print("no pictures of scenes: VTK ended badly under xvfb-run", file=sys.stderr)
