# SPDX-License-Identifier: BSD-3-Clause
"""An installed program works in any folder: it finds its module and the Blender add-on from its own place."""

import json
import os
import re
import shutil
import unittest

from installation import BUILD, ROOT, Installation, run

TWO_MODELS = "".join(
    f"MODEL     {model:4d}\n"
    f"HETATM    1  C   LIG A   1      {model:6.3f}   0.000   0.000  1.00  0.00           C\n"
    f"HETATM    2  O   LIG A   1      {model + 1.2:6.3f}   0.000   0.000  1.00  0.00           O\n"
    "ENDMDL\n" for model in (1, 2))


class Installed(Installation):
    def setUp(self):
        self.molecule = self.folder / "two.pdb"
        self.molecule.write_text(TWO_MODELS)

    def test_it_is_the_program_that_was_built(self):
        built = self.good(BUILD / "meniscus", "--version").stdout
        self.assertEqual(self.good(self.program, "--version").stdout, built)
        here, there = (json.loads(self.good(program, "surface", self.molecule, "--device", "cpu", "--json").stdout)
                       for program in (BUILD / "meniscus", self.program))
        for surface in (here, there):
            del surface["stages"]  # Times of stages differ.
        self.assertEqual(here, there)

    def test_pictures_come_by_the_module_that_was_installed(self):
        picture = self.folder / "two.exr"
        loads = self.good(self.program, "render", self.molecule, "-o", picture, "--size", "40x30", "--device", "software",
                          "--force", env={"LD_DEBUG": "files", "PATH": "/usr/bin:/bin"}).stderr
        modules = set(re.findall(r"file=(\S*meniscus_openimageio\.so)", loads))
        self.assertEqual({os.path.normpath(name) for name in modules},
                         {str(self.prefix / "lib/meniscus/meniscus_openimageio.so")})
        self.assertEqual(picture.read_bytes()[:4], b"\x76\x2f\x31\x01")

    def test_bundles_for_blender_get_the_add_on_that_was_installed(self):
        elsewhere = self.folder / "elsewhere"
        shutil.copytree(self.prefix, elsewhere)
        driver = elsewhere / "share/meniscus/addon/render_mns.py"
        self.assertEqual(driver.read_bytes(), (ROOT / "exporters/blender/addon/render_mns.py").read_bytes())
        command = [elsewhere / "bin/meniscus", "farm", "bundle", self.folder / "job", "--chunk-frames", "1", "--",
                   "export", "blender", self.molecule, "--frames", "all"]
        self.good(*command)
        self.assertTrue((self.folder / "job/inputs/blender/render_mns.py").exists())
        driver.unlink()
        refused = run(*command[:4], "--force", *command[4:])
        self.assertEqual(refused.returncode, 3)
        self.assertIn(f"{elsewhere}/share/meniscus/addon", refused.stderr)

    def test_no_path_of_the_building_machine_is_written_into_texts(self):
        for path in self.prefix.rglob("*"):
            if path.is_file() and "share" in path.parts and path.suffix in {"", ".py", ".fish", ".json"}:
                self.assertNotIn(str(BUILD), path.read_text(errors="replace"), str(path))

    def test_what_makes_the_program_is_told(self):
        report = self.good(self.program, "--version", "--verbose").stdout
        for line in (r"^meniscus \d+\.\d+\.\d+\+\S+$", r"^compiler +\S+", r"^libraries +oneTBB \d+.*fmt \d+\.\d+",
                     r"^pictures +OpenImageIO \d+\.\d+\.\d+$", r"^GL +\d\.\d"):
            self.assertRegex(report, re.compile(line, re.M))


if __name__ == "__main__":
    unittest.main()
