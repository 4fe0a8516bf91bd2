# SPDX-License-Identifier: BSD-3-Clause
"""The Debian package: lintian has nothing to say, it depends on what the program loads, and holds what belongs to it."""

import pathlib
import shutil
import tempfile
import unittest

from installation import BUILD, run


@unittest.skipUnless(shutil.which("dpkg-shlibdeps"), "dpkg-dev is not installed")
class DebianPackage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        done = run("cpack", "--config", BUILD / "CPackConfig.cmake", "-B", folder.name)
        assert done.returncode == 0, done.stdout + done.stderr
        cls.packages = sorted(pathlib.Path(folder.name).glob("*.deb"))

    def test_the_program_has_its_package(self):
        self.assertEqual([package.name.split("_")[0] for package in self.packages], ["meniscus"])

    def test_it_depends_on_libraries_and_only_recommends_other_programs(self):
        fields = dict(line.split(": ", 1) for line in run("dpkg-deb", "-f", self.packages[0]).stdout.splitlines()
                      if line[:1] != " " and ": " in line)
        for name in ("libtbb12", "libopenimageio2.4", "libegl1", "libepoxy0"):
            self.assertRegex(fields["Depends"], rf"\b{name}\b")
        self.assertNotIn("blender", fields["Depends"])
        for name in ("ffmpeg", "povray", "blender"):
            self.assertIn(name, fields["Recommends"])

    def test_it_holds_what_belongs_to_the_program(self):
        listed = run("dpkg-deb", "-c", self.packages[0]).stdout
        for path in ("usr/bin/meniscus", "usr/lib/meniscus/meniscus_openimageio.so", "usr/share/man/man1/meniscus.1.gz",
                     "usr/share/meniscus/addon/render_mns.py", "usr/share/doc/meniscus/copyright"):
            self.assertIn(f" ./{path}\n", listed)

    @unittest.skipUnless(shutil.which("lintian"), "lintian is not installed")
    def test_lintian_has_nothing_to_say(self):
        for package in self.packages:
            checked = run("lintian", "--allow-root", "--fail-on", "error,warning", package)
            self.assertEqual((checked.returncode, checked.stdout), (0, ""), checked.stderr)


if __name__ == "__main__":
    unittest.main()
