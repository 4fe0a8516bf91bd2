#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The table of results is the same each time, and compare_tables.py finds a changed decision and a changed area.

table_test.py RESULT_TABLE"""

import os
import re
import subprocess
import sys
import tempfile
import unittest

TABLE = os.path.abspath(sys.argv[1])
COMPARE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "compare_tables.py")
UBIQUITIN = "/usr/share/freesasa/test-data/1ubq.pdb"


def written(path):
    subprocess.run([TABLE, path, UBIQUITIN], check=True, env={**os.environ, "MENISCUS_TARGETS_TIES": "200"})
    with open(path, encoding="ascii") as file:
        return file.read()


class Table(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.paths = [os.path.join(folder.name, name) for name in ("a.txt", "b.txt")]
        self.text = written(self.paths[0])

    def compare(self, text):
        """Returns whether the table and this one count as equal, and the comparison's messages."""
        with open(self.paths[1], "w", encoding="ascii") as file:
            file.write(text)
        result = subprocess.run([sys.executable, COMPARE, *self.paths], capture_output=True, text=True)
        return result.returncode == 0, result.stdout + result.stderr

    def test_twice_the_same(self):
        self.assertEqual(len(self.text.splitlines()), 5)  # two windows, the molecule, two lines of ties
        self.assertEqual(written(self.paths[1]), self.text)

    def test_differences_are_found(self):
        self.assertTrue(self.compare(self.text)[0])
        equal, said = self.compare(re.sub("decisions .", "decisions x", self.text, count=1))
        self.assertFalse(equal)
        self.assertIn("decisions of 1ubq.pdb+0 differ", said)
        last_bit = re.sub(r"(area \w+)(\w)", lambda m: m[1] + ("0" if m[2] != "0" else "1"), self.text, count=1)
        equal, said = self.compare(last_bit)
        self.assertTrue(equal)
        self.assertIn("area 1,", said)
        other = re.sub(r"(area \w{6})\w", lambda m: m[1] + "f", self.text, count=1)
        self.assertFalse(self.compare(other)[0])
        self.assertFalse(self.compare("\n".join(self.text.splitlines()[:-1]) + "\n")[0])


if __name__ == "__main__":
    if not os.path.exists(UBIQUITIN):
        print(f"{UBIQUITIN} is not there: install freesasa")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1], verbosity=2)
