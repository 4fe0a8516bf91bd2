#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The surface of a file with a polymer is that of the polymer, and pictures show its ligands and ions next to it."""

import json
import unittest

import numpy
import OpenImageIO

from molecule_case import MoleculeCase, pdb

SMALL = ["--size", "120x90", "--samples", "1", "--device", "cpu", "-q", "--force"]
SHEET = [("ATOM", " CA", "ALA", "A", n + 1, (3.8 * (n % 6), 3.8 * (n // 6), 0.0), "C") for n in range(36)]
LIGAND = [("HETATM", " C1", "LIG", "B", 1, (8.0, 8.0, 9.0), "C"), ("HETATM", " O1", "LIG", "B", 1, (9.2, 8.0, 9.0), "O")]
ION = [("HETATM", "ZN", "ZN", "B", 2, (3.0, 14.0, 7.0), "ZN")]
LIGAND_COLORS = ["element-cpk", "element C=#45a878"]
WATER = [("HETATM", " O", "HOH", "B", 3, (14.0, 3.0, 7.0), "O")]


class Companions(MoleculeCase):
    def setUp(self):
        super().setUp()
        self.write("all.pdb", pdb(SHEET + LIGAND + ION + WATER))

    def pixels(self, path):
        file = OpenImageIO.ImageInput.open(str(self.folder / path))
        values = file.read_image(OpenImageIO.FLOAT)
        file.close()
        return values

    def picture(self, *words, file="all.pdb"):
        self.made("render", file, "-o", "a.png", *SMALL, *words)
        pixels = self.pixels("a.png")
        self.assertGreater(pixels.max(), 0.0)
        return pixels

    def assert_same(self, one, other):
        numpy.testing.assert_array_equal(one, other)

    def assert_other(self, one, other):
        self.assertFalse(numpy.array_equal(one, other))

    def atoms(self, *words, file="all.pdb"):
        return json.loads(self.made("surface", file, "--json", *words).stdout)["atoms"]


class Numbers(Companions):
    def test_the_surface_is_that_of_the_polymer(self):
        told = self.made("surface", "all.pdb", "--json")
        self.assertIn("40 atoms read; 1 water atom, 1 free ion, 2 ligand atoms (LIG) left out; 36 used (--select all adds ligands)", told.stderr)
        self.assertEqual(json.loads(told.stdout)["atoms"],
                         {"read": 40, "excluded": {"ion": 1, "ligand": 2, "water": 1}, "excluded_residues": {"ligand": {"LIG": 1}},
                          "used": 36})
        self.assertEqual(json.loads(told.stdout)["area"],
                         json.loads(self.made("surface", "all.pdb", "--json", "--select", "polymer").stdout)["area"])

    def test_options_that_take_more(self):
        self.assertEqual(self.atoms("--select", "all")["used"], 38)
        self.assertEqual(self.atoms("--select", "all", "--keep-water", "--keep-ions")["used"], 40)
        self.assertEqual(self.atoms("--keep-water", "--keep-ions")["used"], 38)
        self.assertIn("a surface takes 36 of them", self.made("info", "all.pdb").stdout)
        self.assertIn("a surface takes 38 of them", self.made("info", "all.pdb", "--select", "all").stdout)

    def test_a_file_without_a_polymer_is_taken_whole(self):
        self.write("ligand.pdb", pdb(LIGAND + ION))
        self.assertEqual(self.atoms(file="ligand.pdb"), {"read": 3, "excluded": {"ion": 1}, "used": 2})
        self.write("metal.pdb", pdb(ION + WATER))
        self.assertEqual(self.atoms(file="metal.pdb"), {"read": 2, "excluded": {"water": 1}, "used": 1})
        self.assertIn("a surface takes 1 of them", self.made("info", "metal.pdb").stdout)

    def test_frames_have_the_atoms_of_the_topology(self):
        lipids = [("ATOM", f" C{k}", "DPPC"[:3], "M", 10 + n, (30.0 + 2 * k, 3.0 * n, 0.0), "C") for n in range(21) for k in range(3)]
        gro = lambda rows, shift: "run\n" + f"{len(rows)}\n" + "".join(
            f"{row[4]:5d}{row[2]:<5}{row[1].strip():>5}{n:5d}{(row[5][0] + shift) / 10:8.3f}{row[5][1] / 10:8.3f}{row[5][2] / 10:8.3f}\n"
            for n, row in enumerate(rows, 1)) + "   9.0   9.0   9.0\n"
        rows = SHEET + LIGAND + [(*row[:2], "POPC", *row[3:]) for row in lipids] + WATER
        self.write("run.gro", gro(rows, 0.0))
        self.write("frames.pdb", "".join(
            f"MODEL {n}\n" + pdb([(*row[:2], row[2][:3], *row[3:]) for row in rows], "ENDMDL\n") for n in (1, 2)))
        told = self.made("surface", "run.gro", "--json")
        self.assertIn("1 water atom, 2 ligand atoms (LIG), 63 lipid atoms (21 POPC) left out; 36 used", told.stderr)
        self.assertEqual(self.made("surface", "run.gro", "--trajectory", "frames.pdb", "--json").stdout.count("\n"), 2)
        self.assert_same(self.picture(file="run.gro"), self.picture("--select", "polymer", "--object", json.dumps(
            {"representation": "sticks", "selection": "resname LIG", "color": LIGAND_COLORS, "radius": 0.4}), file="run.gro"))


class Pictures(Companions):
    def objects(self, **more):
        shapes = [{"representation": "sticks", "selection": "ligand", "color": LIGAND_COLORS, "radius": 0.4},
                  {"representation": "spheres", "selection": "ion", "color": "element-cpk"}]
        return [word for shape in shapes for word in ("--object", json.dumps({**shape, **more}))]

    def test_ligands_are_sticks_and_ions_are_spheres(self):
        plain = self.picture()
        self.assert_same(plain, self.picture("--select", "polymer", *self.objects()))
        self.assert_other(plain, self.picture("--bare"))

    def test_bare_is_the_polymer_alone(self):
        self.assert_same(self.picture("--bare"), self.picture("--select", "polymer"))
        self.assert_same(self.picture("--bare", "--sticks", "ligand"), self.picture("--select", "polymer", "--sticks", "ligand"))
        self.assert_same(self.picture("--bare", "--show", "within 10 of ligand"),
                         self.picture("--bare", "--show", "within 10 of resname LIG"))

    def test_what_is_named_is_drawn_once(self):
        """An option draws its atoms alone, or their shade would be darker and their edges doubled."""
        for kind in ("sticks", "balls", "spheres"):
            with self.subTest(kind):
                named = ["--" + kind, "ligand or ion", "--color", "grey"]
                self.assert_same(self.picture(*named), self.picture("--bare", *named))
        named = ["--object", json.dumps({"representation": "balls", "selection": "ligand", "color": "red"})]
        ion = ["--object", json.dumps({"representation": "spheres", "selection": "ion", "color": "element-cpk"})]
        self.assert_same(self.picture(*named), self.picture("--bare", *named, *ion))

    def test_selections_and_files_without_a_polymer_have_none(self):
        self.assert_same(self.picture("--select", "chain A"), self.picture("--select", "chain A", "--bare"))
        self.write("ligand.pdb", pdb(LIGAND + ION))
        self.assert_same(self.picture(file="ligand.pdb"), self.picture("--bare", file="ligand.pdb"))

    def test_rules_colour_them(self):
        self.assert_other(self.picture("--color", "grey", "--color", "ligand=red"), self.picture("--color", "grey"))
        self.assert_other(self.picture("--color", "chain", "--color", "ligand=red:Drug", "--legend"),
                          self.picture("--color", "chain", "--color", "ligand=red:Other", "--legend"))

    def test_saved_scenes_draw_the_same(self):
        for words in ([], ["--bare"]):
            with self.subTest(words):
                plain = self.picture("--save-scene", "a.json", *words)
                self.assertEqual(json.loads((self.folder / "a.json").read_text()).get("shapes", {}).get("bare", False), bool(words))
                self.made("render", "--scene", "a.json", "-o", "b.png", "--force", "-q")
                self.assert_same(plain, self.pixels("b.png"))

    def test_scenes_for_other_programs_have_them(self):
        sizes = {}
        for words in ([], ["--bare"]):
            self.made("export", "page", "all.pdb", "-o", "a.html", "--force", "-q", *words)
            self.made("export", "povray", "all.pdb", "-o", "pov", "--force", "-q", *words)
            self.made("export", "mesh", "all.pdb", "-o", "a.ply", "--tolerance", "0.5", "--force", "-q")
            pov = "".join(path.read_text() for path in (self.folder / "pov").iterdir() if path.suffix in (".pov", ".inc"))
            sizes[bool(words)] = (len((self.folder / "a.html").read_bytes()), pov.count("\n"), (self.folder / "a.ply").read_bytes())
        self.assertNotEqual(sizes[False][0], sizes[True][0])
        self.assertGreater(sizes[False][1], sizes[True][1])
        self.assertEqual(sizes[False][2], sizes[True][2])

    def test_bundles_make_the_same_frames(self):
        self.write("run.pdb", "".join(f"MODEL {n}\n" + pdb(SHEET + LIGAND + ION, "ENDMDL\n") for n in (1, 2)))
        words = [*SMALL[:-1], "--frames", "all"]
        self.made("render", "run.pdb", "-o", "f_#.png", *words)
        self.made("farm", "bundle", "bundle", "--chunk-frames", "1", "--engine", "make", "--", "render", "run.pdb", *words)
        self.made("work", "bundle")
        for picture in sorted((self.folder / "bundle" / "images").glob("*.png")):
            self.assert_same(self.pixels(f"f_{int(picture.stem[-1])}.png"), self.pixels(picture))


if __name__ == "__main__":
    unittest.main()
