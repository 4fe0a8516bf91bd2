# SPDX-License-Identifier: BSD-3-Clause
"""installed_test.py BUILD EXAMPLE PROGRAM DOCUMENT: the library as it is installed, used outside of the tree by a C program,
whose numbers are the program's, and by the document's C++ program, whose numbers are as it says; both through pkg-config and
through CMake."""
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

build, example, program, document = sys.argv[1:]
ATOMS = "".join(f"{1.5 * n} {0.3 * (n % 3)} {0.1 * n} {1.7 - 0.05 * (n % 4)}\n" for n in range(20))


def run(*command, **options):
    result = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options)
    assert result.returncode == 0, f"{command}\n{result.stdout}"
    return result.stdout


def measures(executable, environment):
    text = run(executable, input=ATOMS, env=environment)
    return [float(value) for value in re.search(r"area (\S+), volume (\S+),", text).groups()]


def document_program():
    """The C++ program of the document, and what it prints, by the comments at the ends of its lines."""
    text = re.search(r"```cpp\n(.*?)```", pathlib.Path(document).read_text(), re.S)[1]
    told = [float(number) for comment in re.findall(r"<<.*// ([-0-9., ]+)$", text, re.M) for number in comment.split(",")]
    pi = math.pi  # balls of 2 and 1 Å, then two of 2 Å, apart; points 5 Å from one centre, and in the other; pixels
    closed_forms = [20 * pi, 12 * pi, 16 * pi, 4 * pi, 3, -1, 16 * pi, 40]
    assert agree(told, closed_forms), told
    return text, told


def agree(found, told):
    return len(found) == len(told) and all(abs(one - other) < 0.006 for one, other in zip(found, told))


CPP_PROJECT = """cmake_minimum_required(VERSION 3.16)
project(balls LANGUAGES CXX)
find_package(Meniscus 0.1 REQUIRED)
add_executable(balls balls.cpp)
target_link_libraries(balls PRIVATE Meniscus::cpp)
"""

with tempfile.TemporaryDirectory() as folder:
    prefix, work = pathlib.Path(folder, "prefix"), pathlib.Path(folder, "work")
    work.mkdir()
    for component in ("libmeniscus", "libmeniscus-dev"):
        run("cmake", "--install", build, "--prefix", prefix, "--component", component)
    installed = sorted(str(p.relative_to(prefix)) for p in prefix.rglob("*") if not p.is_dir())
    libraries = next(prefix.rglob("libmeniscus.so")).parent
    environment = dict(os.environ, PKG_CONFIG_PATH=str(libraries / "pkgconfig"), LD_LIBRARY_PATH=str(libraries))

    flags = run("pkg-config", "--cflags", "--libs", "meniscus", env=environment).split()
    run("cc", "-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror", f"{example}/areas.c", *flags, "-o",
        work / "by_pkgconfig")
    run("cmake", "-S", example, "-B", work / "build", f"-DCMAKE_PREFIX_PATH={prefix}")
    run("cmake", "--build", work / "build")

    (work / "atoms.xyzr").write_text(ATOMS)
    told = json.loads(subprocess.run([program, "surface", "-q", "--device", "cpu", "--json", work / "atoms.xyzr"],
                                     check=True, capture_output=True, text=True).stdout)
    expected = [told["area"], told["volume"]]
    for executable in (work / "by_pkgconfig", work / "build" / "areas"):
        found = measures(executable, environment)
        assert found == expected, f"{executable.name}: {found}, the program says {expected}"
    bad = subprocess.run(work / "by_pkgconfig", input="0 0 0 -1\n", text=True, capture_output=True, env=environment)
    assert bad.returncode == 3 and "radius of atom 0 is -1" in bad.stderr, bad

    text, told = document_program()
    (work / "cpp").mkdir()
    (work / "cpp/balls.cpp").write_text(text)
    (work / "cpp/CMakeLists.txt").write_text(CPP_PROJECT)
    run("c++", "-std=c++20", "-Wall", "-Wextra", "-pedantic", "-Werror", work / "cpp/balls.cpp", *flags, "-o",
        work / "balls_by_pkgconfig")
    run("cmake", "-S", work / "cpp", "-B", work / "cpp/build", f"-DCMAKE_PREFIX_PATH={prefix}")
    run("cmake", "--build", work / "cpp/build")
    for executable in (work / "balls_by_pkgconfig", work / "cpp/build/balls"):
        found = [float(word) for word in run(executable, env=environment).split()]
        assert agree(found, told), f"{executable.name}: {found}, the document says {told}"
    print("\n".join(installed))
