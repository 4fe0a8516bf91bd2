# SPDX-License-Identifier: BSD-3-Clause
"""Any number of workers share one bundle: each frame is made once, and another worker makes those of a dead one."""

import contextlib
import json
import os
import signal
import subprocess
import time

from farm_case import FarmCase, MENISCUS, main, processes_in, sums, wait_until

FRAMES = 12


class Claims(FarmCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.reference = cls("test_four_workers_make_every_frame_once").povray_bundle("reference", FRAMES)
        subprocess.run([MENISCUS, "work", cls.reference, "--progress", "none"], check=True)

    def start(self, folder, *more):
        return subprocess.Popen([MENISCUS, "work", folder, "--progress", "json", *more], stderr=subprocess.PIPE,
                                text=True)

    def made_by(self, worker, code=0):
        """(step, frame) of all that the worker says it made; steps by the order of their first frames."""
        said = worker.communicate(timeout=240)[1]
        self.assertEqual(worker.returncode, code, said)
        return [frame["files"][0] for line in said.splitlines() if line.startswith("{")
                for frame in [json.loads(line)] if frame.get("event") == "frame" and frame["state"] == "done"]

    def assert_equals_reference(self, folder):
        for place, pattern in (("images", "*.png"), ("scene", "*")):
            self.assertEqual(sums(folder / place, pattern), sums(self.reference / place, pattern))
        self.assertEqual(list((folder / "state").rglob("*claim*")), [])
        self.assertEqual(list((folder / "state" / "workers").iterdir()), [])
        self.assert_nothing_unfinished(folder)

    def claims_of(self, folder, worker):
        """Claims that a process holds."""
        name = f"-{worker.pid}-"
        found = []
        for path in (folder / "state").rglob("*.claim*"):
            try:
                if name in path.read_text():
                    found.append(path)
            except FileNotFoundError:
                pass  # given back meanwhile
        return found

    def life_of(self, folder, worker):
        return next((folder / "state" / "workers").glob(f"*-{worker.pid}-*.json"), None)

    def wait_for_signs(self, folder, worker, count):
        """Until a worker has said that it lives, so many times from now on."""
        wait_until(lambda: self.life_of(folder, worker), what="a worker")
        life = self.life_of(folder, worker)
        for _ in range(count):
            last = life.stat().st_mtime_ns
            wait_until(lambda: life.stat().st_mtime_ns != last, what="a sign of life")

    def test_four_workers_make_every_frame_once(self):
        folder = self.povray_bundle("four", FRAMES)
        workers = [self.start(folder, "--threads", "1") for _ in range(4)]
        made = [self.made_by(worker) for worker in workers]
        every = sorted(sum(made, []))
        self.assertEqual(len(every), 2 * FRAMES, every)
        self.assertEqual(len(set(every)), 2 * FRAMES, "made twice")
        self.assertGreater(sum(len(frames) > 0 for frames in made), 1, "one worker made all")
        self.assert_equals_reference(folder)
        # The same with frames that are there: all are made again, once.
        workers = [self.start(folder, "--force", "--step", "surface", "--threads", "1") for _ in range(3)]
        again = sorted(sum((self.made_by(worker) for worker in workers), []))
        self.assertGreaterEqual(len(again), FRAMES)
        self.assertEqual(len(set(again)), FRAMES)
        self.assert_equals_reference(folder)

    def test_frames_of_a_killed_worker_are_made_by_another(self):
        """On this machine at once: its process is gone."""
        folder = self.povray_bundle("killed", FRAMES)
        worker = self.start(folder, "--lease", "3600")
        wait_until(lambda: self.claims_of(folder, worker) and self.records(folder, "surface"), what="a frame")
        other = self.start(folder)
        worker.kill()
        worker.wait()
        self.made_by(other)
        self.assertEqual(len(sums(folder / "images", "*.png")), FRAMES)
        self.meniscus("farm", "verify", folder)
        self.assert_nothing_unfinished(folder)

    def test_elsewhere_a_worker_is_dead_when_its_lease_is_over(self):
        """A worker of another machine that is not heard of: what it has is waited for, and made when its lease ends."""
        folder = self.povray_bundle("lease", 4)
        worker = self.start(folder, "--lease", "5", "--step", "surface")
        wait_until(lambda: self.claims_of(folder, worker), what="a claim")
        held = {path.name: path.read_text() for path in self.claims_of(folder, worker)}
        life = self.life_of(folder, worker)
        said = json.loads(life.read_text())
        worker.kill()
        worker.wait()
        for name, text in held.items():
            (folder / "state" / "surface" / name).write_text(text)
        life.write_text(json.dumps({**said, "space": "another machine"}))
        begin = time.monotonic()
        made = self.made_by(self.start(folder))
        self.assertGreater(time.monotonic() - begin, 4.0)
        for name in held:
            if not (folder / "state" / "surface" / f"{name.split('.')[0]}.json").exists():
                self.fail(f"{name} was not taken over")
        self.assertEqual(len(sums(folder / "images", "*.png")), 4)
        self.assertEqual(len(set(made)), len(made))

    def test_a_worker_that_lives_is_waited_for(self):
        """However long it is silent about frames; a share that another works on is not finished until that is."""
        folder = self.povray_bundle("slow", 2)
        worker = self.start(folder, "--lease", "4", "--chunk", "1/1")
        wait_until(lambda: self.claims_of(folder, worker), what="a claim")
        def stopped_children():
            children = [child for child in processes_in(folder) if child != worker.pid]
            for child in children:
                with contextlib.suppress(ProcessLookupError):
                    os.kill(child, signal.SIGSTOP)
            return children
        wait_until(stopped_children, what="a process that makes a frame")
        hour_ago = time.time() - 3600
        for path in self.claims_of(folder, worker):
            os.utime(path, (hour_ago, hour_ago))
        other = self.start(folder, "--lease", "4")
        self.wait_for_signs(folder, other, 3)
        self.wait_for_signs(folder, worker, 1)
        self.assertIsNone(other.poll())
        for child in processes_in(folder):
            os.kill(child, signal.SIGCONT)
        made = self.made_by(worker) + self.made_by(other)
        self.assertEqual(len(set(made)), len(made), "made twice")
        self.assertEqual(len(sums(folder / "images", "*.png")), 2)

    def test_a_worker_that_is_stopped_gives_its_frames_back(self):
        folder = self.povray_bundle("stopped", FRAMES)
        worker = self.start(folder, "--lease", "3600")
        wait_until(lambda: self.claims_of(folder, worker), what="a claim")
        worker.send_signal(signal.SIGTERM)
        self.made_by(worker, code=9)
        self.assertEqual(list((folder / "state").rglob("*claim*")), [])
        self.made_by(self.start(folder))
        self.assert_equals_reference(folder)

    def test_a_frame_that_fails_fails_once_for_all(self):
        folder = self.povray_bundle("failing", 6, bad_frame=3)
        workers = [self.start(folder) for _ in range(2)]
        tries = 0
        for worker in workers:
            said = worker.communicate(timeout=240)[1]
            self.assertEqual(worker.returncode, 3, said)
            tries += said.count('"state":"done"')
        self.assertEqual(tries, 10)
        self.assertEqual(len(sums(folder / "images", "*.png")), 5)

    def test_claims_and_workers_that_make_no_sense(self):
        """Whatever lies there, a worker neither waits for ever nor leaves the folder."""
        folder = self.povray_bundle("odd", 4)
        surface, workers = folder / "state" / "surface", folder / "state" / "workers"
        surface.mkdir(parents=True)
        workers.mkdir()
        (workers / "host-1-a.json").write_text('{"lease": 1e300, "process": -1, "space": 3}')
        (workers / "host-2-b.json").write_text("[")
        for name, text in (("00000.claim1", "../../bundle\n"), ("00001.claim1", "nobody\n"), ("00002.claim1", ""),
                           ("00003.claim1", "host-1-a\n"), ("00003.claim2", "host-2-b\n")):
            (surface / f"frame_{name}").write_text(text)
        hour_ago = time.time() - 4000
        for path in (*surface.iterdir(), *workers.iterdir()):
            os.utime(path, (hour_ago, hour_ago))
        self.assertEqual(len(self.made_by(self.start(folder))), 8)
        self.meniscus("farm", "verify", folder)


if __name__ == "__main__":
    main()
