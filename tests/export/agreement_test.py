# SPDX-License-Identifier: BSD-3-Clause
"""A run of frames shows the same surfaces in all renderers: PROGRAM ADDON BLENDER POVRAY SCRIPTS."""

import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM, ADDON, BLENDER, POVRAY, SCRIPTS = sys.argv[1:6]
sys.path.insert(0, SCRIPTS)
import compare_pictures  # noqa: E402

FRAMES = [0, 3, 6]  # frames of ten models of ubiquitin in solution; the camera turns
MOLECULE = ["/usr/share/freesasa/test-data/1d3z.pdb", "--select", "resi 1-20", "--frames", "0-6:3", "--superpose", "name CA",
            "--turntable", "0.1", "--device", "cpu", "--size", "200x150", "-q"]


class Agreement(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.folder = cls.holder.name

        def run(*command, **options):
            subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, **options)

        def path(name):
            return os.path.join(cls.folder, name)

        run(PROGRAM, "render", *MOLECULE, "--samples", "1", "--aovs", "-o", path("ray_#####.exr"))
        run(PROGRAM, "export", "povray", *MOLECULE, "-o", path("povray"))
        run(PROGRAM, "export", "blender", *MOLECULE, "--tolerance", "0.01", "-o", path("blender"))
        for frame in FRAMES:
            run(POVRAY, "surface.ini[normal]", f"+SF{frame}", f"+EF{frame}", "-D", "-V", cwd=path("povray"))
        run(BLENDER, "-b", "--factory-startup", "--python-exit-code", "3", "--python", os.path.join(ADDON, "render_mns.py"), "--",
            path("blender/surface_sequence.json"), "--passes", path("blender_#####.exr"))
        cls.ray = [compare_pictures.ray_cast_normals(path(f"ray_{frame:05d}.exr")) for frame in FRAMES]
        cls.others = {
            "POV-Ray": [compare_pictures.povray_normals(path(f"povray/surface_normal_{frame:05d}.png")) for frame in FRAMES],
            "Blender": [compare_pictures.blender_normals(path(f"blender_{frame:05d}.exr")) for frame in FRAMES]}

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    def test_every_frame_agrees_with_its_own_and_with_no_other(self):
        # POV-Ray has the exact patches; a mesh ends within its tolerance of them.
        limits = {"POV-Ray": (0.0005, 0.0005), "Blender": (0.003, 0.03)}
        for renderer, pictures in self.others.items():
            for n, picture in enumerate(pictures):
                for k, ray in enumerate(self.ray):
                    found = compare_pictures.differing_share(ray, picture)
                    outline = found["coverage"] / found["pixels"]
                    if n == k:
                        print(f"{renderer}, frame {FRAMES[n]}: {found}")
                        self.assertGreater(found["pixels"], 3000)
                        self.assertLessEqual(outline, limits[renderer][0], renderer)
                        self.assertLessEqual(found["share"], limits[renderer][1], renderer)
                    else:
                        self.assertGreater(found["share"], 0.3, (renderer, FRAMES[n], FRAMES[k]))


unittest.main(argv=["agreement_test"])
