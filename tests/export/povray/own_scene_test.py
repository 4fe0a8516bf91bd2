# SPDX-License-Identifier: BSD-3-Clause
"""A surface in a scene of the user's own: it stands where it is put, and a cut by --clip is closed: PROGRAM POVRAY."""

import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import OpenImageIO

PROGRAM, POVRAY = sys.argv[1:3]
WIDTH, HEIGHT = 120, 60  # of 12 by 6 Å
RADIUS, APART, SHIFT = 1.7, 1.5, 3.0  # two balls along z, so that no single primitive is the surface
SCENE = """#version 3.7;
global_settings {{ assumed_gamma 1 }}
#declare Meniscus_Own_Scene = 1;
#declare Meniscus_Background = rgb <0, 0, 1>;
#include "surface.pov"
camera {{ orthographic location <0, 0, 50> look_at 0 right -12*x up 6*y }}
light_source {{ <0, 0, 1000> rgb 1 parallel point_at 0 }}
{placed}
"""


class OwnScene(unittest.TestCase):
    def setUp(self):
        self.holder = tempfile.TemporaryDirectory()
        self.addCleanup(self.holder.cleanup)
        self.balls = os.path.join(self.holder.name, "balls.xyzr")
        with open(self.balls, "w", encoding="ascii") as file:
            file.write(f"0 0 {APART} {RADIUS}\n0 0 {-APART} {RADIUS}\n")

    def picture(self, placed, *options):
        """(rows, columns, 3) of the surface in a scene of our own, which looks along -z; red is right."""
        folder = os.path.join(self.holder.name, f"scene{len(os.listdir(self.holder.name))}")
        words = [PROGRAM, "export", "povray", self.balls, "-o", folder, "-q", "--device", "cpu", "--color", "#ff0000", *options]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(os.path.join(folder, "own.pov"), "w", encoding="ascii") as file:
            file.write(SCENE.format(placed=placed))
        done = subprocess.run([POVRAY, "+Iown.pov", "+Oown.png", f"+W{WIDTH}", f"+H{HEIGHT}", "-D", "-A", "File_Gamma=1.0"],
                              capture_output=True, text=True, check=False, cwd=folder)
        self.assertEqual(done.returncode, 0, done.stderr[-2000:])
        image = OpenImageIO.ImageBuf(os.path.join(folder, "own.png"))
        return np.asarray(image.get_pixels(OpenImageIO.FLOAT))[:, :, :3]

    def disc(self, x, radius):
        """Pixels whose middle is that near to a place, in Å."""
        across, up = (np.arange(WIDTH) + 0.5) / 10 - 6, (np.arange(HEIGHT) + 0.5) / 10 - 3
        return np.hypot(*np.meshgrid(across - x, up)) < radius

    def test_it_stands_where_it_is_put_and_nowhere_else(self):
        nothing = self.picture("")
        np.testing.assert_allclose(nothing, np.broadcast_to([0.0, 0.0, 1.0], nothing.shape), atol=1e-3)
        found = self.picture(f"object {{ Meniscus_Surface translate {SHIFT}*x }}\n"
                             f"object {{ Meniscus_Surface scale 0.5 translate -{SHIFT}*x }}")
        solid = self.disc(SHIFT, RADIUS) | self.disc(-SHIFT, RADIUS / 2)
        self.assertLess((solid != (found[:, :, 2] < 0.5)).mean(), 0.01)
        self.assertGreater(found[self.disc(SHIFT, 0.5)][:, 0].min(), 0.3)

    def test_a_cut_is_closed_by_clip_and_not_by_difference(self):
        """Seen from the side of what is cut away: half a ball, whose plane is lit."""
        cut = self.picture(f"object {{ Meniscus_Surface translate {SHIFT}*x }}", "--clip", f"z<{APART}")
        cap = cut[self.disc(SHIFT, 0.9 * RADIUS)]
        self.assertGreater(cap[:, 0].min(), 0.3)
        self.assertLess(np.ptp(cap, axis=0).max(), 0.02)  # flat
        # As the README says: patches are open, so that a difference of theirs is a shell, black inside.
        shell = self.picture(f"difference {{ object {{ Meniscus_Surface }} plane {{ -z, {-APART} }} translate {SHIFT}*x }}")
        self.assertLess(shell[self.disc(SHIFT, 0.9 * RADIUS)].max(), 0.05)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
