# SPDX-License-Identifier: BSD-3-Clause
"""More than 400,000 atoms, which are computed block by block: argument PROGRAM."""

import json
import math
import resource
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy
import OpenImageIO

PROGRAM = sys.argv[1]
LENGTH, ROWS = 75, 75 * 75  # 421,875 atoms


def row(shift=(0.0, 0.0)):
    return [(5.0 * n, *shift, 1.7) for n in range(LENGTH)]


class LargeMolecules(unittest.TestCase):
    """Rows of balls that are apart from one another, around which a probe rolls. Blocks divide all of them."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.write("one.xyzr", row())
        cls.write("all.xyzr", [ball for y in range(75) for z in range(75) for ball in row((9.0 * y, 9.0 * z))])

    @classmethod
    def write(cls, name, balls):
        lines = (f"{x:g} {y:g} {z:g} {r:g}\n" for x, y, z, r in balls)
        (cls.folder / name).write_text("".join(lines), encoding="ascii")

    def run_program(self, *words):
        done = subprocess.run([PROGRAM, *words, "-q"], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def pixels(self, name):
        file = OpenImageIO.ImageInput.open(str(self.folder / name))
        self.addCleanup(file.close)
        return file.spec().channelnames, file.read_image(OpenImageIO.FLOAT)

    def test_numbers_are_those_of_each_row(self):
        one, every = (json.loads(self.run_program("surface", name, "--json", "--device", "cpu"))
                      for name in ("one.xyzr", "all.xyzr"))
        self.assertEqual(every["counts"]["convex"], LENGTH * ROWS)
        self.assertEqual(len(every["components"]), ROWS)
        for name in ("area", "volume"):
            self.assertAlmostEqual(every[name] / ROWS / one[name], 1, delta=1e-9)
            self.assertTrue(all(math.isclose(part[name], one[name], rel_tol=1e-9) for part in every["components"]))

    def test_pictures_are_those_of_the_whole_surface(self):
        picture = ("render", "all.xyzr", "--device", "cpu", "--size", "320x240", "--samples", "1")
        self.run_program(*picture, "-o", "blocks.exr")
        most = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
        self.run_program(*picture, "-o", "whole.exr", "--aovs")  # components have names, which need the borders of all
        self.assertGreater(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, most)
        (some, blocks), (names, whole) = (self.pixels(name) for name in ("blocks.exr", "whole.exr"))
        self.assertGreater(len(numpy.unique(whole[:, :, names.index("component")])), LENGTH)
        pixels = whole[:, :, [names.index(name) for name in some]]
        self.assertTrue(numpy.array_equal(blocks, pixels))
        self.assertGreater(numpy.ptp(pixels), 0.5)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
