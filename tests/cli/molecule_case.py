# SPDX-License-Identifier: BSD-3-Clause
"""A test case that runs the program on its own small PDB files. The first argument of the script is the program."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = sys.argv.pop(1)
ATOM = "{0:<6}{1:5d} {2:>4} {3:>3} {4}{5:4d}    {6:8.3f}{7:8.3f}{8:8.3f}  1.00 10.00          {9:>2}"


def pdb(rows, end="END\n"):
    """Returns the text of atoms, each (record, name, residue, chain, residue number, position in Å, element)."""
    return "".join(ATOM.format(row[0], n, *row[1:5], *row[5], row[6]) + "\n" for n, row in enumerate(rows, 1)) + end


class MoleculeCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, name, text):
        (self.folder / name).parent.mkdir(exist_ok=True)
        (self.folder / name).write_text(text)

    def run_program(self, *words):
        return subprocess.run([PROGRAM, *map(str, words)], cwd=self.folder, capture_output=True, text=True, timeout=300, check=False)

    def made(self, *words):
        """Returns the finished run of a program that must succeed."""
        done = self.run_program(*words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done
