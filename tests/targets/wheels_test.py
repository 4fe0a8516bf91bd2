#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Are the programs in a wheel, and found as commands where pip has installed it?

wheels_test.py ROOT BUILD: packs what BUILD has in the place of what scripts/package/targets.sh builds."""

import csv
import email
import importlib.util
import io
import json
import os
import platform
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

ROOT, BUILD = (os.path.abspath(path) for path in sys.argv[1:3])
UBIQUITIN = "/usr/share/freesasa/test-data/1ubq.pdb"


def wheels_of(folder):
    """Returns scripts/package/wheels.py, which finds a target and licences in this folder."""
    spec = importlib.util.spec_from_file_location("wheels", os.path.join(ROOT, "scripts", "package", "wheels.py"))
    wheels = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(wheels)
    wheels.BUILT = folder
    wheels.PARTS = [("oneTBB", "Apache-2.0", "onetbb-*/LICENSE.txt")]
    licence = os.path.join(folder, "sources", "onetbb-2021.8.0", "LICENSE.txt")
    os.makedirs(os.path.dirname(licence))
    with open(licence, "w", encoding="utf-8") as file:
        file.write("a licence")
    return wheels


class Wheels(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.wheels = wheels_of(self.folder)

    def built(self, target):
        """Makes stand-ins for the files of a target: the programs of BUILD for this machine, text for other systems, and no library."""
        os.mkdir(os.path.join(self.folder, target))
        for path in self.wheels.programs(target).values():
            if target == platform.machine() + "-linux":
                shutil.copy(os.path.join(BUILD, os.path.basename(path)), path)
            else:
                with open(path, "w", encoding="utf-8") as file:
                    file.write(os.path.basename(path))
        with open(os.path.join(self.folder, target, self.wheels.TARGETS[target][1]), "wb"):
            pass

    def test_programs_are_commands_where_the_wheel_is_installed(self):
        target = platform.machine() + "-linux"
        self.built(target)
        wheel = self.wheels.pack(target, self.folder)
        venv = os.path.join(self.folder, "venv")
        subprocess.run([sys.executable, "-m", "venv", venv], check=True)
        subprocess.run([os.path.join(venv, "bin", "python"), "-m", "pip", "install", "-q", "--disable-pip-version-check", "--no-deps",
                        "--no-index", wheel], check=True)
        path = {**os.environ, "PATH": os.path.join(venv, "bin")}
        self.assertEqual(subprocess.run(["meniscus", "--version"], env=path, check=True, capture_output=True, text=True).stdout.split()[0],
                         "meniscus")
        names = subprocess.run(["meniscus-pdb_to_xyzrn", UBIQUITIN], env=path, check=True, capture_output=True).stdout
        self.assertEqual(names.split()[4:6], [b"1", b"N_MET_1"])
        spheres = subprocess.run(["meniscus-pdb_to_xyzr", UBIQUITIN], env=path, check=True, capture_output=True)
        areas = subprocess.run(["meniscus-msms", "-if", "-", "-surface", "ases"], env=path, check=True, capture_output=True,
                               input=spheres.stdout)
        self.assertIn(b"ANALYTICAL SURFACE AREA", areas.stdout)
        help_text = subprocess.run(["meniscus-nanoshaper", "--help"], env=path, check=True, capture_output=True)
        self.assertIn(b"NanoShaper", help_text.stdout)

    def test_each_file_is_in_the_record_and_programs_may_be_run(self):
        self.built("x86_64-windows")
        path = self.wheels.pack("x86_64-windows", self.folder)
        with zipfile.ZipFile(path) as wheel:
            info = {entry.filename: entry for entry in wheel.infolist()}
            record = wheel.read(f"{self.wheels.WHEEL}-{self.wheels.version()}.dist-info/RECORD").decode()
        self.assertEqual(sorted(row[0] for row in csv.reader(io.StringIO(record))), sorted(info))
        scripts = f"{self.wheels.WHEEL}-{self.wheels.version()}.data/scripts/"
        names = [name for name in info if name.startswith(scripts)]
        self.assertEqual([name.removeprefix(scripts) for name in sorted(names)],
                         ["meniscus-msms.exe", "meniscus-nanoshaper.exe", "meniscus-pdb_to_xyzr.exe", "meniscus-pdb_to_xyzrn.exe", "meniscus.exe"])
        for name in names:
            self.assertEqual(info[name].external_attr >> 16, 0o100755, name)

    def test_metadata_and_the_bill_of_materials_name_licences_and_origins(self):
        self.wheels.PARTS.append(("GLM", "MIT", "/usr/share/doc/libglm-dev/copyright"))
        self.built("x86_64-windows")
        with zipfile.ZipFile(self.wheels.pack("x86_64-windows", self.folder)) as wheel:
            info = f"{self.wheels.WHEEL}-{self.wheels.version()}.dist-info"
            metadata = email.message_from_bytes(wheel.read(f"{info}/METADATA"))
            bill = json.loads(wheel.read(f"{info}/sboms/meniscus.cdx.json"))
        self.assertEqual(metadata["License-Expression"], "BSD-3-Clause AND Apache-2.0 AND MIT")
        for field in ("Author", "Keywords", "Classifier", "Summary"):
            self.assertTrue(metadata[field], field)
        self.assertIn("pip install meniscus-ses", metadata.get_payload())
        self.assertNotRegex(metadata.get_payload(), r"\]\((?!https://)", "a link that leads nowhere from another site")
        origins = {part["name"]: part["purl"] for part in bill["components"]}
        self.assertEqual(origins["oneTBB"], "pkg:pypi/onetbb@2021.8.0")  # The name lacks the file of Debian's source, which names patches.
        self.assertRegex(origins["GLM"], r"pkg:deb/debian/libglm-dev@[0-9].*\?distro=bookworm")

    def test_the_package_says_so_where_another_project_has_its_name(self):
        site = os.path.join(self.folder, "site")
        shutil.copytree(self.wheels.PACKAGE, os.path.join(site, "meniscus"), ignore=shutil.ignore_patterns("__pycache__"))
        said = []
        for folder in ("meniscus_ses-0.2.0.dist-info", "meniscus-0.2.0.dist-info"):
            os.mkdir(os.path.join(site, folder))
            said.append(subprocess.run([sys.executable, "-B", "-c", "import meniscus"], env={**os.environ, "PYTHONPATH": site}, check=True,
                                       capture_output=True, text=True).stderr)
        self.assertEqual(said[0], "")
        self.assertIn("pip uninstall meniscus meniscus-ses", said[1])

    def test_the_same_files_give_the_same_bytes(self):
        self.built("aarch64-macos")
        written = []
        for _ in range(2):
            with open(self.wheels.pack("aarch64-macos", self.folder), "rb") as file:
                written.append(file.read())
        self.assertEqual(*written)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
