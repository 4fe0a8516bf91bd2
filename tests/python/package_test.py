# SPDX-License-Identifier: BSD-3-Clause
"""The Python package over libmeniscus; runs in any interpreter that has numpy, Blender's included (blender -b --python
package_test.py). MENISCUS_LIBRARY names the library, MENISCUS_PACKAGE the folder with the package unless it is installed."""
import copy
import ctypes
import dataclasses
import gc
import inspect
import math
import os
import pathlib
import pickle
import re
import subprocess
import sys
import tempfile
import threading
import unittest
import zlib

if "MENISCUS_PACKAGE" in os.environ:
    sys.path.insert(0, os.environ["MENISCUS_PACKAGE"])

import numpy as np

import meniscus
from meniscus import _library

HEADER = os.environ.get("MENISCUS_HEADER")
PROGRAM = os.environ.get("MENISCUS_PROGRAM")


def chain(count):
    n = np.arange(count)
    return np.stack([1.5 * n, 0.3 * (n % 3), 0.1 * n], axis=1), 1.7 - 0.05 * (n % 4)


def cloud(count, seed):
    random = np.random.default_rng(seed)
    return random.uniform(0.0, 2.2 * count ** (1 / 3), (count, 3)), random.uniform(1.2, 1.9, count)


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
        xyz = np.round(xyz * 16) / 16  # as floats have them
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
        self.assertEqual(usual(meniscus.Surface.mesh, "tolerance"), _library.default("mesh_options", _library.MeshOptions()).tolerance)
        pockets = _library.default("pocket_options", _library.PocketOptions())
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


class Errors(unittest.TestCase):
    def test_have_the_texts_of_the_library(self):
        xyz, radii = chain(5)
        xyz[3, 1] = np.nan
        with self.assertRaisesRegex(meniscus.InputError, "y of atom 3 is nan"):
            meniscus.surface(xyz, radii)
        with self.assertRaisesRegex(ValueError, "radius of atom 0 is -1.7"):
            meniscus.surface(chain(5)[0], -radii)
        with self.assertRaisesRegex(meniscus.InputError, "probe_radius: -1 Å is negative"):
            meniscus.surface(*chain(5), probe=-1.0)
        with self.assertRaisesRegex(meniscus.UsageError, "kind is 'lee', none of ses, sas, vdw"):
            meniscus.surface(*chain(5), kind="lee")
        with self.assertRaisesRegex(meniscus.InputError, "tolerance is 9"):
            meniscus.surface(*chain(5)).mesh(9)
        with self.assertRaisesRegex(meniscus.UsageError, "tolerance is 0.05"):
            meniscus.surface(*chain(5)).mesh(0.05, density=0.1)

    def test_shapes_are_looked_at_before_the_library_is(self):
        for xyz, radii in ((np.zeros((3, 2)), 1.7), (np.zeros(3), 1.7), (np.zeros((3, 3)), [1.7, 1.7]),
                           ([["a", "b", "c"]], 1.7), (np.zeros((0, 3)), 1.7), (np.zeros((2, 3)), [[1.7, 1.7]])):
            with self.assertRaises(meniscus.InputError):
                meniscus.surface(xyz, radii)

    def test_an_update_that_is_refused_changes_nothing(self):
        xyz, radii = chain(5)
        s = meniscus.surface(xyz, radii)
        area = s.area
        with self.assertRaises(meniscus.InputError):
            s.update(np.full_like(xyz, np.inf))
        with self.assertRaises(meniscus.InputError):
            s.update(xyz[:3])
        self.assertEqual(s.area, area)
        self.assertEqual(s.update(xyz).area, area)


class Foreign(unittest.TestCase):
    """Numbers of other packages become the numbers that they are, or are refused."""

    class InNanometres:
        """As pint has it."""
        units = "nanometer"

        def __init__(self, values):
            self.values = np.asarray(values)

        def m_as(self, unit):
            return self.values * 10 ** int(unit.split("**")[1])

        def __array__(self, dtype=None, copy=None):
            return self.values

    def test_units_are_converted_or_refused(self):
        nm = self.InNanometres
        xyz, radii = chain(8)
        s = meniscus.surface(nm(xyz / 10), nm(radii / 10), probe=nm(0.14))
        expected = meniscus.surface(xyz, radii, probe=1.4)
        self.assertAlmostEqual(s.area, expected.area, 9)
        self.assertAlmostEqual(s.update(nm(xyz / 10), nm(0.17)).area, meniscus.surface(xyz, 1.7).area, 9)
        np.testing.assert_allclose(expected.distance(nm(xyz)), expected.distance(10 * xyz), atol=1e-9)
        self.assertEqual(len(expected.mesh(nm(0.01)).vertices), len(expected.mesh(0.1).vertices))
        self.assertEqual([p.volume for p in expected.pockets(nm(0.4), min_volume=nm(1e-3))],
                         [p.volume for p in expected.pockets(4.0, min_volume=1.0)])
        with self.assertRaisesRegex(meniscus.InputError, "weights is in nanometer; give numbers without a unit"):
            expected.gradient("sas_area", nm(radii))

        class Labelled(np.ndarray):  # as xarray's
            attrs = {"units": "nm"}
        with self.assertRaisesRegex(meniscus.InputError, "xyz says that it is in nm"):
            meniscus.surface(xyz.view(Labelled), radii)

    def test_what_would_become_other_numbers_is_refused(self):
        xyz, radii = chain(5)
        masked = np.ma.masked_array(xyz, mask=np.arange(15).reshape(5, 3) == 4)
        s = meniscus.surface(xyz, radii)
        self.assertEqual(meniscus.surface(np.ma.masked_array(xyz), np.ma.masked_array(radii)).area, s.area)
        for values, said in ((masked, "1 masked number"), (xyz + 0j, "complex numbers"), (xyz > 1, "true or false"),
                             (xyz.astype(str), "text"), (xyz.astype(str).tolist(), "text"), (xyz.astype("S8"), "text"),
                             (xyz.astype("M8[s]"), "datetime64"), ([[None, 0, 0]], "object")):
            for call in (lambda: meniscus.surface(values, 1.7), lambda: s.update(values), lambda: s.distance(values),
                         lambda: meniscus.surface(xyz, np.ravel(values)[:5] if values is not masked else masked[:, 1])):
                with self.assertRaisesRegex(meniscus.InputError, said):
                    call()
        for values in (np.ma.masked_array(radii, mask=radii > 1.6), radii + 1j, radii > 1, radii.astype(str)):
            self.assertRaises(meniscus.InputError, s.gradient, "sas_area", values)
            self.assertRaises(meniscus.InputError, s.render, size="8x8", colors=values[:3], device="cpu")

    def test_numbers_are_looked_at_before_ctypes_cuts_them(self):
        xyz, radii = chain(5)
        s = meniscus.surface(xyz, radii)
        for call, value in ((lambda: meniscus.surface(xyz, radii, threads=2**32 + 1), "threads is 4294967297"),
                            (lambda: meniscus.radii_of(["C", 2**32 + 6]), "atom 1: the element is 4294967302"),
                            (lambda: meniscus.read("x.pdb", model=2**32 + 1), "model is 4294967297")):
            with self.assertRaisesRegex(meniscus.InputError, value + ", which 32 bits cannot count"):
                call()
        for call, said in ((lambda: meniscus.surface(xyz, radii, threads=1.5), "threads is 1.5, not a whole number"),
                           (lambda: meniscus.radii_of([6.5]), "atom 0: the element is 6.5, not a whole number"),
                           (lambda: meniscus.surface(xyz, radii, probe=None), "probe_radius is None, not a number"),
                           (lambda: meniscus.surface(xyz, radii, probe="1.4"), "probe_radius is '1.4', not a number"),
                           (lambda: meniscus.surface(xyz, radii, probe=1.4 + 0j), "not a number"),
                           (lambda: s.mesh([0.1]), "tolerance is .0.1., not a number")):
            with self.assertRaisesRegex(meniscus.InputError, said):
                call()
        same = meniscus.surface(xyz, radii, np.float32(1.5), threads=np.int64(1), verify=np.bool_(False))
        self.assertEqual(same.area, meniscus.surface(xyz, radii, 1.5).area)

    def test_odd_values_are_refused_with_their_name(self):
        s = meniscus.surface([[0, 0, 0], [3, 0, 0]], 1.7)
        mesh, camera = s.mesh(0.3), s.camera()

        def seen(**fields):
            return s.render(size="8x8", camera=dataclasses.replace(camera, **fields), device="cpu")
        odd = (b"x", 10**400, {}, object(), np.arange(4), 1j, "a\0b", [[1, 2], [3]], math.nan, lambda: 0)
        for name, call in (
                ("kind", lambda v: meniscus.surface([[0, 0, 0]], 1.7, kind=v)),
                ("probe", lambda v: meniscus.surface([[0, 0, 0]], 1.7, v)),
                ("threads", lambda v: meniscus.surface([[0, 0, 0]], 1.7, threads=v)),
                ("verify", lambda v: meniscus.surface([[0, 0, 0]], 1.7, verify=v)),
                ("xyz", s.update), ("points", s.distance), ("of", s.gradient), ("tolerance", s.mesh),
                ("large_probe_radius", s.pockets), ("aspect", s.camera),
                ("weights", lambda v: s.gradient("sas_area", v)),
                ("density", lambda v: s.mesh(density=v)), ("even", lambda v: s.mesh(0.3, even=v)),
                ("split_colors", lambda v: s.mesh(0.3, split_colors=v)),
                ("nearest", lambda v: s.distance([[0, 0, 0]], nearest=v)),
                ("camera", lambda v: s.render(size="8x8", camera=v, device="cpu")),
                ("device", lambda v: s.render(size="8x8", device=v)),
                ("position", lambda v: seen(position=v)), ("up", lambda v: seen(up=v)), ("fov", lambda v: seen(vertical_fov=v)),
                ("select", lambda v: meniscus.read("x.pdb", select=v)), ("keep_water", lambda v: meniscus.read("x.pdb", keep_water=v)),
                ("radius", lambda v: meniscus.read("x.pdb", radius=[v])), ("element", lambda v: meniscus.radii_of([v])),
                ("format", lambda v: mesh.save("x.stl", format=v)), ("scale", lambda v: mesh.save("x.stl", scale=v))):
            for value in odd:
                with self.subTest(name, value=repr(value)[:30]), self.assertRaises(meniscus.Error) as refused:
                    call(value)
                self.assertIn(name, str(refused.exception))

    def test_words_are_no_flags_and_texts_no_lists(self):
        s = meniscus.surface([[0, 0, 0]], 1.7)
        for call, said in ((lambda: s.mesh(0.3, even="no"), "even is 'no', neither True nor False"),
                           (lambda: s.distance([[0, 0, 0]], nearest="no"), "nearest is 'no'"),
                           (lambda: meniscus.radii_of("CN"), "elements is 'CN', not a list of symbols"),
                           (lambda: meniscus.radii_of(None), "elements is None, not a list of symbols")):
            with self.assertRaisesRegex(meniscus.InputError, said):
                call()
        self.assertEqual(meniscus.radii_of(symbol for symbol in "CN").tolist(), [1.7, 1.55])
        self.assertEqual(s.mesh(0.3, even=np.True_).triangles.tolist(), s.mesh(0.3, even=1).triangles.tolist())

    def test_rows_that_are_not_aligned_are_copied(self):
        xyz, radii = chain(5)
        raw = np.zeros(5 * 24 + 1, np.uint8)
        crooked = raw[1:].view(np.float64).reshape(5, 3)
        crooked[:] = xyz
        s = meniscus.surface(xyz, radii)
        self.assertFalse(crooked.flags.aligned)
        self.assertEqual(meniscus.surface(crooked, radii).area, s.area)
        np.testing.assert_array_equal(s.distance(crooked), s.distance(xyz))


class Threads(unittest.TestCase):
    def test_eight_at_once_agree(self):
        clouds = [cloud(120, seed) for seed in range(8)]
        expected = [meniscus.surface(*c).area for c in clouds]
        shared = meniscus.surface(*clouds[0])
        found, faults = [[] for _ in clouds], []

        def work(n):
            try:
                for _ in range(4):
                    found[n].append(meniscus.surface(*clouds[n], threads=1 + n % 2).area)
                    shared.update(*clouds[n])
                    self.assertTrue(np.isfinite(shared.atom_areas).all())
            except Exception as error:  # told by the thread that began them
                faults.append(error)

        threads = [threading.Thread(target=work, args=(n,)) for n in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(faults, [])
        self.assertEqual(found, [[area] * 4 for area in expected])


class Pictures(unittest.TestCase):
    def test_render_and_png(self):
        s = meniscus.surface([[0, 0, 0]], 2.0)
        self.render_and_png(s, "cpu")
        try:
            s.render(size="8x8", device="software")
        except meniscus.GpuError as error:  # of a wheel
            self.assertIn("made without epoxy", str(error))
        else:
            self.render_and_png(s, "software")

    def render_and_png(self, s, device):
        camera = s.camera(1.0, "orthographic")
        camera.height = 8.0
        picture = s.render(size="100x100", preset="classic", camera=camera, colors=(1, 0, 0), device=device)
        pixels = picture.pixels
        self.assertEqual(pixels.shape, (100, 100, 4))
        self.assertIs(np.asarray(picture), pixels)
        self.assertAlmostEqual(pixels[..., 3].sum() / 255, math.pi * 25**2, delta=20)
        self.assertLess(pixels[50, 50, 1], 30)  # but for the highlight
        opaque = s.render(width=100, height=100, camera=camera, colors=[[0, 1, 0]], background="#0000ff", device=device)
        self.assertEqual(opaque.pixels[0, 0].tolist(), [0, 0, 255, 255])
        file = picture.png()
        self.assertTrue(file.startswith(b"\x89PNG\r\n\x1a\n"))
        rows = np.frombuffer(zlib.decompress(file[file.index(b"IDAT") + 4:-16]), np.uint8).reshape(100, 401)
        np.testing.assert_array_equal(rows[:, 1:].reshape(100, 100, 4), pixels)
        with self.assertRaisesRegex(meniscus.InputError, "colors has the shape"):
            s.render(size="10x10", colors=np.zeros((2, 3)), device=device)
        for name, value, said in (("samples", 0, "samples: '0' is not a whole number from 1 to 1024"),
                                  ("sample", 1, "did you mean samples"), ("view", "top", "view: a picture of a surface")):
            with self.assertRaisesRegex(meniscus.UsageError, said):
                s.render(device=device, **{name: value})

    def test_scenes_hold_values_by_name_and_key(self):
        scene = meniscus.Scene(pathlib.Path("a.pdb"), depth_cue=0.5, silhouettes="7pt", keep_water=True,
                               label=["resid 1=one", "resid 2=two"], samples=np.int64(4))
        self.assertEqual((scene.file, scene["look.depth_cue"], scene.silhouettes), ("a.pdb", 0.5, "7pt"))
        self.assertEqual((scene.keep_water, scene.samples, scene.preset), (True, 4, None))
        self.assertEqual(scene.label, ["resid 1=one", "resid 2=two"])
        scene.label, scene["depth_cue"], scene.keep_water = "resid 3=three", None, False
        self.assertEqual((scene.label, scene.depth_cue, scene.keep_water), (["resid 3=three"], None, None))
        again = meniscus.Scene.parse(scene.json())
        self.assertEqual((again.json(), again.silhouettes), (scene.json(), "7pt"))
        self.assertIs(scene.set(depth_cue=0.1), scene)
        self.assertIn("silhouettes", dir(scene))
        self.assertFalse(hasattr(scene, "shape"))
        self.assertIn("a.pdb", repr(scene))
        for name, value, error, said in (("depth_cue", 2, meniscus.UsageError, "depth_cue: '2' is not a number from 0 to 1"),
                                         ("depth_cues", 1, meniscus.UsageError, "did you mean depth_cue?"),
                                         ("depth_cue", 1j, meniscus.InputError, "neither a text nor a number"),
                                         ("select", "a\0", meniscus.InputError, "has a zero in it")):
            with self.assertRaisesRegex(error, re.escape(said)):
                scene[name] = value
        self.assertRaisesRegex(meniscus.InputError, "not JSON", meniscus.Scene.parse, "{")
        self.assertRaisesRegex(meniscus.UsageError, "no molecule", meniscus.Scene().render, "cpu")
        named = {p.name: p for p in meniscus.properties()}
        self.assertEqual((named["depth_cue"].key, named["depth_cue"].highest), ("look.depth_cue", 1.0))
        self.assertEqual(named["surface"].words, ["ses", "sas", "vdw"])

    @unittest.skipUnless(PROGRAM, "MENISCUS_PROGRAM is not set")
    def test_a_scene_is_drawn_as_the_program_draws_it(self):
        with tempfile.TemporaryDirectory() as folder:
            lines = ("ATOM      1  N   ALA A   1       0.000   0.000   0.000  1.00 10.00           N  \n"
                     "ATOM      2  CA  GLY B   2       3.987   2.839   0.000  1.00 25.00           C  \nEND\n")
            (pathlib.Path(folder) / "a.pdb").write_text(lines)
            path = pathlib.Path(folder) / "scene.json"
            path.write_text(meniscus.Scene(os.path.join(folder, "a.pdb"), size="240x180", color="chain", legend=True,
                                           background="white").json(folder))
            subprocess.run([PROGRAM, "render", "-q", "--device", "cpu", "--scene", str(path), "-o", f"{folder}/a.png"], check=True)
            try:
                import OpenImageIO
            except ImportError:
                self.skipTest("OpenImageIO for Python is not installed")
            theirs = OpenImageIO.ImageInput.open(f"{folder}/a.png").read_image("uint8")
            np.testing.assert_array_equal(meniscus.Scene.read(path).render("cpu").pixels[..., :3], theirs)

    def test_nothing_fades_where_a_surface_is_seen_through(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.pdb"
            path.write_text("".join(f"ATOM  {n:5}  C   ALA A{n:4}    {3.0 * n:8.3f}   0.000{4.0 * n:8.3f}  1.00 10.00           C  \n" for n in range(1, 9)))

            def drawn(**values):
                return meniscus.Scene(path, size="80x60", background="white", view="y", **values).render("cpu").pixels.astype(int)

            usual = drawn(opacity="0.4")
            np.testing.assert_array_equal(usual, drawn(opacity="0.4", depth_cue=0))
            self.assertGreater(abs(usual - drawn(opacity="0.4", depth_cue=0.35)).max(), 2)
            self.assertGreater(abs(drawn() - drawn(depth_cue=0)).max(), 2)

    def test_notebooks_show_it(self):
        self.assertTrue(meniscus.surface(*chain(6))._repr_png_().startswith(b"\x89PNG"))
        self.assertIn("6 atoms", repr(meniscus.surface(*chain(6))))


class MeshFiles(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.xyz, self.radii = cloud(40, 7)
        self.surface = meniscus.surface(self.xyz, self.radii)

    def bytes_of(self, mesh, name, **options):
        mesh.save(self.folder / name, **options)
        return (self.folder / name).read_bytes()

    @unittest.skipUnless(PROGRAM, "MENISCUS_PROGRAM is not set")
    def test_the_program_writes_the_same_bytes(self):
        lines = "".join(f"{x!r} {y!r} {z!r} {r!r}\n" for (x, y, z), r in zip(self.xyz.tolist(), self.radii.tolist()))
        mesh = self.surface.mesh(0.05)
        even = self.surface.mesh(0.1, even=True)
        for made, name, *words in ((mesh, "a.stl", "--tolerance", "0.05"), (mesh, "a.off", "--tolerance", "0.05"),
                                   (mesh, "a.smesh", "--tolerance", "0.05"), (even, "b.stl", "--even", "--tolerance", "0.1")):
            path = self.folder / ("program_" + name)
            subprocess.run([PROGRAM, "export", "mesh", "-q", "--device", "cpu", "-", "-o", str(path), *words], input=lines,
                           text=True, check=True, capture_output=True)
            self.assertEqual(self.bytes_of(made, name), path.read_bytes(), name)

    def test_every_format(self):
        mesh = self.surface.mesh(density=1.0)
        begins = {"stl": b"Meniscus", "3mf": b"PK", "obj": b"#", "off": b"OFF", "glb": b"glTF", "vtp": b"<?xml",
                  "smesh": b"#", "dms": b"  -    1", "ply": b"ply"}
        for ending, first in begins.items():
            content = self.bytes_of(mesh, "mesh." + ending)
            self.assertEqual(content[:len(first)], first, ending)
            self.assertEqual(self.bytes_of(mesh, "named_" + ending, format=ending), content)
        self.assertEqual(len(self.bytes_of(mesh, "again.STL")), 84 + 50 * len(mesh.triangles))

    def test_colors_attributes_and_scale(self):
        mesh = self.surface.mesh(0.2)

        def columns(mesh, name, **options):
            content = self.bytes_of(mesh, name, **options)
            head, rows = content.split(b"end_header\n", 1)
            types = {"float": "<f4", "uchar": "u1", "int": "<i4"}
            lines = [line.split() for line in head.decode().split("element face")[0].splitlines()]
            row = np.dtype([(line[2], types[line[1]]) for line in lines if line[0] == "property"])
            count = int(next(line[2] for line in lines if line[:2] == ["element", "vertex"]))
            return np.frombuffer(rows, row, count)

        table = columns(mesh, "a.ply", attributes="all", scale=0.1)
        self.assertEqual(table.dtype.names[9:], ("vdw_radii", "atom_index", "ses_kind", "ses_component", "mean_curvature",
                                                 "gaussian_curvature", "smooth_mean_curvature",
                                                 "smooth_gaussian_curvature", "atom_area", "accessible_area",
                                                 "patch_area"))
        np.testing.assert_allclose(table["vdw_radii"], self.radii[table["atom_index"].astype(int)], rtol=1e-6)
        np.testing.assert_allclose(table["atom_area"], self.surface.atom_areas[table["atom_index"].astype(int)], rtol=1e-5)
        np.testing.assert_allclose(table["accessible_area"], self.surface.atom_sas_areas[table["atom_index"].astype(int)],
                                   rtol=1e-5)
        places = np.stack([table[axis] for axis in "xyz"], axis=1) * 10.0
        np.testing.assert_allclose(self.surface.distance(places), 0.0, atol=1e-4)
        one = columns(mesh, "b.ply", colors=(1, 0, 0), attributes="none")
        self.assertEqual(one.dtype.names[9:], ())
        self.assertTrue((one["red"] == 255).all() and (one["green"] == 0).all())
        self.assertEqual(columns(mesh, "c.ply").dtype.names[9:], ("vdw_radii", "atom_index", "ses_kind", "ses_component"))
        table = columns(meniscus.surface(self.xyz, self.radii, kind="sas").mesh(0.2), "d.ply")
        np.testing.assert_allclose(table["vdw_radii"], self.radii[table["atom_index"].astype(int)], rtol=1e-6)
        apart = meniscus.surface([[0, 0, 0], [20, 0, 0]], [1.7, 1.2]).mesh(density=1.0)
        table = columns(apart, "e.ply", colors=[[0.2, 0.4, 0.6], [1, 0, 0]])
        for atom, color in enumerate(((51, 102, 153), (255, 0, 0))):
            at = table["atom_index"] == atom
            self.assertGreater(at.sum(), 10)
            self.assertTrue(((table["x"][at] > 10) == atom).all())
            self.assertTrue((np.stack([table[c][at] for c in ("red", "green", "blue")], axis=1) == color).all())

    def test_a_mesh_is_that_of_its_frame(self):
        mesh = self.surface.mesh(0.1)
        before = self.bytes_of(mesh, "before.vtp", attributes="all")
        self.surface.update(self.xyz + 0.3)
        self.assertEqual(self.bytes_of(mesh, "after.vtp", attributes="all"), before)

    def test_what_cannot_be(self):
        mesh = self.surface.mesh(0.3)
        mesh.save(self.folder / "there.stl")
        for wanted, error, sentence in (
                (lambda: mesh.save(self.folder / "there.stl"), meniscus.OutputError, "there.stl"),
                (lambda: mesh.save(self.folder / "no" / "folder.stl"), OSError, "folder.stl"),
                (lambda: mesh.save(self.folder / "mesh.xyz"), meniscus.UsageError, "xyz.* does not end like a mesh file"),
                (lambda: mesh.save(self.folder / "mesh"), meniscus.UsageError, "does not end like a mesh file"),
                (lambda: mesh.save(self.folder / "a.stl", format="step"), meniscus.UsageError, "format is 'step'"),
                (lambda: mesh.save(self.folder / "a.ply", attributes="b_factor"), meniscus.UsageError, "bare atoms"),
                (lambda: mesh.save(self.folder / "a.ply", attributes="mass"), meniscus.UsageError, "not an attribute"),
                (lambda: mesh.save(self.folder / "a.ply", scale=0.0), meniscus.InputError, "scale is 0"),
                (lambda: mesh.save(self.folder / "a.ply", scale=math.nan), meniscus.InputError, "scale is nan"),
                (lambda: mesh.save(self.folder / "a.ply", colors=(2, 0, 0)), meniscus.InputError, "atom 0 is 2; it has to be 0 to 1"),
                (lambda: mesh.save(self.folder / "a.ply", colors=np.full((40, 3), -1.0)), meniscus.InputError,
                 "colour of atom 0 is -1"),
                (lambda: mesh.save(self.folder / "a.ply", colors=np.zeros((3, 3))), meniscus.InputError, "the shape"),
                (lambda: mesh.save("a\0.ply"), ValueError, "zero"),
                (lambda: self.surface.mesh(density=0.1).save(self.folder / "a.dms", format="dms", scale=1e9),
                 meniscus.InputError, "scale")):
            with self.assertRaisesRegex(error, sentence):
                wanted()
        self.assertEqual([path.name for path in self.folder.iterdir()], ["there.stl"])
        mesh.save(self.folder / "there.stl", replace=True)


class Elsewhere(unittest.TestCase):
    """In another process, and when Python ends."""

    def test_pickles_hold_atoms_and_options(self):
        xyz, radii = cloud(60, 3)
        for given, options in ((radii, {}), (1.6, {"kind": "sas", "threads": 1}), (radii.astype(np.float32), {"kind": "vdw"}),
                               (radii, {"probe": 1.1})):
            s = meniscus.surface(xyz, given, **options)
            for again in (pickle.loads(pickle.dumps(s)), copy.deepcopy(s)):
                self.assertEqual((again.area, again.volume, again.kind, again.probe), (s.area, s.volume, s.kind, s.probe))
                np.testing.assert_array_equal(again.balls["radius"], s.balls["radius"])
                again.update(xyz + 0.5)
                self.assertEqual(again.area, meniscus.surface(xyz + 0.5, given, **options).area)

    def test_all_that_is_public_is_pickled_and_copied(self):
        xyz, radii = cloud(40, 8)
        s = meniscus.surface(xyz, radii)
        mesh, scene = s.mesh(density=0.5), meniscus.Scene("a.pdb", depth_cue=0.5, label=["resid 1=one", "resid 2=two"])
        s.update(xyz + 0.5)
        for again in (pickle.loads(pickle.dumps(mesh)), copy.deepcopy(mesh)):
            np.testing.assert_array_equal(again.vertices, mesh.vertices)
            np.testing.assert_array_equal(again.triangles, mesh.triangles)
        for again in (pickle.loads(pickle.dumps(scene)), copy.copy(scene)):
            self.assertEqual((again.json(), again.file, again.label), (scene.json(), "a.pdb", scene.label))
            again.depth_cue = 0.25
            self.assertEqual(scene.depth_cue, 0.5)
        for thing in (s.camera(), s.render(size="8x8", device="cpu"), s.patches, s.pockets(), meniscus.properties()[0]):
            self.assertEqual(repr(pickle.loads(pickle.dumps(thing))), repr(thing))

    def test_a_copy_keeps_its_frame(self):
        xyz, radii = cloud(40, 8)
        s = meniscus.surface(xyz, radii)
        area = s.area
        copies = [copy.copy(s), copy.deepcopy(s)]
        later = s.update(xyz * 1.1).area
        self.assertNotEqual(later, area)
        for kept in copies:
            self.assertEqual(kept.area, area)
            kept.update(xyz * 1.2)
        self.assertEqual(s.area, later)

    def test_python_ends_without_a_word(self):
        # Kept by a module that ends after the package's own.
        code = ("import meniscus, numpy\ns = meniscus.surface([[0, 0, 0], [2, 0, 0]], 1.7)\n"
                "numpy.kept = [s, s.mesh(0.3), s.render(size='20x20', device='cpu'), s.pockets(), meniscus.Scene()]\n")
        run = subprocess.run([sys.executable, "-c", f"import sys; sys.path[:0] = {sys.path!r}\n" + code], text=True,
                             capture_output=True)
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "", ""))

    def test_wrong_names_are_refused(self):
        s = meniscus.surface([[0, 0, 0]], 1.7)
        for thing in (s, s.mesh(0.3), s.camera(), s.render(size="8x8", device="cpu"), s.patches, meniscus.properties()[0]):
            with self.assertRaisesRegex(AttributeError, "prob"):
                thing.prob = 3
        with self.assertRaisesRegex(meniscus.UsageError, "did you mean probe?"):
            meniscus.Scene().prob = 3
        with self.assertRaises(AttributeError):
            s.probe = 3

    def test_version(self):
        self.assertEqual(meniscus.__version__, meniscus.version())
        with self.assertRaises(AttributeError):
            meniscus.__versions__


@unittest.skipUnless(HEADER, "MENISCUS_HEADER is not set")
class Header(unittest.TestCase):
    """The structs and constants that are written a second time are those of the header."""

    def setUp(self):
        self.text = re.sub(r"/\*.*?\*/", "", pathlib.Path(HEADER).read_text(), flags=re.S)

    def test_constants(self):
        names = {name: int(value) for name, value in re.findall(r"\bMENISCUS_(\w+) = (\d+)", self.text)}
        checked = 0
        for name, value in names.items():
            if hasattr(_library, name):
                checked += 1
                self.assertEqual(getattr(_library, name), value, name)
        self.assertGreaterEqual(checked, 40)

    def test_structs(self):
        c_names = {"double": ctypes.c_double, "float": ctypes.c_float, "size_t": ctypes.c_size_t,
                   "int32_t": ctypes.c_int32, "uint32_t": ctypes.c_uint32, "uint64_t": ctypes.c_uint64,
                   "uint8_t": ctypes.c_uint8}
        found = re.findall(r"typedef struct meniscus_\w+ \{(.*?)\} meniscus_(\w+);", self.text, re.S)
        self.assertGreaterEqual(len(found), 15)
        words = re.findall(r"typedef enum (\w+) MENISCUS_WORDS", self.text)
        self.assertGreaterEqual(len(words), 14)
        for body, name in found:
            python = {"mesh_options": "MeshOptions", "mesh_file": "MeshFile", "camera": "CameraStruct", "pocket": "PocketRow",
                      "pocket_options": "PocketOptions", "read_options": "ReadOptions", "read_report": "ReadReport"}.get(name, name.capitalize())
            fields = []
            for kind, members in re.findall(r"((?:const )?\w+(?:\* const)?\*?) ([^;]+);", body):
                kind = "int32_t" if kind in words else kind
                self.assertTrue(kind in c_names or "*" in kind, f"{name}: {kind}")
                for member in members.split(","):
                    field, size = re.match(r"\s*(\w+)(?:\[(\d+)\])?", member).groups()
                    wanted = c_names.get(kind)
                    fields.append((field, wanted * int(size) if size else wanted))
            mine = getattr(_library, python)._fields_
            self.assertEqual([f for f, _ in fields], [f for f, _ in mine], name)
            for (field, wanted), (_, kind) in zip(fields, mine):
                if wanted:
                    self.assertEqual(ctypes.sizeof(kind), ctypes.sizeof(wanted), f"{name}.{field}")
                    self.assertIs(kind, wanted, f"{name}.{field}")


if __name__ == "__main__":
    # Blender hands its own arguments on.
    result = unittest.main(argv=["package_test"], exit=False, verbosity=1).result
    sys.stdout.flush()
    os._exit(0 if result.wasSuccessful() and result.testsRun > 15 else 1) if "bpy" in sys.modules else sys.exit(
        0 if result.wasSuccessful() else 1)
