# SPDX-License-Identifier: BSD-3-Clause
"""Figures are the same pictures from POV-Ray as from the ray caster, ray by ray: PROGRAM POVRAY."""

import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import OpenImageIO

PROGRAM, POVRAY = sys.argv[1:3]
UBIQUITIN = "/usr/share/freesasa/test-data/1ubq.pdb"
WIDTH, HEIGHT = 320, 240
#: Of 255: a pixel differs if a channel does by more.
LIMIT = 8


def pixels(path):
    """8 bit sRGB: (rows, columns, 3)."""
    image = OpenImageIO.ImageInput.open(path)
    values = np.asarray(image.read_image("uint8")).astype(int)[:, :, :3]
    image.close()
    return values


class Figure(unittest.TestCase):
    def setUp(self):
        self.holder = tempfile.TemporaryDirectory()
        self.addCleanup(self.holder.cleanup)

    def run_program(self, *command, cwd=None):
        done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=cwd)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-2000:])

    def pair(self, name, *options):
        """The picture of the ray caster, and POV-Ray's of the export with the same options; a ray through each pixel."""
        ours, camera, folder = (os.path.join(self.holder.name, name + end) for end in (".png", ".json", ""))
        view = ["--size", f"{WIDTH}x{HEIGHT}", "-q"]
        self.run_program(PROGRAM, "render", UBIQUITIN, "-o", ours, *view, *options, "--preset", "classic", "--ambient", "1",
                         "--specular", "0", "--samples", "1",
                         "--background", "white", "--save-camera", camera)
        self.run_program(PROGRAM, "export", "povray", UBIQUITIN, "-o", folder, *view, *options, "--camera", camera)
        # Without light, which POV-Ray's highlights make another way: colours, borders and layers alone.
        with open(os.path.join(folder, "flat.pov"), "w", encoding="ascii") as file:
            flat = "finish { ambient 1 diffuse 0 specular 0 }"
            file.write(f'#version 3.7;\n#declare Meniscus_Finish = {flat}\n#declare Meniscus_Shape_Finish = {flat}\n'
                       '#include "surface.pov"\n')
        self.run_program(POVRAY, "surface.ini", "Antialias=Off", "Input_File_Name=flat.pov", cwd=folder)
        return pixels(ours), pixels(os.path.join(folder, "surface.png"))

    def difference(self, name, ours, theirs):
        """The share of differing pixels among those that show something."""
        shown = (ours.min(axis=2) < 255) | (theirs.min(axis=2) < 255)
        self.assertGreater(shown.sum(), 2000)
        share = float((np.abs(ours - theirs).max(axis=2)[shown] > LIMIT).mean())
        print(f"{name}: {shown.sum()} pixels, {100 * share:.3f} % differ")
        return share

    def check(self, name, *options, at_most=0.01):
        """The same figure from both, and a comparison that can fail: one pixel aside."""
        ours, theirs = self.pair(name, *options)
        self.assertLess(self.difference(name, ours, theirs), at_most, name)
        self.assertGreater(self.difference(name + ", one pixel aside", ours, np.roll(theirs, 1, axis=1)), 0.03)

    def test_shapes(self):
        self.check("shapes", "--sticks", "resi 1-20", "--spheres", "resi 70-76", "--show", "resi 30-60", "--color", "element")

    def test_opacity(self):
        self.check("opacity", "--opacity", "0.4", "--color", "residue")
        self.check("opacity of parts", "--opacity", "0.25", "--opacity", "resi 1-30=1", "--opacity", "resi 40-50=0", "--color",
                   "residue", "--sticks", "resi 40-50")
        self.check("film", "--opacity", "0.25", "--film-opacity", "--color", "residue")

    def test_caps(self):
        self.check("caps", "--clip", "depth>0.4", "--color", "residue")
        self.check("slab", "--clip", "1,0.2,0<31", "--clip", "z>22", "--cap-color", "#c04020", "--color", "element")
        self.check("hatched", "--clip", "depth>0.4", "--cap-hatching", "3", "--color", "element", "--sticks", "all")
        self.check("caps seen through", "--clip", "depth>0.4", "--opacity", "0.5", "--color", "element")


unittest.main(argv=["figure_test"])
