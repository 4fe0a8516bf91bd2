# SPDX-License-Identifier: BSD-3-Clause
"""Tests meniscus work and farm verify on one machine: kills, stops, several workers, full disks, bad frames, damage."""

import json
import os
import random
import shutil
import signal
import subprocess
import time

from farm_case import MENISCUS, WorkCase, main, processes_in, sample_run, sums, wait_until

SCENES = "scene/frame_*.done"
SMALL = ("--frames", "all", "--size", "40x30")


class Work(WorkCase):
    def test_kill_and_resume(self):
        """kill -9 at any moment leaves no process behind; the same command goes on, with the same bytes at the end."""
        folder = self.povray_bundle("killed")
        moments = [(SCENES, 2), ("images/frame_*.png", 1), ("images/frame_*.png", 3), *5 * [None]]
        for moment in moments:
            worker = self.start(folder)
            if moment:
                wait_until(lambda: len(self.made(folder, moment[0])) >= moment[1], what=str(moment))
            else:
                time.sleep(random.uniform(0.0, 0.5))
            worker.kill()
            worker.wait()
            wait_until(lambda: not processes_in(folder), 5, "the children to end")
        made = {path: path.stat().st_mtime_ns for path in folder.glob("images/frame_*.png")}
        self.meniscus("work", folder)
        self.assert_equals_reference(folder)
        for path, when in made.items():
            self.assertEqual(path.stat().st_mtime_ns, when, "made twice")
        self.meniscus("farm", "verify", folder)
        self.assert_nothing_unfinished(folder)

    def test_a_worker_that_is_stopped_ends_its_renderer(self):
        """A renderer that would go on for a minute ends, too, even if the worker is killed."""
        folder = self.povray_bundle("stopped")
        self.meniscus("work", folder, "--step", "surface")
        endless = self.programs("endless_bin", povray="#!/bin/sh\nexec sleep 60\n")
        for number, code in ((signal.SIGKILL, -9), (signal.SIGTERM, 9), (signal.SIGUSR1, 9)):
            worker = self.start(folder, "--chunk", "1/1", env=endless)
            wait_until(lambda: processes_in(folder / "scene"), what="the renderer")
            worker.send_signal(number)
            self.assertEqual(worker.wait(5), code)
            wait_until(lambda: not processes_in(folder), 5, "the renderer to end")
        self.assertEqual(self.made(folder), [])
        self.meniscus("work", folder)
        self.assert_equals_reference(folder)

    def test_workers_that_do_not_know_of_each_other(self):
        """Workers that share a run, one of them killed, or its frames make the same bytes, and few frames twice."""
        folder = self.povray_bundle("shared", 24)
        log = self.folder / "calls"
        counting = self.programs("counting", povray=f'#!/bin/sh\necho >> {log}\nexec {shutil.which("povray")} "$@"\n')
        workers = [self.start(folder, env=counting) for _ in range(4)]
        wait_until(lambda: len(self.made(folder)) > 3, what="some frames")
        workers[0].kill()
        self.assertEqual([worker.wait(240) for worker in workers], [-9, 0, 0, 0])
        self.assertEqual(self.made(folder), list(range(24)))
        calls = len(log.read_text().splitlines())
        self.assertLess(calls, 24 + 16, "frames are made twice all the time")
        alone, same = self.povray_bundle("alone", 24), self.povray_bundle("same", 24)
        self.meniscus("work", alone)
        workers = [self.start(same, "--frames", "0-23") for _ in range(2)]
        self.assertEqual([worker.wait(240) for worker in workers], [0, 0])
        for place in ("images", "scene"):
            self.assertEqual(sums(folder / place, "*"), sums(alone / place, "*"))
            self.assertEqual(sums(same / place, "*"), sums(alone / place, "*"))
        self.meniscus("farm", "verify", folder)
        self.assert_nothing_unfinished(folder)

    def test_shares_and_steps_make_the_whole(self):
        folder = self.povray_bundle("shares")
        self.meniscus("work", folder, "--step", "render", code=3)
        for k in (3, 1, 2):
            self.meniscus("work", folder, "--step", "surface", "--chunk", f"{k}/3")
        self.meniscus("work", folder, "--step", "render", "--frames", "7,0-4")
        self.assertEqual(self.made(folder), [0, 1, 2, 3, 4, 7])
        self.meniscus("work", folder, "--chunk", "2/2")
        self.assert_equals_reference(folder)
        for bad in (("--chunk", "0/3"), ("--chunk", "4/3"), ("--chunk", "1"), ("--frames", "8"), ("--step", "paint")):
            self.meniscus("work", folder, *bad, code=2)

    def test_a_failing_frame_has_its_own_code_and_stops_nobody(self):
        folder = self.povray_bundle("failing", bad_frame=3, options=("--chunk-frames", "4", "--film", "film.mp4"))
        for more in ((), ("--chunk", "1/1")):
            result = self.meniscus("work", folder, "--progress", "json", *more, code=3)
            self.assertRegex(result.stderr, r"1 of 8 frames failed; the first, frame 3: .*nan")
            self.assertEqual(self.made(folder), [0, 1, 2, 4, 5, 6, 7])
        told = self.meniscus("farm", "verify", folder, code=3).stderr
        self.assertIn("frame 3: is not made yet", told)
        self.assertIn("--allow-missing hold", told)
        self.assertFalse((folder / "film.mp4").exists())
        for in_place, frames, words in (("drop", 7, "the film is shorter"), ("hold", 8, "the frame before is shown")):
            said = self.meniscus("farm", "verify", folder, "--allow-missing", in_place).stdout
            self.assertIn("7 frames are good, 1 missing: 3; " + words, said)
            self.assertEqual(self.film_frames(folder), frames)

    def film_frames(self, folder):
        probe = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-select_streams", "v", "-show_entries",
                                "stream=nb_read_frames", "-of", "csv=p=0", folder / "film.mp4"],
                               capture_output=True, text=True, check=True)
        return int(probe.stdout)

    def test_progress(self):
        folder = self.povray_bundle("progress", frames=2)
        self.assertIn("openjd_progress: 100.0\n", self.meniscus("work", folder, "--step", "surface", "--progress", "openjd").stdout)
        events = [json.loads(line) for line in self.meniscus("work", folder, "--progress", "json").stderr.splitlines()]
        self.assertEqual([event["event"] for event in events], ["start", "frame", "frame", "end"])
        self.assertEqual(sorted(event["files"] for event in events[1:3]), [["images/frame_00000.png"], ["images/frame_00001.png"]])

    def test_verify_finds_damage_and_work_repairs_it(self):
        folder = self.povray_bundle("damaged", options=("--chunk-frames", "5", "--film", "film.mp4"))
        self.meniscus("work", folder)
        self.meniscus("farm", "verify", folder)
        film = sums(folder, "film.mp4")
        images = folder / "images"
        (images / "frame_00001.png").unlink()
        (images / "frame_00002.png").write_bytes((images / "frame_00000.png").read_bytes()[:100])
        changed = bytearray((images / "frame_00004.png").read_bytes())
        changed[len(changed) // 2] ^= 1
        (images / "frame_00004.png").write_bytes(changed)
        (folder / "scene" / "surface_geometry_00001.inc").write_bytes(b"")
        (folder / "film.mp4").unlink()
        told = self.meniscus("farm", "verify", folder, code=3).stderr
        for line in ("frame 1: is not made yet", "frame 2: is not made yet", "images/frame_00004.png: cannot be read", "3 of 8",
                     f"meniscus work '{folder}'", "--frames 4 --force"):
            self.assertIn(line, told)
        self.meniscus("work", folder)
        self.assertIn("1 of 8", self.meniscus("farm", "verify", folder, code=3).stderr)
        self.meniscus("work", folder, "--frames", "4", "--force")
        self.meniscus("farm", "verify", folder)
        self.assert_equals_reference(folder)
        self.assertEqual(sums(folder, "film.mp4"), film)
        self.assertEqual(self.film_frames(folder), 8)

    def test_pictures_that_are_blank_or_of_another_size_are_not_good(self):
        """The camera looks past the molecule, or the renderer uses another size."""
        molecule = sample_run(self.folder / "blank.pdb", 2)
        camera = json.loads((self.reference / "inputs" / "camera.json").read_text())
        camera["position"] = [value + 500.0 for value in camera["target"]]
        camera["target"] = [value + 1000.0 for value in camera["target"]]
        away = self.folder / "away.json"
        away.write_text(json.dumps(camera))
        blank = self.bundle("blank", "render", molecule, "--camera", away,
                            "--background", "white")
        self.meniscus("work", blank)
        self.assertIn("blank", self.meniscus("farm", "verify", blank, code=3).stderr)
        large = self.bundle("large", "export", "povray", molecule, *SMALL, "--", "+W80", "+H60")
        self.meniscus("work", large)
        self.assertIn("is 80x60 pixels, not 40x30", self.meniscus("farm", "verify", large, code=3).stderr)

    def test_inputs_that_changed_and_damaged_bundles_are_refused(self):
        folder = self.povray_bundle("changed")
        for path in (folder / "inputs").glob("*.pdb"):
            path.write_text(path.read_text().replace("MODEL        2", "MODEL        9"))
        self.assertIn("not what was bundled", self.meniscus("work", folder, code=3).stderr)
        manifest = folder / "bundle.json"
        text = manifest.read_text()
        for broken in (text[:200], text.replace('"program_version": "', '"program_version": "9'),
                       text.replace('"schema_version": 2', '"schema_version": 1'), text.replace('"povray"', '"ply"')):
            self.assertNotEqual(broken, text)
            manifest.write_text(broken)
            self.assertIn("bundle.json", self.meniscus("work", folder, code=3).stderr)
        self.assertIn("is missing", self.meniscus("work", self.folder / "nowhere", code=3).stderr)

    def test_inputs_by_reference(self):
        molecule = sample_run(self.folder / "large $input.pdb", 2)
        folder = self.bundle("named", "render", molecule, *SMALL, options=("--chunk-frames", "5", "--by-reference"))
        self.assertEqual(list(folder.rglob("*.pdb")), [])
        self.meniscus("work", folder)
        self.meniscus("farm", "verify", folder)
        os.remove(molecule)
        self.assertIn("large $input.pdb: is missing, or not what was bundled", self.meniscus("work", folder, code=3).stderr)

    def test_a_full_disk(self):
        """The file system has room for some frames; with more room the same command makes the others."""
        folder = self.povray_bundle("full")
        script = """mount -t tmpfs -o size=1m none "$1" || exit 77
cp -r "$2"/* "$1" && "$3" work "$1" --progress none; code=$?
mount -o remount,size=64m "$1" && "$3" work "$1" --progress none || exit 1
cp -r "$1"/images "$1"/scene "$2" && exit $code
"""
        room = self.folder / "room"
        room.mkdir()
        result = subprocess.run(["unshare", "-rm", "sh", "-c", script, "sh", room, folder, MENISCUS], capture_output=True, text=True,
                                timeout=120)
        if result.returncode == 77 or "unshare" in result.stderr:
            self.skipTest("file systems cannot be mounted here")
        self.assertIn(result.returncode, (3, 6), result.stderr)
        self.assertIn("No space left on device", result.stderr)
        self.assert_equals_reference(folder)

    def test_a_renderer_that_fails_or_is_missing_is_told(self):
        folder = self.povray_bundle("broken")
        self.meniscus("work", folder, "--step", "surface")
        (folder / "scene" / "surface_style.inc").write_text("#error \"no style\"\n")
        result = self.meniscus("work", folder, "--frames", "0-1", code=3)
        self.assertIn("povray ended with code", result.stderr)
        missing = self.meniscus("work", folder, "--frames", "0", code=3, env={"PATH": "/nonexistent"})
        self.assertIn("povray: cannot be started", missing.stderr)

    def test_a_killed_renderer_is_started_once_more(self):
        """A frame at which POV-Ray is always killed is missing; one at which it is killed once is made."""
        folder = self.povray_bundle("killed_renderer", 3)
        real, mark = shutil.which("povray"), self.folder / "mark"
        always = self.programs("always", povray=f'#!/bin/sh\ncase "$*" in *+SF0*) kill -9 $$;; esac\nexec {real} "$@"\n')
        self.assertIn("killed, as when memory runs out, twice", self.meniscus("work", folder, code=5, env=always).stderr)
        self.assertEqual(self.made(folder), [1, 2])
        once = self.programs("once", povray=f"""#!/bin/sh
case "$*" in *+SF0*) if [ ! -e {mark} ]; then touch {mark}; kill -SEGV $$; fi;; esac
exec {real} "$@"
""")
        self.meniscus("work", folder, env=once)
        self.assertTrue(mark.exists())
        self.meniscus("farm", "verify", folder)
        self.assert_nothing_unfinished(folder)

    def test_blender_renders_the_same_bytes_in_any_division(self):
        molecule = sample_run(self.folder / "blender.pdb", 2, atoms=60)
        whole, parts = (self.bundle(name, "export", "blender", molecule, "--frames", "all", "--size", "64x48", "--device",
                                    "cpu", "--", "--samples", "2", options=("--chunk-frames", "1", "--film", "film.mp4"))
                        for name in ("blender $HOME", "blender parts"))
        self.meniscus("work", whole, "--chunk", "1/1")
        self.meniscus("farm", "verify", whole)
        worker = self.start(parts)
        wait_until(lambda: self.made(parts), what="a picture")
        worker.kill()
        worker.wait()
        self.meniscus("work", parts)
        self.meniscus("farm", "verify", parts)
        for place, pattern in (("images", "*.png"), (".", "film.mp4"), ("scene", "*")):
            self.assertEqual(sums(parts / place, pattern), sums(whole / place, pattern))
        self.assertEqual(self.made(whole), [0, 1])
        self.assertEqual(list(parts.rglob("__pycache__")), [])
        self.assert_nothing_unfinished(parts)

    def test_scenes_for_path_tracers_are_made_and_nothing_else(self):
        """The bytes equal those of one command without a farm; a missing mesh is found and made again."""
        molecule = sample_run(self.folder / "scenes.pdb", 4)
        for renderer in ("mitsuba", "pbrt"):
            words = ("export", renderer, molecule, *SMALL, "--device", "cpu")
            folder = self.bundle(renderer, *words)
            worker = self.start(folder)
            wait_until(lambda: self.made(folder, SCENES), what="a scene")
            worker.kill()
            worker.wait()
            self.meniscus("work", folder)
            self.meniscus("farm", "verify", folder)
            alone = self.folder / f"alone_{renderer}"
            self.meniscus(*words, "-o", alone, "-q")
            self.assertEqual(sums(folder / "scene", "surface*"), sums(alone, "*"))
            (folder / "scene" / "surface_00003_1.ply").unlink()
            self.assertIn("frame 3", self.meniscus("farm", "verify", folder, code=3).stderr)
            self.meniscus("work", folder)
            self.assertEqual(sums(folder / "scene", "surface*"), sums(alone, "*"))
            to = ("farm", "bundle", self.folder / "refused", "--chunk-frames", "1")
            self.assertIn("--film", self.meniscus(*to, "--film", "film.mp4", "--", *words, code=2).stderr)
            self.assertIn("no renderer is started", self.meniscus(*to, "--", *words, "--", "-m", "x", code=2).stderr)

    def test_a_missing_gpu_is_exit_four_for_farms_that_need_one(self):
        folder = self.povray_bundle("gpu")
        self.assertIn("--require-gpu", self.meniscus("work", folder, "--require-gpu", "--device", "software", code=4).stderr)


if __name__ == "__main__":
    main()
