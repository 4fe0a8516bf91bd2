# SPDX-License-Identifier: BSD-3-Clause
"""Everything that names the version of Meniscus names that of CMakeLists.txt, and CHANGELOG.md has a section about it."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
VERSION = re.search(r"project\(meniscus VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
#: Files, and how the version is written in them.
PLACES = {
    "CITATION.cff": r"^version: (.+)$",
    "exporters/blender/addon/meniscus_import/blender_manifest.toml": r'^version = "(.+)"$',
    "scripts/package/conda/recipe.yaml": r'^  version: "(.+)"$',
    "scripts/package/debian/changelog": r"\Ameniscus \((.+)-1\) ",
    "scripts/package/default.nix": r'^  version = "(.+)";$',
    "scripts/package/share/metainfo/invalid.meniscus.meniscus.metainfo.xml": r'<releases>\n    <release version="(.+)" date="',
}
#: Three numbers, each in a place of its own.
NUMBERS = {
    "exporters/bindings/c/include/meniscus/meniscus.h":
        r"MENISCUS_VERSION_MAJOR (\d+)\n#define MENISCUS_VERSION_MINOR (\d+)\n#define MENISCUS_VERSION_PATCH (\d+)",
    "exporters/blender/addon/meniscus_import/__init__.py": r'"version": \((\d+), (\d+), (\d+)\)',
}
#: What asks for a version asks for the same minor one.
MINOR = ("docs/reference/library.md", "exporters/bindings/c/example/CMakeLists.txt", "scripts/package/try_package.sh",
         "tests/c_api/installed_test.py")


class Version(unittest.TestCase):
    def found(self, name, pattern):
        match = re.search(pattern, (ROOT / name).read_text(), re.M)
        self.assertIsNotNone(match, name)
        return ".".join(match.groups())

    def test_every_place_agrees(self):
        for name, pattern in (PLACES | NUMBERS).items():
            with self.subTest(name):
                self.assertEqual(self.found(name, pattern), VERSION)

    def test_examples_ask_for_it(self):
        for name in MINOR:
            with self.subTest(name):
                self.assertEqual(self.found(name, r"find_package\(Meniscus ([0-9.]+) REQUIRED\)"), VERSION.rpartition(".")[0])

    def test_the_changelog_has_it_within_sixty_lines(self):
        sections = re.split(r"^## ", (ROOT / "CHANGELOG.md").read_text(), flags=re.M)
        own = [section for section in sections if section.startswith((VERSION, "Unreleased"))]
        self.assertTrue(any(section.startswith(VERSION + " (") for section in own), VERSION)
        for section in own:
            self.assertLessEqual(section.count("\n"), 60)


if __name__ == "__main__":
    unittest.main()
