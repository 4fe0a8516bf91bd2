# SPDX-License-Identifier: BSD-3-Clause
"""A blurred picture is the mean of pictures of its moments; resting parts stay sharp."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy
import OpenImageIO

PROGRAM = sys.argv.pop(1)
LOOK = ["--size", "96x72", "--samples", "1", "--device", "cpu", "--preset", "classic", "--camera", "camera.json"]


def models(count):
    """Returns models in which one atom rests and one goes along x."""
    lines = []
    for model in range(count):
        lines.append("MODEL     %4d" % (model + 1))
        for n, place in enumerate(((0.0, -6.0, 0.0), (4.0 * model, 4.0, 0.0))):
            lines.append("ATOM  %5d  CA  ALA %s%4d    %8.3f%8.3f%8.3f  1.00 10.00           C" % (n + 1, "AB"[n], n + 1, *place))
        lines.append("ENDMDL")
    return "\n".join(lines) + "\n"


def linear(path):
    image = OpenImageIO.ImageInput.open(str(path))
    pixels = numpy.asarray(image.read_image("float"), float)
    image.close()
    return pixels


class MotionBlur(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "run.pdb").write_text(models(4))
        (self.folder / "camera.json").write_text(json.dumps({"position": [5, 0, 60], "target": [5, 0, 0], "up": [0, 1, 0], "projection": "orthographic",
                                                             "height": 24}))

    def render(self, *words, code=0):
        done = subprocess.run([PROGRAM, "render", "run.pdb", *LOOK, *words], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr

    def test_a_picture_is_the_mean_of_its_moments(self):
        self.render("--frames", "all", "--motion-blur", "2", "-o", "blur_#.exr")
        self.render("--frames", "all", "--interpolate", "8", "-o", "sharp_##.exr")
        sharp = [linear(self.folder / f"sharp_{n:02}.exr") for n in range(25)]
        for frame in range(4):
            mean = 0.5 * (sharp[max(8 * frame - 1, 0)] + sharp[min(8 * frame + 1, 24)])
            self.assertLess(abs(linear(self.folder / f"blur_{frame}.exr") - mean).max(), 2e-3, frame)  # half floats

    def test_what_rests_is_sharp_and_what_moves_is_smeared(self):
        self.render("--frames", "1", "-o", "sharp_#.exr")
        self.render("--frames", "0-2", "--motion-blur", "8", "-o", "blur_#.exr")
        sharp, blur = linear(self.folder / "sharp_1.exr"), linear(self.folder / "blur_1.exr")
        self.assertLess(abs(sharp[36:] - blur[36:]).max(), 2e-3)
        partly = lambda picture: int(((picture[:36, :, 3] > 0.01) & (picture[:36, :, 3] < 0.99)).sum())
        self.assertEqual(partly(sharp), 0)
        self.assertGreater(partly(blur), 100)
        # The whole ball is there: the mean of alpha equals the sharp ball's.
        self.assertAlmostEqual(blur[..., 3].sum() / sharp[..., 3].sum(), 1.0, delta=0.02)

    def test_a_moving_camera_blurs_too(self):
        look = ["--frames", "all", "--turntable", "0.25", "-o", "turn_#.png", "--size", "96x72", "--samples", "1", "--device", "cpu"]
        subprocess.run([PROGRAM, "render", "run.pdb", *look], cwd=self.folder, check=True, capture_output=True)
        sharp = linear(self.folder / "turn_1.png")
        subprocess.run([PROGRAM, "render", "run.pdb", *look, "--motion-blur", "4", "--force"], cwd=self.folder, check=True, capture_output=True)
        self.assertGreater(abs(linear(self.folder / "turn_1.png") - sharp).mean(), 0.002)

    def test_what_cannot_be_blurred_is_said(self):
        self.assertIn("add the frames of a run", self.render("--motion-blur", "4", "-o", "a.png", code=2))
        self.assertIn("--aovs", self.render("--frames", "all", "--motion-blur", "4", "--aovs", "-o", "a_#.exr", code=2))
        self.assertIn("--repeat", self.render("--frames", "all", "--motion-blur", "4", "--repeat", "2", "-o", "a_#.png", code=2))


if __name__ == "__main__":
    unittest.main()
