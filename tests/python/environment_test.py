# SPDX-License-Identifier: BSD-3-Clause
"""The Python package where something is missing or of another system: one sentence says what to do. Needs the
MENISCUS_PACKAGE and MENISCUS_LIBRARY of package_test.py."""
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile
from unittest import mock

PACKAGE, LIBRARY = pathlib.Path(os.environ["MENISCUS_PACKAGE"]), pathlib.Path(os.environ["MENISCUS_LIBRARY"])

sys.path.insert(0, str(PACKAGE))

from meniscus._library import why_not_loaded


def run(code, library=LIBRARY, package=PACKAGE, flags=("-B",), **options):
    """Runs a program in an interpreter of its own, with this library or, if None, the one that the package finds;
    returns its last line of errors."""
    environment = {**os.environ, "MENISCUS_LIBRARY": str(library or "")}
    ended = subprocess.run([sys.executable, *flags, "-c", f"import sys; sys.path.insert(0, {str(package)!r})\n{code}"],
                           text=True, capture_output=True, env=environment, **options)
    return ended.stderr.strip().splitlines()[-1] if ended.returncode else ""


def installed(folder, content):
    """Installs the package with its library in this folder, like a wheel."""
    shutil.copytree(PACKAGE / "meniscus", folder / "meniscus", ignore=shutil.ignore_patterns("__pycache__"))
    (folder / "meniscus" / "libmeniscus.so").write_bytes(content)


def elf_hash(name):
    """Returns the loader's hash of a version's name."""
    value = 0
    for byte in name.encode():
        value = (value << 4) + byte
        value = (value ^ (value >> 24 & 0xF0)) & 0x0FFFFFFF
    return value.to_bytes(4, "little")


class Missing(unittest.TestCase):
    def test_numpy(self):
        self.assertRegex(run("sys.modules['numpy'] = None\nimport meniscus"),
                         r"^ImportError: meniscus needs numpy \(.*numpy.*\): python -m pip install numpy$")

    def test_library(self):
        self.assertRegex(run("import meniscus; meniscus.version()", "/nowhere/libmeniscus.so"),
                         r"^ImportError: libmeniscus cannot be loaded: /nowhere/libmeniscus.so: .*No such file.*; "
                         "install it, or set MENISCUS_LIBRARY to its file$")

    def test_read_only_folders_are_enough(self):
        with tempfile.TemporaryDirectory() as name:  # The package writes nothing there.
            folder = pathlib.Path(name)
            installed(folder, LIBRARY.read_bytes())
            for path in (folder, folder / "meniscus"):
                path.chmod(0o555)
            user = {"user": "nobody", "cwd": "/"} if os.geteuid() == 0 else {}  # Root may write anywhere.
            before = sorted(folder.rglob("*"))
            code = "import meniscus; s = meniscus.surface([[0, 0, 0]], 1.7); s.mesh(); s.render(size='8x8', device='cpu')"
            self.assertEqual(run(code, None, folder, flags=(), **user), "")
            self.assertEqual(sorted(folder.rglob("*")), before)
            for path in (folder / "meniscus", folder):
                path.chmod(0o755)


@unittest.skipUnless(sys.platform == "linux", "the texts are those of Linux")
class Foreign(unittest.TestCase):
    def loaded(self, content):
        with tempfile.TemporaryDirectory() as folder:
            installed(pathlib.Path(folder), content)
            return run("import meniscus; meniscus.version()", None, folder)

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
        needed = re.search(rb"\0(libtbb\.so\.\d+|libm\.so\.6)\0", content)[1]
        missing = needed[:-1] + b"9"
        self.assertRegex(self.loaded(content.replace(needed, missing)),
                         rf"needs {re.escape(missing.decode())}, which is not installed: apt-get install ")

    def test_an_old_glibc(self):
        content = LIBRARY.read_bytes()
        needed = re.search(rb"\0(GLIBC_2\.\d\d)\0", content)[1].decode()
        newer = needed.replace("2.", "9.")
        content = content.replace(needed.encode(), newer.encode()).replace(elf_hash(needed), elf_hash(newer))
        self.assertRegex(self.loaded(content), rf"libmeniscus.so needs glibc {newer[6:]}, and this system has 2\.\d+: install")

    def test_another_c_library(self):
        text = "Error loading shared library ld-linux-x86-64.so.2: No such file or directory (needed by libmeniscus.so)"
        with mock.patch("platform.libc_ver", return_value=("", "")):  # musl's Python reports no version.
            self.assertRegex(why_not_loaded(str(LIBRARY), OSError(text)), "is for Linux with glibc, .* musl: build it here")

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
                ("libz.so.1: cannot open shared object file: No such file or directory", "apt-get install zlib1g"),
                ("x.so: something else", "^x.so: something else; install it, or set MENISCUS_LIBRARY to its file$")):
            self.assertRegex(why_not_loaded("x.so", OSError(text)), said)


@unittest.skipUnless(importlib.util.find_spec("pip"), "pip is not installed")
class Wheels(unittest.TestCase):
    """Names of wheels tell pip where they run; pip refuses all others."""

    def test_systems(self):
        with tempfile.TemporaryDirectory() as name:
            wheel = pathlib.Path(name, "meniscus_ses-1.0-py3-none-manylinux_2_28_x86_64.whl")
            with zipfile.ZipFile(wheel, "w") as file:
                for part, text in (("METADATA", "Metadata-Version: 2.1\nName: meniscus-ses\nVersion: 1.0\nRequires-Python: >=3.9\n"),
                                   ("WHEEL", "Wheel-Version: 1.0\nRoot-Is-Purelib: false\nTag: py3-none-manylinux_2_28_x86_64\n"),
                                   ("RECORD", "")):
                    file.writestr(f"meniscus_ses-1.0.dist-info/{part}", text)
            refused = "is not a supported wheel on this platform"
            for platform, python, said in (("manylinux_2_28_x86_64", "3.9", ""), ("manylinux_2_28_x86_64", "3.14", ""),
                                           ("musllinux_1_2_x86_64", "3.12", refused), ("manylinux_2_17_x86_64", "3.12", refused),
                                           ("manylinux_2_28_aarch64", "3.12", refused), ("win_amd64", "3.12", refused),
                                           ("manylinux_2_28_x86_64", "3.8", "requires a different Python")):
                ended = subprocess.run([sys.executable, "-m", "pip", "download", "-q", "--no-deps", "--no-index", "--only-binary=:all:",
                                        "--platform", platform, "--python-version", python, "-d", name, str(wheel)],
                                       text=True, capture_output=True)
                self.assertEqual(ended.returncode != 0, bool(said), (platform, python, ended.stderr))
                self.assertIn(said, ended.stderr)


if __name__ == "__main__":
    unittest.main()
