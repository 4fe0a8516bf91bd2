# SPDX-License-Identifier: BSD-3-Clause
"""Inputs of the package: errors in the words of the library, and numbers of other packages."""
import dataclasses
import math
import unittest

import numpy as np

from package_case import chain
import meniscus


class Errors(unittest.TestCase):
    def test_have_the_texts_of_the_library(self):
        xyz, radii = chain(5)
        xyz[3, 1] = np.nan
        with self.assertRaisesRegex(meniscus.InputError, "y of atom 3 is nan"):
            meniscus.surface(xyz, radii)
        with self.assertRaisesRegex(ValueError, "radius of atom 0 is -1.7"):
            meniscus.surface(chain(5)[0], -radii)
        with self.assertRaisesRegex(meniscus.InputError, "probe: -1 Å is negative"):
            meniscus.surface(*chain(5), probe=-1.0)
        for kind in ("ses", "sas"):
            with self.assertRaisesRegex(meniscus.InputError, 'probe is 0; kind="vdw" is the surface without a probe'):
                meniscus.surface(*chain(5), probe=0, kind=kind)
        self.assertEqual(meniscus.surface(*chain(5), probe=0, kind="vdw").probe, 0)
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
    """Numbers of other packages become plain numbers, or are refused."""

    class InNanometres:
        """A value with a unit in pint's form."""
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
                           (lambda: meniscus.surface(xyz, radii, probe=None), "probe is None, not a number"),
                           (lambda: meniscus.surface(xyz, radii, probe="1.4"), "probe is '1.4', not a number"),
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
                ("large_probe", s.pockets), ("aspect", s.camera),
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
