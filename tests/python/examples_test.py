# SPDX-License-Identifier: BSD-3-Clause
"""examples_test.py PACKAGE...: every public name of the Python package has a docstring with an example that is true. Examples
that need a package are left out where it is missing, unless it is named. Environment as of package_test.py."""
import doctest
import importlib.util
import inspect
import os
import pathlib
import re
import sys
import tempfile
import unittest
import warnings

if "MENISCUS_PACKAGE" in os.environ:
    sys.path.insert(0, os.environ["MENISCUS_PACKAGE"])

import numpy as np

import meniscus
from structure_test import atoms, pdb

NAMED = sys.argv[1:]
MODULES = {"biopython": "Bio"}


def members(kind):
    """Returns functions and properties of a class itself, in their order."""
    return [(name, getattr(kind, name)) for name, member in vars(kind).items() if not name.startswith("_")
            and (isinstance(member, (property, classmethod)) or inspect.isfunction(member))]


def fields(kind):
    return getattr(kind, "_fields", ()) or tuple(getattr(kind, "__dataclass_fields__", ()))


def needed(text):
    """Returns the package that an example imports, or "" if it imports none or the package is installed."""
    for module in re.findall(r">>> (?:import|from) (\w+)", text):
        spec = importlib.util.find_spec(module)
        if spec is None or spec.origin is None:  # Debian has only the tests of ProDy.
            return module
    return ""


class Examples(unittest.TestCase):
    def setUp(self):
        folder, before = tempfile.TemporaryDirectory(), os.getcwd()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, before)
        os.chdir(folder.name)
        helix = atoms()
        pathlib.Path("helix.pdb").write_text(pdb(helix))
        wider = [(*row[:5], 1.1 * row[5]) for row in helix]
        pathlib.Path("models.pdb").write_text("".join(
            f"MODEL     {n}\n{pdb(rows, water=False).replace('END', 'ENDMDL')}" for n, rows in enumerate((helix, wider), 1)))
        warnings.simplefilter("ignore")

    def run_example(self, name, text, names):
        self.assertIn(">>>", text or "", f"{name} has no example")
        missing = needed(text)
        if missing:
            self.assertNotIn(missing, [MODULES.get(package, package) for package in NAMED])
            print(f"left out: {name}, for {missing} is not installed")
            return
        said = []
        test = doctest.DocTestParser().get_doctest(text, names, name, None, None)
        doctest.DocTestRunner(verbose=False).run(test, out=said.append, clear_globs=False)
        names.update(test.globs)
        self.assertFalse(said, "".join(said))

    def test_all(self):
        for name in meniscus.__all__:
            thing = getattr(meniscus, name)
            with self.subTest(name):
                self.run_example(name, thing.__doc__, {"meniscus": meniscus, "np": np})
            if not inspect.isclass(thing):
                continue
            for field in fields(thing):
                self.assertRegex(thing.__doc__, rf"\b{field}\b", f"{name} does not explain it")
            for member, function in members(thing):
                with self.subTest(f"{name}.{member}"):
                    names = {"meniscus": meniscus, "np": np}
                    self.run_example(name, thing.__doc__, names)
                    self.run_example(f"{name}.{member}", function.__doc__, names)


if __name__ == "__main__":
    unittest.main(argv=["examples_test"])
