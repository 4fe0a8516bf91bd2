# SPDX-License-Identifier: BSD-3-Clause
"""A page of panels has the pixels that each scene gives alone at its size; shared legends and scales fit all panels."""

import json
import math
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
LOOK = ["--samples", "4", "--device", "cpu"]


def atoms(chains="AB", turned=False, warmth=10.0):
    lines = []
    for n in range(24):
        place = (3.2 * (n % 4), 3.2 * (n // 8), 1.1 * (n % 8))
        if turned:
            c, s = math.cos(0.7), math.sin(0.7)
            place = (c * place[0] - s * place[2] + 9.0, place[1] - 4.0, s * place[0] + c * place[2])
        residue = ("ALA", "GLY", "SER", "LEU", "LYS", "TRP")[n // 2 % 6]
        lines.append("ATOM  %5d  CA  %s %s%4d    %8.3f%8.3f%8.3f  1.00%6.2f           C" %
                     (n + 1, residue, chains[n // 12], n + 1, *place, warmth + n))
    return "\n".join(lines) + "\n"


def pixels_of(path):
    image = OpenImageIO.ImageInput.open(str(path))
    pixels = numpy.asarray(image.read_image("uint8")).astype(int)
    image.close()
    return pixels


class Panels(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "a.pdb").write_text(atoms())
        (self.folder / "b.pdb").write_text(atoms(turned=True, warmth=30.0))
        (self.folder / "c.pdb").write_text(atoms("BC"))

    def run_program(self, *words, code=0):
        done = subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr

    def render(self, molecule, name, *more):
        self.run_program("render", molecule, "-o", name, "--force", *LOOK, *more)
        return pixels_of(self.folder / name)

    def panels(self, *words, code=0, name="page.png"):
        return self.run_program("panels", *words, "-o", name, "--force", "--device", "cpu", code=code)

    def page(self, *words):
        self.panels(*words)
        return pixels_of(self.folder / "page.png")

    def test_a_chain_keeps_its_colour_in_a_part_of_its_file(self):
        self.render("a.pdb", "a.png", "--color", "chain", "--size", "90x90")
        part = self.render("a.pdb", "p.png", "--color", "chain", "--size", "90x90", "--select", "chain B", "--preset", "flat",
                           "--depth-cue", "0")
        self.assertGreater((part[..., :3] == (233, 183, 113)).all(axis=2).sum(), 100, "the second colour")
        self.assertNotIn("warning", self.panels("a.png", "p.png", "--legend"))
        self.render("c.pdb", "c.png", "--color", "chain", "--size", "90x90")
        self.assertIn("warning: #94cbfb is chain 'A' in panel 1 and chain 'B' in panel 2; 2 more colours differ", self.panels("a.png", "c.png"))
        self.render("b.pdb", "b.png", "--color", "bfactor", "--size", "90x90")
        self.render("a.pdb", "n.png", "--color", "bfactor", "--size", "90x90")
        self.assertIn("warning: the colours of B-factor show 10 to 33 in panel 1, but 30 to 53 in panel 2", self.panels("n.png", "b.png"))
        self.assertNotIn("warning", self.panels("n.png", "b.png", "--one-scale"))

    def test_each_panel_is_the_picture_of_its_scene(self):
        self.render("a.pdb", "a.png", "--color", "chain", "--size", "120x90", "--scale-bar", "5")
        self.render("b.pdb", "b.png", "--color", "bfactor", "--size", "200x100", "--legend", "--label", "resid 3=three")
        self.render("c.pdb", "c.png", "--color", "element", "--panel", "z", "--silhouettes", "2")
        page = self.page("a.png", "b.png", "c.png", "a.png", "c.png", "--size", "620x410", "--gap", "10", "--letters", "lower")
        self.assertEqual(page.shape[:2], (410, 620))
        for n, (molecule, letter, *look) in enumerate([
                ("a.pdb", "a", "--color", "chain", "--scale-bar", "5"),
                ("b.pdb", "b", "--color", "bfactor", "--legend", "--label", "resid 3=three"),
                ("c.pdb", "z", "--color", "element", "--silhouettes", "2"),
                ("a.pdb", "d", "--color", "chain", "--scale-bar", "5"),
                ("c.pdb", "z", "--color", "element", "--silhouettes", "2")]):
            alone = self.render(molecule, f"alone{n}.png", "--size", "200x200", "--panel", letter, *look)
            x, y = 210 * (n % 3), 210 * (n // 3)
            numpy.testing.assert_array_equal(page[y:y + 200, x:x + 200], alone, f"panel {n + 1}")
        self.assertEqual(page[200:210].max(), 0, "nothing is between rows")
        self.assertEqual(page[:, 200:210].max(), 0)
        self.assertEqual(page[210:, 420:].max(), 0, "no sixth panel")

    def test_a_legend_for_all_has_to_be_true_of_all(self):
        for molecule in "abc":
            self.render(f"{molecule}.pdb", f"{molecule}.png", "--color", "chain", "--size", "240x180")
        # Chain B is the second colour of a.pdb and the first of c.pdb.
        for other, shared in (("b.png", True), ("c.png", False)):
            plain = self.page("a.png", other, "--gap", "0", "--size", "480x180", "--background", "white")
            page = self.page("a.png", other, "--gap", "0", "--size", "480x180", "--background", "white", "--legend")
            legend = self.render("a.pdb", "legend.png", "--color", "chain", "--legend", "--size", "240x180", "--panel", "A",
                                 "--background", "white")
            self.assertFalse((plain == page).all())
            self.assertEqual((page[:, :240] == legend).all(), not shared, "its own legend")
            swatches = [numpy.argwhere((page == numpy.array(color)).all(axis=2)) for color in ((233, 183, 113), (148, 203, 251))]
            right = [place[place[:, 1] > 420] for place in swatches]
            self.assertTrue(all(len(place) > 20 for place in right))
        # The legend is on one panel, and the other has colours of another kind: the legend may not stand next to both.
        self.render("b.pdb", "b.png", "--color", "bfactor", "--size", "240x180", "--background", "white")
        self.render("a.pdb", "a.png", "--color", "chain", "--legend", "--size", "240x180", "--background", "white")
        page = self.page("a.png", "b.png", "--gap", "0", "--size", "480x180")
        alone = self.render("b.pdb", "alone.png", "--color", "bfactor", "--size", "240x180", "--panel", "B", "--background", "white")
        numpy.testing.assert_array_equal(page[:, 240:], alone)

    def test_one_scale_is_from_the_least_to_the_greatest(self):
        for molecule in "ab":
            self.render(f"{molecule}.pdb", f"{molecule}.png", "--color", "bfactor", "--size", "120x90")
        apart = self.page("a.png", "b.png", "--gap", "0", "--size", "240x90", "--letters", "none")
        page = self.page("a.png", "b.png", "--gap", "0", "--size", "240x90", "--letters", "none", "--one-scale")
        self.assertFalse((apart == page).all())
        for n, molecule in enumerate("ab"):
            alone = self.render(f"{molecule}.pdb", "alone.png", "--color", "bfactor", "--color-range", "10:53", "--size", "120x90")
            numpy.testing.assert_array_equal(page[:, 120 * n:120 * n + 120], alone)

    def test_superposed_molecules_with_one_camera_are_the_same_picture(self):
        for molecule in "ab":
            self.render(f"{molecule}.pdb", f"{molecule}.png", "--color", "chain", "--size", "160x120")
        words = ["a.png", "b.png", "--gap", "0", "--size", "320x120", "--letters", "none", "--one-camera"]
        apart = self.page(*words)
        self.assertGreater((abs(apart[:, :160] - apart[:, 160:]).max(axis=2) > 8).mean(), 0.1)
        said = self.panels(*words, "--superpose-on", "name CA")
        self.assertIn("b.png is superposed on a.png by 24 atoms with an RMSD of 0.00", said)
        page = pixels_of(self.folder / "page.png")
        self.assertLess((abs(page[:, :160] - page[:, 160:]).max(axis=2) > 8).mean(), 0.01)
        # The camera shows the content of both panels: nothing touches the border.
        for edge in (apart[0], apart[-1], apart[:, 0], apart[:, 159], apart[:, 160], apart[:, -1]):
            self.assertEqual(edge[..., 3].max(), 0)

    def test_pages_are_what_pictures_are(self):
        for molecule in "ab":
            self.render(f"{molecule}.pdb", f"{molecule}.png", "--color", "chain", "--label", "resid 3=three", "--size", "120x90")
        words = ["a.png", "b.png", "--width", "85mm", "--dpi", "150", "--legend", "--background", "white"]
        picture = self.page(*words)
        self.assertEqual(picture.shape[1], round(85 / 25.4 * 150))
        for name, tool in (("page.svg", ["rsvg-convert", "-d", "150", "-p", "150", "-o", "drawn.png", "page.svg"]),
                           ("page.pdf", ["pdftoppm", "-r", "150", "-png", "-singlefile", "page.pdf", "drawn"])):
            if not shutil.which(tool[0]):
                self.skipTest(tool[0] + " is not installed")
            self.panels(*words, name=name)
            subprocess.run(tool, cwd=self.folder, check=True)
            drawn = pixels_of(self.folder / "drawn.png")[..., :3]
            height, width = numpy.minimum(drawn.shape, picture.shape)[:2]
            self.assertLessEqual(abs(numpy.array(drawn.shape[:2]) - picture.shape[:2]).max(), 1)
            off = abs(drawn[:height, :width] - picture[:height, :width, :3]).max(axis=2)
            self.assertLess(off.mean(), 5.0, "edges of letters are smoothed in other ways")
            self.assertLess((off > 128).mean(), 0.004, name)
            (self.folder / "drawn.png").unlink()
        text = (self.folder / "page.svg").read_text()
        groups = {name: re.findall("<text [^>]*>([^<]*)</text>", group) for name, group in re.findall('<g id="([^"]*)"(.*?)</g>', text, re.S)}
        self.assertEqual(groups, {"molecule": [], "panel-1-halos": groups["panel-1-halos"], "panel-1-panel-letter": ["A"],
                                  "panel-1-labels": ["three"], "panel-2-halos": groups["panel-2-halos"], "panel-2-panel-letter": ["B"],
                                  "panel-2-labels": ["three"], "legend": ["chain", "A", "B"]})

    def test_one_frame_of_a_run_is_a_panel(self):
        run = "".join(f"MODEL {n + 1}\n{atoms(turned=n == 1)}ENDMDL\n" for n in range(2))
        (self.folder / "run.pdb").write_text(run)
        for name, frames in (("one", "1"), ("two", "0-1")):
            self.run_program("render", "run.pdb", "--frames", frames, "-o", f"{name}_#.png", "--size", "100x80", "--force", "--save-scene",
                             f"{name}.json", *LOOK)
        page = self.page("one.json", "--letters", "none")
        numpy.testing.assert_array_equal(page, pixels_of(self.folder / "one_1.png"))
        self.assertIn("a panel shows one frame, and this scene has 2", self.panels("two.json", code=2))

    def test_what_is_refused_leaves_nothing(self):
        self.render("a.pdb", "a.png", "--color", "chain", "--size", "120x90")
        self.render("b.pdb", "b.png", "--color", "bfactor", "--size", "120x90")
        self.render("c.pdb", "c.png", "--color", "occupancy", "--size", "120x90", "--no-provenance")
        for code, sentence, words in [
                (2, "PANEL", []),
                (3, "carries no scene", ["c.png"]),
                (2, "--one-scale: panel 1 is not coloured by a number", ["a.png", "b.png", "--one-scale"]),
                (2, "16 panels in 40 x 40 pixels have 10 x 10 each", ["a.png"] * 16 + ["--size", "40x40", "--gap", "0"]),
                (2, "--columns", ["a.png", "--columns", "0"]),
                (2, "--superpose-on 'chain Q'", ["a.png", "b.png", "--superpose-on", "chain Q"])]:
            self.assertIn(sentence, self.panels(*words, code=code, name="none.png"))
            self.assertFalse((self.folder / "none.png").exists())
        self.assertIn("panels are written as .png", self.panels("a.png", code=2, name="a.exr"))
        before = (self.folder / "a.pdb").read_bytes()
        (self.folder / "page.png").write_bytes(before)
        self.run_program("panels", "a.png", "-o", "page.png", code=6)
        self.assertEqual((self.folder / "page.png").read_bytes(), before)


if __name__ == "__main__":
    unittest.main()
