# SPDX-License-Identifier: BSD-3-Clause
"""The part of the add-on that computes, under plain Python, and files for it. Arguments of the script: PROGRAM ADDON PACKAGE."""

import os
import subprocess
import sys
import tempfile
import types
import unittest

PROGRAM, ADDON, PACKAGE = sys.argv[1:4]
del sys.argv[1:4]
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import samples  # noqa: E402

package = types.ModuleType("meniscus_import")  # This stand-in leaves out the part of the add-on that needs Blender.
package.__path__ = [os.path.join(ADDON, "meniscus_import")]
sys.modules["meniscus_import"] = package
from meniscus_import.computing import engines  # noqa: E402


class Quiet:
    """A task whose progress nobody watches."""

    def report(self, stage):
        pass

    def check(self):
        pass


class WithFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(engines.forget)
        self.folder = folder.name

    def molecule(self, name="triple"):
        path = os.path.join(self.folder, name + ".xyzr")
        with open(path, "w", encoding="ascii") as file:
            for atom in samples.MOLECULES[name]:
                file.write("%.12f %.12f %.12f %.4f\n" % atom)
        return path

    def atoms(self, *arguments):
        target = os.path.join(self.folder, "some.atoms")
        subprocess.run([PROGRAM, "export", "atoms", *arguments, "-o", target, "--force", "-q", "--device", "cpu"], check=True,
                       stdout=subprocess.DEVNULL)
        return target
