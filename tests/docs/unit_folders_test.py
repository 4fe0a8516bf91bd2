# SPDX-License-Identifier: BSD-3-Clause
"""The tests of a file of core are found by its path: folders of tests/unit are folders of core, and no source is left out."""

import pathlib
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
UNIT = ROOT / "tests" / "unit"


def without_counterpart(unit, core):
    """Returns folders of `unit` that `core` lacks, and tests outside of folders."""
    folders = [path.relative_to(unit) for path in unit.rglob("*") if path.is_dir()]
    lost = [str(folder) for folder in folders if not (core / folder).is_dir()]
    return sorted(lost + [path.name for path in unit.glob("*.cpp")])


class UnitFolders(unittest.TestCase):
    def test_are_those_of_core(self):
        self.assertEqual(without_counterpart(UNIT, ROOT / "core"), [])

    def test_every_test_is_built(self):
        listed = (UNIT / "CMakeLists.txt").read_text(encoding="utf-8").split()
        tests = [str(path.relative_to(UNIT)) for path in UNIT.rglob("*_test.cpp")]
        self.assertGreater(len(tests), 50)
        self.assertEqual([name for name in tests if name not in " ".join(listed)], [])

    def test_a_folder_of_another_name_is_found(self):
        self.assertIn("surface", without_counterpart(UNIT, ROOT / "app"))


if __name__ == "__main__":
    unittest.main()
