# SPDX-License-Identifier: BSD-3-Clause
"""Runs the programs under test in folders of their own, and reads their files like the three kinds of clients."""

import collections
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
MSMS = BUILD / "meniscus-msms"
UBIQUITIN = pathlib.Path("/usr/share/freesasa/test-data/1ubq.pdb")
LYSOZYME = pathlib.Path("/usr/lib/R/site-library/bio3d/examples/1hel.pdb")
TOXIN = pathlib.Path("/usr/share/pymol/data/demo/1tii.pdb")

Vertex = collections.namedtuple("Vertex", "position normal face sphere level name")
Triangle = collections.namedtuple("Triangle", "corners kind face")


def run(*words, **options):
    """Runs a command and returns its exit code, output and messages as text."""
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, timeout=120, **options)


def vertices(path):
    """Reads vertices by split: rows of nine or ten fields; it passes over all others."""
    rows = []
    for line in path.read_text().splitlines():
        fields = line.split()
        if len(fields) not in (9, 10) or line.startswith("#"):
            continue
        numbers = [float(field) for field in fields[:6]]
        rows.append(Vertex(tuple(numbers[:3]), tuple(numbers[3:]), *map(int, fields[6:9]), "".join(fields[9:])))
    return rows


def triangles(path):
    """Reads triangles by split: rows of five fields that are whole numbers."""
    rows = []
    for line in path.read_text().splitlines():
        fields = line.split()
        if len(fields) == 5 and not line.startswith("#"):
            a, b, c, kind, face = map(int, fields)
            rows.append(Triangle((a, b, c), kind, face))
    return rows


SCANNED = re.compile(r"\s*" + r"\s+".join([r"([-+]?\d+\.\d+)"] * 6 + [r"([-+]?\d+)"] * 3) + r"(?:\s|$)")


def scanned_vertices(path):
    """Reads vertices by scanf: nine numbers from the beginning of each line, with anything behind them."""
    matches = (SCANNED.match(line) for line in path.read_text().splitlines())
    return [match.groups() for match in matches if match]


def table(out, title):
    """Returns the rows of numbers under a line of titles, up to the first other line."""
    rows = []
    for line in out.split(title, 1)[1].splitlines()[1:]:
        if not re.fullmatch(r"[\s\d.+-]+", line):
            break
        rows.append([float(field) for field in line.split()])
    return rows


ANALYTIC = "    Comp. probe_radius,   reent,    toric,   contact    SES       SAS"
NUMERIC = "    Comp. probe_radius SES_volume SES_area)"


class Folder(unittest.TestCase):
    """Each test has an empty `folder`."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def spheres(self, text, name="in.xyzr"):
        path = self.folder / name
        path.write_text(text)
        return path

    def molecule(self, pdb=UBIQUITIN, program="meniscus-pdb_to_xyzr", name="in.xyzr"):
        return self.spheres(self.good(BUILD / program, pdb).stdout, name)

    def good(self, *words, **options):
        done = run(*words, **options)
        self.assertEqual((done.returncode, done.stderr), (0, ""), f"{words}: {done.stdout}")
        return done

    def msms(self, *words):
        return self.good(MSMS, *words, cwd=self.folder)

    def refused(self, code, *words):
        """Checks that a command fails with this exit code and a message, and writes no file."""
        before = sorted(self.folder.iterdir())
        done = run(MSMS, *words, cwd=self.folder)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertNotEqual(done.stderr, "")
        self.assertEqual(sorted(self.folder.iterdir()), before)
        return done
