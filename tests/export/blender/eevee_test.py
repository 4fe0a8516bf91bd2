# SPDX-License-Identifier: BSD-3-Clause
"""Films by Eevee are those by Cycles: the colours of each frame of a run, and looks that catch light: PROGRAM ADDON_FOLDER BLENDER.

Eevee draws by OpenGL, here that of Mesa on the CPU. MENISCUS_KEEP_PICTURES: a folder for the pictures, to look at."""

import json
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import OpenImageIO

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import samples  # noqa: E402

PROGRAM, ADDON, BLENDER = sys.argv[1:4]
FRAMES = (1, 3, 5)
#: Largest difference of a channel between equal pixels.
LIMIT = 16 / 255


def pixels(path):
    """Returns sRGB colours and coverage, (rows, columns, 4)."""
    return np.asarray(OpenImageIO.ImageInput.open(path).read_image(OpenImageIO.FLOAT), dtype=np.float64)


class Eevee(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder = os.environ.get("MENISCUS_KEEP_PICTURES", holder.name)
        cls.run_folder = os.path.join(holder.name, "run")
        samples.export_run(PROGRAM, cls.run_folder)

    def render(self, name, *options, code=0):
        """Returns the driver's JSON lines about frames, and the pictures that they name."""
        done = subprocess.run(
            [BLENDER, "-b", "--factory-startup", "--python-exit-code", "3", "--python", os.path.join(ADDON, "render_mns.py"), "--",
             os.path.join(self.run_folder, "surface_sequence.json"), "--output", os.path.join(self.folder, name + "_##"), "--transparent", *options],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, env={**os.environ, "LIBGL_ALWAYS_SOFTWARE": "1"}, check=False)
        self.assertEqual(done.returncode, code, done.stderr.decode()[-3000:])
        told = [json.loads(line) for line in done.stdout.decode().splitlines() if line.startswith("{")]
        return told, [pixels(file) for line in told for file in line["files"]]

    def share_that_differs(self, one, other):
        """Returns the share of differing pixels away from edges of `one`, where the two engines filter differently."""
        around = np.lib.stride_tricks.sliding_window_view(one, (3, 3), axis=(0, 1))
        smooth = (around.max(axis=(3, 4)) - around.min(axis=(3, 4))).max(axis=2) < LIMIT
        smooth &= one[1:-1, 1:-1, 3] > 0.0
        self.assertGreater(smooth.sum(), 1000)
        return float((np.abs(one - other).max(axis=2)[1:-1, 1:-1] > LIMIT)[smooth].mean())

    def test_a_film_is_that_of_cycles(self):
        _, wanted = self.render("cycles", "--style", "flat", "--samples", "64")
        for mode in ("driver", "bake", "stream"):
            told, film = self.render(f"eevee_{mode}", "--style", "flat", "--engine", "eevee", "--samples", "16", "--mode", mode)
            self.assertEqual([(line["frame"], line["state"]) for line in told], [(frame, "done") for frame in FRAMES])
            for place, picture in enumerate(film):
                share = self.share_that_differs(wanted[place], picture)
                print(f"{mode}, frame {FRAMES[place]}: {100 * share:.2f} % differ")
                self.assertLess(share, 0.002, f"{mode} {FRAMES[place]}")
                self.assertGreater(self.share_that_differs(wanted[(place + 1) % len(FRAMES)], picture), 0.05)

    def test_looks_catch_light(self):
        """Wax is lit and coloured; glass shows the bright wall behind it, a little darker, and darker still towards its edges."""
        given = ("--engine", "eevee", "--samples", "4", "--frames", "1")
        _, (wax,) = self.render("eevee_wax", "--look", "wax", *given)
        _, (glass,) = self.render("eevee_glass", "--look", "glass", *given)
        inside = wax[:, :, 3] > 0.99
        for picture in (wax, glass):
            self.assertGreater(inside.sum(), 1000)
            self.assertGreater(picture[inside][:, :3].mean(), 0.2)
            self.assertGreater(picture[inside][:, :3].std(axis=0).max(), 0.03)
        self.assertGreater(glass[inside][:, :3].mean(), wax[inside][:, :3].mean())

    def test_blur_is_refused(self):
        self.render("no", "--engine", "eevee", "--motion-blur", "0.5", code=2)


unittest.main(argv=["eevee_test"])
