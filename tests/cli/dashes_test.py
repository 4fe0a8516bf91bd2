#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Dashed lines of hydrogen bonds and distances have their lengths in pictures, runs and exports."""

import json
import pathlib
import re
import sys
import unittest

import numpy
import OpenImageIO

from molecule_case import MoleculeCase, pdb

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "preview"))
from exported_page import page_of

SMALL = ["--size", "320x240", "--samples", "1", "--view", "z", "--preset", "flat", "-q", "--force"]


def pair(distance, end="END\n"):
    """Returns an alcohol, and a carbonyl at this distance from its oxygen."""
    rows = [("HETATM", " C1", "LGA", "A", 1, (-0.5, -1.33, 0.0), "C"), ("HETATM", " O1", "LGA", "A", 1, (0.0, 0.0, 0.0), "O"),
            ("HETATM", " O2", "LGB", "B", 2, (distance, 0.0, 0.0), "O"),
            ("HETATM", " C2", "LGB", "B", 2, (distance + 0.7, 1.0, 0.0), "C")]
    return pdb(rows, end)


BONDS = ["--hide-surface", "--hydrogen-bonds", "resname LGA"]
DASHES = 6  # 2.8 Å have one dash per 0.5 Å


class Dashes(MoleculeCase):
    def setUp(self):
        super().setUp()
        self.write("pair.pdb", pair(2.8))
        self.write("apart.pdb", pair(3.6))
        self.write("models.pdb", "".join(f"MODEL     {n:4d}\n" + pair(distance, "ENDMDL\n")
                                         for n, distance in enumerate((2.8, 3.2, 3.6), 1)))

    def pixels(self, path):
        file = OpenImageIO.ImageInput.open(str(self.folder / path))
        values = numpy.asarray(file.read_image("uint8"))[..., :3].astype(int)
        file.close()
        return values

    def picture(self, *words, file="pair.pdb"):
        self.made("render", file, "-o", "a.png", *SMALL, "--background", "white", *words)
        return self.pixels("a.png")

    @staticmethod
    def dashes(pixels):
        """Returns the columns of runs of pixels that have the colour of dashes."""
        warm = (abs(pixels - (255, 179, 0)) < 40).all(axis=2)
        columns = warm.any(axis=0).astype(int)
        return int((numpy.diff(columns) == 1).sum())

    def test_a_hydrogen_bond_is_dashed_and_has_its_length(self):
        without = self.picture("--hide-surface", "--sticks", "all", "--device", "cpu")
        self.assertEqual(self.dashes(without), 0)
        plain = self.picture(*BONDS, "--hide-lengths", "--device", "cpu")
        self.assertEqual(self.dashes(plain), DASHES)
        written = self.picture(*BONDS, "--device", "cpu")
        changed = numpy.argwhere((written != plain).any(axis=2))
        self.assertGreater(len(changed), 50)
        rows = numpy.argwhere((plain != 255).any(axis=2))[:, 0]
        self.assertLess(abs(changed[:, 0] - numpy.median(rows)).max(), 60, "next to the line")
        numpy.testing.assert_array_equal(written, self.picture("--hide-surface", "--object", json.dumps(
            {"representation": "hydrogen_bonds", "selection": "resname LGA to all"}), "--device", "cpu"))

    def test_lengths_are_text_in_vectors_where_lines_are_seen(self):
        for more, count in (([], 2), (["--spheres", "all"], 0)):  # the text and its rim
            self.made("render", "pair.pdb", "-o", "a.svg", *SMALL, *BONDS, *more)
            text = (self.folder / "a.svg").read_text()
            self.assertEqual(text.count("<text"), count)
            self.assertEqual(text.count("2.8 Å"), count)

    def test_both_renderers_show_the_same(self):
        cpu, gl = (self.picture(*BONDS, "--device", device) for device in ("cpu", "software"))
        self.assertEqual(self.dashes(gl), DASHES)
        self.assertLess((abs(cpu - gl).max(axis=2) > 16).mean(), 0.002)

    def test_a_distance_is_that_of_the_closest_atoms(self):
        self.assertEqual(self.dashes(self.picture("--hide-surface", "--distance", "resname LGA to resname LGB", "--hide-lengths")), DASHES)
        other = self.picture("--hide-surface", "--distance", "name C1 to resid 2", "--hide-lengths")
        self.assertGreater(self.dashes(other), DASHES, "3.6 Å")

    def test_objects_have_their_own_colour_and_radius(self):
        own = {"representation": "hydrogen_bonds", "selection": "resname LGA", "color": "blue", "radius": 0.3}
        shown = self.picture("--hide-surface", "--object", json.dumps(own), "--hide-lengths")
        self.assertEqual(self.dashes(shown), 0)
        blue = (shown[..., 2] > 150) & (shown[..., 0] < 90)
        self.assertGreater(blue.sum(), 1000)

    def test_a_bond_that_breaks_is_gone_in_the_frames_without_it(self):
        done = self.made("render", "models.pdb", "--frames", "all", "-o", "f_#.png", *SMALL, "--background", "white", *BONDS,
                         "--hide-lengths", "--sticks", "all")
        self.assertEqual(done.stderr, "")
        counts = [self.dashes(self.pixels(f"f_{n}.png")) for n in range(3)]
        self.assertEqual(counts, [6, 6, 0])
        lengths = self.pixels("f_0.png"), self.pixels("f_1.png")
        self.assertTrue((lengths[0] != lengths[1]).any())

    def test_exports_have_the_dashes(self):
        self.made("export", "povray", "pair.pdb", "-o", "pov", "-q", *BONDS)
        text = (self.folder / "pov/surface_object_1.inc").read_text()
        self.assertEqual(len(re.findall(r"\bcylinder\b", text)), DASHES)
        self.made("export", "blender", "pair.pdb", "-o", "a.mns", "-q", *BONDS)
        self.assertIn(b"object 1", (self.folder / "a.mns").read_bytes())
        for renderer in ("mitsuba", "pbrt"):
            self.made("export", renderer, "pair.pdb", "-o", renderer, "-q", *BONDS)
        self.made("export", "mvs", "pair.pdb", "-o", "a.mvsx", "-q", *BONDS)
        written = [self.made("export", "page", "pair.pdb", "-o", f"{n}.html", "-q", *BONDS, *more) and (self.folder / f"{n}.html").read_bytes()
                   for n, more in enumerate(([], [], ["--hide-lengths"]))]
        self.assertEqual(written[0], written[1])
        labels = [[label["text"] for label in page_of(page.decode())[0]["labels"]] for page in written[1:]]
        self.assertEqual(labels, [["2.8 Å"], []])
        for exporter, name in (("povray", "p"), ("blender", "b"), ("mitsuba", "m"), ("page", "p.html")):
            self.made("export", exporter, "models.pdb", "--frames", "all", "-o", name, "-q", *BONDS, "--sticks", "all")

    def test_scenes_keep_them(self):
        first = self.picture(*BONDS, "--distance", "name C1 to name C2", "--save-scene", "a.json")
        objects = json.loads((self.folder / "a.json").read_text())["objects"]
        self.assertEqual(objects[1:], [{"representation": "hydrogen_bonds", "selection": "resname LGA"},
                                       {"representation": "distance", "selection": "name C1 to name C2"}])
        self.made("render", "--scene", "a.json", "-o", "b.png", "--force", "-q")
        numpy.testing.assert_array_equal(first, self.pixels("b.png"))

    def test_what_is_not_there_is_said(self):
        for file, words in (("pair.pdb", "--hydrogen-bonds 'resid 7'"), ("pair.pdb", "--distance 'all to resid 7'")):
            option, text = words.split(" ", 1)
            done = self.run_program("render", file, "-o", "a.png", option, text.strip("'"))
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn(option, done.stderr)
        for text, expected in (("ligand", "is not EXPR to EXPR"), ("resid 1 to 2", "is not EXPR to EXPR"), ("ligand to (", "is not EXPR to EXPR")):
            done = self.run_program("render", "pair.pdb", "-o", "a.png", "--distance", text)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("--distance", done.stderr)
            self.assertIn(expected, done.stderr)
        done = self.made("render", "apart.pdb", "-o", "a.png", "--force", "--size", "64x48", "--hydrogen-bonds", "all")
        self.assertIn("note: --hydrogen-bonds 'all' finds nothing to draw;", done.stderr)
        done = self.made("render", "pair.pdb", "-o", "a.png", "--force", "--size", "64x48", "--hide-lengths")
        self.assertIn("--hide-lengths", done.stderr)
        self.assertIn("no dashed lines", done.stderr)


if __name__ == "__main__":
    unittest.main()
