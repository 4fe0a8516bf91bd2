# SPDX-License-Identifier: BSD-3-Clause
"""Frames that fail are tried again later, as often as was asked for; a bundle that is paused waits."""

import json
import os
import re
import signal
import subprocess
import time

from farm_case import MENISCUS, WorkCase, main, processes_in, wait_until

# Fails for frame 3 as often as a file says, and notes when.
POVRAY = """#!/bin/sh
case "$*" in *"+SF3 "*)
  date +%s.%N >> "$FARM_TEST/tries"
  if [ "$(wc -l < "$FARM_TEST/tries")" -le "$(cat "$FARM_TEST/failures")" ]; then echo "no licence left"; exit 1; fi
esac
exec /usr/bin/povray "$@"
"""


class Tries(WorkCase):
    def failing(self, name, failures, *options):
        """A bundle, and an environment whose POV-Ray fails so many times at frame 3."""
        place = self.folder / f"{name}_bin"
        place.mkdir()
        (place / "povray").write_text(POVRAY)
        (place / "povray").chmod(0o755)
        (place / "failures").write_text(str(failures))
        folder = self.povray_bundle(name, options=("--chunk-frames", "5", "--film", "film.mp4", *options))
        return folder, {**os.environ, "PATH": f"{place}:{os.environ['PATH']}", "FARM_TEST": str(place)}

    def tries(self, environment):
        """When frame 3 was tried."""
        path = os.path.join(environment["FARM_TEST"], "tries")
        if not os.path.exists(path):
            return []
        with open(path) as lines:
            return [float(line) for line in lines]

    def failed(self, folder):
        return json.loads(self.meniscus("farm", "status", folder, "--json").stdout)["steps"][1]["failed"]

    def test_a_frame_that_fails_is_tried_again_later(self):
        folder, environment = self.failing("again", 2, "--tries", "3", "--retry-wait", "1")
        said = self.meniscus("work", folder, env=environment).stderr
        self.assertIn("frame 3 failed, try 1 of 3, the next in 1 s: ", said)
        self.assertIn("frame 3 failed, try 2 of 3, the next in 2 s: ", said)
        first, second, third = self.tries(environment)
        self.assertGreater(second - first, 1.0)
        self.assertGreater(third - second, 2.0)
        self.assert_equals_reference(folder)
        self.meniscus("farm", "verify", folder)

    def test_it_fails_after_so_many_tries_and_workers_count_together(self):
        folder, environment = self.failing("most", 99, "--tries", "3", "--retry-wait", "0.5")
        workers = [subprocess.Popen([MENISCUS, "work", folder, "--progress", "none"], env=environment,
                                    stderr=subprocess.DEVNULL) for _ in range(2)]
        self.assertEqual([worker.wait(240) for worker in workers], [3, 3])
        self.assertEqual(len(self.tries(environment)), 3)
        record = self.records(folder, "render")[3]
        self.assertEqual((record["state"], record["tries"], "again" in record), ("failed", 3, False))
        self.assertRegex(self.meniscus("farm", "status", folder).stdout, "render frame 3, exit code 3, 3 tries: .*licence")
        self.assertIn(", 3 times, exit code 3", self.meniscus("farm", "log", folder, "3").stdout)
        # By hand once more: it begins anew, with as many tries as this worker has.
        self.meniscus("work", folder, "--tries", "1", code=3, env=environment)
        self.assertEqual(len(self.tries(environment)), 4)
        self.assertNotIn("tries", self.records(folder, "render")[3])
        # The film is made in spite of it, and says what it lacks.
        self.assertIn("1 missing: 3", self.meniscus("farm", "verify", folder, "--allow-missing", "hold").stdout)

    def test_status_tells_of_the_next_try_and_another_worker_makes_it(self):
        folder, environment = self.failing("told", 1, "--tries", "2", "--retry-wait", "15")
        worker = subprocess.Popen([MENISCUS, "work", folder, "--frames", "3", "--progress", "none"], env=environment,
                                  stderr=subprocess.DEVNULL)
        wait_until(lambda: self.records(folder, "render"), what="a failure")
        self.assertRegex(self.meniscus("farm", "status", folder).stdout,
                         r"render frame 3, exit code 3, 1 try, the next in \d+ s: ")
        (frame,) = self.failed(folder)
        self.assertEqual((frame["frame"], frame["tries"], frame["again_after_seconds"]), (3, 1, 15))
        self.assertIsNone(worker.poll())
        worker.kill()
        worker.wait()
        self.meniscus("work", folder, env=environment)
        first, second = self.tries(environment)
        self.assertGreater(second - first, 15.0)
        self.assert_equals_reference(folder)

    def test_pictures_wait_for_the_second_try_of_their_scene(self):
        """A frame that cannot be read fails twice, and then its picture, too, without another wait."""
        folder = self.povray_bundle("scene", bad_frame=3, options=("--chunk-frames", "5", "--tries", "2", "--retry-wait", "1"))
        said = self.meniscus("work", folder, code=3).stderr
        self.assertIn("try 1 of 2", said)
        self.assertEqual(self.records(folder, "surface")[3]["tries"], 2)
        self.assertEqual(sorted(self.records(folder, "render")), [0, 1, 2, 4, 5, 6, 7])

    def test_numbers_that_make_no_sense(self):
        """A record that asks for a rest without end counts for nothing; a manifest likewise."""
        folder = self.povray_bundle("odd")
        self.meniscus("work", folder, "--frames", "0")
        path = folder / "state" / "render" / "frame_00000.json"
        record = json.loads(path.read_text())
        path.write_text(json.dumps({**record, "state": "failed", "exit": 3, "error": "x", "tries": 1, "again": 1e300}))
        begin = time.monotonic()
        self.meniscus("work", folder, "--frames", "0", "--tries", "5")
        self.assertLess(time.monotonic() - begin, 60)
        manifest = json.loads((folder / "bundle.json").read_text())
        for tries in ({"most": 0, "wait_seconds": 1}, {"most": 1e9, "wait_seconds": 1}, {"most": 2, "wait_seconds": 1e9}, {}):
            (folder / "bundle.json").write_text(json.dumps({**manifest, "tries": tries}))
            self.assertIn("bundle.json", self.meniscus("work", folder, code=3).stderr)


class Pause(WorkCase):
    def test_a_paused_bundle_waits_and_goes_on(self):
        folder = self.povray_bundle("paused")
        self.meniscus("work", folder, "--step", "surface")
        # Its share is one batch, which is cut off.
        said = self.folder / "said"
        with said.open("w") as messages:
            worker = subprocess.Popen([MENISCUS, "work", folder, "--step", "render", "--chunk", "1/1"], stderr=messages)
        wait_until(lambda: self.records(folder, "render"), what="a frame")
        for _ in range(2):
            self.meniscus("farm", "pause", folder)
        # It says so after it has given back the frames that it did not make.
        wait_until(lambda: "paused; " in said.read_text(), what="an end of the work")
        self.assertEqual(processes_in(folder), [])
        second = self.start(folder)
        wait_until(lambda: len(list((folder / "state" / "workers").glob("[!.]*.json"))) == 2, what="the second worker")
        before = {path: path.stat().st_mtime_ns for path in folder.rglob("*.*") if "workers" not in path.parts}
        self.assertLess(len(self.records(folder, "render")), 8)
        time.sleep(2)
        self.assertEqual({path: path.stat().st_mtime_ns for path in folder.rglob("*.*") if "workers" not in path.parts}, before)
        self.assertEqual(list((folder / "state").rglob("*claim*")), [])
        self.assertIn("paused, 2 workers wait; to go on: meniscus farm resume", self.meniscus("farm", "status", folder).stdout)
        self.assertTrue(json.loads(self.meniscus("farm", "status", folder, "--json").stdout)["paused"])
        second.send_signal(signal.SIGTERM)
        self.assertEqual(second.wait(20), 9)
        self.assertIsNone(worker.poll())
        for _ in range(2):
            self.meniscus("farm", "resume", folder)
        self.assertEqual(worker.wait(240), 0, said.read_text())
        self.assertTrue(re.search(r"paused; to go on: meniscus farm resume \S+", said.read_text()), said.read_text())
        self.meniscus("farm", "verify", folder)
        self.assert_equals_reference(folder)
        self.assert_nothing_unfinished(folder)

    def test_only_a_file_is_a_pause(self):
        folder = self.povray_bundle("linked")
        (folder / "state").mkdir()
        (folder / "state" / "paused").symlink_to("/etc/passwd")
        for command in (("work",), ("farm", "pause"), ("farm", "resume")):
            self.assertIn("symbolic link", self.meniscus(*command, folder, code=3).stderr)


if __name__ == "__main__":
    main()
