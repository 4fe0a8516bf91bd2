# SPDX-License-Identifier: BSD-3-Clause
"""Pages (.svg, .pdf) show what the PNG file of the same command shows, at the size that was asked for, drawn by librsvg
and by poppler."""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy
import OpenImageIO

PROGRAM = sys.argv.pop(1)
FIGURE = ["--color", "chain", "--legend", "--panel", "a", "--scale-bar", "5", "--label", "resid 1=Ala 1 = A", "--label",
          "resid 4=Ala 4", "--width", "85mm", "--dpi", "150", "--samples", "4", "--device", "cpu"]


def atoms():
    lines = []
    for n in range(8):
        lines.append("ATOM  %5d  CA  ALA %s%4d    %8.3f%8.3f%8.3f  1.00 10.00           C" %
                     (n + 1, "AB"[n % 2], n + 1, 3.2 * (n % 4), 3.2 * (n // 4), 0.7 * n))
    return "\n".join(lines) + "\n"


def pixels_of(path):
    image = OpenImageIO.ImageInput.open(str(path))
    pixels = numpy.asarray(image.read_image("float"))
    image.close()
    return pixels


def on_paper(pixels):
    if pixels.shape[2] == 3:
        return pixels
    return pixels[..., :3] * pixels[..., 3:] + (1.0 - pixels[..., 3:])


class Pages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "a.pdb").write_text(atoms())

    def render(self, name, *more):
        done = subprocess.run([PROGRAM, "render", "a.pdb", "-o", name, "--force", *FIGURE, *more], cwd=self.folder, capture_output=True,
                              text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.folder / name

    def drawn(self, page):
        """The page at the resolution of the picture."""
        tool = {".svg": "rsvg-convert", ".pdf": "pdftoppm"}[page.suffix]
        if not shutil.which(tool):
            self.skipTest(tool + " is not installed")
        out = page.with_name(page.stem + "_drawn")
        if page.suffix == ".svg":
            words = [tool, "-d", "150", "-p", "150", "-b", "white", "-o", str(out) + ".png", str(page)]
        else:
            words = [tool, "-r", "150", "-png", "-singlefile", str(page), str(out)]
        subprocess.run(words, check=True)
        return pixels_of(str(out) + ".png")[..., :3]

    def compare(self, ending, *more):
        picture = on_paper(pixels_of(self.render("picture.png", *more)))
        page = self.drawn(self.render("page" + ending, *more))
        self.assertLessEqual(abs(numpy.array(page.shape) - picture.shape).max(), 1)
        height, width = numpy.minimum(page.shape, picture.shape)[:2]
        off = abs(page[:height, :width] - picture[:height, :width]).max(axis=2)
        # Edges of letters are smoothed in other ways (in sRGB); what was missing or elsewhere would be more than that.
        self.assertLess(off.mean(), 0.01)
        self.assertLess((off > 0.5).mean(), 0.003)

    def test_svg(self):
        for more in ([], ["--background", "white"]):
            self.compare(".svg", *more)

    def test_pdf(self):
        for more in ([], ["--background", "white"]):
            self.compare(".pdf", *more)

    def test_sizes_and_texts(self):
        text = self.render("page.svg").read_text()
        width = float(re.search(r'<svg [^>]*width="([\d.]+)mm"', text).group(1))
        self.assertAlmostEqual(width, 85.0, delta=0.1)
        for word in ("Ala 1 = A", "Ala 4", "5 Å", "a"):
            self.assertIn(f'aria-label="{word}"', text)
        self.assertNotIn("<text", text, "outlines need no font")
        self.assertNotIn(str(self.folder), text)
        page = self.render("page.pdf").read_bytes()
        self.assertTrue(page.startswith(b"%PDF-1.4") and page.rstrip().endswith(b"%%EOF"))
        box = re.search(rb"/MediaBox \[0 0 ([\d.]+) ([\d.]+)\]", page)
        self.assertAlmostEqual(float(box.group(1)), 85.0 / 25.4 * 72.0, delta=0.3)
        self.assertEqual(self.render("again.pdf", "--no-provenance").read_bytes(),
                         self.render("more.pdf", "--no-provenance").read_bytes(), "equal pictures are equal files")

    def test_a_legend_alone(self):
        for name in ("alone.svg", "alone.pdf"):
            self.render("b.png", "--legend-file", name)
            drawn = self.drawn(self.folder / name)
            self.assertLess(drawn.shape[1], 300)
            self.assertGreater((drawn.min(axis=2) < 0.5).sum(), 100)


if __name__ == "__main__":
    unittest.main()
