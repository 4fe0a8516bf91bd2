# SPDX-License-Identifier: BSD-3-Clause
"""What computes surfaces for the Blender add-on, under plain Python: files of atoms, library and program, the newest request wins."""

import os
import subprocess
import sys
import tempfile
import threading
import time
import types
import unittest

import numpy as np

PROGRAM, ADDON, PACKAGE = sys.argv[1:4]
del sys.argv[1:4]
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import samples  # noqa: E402

package = types.ModuleType("meniscus_import")  # without Blender's side of it
package.__path__ = [os.path.join(ADDON, "meniscus_import")]
sys.modules["meniscus_import"] = package
from meniscus_import import mns_reader  # noqa: E402
from meniscus_import.computing import atoms, engines, jobs, request  # noqa: E402


class Quiet:
    """A task that nobody looks at."""

    def say(self, stage):
        pass

    def check(self):
        pass


class WithFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(engines.forget)
        self.folder = folder.name

    def molecule(self, name="triple"):
        path = os.path.join(self.folder, name + ".xyzr")
        with open(path, "w", encoding="ascii") as file:
            for atom in samples.MOLECULES[name]:
                file.write("%.12f %.12f %.12f %.4f\n" % atom)
        return path

    def atoms(self, *arguments):
        target = os.path.join(self.folder, "some.atoms")
        subprocess.run([PROGRAM, "export", "atoms", *arguments, "-o", target, "--force", "-q", "--device", "cpu"], check=True,
                       stdout=subprocess.DEVNULL)
        return target


class AtomFiles(WithFolder):
    def test_atoms_are_those_of_the_surface(self):
        found = atoms.read(self.atoms(self.molecule(), "--color", "element"))
        np.testing.assert_array_equal(found.atoms.positions, [row[:3] for row in samples.MOLECULES["triple"]])
        np.testing.assert_array_equal(found.atoms.radii, [1.7, 1.55, 1.52])
        np.testing.assert_array_equal(found.atoms.index, [0, 1, 2])
        self.assertEqual(found.numbers, [])
        exported = mns_reader.read(samples.export(PROGRAM, self.folder, "triple", "--color", "element")).objects[0]
        np.testing.assert_array_equal(found.atoms.colors, exported["atom.color"])

    def test_frames_are_those_of_the_run(self):
        every = ["--select", "resi 1-15", "--color", "residue"]
        found = atoms.read(self.atoms(samples.UBIQUITIN, *every, "--frames", "1-5:2"))
        self.assertEqual(found.numbers, [1, 3, 5])
        for place, number in enumerate(found.numbers, 1):
            model = atoms.read(self.atoms(samples.UBIQUITIN, *every, "--model", str(number + 1)))
            np.testing.assert_allclose(found.frame(place).positions, model.atoms.positions, atol=1e-5)
            np.testing.assert_array_equal(found.frame(place).radii, model.atoms.radii)
        self.assertGreater(np.abs(found.frame(1).positions - found.frame(2).positions).max(), 0.1)

    def test_copies_are_atoms_of_their_own(self):
        path = os.path.join(self.folder, "two.pdb")
        with open(path, "w", encoding="ascii") as file:
            file.write("REMARK 350 BIOMOLECULE: 1\nREMARK 350 APPLY THE FOLLOWING TO CHAINS: A\n")
            for copy, shift in ((1, 0.0), (2, 20.0)):
                for row in range(3):
                    cells = [1.0 if column == row else 0.0 for column in range(3)]
                    file.write("REMARK 350   BIOMT%d %3d %9.6f %9.6f %9.6f %14.5f\n" % (row + 1, copy, *cells, shift if row == 0 else 0.0))
            file.write("ATOM      1  CA  ALA A   1       1.000   2.000   3.000  1.00  0.00           C\nEND\n")
        found = atoms.read(self.atoms(path, "--assembly", "1", "--instances", "exact"))
        np.testing.assert_allclose(found.atoms.positions, [[1, 2, 3], [21, 2, 3]], atol=1e-6)

    def test_what_is_no_file_of_atoms_says_why(self):
        good = self.atoms(self.molecule())
        surface = samples.export(PROGRAM, self.folder, "pair")
        with self.assertRaisesRegex(mns_reader.MnsError, "holds no atoms"):
            atoms.read(surface)
        with self.assertRaisesRegex(mns_reader.MnsError, "holds atoms"):
            mns_reader.read(good)
        with open(good, "rb") as file:
            data = file.read()
        header, _ = samples.header_of(data)
        short = {**header, "frames": [1, 2]}
        lost = {**header, "arrays": [entry for entry in header["arrays"] if entry["name"] != "atom.radius"]}
        for text, bad in (("frame.position", samples.with_header(data, short)), ("atom.radius", samples.with_header(data, lost)),
                          ("finite", samples.patched(data, "atom.center", "d", float("nan"))), ("checksum", data[:-1] + b"x")):
            with open(good, "wb") as file:
                file.write(bad)
            with self.assertRaisesRegex(mns_reader.MnsError, text):
                atoms.read(good)


class Engines(WithFolder):
    def setUp(self):
        super().setUp()
        self.tools = engines.find_tools(PACKAGE, PROGRAM)
        self.assertIsNotNone(self.tools.library, self.tools.missing)
        self.alone = engines.Tools(None, self.tools.program, "taken away")

    def asked(self, **options):
        return request.Request(**{"file": self.molecule(), **options})

    def test_library_and_program_give_the_same_surface(self):
        for kind in request.KINDS:
            wanted = self.asked(kind=kind, probe=1.2)
            one, other = (engines.compute(tools, wanted, None, self.folder, Quiet()) for tools in (self.tools, self.alone))
            for key in ("area", "volume"):
                self.assertEqual(one.header[key], other.header[key], (kind, key))
            for name in ("mesh.triangle", "mesh.atom", "mesh.kind", "mesh.component", "mesh.patch", "mesh.sharp_corner", "atom.color"):
                np.testing.assert_array_equal(one[name], other[name], f"{kind} {name}")
            np.testing.assert_allclose(one["mesh.position"] + one.header["mesh"]["origin"],
                                       other["mesh.position"] + other.header["mesh"]["origin"], atol=2e-6)
            np.testing.assert_allclose(one["mesh.normal"], other["mesh.normal"], atol=1e-6)
            self.assertTrue(mns_reader.is_closed(one["mesh.triangle"]))

    def test_frames_too(self):
        wanted = self.asked(file=samples.UBIQUITIN, selection="resi 1-4", frames="1-5:2", place=2)
        one, other = (engines.compute(tools, wanted, None, self.folder, Quiet()) for tools in (self.tools, self.alone))
        self.assertAlmostEqual(one.header["area"] / other.header["area"], 1.0, places=6)  # positions have single precision
        still = engines.compute(self.alone, self.asked(file=samples.UBIQUITIN, selection="resi 1-4"), None, self.folder, Quiet())
        self.assertNotAlmostEqual(one.header["area"] / still.header["area"], 1.0, places=4)

    def test_what_is_missing_is_said(self):
        nothing = engines.find_tools(self.folder, os.path.join(self.folder, "no_program"))
        self.assertIsNone(nothing.library)
        self.assertIsNone(nothing.program)
        with self.assertRaisesRegex(engines.EngineError, "needs the program"):
            engines.compute(nothing, self.asked(), None, self.folder, Quiet())
        given = atoms.Atoms(np.zeros((1, 3)), np.ones(1), np.ones((1, 3)), np.zeros(1, np.uint32))
        with self.assertRaisesRegex(engines.EngineError, "need libmeniscus"):
            engines.compute(self.alone, self.asked(file=""), given, self.folder, Quiet())
        for tools in (self.tools, self.alone):
            with self.assertRaisesRegex(engines.EngineError, "chain Q"):
                engines.compute(tools, self.asked(selection="chain Q"), None, self.folder, Quiet())
        with self.assertRaisesRegex(engines.EngineError, "probe"):
            engines.compute(self.tools, self.asked(probe=1e9), None, self.folder, Quiet())
        self.assertEqual([name for name in os.listdir(self.folder) if name.startswith(("atoms_", "surface_"))], [])

    def test_a_program_that_nobody_waits_for_ends(self):
        slow = os.path.join(self.folder, "slow")
        with open(slow, "w", encoding="ascii") as file:
            file.write("#!/bin/sh\nexec sleep 60\n")
        os.chmod(slow, 0o755)
        task = jobs.Task("a", "k", lambda task: engines.compute(engines.Tools(None, slow), self.asked(), None, self.folder, task))
        thread = threading.Thread(target=task.run)
        began = time.monotonic()
        thread.start()
        time.sleep(0.2)
        task.cancel()
        thread.join(10)
        self.assertLess(time.monotonic() - began, 10)
        self.assertTrue(task.finished.is_set())
        self.assertIsNone(task.result)
        self.assertIsNone(task.error)

    def test_keys_tell_what_matters(self):
        base = self.asked()
        same = [self.asked(color="element"), self.asked()]
        other = [self.asked(probe=1.5), self.asked(kind="SAS"), self.asked(selection="all"), self.asked(tolerance=0.1), self.asked(place=1), self.asked(color="chain")]
        self.assertEqual({each.key() for each in same}, {base.key()})
        self.assertEqual(len({each.key() for each in other} | {base.key()}), len(other) + 1)
        before = base.key()
        with open(base.file, "a", encoding="ascii") as file:
            file.write("9 9 9 1\n")
        self.assertNotEqual(base.key(), before)


class Jobs(unittest.TestCase):
    def test_of_each_owner_the_newest_is_done(self):
        worker, gate, done = jobs.Worker(), threading.Event(), []

        def work(task):
            gate.wait(10)
            done.append((task.owner, task.key))
            return task.key

        worker.ask(jobs.Task("a", 0, work))
        while worker.task_of("a").stage == "Waiting" and worker._waiting:  # until it runs
            time.sleep(0.001)
        for key in range(1, 6):
            worker.ask(jobs.Task("a", key, work))
            worker.ask(jobs.Task("b", key, work))
        gate.set()
        self.finish(worker)
        self.assertEqual(done, [("a", 0), ("a", 5), ("b", 5)])
        self.assertEqual([task.result for task in worker.take()], [0, 5, 5])
        self.assertFalse(worker.is_busy())

    def test_cancelled_tasks_give_nothing(self):
        worker, started = jobs.Worker(), threading.Event()

        def work(task):
            started.set()
            for _ in range(1000):
                time.sleep(0.005)
                task.check()
            return "too late"

        task = jobs.Task("a", 0, work)
        worker.ask(task)
        started.wait(10)
        self.assertTrue(worker.cancel("a"))
        self.finish(worker)
        self.assertEqual(worker.take(), [])
        self.assertFalse(worker.cancel("a"))
        self.assertIsNone(task.error)

    def test_an_error_comes_with_its_task(self):
        worker = jobs.Worker()
        worker.ask(jobs.Task("a", 0, lambda task: 1 // 0))
        self.finish(worker)
        (task,) = worker.take()
        self.assertIsInstance(task.error, ZeroDivisionError)

    def finish(self, worker):
        end = time.monotonic() + 10
        while worker._thread is not None and time.monotonic() < end:
            time.sleep(0.001)


if __name__ == "__main__":
    unittest.main()
