# SPDX-License-Identifier: BSD-3-Clause
"""Computations in a process of their own, under plain Python: the newest request wins while Blender goes on."""

import os
import sys
import threading
import time
import unittest

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from computing_case import PACKAGE, PROGRAM, Quiet, WithFolder  # noqa: E402
from meniscus_import import mesh_arrays  # noqa: E402
from meniscus_import.computing import engines, jobs, process, request  # noqa: E402


class Jobs(unittest.TestCase):
    def setUp(self):
        self.given = []
        self.worker = jobs.Worker(self.given.append)

    def test_of_each_owner_the_newest_is_done(self):
        gate, done = threading.Event(), []

        def work(task):
            gate.wait(10)
            done.append((task.owner, task.key))
            return task.key

        self.worker.submit(jobs.Task("a", 0, work))
        while self.worker._waiting:  # Waits until the task runs.
            time.sleep(0.001)
        for key in range(1, 6):
            self.worker.submit(jobs.Task("later", key, work, 1))
            self.worker.submit(jobs.Task("a", key, work))
            self.worker.submit(jobs.Task("b", key, work))
        gate.set()
        self.finish()
        self.assertEqual(done, [("a", 0), ("a", 5), ("b", 5), ("later", 5)])
        self.assertEqual([task.result for task in self.given], [0, 5, 5, 5])

    def test_threads_share_owners_but_no_owner(self):
        self.worker = jobs.Worker(self.given.append, 2)
        lock, running, most, together, both = threading.Lock(), [], 0, [], threading.Barrier(2)

        def work(task):
            nonlocal most
            with lock:
                together.extend((task.owner, other) for other in running)
                running.append(task.owner)
                most = max(most, len(running))
            if task.key == 0:
                both.wait(10)  # The barrier breaks unless both tasks run at the same time.
            time.sleep(0.01)
            with lock:
                running.remove(task.owner)

        for owner in "ab":
            self.worker.submit(jobs.Task(owner, 0, work))
        both_began = time.monotonic() + 10
        while self.worker._waiting and time.monotonic() < both_began:
            time.sleep(0.001)
        for owner in "abcd":
            self.worker.submit(jobs.Task(owner, 1, work))
        self.finish()
        self.assertEqual([task.error for task in self.given], 6 * [None])
        self.assertEqual(most, 2)
        self.assertEqual([pair for pair in together if pair[0] == pair[1]], [])

    def test_cancelled_tasks_give_nothing(self):
        started = threading.Event()

        def work(task):
            started.set()
            for _ in range(1000):
                time.sleep(0.005)
                task.check()
            return "too late"

        task = jobs.Task("a", 0, work)
        self.worker.submit(task)
        started.wait(10)
        self.assertTrue(self.worker.cancel("a"))
        self.finish()
        self.assertEqual(self.given, [])
        self.assertFalse(self.worker.cancel("a"))
        self.assertIsNone(task.error)

    def test_an_error_comes_with_its_task(self):
        self.worker.submit(jobs.Task("a", 0, lambda task: 1 // 0))
        self.finish()
        self.assertIsInstance(self.given[0].error, ZeroDivisionError)

    def finish(self):
        end = time.monotonic() + 10
        while self.worker._threads and time.monotonic() < end:
            time.sleep(0.001)


class OtherProcess(WithFolder):
    def setUp(self):
        super().setUp()
        self.process = process.Process(PACKAGE, PROGRAM, self.folder)
        self.addCleanup(self.process.end)

    def about(self, **options):
        return {"request": vars(request.Request(**{"file": self.molecule(), **options})), "atoms": None, "others": [], "scale": 0.1,
                "crisp": False}

    def finished(self, job):
        self.process.wait(job)
        if job.error:
            raise job.error
        return job.result

    def slow(self):
        """Returns a process whose program sleeps and writes its own process number."""
        path = os.path.join(self.folder, "slow")
        with open(path, "w", encoding="ascii") as file:
            file.write(f"#!/bin/sh\necho $$ >{self.folder}/pid\nexec sleep 60\n")
        os.chmod(path, 0o755)
        made = process.Process(self.folder, path, self.folder)  # The library would read the file itself.
        self.addCleanup(made.end)
        return made

    def number_of_program(self):
        path, end = os.path.join(self.folder, "pid"), time.monotonic() + 20
        while time.monotonic() < end:
            if os.path.exists(path) and os.path.getsize(path):
                with open(path, encoding="ascii") as file:
                    return int(file.read())
            time.sleep(0.01)
        self.fail("the program was not called")

    def assert_gone(self, number):
        end = time.monotonic() + 10
        while os.path.exists(f"/proc/{number}") and time.monotonic() < end:
            time.sleep(0.01)
        self.assertFalse(os.path.exists(f"/proc/{number}"))

    def test_it_gives_what_this_process_would_compute(self):
        self.assertIn("libmeniscus", self.process.describe_tools()["library"])
        self.assertEqual(self.process.describe_tools()["program"], os.path.abspath(PROGRAM))
        about = self.about(probe=1.2)
        found = self.finished(self.process.submit("a", "k", "surface", about))
        surface = engines.compute(engines.find_tools(PACKAGE, PROGRAM), request.Request(**about["request"]), None, self.folder, Quiet())
        wanted = mesh_arrays.of_surface(surface, 0.1, False, mesh_arrays.names_of(surface), found["middle"])
        self.assertEqual(found["header"]["area"], surface.header["area"])
        for name in ("positions", "triangles", "normals", "slots", "ses_atom"):
            np.testing.assert_array_equal(found["arrays"][name], getattr(wanted, name), name)
        self.assertEqual([each[:3] for each in found["arrays"]["attributes"]], [each[:3] for each in wanted.attributes])

    def test_atoms_go_there_with_their_attributes(self):
        given = {"positions": np.array([[0.0, 0, 0], [9, 0, 0]]), "radii": np.ones(2), "colors": np.ones((2, 3)), "index": np.arange(2),
                 "numbers": {}, "chain_names": [], "kind_colors": None, "source": "two"}
        own = {"name": "own", "kind": "FLOAT", "domain": "POINT", "values": np.array([[3.0], [7.0]]), "known": np.ones(2, bool)}
        found = self.finished(self.process.submit("a", "k", "surface", {**self.about(file=""), "atoms": given, "others": [own]}))
        (values,) = [values for name, *_, values in found["arrays"]["attributes"] if name == "own"]
        np.testing.assert_array_equal(values[:, 0], np.where(found["arrays"]["positions"][:, 0] < 0.45, 3.0, 7.0))
        np.testing.assert_array_equal(found["middle"], [4.5, 0, 0])

    def test_what_is_newer_comes_instead_of_what_waited(self):
        about = [self.about(probe=probe) for probe in np.linspace(1.0, 2.0, 30)]  # Each writes the molecule's file, which the other reads.
        asked = [self.process.submit("a", each["request"]["probe"], "surface", each) for each in about]
        self.process.wait(asked[-1])
        self.assertFalse(self.process.is_busy())
        done = [job for job in asked if job.is_done]
        self.assertLess(len(done), 25)
        self.assertTrue(all(job.result["header"]["probe_radius"] == job.key for job in done))

    def test_errors_come_in_words(self):
        with self.assertRaisesRegex(engines.EngineError, "chain Q"):
            self.finished(self.process.submit("a", "k", "surface", self.about(selection="chain Q")))

    def test_what_is_stopped_ends_at_once_and_with_what_it_started(self):
        slow = self.slow()
        job, other = slow.submit("a", "k", "surface", self.about()), slow.submit("b", "k", "surface", self.about())
        number = self.number_of_program()
        self.assertTrue(slow.stop("a"))
        self.assert_gone(number)
        self.assertEqual((job.is_done, slow.take()), (False, [other]))
        self.assertIn("stopped", str(other.error))
        self.assertFalse(slow.is_busy())

    def test_what_is_dropped_gives_nothing_and_the_next_begins_soon(self):
        slow = self.slow()
        slow.submit("a", "k", "surface", self.about())
        self.number_of_program()
        self.assertTrue(slow.drop("a"))
        os.remove(os.path.join(self.folder, "pid"))
        slow.submit("b", "k", "surface", self.about())
        self.number_of_program()

    def test_if_it_dies_that_is_said_and_it_starts_anew(self):
        slow = self.slow()
        job = slow.submit("a", "k", "surface", self.about())
        number = self.number_of_program()
        os.kill(slow._child.pid, 9)
        slow.wait(job)
        self.assertIn("signal 9", str(job.error))
        self.assert_gone(number)
        os.remove(os.path.join(self.folder, "pid"))
        slow.submit("a", "k", "surface", self.about())
        self.number_of_program()

    def test_it_ends_with_the_one_that_asked(self):
        slow = self.slow()
        slow.submit("a", "k", "surface", self.about())
        number, child = self.number_of_program(), slow._child
        slow._connection.close()
        self.assertEqual(child.wait(10), -9)
        self.assert_gone(number)

    def test_no_thread_of_python_lives_in_this_one(self):
        job = self.process.submit("a", "k", "surface", self.about())
        self.assertEqual(threading.enumerate(), [threading.main_thread()])
        self.finished(job)
        self.assertEqual(threading.enumerate(), [threading.main_thread()])


if __name__ == "__main__":
    unittest.main()
