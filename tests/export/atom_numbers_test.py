# SPDX-License-Identifier: BSD-3-Clause
"""One number for an atom, its place in the file, in every output: PROGRAM ADDON. Each output is joined to the file by coordinates
or names, of a molecule of which atoms in the middle are not used."""

import csv
import json
import os
import re
import subprocess
import sys
import tempfile
import types
import unittest

import numpy as np
import OpenImageIO

PROGRAM, ADDON = sys.argv[1:3]
package = types.ModuleType("meniscus_import")  # The add-on is loaded without Blender.
package.__path__ = [os.path.join(ADDON, "meniscus_import")]
sys.modules["meniscus_import"] = package
from meniscus_import import mesh_arrays, mns_reader  # noqa: E402

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "mesh"))
import mesh_readers_test  # noqa: E402

#: A cage of carbons (an icosahedron around a cavity) among unused atoms: water, an altloc, and a name left out.
GOLD = (1 + 5 ** 0.5) / 2
CAGE = [row for a in (-2.1, 2.1) for b in (-2.1 * GOLD, 2.1 * GOLD) for row in ((0, a, b), (a, b, 0), (b, 0, a))]
RADIUS = 1.7


def records():
    rows = []
    for n, place in enumerate(CAGE):
        rows.append((f"C{n}", " ", "ALA", 1, place))
        if n == 2:
            rows.append(("O", " ", "HOH", 2, (30.0, 0.0, 0.0)))
        if n == 5:
            rows[-1] = (f"C{n}", "A", "ALA", 1, place)
            rows.append((f"C{n}", "B", "ALA", 1, (place[0] + 0.3, place[1], place[2])))
        if n == 8:
            rows.append(("CX", " ", "ALA", 1, (20.0, 0.0, 0.0)))
    return rows


class AtomNumbers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.rows = records()
        cls.places = np.array([row[4] for row in cls.rows], dtype=float).round(3)
        cls.file = cls.path("cage.pdb")
        with open(cls.file, "w", encoding="ascii") as file:
            for n, (name, altloc, residue, number, (x, y, z)) in enumerate(cls.rows):
                file.write(f"{'HETATM' if residue == 'HOH' else 'ATOM  '}{n + 1:5d}  {name:<3s}{altloc}{residue} A{number:4d}    {x:8.3f}{y:8.3f}{z:8.3f}  1.00{n:6.2f}"
                           f"          {name[0]:>2s}\n")
        # The same balls have no names here, and unused atoms have radius 0.
        cls.balls = cls.path("cage.xyzr")
        used = [row[2] == "ALA" and row[1] != "B" and row[0] != "CX" for row in cls.rows]
        with open(cls.balls, "w", encoding="ascii") as file:
            for (x, y, z), counts in zip(cls.places, used):
                file.write(f"{x:.3f} {y:.3f} {z:.3f} {RADIUS if counts else 0}\n")
        cls.used = np.flatnonzero(used)
        assert (cls.used != np.arange(len(cls.used))).sum() > 5

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    @classmethod
    def path(cls, name):
        return os.path.join(cls.holder.name, name)

    def run_program(self, *words, program=PROGRAM):
        done = subprocess.run([program, *words], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def inputs(self):
        """Returns the arguments for both inputs, the PDB file and the balls."""
        return ([self.file, "--select", "not name CX", "--device", "cpu", "-q"], [self.balls, "--device", "cpu", "-q"])

    def meet(self, points, numbers, what):
        """Checks that points of convex patches lie a radius away from the atoms that their numbers name."""
        numbers = np.asarray(numbers, dtype=int)
        self.assertEqual(set(numbers), set(self.used), what)
        distances = np.linalg.norm(np.asarray(points, dtype=float) - self.places[numbers], axis=1)
        np.testing.assert_allclose(distances, RADIUS, atol=2e-3, err_msg=what)

    def test_pictures(self):
        for words in self.inputs():
            for more in ([], ["--spheres", "name C3 or name O"]) if words[0] == self.file else ([],):
                found = []
                for view in ("x", "-x", "y", "-y", "z", "-z"):
                    exr = self.path("a.exr")
                    self.run_program("render", *words, "--aovs", "--samples", "1", "--size", "80x60", f"--view={view}", "--force", "-o", exr, *more)
                    image = OpenImageIO.ImageInput.open(exr)
                    values = dict(zip(image.spec().channelnames, np.moveaxis(np.asarray(image.read_image(OpenImageIO.FLOAT)), 2, 0)))
                    convex = values["kind"] == 0
                    found.append((np.stack([values["P." + k][convex] for k in "xyz"], axis=1), values["atom"][convex]))
                    self.assertTrue((values["atom"][values["kind"] == -1] == -1).all())
                    for n in np.unique(values["atom"][values["kind"] == 3]):
                        self.assertIn(self.rows[int(n)][0], ("C3", "O"))
                self.meet(*(np.concatenate(part) for part in zip(*found)), f"EXR {words[0]} {more}")

    def test_meshes(self):
        # VTP and GLB have the numbers of PLY, as mesh_readers_test checks.
        for words in self.inputs():
            ply = self.path("a.ply")
            self.run_program("export", "mesh", *words, "--tolerance", "0.02", "--force", "-o", ply)
            vertices, _ = mesh_readers_test.read_ply(mesh_readers_test.pathlib.Path(ply))
            # Only inner vertices count: one on a border may be nearest to another atom's contact.
            convex = vertices["ses_kind"] == 0
            points, numbers = mesh_readers_test.positions_of(vertices)[convex], vertices["atom_index"][convex].astype(int)
            near = np.abs(np.linalg.norm(points - self.places[numbers], axis=1) - RADIUS) < 2e-3
            self.assertGreater(near.mean(), 0.99)
            self.meet(points[near], numbers[near], f"PLY {words[0]}")

    def test_blender(self):
        for words in self.inputs():
            mns = self.path("a.mns")
            self.run_program("export", "blender", *words, "--force", "-o", mns)
            surface = mns_reader.read(mns).objects[0]
            np.testing.assert_allclose(self.places[surface["atom.file_index"]], surface["atom.center"], atol=1e-6)
            made = mesh_arrays.of_surface(surface, 1.0, True, mesh_arrays.names_of(surface))
            values = {name: array for name, *_, array in made.attributes}
            convex = surface["mesh.kind"] == 0
            self.meet(made.positions[made.triangles[convex][:, 0]], values["atom_index"][convex], f"Blender {words[0]}")
            np.testing.assert_array_equal(values["ses_atom"], surface["mesh.atom"])
            atoms = self.path("a.atoms")
            self.run_program("export", "atoms", *words, "--force", "-o", atoms)
            _, arrays = mns_reader.read_arrays(atoms)
            np.testing.assert_allclose(self.places[arrays["atom.file_index"]], arrays["atom.center"], atol=1e-6)

    def test_comments_of_povray(self):
        for words in self.inputs():
            folder = self.path("povray" + os.path.splitext(words[0])[1])
            self.run_program("export", "povray", *words, "--comments", "-o", folder)
            with open(os.path.join(folder, "surface_geometry.inc"), encoding="utf-8") as file:
                named = set(re.findall(r"// convex (.*)", file.read()))
            if words[0] == self.file:
                self.assertEqual(named, {f"A ALA 1 {self.rows[n][0]}" for n in self.used})
            else:
                self.assertEqual(named, {f"index {n}" for n in self.used})

    def test_tables_and_what_takes_numbers(self):
        words = self.inputs()[0]
        tables = [self.path("areas.csv"), self.path("gradients.csv")]
        self.run_program("surface", *words, "--csv", tables[0], "--gradients", tables[1])
        for table in tables:
            with open(table, encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual([int(row["index"]) for row in rows], list(self.used))
            self.assertEqual([row["name"] for row in rows], [self.rows[n][0] for n in self.used])
        pockets = json.loads(self.run_program("pockets", *words, "--probe", "0.7", "--json"))
        for pocket in pockets["pockets"]:
            self.assertTrue(set(pocket["atoms"]) <= set(self.used))
        numbers = self.path("numbers.csv")
        with open(numbers, "w", encoding="ascii") as file:
            file.write("index,value\n" + "".join(f"{n},{n}\n" for n in range(len(self.rows))))
        for color in (["--color", "index", "--color-range", "0:20"], ["--color-by-file", numbers, "--map", "viridis", "--color-range", "0:20"]):
            mns = self.path("b.mns")
            self.run_program("export", "blender", *words, *color, "--force", "-o", mns)
            surface = mns_reader.read(mns).objects[0]
            colors = {tuple(color): n for color, n in zip(surface["atom.color"].round(6), surface["atom.file_index"])}
            self.assertEqual(len(colors), len(self.used))
            if color[0] == "--color":
                first = surface["atom.color"]
        np.testing.assert_array_equal(surface["atom.color"], first)
        for n in (4, 8):
            text = self.run_program("surface", self.file, "--device", "cpu", "-q", "--select", f"index {n}", "--csv", "-")
            (row,) = csv.DictReader(text.splitlines())
            self.assertEqual(row["name"], self.rows[n][0])

    def test_msms(self):
        self.run_program("-if", self.balls, "-of", self.path("msms"), "-af", self.path("msms"), program=PROGRAM + "-msms")
        with open(self.path("msms.vert"), encoding="ascii") as file:
            vertices = np.array([[float(word) for word in line.split()[:9]] for line in file.readlines()[3:]])
        spheres = vertices[:, 7].astype(int) - 1
        near = np.abs(np.linalg.norm(vertices[:, :3] - self.places[spheres], axis=1) - RADIUS) < 2e-3
        self.assertEqual(set(spheres[near]), set(self.used))
        with open(self.path("msms.area"), encoding="ascii") as file:
            rows = [line.split() for line in file.readlines()[1:]]
        self.assertEqual([int(row[0]) for row in rows], list(range(len(self.rows))))
        self.assertEqual({int(row[0]) for row in rows if float(row[1]) > 0}, set(self.used))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
