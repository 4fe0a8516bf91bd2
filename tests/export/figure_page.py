# SPDX-License-Identifier: BSD-3-Clause
"""Pages of `export page` in a real browser against `render`: arguments PROGRAM CHROMIUM FREESASA_DATA."""

import base64
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "preview"))

import numpy
import OpenImageIO
from browser import Browser

PROGRAM, CHROMIUM, FREESASA = sys.argv[1:4]
TOXIN = "/usr/share/pymol/data/demo/1tii.pdb"
UBIQUITIN = f"{FREESASA}/1ubq.pdb"
PROTEASE = "/usr/share/pymol/data/tut/1hpv.pdb"
DEPTH_CUE = 41  # place of the depth cue among the words of FinishParameters (gpu_shaders/look/parameters.glsl)
SIZE = (240, 180)
SOFTWARE_GL = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")
NOTHING = 0xffffffff

# Casts one sample through the middle of each pixel, with the look, and returns the hits and the sums of colours.
CAST = """(() => {
  const viewer = window.meniscus, caster = viewer.caster, gl = caster.gl, [width, height] = [%d, %d];
  caster.begin(viewer.camera, width, height);
  caster.cast(0, viewer.effects);
  const text = (words) => { let all = ""; for (const byte of new Uint8Array(words.buffer)) all += String.fromCharCode(byte);
    return btoa(all); };
  const what = text(caster.read(0, 0, width, height, 2));
  const sums = new Uint32Array(4 * width * height);
  gl.bindFramebuffer(gl.FRAMEBUFFER, caster.targets.sum);
  gl.readPixels(0, 0, width, height, gl.RGBA_INTEGER, gl.UNSIGNED_INT, sums);
  const { forward, eye_distance, pixel_size, orthographic } = caster.frame;
  return { what, sums: text(sums), shown: [...viewer.figure.tables.shown], eye_distance, pixel_size, orthographic };
})()""" % SIZE

# Software GL is slow, so the viewer draws by itself only when a test allows it.
HELD = """(() => {
  const frames = window.requestAnimationFrame.bind(window);
  window.held = true;
  window.requestAnimationFrame = (draw) => window.held ? 1 : frames(draw);
})()"""


def srgb(linear):
    linear = numpy.clip(linear, 0, 1)
    return numpy.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


class PageCase(unittest.IsolatedAsyncioTestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def run_program(self, *words):
        done = subprocess.run([PROGRAM, *words], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stderr

    def export(self, molecule, *options, name="page.html"):
        self.run_program("export", "page", molecule, "-o", self.path(name), "--force", "-q", *options)
        return self.path(name)

    def part_of(self, molecule, first, last):
        """Writes a file with some of the molecule's residues."""
        with open(molecule) as file, open(self.path("part.pdb"), "w") as part:
            part.writelines(row for row in file if row.startswith("ATOM") and first <= int(row[22:26]) <= last)
        return part.name

    def browser(self, size=(520, 260)):
        return Browser(CHROMIUM, size, SOFTWARE_GL)

    async def load(self, page, path):
        """Loads a page and waits for its viewer, which draws nothing by itself."""
        await page.send("Page.addScriptToEvaluateOnNewDocument", source=HELD)
        await page.send("Page.navigate", url="file://" + path)
        await page.until("Boolean(window.meniscus) || document.getElementById('message')?.textContent", 100)
        fault = await page.evaluate("document.getElementById('message').textContent")
        if "WebGL 2" in fault:
            print(f"skipped: this Chromium has no WebGL 2 ({fault})")
            sys.exit(77)
        self.assertEqual(fault, "")

    async def open(self, page, path):
        """Loads a page and lets it draw, with three samples a pixel, which suffice when nothing is compared."""
        await self.load(page, path)
        await page.evaluate("(() => { window.held = false; meniscus.waiting = 0; meniscus.figure.samples.length = 3;"
                            " meniscus.change(); })()")

    async def shoot(self, page, name):
        if "MENISCUS_SCREENSHOTS" in os.environ:
            if await page.evaluate("window.held"):
                await page.evaluate("window.held = false, meniscus.waiting = 0, meniscus.change()")
            await page.at_rest(300)
            await page.screenshot(os.path.join(os.environ["MENISCUS_SCREENSHOTS"], name))

    def rendered(self, molecule, *options, frame=None, size=SIZE):
        """Returns colour (sRGB over white), distance and atom of each pixel; frame: number in a run."""
        path = self.path("r.exr" if frame is None else f"r_{frame}.exr")
        names = ["-o", path] if frame is None else ["-o", self.path("r_#.exr"), "--only", str(frame)]
        self.run_program("render", molecule, *names, "--force", "-q", "--aovs", "--samples", "1", "--size",
                         "%dx%d" % size, "--device", "cpu", *options)
        image = OpenImageIO.ImageInput.open(path)
        names, pixels = image.spec().channelnames, image.read_image(OpenImageIO.FLOAT)
        channel = lambda name: pixels[:, :, names.index(name)]
        color = numpy.stack([channel(c) + 1 - channel("A") for c in "RGB"], axis=2)
        return srgb(color), channel("Z"), channel("atom").astype(numpy.int64)

    async def cast(self, page):
        answer = await page.evaluate(CAST)
        width, height = SIZE
        words = lambda key: numpy.frombuffer(base64.b64decode(answer[key]), numpy.uint32).reshape(height, width, 4)
        what, sums = words("what"), words("sums").view(numpy.float32)
        met = what[:, :, 1] != NOTHING
        t = what[:, :, 3].view(numpy.float32)
        x = (numpy.arange(width) + 0.5 - width / 2) * answer["pixel_size"] / answer["eye_distance"]
        y = (numpy.arange(height) + 0.5 - height / 2) * answer["pixel_size"] / answer["eye_distance"]
        slant = 1 if answer["orthographic"] else numpy.sqrt(1 + x[None, :] ** 2 + y[:, None] ** 2)
        z = numpy.where(met, t + answer["eye_distance"] * slant, numpy.inf)
        shown = numpy.array(answer["shown"] + [-1])
        atom = shown[numpy.where(met, what[:, :, 0], len(shown) - 1)]
        return srgb(sums[:, :, :3] + 1 - sums[:, :, 3:]), z, atom

    async def compare(self, page, molecule, *options):
        """Checks that at most one pixel in a thousand differs, none by more than its neighbours' values."""
        await self.load(page, self.export(molecule, "--size", "%dx%d" % SIZE, *options))
        self.check(f"{os.path.basename(molecule)} {' '.join(options)}", await self.cast(page), self.rendered(molecule, *options))

    def check(self, name, found, wanted):
        (color, z, atom), (true_color, true_z, true_atom) = found, wanted
        both = numpy.isfinite(z) & numpy.isfinite(true_z)
        self.assertGreater(both.sum(), 0.1 * both.size)
        far = numpy.isfinite(z) != numpy.isfinite(true_z)
        far |= both & (numpy.abs(numpy.where(both, z, 0) - numpy.where(both, true_z, 0)) > 2e-3)
        other_atom = atom != true_atom
        other_color = numpy.abs(color - true_color).max(axis=2) > 2 / 255
        differs = far | other_atom | other_color
        print(f"{name}: of {differs.size} pixels differ in depth {far.sum()}, atom {other_atom.sum()}, colour {other_color.sum()}; "
              f"any {100 * differs.mean():.3f} %")
        self.assertLessEqual(differs.mean(), 1e-3)
        # A differing pixel shows a point within half a pixel of its middle, at a distance between its neighbours'.
        for y, x in zip(*numpy.nonzero(far)):
            around = true_z[max(y - 1, 0):y + 2, max(x - 1, 0):x + 2]
            self.assertTrue(around.min() - 0.05 <= z[y, x] <= around.max() + 0.05, f"pixel {x}, {y}: {z[y, x]} Å")
        return far.sum(), other_atom.sum(), other_color.sum(), differs.mean()

    def balls(self, name, balls):
        """Writes a file of atoms, with places and radii."""
        with open(self.path(name), "w") as file:
            file.writelines("%.6f %.6f %.6f %.3f\n" % ball for ball in balls)
        return file.name
