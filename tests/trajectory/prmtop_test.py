# SPDX-License-Identifier: BSD-3-Clause
"""Amber topologies are read like in MDAnalysis, MDTraj and ParmEd: prmtop_test.py ATOM_DUMP MENISCUS PRMTOP."""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import warnings

import numpy as np

warnings.filterwarnings("ignore")
import MDAnalysis  # noqa: E402
import mdtraj  # noqa: E402
import parmed  # noqa: E402

CRAMBIN = "/usr/lib/R/site-library/bio3d/examples/crambin.prmtop"
dump_program = meniscus_program = topology_file = None


def dump(path):
    """Returns the atoms, a list of words each, and the set of bonds."""
    text = subprocess.run([dump_program, str(path)], check=True, capture_output=True, text=True).stdout
    rows = [line.split("\t") for line in text.splitlines()]
    return ([row[1:] for row in rows if row[0] == "atom"],
            sorted(tuple(sorted(map(int, row[1:]))) for row in rows if row[0] == "bond"))


class Prmtop(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.text = pathlib.Path(topology_file).read_text()

    def write(self, name, text):
        path = pathlib.Path(self.folder.name) / name
        path.write_text(text)
        return path

    def without(self, *sections):
        text = self.text
        for name in sections:
            text, count = re.subn(rf"(?ms)^%FLAG {name}\b.*?(?=^%FLAG)", "", text)
            self.assertEqual(count, 1, name)
        return text

    def test_atoms_and_bonds_are_those_of_other_readers(self):
        """ParmEd wrote three residues, two waters and three ions from a topology of GROMACS."""
        atoms, bonds = dump(topology_file)
        theirs = parmed.load_file(str(topology_file))
        self.assertEqual(len(atoms), 65)
        self.assertEqual(len(atoms), len(theirs.atoms))
        for mine, other in zip(atoms, theirs.atoms):
            name, residue, number, place, chain, code, element, charge, radius, kind = mine
            self.assertEqual((name, residue), (other.name, other.residue.name))
            self.assertEqual(int(number), other.residue.idx + 1)
            self.assertEqual(int(place), other.residue.idx)
            self.assertEqual(int(element), other.atomic_number)
            self.assertAlmostEqual(float(charge), other.charge, places=6)
            self.assertAlmostEqual(float(radius), other.solvent_radius, places=8)
            expected = {"HOH": "water", "SOL": "water", "WAT": "water", "NA": "ion", "CL": "ion", "ZN": "ion"}
            self.assertEqual(kind, expected.get(residue, "polymer"), residue)
            self.assertEqual((chain, code), ("", " "))
        self.assertEqual(bonds, sorted((bond.atom1.idx, bond.atom2.idx) if bond.atom1.idx < bond.atom2.idx else
                                       (bond.atom2.idx, bond.atom1.idx) for bond in theirs.bonds))
        analysis = MDAnalysis.Universe(str(topology_file), topology_format="PRMTOP")
        self.assertEqual([mine[0] for mine in atoms], list(analysis.atoms.names))
        np.testing.assert_allclose([float(mine[7]) for mine in atoms], analysis.atoms.charges, atol=1e-6)
        traj = mdtraj.load_prmtop(str(topology_file))
        self.assertEqual([int(mine[6]) for mine in atoms], [atom.element.number for atom in traj.atoms])
        self.assertEqual(bonds, sorted(tuple(sorted((a.index, b.index))) for a, b in traj.bonds))

    def test_a_file_that_leap_wrote(self):
        """The file holds crambin with its disulfide bridges; its lines end in blanks up to the 80th column."""
        atoms, bonds = dump(CRAMBIN)
        theirs = parmed.load_file(CRAMBIN)
        self.assertEqual([(mine[0], mine[1], int(mine[2]), int(mine[6])) for mine in atoms],
                         [(atom.name, atom.residue.name, atom.residue.idx + 1, atom.atomic_number) for atom in theirs.atoms])
        np.testing.assert_allclose([(float(mine[7]), float(mine[8])) for mine in atoms],
                                   [(atom.charge, atom.solvent_radius) for atom in theirs.atoms], atol=1e-6)
        self.assertEqual(bonds, sorted(tuple(sorted((bond.atom1.idx, bond.atom2.idx))) for bond in theirs.bonds))
        self.assertEqual(sum(atoms[a][0] == atoms[b][0] == "SG" for a, b in bonds), 3)

    def test_elements_by_mass_where_there_are_no_numbers(self):
        """Amber before 12 writes such files."""
        atoms, bonds = dump(self.write("old.parm7", self.without("ATOMIC_NUMBER")))
        self.assertEqual((atoms, bonds), dump(topology_file))

    def test_chains_and_numbers_that_parmed_adds(self):
        numbers, chains = [10, 11, 11, -3, 2, 3, 4, 5], ["A", "A", "A", "W", "W", "I", "I", "I"]
        codes = ["", "", "B", "", "", "", "", ""]
        added = ("%FLAG RESIDUE_NUMBER\n%COMMENT the numbers\n%FORMAT(20I4)\n" + "".join(f"{n:4d}" for n in numbers) +
                 "\n%FLAG RESIDUE_CHAINID\n%FORMAT(20a4)\n" + "".join(f"{chain:4s}" for chain in chains).rstrip() +
                 "\n%FLAG RESIDUE_ICODE\n%FORMAT(20a4)\n" + "".join(f"{code:4s}" for code in codes).rstrip() + "\n")
        atoms, _ = dump(self.write("added.prmtop", self.text + added))
        plain, _ = dump(topology_file)
        for mine, other in zip(atoms, plain):
            residue = int(mine[3])
            self.assertEqual(mine[3], other[3])
            self.assertEqual(mine[2], str(numbers[residue]))
            self.assertEqual(mine[4], chains[residue])
            self.assertEqual(mine[5], codes[residue] or " ")

    def run_meniscus(self, *words):
        return subprocess.run([meniscus_program, *map(str, words)], capture_output=True, text=True)

    def test_with_its_trajectory(self):
        """Radii are Bondi's as for all topologies, or those of generalized Born models on request."""
        rng = np.random.default_rng(1)
        frames = np.cumsum(rng.normal(0, 1.2, (2, 65, 3)), axis=1)
        crd = parmed.amber.AmberMdcrd(str(self.write("a.mdcrd", "")), 65, False, "w")
        for frame in frames:
            crd.add_coordinates(frame.ravel())
        crd.close()
        path = self.folder.name + "/a.mdcrd"
        common = ["surface", topology_file, path, "-q", "--trust-atom-order", "--device", "cpu", "--csv", "-"]
        for words, h1 in (([], "1.2"), (["--radii", "file"], "1.3")):
            result = self.run_meniscus(*common, *words)
            self.assertEqual(result.returncode, 0, result.stderr)
            rows = [line.split(",") for line in result.stdout.splitlines()]
            self.assertEqual([row[0] for row in rows[1:]].count("1"), 65 - 6 - 3)
            self.assertEqual([float(row[11]) for row in rows if row[8] == "H1"], [float(h1)] * 2)

    def test_damage_is_named_with_its_line(self):
        def said(text):
            result = subprocess.run([dump_program, str(self.write("b.prmtop", text))], capture_output=True, text=True)
            self.assertEqual(result.returncode, 1, text[:100])
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
            return result.stderr

        line = self.text[:self.text.index("%FLAG CHARGE")].count("\n") + 1
        self.assertIn("has no section %FLAG MASS; is the file cut short?", said(self.without("MASS")))
        self.assertIn("has no %FLAG: prmtop files of Amber 6 and before", said("title\n    65    16\n"))
        self.assertIn(f"b.prmtop:{line + 2}: '  2.90099016E+xx' of %FLAG CHARGE is not a number",
                      said(self.text.replace("2.90099016E+00", "2.90099016E+xx")))
        self.assertIn("%FLAG CHARGE should have 65 fields, but 64 follow",
                      said(self.shortened("CHARGE", 1)))
        self.assertIn("%FLAG ATOM_NAME has 'CL  ZN' after its 63 fields; do its POINTERS belong to another file?",
                      said(self.text.replace("      65      16", "      63      16", 1)))
        self.assertIn(f"b.prmtop:{line}: %FLAG CHARGE has no %FORMAT such as",
                      said(self.text.replace("%FLAG CHARGE\n%FORMAT(5E16.8)", "%FLAG CHARGE\n%FORMAT(*)")))
        self.assertIn("POINTERS say 99999999 of NATOM, which its",
                      said(self.text.replace("      65      16", "99999999      16", 1)))
        self.assertIn("RESIDUE_POINTER does not begin with 1",
                      said(re.sub(r"(%FLAG RESIDUE_POINTER\n.*\n)       1", r"\g<1>       2", self.text)))
        self.assertIn("is not three times one of the atoms 0 to 64",
                      said(re.sub(r"(%FLAG BONDS_INC_HYDROGEN\n.*\n)........", r"\g<1>       1", self.text)))
        for cut in range(500, self.text.index("%FLAG ANGLES_INC_HYDROGEN") - 10, 997):
            said(self.text[:cut])

    def shortened(self, section, fields):
        """Returns the topology without so many last fields of a section."""
        begin = self.text.index(f"%FLAG {section}")
        end = self.text.index("%FLAG", begin + 1)
        return self.text[:begin] + self.text[begin:end].rstrip()[:-16 * fields] + "\n" + self.text[end:]


if __name__ == "__main__":
    dump_program, meniscus_program, topology_file = sys.argv[1:4]
    unittest.main(argv=sys.argv[:1])
