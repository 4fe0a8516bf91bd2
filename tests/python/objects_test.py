# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces in threads, in other processes, and when Python ends."""
import copy
import pickle
import subprocess
import sys
import threading
import unittest

import numpy as np

from package_case import cloud
import meniscus


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
            except Exception as error:  # The main thread reports it.
                faults.append(error)

        threads = [threading.Thread(target=work, args=(n,)) for n in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(faults, [])
        self.assertEqual(found, [[area] * 4 for area in expected])


class Elsewhere(unittest.TestCase):
    """Surfaces in another process, and when Python ends."""

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
        # A module that ends after the package's own keeps the surface.
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
