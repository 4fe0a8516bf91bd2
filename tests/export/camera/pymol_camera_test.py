# SPDX-License-Identifier: BSD-3-Clause
"""A view of PyMOL, read by --camera, puts atoms where PyMOL's own pictures have them; --turn turns as PyMOL does."""

import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy
    import pymol
    from PIL import Image
    from pymol import cmd
except ImportError as missing:
    print(f"skipped: {missing}; Debian has pymol, python3-pil and python3-numpy")
    sys.exit(77)

PROGRAM = sys.argv.pop(1)
SIZE = (400, 300)
# The atoms lie in no plane and stay apart in every picture below; each has a colour of its own.
ATOMS = [(0.0, 0.0, 0.0), (9.0, 1.0, 2.0), (-2.0, 8.0, -3.0), (3.0, -4.0, 9.0)]
COLORS = ["red", "green", "blue", "yellow"]
SEEN = [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0)]


def pictured():
    """Returns the columns and rows where PyMOL draws the atoms, as the middles of their colours in its picture."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "pymol.png"
        cmd.png(str(path), width=SIZE[0], height=SIZE[1], ray=1, quiet=1)
        pixels = numpy.asarray(Image.open(path).convert("RGB")) > 60
    places = []
    for color in SEEN:
        rows, columns = numpy.nonzero((pixels == numpy.array(color, bool)).all(axis=2))
        assert len(rows) > 20, color
        places.append((columns.mean() + 0.5, rows.mean() + 0.5))
    return numpy.array(places)


def projected(camera):
    """Returns the columns and rows where our camera has the atoms."""
    position = numpy.array(camera["position"])
    forward = numpy.array(camera["target"]) - position
    forward /= numpy.linalg.norm(forward)
    right = numpy.cross(forward, camera["up"])
    right /= numpy.linalg.norm(right)
    up = numpy.cross(right, forward)
    places = []
    for atom in numpy.array(ATOMS):
        x, y, z = right @ (atom - position), up @ (atom - position), forward @ (atom - position)
        if camera["projection"] == "perspective":
            half = z * math.tan(math.radians(camera["vertical_fov"]) / 2)
        else:
            half = camera["height"] / 2
        places.append(((1 + x / half * SIZE[1] / SIZE[0]) * SIZE[0] / 2, (1 - y / half) * SIZE[1] / 2))
    return numpy.array(places)


class PyMOLCamera(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        pymol.finish_launching(["pymol", "-cqk"])
        for atom, color in zip(ATOMS, COLORS):
            cmd.pseudoatom("m", pos=list(atom), color=color, vdw=0.8)
        cmd.show_as("spheres")
        for name, value in [("ambient", 1.0), ("direct", 0), ("reflect", 0), ("specular", 0), ("ray_shadows", 0),
                            ("depth_cue", 0), ("antialias", 2), ("ray_trace_fog", 0)]:
            cmd.set(name, value)
        cmd.viewport(*SIZE)

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.molecule = self.path("m.xyzr")
        self.molecule.write_text("".join(f"{x} {y} {z} 0.8\n" for x, y, z in ATOMS))
        cmd.set("orthoscopic", 0)
        cmd.set("field_of_view", 20)
        cmd.reset()
        cmd.zoom("all", 5)  # The picture's edge cuts no atom off.

    def path(self, name):
        return pathlib.Path(self.folder.name) / name

    def camera(self, view, *options):
        """Returns the camera that the program saves with a picture of a view."""
        self.path("view.txt").write_text(view)
        subprocess.run([PROGRAM, "render", self.molecule, "-o", self.path("a.png"), "--force", "--samples", "1", "--size",
                        f"{SIZE[0]}x{SIZE[1]}", "--camera", self.path("view.txt"), "--save-camera", self.path("c.json"),
                        "--device", "cpu", "-q", *options], check=True)
        return json.loads(self.path("c.json").read_text())

    def assert_sees_alike(self, camera):
        apart = numpy.abs(projected(camera) - pictured()).max()
        self.assertLess(apart, 0.7, (projected(camera), pictured()))

    def test_puts_atoms_where_pymol_does(self):
        # The camera looks from the side, shifted and near, so that perspective counts.
        cmd.turn("x", 33)
        cmd.turn("y", -58)
        cmd.turn("z", 17)
        cmd.move("x", 1.5)
        cmd.move("z", 8)
        for orthoscopic, angle in [(0, 20), (0, 60), (1, 20), (1, 45)]:
            cmd.set("orthoscopic", orthoscopic)
            cmd.set("field_of_view", angle)
            with self.subTest(orthoscopic=orthoscopic, angle=angle):
                self.assert_sees_alike(self.camera(str(cmd.get_view())))

    def test_reads_what_pymol_prints_and_what_people_paste(self):
        view = cmd.get_view()
        rows = [view[n:n + 3] for n in range(0, 18, 3)]
        printed = "### cut below here and paste into script ###\nset_view (\\\n" + ",\\\n".join(
            "  ".join(f"{value:14.9f}," for value in row).rstrip(",") for row in rows) + " )\n### cut above here ###\n"
        for text in [printed, "\n".join(map(str, view)), f"cmd.set_view({list(view)})"]:
            self.assert_sees_alike(self.camera(text))

    def test_turns_as_pymol_does(self):
        before = str(cmd.get_view())
        options = []
        for axis, angle in [("y", 90), ("x", -30), ("z", 45), ("y", 12.5)]:
            cmd.turn(axis, angle)
            options += ["--turn", f"{axis}{angle}"]
        turned, wanted = self.camera(before, *options), self.camera(str(cmd.get_view()))
        for camera in (turned, wanted):
            camera["ahead"] = numpy.array(camera["target"]) - numpy.array(camera["position"])
        self.assertLess(numpy.abs(turned["ahead"] - wanted["ahead"]).max(), 1e-4)
        self.assertLess(numpy.abs(numpy.array(turned["up"]) - numpy.array(wanted["up"])).max(), 1e-5)


if __name__ == "__main__":
    unittest.main()
