# SPDX-License-Identifier: BSD-3-Clause
"""Molecules of arrays and their parts, tables, files, scenes and buried areas; Ctrl-C. Environment as of package_test.py."""
import copy
import io
import os
import pathlib
import pickle
import subprocess
import sys
import tempfile
import unittest
import warnings

if "MENISCUS_PACKAGE" in os.environ:
    sys.path.insert(0, os.environ["MENISCUS_PACKAGE"])

import numpy as np

import meniscus
from structure_test import PROGRAM, atoms, pdb

LIGAND = "HETATM   66  C1  LIG L   1      20.000   0.000   0.000  1.00 10.00           C\n" \
         "HETATM   67  O1  LIG L   1      21.300   0.000   0.000  1.00 10.00           O\n"


class Case(unittest.TestCase):
    def setUp(self):
        folder, before = tempfile.TemporaryDirectory(), os.getcwd()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, before)
        os.chdir(folder.name)
        pathlib.Path("helix.pdb").write_text(pdb(atoms()).replace("END", LIGAND + "END"))
        self.all = meniscus.read("helix.pdb", select="all", keep_water=True)
        self.molecule = meniscus.read("helix.pdb")

    def same(self, a, b, *names):
        for name in names or ("positions", "radii", "elements", "names", "residue_names", "residue_numbers", "chains", "classes",
                              "b_factors", "occupancies", "models"):
            np.testing.assert_array_equal(getattr(a, name), getattr(b, name), name)


class Parts(Case):
    def test_masks_slices_and_indices(self):
        m = self.molecule
        carbon = m[m.elements == "C"]
        self.assertEqual((len(carbon), set(carbon.elements.tolist())), (32, {"C"}))
        self.same(m[8:16], m[list(range(8, 16))])
        self.same(m[::-1][:4], m[[63, 62, 61, 60]])
        self.same(m[m.chains == "B"][2:], m[34:])
        self.assertEqual(m[m.chains == "B"].indices[0], 32)
        self.assertEqual(len(m[[]]), 0)
        self.assertFalse(carbon.positions.flags.writeable)
        again = pickle.loads(pickle.dumps(carbon))
        self.same(again, carbon)
        self.assertIs(copy.copy(carbon), carbon)
        self.assertEqual(meniscus.surface(carbon).area, meniscus.surface(carbon.positions, carbon.radii).area)
        np.testing.assert_array_equal(carbon.colors("residue"), m.colors("residue")[m.elements == "C"])
        np.testing.assert_array_equal(again.colors("red"), carbon.colors("red"))
        self.assertIn("nan" if np.isnan(carbon.hydropathies).any() else "1.8", str(carbon.hydropathies[0]))

    def test_atoms_residues_and_chains(self):
        m = self.molecule
        self.assertEqual(m[5], list(m)[5])
        self.assertEqual(m[-1].row, 63)
        self.assertEqual([atom.name for atom in m], m.names.tolist())
        residues, chains = m.split("residue"), m.split("chain")
        self.assertEqual([len(residue) for residue in residues], [4] * 16)
        self.assertEqual([chain.chains[0] for chain in chains], ["A", "B"])
        self.assertEqual(sum(meniscus.surface(m).areas_by("chain")["atoms"]), 64)

    def test_selections_are_those_of_read(self):
        for selection in ("chain B", "resid 3-5 and name CA", "protein", "ligand", "water", "not chain A", "within 4 of resid 1",
                          "bfactor > 30", "element C", "index 3 to 9", "backbone", "name CA and not (resid 2-4 or chain B)"):
            with self.subTest(selection):
                self.same(self.all.select(selection), meniscus.read("helix.pdb", select=selection, keep_water="not" in selection
                                                                    or "index" in selection or "within" in selection))
        part = self.all[self.all.chains == "B"].select("name CA")
        self.assertEqual(part.residue_numbers.tolist(), list(range(9, 17)))
        self.assertEqual(part.select("resid 9 12").indices.tolist(), [33, 45])

    def test_partial_charges_and_segments_stay(self):
        m = meniscus.Structure([[0, 0, 0], [3, 0, 0], [6, 0, 0]], ["C", "O", "N"], charges=[0.5, -0.25, np.nan], segments=["PROA", "", "PROB"])
        self.assertEqual(m.select("charge > 0").segments.tolist(), ["PROA"])
        self.assertEqual(m.split("residue")[1].charges.tolist(), [-0.25])
        self.assertEqual(len(set(map(tuple, m.colors("charge").tolist()))), 3)
        m.write("charged.cif")
        read = meniscus.read("charged.cif", select="all")
        np.testing.assert_array_equal(read.charges, m.charges)
        self.assertEqual(read.segments.tolist(), m.segments.tolist())
        m[2:].write("plain.cif")
        self.assertNotIn("_atom_site.charge", pathlib.Path("plain.cif").read_text())

    def test_elements_and_numbers_are_not_mixed_up(self):
        m = self.molecule
        with self.assertWarnsRegex(DeprecationWarning, "compare atomic_numbers"):
            np.testing.assert_array_equal(m.elements == 6, m.atomic_numbers == 6)
        with self.assertWarnsRegex(DeprecationWarning, "compare atomic_numbers"):
            np.testing.assert_array_equal(m.elements != 6, m.elements != "C")
        for wrong in (lambda: m.residue_numbers == "48", lambda: m.names == 3, lambda: "48" == m.residue_numbers,
                      lambda: m.chains != 1.5, lambda: m.elements == 6.5, lambda: m.atomic_numbers == "C",
                      lambda: m[:3].altlocs == 1, lambda: m.classes == 2):
            self.assertRaisesRegex(TypeError, "is compared with", wrong)
        self.assertEqual((m.residue_numbers == 5).sum(), 4)
        self.assertEqual(np.isin(m.elements, ["C", "N"]).sum(), 48)
        for plain in (np.add(m.residue_numbers, 1), pickle.loads(pickle.dumps(m.residue_numbers))):
            self.assertEqual(type(plain), np.ndarray)
        for number, symbol in enumerate(meniscus._columns.SYMBOLS[1:], 1):
            self.assertEqual(meniscus.radii_of([str(symbol)])[0], meniscus.radii_of([number])[0])
            self.assertEqual(meniscus._columns.atomic_numbers([symbol])[0], number)


class Arrays(Case):
    def test_arrays_give_what_the_file_gives(self):
        m = self.all
        names = ("names", "residue_names", "residue_numbers", "chains", "b_factors", "occupancies")
        made = meniscus.Structure(m.positions, m.elements, **{name: getattr(m, name) for name in names})
        self.same(made, m, "positions", "radii", "elements", *names, "residues", "models", "hydropathies")
        self.assertEqual(made.classes[0], "polymer")
        self.assertEqual(set(made.select("water").names.tolist()), {"O"})
        self.assertEqual(meniscus.surface(made).area, meniscus.surface(m).area)
        self.same(meniscus.Structure(m.positions, m.atomic_numbers), m, "radii", "elements")
        bare = meniscus.Structure([[0, 0, 0], [3, 0, 0]], ["C", "O"], name="two")
        self.assertEqual((set(bare.classes), bare.file, repr(bare)), ({"unclassified"}, "two", "<meniscus.Structure: 2 atoms of two>"))

    def test_elements_are_guessed_from_names(self):
        m = self.all
        made = meniscus.Structure(m.positions, names=m.names, residue_names=m.residue_names, residue_numbers=m.residue_numbers)
        self.same(made, m, "elements", "radii")
        self.assertRegex(made.warnings[0], "67 atoms have no element symbol; elements were guessed")
        some = meniscus.Structure(m.positions, ["S", *[""] * 66], names=m.names, residue_names=m.residue_names)
        self.assertEqual(some.elements[:3].tolist(), ["S", "C", "C"])
        sites = meniscus.Structure([[0, 0, 0], [3, 0, 0]], names=["OW", "MW"], residue_names="SOL", residue_numbers=1, radii=1.5)
        self.assertEqual(pickle.loads(pickle.dumps(meniscus.surface(sites))).structure.classes.tolist(), ["water", "unclassified"])
        with self.assertRaisesRegex(meniscus.InputError, "1 of 2 atoms are virtual sites"):
            sites.colors("element")
        with self.assertRaisesRegex(meniscus.InputError, "1 of 2 atoms have no element.*'MW' in SOL 1"):
            meniscus.Structure([[0, 0, 0], [3, 0, 0]], names=["OW", "MW"], residue_names="SOL", residue_numbers=1)

    def test_radii(self):
        xyz, elements = [[0, 0, 0], [3, 0, 0]], ["C", "O"]
        for radii, expected in ((None, [1.7, 1.52]), (1.5, [1.5, 1.5]), ({"O": 1.4}, [1.7, 1.4]), ("bondi", [1.7, 1.52])):
            self.assertEqual(meniscus.Structure(xyz, elements, radii=radii).radii.tolist(), expected)
        m = self.molecule
        made = meniscus.Structure(m.positions, m.elements, names=m.names, residue_names=m.residue_names, chains=m.chains,
                                  residue_numbers=m.residue_numbers, radii="protor")
        np.testing.assert_array_equal(made.radii, meniscus.read("helix.pdb", radii="protor").radii)

    def test_files_objects_and_bytes(self):
        content = pathlib.Path("helix.pdb").read_bytes()
        for source in (io.BytesIO(content), io.StringIO(content.decode()), content):
            self.same(meniscus.read(source), self.molecule)
        with open("helix.pdb", "rb") as file:
            self.assertEqual(meniscus.read(file).file, "helix.pdb")
        self.assertEqual([s.area for s in meniscus.frames(content)], [s.area for s in meniscus.frames("helix.pdb")])

    def test_models_are_frames(self):
        rows = atoms()
        models = [rows, [(*row[:5], 1.1 * row[5]) for row in rows], rows[:40]]
        pathlib.Path("models.pdb").write_text("".join(
            f"MODEL     {n}\n{pdb(model, water=False).replace('END', 'ENDMDL')}" for n, model in enumerate(models, 1)))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            expected = [meniscus.surface(meniscus.read("models.pdb", model=n)).area for n in (1, 2, 3)]
        found = list(meniscus.frames("models.pdb"))
        self.assertEqual(([s.area for s in found], [len(s.structure) for s in found]), (expected, [64, 64, 40]))
        np.testing.assert_array_equal(meniscus.series("models.pdb")["area"], expected)
        np.testing.assert_allclose(found[1].structure.positions, [row[5] for row in models[1]], atol=5.1e-4)

    def test_written_files_are_read_back(self):
        self.all.write("a.cif")
        back = meniscus.read("a.cif", select="all", keep_water=True)
        self.same(back, self.all)
        odd = meniscus.Structure([[1 / 3, 0, 0], [3, 1e-7, 0], [6, 0, 0]], ["C", "O", "N"], names=["C1'", 'O5" x', "_N 1"],
                                 residue_names="data_x", chains=["A", "", "#"], residue_numbers=[-5, 7, 7], altlocs=["", "A", "B"])
        odd.write("odd.cif")
        back = meniscus.read("odd.cif", select="all", altloc="all")
        self.same(back, odd, "positions", "elements", "residue_names", "chains", "residue_numbers", "altlocs")
        self.assertEqual(back.names.tolist(), ["C1'", 'O5" x', "_N 1"])
        text = io.BytesIO()
        self.molecule[:4].write(text, format="cif")
        self.assertIn(b"_atom_site.Cartn_x", text.getvalue())


class Tables(Case):
    def test_areas_by_residue_and_chain(self):
        s = meniscus.surface(self.molecule)
        for by, count in (("residue", 16), ("chain", 2), ("model", 1)):
            rows = s.areas_by(by)
            self.assertEqual(len(rows), count)
            self.assertAlmostEqual(rows["area"].sum(), s.area, 9)
            self.assertAlmostEqual(rows["sas_area"].sum(), s.atom_sas_areas.sum(), 9)
        self.assertEqual(s.areas_by()["residue_number"].tolist(), list(range(1, 17)))
        self.assertNotIn("sas_area", meniscus.surface(self.molecule, kind="vdw").areas_by("chain").dtype.names)
        s.update(self.molecule.positions + 1.0)
        np.testing.assert_array_equal(s.structure.positions, self.molecule.positions + 1.0)
        self.same(pickle.loads(pickle.dumps(s)).structure, s.structure)

    @unittest.skipUnless(PROGRAM, "MENISCUS_PROGRAM is not set")
    def test_buried_areas_are_those_of_the_program(self):
        buried = meniscus.buried(self.molecule, "chain A", self.molecule.chains == "B")
        subprocess.run([PROGRAM, "surface", "helix.pdb", "--select", "chain A", "--context", "chain B", "--csv-residues", "r.csv", "-q",
                        "--device", "cpu"], check=True, capture_output=True)
        rows = np.genfromtxt("r.csv", delimiter=",", names=True, dtype=None, encoding=None)
        self.assertAlmostEqual(buried.areas[~buried.in_second].sum(), rows["sas_area_buried"].sum(), delta=1e-5)
        self.assertAlmostEqual(buried.total, buried.areas.sum())
        self.assertEqual(set(buried.interface.chains.tolist()), {"A", "B"})

    def test_data_frames(self):
        try:
            import pandas
        except ImportError:
            with self.assertRaisesRegex(ImportError, "pip install pandas"):
                self.molecule.to_dataframe()
            return
        frame = self.molecule.to_dataframe()
        self.assertIsInstance(frame, pandas.DataFrame)
        self.assertEqual(frame.groupby("chain").size().tolist(), [32, 32])
        areas = meniscus.surface(self.molecule).to_dataframe()
        self.assertAlmostEqual(areas["area"].sum(), meniscus.surface(self.molecule).area)
        self.assertEqual(len(meniscus.surface(self.molecule).to_dataframe("residue")), 16)


class Scenes(Case):
    def test_of_structures_are_those_of_files(self):
        values = dict(size=(96, 72), color="chain-element", sticks="resid 3", samples=4)
        expected = meniscus.Scene("helix.pdb", select="polymer", **values).render("cpu").pixels
        scene = meniscus.Scene(self.molecule, **values)
        for one in (scene, pickle.loads(pickle.dumps(scene)), copy.copy(scene)):
            np.testing.assert_array_equal(one.render("cpu").pixels, expected)
        own = meniscus.Structure(self.molecule.positions, self.molecule.elements, radii=2.5)
        self.assertEqual(meniscus.Scene(own).radius[0].split("=")[1], "2.5")
        folder, packed = os.path.dirname(scene.file), pickle.dumps(scene)
        self.assertTrue(os.path.isdir(folder))
        del scene, one
        self.assertFalse(os.path.isdir(folder))
        np.testing.assert_array_equal(pickle.loads(packed).render("cpu").pixels, expected)
        np.testing.assert_array_equal(meniscus.Scene(self.all, size=(64, 48)).render("cpu").pixels, meniscus.Scene(
            "helix.pdb", size=(64, 48), select="all", keep_water=True).render("cpu").pixels)

    def test_are_mappings_of_what_is_set(self):
        scene = meniscus.Scene("a.pdb", depth_cue=0.5, light=(1, 2, 3), label=["resid 1=one"])
        self.assertEqual(dict(scene), {"file": "a.pdb", "depth_cue": 0.5, "light": "1,2,3", "label": ["resid 1=one"]})
        self.assertTrue("depth_cue" in scene and "look.depth_cue" in scene and "color" not in scene and "zz" not in scene)
        del scene["depth_cue"]
        self.assertEqual((scene.get("depth_cue", 7), len(scene)), (7, 3))
        self.assertTrue(meniscus.Scene() and meniscus.Scene() != meniscus.Scene() and {scene: 1})
        self.assertEqual(meniscus.Scene(**dict(scene)).json(), scene.json())


class Results(Case):
    def test_pictures(self):
        s = meniscus.surface(self.molecule)
        picture = s.render(size=(32, 24), device="cpu", colors="teal")
        picture.save("a.png")
        file = io.BytesIO()
        picture.save(file)
        self.assertEqual(pathlib.Path("a.png").read_bytes(), file.getvalue())
        self.assertEqual(picture.__array_interface__["shape"], (24, 32, 4))
        red = s.render(size=(32, 24), device="cpu", colors=(1, 0, 0)).pixels
        for colors in ("red", "#ff0000", (1, 0, 0, 1), ["red"] * 64, np.tile([1.0, 0, 0, 1], (64, 1))):
            np.testing.assert_array_equal(s.render(size="32x24", device="cpu", colors=colors).pixels, red)

    def test_meshes(self):
        s = meniscus.surface([[0, 0, 0], [20, 0, 0]], [1.5, 2.0])
        mesh = s.mesh(0.2)
        curvature = mesh.attribute("mean_curvature")
        np.testing.assert_allclose(curvature, 1 / np.array([1.5, 2.0])[mesh.vertex_atoms], rtol=1e-6)
        np.testing.assert_allclose(mesh.attribute("gaussian_curvature"), curvature**2, rtol=1e-5)
        for ending in ("stl", "ply", "glb"):
            file = io.BytesIO()
            mesh.save(file, format=ending)
            mesh.save("a." + ending)
            self.assertEqual(pathlib.Path("a." + ending).read_bytes(), file.getvalue())

    def test_one_point(self):
        s = meniscus.surface([[0, 0, 0]], 2.0)
        self.assertEqual((s.distance([5, 0, 0]), s.distance([5, 0, 0]).shape), (3.0, ()))
        distance, foot = s.distance(np.array([5.0, 0, 0]), nearest=True)
        self.assertEqual((float(distance), foot.tolist()), (3.0, [2.0, 0.0, 0.0]))

    def test_short_texts(self):
        s = meniscus.surface(self.molecule)
        for thing in (s, s.patches, s.mesh(0.5), s.pockets(), self.molecule, self.molecule[:3], s.structure):
            self.assertLess(len(repr(thing)), 220)
        self.assertIn("1 component>", repr(s))

    def test_warnings_are_of_the_line_that_called(self):
        class Atoms:
            __module__ = "prody.fake"
            def getElements(self): return None
            def getNames(self): return ["CA", "CB"]
            def getResnames(self): return ["ALA", "ALA"]
            def getCoords(self): return np.array([[0.0, 0, 0], [3, 0, 0]])
            def iterCoordsets(self): return iter([self.getCoords()] * 2)
        pathlib.Path("odd.pdb").write_text(pdb(atoms(4)).replace("           C", ""))
        for call in (lambda: meniscus.surface(Atoms()), lambda: meniscus.from_prody(Atoms()), lambda: list(meniscus.frames(Atoms())),
                     lambda: meniscus.series(Atoms()), lambda: meniscus.Scene(Atoms()), lambda: meniscus.read("odd.pdb"),
                     lambda: list(meniscus.frames("odd.pdb")), lambda: meniscus.surface([[0, 0, 0], [0.1, 0, 0]], 1.0)):
            with self.assertWarnsRegex(UserWarning, "no element (symbol|column)|nanometres") as caught:
                call()
            self.assertEqual(caught.filename, __file__)

    def test_the_from_functions_return_structures_softly(self):
        class Atoms:
            __module__ = "prody.fake"
            def getElements(self): return ["C", "O"]
            def getCoords(self): return np.array([[0.0, 0, 0], [3, 0, 0]])
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            structure = meniscus.from_prody(Atoms())
            s = meniscus.surface(Atoms(), probe=1.2)
        self.assertIsInstance(structure, meniscus.Structure)
        with self.assertWarnsRegex(DeprecationWarning, r"area is of meniscus.surface\(structure\)"):
            self.assertEqual(structure.area, meniscus.surface(structure).area)
        with self.assertWarnsRegex(FutureWarning, r"probe belongs to meniscus.surface\(\)"):
            structure = meniscus.from_prody(Atoms(), probe=1.2)
        with self.assertWarns(DeprecationWarning):
            self.assertEqual(structure.area, s.area)
        with self.assertRaises(AttributeError):
            structure.mass


class Elsewhere(Case):
    def test_a_long_call_is_interrupted(self):
        code = (f"import sys; sys.path[:0] = {sys.path!r}\nimport meniscus, numpy as np, os, signal, threading, time\n"
                "xyz = np.random.default_rng(1).uniform(0, 120, (160000, 3))\nmeniscus.surface(xyz[:9], 1.6)\n"
                "def interrupt():\n    global sent\n    time.sleep(0.2)\n    sent = time.perf_counter()\n    os.kill(os.getpid(), signal.SIGINT)\n"
                "threading.Thread(target=interrupt).start()\n"
                "try:\n    meniscus.surface(xyz, 1.6, threads=1)\nexcept KeyboardInterrupt:\n    waited = time.perf_counter() - sent\n"
                "del xyz\nprint(waited, meniscus.surface([[0, 0, 0]], 1.0).area)\n")
        run = subprocess.run([sys.executable, "-c", code], text=True, capture_output=True, timeout=120)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        drawn = code.replace("meniscus.surface(xyz, 1.6, threads=1)", "meniscus.surface(xyz, 1.6).render(device='cpu')")
        ended = subprocess.run([sys.executable, "-c", drawn[:drawn.index("del xyz")]], text=True, capture_output=True, timeout=120)
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))
        waited, area = map(float, run.stdout.split())
        self.assertLess(waited, 0.2)
        self.assertAlmostEqual(area, 4 * np.pi)

    @unittest.skipUnless(PROGRAM and os.name == "posix", "MENISCUS_PROGRAM is not set")
    def test_the_module_runs_the_program(self):
        path = os.pathsep.join([os.path.dirname(PROGRAM), os.environ["PATH"]])
        environment = {**os.environ, "PATH": path, "PYTHONPATH": os.pathsep.join(sys.path)}
        run = subprocess.run([sys.executable, "-m", "meniscus", "--version"], env=environment, text=True, capture_output=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn(meniscus.version(), run.stdout)


if __name__ == "__main__":
    unittest.main()
