# SPDX-License-Identifier: BSD-3-Clause
"""adapters_test.py PACKAGE...: molecules and numbers of other packages go in, meshes come out, and surfaces go to other
processes. The packages named must be there, and only they are tried; without names those that are installed are."""
import importlib
import importlib.metadata
import multiprocessing
import os
import sys
import tempfile
import unittest
import warnings

if "MENISCUS_PACKAGE" in os.environ:
    sys.path.insert(0, os.environ["MENISCUS_PACKAGE"])

import numpy as np

import meniscus

ALL = ("MDAnalysis", "mdtraj", "prody", "biotite", "biopython", "ase", "rdkit", "openmm", "gemmi", "pint", "astropy",
       "unyt", "joblib", "dask", "trimesh", "pyvista", "open3d")
NAMED = sys.argv[1:]

# Atoms of two residues, in three models.
NAMES = (("N", "N"), ("CA", "C"), ("C", "C"), ("O", "O"), ("CB", "C"), ("SG", "S"))


def models():
    random = np.random.default_rng(5)
    first = np.round(np.cumsum(random.normal(0, 0.8, (12, 3)), axis=0), 3)
    return [np.round(first + 0.2 * n * random.normal(0, 1, (12, 3)), 3) for n in range(3)]


def pdb(frames):
    text = ""
    for m, xyz in enumerate(frames):
        text += f"MODEL     {m + 1:4d}\n"
        for n, (x, y, z) in enumerate(xyz):
            name, element = NAMES[n % 6]
            text += (f"ATOM  {n + 1:5d}  {name:<3s} CYS A{1 + n // 6:4d}    {x:8.3f}{y:8.3f}{z:8.3f}  1.00  0.00"
                     f"          {element:>2s}\n")
        text += "ENDMDL\n"
    return text + "END\n"


def one(xyz):
    """Computes a surface in another process."""
    s = meniscus.surface(xyz, 1.7, threads=1)
    return s, s.mesh(density=0.5)


def tried_with(name):
    """Decorates a test of one package: it runs when the package is named, or none is."""
    return lambda test: test if not NAMED or name in NAMED else None


def module(name):
    try:
        return importlib.import_module(name)
    except ImportError as error:
        if NAMED:
            raise
        raise unittest.SkipTest(f"{name} is not installed: {error}") from None


class Frames(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.frames = models()
        radii = meniscus.radii_of([element for _, element in NAMES] * 2)
        cls.areas = [meniscus.surface(xyz, radii, probe=1.3).area for xyz in cls.frames]
        cls.folder = tempfile.TemporaryDirectory()
        cls.file = os.path.join(cls.folder.name, "models.pdb")
        with open(cls.file, "w") as file:
            file.write(pdb(cls.frames))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def check(self, first, every, relative):
        self.assertAlmostEqual(first.area / self.areas[0], 1.0, delta=relative)
        found = [s.area for s in list(every)]  # Each surface keeps its frame.
        np.testing.assert_allclose(found, self.areas, rtol=relative)

    @tried_with("MDAnalysis")
    def test_mdanalysis(self):
        atoms = module("MDAnalysis").Universe(self.file).atoms
        self.check(meniscus.from_mdanalysis(atoms, probe=1.3), meniscus.frames(atoms, probe=1.3), 1e-5)  # MDAnalysis has floats.
        np.testing.assert_allclose(meniscus.series(atoms, probe=1.3)["area"], self.areas, rtol=1e-5)
        part = meniscus.from_mdanalysis(atoms[:6], probe=1.3)
        self.assertEqual(len(part), 6)

    @tried_with("mdtraj")
    def test_mdtraj(self):
        trajectory = module("mdtraj").load(self.file)
        self.check(meniscus.from_mdtraj(trajectory, probe=1.3), meniscus.frames(trajectory, probe=1.3), 1e-5)

    @tried_with("prody")
    def test_prody(self):
        prody = module("prody")
        prody.confProDy(verbosity="none")
        atoms = prody.parsePDB(self.file)
        self.check(meniscus.from_prody(atoms, probe=1.3), meniscus.frames(atoms, probe=1.3), 1e-12)
        self.assertEqual(len(meniscus.from_prody(atoms.select("resnum 1"))), 6)

    @tried_with("biotite")
    def test_biotite(self):
        module("biotite")
        pdb_io = importlib.import_module("biotite.structure.io.pdb")
        stack = pdb_io.PDBFile.read(self.file).get_structure()
        self.check(meniscus.from_biotite(stack, probe=1.3), meniscus.frames(stack, probe=1.3), 1e-5)
        self.assertAlmostEqual(meniscus.from_biotite(stack[1], probe=1.3).area / self.areas[1], 1.0, delta=1e-5)

    @tried_with("biopython")
    def test_biopython(self):
        structure = module("Bio.PDB").PDBParser(QUIET=True).get_structure("models", self.file)
        self.check(meniscus.from_biopython(structure, probe=1.3), meniscus.frames(structure, probe=1.3), 1e-6)  # Biopython has floats.
        self.assertAlmostEqual(meniscus.from_biopython(structure[1], probe=1.3).area / self.areas[1], 1, delta=1e-6)
        residue = next(structure.get_residues())
        self.assertEqual(len(meniscus.from_biopython(residue)), 6)
        self.assertEqual(len(meniscus.from_biopython(list(residue)[:4])), 4)
        with self.assertRaisesRegex(meniscus.InputError, r"a Bio.Structure has no atoms that from_biopython\(\) takes"):
            meniscus.from_biopython(type(structure)("empty"))

    @tried_with("ase")
    def test_ase(self):
        ase = module("ase")
        images = [ase.Atoms([element for _, element in NAMES] * 2, positions=xyz) for xyz in self.frames]
        self.check(meniscus.from_ase(images[0], probe=1.3), meniscus.frames(images, probe=1.3), 1e-12)
        images[1].symbols[3] = "N"
        with self.assertRaisesRegex(meniscus.InputError, "image 1 has other atoms"):
            list(meniscus.frames(images))
        s = meniscus.surface(images[0], 1.7)
        self.assertEqual(s.area, meniscus.surface(self.frames[0], 1.7).area)
        with self.assertRaisesRegex(meniscus.InputError, r"not an array; meniscus.from_ase\(\) takes it"):
            s.update(images[0])

    @tried_with("rdkit")
    def test_rdkit(self):
        chem = module("rdkit.Chem")
        molecule = chem.MolFromPDBFile(self.file, sanitize=False)
        self.assertEqual(molecule.GetNumConformers(), 3)
        self.check(meniscus.from_rdkit(molecule, probe=1.3), meniscus.frames(molecule, probe=1.3), 1e-12)
        self.assertAlmostEqual(meniscus.from_rdkit(molecule.GetConformer(1), probe=1.3).area / self.areas[1], 1, delta=1e-12)
        with self.assertRaisesRegex(meniscus.InputError, "a rdkit.Atom has no atoms"):
            meniscus.from_rdkit(molecule.GetAtomWithIdx(0))
        flat = chem.MolFromSmiles("CCO")
        with self.assertRaisesRegex(meniscus.InputError, "no conformer; .*EmbedMolecule"):
            meniscus.from_rdkit(flat)
        module("rdkit.Chem.AllChem").Compute2DCoords(flat)
        with self.assertRaisesRegex(meniscus.InputError, "conformer 0 is a drawing"):
            meniscus.from_rdkit(flat)

    @tried_with("openmm")
    def test_openmm(self):
        app, unit = module("openmm.app"), module("openmm.unit")
        file = app.PDBFile(self.file)
        self.check(meniscus.from_openmm(file, probe=1.3), meniscus.frames(file, probe=1.3), 1e-9)
        modeller = app.Modeller(file.topology, file.getPositions(frame=1))
        self.assertAlmostEqual(meniscus.from_openmm(modeller, probe=1.3).area / self.areas[1], 1, delta=1e-9)
        positions = file.getPositions(asNumpy=True, frame=2)
        self.assertAlmostEqual(meniscus.from_openmm(file.topology, positions, probe=1.3).area / self.areas[2], 1, delta=1e-9)
        with self.assertRaisesRegex(meniscus.InputError, "the positions have no unit"):
            meniscus.from_openmm(file.topology, positions.value_in_unit(unit.nanometer))
        with self.assertRaisesRegex(meniscus.InputError, "no atoms that from_openmm"):
            meniscus.from_openmm(file.topology)
        openmm = module("openmm")
        system = openmm.System()
        for _ in range(12):
            system.addParticle(12.0)
        simulation = app.Simulation(file.topology, system, openmm.VerletIntegrator(0.001),
                                    openmm.Platform.getPlatformByName("Reference"))
        simulation.context.setPositions(file.positions)
        self.assertAlmostEqual(meniscus.from_openmm(simulation, probe=1.3).area / self.areas[0], 1, delta=1e-9)

    @tried_with("gemmi")
    def test_gemmi(self):
        structure = module("gemmi").read_structure(self.file)
        self.check(meniscus.from_gemmi(structure, probe=1.3), meniscus.frames(structure, probe=1.3), 1e-12)
        self.assertAlmostEqual(meniscus.from_gemmi(structure[1], probe=1.3).area / self.areas[1], 1, delta=1e-12)
        self.assertEqual(len(meniscus.from_gemmi(structure[0][0][0])), 6)
        structure[0][0][0][5].altloc, structure[0][0][1][5].altloc = "A", "B"
        with self.assertWarnsRegex(UserWarning, "alternate locations A, B all count"):
            meniscus.from_gemmi(structure)

    def test_alternate_locations_are_warned_of_here(self):
        class Atoms:
            __module__ = "MDAnalysis.fake"
            positions, elements, altLocs = np.zeros((2, 3)), ["C", "C"], ["", "A"]
        Atoms.atoms = Atoms
        Atoms.positions = np.array([[0, 0, 0], [3, 0, 0]])
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            meniscus.from_mdanalysis(Atoms())
        Atoms.altLocs = ["B", "A"]
        with self.assertWarnsRegex(UserWarning, "alternate locations A, B all count") as caught:
            meniscus.from_mdanalysis(Atoms())
        self.assertEqual(caught.filename, __file__)

    def test_what_a_function_does_not_take_is_named(self):
        for function in (meniscus.from_mdtraj, meniscus.from_biopython, meniscus.from_gemmi):
            with self.assertRaisesRegex(meniscus.InputError, rf"{function.__name__}\(\) does not take a builtins.dict"):
                function({})

    def test_atoms_without_elements_need_radii(self):
        class Atoms:
            __module__ = "prody.fake"
            def getElements(self): return None
            def getCoords(self): return np.zeros((1, 3))
        with self.assertRaisesRegex(meniscus.InputError, "no element; give radii"):
            meniscus.from_prody(Atoms())
        self.assertAlmostEqual(meniscus.from_prody(Atoms(), radii=1.0).area, 4 * np.pi)
        Atoms.getCoords = lambda self: None
        with self.assertRaisesRegex(meniscus.InputError, "the atoms have no positions"):
            meniscus.from_prody(Atoms())

    def test_series(self):
        random = np.random.default_rng(1)
        turns, heights = 2.399963 * np.arange(60), 1 - (2 * np.arange(60) + 1) / 60  # a cage that no probe leaves
        flat = np.sqrt(1 - heights**2)
        cage = 4.2 * np.stack([flat * np.cos(turns), flat * np.sin(turns), heights], axis=1)

        class Atoms:
            __module__ = "prody.fake"
            def getElements(self): return ["C"] * 60
            def iterCoordsets(self): return iter([cage, 0.69 * cage, cage + 1e-3 * random.normal(size=cage.shape)])
        rows = meniscus.series(Atoms())
        self.assertEqual(rows["cavities"].tolist(), [1, 0, 1])
        for row, xyz in zip(rows[:2], [cage, 0.69 * cage]):
            s = meniscus.surface(xyz, 1.7)
            self.assertEqual((row["area"], row["volume"]), (s.area, s.volume))
            self.assertAlmostEqual(row["sas_area"], s.atom_sas_areas.sum(), 9)
            self.assertEqual(row["cavity_volume"], -s.components["volume"][1:].sum())
        self.assertNotIn("sas_area", meniscus.series(Atoms(), kind="vdw").dtype.names)

    def test_what_is_no_source_is_named(self):
        with self.assertRaisesRegex(meniscus.InputError, "a builtins.dict has no frames that can be read"):
            meniscus.frames({})


class Units(unittest.TestCase):
    """Values with a unit are converted; positions in nm without one give a warning."""

    @classmethod
    def setUpClass(cls):
        cls.xyz = models()[0]
        cls.radii = meniscus.radii_of([element for _, element in NAMES] * 2)
        cls.surface = meniscus.surface(cls.xyz, cls.radii, probe=1.3)

    def same(self, xyz, radii, probe=1.3, points=None):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            s = meniscus.surface(xyz, radii, probe=probe)
        self.assertAlmostEqual(s.area / self.surface.area, 1, delta=1e-9)
        self.assertAlmostEqual(s.update(xyz, radii).area / self.surface.area, 1, delta=1e-9)
        if points is not None:
            np.testing.assert_allclose(s.distance(points), self.surface.distance(self.xyz), atol=1e-9)

    def looks_like_nanometres(self, xyz):
        with self.assertWarnsRegex(UserWarning, "look like nanometres"):
            return meniscus.surface(xyz, self.radii)

    def test_plain_numbers_in_nanometres(self):
        self.looks_like_nanometres(self.xyz / 10)
        with self.assertWarnsRegex(UserWarning, "look like nanometres"):
            meniscus.surface(self.xyz, self.radii).update(self.xyz / 10)

    @tried_with("mdtraj")
    def test_mdtraj(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "models.pdb")
            with open(file, "w") as out:
                out.write(pdb(models()))
            trajectory = module("mdtraj").load(file)
        self.looks_like_nanometres(trajectory.xyz[0])
        self.assertAlmostEqual(meniscus.surface(trajectory, self.radii, 1.3).area / self.surface.area, 1, delta=1e-5)
        with self.assertRaisesRegex(meniscus.InputError, r"not an array; meniscus.from_mdtraj\(\) takes it"):
            self.surface.update(trajectory)

    @tried_with("MDAnalysis")
    def test_mdanalysis(self):
        module("MDAnalysis")
        class Atoms:
            __module__ = "MDAnalysis.fake"
            def __len__(self): return 12
        with self.assertRaisesRegex(meniscus.InputError, r"no atoms that from_mdanalysis\(\) takes"):
            meniscus.surface(Atoms(), self.radii)
        with self.assertRaisesRegex(meniscus.InputError, r"meniscus.from_mdanalysis\(\) takes it"):
            self.surface.update(Atoms())

    @tried_with("ase")
    def test_ase(self):
        atoms = module("ase").Atoms("NCCOCS" * 2, positions=self.xyz)
        self.same(atoms.get_positions(), self.radii)
        self.same(atoms.positions, meniscus.radii_of(atoms.get_atomic_numbers()))

    @tried_with("openmm")
    def test_openmm(self):
        module("openmm")
        unit, vec3 = importlib.import_module("openmm.unit"), importlib.import_module("openmm").Vec3
        nm = self.xyz / 10
        as_array = unit.Quantity(nm, unit.nanometer)
        self.same(as_array, self.radii, points=as_array)
        self.same(unit.Quantity([vec3(*row) for row in nm], unit.nanometer), self.radii / 10 * unit.nanometer)
        self.same([vec3(*row) * unit.nanometer for row in nm], self.radii, probe=0.13 * unit.nanometer)
        with self.assertRaisesRegex(meniscus.InputError, "xyz is in kelvin, not in a unit of Å"):
            meniscus.surface(self.xyz * unit.kelvin, self.radii)
        with self.assertRaisesRegex(meniscus.InputError, "weights is in angstrom; give numbers without a unit"):
            self.surface.gradient("sas_area", np.ones(12) * unit.angstrom)

    @tried_with("pint")
    def test_pint(self):
        units = module("pint").UnitRegistry()
        nm = units.Quantity(self.xyz / 10, "nm")
        self.same(nm, units.Quantity(self.radii * 100, "pm"), units.Quantity(0.13, "nm"), nm)
        with self.assertRaisesRegex(meniscus.InputError, "xyz is in second"):
            meniscus.surface(units.Quantity(self.xyz, "s"), self.radii)

    @tried_with("astropy")
    def test_astropy(self):
        module("astropy")
        units = importlib.import_module("astropy.units")
        nm = self.xyz / 10 * units.nm
        self.same(nm, self.radii / 10 * units.nm, 0.13 * units.nm, nm)
        with self.assertRaisesRegex(meniscus.InputError, "xyz is in K"):
            meniscus.surface(self.xyz * units.K, self.radii)

    @tried_with("unyt")
    def test_unyt(self):
        unyt = module("unyt")
        nm = unyt.unyt_array(self.xyz / 10, "nm")
        self.same(nm, unyt.unyt_array(self.radii / 10, "nm"), unyt.unyt_quantity(0.13, "nm"), nm)
        with self.assertRaisesRegex(meniscus.InputError, "xyz is in s"):
            meniscus.surface(unyt.unyt_array(self.xyz, "s"), self.radii)


class Processes(unittest.TestCase):
    """Surfaces come back unchanged from workers."""

    def check(self, came_back):
        surfaces, meshes = zip(*came_back)
        self.assertEqual([s.area for s in surfaces], [one(xyz)[0].area for xyz in models()])
        for s, mesh in zip(surfaces, meshes):
            np.testing.assert_array_equal(mesh.vertices, s.mesh(density=0.5).vertices)

    def test_multiprocessing(self):
        for start in ("fork", "spawn"):
            with multiprocessing.get_context(start).Pool(2) as pool:
                self.check(pool.map(one, models()))

    @tried_with("joblib")
    def test_joblib(self):
        joblib = module("joblib")
        self.check(joblib.Parallel(2)(joblib.delayed(one)(xyz) for xyz in models()))

    @tried_with("dask")
    def test_dask(self):
        dask = module("dask")
        self.check(dask.compute(*[dask.delayed(one)(xyz) for xyz in models()], scheduler="processes"))


class Meshes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.surface = meniscus.surface(models()[0], 1.7)
        cls.mesh = cls.surface.mesh(0.05)

    @tried_with("trimesh")
    def test_trimesh(self):
        module("trimesh")
        mesh = self.mesh.to_trimesh()
        self.assertTrue(mesh.is_watertight)
        self.assertAlmostEqual(mesh.area / self.surface.area, 1.0, delta=0.02)
        self.assertAlmostEqual(mesh.volume / self.surface.volume, 1.0, delta=0.02)
        self.assertEqual(len(mesh.face_attributes["atom"]), len(mesh.faces))

    @tried_with("pyvista")
    def test_pyvista(self):
        module("pyvista")
        mesh = self.mesh.to_pyvista()
        self.assertEqual(mesh.n_points, len(self.mesh.vertices))
        self.assertEqual(mesh.n_open_edges, 0)
        self.assertAlmostEqual(mesh.area / self.surface.area, 1.0, delta=0.02)
        self.assertEqual(len(mesh.cell_data["atom"]), mesh.n_cells)

    @tried_with("open3d")
    def test_open3d(self):
        module("open3d")
        mesh = self.mesh.to_open3d()
        self.assertTrue(mesh.is_watertight())
        self.assertAlmostEqual(mesh.get_surface_area() / self.surface.area, 1.0, delta=0.02)
        self.assertEqual(len(mesh.vertex_normals), len(self.mesh.vertices))


if __name__ == "__main__":
    result = unittest.main(argv=["adapters_test"], exit=False, verbosity=2).result
    for name in ALL:
        try:
            print(name, importlib.metadata.version(name))
        except importlib.metadata.PackageNotFoundError:
            pass
    failed = len(result.failures) + len(result.errors)
    print(f"cases {result.testsRun - len(result.skipped)} failures {failed}")
    sys.exit(1 if failed else 0)
