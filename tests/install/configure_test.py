# SPDX-License-Identifier: BSD-3-Clause
"""Configuring once is enough: a second run writes the same build and the same installation, so that nothing depends on
what an earlier one left in the cache."""

import pathlib
import re
import tempfile
import unittest

from installation import ROOT, run


HOW_IT_IS_BUILT = ("DEFINES", "FLAGS", "INCLUDES", "COMMAND", "LINK_FLAGS", "LINK_LIBRARIES", "LINK_PATH")


def written(build):
    """Returns by path the build's commands, the scripts of the installation and the exported targets. Other content of
    a first run's build.ninja (symbols of other systems, its dependencies) differs."""
    patterns = ("**/cmake_install.cmake", "**/Export/**/*.cmake")
    states = {str(path.relative_to(build)): path.read_text() for pattern in patterns for path in build.glob(pattern)}
    lines = (build / "build.ninja").read_text().splitlines(keepends=True)
    states["build.ninja"] = "".join(line for line in lines if line.startswith("build ") and "RERUN_CMAKE" not in line
                                    and "VerifyGlobs" not in line or line.strip().startswith(HOW_IT_IS_BUILT))
    return states


class Configuration(unittest.TestCase):
    def test_a_second_one_changes_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            build = pathlib.Path(folder)
            states = []
            for _ in range(2):
                done = run("cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                           "-DMENISCUS_TESTS=OFF")
                self.assertEqual(done.returncode, 0, done.stderr)
                states.append(written(build))
        first, second = states
        self.assertIn("build.ninja", first)
        self.assertTrue(any("Export" in path for path in first))
        self.assertEqual(sorted(first), sorted(second))
        for path, text in first.items():
            changed = [pair for pair in zip(text.splitlines(), second[path].splitlines()) if pair[0] != pair[1]]
            self.assertEqual((changed[:3], len(text)), ([], len(second[path])), path)

    def test_a_folder_below_the_prefix_stays_below_it(self):
        """debhelper names it without a type, and CMake may take such a path as relative to the current folder."""
        with tempfile.TemporaryDirectory() as folder:
            done = run("cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DMENISCUS_TESTS=OFF",
                       "-DCMAKE_INSTALL_LIBDIR=lib/somewhere", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            scripts = [path.read_text() for path in pathlib.Path(folder).glob("**/cmake_install.cmake")]
            places = {place for text in scripts for place in re.findall(r'file\(INSTALL DESTINATION "([^"]*)', text)}
            self.assertIn("${CMAKE_INSTALL_PREFIX}/lib/somewhere", places)
            self.assertEqual({place for place in places if not place.startswith("${CMAKE_INSTALL_PREFIX}/")}, set())


if __name__ == "__main__":
    unittest.main()
