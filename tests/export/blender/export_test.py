# SPDX-License-Identifier: BSD-3-Clause
"""How fine the files of `export blender` are, and which sizes the program prints for them: PROGRAM ADDON."""

import json
import os
import re
import subprocess
import sys
import tempfile
import types
import unittest

import numpy as np

import samples

PROGRAM, ADDON = sys.argv[1:3]
package = sys.modules["meniscus_import"] = types.ModuleType("meniscus_import")  # The add-on is loaded without Blender.
package.__path__ = [os.path.join(ADDON, "meniscus_import")]
from meniscus_import import mns_reader  # noqa: E402

UBIQUITIN = samples.UBIQUITIN


class Export(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder = holder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def export(self, *options, name="a.mns", code=0):
        """Returns the path of the file and the program's messages."""
        done = subprocess.run([PROGRAM, "export", "blender", UBIQUITIN, "--select", "resi 1-15", "-o", self.path(name), "--device", "cpu",
                               "--force", *options], capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stderr)
        return self.path(name), done.stderr

    def surface(self, *options):
        """Returns the only object of a file and the printed line about triangles."""
        path, said = self.export(*options)
        (line,) = [line for line in said.splitlines() if " triangles " in line]
        megabytes = float(re.search(r"([0-9.]+) MB\Z", line).group(1))
        self.assertAlmostEqual(megabytes, os.path.getsize(path) / 1e6, delta=0.05 * megabytes)
        surface = mns_reader.read(path).objects[0]
        self.assertEqual(int(re.search(r"([0-9,]+) triangles", line).group(1).replace(",", "")), len(surface["mesh.triangle"]))
        return surface, line

    def off(self, surface):
        """Returns the largest distance of vertices from the spheres of their convex patches, in Å."""
        on = surface["mesh.triangle"][surface["mesh.kind"] == 0]
        atom = surface["convex.atom"][surface["mesh.patch"][surface["mesh.kind"] == 0]]
        origin = np.array(surface.header["mesh"]["origin"])
        middle = (surface["mesh.position"][on].astype(float) + origin).mean(axis=1)
        return float(np.abs(np.linalg.norm(middle - surface["atom.center"][atom], axis=1) - surface["atom.radius"][atom]).max())

    def test_tolerance_is_a_tenth_unless_another_is_asked_for(self):
        usual, line = self.surface()
        self.assertEqual(usual.header["mesh"]["tolerance"], 0.1)
        self.assertIn("within 0.1 Å of the surface", line)
        self.assertLessEqual(self.off(usual), 0.1)
        fine, _ = self.surface("--tolerance", "0.01")
        self.assertEqual(fine.header["mesh"]["tolerance"], 0.01)
        self.assertLessEqual(self.off(fine), 0.01)
        self.assertGreater(len(fine["mesh.triangle"]), 2 * len(usual["mesh.triangle"]))

    def test_a_camera_decides_unless_something_else_does(self):
        camera = self.path("camera.json")
        self.export("--size", "400x300", "--projection", "orthographic", "--save-camera", camera)
        with open(camera, encoding="utf-8") as file:
            shot = json.load(file)
        self.assertEqual(mns_reader.read(self.path("a.mns")).header["camera"]["position"], shot["position"])
        small, line = self.surface("--camera", camera, "--size", "400x300")
        large, _ = self.surface("--camera", camera, "--size", "1600x1200")
        self.assertRegex(line, r"within 0\.\d+ Å of the surface")
        tolerance = [surface.header["mesh"]["tolerance"] for surface in (small, large)]
        self.assertAlmostEqual(tolerance[0] / tolerance[1], 4.0, places=6)
        half_a_pixel, _ = self.surface("--camera", camera, "--size", "400x300", "--tolerance-pixels", "0.5")
        self.assertEqual(half_a_pixel.header["mesh"]["tolerance"], tolerance[0])
        said, _ = self.surface("--camera", camera, "--tolerance", "0.2")
        self.assertEqual(said.header["mesh"]["tolerance"], 0.2)

    def test_even_meshes(self):
        """Vertices lie on the surface with its exact curvature, within the tolerance or at the requested density."""
        dense, line = self.surface("--density", "2")
        self.assertIn(" triangles with 2 vertices per Å², ", line)
        self.assertIn(" triangles with 1 vertex per Å², ", self.surface("--density", "1")[1])
        self.assertAlmostEqual(len(dense["mesh.position"]) / dense.header["area"], 2.0, delta=0.2)
        self.assertEqual(dense.header["mesh"]["tolerance"], 0.0)
        even, _ = self.surface("--even", "--tolerance", "0.2")
        self.assertLessEqual(self.off(even), 0.3)
        for surface in (dense, even):
            self.assertTrue(surface.header["mesh"]["closed"])
            a, b, c = (surface["mesh.position"][surface["mesh.triangle"][:, k]].astype(float) for k in range(3))
            sides = np.array([np.linalg.norm(u - v, axis=1) for u, v in ((a, b), (b, c), (c, a))])
            area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
            shape = 4.0 * 3.0**0.5 * area / (sides**2).sum(axis=0)  # An equilateral triangle gives 1.
            self.assertGreater(np.median(shape), 0.9)
            # A vertex bulges like an atom or like the probe, or it lies on a torus between them.
            mean = surface["mesh.mean_curvature"].astype(float)
            on_atoms = np.isclose(mean[:, None], 1.0 / np.unique(surface["atom.radius"]), atol=1e-4).any(axis=1)
            on_probes = np.isclose(mean, -1.0 / 1.4, atol=1e-4)
            self.assertGreater(on_atoms.mean(), 0.2)
            self.assertGreater(on_probes.mean(), 0.1)

    def test_no_blend_file(self):
        """The program refuses the name, for Blender would refuse the file without a reason."""
        for name in ("a.blend", "B.blend"):
            path, said = self.export(name=name, code=2)
            self.assertIn("name this one .mns", said)
            self.assertFalse(os.path.exists(path))

    def test_what_cannot_be_even(self):
        for options, word in ((("--show", "resi 1-5"), "--show"), (("--clip", "x<0"), "--clip")):
            for even in (("--even",), ("--density", "1")):
                _, said = self.export(*options, *even, name="none.mns", code=2)
                self.assertIn(word, said)
                self.assertFalse(os.path.exists(self.path("none.mns")))

    def test_a_large_run_says_how_to_make_it_smaller(self):
        """The advice comes before the second frame; frames are coarser than a single surface."""
        words = [PROGRAM, "export", "blender", UBIQUITIN, "--repeat", "300", "-o", self.path("many"), "--device", "cpu"]
        with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as child:
            line = next(line for line in child.stderr if " triangles " in line)
            child.kill()
        self.assertRegex(line, r"within 0\.2 Å of the surface, [0-9.]+ MB a frame; about [0-9.]+ GB for 3000 frames; "
                         r"fewer --frames, or a larger --tolerance, make it smaller$")

    def test_the_size_of_a_run_is_said_before_it(self):
        path, said = self.export("--frames", "0-4", "--density", "0.5", "--save-camera", self.path("run.json"), name="run")
        (line,) = [line for line in said.splitlines() if " triangles " in line]
        each, whole = (float(text) for text in re.search(r"([0-9.]+) MB a frame; about ([0-9.]+) MB for 5 frames", line).groups())
        size = sum(os.path.getsize(os.path.join(path, name)) for name in os.listdir(path) if name.endswith(".mns")) / 1e6
        self.assertAlmostEqual(whole, size, delta=0.1 * size)
        self.assertAlmostEqual(each * 5, whole, delta=0.1 * size)
        self.assertTrue(os.path.exists(self.path("run.json")))

    def test_a_very_large_mesh_is_announced_before_it_is_made(self):
        child = subprocess.Popen([PROGRAM, "export", "blender", UBIQUITIN, "-o", self.path("large.mns"), "--device", "cpu", "--tolerance", "1e-4"],
                                 stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        with child.stderr:
            line = next((line for line in child.stderr if "million triangles" in line), "")
        child.kill()
        child.wait()
        self.assertRegex(line, r"warning: about \d+ million triangles; a larger --tolerance or a smaller --density makes fewer")
        self.assertFalse(os.path.exists(self.path("large.mns")))


unittest.main(argv=["export_test"])
