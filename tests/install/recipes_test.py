# SPDX-License-Identifier: BSD-3-Clause
"""Recipes for other package managers have this version, name the library's dependencies, and can be read."""

import re
import shutil
import unittest

from installation import ROOT, run

FOLDER = ROOT / "scripts/package"
RECIPES = {"conda": FOLDER / "conda/recipe.yaml", "nix": FOLDER / "default.nix", "homebrew": FOLDER / "meniscus.rb"}
PARTS = ("cmake", "ninja", "glm", "fmt", "tbb", "gemmi", "zlib", "freetype", "nlohmann.json", "libdeflate", "libepoxy", "liberation")


class Recipes(unittest.TestCase):
    def test_versions(self):
        version = re.search(r"project\(meniscus VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
        for name in ("conda", "nix"):
            self.assertIn(f'"{version}"', RECIPES[name].read_text(), name)

    def test_parts(self):
        for name, path in RECIPES.items():
            for part in PARTS:
                self.assertRegex(path.read_text(), rf"(?i)\b{part}", name)

    @unittest.skipUnless(shutil.which("ruby"), "ruby is not installed")
    def test_homebrew_is_ruby(self):
        self.assertEqual(run("ruby", "-wc", RECIPES["homebrew"]).stdout, "Syntax OK\n")

    @unittest.skipUnless(shutil.which("nix-instantiate"), "nix-bin is not installed")
    def test_nix_is_read(self):
        done = run("nix-instantiate", "--parse", RECIPES["nix"])
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
