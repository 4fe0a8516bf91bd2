#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the program calls by UTF-8 has that name for others, too, on Windows, which has a code page beside it.

wine_files_test.py ROOT FOLDER: as compile_test.py. Exit code 77 without wine."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import compile_test

ROOT, FOLDER = compile_test.ROOT, compile_test.FOLDER


class WineFiles(unittest.TestCase):
    def test_files_of_any_name(self):
        self.check()
        self.check(self.manifest(), "UTF-8")

    def manifest(self):
        """Returns the file that sets the code page of `meniscus` to UTF-8."""
        path = os.path.join(FOLDER, "windows.res")
        subprocess.run([compile_test.zig(), "rc", "app/process/windows.rc", path], cwd=ROOT, check=True, timeout=600)
        return path

    def check(self, *more):
        """Runs system_file_check.cpp, linked with the first of `more` and called with the rest."""
        program, headers = os.path.join(FOLDER, "system_file_check.exe"), os.path.join(FOLDER, "fmt_alone")
        shutil.copytree("/usr/include/fmt", os.path.join(headers, "fmt"), dirs_exist_ok=True)
        subprocess.run([compile_test.zig(), "c++", "-target", "x86_64-windows-gnu", "-std=c++20", "-O1", "-w", "-DFMT_HEADER_ONLY",
                        "-include", "core/base/windows_names.h", "-I", ".", "-isystem", headers, "-o", program,
                        "tests/targets/system_file_check.cpp", "core/base/system_file_windows.cpp", "core/base/output_file.cpp",
                        "core/base/text.cpp", *more[:1]], cwd=ROOT, check=True, timeout=1500)
        with tempfile.TemporaryDirectory() as folder:
            environment = {**os.environ, "LC_ALL": "C.UTF-8", "WINEPREFIX": os.path.join(FOLDER, "wine"), "WINEDEBUG": "-all"}
            done = subprocess.run(["wine", program, *more[1:]], cwd=folder, env=environment, timeout=600)
            self.assertEqual(done.returncode, 0, "the line of system_file_check.cpp")
            self.assertEqual(os.listdir(folder), ["Größe Å 分子 🧬.txt"])


if __name__ == "__main__":
    if not shutil.which("wine"):
        print("wine is not installed")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1], verbosity=2)
