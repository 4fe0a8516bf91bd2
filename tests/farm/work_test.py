# SPDX-License-Identifier: BSD-3-Clause
"""meniscus work on one machine: kills, stops, failures, damage; and what status and verify say about them."""

import json
import os
import shutil
import signal
import subprocess
import time

from farm_case import FarmCase, MENISCUS, main, processes_in, sample_run, sums, wait_until


class Work(FarmCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.reference = cls("test_kill_and_resume").povray_bundle("reference", options=("--chunk-frames", "5", "--film",
                                                                                        "film.mp4"))
        subprocess.run([MENISCUS, "work", cls.reference, "--progress", "none"], check=True)

    def start(self, folder, *more):
        return subprocess.Popen([MENISCUS, "work", folder, "--progress", "none", *more])

    def assert_equals_reference(self, folder):
        for place, pattern in (("images", "*.png"), ("scene", "*.inc"), ("scene", "*.pov"), ("scene", "*.ini")):
            expected = sums(self.reference / place, pattern)
            self.assertGreater(len(expected), 0)
            self.assertEqual(sums(folder / place, pattern), expected)

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

    def test_a_renderer_ends_with_its_worker(self):
        """Even one that would go on for a minute, and even when the worker is killed without a chance to say so."""
        folder = self.povray_bundle("endless")
        self.meniscus("work", folder, "--step", "surface")
        endless = self.folder / "endless_bin"
        endless.mkdir()
        (endless / "povray").write_text("#!/bin/sh\nexec sleep 60\n")
        (endless / "povray").chmod(0o755)
        for number, code in ((signal.SIGKILL, -9), (signal.SIGTERM, 9)):
            worker = subprocess.Popen([MENISCUS, "work", folder, "--progress", "none"],
                                      env=dict(os.environ, PATH=f"{endless}:{os.environ['PATH']}"))
            wait_until(lambda: processes_in(folder / "scene"), what="the renderer")
            worker.send_signal(number)
            self.assertEqual(worker.wait(20), code)
            wait_until(lambda: not processes_in(folder), 10, "the renderer to end")
        self.assertEqual(self.records(folder, "render"), {})

    def test_a_frame_that_kills_its_process_costs_one_frame(self):
        """As one that needs more memory than there is: that frame has failed, another process makes the others."""
        molecule = sample_run(self.folder / "fatal.pdb", 5)
        folder = self.bundle("fatal", "render", molecule, "--frames", "all", "--size", "640x480", "--samples", "16")
        worker = self.start(folder)
        wait_until(lambda: self.records(folder, "render"), what="a frame")
        child = next(number for number in processes_in(folder) if number != worker.pid)
        os.kill(child, signal.SIGKILL)
        self.assertEqual(worker.wait(120), 5)
        records = self.records(folder, "render")
        failed = [frame for frame, record in records.items() if record["state"] == "failed"]
        self.assertEqual((len(records), len(failed)), (5, 1))
        self.assertIn("was killed", records[failed[0]]["error"])
        self.meniscus("work", folder)
        self.meniscus("farm", "verify", folder)

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

    def test_a_renderer_that_fails_is_told(self):
        folder = self.povray_bundle("broken")
        self.meniscus("work", folder, "--step", "surface")
        self.assertIn("do that step first", self.meniscus(
            "work", self.povray_bundle("unbegun"), "--step", "render", code=3).stderr)
        style = folder / "scene" / "surface_style.inc"
        style.write_text("#error \"no style\"\n")
        result = self.meniscus("work", folder, "--step", "render", "--frames", "0-1", code=3)
        self.assertIn("povray ended with code", result.stderr)
        missing = self.meniscus("work", folder, "--step", "render", "--frames", "0", code=3,
                                env={"PATH": "/nonexistent"})
        self.assertIn("povray: cannot be started", missing.stderr)

    def test_verify_finds_every_damage_and_work_repairs_it(self):
        folder = self.povray_bundle("damaged", options=("--chunk-frames", "5", "--film", "film.mp4"))
        self.meniscus("work", folder)
        self.meniscus("farm", "verify", folder)
        film = sums(folder, "film.mp4")
        images = folder / "images"
        (images / "frame_00001.png").unlink()
        (images / "frame_00002.png").write_bytes((images / "frame_00000.png").read_bytes()[:100])
        (images / "frame_00004.png").write_bytes((images / "frame_00005.png").read_bytes())
        (folder / "state" / "render" / "frame_00006.json").write_text("{")
        (folder / "film.mp4").unlink()
        told = self.meniscus("farm", "verify", folder, code=3).stderr
        for line in ("frame 1: images/frame_00001.png: is missing", "frame 2: images/frame_00002.png: is not what",
                     "frame 4: images/frame_00004.png: is not what", "frame 6: is not made yet", "4 of 16"):
            self.assertIn(line, told)
        self.assertFalse((folder / "film.mp4").exists())
        self.meniscus("work", folder)
        self.meniscus("farm", "verify", folder)
        self.assert_equals_reference(folder)
        self.assertEqual(sums(folder, "film.mp4"), film)
        probe = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-select_streams", "v", "-show_entries",
                                "stream=nb_read_frames,width,height,pix_fmt,codec_name", "-of", "json",
                                folder / "film.mp4"], capture_output=True, text=True, check=True)
        stream = json.loads(probe.stdout)["streams"][0]
        self.assertEqual((stream["codec_name"], stream["width"], stream["height"], stream["pix_fmt"],
                          stream["nb_read_frames"]), ("h264", 160, 120, "yuv420p", "8"))

    def test_pictures_that_are_blank_or_of_another_size_are_not_good(self):
        """The renderer looks past the molecule, or is told another size: its own record is good, the picture is not."""
        molecule = sample_run(self.folder / "blank.pdb", 2)
        camera = json.loads((self.reference / "inputs" / "camera.json").read_text())
        camera["position"], camera["target"] = camera["target"], camera["position"]
        camera["position"] = [value + 500.0 for value in camera["position"]]
        camera["target"] = [value + 1000.0 for value in camera["target"]]
        away = self.folder / "away.json"
        away.write_text(json.dumps(camera))
        blank = self.bundle("blank", "render", molecule, "--frames", "all", "--size", "40x30", "--camera", away,
                            "--background", "white")
        self.meniscus("work", blank)
        self.assertIn("blank", self.meniscus("farm", "verify", blank, code=3).stderr)
        large = self.bundle("large", "export", "povray", molecule, "--frames", "all", "--size", "40x30", "--", "+W80",
                            "+H60")
        self.meniscus("work", large)
        self.assertIn("is 80x60 pixels, not 40x30", self.meniscus("farm", "verify", large, code=3).stderr)

    def test_inputs_that_changed_and_damaged_bundles_are_refused(self):
        folder = self.povray_bundle("changed")
        for path in (folder / "inputs").glob("*.pdb"):
            path.write_text(path.read_text().replace("MODEL        2", "MODEL        9"))
        self.assertIn("not what was bundled", self.meniscus("work", folder, code=3).stderr)
        manifest = folder / "bundle.json"
        text = manifest.read_text()
        for broken in (text[:200], text.replace('"program_version": "', '"program_version": "9'), text.replace('"schema_version": 1', '"schema_version": 2'),
                       text.replace('"inputs/camera.json",\n      "bytes"', '"../camera.json",\n      "bytes"')):
            self.assertNotEqual(broken, text)
            manifest.write_text(broken)
            self.assertIn("bundle.json", self.meniscus("work", folder, code=3).stderr)
        self.assertIn("cannot be opened", self.meniscus("work", self.folder / "nowhere", code=3).stderr)

    def test_records_of_another_bundle_count_for_nothing(self):
        """Frames of an older bundle, copied into the folder of a newer one, are not taken for its own."""
        molecule = sample_run(self.folder / "two.pdb", 2)
        old, new = (self.bundle(name, "render", molecule, "--frames", "all", "--size", size)
                    for name, size in (("old", "40x30"), ("new", "60x45")))
        self.meniscus("work", old)
        for place in ("state", "images"):
            shutil.copytree(old / place, new / place)
        self.assertIn("is not made yet", self.meniscus("farm", "verify", new, code=3).stderr)
        self.meniscus("work", new)
        self.meniscus("farm", "verify", new)

    def test_a_missing_gpu_is_exit_four_for_farms_that_need_one(self):
        folder = self.povray_bundle("gpu")
        for options in (("--require-gpu", "--device", "cpu"), ("--require-gpu", "--device", "software")):
            self.assertIn("--require-gpu", self.meniscus("work", folder, "--step", "surface", *options, code=4).stderr)

    def test_blender_renders_the_same_bytes_in_any_division(self):
        molecule = sample_run(self.folder / "blender.pdb", 2, atoms=60)

        def bundle(name):
            return self.bundle(name, "export", "blender", molecule, "--frames", "all", "--size", "64x48", "--device",
                               "cpu", "--", "--samples", "2", options=("--chunk-frames", "1", "--film", "film.mp4"))

        whole, parts = bundle("blender $HOME"), bundle("blender parts")
        self.meniscus("work", whole)
        self.meniscus("farm", "verify", whole)
        self.meniscus("work", parts, "--step", "surface")
        self.meniscus("work", parts, "--step", "render", "--chunk", "2/2")
        (parts / "scene" / "surface_00000.mns").write_bytes(b"")
        self.assertIn("do that step first", self.meniscus("work", parts, "--step", "render", code=3).stderr)
        self.meniscus("work", parts)
        self.meniscus("farm", "verify", parts)
        for place, pattern in (("images", "*.png"), (".", "film.mp4"), ("scene", "*")):
            self.assertEqual(sums(parts / place, pattern), sums(whole / place, pattern))
        self.assertEqual(len(sums(whole / "images", "*.png")), 2)

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
