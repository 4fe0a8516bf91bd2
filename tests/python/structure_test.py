# SPDX-License-Identifier: BSD-3-Clause
"""Molecules from files in the Python package: the program's numbers to the last digit in every format, what is known of
atoms, and errors in the words of Python. Environment as of package_test.py."""
import copy
import gzip
import json
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

PROGRAM = os.environ.get("MENISCUS_PROGRAM")


def atoms(count=64):
    """Returns residues of four atoms along a helix: name, element, residue name, chain, residue number, position."""
    rows = []
    for n in range(count):
        name, element = (("N", "N"), ("CA", "C"), ("C", "C"), ("O", "O"))[n % 4]
        turn = 0.9 * n
        xyz = np.round([3.1 * np.cos(turn), 3.1 * np.sin(turn), 0.55 * n], 3)
        rows.append((name, element, "ALA" if n % 8 < 4 else "SER", "AB"[n * 2 // count], n // 4 + 1, xyz))
    return rows


def pdb(rows, water=True):
    lines = [f"ATOM  {n + 1:5}  {name:<3} {residue} {chain}{number:4}    {x:8.3f}{y:8.3f}{z:8.3f}  1.00{n % 50:6.2f}"
             f"          {element:>2}" for n, (name, element, residue, chain, number, (x, y, z)) in enumerate(rows)]
    if water:
        lines.append(f"HETATM{len(rows) + 1:5}  O   HOH A 900    {40.0:8.3f}{0.0:8.3f}{0.0:8.3f}  1.00 20.00           O")
    return "\n".join(lines) + "\nEND\n"


def cif(rows):
    keys = ("group_PDB id type_symbol label_atom_id label_alt_id label_comp_id label_asym_id label_entity_id label_seq_id "
            "Cartn_x Cartn_y Cartn_z occupancy B_iso_or_equiv auth_seq_id auth_asym_id pdbx_PDB_model_num").split()
    lines = [f"ATOM {n + 1} {element} {name} . {residue} {chain} 1 {number} {x:.3f} {y:.3f} {z:.3f} 1.00 {n % 50} {number} "
             f"{chain} 1" for n, (name, element, residue, chain, number, (x, y, z)) in enumerate(rows)]
    return "\n".join(["data_X", "loop_", *("_atom_site." + key for key in keys), *lines]) + "\n"


def pqr(rows):
    return "".join(f"ATOM {n + 1} {name} {residue} {chain} {number} {x:.3f} {y:.3f} {z:.3f} {0.1 * (n % 3 - 1):.2f} "
                   f"{1.5 + 0.05 * (n % 5):.2f}\n"
                   for n, (name, _, residue, chain, number, (x, y, z)) in enumerate(rows))


def gro(rows):
    lines = [f"{number:5}{residue:<5}{name:>5}{n + 1:5}{x / 10:8.4f}{y / 10:8.4f}{z / 10:8.4f}"
             for n, (name, _, residue, _, number, (x, y, z)) in enumerate(rows)]
    return "\n".join(["helix", str(len(rows)), *lines, "  10.0  10.0  10.0"]) + "\n"


def xyz(rows):
    return f"{len(rows)}\nhelix\n" + "".join(f"{row[1]} {row[5][0]} {row[5][1]} {row[5][2]}\n" for row in rows)


def xyzr(rows):
    return "".join(f"{row[5][0]} {row[5][1]} {row[5][2]} {1.5 + 0.07 * (n % 4):.2f}\n" for n, row in enumerate(rows))


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        rows = atoms()
        for name, text in (("helix.pdb", pdb(rows)), ("helix.cif", cif(rows)), ("helix.pqr", pqr(rows)),
                           ("helix.gro", gro(rows)), ("helix.xyz", xyz(rows)), ("helix.xyzr", xyzr(rows))):
            (self.folder / name).write_text(text)
        (self.folder / "helix.pdb.gz").write_bytes(gzip.compress(pdb(rows).encode()))
        self.pdb = self.folder / "helix.pdb"


@unittest.skipUnless(PROGRAM, "MENISCUS_PROGRAM is not set")
class Program(Files):
    def told(self, *arguments, good=True):
        run = subprocess.run([PROGRAM, "surface", "--device", "cpu", "--json", *map(str, arguments)], text=True,
                             capture_output=True)
        self.assertEqual(run.returncode == 0, good, run.stderr)
        return json.loads(run.stdout) if good else run.stderr

    def same(self, told, structure, **options):
        s = meniscus.surface(structure, **options)
        self.assertEqual((s.area, s.volume), (told["area"], told["volume"]))
        self.assertEqual(len(structure), told["atoms"]["used"])
        self.assertEqual(structure.radii_set, told["radii_set"])
        if "ses_sas_area" in told:
            self.assertEqual(s.atom_sas_areas.sum(), told["ses_sas_area"])

    def test_says_the_same_to_the_last_digit_in_every_format(self):
        for path in sorted(self.folder.iterdir()):
            with self.subTest(path.name):
                self.same(self.told(path), meniscus.read(path))
        self.assertEqual(len(list(self.folder.iterdir())), 7)

    def test_says_the_same_with_options(self):
        for words, options in ((["--select", "chain A"], {"select": "chain A"}),
                               (["--keep-water"], {"keep_water": True}),
                               (["--radii", "protor"], {"radii": "protor"}),
                               (["--radius", "element N=2.5"], {"radius": {"element N": 2.5}}),
                               (["--hydrogens", "drop"], {"hydrogens": "drop"})):
            with self.subTest(words):
                self.same(self.told(self.pdb, *words), meniscus.read(self.pdb, **options))
        for kind in ("sas", "vdw"):
            self.same(self.told(self.pdb, "--surface", kind), meniscus.read(self.pdb), kind=kind)

    def test_says_the_same_of_a_ligand(self):
        rows = [*atoms(), ("C1", "C", "LIG", "L", 1, (20.0, 0.0, 0.0)), ("O1", "O", "LIG", "L", 1, (21.3, 0.0, 0.0))]
        self.pdb.write_text(pdb(rows, water=False).replace("ATOM     65", "HETATM   65").replace("ATOM     66", "HETATM   66"))
        polymer = meniscus.read(self.pdb)
        self.assertEqual(polymer.report, "66 atoms read; 2 ligand atoms (LIG) left out; 64 used (select=all adds ligands)")
        self.same(self.told(self.pdb), polymer)
        self.assertEqual(len(meniscus.read(self.pdb, select="all")), 66)

    def test_says_the_same_where_a_file_is_refused(self):
        for words, options in ((["--select", "chain Z"], {"select": "chain Z"}),
                               (["--model", "3"], {"model": 3}),
                               (["--assembly", "1"], {"assembly": "1"})):
            with self.assertRaises(meniscus.InputError) as caught:
                meniscus.read(self.pdb, **options)
            said = self.told(self.pdb, *words, good=False).strip().removeprefix("meniscus: ").removeprefix("error: ")
            self.assertEqual(said.replace("--", ""), str(caught.exception))

    def test_warns_of_the_same(self):
        rows = atoms(4)
        rows[1] = (*rows[1][:5], rows[0][5])
        self.pdb.write_text(pdb(rows, water=False))
        run = subprocess.run([PROGRAM, "surface", "--device", "cpu", str(self.pdb)], text=True, capture_output=True)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            structure = meniscus.read(self.pdb)
        self.assertEqual(len(caught), 1)
        self.assertEqual(caught[0].filename, __file__)
        self.assertIn(f"warning: {caught[0].message}", run.stderr)
        self.assertEqual([f"{self.pdb}: {text}" for text in structure.warnings], [str(caught[0].message)])


class Atoms(Files):
    def test_arrays(self):
        rows, s = atoms(), meniscus.read(self.pdb)
        self.assertEqual(len(s), 64)
        self.assertEqual(list(s.names), [row[0] for row in rows])
        self.assertEqual(list(s.residue_names), [row[2] for row in rows])
        self.assertEqual(list(s.chains), [row[3] for row in rows])
        self.assertEqual(list(s.residue_numbers), [row[4] for row in rows])
        self.assertEqual(list(s.elements), [row[1] for row in rows])
        self.assertEqual(list(s.atomic_numbers), [{"N": 7, "C": 6, "O": 8}[row[1]] for row in rows])
        np.testing.assert_array_equal(s.positions, [row[5] for row in rows])
        np.testing.assert_array_equal(s.radii, meniscus.radii_of([row[1] for row in rows]))
        np.testing.assert_array_equal(s.b_factors, [n % 50 for n in range(64)])
        np.testing.assert_array_equal(s.occupancies, np.ones(64))
        np.testing.assert_array_equal(s.indices, range(64))
        np.testing.assert_array_equal(s.residues, [n // 4 for n in range(64)])
        np.testing.assert_array_equal(s.models, np.ones(64))
        np.testing.assert_array_equal(s.copies, np.zeros(64))
        self.assertTrue(np.isnan(s.charges).all())
        self.assertEqual(set(s.classes), {"polymer"})
        self.assertEqual(set(s.altlocs) | set(s.insertion_codes) | set(s.segments), {""})
        self.assertEqual((s.file, s.format, s.radii_set, s.model_count), (str(self.pdb), "PDB", "bondi", 1))
        self.assertEqual(s.report, "65 atoms read; 1 water atom left out; 64 used")
        self.assertEqual(repr(s), f"<meniscus.Structure: {self.pdb}, PDB: {s.report}>")
        self.assertFalse(s.positions.flags.writeable)
        np.testing.assert_allclose(meniscus.read(self.folder / "helix.pqr").charges[:3], [-0.1, 0, 0.1], atol=1e-7)

    def test_arrays_outlive_the_structure(self):
        s = meniscus.read(self.pdb)
        positions, names = s.positions, s.names
        del s
        np.testing.assert_array_equal(positions[-1], atoms()[-1][5])
        self.assertEqual(names[1], "CA")

    def test_pickles_need_no_file(self):
        s = meniscus.read(self.pdb)
        packed = pickle.dumps(s)
        self.pdb.unlink()
        again = pickle.loads(packed)
        for name in ("positions", "radii", "names", "chains", "classes", "charges", "residue_numbers", "altlocs"):
            np.testing.assert_array_equal(getattr(again, name), getattr(s, name), name)
        self.assertEqual((repr(again), len(again), again.warnings), (repr(s), len(s), s.warnings))
        self.assertEqual(meniscus.surface(again).area, meniscus.surface(s).area)
        self.assertFalse(again.positions.flags.writeable)
        self.assertIs(copy.deepcopy(again), again)
        with self.assertRaisesRegex(AttributeError, "name"):
            s.name = "x"

    def test_arguments(self):
        read, path = meniscus.read, self.pdb
        self.assertEqual(len(read(str(path), select="name CA")), 16)
        self.assertEqual(len(read(os.fsencode(path), model="all")), 64)
        table = self.folder / "radii.txt"
        table.write_text("* CA 2.25\n")
        self.assertEqual(read(path, radii_files=table, select="name CA").radii[0], 2.25)
        self.assertEqual(read(path, radius=["all=1.25", "name N = 3"]).radii[1], 1.25)
        for wanted, error, sentence in (
                (lambda: read(path, select="chain ("), meniscus.UsageError, r"select: .*\n.*chain \("),
                (lambda: read(path, altloc="both"), meniscus.UsageError, "altloc is 'both'"),
                (lambda: read(path, hydrogens="no"), meniscus.UsageError, "hydrogens is 'no', none of auto, keep, drop"),
                (lambda: read(path, unknown_element="x"), meniscus.UsageError, "unknown_element is 'x'"),
                (lambda: read(path, radii="amber"), meniscus.InputError, "not a set of radii"),
                (lambda: read(path, model=0), meniscus.UsageError, "model is 0"),
                (lambda: read(path, model="none"), meniscus.InputError, "model is 'none'"),
                (lambda: read(path, radius={"all": -1.0}), meniscus.UsageError, "radius: the radius must be"),
                (lambda: read(path, select="a\0b"), meniscus.InputError, "select is"),
                (lambda: read("a\0.pdb"), meniscus.InputError, "zero"),
                (lambda: read(self.folder), meniscus.InputError, "is a folder"),
                (lambda: read(self.folder / "none.pdb"), meniscus.InputError, "none.pdb: cannot be read"),
                (lambda: meniscus.surface(str(path)), meniscus.InputError, r"meniscus.read\(\)"),
                (lambda: meniscus.surface([[0, 0, 0]]), meniscus.InputError, "radii are missing")):
            with self.assertRaisesRegex(error, sentence):
                wanted()

    def test_surface_takes_radii_of_its_own(self):
        s = meniscus.read(self.pdb)
        self.assertEqual(meniscus.surface(s, 1.5).area, meniscus.surface(np.array(s.positions), 1.5).area)


if __name__ == "__main__":
    unittest.main()
