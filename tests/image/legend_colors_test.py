# SPDX-License-Identifier: BSD-3-Clause
"""Numbers are read back from a picture in its readers' way: each sphere's colour is looked up on the colour bar of the
same picture, for any lightness, and lies at the number of its atom."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy
import OpenImageIO

PROGRAM = sys.argv.pop(1)
COUNT = 9
NUMBERS = [float(n) for n in range(COUNT)]


def spheres():
    """Returns a sphere for each number, each farther away than the last, and some of them in others' shade."""
    lines = []
    for n, number in enumerate(NUMBERS):
        x, y, z = 9.0 * (n % 3), 9.0 * (n // 3), -4.0 * n
        lines.append("ATOM  %5d  C   ALA A%4d    %8.3f%8.3f%8.3f  1.00%6.2f           C" % (n + 1, n + 1, x, y, z, number))
    return "\n".join(lines) + "\n"


def linear(srgb):
    return numpy.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def picture_of(path):
    image = OpenImageIO.ImageInput.open(str(path))
    pixels = image.read_image("float")
    image.close()
    return numpy.asarray(pixels)[..., :3]


def bar_of(pixels):
    """Returns the colours along the bar from its lower end, from columns at the right with little paper and ink."""
    width = pixels.shape[1]
    colored = (pixels.max(axis=2) - pixels.min(axis=2) > 0.02) | ((pixels.max(axis=2) > 0.2) & (pixels.max(axis=2) < 0.9))
    strip = range(width * 7 // 8, width)
    column = max(strip, key=lambda x: colored[:, x].sum())
    inside = [x for x in strip if colored[:, x].sum() > 0.95 * colored[:, column].sum()]
    middle = inside[len(inside) // 2]
    rows = numpy.flatnonzero(colored[:, middle])
    return pixels[rows.max() : rows.min() : -1, middle]


def place_on(bar, colors):
    """Returns the share of the bar that fits all of these colours best, each with a lightness of its own."""
    bar, colors = linear(bar), linear(colors)
    # Light in [0, 1] brings the bar's colour nearest to each; the remaining distance is measured in the eye's terms.
    light = numpy.clip(colors @ bar.T / numpy.maximum((bar * bar).sum(axis=1), 1e-9), 0.0, 1.0)
    off = numpy.sqrt(light[..., None] * bar[None]) - numpy.sqrt(colors)[:, None]
    return numpy.argmin((off * off).sum(axis=(0, 2))) / (len(bar) - 1)


class LegendColors(unittest.TestCase):
    def render(self, *words):
        with tempfile.TemporaryDirectory() as folder:
            molecule, picture = pathlib.Path(folder) / "spheres.pdb", pathlib.Path(folder) / "spheres.png"
            molecule.write_text(spheres())
            result = subprocess.run([PROGRAM, "render", molecule, "-o", picture, "--color", "bfactor", "--legend", "--legend-title", "",
                                     "--background", "white", "--projection", "orthographic", "--view", "z", "--samples", "4",
                                     "--size", "400x300", *words], capture_output=True, text=True, timeout=100)
            self.assertEqual(result.returncode, 0, result.stderr)
            return picture_of(picture), result.stderr

    def places(self, pixels):
        """Returns the place of each sphere's colours on the bar; spheres are parted by the paper between them."""
        bar = bar_of(pixels)
        molecule = pixels[:, : pixels.shape[1] * 7 // 8]
        ink = (numpy.abs(molecule - 1.0).max(axis=2) > 0.02)
        rows, columns = self.runs(ink.any(axis=1)), self.runs(ink.any(axis=0))
        self.assertEqual((len(rows), len(columns)), (3, 3))
        found = []
        for low, high in reversed(rows):  # The upper row comes first.
            for left, right in columns:
                y, x = (low + high) // 2, (left + right) // 2
                reach = max(2, (high - low) // 4)  # The reach stays clear of the outline.
                found.append(place_on(bar, molecule[y - reach : y + reach, x - reach : x + reach].reshape(-1, 3)))
        return found

    @staticmethod
    def runs(flags):
        edges = numpy.flatnonzero(numpy.diff(numpy.concatenate(([0], flags.astype(int), [0]))))
        return list(zip(edges[::2], edges[1::2]))

    def check(self, *words):
        pixels, _ = self.render(*words)
        for number, place in zip(NUMBERS, self.places(pixels)):
            self.assertLess(abs(place - number / NUMBERS[-1]), 0.5 / (COUNT - 1), (words, number, place))

    def test_each_number_is_found_on_the_bar_by_every_map(self):
        for name in ("viridis", "cividis", "magma", "blue-white-red", "red-white-blue", "blues", "ylorrd"):
            with self.subTest(map=name):
                self.check("--map", name)

    def test_each_look_leaves_colours_on_the_bar(self):
        for preset in ("publication", "cover", "flat", "soft", "classic"):
            for name in ("viridis", "blue-white-red"):
                with self.subTest(preset=preset, map=name):
                    self.check("--preset", preset, "--map", name)

    def test_a_fade_that_is_asked_for_counts_and_is_said(self):
        plain, said = self.render()
        self.assertNotIn("legend", said)
        faded, said = self.render("--depth-cue", "0.9")
        self.assertIn("--depth-cue fades them into the background", said)
        self.assertGreater(numpy.abs(faded - plain).max(), 0.3)
        found = self.places(faded)
        self.assertGreater(abs(found[-1] - 1.0) + abs(found[-2] - NUMBERS[-2] / NUMBERS[-1]), 0.0)

    def test_a_legend_does_not_change_the_molecule(self):
        with tempfile.TemporaryDirectory() as folder:
            molecule = pathlib.Path(folder) / "spheres.pdb"
            molecule.write_text(spheres())
            for scheme in ("chain", "bfactor"):
                for preset in ("publication", "cover", "soft", "classic"):
                    pictures = []
                    for legend in ([], ["--legend-file", pathlib.Path(folder) / "legend.png"]):
                        picture = pathlib.Path(folder) / "picture.png"
                        subprocess.run([PROGRAM, "render", molecule, "-o", picture, "--force", "--color", scheme, "--preset", preset,
                                        "--background", "white", "--size", "200x150", *legend], check=True, capture_output=True)
                        pictures.append(picture_of(picture))
                    with self.subTest(scheme=scheme, preset=preset):
                        self.assertTrue((pictures[0] == pictures[1]).all())

    def test_the_classes_of_confidence_have_exactly_their_colours(self):
        """Unlit, each sphere has the colour of its class, and so has a box of the legend."""
        wanted = [(0x00, 0x53, 0xD6), (0x65, 0xCB, 0xF3), (0xFF, 0xDB, 0x13), (0xFF, 0x7D, 0x45)]
        line = "ATOM  %5d  CA  ALA A%4d    %8.3f   0.000   0.000  1.00%6.2f           C\n"
        with tempfile.TemporaryDirectory() as folder:
            molecule, picture = pathlib.Path(folder) / "model.pdb", pathlib.Path(folder) / "model.png"
            molecule.write_text("".join(line % (n, n, 9.0 * n, number) for n, number in enumerate([95, 80, 60, 30])))
            result = subprocess.run([PROGRAM, "render", molecule, "-o", picture, "--color", "plddt", "--legend", "--background", "white",
                                     "--projection", "orthographic", "--view", "z", "--size", "600x200", "--preset", "flat"],
                                    capture_output=True, text=True, timeout=100)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("pLDDT is that of B-factors", result.stderr)
            pixels = numpy.rint(picture_of(picture) * 255).astype(int)
        first_box = min(x for x in range(300, 600) if (pixels[:, x] == wanted[0]).all(axis=1).any())
        columns = [numpy.flatnonzero((pixels[:, :first_box - 1] == color).all(axis=2).any(axis=0)) for color in wanted]
        rows = [numpy.flatnonzero((pixels[:, first_box:] == color).all(axis=2).any(axis=1)) for color in wanted]
        for sphere, box in zip(columns, rows):
            self.assertGreater(len(sphere), 20)
            self.assertGreater(len(box), 5)
        for before, behind in zip(range(3), range(1, 4)):
            self.assertLess(columns[before].max(), columns[behind].min(), "spheres from the left")
            self.assertLess(rows[before].max(), rows[behind].min(), "boxes from above")

    def test_a_legend_has_the_colours_of_the_picture_and_no_others(self):
        """Unlit pictures show pairs of a scheme and a rule; shapes next to the surface count, too."""
        lines = ["ATOM  %5d %s ALA %s%4d    %8.3f%8.3f   0.000  1.00%6.2f          %2s" %
                 (n + 1, name, chain, n, 9.0 * n, 9.0 * row, 10.0 + 7 * n, element)
                 for row, chain in enumerate("ABC")
                 for n, (name, element) in enumerate([(" CA ", "C"), (" N  ", "N"), (" O  ", "O"), (" CB ", "C")])]
        cases = [["element", "element C=chain"], ["lightgrey", "protein=chain"], ["chain", "element N O=element-cpk"],
                 ["element", "chain A B C=red"], ["chain", "chain C=#123456:third"], ["kind"], ["chain", "name CB=element"]]
        scales = [["element", "element C=bfactor"], ["#eeeeee", "chain B=bfactor"], ["bfactor", "element O=chain"]]
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "atoms.pdb").write_text("\n".join(lines) + "\n")

            def colors(*words):
                """Returns the colours of the picture and of its legend that many pixels have."""
                result = subprocess.run([PROGRAM, "render", "atoms.pdb", "-o", "p.png", "--legend-file", "l.png", "--background", "white",
                                         "--projection", "orthographic", "--view", "z", "--size", "500x400", "--preset", "flat",
                                         "--silhouettes", "0", "--samples", "1", "--device", "cpu", "--force", *words],
                                        cwd=folder, capture_output=True, text=True, timeout=100)
                self.assertEqual(result.returncode, 0, result.stderr)
                found = []
                for name, least in (("p.png", 60), ("l.png", 150)):  # A box of the legend has 169 pixels.
                    pixels = numpy.rint(picture_of(pathlib.Path(folder) / name) * 255).astype(int).reshape(-1, 3)
                    each, count = numpy.unique(pixels, axis=0, return_counts=True)
                    found.append({tuple(color) for color, n in zip(each, count) if n > least and tuple(color) != (255, 255, 255)})
                return found[0], {color for color in found[1] if max(color) > 60}  # Ink is left out.
            for case in cases:
                with self.subTest(case=case):
                    drawn, told = colors(*sum((["--color", word] for word in case), []))
                    self.assertEqual(drawn, told)
            drawn, told = colors("--color", "kind", "--balls", "chain B", "--opacity", "chain B=0")
            self.assertEqual(drawn, told, "balls are by element where the surface is by kind of patch")
            drawn, told = colors("--color", "chain", "--hide-surface", "--spheres", "chain B")
            self.assertEqual(drawn, told, "one chain is drawn")
            drawn, told = colors("--spheres", "chain B", "--opacity", "chain B=0")
            self.assertEqual(drawn, told, "by default surfaces are by chain, and spheres by element")
            self.assertIn((0x46, 0x66, 0xD8), drawn, "nitrogen, as element-cpk has it")
            self.assertIn((0xE9, 0xB7, 0x71), drawn, "carbon has the colour of the second chain")
            for case in scales:
                with self.subTest(case=case):
                    drawn, _ = colors(*sum((["--color", word] for word in case), []))
                    legend = numpy.rint(picture_of(pathlib.Path(folder) / "l.png") * 255).astype(int).reshape(-1, 3)
                    for color in drawn:
                        self.assertLessEqual(numpy.abs(legend - color).max(axis=1).min(), 8, color)


if __name__ == "__main__":
    unittest.main()
