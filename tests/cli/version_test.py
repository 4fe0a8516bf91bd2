# SPDX-License-Identifier: BSD-3-Clause
"""The version that a build reports: version_test.py SOURCE CMAKE. Changed sources never look like another build."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE, CMAKE = pathlib.Path(sys.argv[1]), sys.argv[2]
ENVIRONMENT = {**{name: value for name, value in os.environ.items() if not name.startswith("GIT_")},
               "GIT_CONFIG_GLOBAL": "/dev/null", "GIT_CONFIG_NOSYSTEM": "1"}


class Version(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="meniscus-version-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.tree = self.folder / "a tree of $sources"
        for part in ("app", "core", "exporters", "gpu_shaders", "docs", "scripts/cmake"):
            (self.tree / part).mkdir(parents=True)
            (self.tree / part / "file.txt").write_text(f"{part}\n")
        (self.tree / "CMakeLists.txt").write_text("project(x)\n")

    def git(self, *words, where=None):
        subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@b", "-C", where or self.tree, *words],
                       check=True, capture_output=True, env=ENVIRONMENT)

    def commit(self):
        self.git("init", "-q")
        self.git("add", ".")
        self.git("commit", "-q", "-m", "Tree: as it is")

    def version(self):
        output = self.folder / "version.cpp"
        subprocess.run([CMAKE, f"-DSOURCE={self.tree}", "-DVERSION=1.2.3", f"-DOUTPUT={output}", "-P",
                        SOURCE / "scripts" / "cmake" / "build_version.cmake"], check=True, env=ENVIRONMENT)
        found = re.search(r'return "1\.2\.3\+([^"]*)"', output.read_text()).group(1)
        before = output.stat().st_mtime_ns
        return found, before

    def test_a_commit(self):
        self.commit()
        clean, written = self.version()
        self.assertRegex(clean, "^g[0-9a-f]{12}$")
        self.assertEqual(self.version(), (clean, written), "written again though nothing changed")
        self.git("commit", "-q", "--allow-empty", "-m", "Tree: another")
        self.assertNotEqual(self.version()[0], clean)

    def test_a_dirty_tree(self):
        self.commit()
        clean = self.version()[0]
        seen = {clean}

        def differs(change):
            change()
            found = self.version()[0]
            self.assertRegex(found, f"^{clean}\\.dirty\\.[0-9a-f]{{12}}$")
            self.assertNotIn(found, seen)
            seen.add(found)

        file, added = self.tree / "core" / "file.txt", self.tree / "app" / "a new file"
        differs(lambda: file.write_text("one\n"))
        differs(lambda: file.write_text("two\n"))
        differs(lambda: added.write_text("one\n"))
        differs(lambda: added.write_text("two\n"))
        differs(lambda: self.git("add", "."))
        differs(lambda: file.unlink())
        self.git("reset", "-q", "--hard")
        added.unlink(missing_ok=True)
        (self.tree / "docs" / "file.txt").write_text("nothing that is compiled\n")
        self.assertEqual(self.version()[0], clean)

    def test_without_a_repository(self):
        """The sources are those of a tarball, although its user keeps them in another repository."""
        first = self.version()[0]
        self.assertRegex(first, "^s[0-9a-f]{12}$")
        self.git("init", "-q", where=self.folder)
        self.git("commit", "-q", "--allow-empty", "-m", "Mine: not theirs", where=self.folder)
        self.assertEqual(self.version()[0], first)
        (self.tree / "gpu_shaders" / "file.txt").write_text("other\n")
        self.assertRegex(self.version()[0], "^s[0-9a-f]{12}$")
        self.assertNotEqual(self.version()[0], first)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
