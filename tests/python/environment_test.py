# SPDX-License-Identifier: BSD-3-Clause
"""The Python package where something is missing or of another system: one sentence that says what to do. Needs the
MENISCUS_PACKAGE and MENISCUS_LIBRARY of package_test.py."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PACKAGE, LIBRARY = pathlib.Path(os.environ["MENISCUS_PACKAGE"]), pathlib.Path(os.environ["MENISCUS_LIBRARY"])

sys.path.insert(0, str(PACKAGE))

from meniscus._loading import why_not_loaded


def run(code, library=LIBRARY, package=PACKAGE):
    """Runs a program in an interpreter of its own; its last line of errors."""
    environment = {**os.environ, "MENISCUS_LIBRARY": str(library)}
    ended = subprocess.run([sys.executable, "-B", "-c", f"import sys; sys.path.insert(0, {str(package)!r})\n{code}"],
                           text=True, capture_output=True, env=environment)
    return ended.stderr.strip().splitlines()[-1] if ended.returncode else ""


class Missing(unittest.TestCase):
    def test_numpy(self):
        self.assertRegex(run("sys.modules['numpy'] = None\nimport meniscus"),
                         r"^ImportError: meniscus needs numpy \(.*numpy.*\): python -m pip install numpy$")

    def test_library(self):
        self.assertRegex(run("import meniscus; meniscus.version()", "/nowhere/libmeniscus.so"),
                         r"^ImportError: libmeniscus cannot be loaded \(/nowhere/libmeniscus.so: .*No such file.*\)")

    def test_read_only_folders_are_enough(self):
        with tempfile.TemporaryDirectory() as folder:  # nothing is written there
            shutil.copytree(PACKAGE / "meniscus", pathlib.Path(folder) / "meniscus",
                            ignore=shutil.ignore_patterns("__pycache__"))
            before = sorted(pathlib.Path(folder).rglob("*"))
            code = "import meniscus; s = meniscus.surface([[0, 0, 0]], 1.7); s.mesh(); s.render(size='8x8', device='cpu')"
            self.assertEqual(run(code, package=folder), "")
            self.assertEqual(sorted(pathlib.Path(folder).rglob("*")), before)


@unittest.skipUnless(sys.platform == "linux", "the texts are those of Linux")
class Foreign(unittest.TestCase):
    def loaded(self, content):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "libmeniscus.so"
            file.write_bytes(content)
            return run("import meniscus; meniscus.version()", file)

    def test_another_architecture(self):
        elf = bytearray(LIBRARY.read_bytes()[:4096])
        other = 62 if elf[18] != 62 else 183
        elf[18:20] = other.to_bytes(2, "little")
        name, here = {62: "x86_64", 183: "arm64"}[other], r"and this is Linux on \w+"
        self.assertRegex(self.loaded(elf), rf"libmeniscus.so is for Linux on {name}, {here}: install the package for")
        self.assertRegex(self.loaded(b"\xcf\xfa\xed\xfe" + bytes(4096)), f"is for macOS, {here}")
        self.assertRegex(self.loaded(b"MZ" + bytes(4096)), f"is for Windows, {here}")

    def test_a_damaged_file(self):
        for content in (b"", b"x", bytes(4096)):
            self.assertRegex(self.loaded(content), "libmeniscus.so is damaged, or not a library: install it again")

    def test_a_library_that_another_one_needs(self):
        content = LIBRARY.read_bytes()
        needed = re.search(rb"\0(libstdc\+\+\.so\.6|libm\.so\.6|libc\.so\.6)\0", content)[1]
        missing = needed[:-1] + b"9"
        self.assertRegex(self.loaded(content.replace(needed, missing)),
                         rf"needs {re.escape(missing.decode())}, which is not installed: apt-get install ")

    def test_another_library(self):
        self.assertRegex(run("import meniscus; meniscus.version()", "libm.so.6"),
                         r"^ImportError: libm.so.6 has no meniscus_\w+\(\): it is not libmeniscus, or of another version")

    def test_texts_of_the_loader(self):
        for text, said in (
                ("/lib/libc.so.6: version `GLIBC_2.38' not found (required by x.so)",
                 r"x.so needs glibc 2.38, and this system has 2\.\d+:"),
                ("/lib/libstdc++.so.6: version `GLIBCXX_3.4.32' not found (required by x.so)",
                 r"x.so needs a newer libstdc\+\+, with GLIBCXX_3.4.32"),
                ("libtbb.so.12: cannot open shared object file: No such file or directory",
                 "x.so needs libtbb.so.12, which is not installed: apt-get install libtbb12"),
                ("x.so: something else", "^x.so: something else$")):
            self.assertRegex(why_not_loaded("x.so", OSError(text)), said)


if __name__ == "__main__":
    unittest.main()
