# SPDX-License-Identifier: BSD-3-Clause
"""alone_test.py BUILD: the library without the programs. Configured without any of its parts it includes and links to
nothing but GLM, fmt, TBB and the system; each part says why it is not built; the programs refuse to do without most of
them. Nothing is compiled here: scripts/package/try_library.sh does that in a bare system."""
import json
import pathlib
import re
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PARTS = {"GEMMI": "gemmi (with PEGTL)", "ZLIB": "zlib", "GL": "epoxy", "JSON": "nlohmann_json", "DEFLATE": "libdeflate"}
INCLUDE = re.compile(r'^\s*#\s*include\s+([<"])([^>"]+)[>"]', re.M)
#: Matches code that is built with a part only, up to #else or #endif.
PART = re.compile(r"^#ifdef (MENISCUS_\w+)$.*?^#(?:else|endif)$", re.M | re.S)
FREE = {"glm", "fmt", "tbb"}
SYSTEM = {"cpuid.h", "stddef.h", "stdint.h", "sched.h", "fcntl.h", "unistd.h", "dlfcn.h", "sys/mman.h", "sys/resource.h", "sys/stat.h", "sys/types.h", "sys/sysinfo.h", "emmintrin.h", "immintrin.h",
          "malloc.h", "quadmath.h", "linux/fs.h", "mach-o/dyld.h", "sys/syscall.h", "errno.h"}


def configure(folder, *options):
    return subprocess.run(["cmake", "-S", str(ROOT), "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                           *options], text=True, capture_output=True)


def closure(commands):
    """Returns all headers of ours that compiled sources include, and others with the file that includes them."""
    ours, others, rest = set(), {}, [(pathlib.Path(command["file"]), command["command"].split()) for command in commands]
    while rest:
        file, words = rest.pop()
        if file in ours:
            continue
        ours.add(file)
        text = PART.sub(lambda part: part[0] if f"-D{part[1]}" in words else "", file.read_text())
        for kind, name in INCLUDE.findall(text):
            for place in (ROOT / name, file.parent / name):
                if place.is_file():
                    rest.append((place, words))
                    break
            else:
                if name != "meniscus/meniscus.h":
                    others.setdefault(name, file)
    return ours, others


def sources(folder):
    """Returns the commands that compile files of the repository."""
    commands = json.loads((pathlib.Path(folder) / "compile_commands.json").read_text())
    return [command for command in commands if not command["file"].startswith(folder)]


class Alone(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def test_needs_three_libraries(self):
        run = configure(self.folder, "-DMENISCUS_APP=OFF", "-DMENISCUS_UNITY=OFF",
                        *(f"-DMENISCUS_{part}=OFF" for part in PARTS))
        self.assertEqual(run.returncode, 0, run.stderr)
        for part in PARTS:
            self.assertRegex(run.stdout, f"no: MENISCUS_{part} is OFF")
        commands = sources(self.folder)
        files = [command["file"] for command in commands]
        self.assertGreater(len(files), 100)
        self.assertFalse([file for file in files if "/app/" in file])
        ours, others = closure(commands)
        self.assertGreater(len(ours), 250)
        foreign = {name: str(file.relative_to(ROOT)) for name, file in others.items()
                   if "." in name and name.split("/")[0] not in FREE and name not in SYSTEM
                   and not (pathlib.Path(self.folder) / "generated" / name).exists()}
        self.assertEqual(foreign, {})
        includes = " ".join(command["command"] for command in commands)
        self.assertNotRegex(includes, "gemmi|epoxy|hdf5|OpenImageIO|freetype")
        ninja = (pathlib.Path(self.folder) / "build.ninja").read_text()
        linked = re.search(r"build exporters/bindings/c/libmeniscus\.so\S*: .*?LINK_LIBRARIES = (.*?)\n", ninja, re.S).group(1)
        libraries = {pathlib.Path(word).name.split(".")[0] for word in linked.split() if ".so" in word or word.startswith("-l")}
        self.assertLessEqual(libraries, {"libtbb", "libfmt", "-ldl", "-lpthread"}, linked)

    def test_is_shared_or_an_archive(self):
        for option, made, not_made in (("ON", r"libmeniscus\.so", r"libmeniscus\.a"), ("OFF", r"libmeniscus\.a", r"libmeniscus\.so")):
            run = configure(self.folder, "-DMENISCUS_APP=OFF", f"-DBUILD_SHARED_LIBS={option}")
            self.assertEqual(run.returncode, 0, run.stderr)
            ninja = (pathlib.Path(self.folder) / "build.ninja").read_text()
            by_default = re.search(r"^build exporters/bindings/c/all: phony (.*)$", ninja, re.M)[1]
            self.assertRegex(by_default, made)
            self.assertNotRegex(by_default, not_made)

    def test_takes_what_is_there(self):
        run = configure(self.folder, "-DMENISCUS_APP=OFF", "-DMENISCUS_GL=OFF", "-DCMAKE_DISABLE_FIND_PACKAGE_ZLIB=ON")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertRegex(run.stdout, "no: zlib was not found")
        self.assertRegex(run.stdout, "no: MENISCUS_GL is OFF")
        self.assertRegex(run.stdout, r"yes, with gemmi \(with PEGTL\)")
        self.assertRegex(run.stdout, "programs: no: MENISCUS_APP is OFF")

    def test_has_the_drop_in_programs_where_they_are_asked_for(self):
        run = configure(self.folder, "-DMENISCUS_APP=OFF", "-DMENISCUS_DROP_INS=ON", "-DMENISCUS_UNITY=OFF")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertRegex(run.stdout, "programs: meniscus-msms, meniscus-nanoshaper and meniscus-pdb_to_xyzr alone")
        commands = json.loads((pathlib.Path(self.folder) / "compile_commands.json").read_text())
        folders = {pathlib.Path(command["file"]).relative_to(ROOT).parts[1] for command in commands
                   if command["file"].startswith(str(ROOT / "app"))}
        self.assertEqual(folders, {"msms", "process"})
        ninja = (pathlib.Path(self.folder) / "build.ninja").read_text()
        for program in ("meniscus-msms", "meniscus-nanoshaper", "meniscus-pdb_to_xyzr"):
            self.assertIn(f"build {program}: CXX_EXECUTABLE", ninja)

    def test_drop_in_programs_need_molecule_files(self):
        run = configure(self.folder, "-DMENISCUS_APP=OFF", "-DMENISCUS_DROP_INS=ON", "-DMENISCUS_GEMMI=OFF")
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("MENISCUS_DROP_INS needs gemmi (with PEGTL), for molecule files", " ".join(run.stderr.split()))

    def test_the_program_does_without_gl_and_modules(self):
        run = configure(self.folder, "-DMENISCUS_UNITY=OFF", "-DMENISCUS_TESTS=OFF",
                        *(f"-DMENISCUS_{part}=OFF" for part in ("GL", "IMAGES", "HDF5")))
        self.assertEqual(run.returncode, 0, run.stderr)
        for part in ("GL", "IMAGES", "HDF5"):
            self.assertRegex(run.stdout, f"no: MENISCUS_{part} is OFF")
        commands = sources(self.folder)
        files = [command["file"] for command in commands]
        self.assertIn(str(ROOT / "app/main.cpp"), files)
        foreign = {name for name in closure(commands)[1] if re.match("epoxy/|EGL/|GL/|OpenImageIO/|hdf5", name)}
        self.assertEqual(foreign, set())
        self.assertNotRegex(" ".join(command["command"] for command in commands), "epoxy|hdf5/|OpenImageIO")

    def test_the_preview_does_without_gl(self):
        run = configure(self.folder, "-DMENISCUS_UNITY=OFF", "-DMENISCUS_TESTS=OFF", "-DMENISCUS_GL=OFF")
        self.assertEqual(run.returncode, 0, run.stderr)
        commands = sources(self.folder)
        files = [command["file"] for command in commands]
        self.assertIn(str(ROOT / "app/preview/server/serve.cpp"), files)
        self.assertFalse({name for name in closure(commands)[1] if re.match("epoxy/|EGL/|GL/|GLFW/", name)})

    def test_says_what_the_program_can_be_built_without(self):
        run = configure(self.folder, "-DCMAKE_DISABLE_FIND_PACKAGE_OpenImageIO=ON")
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("The program can be built without it: -DMENISCUS_IMAGES=OFF", " ".join(run.stderr.split()))

    def test_programs_do_not_do_without(self):
        run = configure(self.folder, "-DCMAKE_DISABLE_FIND_PACKAGE_ZLIB=ON")
        self.assertNotEqual(run.returncode, 0)
        said = " ".join(run.stderr.split())
        self.assertIn("zlib was not found, which is needed for: molecule files packed with gzip", said)
        self.assertIn("-DMENISCUS_APP=OFF", said)


if __name__ == "__main__":
    unittest.main(argv=["alone_test.py"])
