# SPDX-License-Identifier: BSD-3-Clause
"""Every error that a program can provoke: it is Python's exception, too, and its message has no word of C or of the command
line. Environment as of package_test.py."""
import io
import os
import pathlib
import pickle
import re
import sys
import tempfile
import unittest
import warnings

if "MENISCUS_PACKAGE" in os.environ:
    sys.path.insert(0, os.environ["MENISCUS_PACKAGE"])

import numpy as np

import meniscus
from meniscus import _header, _library
from structure_test import atoms, cif, gro, pdb

#: Words that no message may have: options, C's constants, types and functions, and fields with other names in Python.
FOREIGN = re.compile(r"(?<![\w-])--\w|\bNULL\b|MENISCUS_|(?<!\x22)meniscus_\w|\b(large_)?probe_radius\b|\batom_colors\b|sizeof|struct\b|"
                     r"standard input|/tmp/meniscus-|size_t|\bstride\b")
PSF = "PSF\n\n 1 !NTITLE\n x\n\n 1 !NATOM\n 1 A 1 LIG C1 CT 0.0 12.011 0\n\n 0 !NBOND: bonds\n"
SOURCES = pathlib.Path(__file__).resolve().parents[2] / "exporters/bindings/c"


class Provoked(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder, before = tempfile.TemporaryDirectory(), os.getcwd()
        cls.addClassCleanup(folder.cleanup)
        cls.addClassCleanup(os.chdir, before)
        os.chdir(folder.name)
        rows = atoms()
        for name, text in (("helix.pdb", pdb(rows)), ("helix.cif", cif(rows)), ("helix.gro", gro(rows)), ("nothing.pdb", ""),
                           ("odd.pdb", "<html>"), ("run.xtc", "\7\xcb"), ("top.psf", PSF), ("scene.json", "{"), ("water.pdb", pdb(rows[:1]).replace("ALA", "HOH")),
                           ("unknown.cif", cif([("Q1", "?", "LIG", "A", 1, (0, 0, 0))]))):
            pathlib.Path(name).write_text(text)
        os.mkdir("folder")
        warnings.simplefilter("ignore")
        cls.molecule, cls.messages = meniscus.read("helix.pdb"), []
        cls.surface = meniscus.surface(cls.molecule)
        cls.mesh = cls.surface.mesh(0.5)
        cls.mesh.save("there.stl")

    def provoke(self, *calls, kinds=(meniscus.Error,)):
        for number, call in enumerate(calls):
            with self.subTest(call=number):
                with self.assertRaises(kinds[0]) as caught:
                    call()
                error = caught.exception
                for kind in (*kinds, meniscus.Error):
                    self.assertIsInstance(error, kind, error)
                self.assertNotRegex(str(error), FOREIGN)
                self.assertLess(len(str(error)), 1000)
                self.assertEqual(type(error).__module__, "meniscus")
                again = pickle.loads(pickle.dumps(error))
                self.assertEqual((type(again), str(again)), (type(error), str(error)))
                self.messages.append(str(error))

    def test_files(self):
        read, mesh, picture = meniscus.read, self.mesh, self.surface.render(size=(8, 8), device="cpu")
        self.provoke(lambda: read("none.pdb"), lambda: read("none/x.pdb"), lambda: meniscus.Scene("none.pdb").render("cpu"),
                     lambda: meniscus.Scene.read("none.json"), lambda: list(meniscus.frames("none.pdb")),
                     kinds=(FileNotFoundError, meniscus.InputError))
        self.provoke(lambda: mesh.save("none/x.stl"), lambda: picture.save("none/x.png"), lambda: self.molecule.write("none/x.cif"),
                     kinds=(FileNotFoundError, meniscus.OutputError))
        self.provoke(lambda: read("folder"), kinds=(IsADirectoryError, meniscus.InputError))
        self.provoke(lambda: read("helix.pdb/x"), kinds=(NotADirectoryError, meniscus.InputError))
        self.provoke(lambda: mesh.save("there.stl"), lambda: picture.save("helix.pdb.png") or picture.save("helix.pdb.png"),
                     kinds=(FileExistsError, meniscus.OutputError))
        with self.assertRaises(FileNotFoundError) as caught:
            read("none.pdb")
        self.assertEqual((caught.exception.filename, caught.exception.errno), ("none.pdb", 2))
        self.assertEqual(str(caught.exception), "none.pdb: cannot be read: No such file or directory")
        if os.geteuid():
            os.chmod("odd.pdb", 0)
            self.provoke(lambda: read("odd.pdb"), kinds=(PermissionError, meniscus.InputError))
            os.chmod("odd.pdb", 0o600)
        for status, base in ((_header.INPUT, meniscus.InputError), (_header.OUTPUT, meniscus.OutputError)):
            error = _library.error_of(status, "a.pdb: cannot be read: Permission denied")
            self.assertTrue(isinstance(error, PermissionError) and isinstance(error, base) and error.filename == "a.pdb")

    def test_types(self):
        s, m = self.surface, self.molecule
        self.provoke(lambda: meniscus.surface(m, threads=1.5), lambda: meniscus.surface(m, probe="1"), lambda: s.mesh("fine"),
                     lambda: s.mesh(even="no"), lambda: meniscus.read(5), lambda: meniscus.read("helix.pdb", select=5),
                     lambda: meniscus.surface("helix.pdb"), lambda: meniscus.surface([[0, 0, 0]]), lambda: m["chain A"],
                     lambda: m.names == 3, lambda: m.residue_numbers == "48", lambda: m.chains != 1, lambda: m.b_factors == "x",
                     lambda: meniscus.from_rdkit(m), lambda: meniscus.frames({}), lambda: meniscus.Scene(5),
                     lambda: meniscus.Scene(size={}), lambda: s.render(camera=5), lambda: s.distance([["a", "b", "c"]]),
                     lambda: m.select(5), lambda: m.colors(5), lambda: meniscus.buried("x", "a", "b"),
                     lambda: meniscus.Structure([[0, 0, 0]], ["C"], names=[5]), lambda: self.mesh.save(5),
                     lambda: meniscus.Structure([[0, 0, 0]], ["C"], residue_numbers=[1.5]),
                     kinds=(TypeError, meniscus.InputError))

    def test_names_and_places(self):
        scene = meniscus.Scene()
        self.provoke(lambda: scene["depth_cu"], lambda: scene.depth_cu, lambda: setattr(scene, "depth_cu", 1), lambda: scene["zz"],
                     lambda: meniscus.Scene(silhouetes=1), kinds=(KeyError, AttributeError, meniscus.UsageError))
        self.assertFalse(hasattr(scene, "depth_cu"))
        self.provoke(lambda: self.molecule[64], lambda: self.molecule[[0, 99]], lambda: self.molecule[np.ones(3, bool)],
                     kinds=(IndexError, meniscus.InputError))

    def test_values(self):
        read, s, m, mesh, scene = meniscus.read, self.surface, self.molecule, self.mesh, meniscus.Scene
        nan = float("nan")
        self.provoke(
            lambda: meniscus.surface(np.zeros((0, 3)), 1.7), lambda: meniscus.surface([[0, 0, nan]], 1.7),
            lambda: meniscus.surface([[0, 0, 1e9]], 1.7), lambda: meniscus.surface([[0, 0, 0]], -1), lambda: meniscus.surface([[0, 0, 0]], 1e9),
            lambda: meniscus.surface(m, probe=-1), lambda: meniscus.surface(m, probe=0), lambda: meniscus.surface(m, probe=1e9),
            lambda: meniscus.surface(m, probe=nan), lambda: meniscus.surface(m, kind="lee"), lambda: meniscus.surface(m, device="tpu"),
            lambda: meniscus.surface(m, threads=-1), lambda: s.mesh(9), lambda: s.mesh(0.05, density=1), lambda: s.mesh(density=1e9),
            lambda: s.mesh(0), lambda: s.pockets(0.5), lambda: s.pockets(1e9), lambda: s.pockets(trim=-1), lambda: s.pockets(mouth_tolerance=9),
            lambda: meniscus.surface(m, kind="vdw").pockets(), lambda: meniscus.surface(m, kind="sas").atom_sas_areas,
            lambda: meniscus.surface(m, kind="sas").gradient("sas_area"), lambda: s.gradient("mass"), lambda: s.gradient("area", [1]),
            lambda: s.gradient("volume", np.ones(64)), lambda: s.gradient("sas_area", np.full(64, nan)), lambda: s.distance([[nan, 0, 0]]),
            lambda: s.distance([0, 0, 1e300]), lambda: s.distance(np.zeros((2, 2))), lambda: s.camera(-1), lambda: s.camera(1, "flat"),
            lambda: s.areas_by("atom"), lambda: meniscus.surface([[0, 0, 0]], 1).areas_by(), kinds=(ValueError,))
        self.provoke(
            lambda: mesh.save("x.xyz"), lambda: mesh.save("x"), lambda: mesh.save(io.BytesIO()), lambda: mesh.save("x.stl", format="step"),
            lambda: mesh.save("x.ply", attributes="mass"), lambda: mesh.save("x.ply", attributes="b_factor"), lambda: mesh.save("x.ply", scale=0),
            lambda: mesh.save("x.ply", colors=(2, 0, 0)), lambda: mesh.save("x.ply", colors="teaal"), lambda: mesh.save("x.ply", colors=(1, 1)),
            lambda: mesh.save("x.ply", colors=(1, 0, 0, 0.5)), lambda: mesh.attribute("mass"), lambda: mesh.attribute("all"),
            lambda: m.write("x.xyz"), lambda: m.split("atom"), lambda: m.colors("teaal"), lambda: m.colors("kind"), lambda: m.colors("charge"),
            lambda: m.select("chain Z"), lambda: m.select("chain ("), lambda: m.select("nme CA"), lambda: m.select("charge > 0"),
            lambda: meniscus.buried(m, "chain A", "resid 1-9"),
            lambda: m[:0].select("all"), lambda: m[:0].write("x.cif"), lambda: meniscus.Scene(m[:0]), lambda: meniscus.surface(m[:0]), kinds=(ValueError,))
        self.provoke(
            lambda: read("nothing.pdb"), lambda: read("odd.pdb"), lambda: read("water.pdb"), lambda: read("unknown.cif"), lambda: read(b"x\n"),
            lambda: read(b"ATOM\n" * 1000), lambda: read(io.BytesIO(b"")), lambda: read(io.StringIO("2\n\nC 0 0\n")), lambda: read("a\0b"),
            lambda: read("helix.pdb", select="chain Z"), lambda: read("helix.pdb", select="chain ("), lambda: read("helix.pdb", model=9),
            lambda: read("helix.pdb", model=0), lambda: read("helix.pdb", assembly=9), lambda: read("helix.cif", assembly=9),
            lambda: read("helix.gro", assembly=1), lambda: read("helix.pdb", altloc="both"), lambda: read("helix.pdb", radii="amber"),
            lambda: read("helix.pdb", radii="file"), lambda: read("helix.pdb", radius={"all": -1}), lambda: read("helix.pdb", radius=["all"]),
            lambda: read("helix.pdb", radii_files="none.txt"), lambda: read("helix.pdb", radii_files="odd.pdb"),
            lambda: read("helix.pdb", radii="martini2", hydrogens="x"), lambda: read("helix.pdb", unknown_element="x"),
            lambda: read("helix.pdb", select="radius > 1"), lambda: read("run.xtc"), lambda: read("top.psf"), kinds=(ValueError,))
        for file in ("run.xtc", "top.psf"):
            with self.assertRaisesRegex(meniscus.InputError, rf"{file}: .*meniscus.frames\(trajectory, topology=...\) reads"):
                read(file)
        self.provoke(
            lambda: scene().render("cpu"), lambda: scene("helix.pdb", size="80"), lambda: scene("helix.pdb", samples=0),
            lambda: scene("helix.pdb", preset="flatt"), lambda: scene("helix.pdb", color="teaal").render("cpu"),
            lambda: scene("helix.pdb", legend=True, color="red").render("cpu"), lambda: scene("helix.pdb", label="x").render("cpu"),
            lambda: scene("helix.pdb", sticks="resid 999").render("cpu"), lambda: scene("helix.pdb", sticks="("),
            lambda: scene("helix.pdb", trajectory="none.xtc").render("cpu"), lambda: scene("helix.gro", frames="1").render("cpu"),
            lambda: scene("helix.pdb", camera="none.json").render("cpu"), lambda: scene("helix.pdb", size="8x8", legend=True).render("cpu"),
            lambda: scene("helix.pdb", assembly="9").render("cpu"),
            lambda: scene("helix.pdb", object="x").show(),
            lambda: scene("helix.pdb", context="x"), lambda: scene.parse("{"), lambda: scene.read("scene.json"), lambda: scene.parse('{"a": 1}'),
            lambda: scene("helix.pdb", zoom_to="resid 999").render("cpu"),
            lambda: s.render(size="80", device="cpu"), lambda: s.render(view="top"), lambda: s.render(preset="ghost", device="cpu"),
            lambda: s.render(color="chain", device="cpu"),
            lambda: s.render(color="resid 5=red", device="cpu"), lambda: s.show(structure=m[:3]), kinds=(meniscus.Error,))
        structure = meniscus.Structure
        self.provoke(
            lambda: structure([[0, 0, 0]]), lambda: structure([0, 0, 0]), lambda: structure([[0, 0, 0]], ["C", "C"]), lambda: structure([[0, 0, 0]], ["Qq"]),
            lambda: structure([[0, 0, 0]], [999]), lambda: structure([[0, 0, 0]], names=["MW"], residue_names=["SOL"]),
            lambda: structure([[0, 0, 0]], ["C"], chains=["A", "B"]), lambda: structure([[0, 0, 0]], ["C"], radii=[1, 2]),
            lambda: structure([[0, 0, 0]], ["C"], radii="amber"), lambda: meniscus.radii_of(["Qq"]), lambda: meniscus.radii_of([999]),
            kinds=(ValueError,))

    def test_the_table_of_words_has_all_of_C(self):
        """Messages of the C interface that no call of the package provokes are read in its sources."""
        table = {}
        for path in sorted(SOURCES.glob("*.cpp")):
            for text in re.findall(r'refuse\(\s*MENISCUS_\w+,\s*((?:"[^"]*"\s*)+)', path.read_text()):
                table["".join(re.findall(r'"([^"]*)"', text))] = path.name
        self.assertGreater(len(table), 50)
        # The package itself checks pointers, structs and numbers of enumerations.
        own = re.compile(r"\{\}(\[\{\}\])? is NULL|not aligned|_stride|_type is|do not fit into memory|overlap|\.size is|asks for more|"
                         r"it has to be 0$|none of MENISCUS_|neither MENISCUS_|no table|no gradient|only for MENISCUS_MESH|MENISCUS_OPTIONS_INIT")
        left = [text for text in table if FOREIGN.search(_library.in_words_of_python(text)) and not own.search(text)]
        self.assertEqual(left, [])

    @classmethod
    def tearDownClass(cls):
        print(f"{len(cls.messages)} messages read, {len(set(cls.messages))} of them different")
        if "-v" in sys.argv:
            print("\n".join(sorted(set(cls.messages))))


if __name__ == "__main__":
    unittest.main()
