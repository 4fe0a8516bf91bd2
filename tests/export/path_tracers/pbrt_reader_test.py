# SPDX-License-Identifier: BSD-3-Clause
"""pbrt_reader_test.py PROGRAM READER: the crate pbrt4 and our own grammar read the same statements in our scenes; the
last line says "cases N failures M"."""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from scene_files import pbrt_scene  # noqa: E402

PROGRAM, READER = sys.argv[1:3]
UBIQUITIN = "/usr/share/freesasa/test-data/1ubq.pdb"
NUMBER = re.compile(r"-?[0-9]+(?:\.[0-9]+)?(?:e-?[0-9]+)?")


class Reader(unittest.TestCase):
    def test_it_reads_the_same_statements(self):
        for options in ([], ["--projection", "orthographic", "--material", "plastic", "--sticks", "resname LYS"],
                        ["--material", "glass", "--spheres", "resid 1-5"], ["--material", "wax", "--opacity", "0.5"]):
            with self.subTest(options=options), tempfile.TemporaryDirectory() as folder:
                subprocess.run([PROGRAM, "export", "pbrt", UBIQUITIN, "-o", folder + "/s", "-q", "--tolerance", "0.3", *options],
                               check=True, stdout=subprocess.DEVNULL)
                path = pathlib.Path(folder, "s", "surface.pbrt")
                said = subprocess.run([READER, path], check=False, capture_output=True, text=True)
                self.assertEqual(said.returncode, 0, said.stdout[-300:])
                read = said.stdout.splitlines()
                ours, _ = pbrt_scene(path)
                self.assertEqual([line.split(" ")[0] for line in read], [name for name, _, _ in ours])
                self.assertGreater(len(read), 15)
                for line, (name, values, _) in zip(read, ours):
                    if name in ("Scale", "LookAt", "Translate", "ConcatTransform"):
                        np.testing.assert_allclose([float(n) for n in NUMBER.findall(line)], values, rtol=1e-6, atol=1e-7)


if __name__ == "__main__":
    result = unittest.main(argv=sys.argv[:1] + sys.argv[3:], exit=False).result
    print(f"cases {result.testsRun} failures {len(result.failures) + len(result.errors)}")
    sys.exit(not result.wasSuccessful())
