# SPDX-License-Identifier: BSD-3-Clause
"""Installs the build into a temporary folder, and runs the program from there."""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
ROOT = pathlib.Path(__file__).resolve().parents[2]


def run(*words, **options):
    """Runs a command and returns its exit code, output and messages as text."""
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, **options)


class Installation(unittest.TestCase):
    """A test whose `prefix` holds the files of cmake --install."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.prefix = cls.folder / "anywhere"
        done = run("cmake", "--install", BUILD, "--prefix", cls.prefix)
        assert done.returncode == 0, done.stderr
        cls.program = cls.prefix / "bin/meniscus"

    def good(self, *words, **options):
        done = run(*words, **options)
        self.assertEqual(done.returncode, 0, f"{words}: {done.stderr}")
        return done

    def commands(self):
        """Returns the words of every command, and of the program itself: [], ["surface"], ["export", "povray"]..."""
        found = [[]]
        for words in found:
            lines = re.split(r"\n(?:Commands|Formats):\n", self.good(self.program, *words, "--help-all").stdout)[1:]
            for line in (lines or [""])[0].split("\n\n")[0].splitlines():
                if line.startswith("  ") and line[2] != " ":
                    found.append([*words, line.split()[0]])
        return found

    def options(self, words):
        """Returns the names of a command's options in its help."""
        names = []
        for line in self.good(self.program, *words, "--help-all").stdout.splitlines():
            if line.startswith("  -"):
                names += [name for name in line.split()[0].split(",") if name.startswith("-")]
        return names
