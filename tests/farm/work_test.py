# SPDX-License-Identifier: BSD-3-Clause
"""meniscus work on one machine: kills, stops, failing frames, shares."""

import json
import signal
import time

from farm_case import WorkCase, main, processes_in, sums, wait_until


class Work(WorkCase):
    def test_kill_and_resume(self):
        """kill -9 in either step leaves no process behind; the same command goes on, with the same bytes at the end."""
        folder = self.povray_bundle("killed")
        for step, count in (("surface", 2), ("render", 3)):
            worker = self.start(folder)
            wait_until(lambda: len(self.records(folder, step)) >= count, what=f"{count} frames of {step}")
            worker.kill()
            worker.wait()
            wait_until(lambda: not processes_in(folder), 5, "the children to end")
            self.assertLess(len(self.records(folder, "render")), 8)
        made = {frame: (folder / "images" / f"frame_{frame:05}.png").stat().st_mtime_ns
                for frame in self.records(folder, "render")}
        self.meniscus("work", folder)
        self.assert_equals_reference(folder)
        for frame, when in made.items():
            self.assertEqual((folder / "images" / f"frame_{frame:05}.png").stat().st_mtime_ns, when, "made twice")
        self.meniscus("farm", "verify", folder)
        self.assert_nothing_unfinished(folder)

    def test_stops_promptly_and_in_good_order(self):
        folder = self.povray_bundle("stopped")
        self.meniscus("work", folder, "--step", "surface")
        for number in (signal.SIGTERM, signal.SIGUSR1):
            worker = self.start(folder, "--step", "render")
            before = len(self.records(folder, "render"))
            wait_until(lambda: len(self.records(folder, "render")) > before, what="a frame")
            begin = time.monotonic()
            worker.send_signal(number)
            self.assertEqual(worker.wait(), 9)
            self.assertLess(time.monotonic() - begin, 3.0)
            self.assertEqual({record["state"] for record in self.records(folder, "render").values()}, {"done"})
            self.assertEqual(processes_in(folder), [])
            self.assert_nothing_unfinished(folder)
        self.meniscus("work", folder)
        self.assert_equals_reference(folder)

    def test_stopped_while_it_copies_a_scene(self):
        """What is copied for a frame is gone after a stop, also when the stop comes in the middle of the copying."""
        folder = self.povray_bundle("copying", 2)
        self.meniscus("work", folder, "--step", "surface")
        for number in range(3000):
            (folder / "scene" / f"surface_volume_{number}.df3").write_bytes(b"0" * 10)
        worker = self.start(folder, "--step", "render")
        wait_until(lambda: any(folder.glob("images/.povray_*/*.df3")), what="the first copy")
        worker.send_signal(signal.SIGTERM)
        self.assertEqual(worker.wait(), 9)
        self.assert_nothing_unfinished(folder)

    def test_shares_make_the_whole(self):
        folder = self.povray_bundle("shares")
        for k in (3, 1, 2):
            self.meniscus("work", folder, "--step", "surface", "--chunk", f"{k}/3")
        self.meniscus("work", folder, "--step", "render", "--frames", "7,0-4")
        self.assertEqual(sorted(self.records(folder, "render")), [0, 1, 2, 3, 4, 7])
        self.meniscus("work", folder, "--step", "render", "--chunk", "2/2")
        self.assert_equals_reference(folder)
        for bad in (("--chunk", "0/3"), ("--chunk", "4/3"), ("--chunk", "1"), ("--frames", "8"), ("--step", "paint")):
            self.meniscus("work", folder, *bad, code=2)

    def test_a_failing_frame_has_its_own_code_and_stops_nobody(self):
        folder = self.povray_bundle("failing", bad_frame=3)
        result = self.meniscus("work", folder, "--progress", "json", code=3)
        self.assertIn("1 of 8 frames failed; the first, frame 3", result.stderr)
        self.assertEqual(len(sums(folder / "images", "*.png")), 7)
        record = self.records(folder, "surface")[3]
        self.assertEqual((record["state"], record["exit"]), ("failed", 3))
        # The step behind it alone says the same.
        self.assertIn("nan", self.meniscus("work", folder, "--step", "render", code=3).stderr)
        status = json.loads(self.meniscus("farm", "status", folder, "--json").stdout)
        surface, render = status["steps"]
        self.assertEqual((surface["done"], surface["missing"], len(surface["failed"])), (7, 0, 1))
        self.assertEqual((render["done"], render["missing"]), (7, 1))
        self.assertIn("frame 3, exit code 3", self.meniscus("farm", "status", folder).stdout)
        self.assertIn("frame 3: failed", self.meniscus("farm", "verify", folder, code=3).stderr)

    def test_progress_styles(self):
        folder = self.povray_bundle("progress", frames=2)
        openjd = self.meniscus("work", folder, "--step", "surface", "--progress", "openjd")
        self.assertIn("openjd_progress: 100.0\n", openjd.stdout)
        self.assertIn("openjd_status: ", openjd.stdout)
        lines = self.meniscus("work", folder, "--step", "render", "--progress", "json").stderr.splitlines()
        events = [json.loads(line) for line in lines]
        self.assertEqual([event["event"] for event in events], ["start", "frame", "frame", "end"])
        self.assertEqual(events[1]["files"], ["images/frame_00000.png"])
        self.assertEqual(self.meniscus("work", folder, "--progress", "none").stderr, "")


if __name__ == "__main__":
    main()
