"""Tests of frames and of their pictures."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from PIL import Image

import render
from frames import COLORS, HELD, Frames, connected, turned

CORNERS = np.array([(0, 0, 0), (0.1, 0, 0), (0, 0.1, 0), (0, 0, 0.1)])
TRIANGLES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]


def array(name, values):
    text = "\n".join(" ".join(map(str, row)) for row in np.atleast_2d(values))
    return f'<DataArray type="Float64" Name="{name}" format="ascii">\n{text}\n</DataArray>\n'


def write(folder, collection, frames):
    """Frames of (time, points, cells, their type, forces), as pbdcheck writes them."""
    (folder / "frames").mkdir(parents=True, exist_ok=True)
    listed = ""
    for k, (time, points, cells, kind, force) in enumerate(frames):
        name = f"frames/{collection}_{k:06}.vtu"
        (folder / name).write_text(
            "<Points>" + array("points", points) + "</Points><Cells>" + array("connectivity", [n for cell in cells for n in cell])
            + array("offsets", np.cumsum([len(cell) for cell in cells])) + array("types", [kind] * len(cells))
            + "</Cells><PointData>" + array("force", force) + "</PointData>", encoding="utf-8")
        listed += f'<DataSet timestep="{time}" file="{name}"/>\n'
    (folder / f"{collection}.pvd").write_text(listed, encoding="utf-8")


def write_scene(folder):
    """Two frames of a scene file with a plane and a box, here a tetrahedron that is pressed by the plane in the second."""
    moved = (0, CORNERS), (1, CORNERS + (0.1, 0, 0))
    write(folder, "simulation", [(time, [(0, 0, 0)], [(0,)], 1, [(0, 0, 0)]) for time, _ in moved])
    write(folder, "bodies", [(time, x, TRIANGLES, 5, [(0, 0, 0)]) for time, x in moved])
    write(folder, "contacts", [(time, CORNERS[:2], [(0,), (1,)], 1, [(0, 0, 0), (time, 0, -2 * time)]) for time, _ in moved])


class FramesTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.directory = Path(folder.name)
        self.folder = self.directory / "contact_scenes" / "incline"
        write_scene(self.folder)

    def test_surfaces_grounds_and_forces(self):
        frames = Frames(self.folder)
        self.assertEqual((frames.times, frames.held), ([0, 1], [False]))
        ((_, normal),) = frames.grounds
        np.testing.assert_allclose(normal, (np.sin(0.4), 0, np.cos(0.4)))
        ((x, triangles, color, edges),) = frames.surfaces(1)
        np.testing.assert_allclose(x, CORNERS + (0.1, 0, 0))
        self.assertEqual((triangles.tolist(), color, edges), ([list(nodes) for nodes in TRIANGLES], COLORS[0], False))
        place, force = frames.forces(1)
        self.assertEqual((place.tolist(), force.tolist()), ([[0.1, 0, 0]], [[-1, 0, 2]]))

    def test_what_is_held_is_grey(self):
        folder = self.directory / "contact_scenes" / "boxes_at_edges"
        apart = np.concatenate([CORNERS + k for k in range(8)])
        cells = [tuple(4 * k + np.array(nodes)) for k in range(8) for nodes in TRIANGLES]
        for collection, frame in (("simulation", (0, [(0, 0, 0)], [(0,)], 1, [(0, 0, 0)])), ("bodies", (0, apart, cells, 5, [(0, 0, 0)]))):
            write(folder, collection, [frame])
        grey = [triangles for _, triangles, color, _ in Frames(folder).surfaces(0) if color == HELD]
        self.assertEqual([len(triangles) for triangles in grey], [16])

    def test_ropes_are_links_and_solids_their_skin(self):
        folder = self.directory / "contact_scenes" / "conveyor"
        write(folder, "simulation", [(0, CORNERS, [(0, 1), (1, 2)], 3, [(0, 0, 0)])])
        frames = Frames(folder)
        self.assertEqual((frames.ropes(0)[1].tolist(), frames.surfaces(0)), ([[0, 1], [1, 2]], []))
        write(folder, "simulation", [(0, CORNERS, [(0, 1, 2, 3)], 10, [(0, 0, 0)])])
        frames = Frames(folder)
        ((_, triangles, *_),) = frames.surfaces(0)
        self.assertEqual((len(frames.ropes(0)[1]), sorted(map(sorted, triangles.tolist()))), (0, [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]]))

    def test_components(self):
        self.assertEqual(connected(np.array([(0, 1, 2), (5, 4, 3), (2, 6, 1)]), 7).tolist(), [0, 0, 0, 1, 1, 1, 0])

    def test_turning(self):
        np.testing.assert_allclose(turned(np.array([0.0, 0, 1]), np.array([0, np.pi / 2, 0])), (1, 0, 0), atol=1e-15)
        np.testing.assert_allclose(turned(np.array([0.0, 0, 1]), np.zeros(3)), (0, 0, 1))

    @unittest.skipIf(render.missing(), "VTK or xvfb is not installed")
    def test_pictures_show_forces_and_the_animation_all_frames(self):
        subprocess.run([sys.executable, Path(render.__file__), self.directory], check=True)
        red = [int((np.array(Image.open(self.folder / f"instant_{k}.png"), dtype=int) @ (1, -1, -1) > 60).sum()) for k in (0, 3)]
        self.assertEqual(red[0], 0)
        self.assertGreater(red[1], 100)
        with Image.open(self.folder / "animation.webp") as moving:
            self.assertEqual((moving.n_frames, moving.size), (2, render.SIZE))


if __name__ == "__main__":
    unittest.main()
