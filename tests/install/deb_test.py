# SPDX-License-Identifier: BSD-3-Clause
"""The Debian packages: lintian finds nothing, they depend on what they load, and hold what belongs to them, with modes
times that do not depend on who made them, and when."""

import configparser
import pathlib
import re
import shutil
import sysconfig
import tempfile
import unittest
import xml.etree.ElementTree as xml

from installation import BUILD, ROOT, run

LIBRARIES = f"usr/lib/{sysconfig.get_config_var('MULTIARCH')}"
HOLDS = {
    "meniscus": {"usr/bin/meniscus", "usr/lib/meniscus/meniscus_openimageio.so", "usr/lib/meniscus/meniscus_hdf5.so",
                 "usr/share/man/man1/meniscus.1.gz", "usr/bin/meniscus-msms", "usr/bin/meniscus-nanoshaper", "usr/bin/meniscus-pdb_to_xyzr",
                 "usr/bin/meniscus-pdb_to_xyzrn", "usr/share/man/man1/meniscus-msms.1.gz",
                 "usr/share/meniscus/addon/render_mns.py", "usr/share/meniscus/meniscus_plugin.py",
                 "usr/share/applications/meniscus.desktop", "usr/share/icons/hicolor/scalable/apps/meniscus.svg",
                 "usr/share/metainfo/invalid.meniscus.meniscus.metainfo.xml"},
    "libmeniscus0": {f"{LIBRARIES}/libmeniscus.so.0", f"{LIBRARIES}/libmeniscus.so.{{version}}"},
    "libmeniscus-dev": {"usr/include/meniscus/meniscus.h", "usr/include/meniscus/meniscus.hpp",
                        f"{LIBRARIES}/libmeniscus.so", f"{LIBRARIES}/pkgconfig/meniscus.pc",
                        f"{LIBRARIES}/cmake/Meniscus/MeniscusConfig.cmake"},
    "python3-meniscus": {f"usr/lib/python3/dist-packages/meniscus/{path.name}"
                         for path in (ROOT / "exporters/bindings/python/meniscus").iterdir() if path.is_file()}
                        | {"usr/lib/python3/dist-packages/meniscus_ses-{version}.dist-info/METADATA"},
    "meniscus-doc": {"usr/share/doc/meniscus/docs/index.md", "usr/share/doc/meniscus/docs/gallery/pocket.jpg"},
}


def pack(folder, **options):
    return run("bash", ROOT / "scripts/package/debian.sh", folder, BUILD, **options)


def fields(package):
    lines = run("dpkg-deb", "-f", package).stdout.splitlines()
    return dict(line.split(": ", 1) for line in lines if line[:1] != " " and ": " in line)


def listed(package):
    """Returns mode and owner of each file and folder by its path."""
    rows = (line.split(None, 5) for line in run("dpkg-deb", "-c", package).stdout.splitlines())
    return {path.split(" -> ")[0].removeprefix("./").rstrip("/"): (mode, owner) for mode, owner, _, _, _, path in rows}


@unittest.skipUnless(shutil.which("dh"), "debhelper is not installed")
class DebianPackages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        done = pack(folder.name, umask=0o077)
        assert done.returncode == 0, done.stdout + done.stderr
        cls.packages = {path.name.split("_")[0]: path for path in pathlib.Path(folder.name).glob("*.deb")}
        cls.revision = fields(cls.packages["meniscus"])["Version"]
        cls.version = cls.revision.rpartition("-")[0]

    def test_program_library_headers_python_and_manual_have_their_packages(self):
        self.assertEqual(set(self.packages), set(HOLDS))

    def test_the_program_depends_on_libraries_and_only_recommends_other_programs(self):
        told = fields(self.packages["meniscus"])
        for name in ("libtbb12", r"libopenimageio2\.\d", "libegl1", "libepoxy0", "libtiff6"):
            self.assertRegex(told["Depends"], rf"\b{name}\b")
        self.assertNotIn("blender", told["Depends"])
        for name in ("ffmpeg", "povray", "blender"):
            self.assertIn(name, told["Recommends"])

    def test_the_library_depends_on_little_and_works_without_gl(self):
        needed = {re.sub(r"libfmt\d+", "libfmt", entry.split()[0]) for entry in fields(self.packages["libmeniscus0"])["Depends"].split(", ")}
        # zlib1g reads .gz files of molecules.
        self.assertEqual(needed, {"libc6", "libepoxy0", "libfmt", "libfreetype6", "libgcc-s1", "libstdc++6", "libtbb12", "zlib1g"})

    def test_what_uses_the_library_depends_on_it(self):
        self.assertEqual(fields(self.packages["libmeniscus-dev"])["Depends"], f"libmeniscus0 (= {self.revision})")
        told = fields(self.packages["python3-meniscus"])
        self.assertEqual(told["Architecture"], "all")
        self.assertLessEqual({"python3-numpy", f"libmeniscus0 (>= {self.version})"}, set(told["Depends"].split(", ")))

    def test_packages_of_programs_that_are_linked_to_the_library_will_depend_on_it(self):
        shlibs = run("dpkg-deb", "-I", self.packages["libmeniscus0"], "shlibs").stdout
        self.assertEqual(shlibs, f"libmeniscus 0 libmeniscus0 (>= {self.version})\n")
        triggers = run("dpkg-deb", "-I", self.packages["libmeniscus0"], "triggers").stdout
        self.assertIn("\nactivate-noawait ldconfig\n", triggers)

    def test_its_symbols_are_the_functions_of_the_header(self):
        header = (ROOT / "exporters/bindings/c/include/meniscus/meniscus.h").read_text()
        title, *rows = run("dpkg-deb", "-I", self.packages["libmeniscus0"], "symbols").stdout.splitlines()
        self.assertEqual(title, "libmeniscus.so.0 libmeniscus0 #MINVER#")
        self.assertEqual({row.split("@")[0].strip() for row in rows} - {"MENISCUS_0"},
                         set(re.findall(r"^MENISCUS_API [^;(]*?\b(meniscus_\w+)\(", header, re.M)))

    def test_each_holds_what_belongs_to_it(self):
        owners = {}
        for name, expected in HOLDS.items():
            files = {path for path, (mode, _) in listed(self.packages[name]).items() if mode[0] != "d"}
            expected = {path.format(version=self.version) for path in expected}
            papers = {f"usr/share/doc/{name}/copyright", f"usr/share/doc/{name}/changelog.gz", f"usr/share/doc/{name}/changelog.Debian.gz"}
            self.assertLessEqual(expected | papers, files, name)
            if name not in ("meniscus", "meniscus-doc"):  # which also have pages, documents, completions
                extra = {path for path in files - expected - papers if "/cmake/Meniscus/" not in path
                         and not path.endswith("/INSTALLER")}  # dh_python3 of Debian 13 adds it
                self.assertEqual(extra, set(), name)
            for path in files:
                self.assertEqual(owners.setdefault(path, name), name, path)

    def unpacked(self, name):
        """Returns the folder of the files of a package."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.assertEqual(run("dpkg-deb", "-x", self.packages[name], folder.name).returncode, 0)
        return pathlib.Path(folder.name)

    def test_the_licences_of_what_is_compiled_in_are_named(self):
        for name in ("meniscus", "libmeniscus0"):
            text = (self.unpacked(name) / f"usr/share/doc/{name}/copyright").read_text()
            for words in ("Copyright (c) 2026, the Meniscus developers", "GNU General Public License", "gemmi-dev", "Mozilla Public License",
                          "libcli11-dev", "libglm-dev", "nlohmann-json3-dev", "libdeflate-dev", "fonts-liberation2", "SIL O"):
                self.assertIn(words.lower(), text.lower(), name)

    def test_no_file_knows_the_folder_of_the_sources(self):
        for name in self.packages:
            for path in self.unpacked(name).rglob("*"):
                if path.is_file() and not path.is_symlink():
                    self.assertNotIn(f"{ROOT}/".encode(), path.read_bytes(), path)

    def test_programs_are_not_linked_with_the_folder_of_the_build(self):
        """A path that is removed when a program is installed leaves room as long as it was."""
        for name in ("meniscus", "meniscus-msms", "meniscus-nanoshaper", "meniscus-pdb_to_xyzr"):
            self.assertNotIn(str(BUILD), run("readelf", "-d", BUILD / name).stdout, name)

    def test_made_again_elsewhere_a_package_has_the_same_bytes(self):
        with tempfile.TemporaryDirectory() as folder:
            done = pack(folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            for package in self.packages.values():
                self.assertEqual((pathlib.Path(folder) / package.name).read_bytes(), package.read_bytes(), package.name)

    def test_file_managers_offer_the_preview_for_molecules(self):
        share = self.unpacked("meniscus") / "usr/share"
        entry, about = share / "applications/meniscus.desktop", next((share / "metainfo").iterdir())
        for tool in (("desktop-file-validate", entry), ("appstreamcli", "validate", "--no-net", about)):
            if shutil.which(tool[0]):
                done = run(*tool)
                rows = [row for row in (done.stdout + done.stderr).splitlines() if row and not row.startswith(("I:", "✘", "✔"))]
                self.assertEqual([row for row in rows if "url-homepage-missing" not in row], [])  # there is none yet
        desktop = configparser.ConfigParser(interpolation=None)
        desktop.read(entry)
        desktop, types = desktop["Desktop Entry"], {row.text for row in xml.parse(about).iter("mediatype")}
        self.assertEqual(set(desktop["MimeType"].rstrip(";").split(";")), types)
        self.assertEqual(run(BUILD / "meniscus", *desktop["Exec"].replace("%f", "--help").split()[1:]).returncode, 0)
        self.assertTrue((share / f"icons/hicolor/scalable/apps/{desktop['Icon']}.svg").exists())

    def test_binaries_are_bound_at_start(self):
        for name in ("meniscus", "libmeniscus0"):
            files = [path for path in self.unpacked(name).rglob("*") if path.is_file() and not path.is_symlink()]
            binaries = [path for path in files if path.read_bytes()[:4] == b"\x7fELF"]
            self.assertTrue(binaries, name)
            for path in binaries:
                dynamic = run("readelf", "-d", path).stdout
                self.assertRegex(dynamic, r"BIND_NOW|Flags: .*NOW", path)
                self.assertNotIn("RUNPATH", dynamic, path)

    def test_the_program_offers_itself_as_msms(self):
        for script, action in (("postinst", "--install /usr/bin/msms msms /usr/bin/meniscus-msms"),
                               ("prerm", "--remove msms /usr/bin/meniscus-msms")):
            text = run("dpkg-deb", "-I", self.packages["meniscus"], script).stdout
            self.assertIn(f"update-alternatives {action}", text)

    def test_modes_do_not_depend_on_who_made_them(self):
        for name, package in self.packages.items():
            for path, (mode, owner) in listed(package).items():
                executable = path.startswith("usr/bin/")
                expected = {"d": "drwxr-xr-x", "l": "lrwxrwxrwx", "-": "-rwxr-xr-x" if executable else "-rw-r--r--"}
                self.assertEqual((mode, owner), (expected[mode[0]], "root/root"), f"{name}: {path}")

    @unittest.skipUnless(shutil.which("lintian"), "lintian is not installed")
    def test_lintian_has_nothing_to_say(self):
        checked = run("lintian", "--allow-root", *self.packages.values())
        rows = (checked.stdout + checked.stderr).splitlines()
        # From Debian 13 on lintian runs appstreamcli, which another test does.
        self.assertEqual([row for row in rows if "appstream-metadata-validation-failed" not in row], [])


if __name__ == "__main__":
    unittest.main()
