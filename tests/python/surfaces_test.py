# SPDX-License-Identifier: BSD-3-Clause
"""Numbers, defaults and arrays of a surface."""
import gc
import inspect
import math
import pathlib
import subprocess
import unittest

import numpy as np

from package_case import PROGRAM, chain, cloud
import meniscus
from meniscus import _header, _library


class Numbers(unittest.TestCase):
    def test_one_sphere(self):
        for kind, radius in (("ses", 1.7), ("sas", 3.1), ("vdw", 1.7)):
            s = meniscus.surface([[1, 2, 3]], 1.7, kind=kind)
            self.assertAlmostEqual(s.area, 4 * math.pi * radius**2, 10)
            self.assertAlmostEqual(s.volume, 4 / 3 * math.pi * radius**3, 10)
            self.assertEqual(s.kind, kind)
        self.assertEqual(len(s), 1)

    @unittest.skipUnless(PROGRAM, "MENISCUS_PROGRAM is not set")
    def test_the_program_says_the_same_to_the_last_digit(self):
        import json
        xyz, radii = cloud(200, 1)
        lines = "".join(f"{x!r} {y!r} {z!r} {r!r}\n" for (x, y, z), r in zip(xyz.tolist(), radii.tolist()))
        told = json.loads(subprocess.run([PROGRAM, "surface", "-q", "--device", "cpu", "--json", "-"], input=lines,
                                         text=True, check=True, capture_output=True).stdout)
        s = meniscus.surface(xyz, radii)
        self.assertEqual((s.area, s.volume), (told["area"], told["volume"]))

    def test_sums(self):
        xyz, radii = cloud(150, 2)
        s = meniscus.surface(xyz, radii, probe=1.2)
        self.assertAlmostEqual(s.atom_areas.sum(), s.area, 6)
        self.assertAlmostEqual(s.components["area"].sum(), s.area, 6)
        self.assertAlmostEqual(s.components["volume"].sum(), s.volume, 6)
        self.assertAlmostEqual(s.faces["area"].sum(), s.area, 6)
        self.assertAlmostEqual(s.atom_sas_areas.sum(), meniscus.surface(xyz, radii, 1.2, kind="sas").area, 5)
        self.assertEqual(s.counts["components"], len(s.components))
        self.assertEqual(s.counts["cavities"], int((s.components["kind"] == 1).sum()))
        patches = s.patches
        self.assertEqual(len(patches.toroidal), s.counts["toroidal"])
        self.assertTrue((patches.contacts < 150).all())
        axes = patches.toroidal["axis"]
        np.testing.assert_allclose(np.linalg.norm(axes, axis=1), 1.0, atol=1e-12)

    def test_types_and_strides_of_arrays(self):
        xyz, radii = chain(20)
        xyz = np.round(xyz * 16) / 16  # These values fit floats exactly.
        expected = meniscus.surface(xyz, radii).area
        wide = np.zeros((20, 5))
        wide[:, 1:4] = xyz
        for given in (xyz.tolist(), xyz.astype(np.float32), wide[:, 1:4], np.asfortranarray(xyz),
                      np.repeat(xyz, 2, axis=0)[::2], xyz[::-1][::-1]):
            self.assertEqual(meniscus.surface(given, radii).area, expected)

    def test_gradients(self):
        xyz, radii = cloud(60, 4)
        motion = np.random.default_rng(5).normal(size=xyz.shape)
        s = meniscus.surface(xyz, radii)
        for of, value in (("area", lambda s: s.area), ("volume", lambda s: s.volume),
                          ("sas_area", lambda s: s.atom_sas_areas.sum())):
            def at(t):
                return value(meniscus.surface(xyz + t * motion, radii))
            h = 1e-5
            expected = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h)
            gradient = s.gradient(of)
            self.assertEqual(gradient.shape, (60, 3))
            self.assertAlmostEqual((gradient * motion).sum() / expected, 1.0, 5, of)
            np.testing.assert_allclose(gradient.sum(axis=0), 0.0, atol=1e-9)
        np.testing.assert_allclose(s.gradient("sas_area", np.full(60, 2.0)), 2 * s.gradient("sas_area"), atol=1e-12)
        np.testing.assert_allclose(meniscus.surface(xyz, radii, kind="sas").gradient("volume"),
                                   s.gradient("sas_volume"), atol=1e-9)
        for wrong in (lambda: s.gradient("mass"), lambda: s.gradient("area", np.ones(60)),
                      lambda: s.gradient("sas_area", np.ones(3)), lambda: s.gradient("sas_area", np.full(60, np.nan)),
                      lambda: meniscus.surface([[0, 0, 0]], 1.7, kind="vdw").gradient("sas_area")):
            self.assertRaises(meniscus.Error, wrong)
        square = meniscus.surface([[0, 0, 0], [3.4, 0, 0], [3.4, 3.4, 0], [0, 3.4, 0]], 1.7)
        self.assertRaisesRegex(meniscus.InputError, "4 atoms at once", square.gradient, "volume")
        square.gradient("sas_area")

    @unittest.skipUnless(PROGRAM, "MENISCUS_PROGRAM is not set")
    def test_pockets_are_those_of_the_program(self):
        import json
        xyz, radii = cloud(600, 6)
        xyz *= 1.25
        lines = "".join(f"{x!r} {y!r} {z!r} {r!r}\n" for (x, y, z), r in zip(xyz.tolist(), radii.tolist()))
        told = json.loads(subprocess.run([PROGRAM, "pockets", "-q", "--device", "cpu", "--ligand", "none", "--trim", "0.5", "--json", "-"],
                                         input=lines, text=True, check=True, capture_output=True).stdout)["pockets"]
        found = meniscus.surface(xyz, radii).pockets(trim=0.5)
        gc.collect()
        self.assertGreater(len(told), 0)
        self.assertEqual(len(found), len(told))
        for pocket, expected in zip(found, told):
            self.assertIsInstance(pocket, meniscus.Pocket)
            self.assertEqual((pocket.kind, pocket.volume, pocket.volume_excess, pocket.area, pocket.depth),
                             tuple(expected[key] for key in ("kind", "volume", "volume_excess_at_most", "area", "depth")))
            self.assertAlmostEqual(pocket.wall_area, expected["wall_area"], 9)
            self.assertEqual(pocket.mouth_areas.tolist(), expected["mouth_areas"])
            self.assertEqual(pocket.middle.tolist(), expected["middle"])
            self.assertEqual(pocket.atoms.tolist(), expected["atoms"])
            np.testing.assert_allclose(pocket.probes.mean(axis=0), expected["middle"], atol=1e-9)
            self.assertFalse(pocket.atoms.flags.writeable)
        self.assertEqual(meniscus.surface(xyz, radii).pockets(min_volume=1e8), [])
        for wrong in ({"large_probe": 1.0}, {"trim": -1}, {"mouth_tolerance": 0}, {"min_volume": math.nan}):
            self.assertRaisesRegex(meniscus.InputError, list(wrong)[0], meniscus.surface(xyz, radii).pockets, **wrong)
        self.assertRaises(meniscus.UsageError, meniscus.surface(xyz, radii, kind="sas").pockets)

    def test_distance(self):
        xyz, radii = chain(12)
        s = meniscus.surface(xyz, radii)
        mesh = s.mesh(0.05)
        np.testing.assert_allclose(s.distance(mesh.vertices), 0.0, atol=1e-12)
        self.assertTrue((s.distance(xyz) < 0).all())
        out, feet = s.distance(xyz + [0, 30, 0], nearest=True)
        self.assertTrue((out > 0).all())
        np.testing.assert_allclose(np.linalg.norm(xyz + [0, 30, 0] - feet, axis=1), out, atol=1e-12)
        self.assertEqual(s.distance(np.empty((0, 3))).shape, (0,))

    def test_radii(self):
        np.testing.assert_array_equal(meniscus.radii_of(["C", "zn", "D", 8]), [1.7, 1.39, 1.2, 1.52])
        with self.assertRaisesRegex(meniscus.InputError, "atom 1: 'Qq' is not an element"):
            meniscus.radii_of(["C", "Qq"])


class Defaults(unittest.TestCase):
    def test_signatures_have_those_of_the_library(self):
        def usual(function, name):
            return inspect.signature(function).parameters[name].default
        self.assertEqual(usual(meniscus.Surface.mesh, "tolerance"), _library.default("mesh_options", _header.MeshOptions()).tolerance)
        pockets = _library.default("pocket_options", _header.PocketOptions())
        for name in ("trim", "min_volume", "mouth_tolerance"):
            self.assertEqual(usual(meniscus.Surface.pockets, name), getattr(pockets, name), name)


class Views(unittest.TestCase):
    def test_keep_their_owner_and_their_frame(self):
        xyz, radii = cloud(80, 3)
        s = meniscus.surface(xyz, radii)
        areas, planes, total = s.atom_areas, s.patches.planes, s.area
        copy, planes_copy = areas.copy(), planes.copy()
        s.update(xyz * 1.05)
        self.assertNotEqual(s.area, total)
        del s
        gc.collect()
        for n in range(5):
            meniscus.surface(xyz * (1 + 0.01 * n), radii)
        np.testing.assert_array_equal(areas, copy)
        np.testing.assert_array_equal(planes, planes_copy)

    def test_are_views_and_read_only(self):
        s = meniscus.surface(*chain(10))
        self.assertEqual(s.atom_areas.ctypes.data, s.atom_areas.ctypes.data)
        for array in (s.atom_areas, s.components, s.patches.convex, s.mesh(0.1).vertices, s.half_borders):
            self.assertFalse(array.flags.writeable)
            self.assertFalse(array.flags.owndata)
        with self.assertRaises(ValueError):
            s.atom_areas[0] = 1.0

    def test_memory_comes_back(self):
        xyz, radii = cloud(200, 4)
        s = meniscus.surface(xyz, radii)

        def resident():
            return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * 4096 / 2**20

        for _ in range(10):
            s.update(xyz).mesh(0.3)
        before = resident()
        for _ in range(60):
            s.update(xyz).mesh(0.3)
        self.assertLess(resident() - before, 10.0)

    def test_mesh(self):
        mesh = meniscus.surface(*chain(10)).mesh(0.05)
        triangles = mesh.triangles
        self.assertEqual(len(triangles), 2 * len(mesh.vertices) - 4)
        a, b, c = (mesh.vertices[triangles[:, n]] for n in range(3))
        volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
        self.assertAlmostEqual(volume / meniscus.surface(*chain(10)).volume, 1.0, delta=0.03)
        self.assertEqual(len(mesh.triangle_atoms), len(triangles))
        self.assertLess(mesh.triangle_kinds.max(), 3)
        np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1.0, atol=1e-12)
