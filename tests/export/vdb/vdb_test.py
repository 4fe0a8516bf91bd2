# SPDX-License-Identifier: BSD-3-Clause
"""vdb_test.py PROGRAM: level sets of `meniscus export vdb`, read by OpenVDB, against distances of libmeniscus."""

import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

import numpy as np

try:
    import pyopenvdb
except ImportError:
    print("python3-openvdb is not installed")
    sys.exit(77)
import meniscus

PROGRAM = sys.argv.pop(1)
UBIQUITIN = "/usr/share/freesasa/test-data/1ubq.pdb"
MODELS = "/usr/share/freesasa/test-data/1d3z.pdb"


class Vdb(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.room = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.room.name)
        cls.surface = meniscus.surface(meniscus.read(UBIQUITIN))

    @classmethod
    def tearDownClass(cls):
        cls.room.cleanup()

    def export(self, name, molecule, *words, code=0):
        done = subprocess.run([PROGRAM, "export", "vdb", molecule, "-o", str(self.folder / name), "--device", "cpu", "-q", *words],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def grid(self, name):
        return pyopenvdb.read(str(self.folder / name), "surface")

    def compare(self, grid, voxel, scale, surface):
        """Compares 1,000 voxels in the band with distances there, and 1,000 voxels outside of it by their signs."""
        self.assertAlmostEqual(grid.transform.voxelSize()[0], voxel * scale)
        chosen = random.Random(1)
        active = chosen.sample([(item.min, item.value) for item in grid.citerOnValues()], 1000)
        found = surface.distance(voxel * np.array([place for place, _ in active], dtype=float))
        np.testing.assert_allclose([value / scale for _, value in active], found, atol=1e-6)
        low, high = grid.evalActiveVoxelBoundingBox()
        at, beyond = grid.getConstAccessor(), []
        while len(beyond) < 1000:
            place = tuple(chosen.randint(a, b) for a, b in zip(low, high))
            value, is_active = at.probeValue(place)
            if not is_active:
                beyond.append((place, value))
        values = np.array([value for _, value in beyond])
        found = surface.distance(voxel * np.array([place for place, _ in beyond], dtype=float))
        np.testing.assert_allclose(np.abs(values), grid.background, rtol=1e-6)
        np.testing.assert_array_equal(values > 0, found > 0)
        self.assertGreaterEqual(np.abs(found).min(), grid.background / scale - 1e-6)
        self.assertGreater((values < 0).sum(), 20)

    def test_distances_and_signs(self):
        for voxel, band, scale in ((0.5, 3, 1.0), (0.8, 2, 0.1)):
            self.export("a.vdb", UBIQUITIN, "--voxel", str(voxel), "--band", str(band), "--scale", str(scale), "--force")
            grid = self.grid("a.vdb")
            self.assertEqual((grid.gridClass, grid.name), ("level set", "surface"))
            self.assertAlmostEqual(grid.background, voxel * band * scale, places=6)
            self.assertEqual(grid["file_voxel_count"], grid.activeVoxelCount())
            self.assertEqual((grid["file_bbox_min"], grid["file_bbox_max"]), grid.evalActiveVoxelBoundingBox())
            self.compare(grid, voxel, scale, self.surface)

    def test_its_zero_is_the_surface(self):
        """Points of OpenVDB's own mesh lie on the surface, about as far off as an edge of a voxel bends."""
        self.export("b.vdb", UBIQUITIN, "--voxel", "0.4")
        points, quads = self.grid("b.vdb").convertToQuads()
        off = np.abs(self.surface.distance(points.astype(float)))
        print(f"{len(points)} points, {len(quads)} quads: {off.mean():.4f} Å off in the mean, {off.max():.3f} Å at most")
        self.assertLess(off.mean(), 0.03)
        self.assertLess(off.max(), 0.4)
        a, b, c, d = (points[quads[:, k]].astype(float) for k in range(4))
        area = np.linalg.norm(np.cross(c - a, d - b), axis=1).sum() / 2
        self.assertAlmostEqual(area / self.surface.area, 1, delta=0.03)

    def test_a_run_has_a_file_a_frame(self):
        self.export("run_#.vdb", MODELS, "--frames", "0-2:2", "--voxel", "1", "--band", "2")
        self.assertEqual(sorted(path.name for path in self.folder.glob("run*")), ["run_0.vdb", "run_2.vdb"])
        for frame in (0, 2):
            self.compare(self.grid(f"run_{frame}.vdb"), 1, 1, meniscus.surface(meniscus.read(MODELS, model=frame + 1)))

    def test_what_cannot_be(self):
        self.assertIn("put # where", self.export("run.vdb", MODELS, "--frames", "0-2", code=2).stderr)
        self.assertIn("choose a larger --voxel", self.export("huge.vdb", UBIQUITIN, "--voxel", "0.01", "--band", "1000",
                                                             code=5).stderr)
        self.assertFalse((self.folder / "huge.vdb").exists())


unittest.main()
