#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Do the files that ask the system, the compiler or the processor for something compile for every target?

compile_test.py ROOT FOLDER [--few]: zig is installed into FOLDER, from PyPI. scripts/package/targets.sh builds and runs all the
rest. --few: one target of each system, and only the files that differ most."""

import os
import shutil
import subprocess
import sys
import unittest

ROOT, FOLDER = (os.path.abspath(path) for path in sys.argv[1:3])
FEW = sys.argv[3:] == ["--few"]
TARGETS = ("aarch64-linux-gnu.2.28", "x86_64-windows-gnu", "aarch64-macos.13.0") if FEW else (
    "x86_64-linux-gnu.2.28", "aarch64-linux-gnu.2.28", "x86_64-windows-gnu", "aarch64-macos.13.0", "x86_64-macos.13.0")
FILES = ["core/surface/fixed_probes.cpp"] if FEW else [
    "app/film/film.cpp", "app/process/program_main.cpp", "core/base/output_file.cpp", "core/reduced_surface/contour/contour.cpp",
    "core/surface/fixed_probes.cpp", "core/render/cpu/lanes_16.cpp"]
#: Each file exists for Windows and for the others.
BY_SYSTEM = ["app/msms/local_socket_{}.cpp", "app/process/child_process_{}.cpp", "app/process/system_process_{}.cpp",
             "core/base/system_file_{}.cpp"]
#: Headers that are the same on every system.
HEADERS = ["fmt", "glm", "oneapi", "tbb"]


def zig():
    venv = os.path.join(FOLDER, "zig")
    python = os.path.join(venv, "bin", "python")
    if not os.path.exists(python):
        subprocess.run([sys.executable, "-m", "venv", venv], check=True)
    subprocess.run([python, "-m", "pip", "install", "-q", "--disable-pip-version-check", "ziglang==0.15.2"], check=True)
    where = "import os, ziglang; print(os.path.join(os.path.dirname(ziglang.__file__), 'zig'))"
    return subprocess.run([python, "-c", where], check=True, capture_output=True, text=True).stdout.strip()


class Compile(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.zig = zig()
        cls.include = os.path.join(FOLDER, "include")
        for name in HEADERS:
            shutil.copytree(os.path.join("/usr/include", name), os.path.join(cls.include, name), dirs_exist_ok=True)

    def compile(self, target, *files):
        windows = ("-include", os.path.join(ROOT, "core/base/windows_names.h")) if "windows" in target else ()
        for file in files:
            result = subprocess.run(
                [self.zig, "c++", "-target", target, "-std=c++20", "-c", "-o", os.path.join(FOLDER, "made.o"), "-Wall", "-Wextra", "-Werror",
                 *windows,
                 "-DGLM_FORCE_XYZW_ONLY", "-DMENISCUS_BUILDS_LIBRARY", "-I", ROOT, "-isystem", self.include,
                 "-I", os.path.join(ROOT, "exporters/bindings/c/include"), os.path.join(ROOT, file)],
                capture_output=True, text=True, timeout=600)
            self.assertEqual(result.returncode, 0, f"{file} for {target}:\n{result.stderr[-4000:]}")

    def test_every_target(self):
        for target in TARGETS:
            system = "windows" if "windows" in target else "posix"
            with self.subTest(target=target):
                self.compile(target, *FILES, *(name.format(system) for name in BY_SYSTEM))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
