# SPDX-License-Identifier: BSD-3-Clause
"""installed_test.py BUILD EXAMPLE PROGRAM: the library as it is installed, used by a C program outside of the tree, through
pkg-config and through CMake; its numbers are the program's."""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

build, example, program = sys.argv[1:]
ATOMS = "".join(f"{1.5 * n} {0.3 * (n % 3)} {0.1 * n} {1.7 - 0.05 * (n % 4)}\n" for n in range(20))


def run(*command, **options):
    result = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options)
    assert result.returncode == 0, f"{command}\n{result.stdout}"
    return result.stdout


def measures(executable, environment):
    text = run(executable, input=ATOMS, env=environment)
    return [float(value) for value in re.search(r"area (\S+), volume (\S+),", text).groups()]


with tempfile.TemporaryDirectory() as folder:
    prefix, work = pathlib.Path(folder, "prefix"), pathlib.Path(folder, "work")
    work.mkdir()
    for component in ("libmeniscus", "libmeniscus-dev"):
        run("cmake", "--install", build, "--prefix", prefix, "--component", component)
    installed = sorted(str(p.relative_to(prefix)) for p in prefix.rglob("*") if not p.is_dir())
    libraries = next(prefix.rglob("libmeniscus.so")).parent
    environment = dict(os.environ, PKG_CONFIG_PATH=str(libraries / "pkgconfig"), LD_LIBRARY_PATH=str(libraries))

    # A prefix that is given when it is installed is not known when it is configured: pkg-config is told.
    flags = run("pkg-config", f"--define-variable=prefix={prefix}", f"--define-variable=libdir={libraries}",
                f"--define-variable=includedir={prefix}/include", "--cflags", "--libs", "meniscus",
                env=environment).split()
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
    print("\n".join(installed))
