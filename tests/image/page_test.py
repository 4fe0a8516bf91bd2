# SPDX-License-Identifier: BSD-3-Clause
"""Pages (.svg, .pdf) show the PNG file of the same command at the requested size, drawn by librsvg and by poppler."""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

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
        """Draws the page at the resolution of the picture."""
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
        # Edges of letters are smoothed in other ways (in sRGB); missing or misplaced letters would differ more.
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
        self.assertNotIn(str(self.folder), text)
        page = self.render("page.pdf").read_bytes()
        self.assertTrue(page.startswith(b"%PDF-1.6") and page.rstrip().endswith(b"%%EOF"))
        box = re.search(rb"/MediaBox \[0 0 ([\d.]+) ([\d.]+)\]", page)
        self.assertAlmostEqual(float(box.group(1)), 85.0 / 25.4 * 72.0, delta=0.3)
        self.assertEqual(self.render("again.pdf", "--no-provenance").read_bytes(),
                         self.render("more.pdf", "--no-provenance").read_bytes(), "equal pictures are equal files")

    def groups(self, path):
        """Returns the texts of each group of an SVG file, by the group's name in their order."""
        name = "{http://www.w3.org/2000/svg}"
        groups = xml.etree.ElementTree.parse(path).getroot().findall(name + "g")
        return {group.get("id"): [text.text for text in group.findall(name + "text")] for group in groups}

    def test_an_svg_file_has_texts_in_named_groups(self):
        page = self.render("page.svg", "--title", 'A < B & "C"')
        groups = self.groups(page)
        self.assertEqual(list(groups), ["molecule", "halos", "panel-letter", "title", "scale-bar", "labels", "legend"])
        self.assertEqual({name: groups[name] for name in list(groups)[2:6]},
                         {"panel-letter": ["a"], "title": ['A < B & "C"'], "scale-bar": ["5 Å"], "labels": ["Ala 1 = A", "Ala 4"]})
        self.assertEqual(groups["legend"], ["chain", "A", "B"])
        self.assertLessEqual(set(groups["halos"]), {"Ala 1 = A", "Ala 4", "5 Å"})
        texts = re.findall("<text [^>]*>", page.read_text())
        self.assertEqual(len(texts), 8 + len(groups["halos"]))
        for text in texts:
            self.assertIn("font-family=\"Arial, 'Liberation Sans', Helvetica, sans-serif\"", text)
        self.assertIn('font-weight="bold"', texts[len(groups["halos"])])

    def tool(self, *words):
        if not shutil.which(words[0]):
            self.skipTest(words[0] + " is not installed")
        return subprocess.run(words, check=True, cwd=self.folder, capture_output=True, text=True)

    def fonts(self, path):
        """Returns name, type and whether it is embedded and has characters, for each font of a PDF file."""
        lines = self.tool("pdffonts", path.name).stdout.splitlines()[2:]
        return [(line[:36].strip(), line[37:54].strip(), *line[55:].split()[-5::2]) for line in lines]

    def test_a_pdf_file_embeds_fonts_and_has_words_and_layers(self):
        page = self.render("page.pdf", "--title", 'A < B & "C" (Zn²⁺)')
        fonts = {name: (kind, rest) for name, kind, *rest in self.fonts(page)}
        self.assertEqual(set(fonts), {"LiberationSans", "LiberationSans-Bold", "DejaVuSans"}, "⁺ is not in Liberation Sans")
        lines = self.tool("pdffonts", page.name)
        self.assertEqual(lines.stderr, "")
        for line in lines.stdout.splitlines()[2:]:
            self.assertRegex(line, r"CID TrueType +Identity-H +yes no +yes")
        words = self.tool("pdftotext", "-layout", page.name, "-").stdout
        for text in ("Ala 1 = A", "Ala 4", "5 Å", 'A < B & "C" (Zn²⁺)', "chain"):
            self.assertEqual(words.replace(" ", "").count(text.replace(" ", "")), 1, words)
        layers = [bytes.fromhex(name.decode()).decode("utf-8-sig") for name in re.findall(rb"/Type /OCG /Name <([0-9A-F]*)>", page.read_bytes())]
        self.assertEqual(layers, ["molecule", "halos", "panel-letter", "title", "scale-bar", "labels", "legend"])

    def test_fonts_can_be_chosen(self):
        self.assertEqual({name for name, *_ in self.fonts(self.render("family.pdf", "--font", "dejavu sans"))}, {"DejaVuSans", "DejaVuSans-Bold"})
        file = next(pathlib.Path("/usr/share/fonts").rglob("DejaVuSerif.ttf"), None)
        if file:
            self.assertEqual({name for name, *_ in self.fonts(self.render("file.pdf", "--font-file", str(file)))}, {"DejaVuSerif"})
            self.assertIn("font-family=\"'DejaVu Serif', Arial", self.render("file.svg", "--font-file", str(file)).read_text())
            self.assertTrue((pixels_of(self.render("file.png", "--font-file", str(file))) != pixels_of(self.render("usual.png"))).any())
        for words, message in ((["--font", "No Such Font"], "no font of this family"), (["--font-file", "a.pdb"], "is not a .ttf or .otf file"),
                               (["--font-file", "gone.ttf"], "gone.ttf")):
            done = subprocess.run([PROGRAM, "render", "a.pdb", "-o", "no.png", *FIGURE, *words], cwd=self.folder, capture_output=True, text=True)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(message, done.stderr)
            self.assertFalse((self.folder / "no.png").exists())

    def test_a_page_ends_at_the_molecule(self):
        (self.folder / "long.pdb").write_text("".join("ATOM  %5d  CA  ALA A%4d    %8.3f%8.3f%8.3f  1.00 10.00           C\n" %
                                                      (n, n, 3.0 * n, 0.2 * n, 0.0) for n in range(1, 13)))
        for size, margin in ((["--size", "auto"], 24), (["--width", "40mm", "--dpi", "200", "--height", "auto", "--margin", "3mm"], 24)):
            for more in ([], ["--projection", "orthographic"], ["--legend", "--color", "chain", "--color", "resid 3=red", "--panel", "a"]):
                done = subprocess.run([PROGRAM, "render", "long.pdb", "-o", "fit.png", "--force", "--samples", "4", "--device", "cpu",
                                       "--preset", "flat", *size, *more], cwd=self.folder, capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)
                picture = pixels_of(self.folder / "fit.png")
                self.assertEqual(picture.shape[1], 315 if "40mm" in size else 1280)
                self.assertLess(picture.shape[0], 0.7 * picture.shape[1])
                if "--legend" in more:
                    continue
                rows, columns = numpy.nonzero(picture[..., 3] > 0.5)
                for gap in (rows[0], picture.shape[0] - 1 - rows[-1], columns.min(), picture.shape[1] - 1 - columns.max()):
                    self.assertAlmostEqual(gap, margin, delta=3)
        done = subprocess.run([PROGRAM, "render", "a.pdb", "-o", "no_#.png", "--size", "auto", "--frames", "all"], cwd=self.folder, capture_output=True,
                              text=True)
        self.assertIn("--size auto", done.stderr)
        for words in (["export", "povray", "a.pdb", "-o", "scene"], ["export", "blender", "a.pdb", "-o", "scene"], ["export", "page", "a.pdb", "-o", "a.html"],
                      ["looks", "a.pdb"], ["panels", "a.json", "-o", "a.png"], ["film", "a.json", "b.json", "-o", "a.mp4"]):
            done = subprocess.run([PROGRAM, *words, "--size", "auto"], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, 2, words)
            self.assertIn("auto is for `meniscus render`", done.stderr, words)

    def test_letters_and_bars_keep_two_millimetres(self):
        """Small letters keep that distance in pictures with a size on paper, and are nearer to the border in others."""
        written = ["--letter-color", "#00ff00", "--letter-size", "6", "--panel-size", "6", "--panel", "a", "--scale-bar", "5", "--title", "title", "--label", "resid 1=first",
                   "--projection", "orthographic", "--color", "element", "--background", "white"]
        for paper in ([], ["--width", "60mm", "--dpi", "254"]):
            for legend in ([], ["--legend", "--legend-place", "right"], ["--legend", "--legend-place", "below"]):
                subprocess.run([PROGRAM, "render", "a.pdb", "-o", "border.png", "--force", "-q", "--samples", "1", "--device", "cpu",
                                *(paper or ["--size", "320x240"]), *written, *legend], cwd=self.folder, check=True)
                picture = pixels_of(self.folder / "border.png")
                self.assertEqual(picture.shape[1], 600 if paper else 320)
                rows, columns = numpy.nonzero((picture[..., 1] > 0.6) & (picture[..., 0] < 0.4) & (picture[..., 2] < 0.4))
                gap = min(rows[0], picture.shape[0] - 1 - rows[-1], columns.min(), picture.shape[1] - 1 - columns.max())
                if paper:
                    self.assertGreaterEqual(gap, 19, legend)  # 2 mm are 20 pixels
                else:
                    self.assertLess(gap, 10, legend)

    def test_tiff_files_as_publishers_ask_for(self):
        for words, bits, compression in (([], "uint16", "zip"), (["--tiff-bits", "8", "--tiff-compression", "lzw"], "uint8", "lzw"),
                                         (["--tiff-compression", "none"], "uint16", "none")):
            image = OpenImageIO.ImageInput.open(str(self.render("page.tif", "--background", "white", *words)))
            spec = image.spec()
            self.assertEqual((str(spec.format), spec.getattribute("compression"), spec.nchannels), (bits, compression, 3))
            image.close()

    def test_a_legend_alone(self):
        for name in ("alone.svg", "alone.pdf"):
            self.render("b.png", "--legend-file", name)
            drawn = self.drawn(self.folder / name)
            self.assertLess(drawn.shape[1], 300)
            self.assertGreater((drawn.min(axis=2) < 0.5).sum(), 100)


if __name__ == "__main__":
    unittest.main()
