# SPDX-License-Identifier: BSD-3-Clause
"""installed_test.py BUILD EXAMPLE PROGRAM DOCUMENT: the library as it is installed, used outside of the tree by a C program,
whose numbers are the program's, and by the document's C++ program, whose numbers are as it says; both through pkg-config and
through CMake, with the shared library and with the archive."""
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
    """Returns the C++ program of the document, and its output by the comments at the ends of its lines."""
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
find_package(Meniscus 0.3 REQUIRED)
add_executable(balls balls.cpp)
target_link_libraries(balls PRIVATE Meniscus::cpp)
"""


def needs_library(executable):
    return "libmeniscus" in run("readelf", "-d", executable)


def say_what_the_loader_needs(prefix, work):
    """Checks that the installation names ldconfig where the loader searches the folder but lacks the library."""
    folder = next(prefix.rglob("libmeniscus.so")).parent
    lists, known = f"{folder}: (from its configuration)", f"libmeniscus.so.0 (libc6,x86-64) => {folder}/libmeniscus.so.0"
    for searched, cache, said in ((lists, "", True), (lists, known, False), ("/usr/lib: (from <builtin>)", "", False)):
        loader = work / "ldconfig"
        loader.write_text(f"#!/bin/sh\n[ \"$1\" = -p ] && echo ' {cache}' || echo '{searched}'\n")
        loader.chmod(0o755)
        text = run("cmake", "--install", build, "--prefix", prefix, "--component", "libmeniscus",
                   env=dict(os.environ, PATH=f"{work}:{os.environ['PATH']}"))
        assert ("run ldconfig" in text) == said, (searched, cache, text)


with tempfile.TemporaryDirectory() as folder:
    prefix, work = pathlib.Path(folder, "prefix"), pathlib.Path(folder, "work")
    work.mkdir()
    for component in ("libmeniscus", "libmeniscus-dev", "libmeniscus-static"):
        run("cmake", "--install", build, "--prefix", prefix, "--component", component)
    say_what_the_loader_needs(prefix, work)
    installed = sorted(str(p.relative_to(prefix)) for p in prefix.rglob("*") if not p.is_dir())
    libraries = next(prefix.rglob("libmeniscus.so")).parent
    os.environ["PKG_CONFIG_PATH"] = str(libraries / "pkgconfig")
    loader = dict(os.environ, LD_LIBRARY_PATH=str(libraries))
    text, told = document_program()
    (work / "cpp").mkdir()
    (work / "cpp/balls.cpp").write_text(text)
    (work / "cpp/CMakeLists.txt").write_text(CPP_PROJECT)

    def by_pkg_config(kind, *options):
        flags = run("pkg-config", *options, "--cflags", "--libs", "meniscus").split()
        run("cc", "-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror", f"{example}/areas.c", *flags, "-o", work / f"areas_{kind}")
        run("c++", "-std=c++20", "-Wall", "-Wextra", "-pedantic", "-Werror", work / "cpp/balls.cpp", *flags, "-o", work / f"balls_{kind}")
        return work / f"areas_{kind}", work / f"balls_{kind}"

    def by_cmake(kind, *options):
        for source, name in ((example, "areas"), (work / "cpp", "balls")):
            run("cmake", "-S", source, "-B", work / f"{name}_{kind}_build", f"-DCMAKE_PREFIX_PATH={prefix}", *options)
            run("cmake", "--build", work / f"{name}_{kind}_build")
        return work / f"areas_{kind}_build/areas", work / f"balls_{kind}_build/balls"

    shared = [by_pkg_config("shared"), by_cmake("shared")]
    static = [by_cmake("static", "-DMeniscus_USE_STATIC_LIBS=ON")]
    for file in [*libraries.glob("libmeniscus.so*"), *libraries.glob("cmake/Meniscus/MeniscusShared*")]:
        file.rename(work / file.name)  # Removed files act like ones that were not installed.
    static += [by_pkg_config("static", "--static"), by_cmake("archive_alone")]
    (libraries / "cmake/Meniscus/MeniscusStatic.cmake").unlink()
    nothing = subprocess.run(["cmake", "-S", example, "-B", work / "nothing", f"-DCMAKE_PREFIX_PATH={prefix}"], text=True,
                             capture_output=True)
    assert nothing.returncode and "libmeniscus.a is not installed" in nothing.stderr, nothing
    for file in work.glob("libmeniscus.so*"):
        file.rename(libraries / file.name)

    (work / "atoms.xyzr").write_text(ATOMS)
    report = json.loads(run(program, "surface", "-q", "--device", "cpu", "--json", work / "atoms.xyzr"))
    expected = [report["area"], report["volume"]]
    for pairs, environment in ((shared, loader), (static, None)):
        for areas, balls in pairs:
            assert needs_library(areas) == needs_library(balls) == (pairs is shared), areas
            found = measures(areas, environment)
            assert found == expected, f"{areas}: {found}, the program says {expected}"
            found = [float(word) for word in run(balls, env=environment).split()]
            assert agree(found, told), f"{balls}: {found}, the document says {told}"
    bad = subprocess.run(shared[0][0], input="0 0 0 -1\n", text=True, capture_output=True, env=loader)
    assert bad.returncode == 3 and "radius of atom 0 is -1" in bad.stderr, bad
    print("\n".join(installed))
