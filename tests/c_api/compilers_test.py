# SPDX-License-Identifier: BSD-3-Clause
"""compilers_test.py ROOT: the headers, the example and the document's C++ program with the releases of GCC
and Clang that Debian 12 and 13 have, warnings being errors. A release that is not installed is a skipped test."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

BINDINGS = pathlib.Path(sys.argv[1], "exporters/bindings")
DOCUMENT = pathlib.Path(sys.argv[1], "docs/reference/library.md")
COMPILERS = {"gcc": ("g++", (11, 12, 13, 14)), "clang": ("clang++", (13, 14, 15, 16, 17, 18, 19))}
STRICT = ("-fsyntax-only", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror", f"-I{BINDINGS}/c/include",
          f"-I{BINDINGS}/cpp/include")


def initialized():
    """Returns a program in C and C++ that initializes a struct by each MENISCUS_..._INIT of the header."""
    names = re.findall(r"^#define (MENISCUS_(\w+)_INIT)\b", (BINDINGS / "c/include/meniscus/meniscus.h").read_text(), re.M)
    assert len(names) >= 4, names
    lines = [f"  meniscus_{name.lower()} {name.lower()} = {macro};" for macro, name in names]
    used = " + ".join(f"{name.lower()}.size" for _, name in names)
    return "\n".join(["#include <meniscus/meniscus.h>", "int main(void) {", *lines, f"  return {used} == 0;", "}", ""])


class Compilers(unittest.TestCase):
    def compiled(self, compiler, standard, source):
        done = subprocess.run([compiler, f"-std={standard}", *STRICT, source], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, f"{compiler} -std={standard} {source}\n{done.stderr}")

    def check(self, c, cpp):
        for compiler in (c, cpp):
            if not shutil.which(compiler):
                self.skipTest(f"{compiler} is not installed")
        with tempfile.TemporaryDirectory() as folder:
            programs = {name: pathlib.Path(folder, name) for name in ("initialized.c", "initialized.cpp", "balls.cpp")}
            programs["initialized.c"].write_text(initialized())
            programs["initialized.cpp"].write_text(initialized())
            programs["balls.cpp"].write_text(re.search(r"```cpp\n(.*?)```", DOCUMENT.read_text(), re.S)[1])
            for standard in ("c99", "c11", "c17"):
                self.compiled(c, standard, BINDINGS / "c/example/areas.c")
                self.compiled(c, standard, programs["initialized.c"])
            for standard in ("c++11", "c++17", "c++20"):
                self.compiled(cpp, standard, programs["initialized.cpp"])
            self.compiled(cpp, "c++20", programs["balls.cpp"])


for kind, (cpp_name, releases) in COMPILERS.items():
    for release in releases:
        setattr(Compilers, f"test_{kind}_{release}",
                lambda self, c=f"{kind}-{release}", cpp=f"{cpp_name}-{release}": self.check(c, cpp))

if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
