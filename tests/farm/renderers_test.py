# SPDX-License-Identifier: BSD-3-Clause
"""The programs that make frames: how they end, fail and are tried again, and Blender."""

import os
import shutil
import signal
import subprocess

from farm_case import MENISCUS, WorkCase, main, processes_in, sample_run, sums, wait_until


class Renderers(WorkCase):
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
            wait_until(lambda: processes_in(folder / "images" / ".povray_"), what="the renderer")
            worker.send_signal(number)
            self.assertEqual(worker.wait(20), code)
            wait_until(lambda: not processes_in(folder), 10, "the renderer to end")
        self.assertEqual(self.records(folder, "render"), {})

    def test_a_process_that_is_killed_in_a_frame_is_started_once_more(self):
        """As one that needs more memory than there is: once, and nothing is lost; twice in one frame, and that has failed."""
        molecule = sample_run(self.folder / "fatal.pdb", 5)
        folder = self.bundle("fatal", "render", molecule, "--frames", "all", "--size", "640x480", "--samples", "16")

        def kill_child(worker, but=None):
            child = wait_until(lambda: next((number for number in processes_in(folder) if number not in (worker.pid, but)),
                                            None), 120, "a child")
            os.kill(child, signal.SIGKILL)
            return child

        worker = self.start(folder)
        wait_until(lambda: self.records(folder, "render"), 120, "a frame")
        kill_child(worker)
        self.assertEqual(worker.wait(120), 0)
        records = self.records(folder, "render")
        self.assertEqual([record["state"] for record in records.values()], ["done"] * 5)
        again = [frame for frame, record in records.items() if "first_try" in record]
        self.assertEqual(len(again), 1)
        self.assertIn("was killed", records[again[0]]["first_try"])
        self.meniscus("farm", "verify", folder)

        shutil.rmtree(folder / "state")
        worker = self.start(folder)
        kill_child(worker, but=kill_child(worker))  # both before the first frame
        self.assertEqual(worker.wait(120), 5)
        records = self.records(folder, "render")
        self.assertEqual([records[frame]["state"] for frame in range(5)], ["failed"] + ["done"] * 4)
        self.assertIn("was killed, as when memory runs out, twice", records[0]["error"])
        self.meniscus("work", folder)
        self.meniscus("farm", "verify", folder)

    def test_a_renderer_that_fails_is_told(self):
        folder = self.povray_bundle("broken")
        self.meniscus("work", folder, "--step", "surface")
        self.assertIn("run that step first", self.meniscus(
            "work", self.povray_bundle("unbegun"), "--step", "render", code=3).stderr)
        style = folder / "scene" / "surface_style.inc"
        style.write_text("#error \"no style\"\n")
        result = self.meniscus("work", folder, "--step", "render", "--frames", "0-1", code=3)
        self.assertIn("povray ended with code", result.stderr)
        missing = self.meniscus("work", folder, "--step", "render", "--frames", "0", code=3,
                                env={"PATH": "/nonexistent"})
        self.assertIn("povray: cannot be started", missing.stderr)

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
        self.assertIn("run that step first", self.meniscus("work", parts, "--step", "render", code=3).stderr)
        self.meniscus("work", parts)
        self.meniscus("farm", "verify", parts)
        for place, pattern in (("images", "*.png"), (".", "film.mp4"), ("scene", "*")):
            self.assertEqual(sums(parts / place, pattern), sums(whole / place, pattern))
        self.assertEqual(len(sums(whole / "images", "*.png")), 2)

    def programs(self, name, **scripts):
        """An environment in which these programs are found first."""
        folder = self.folder / name
        folder.mkdir()
        for program, text in scripts.items():
            (folder / program).write_text(text)
            (folder / program).chmod(0o755)
        return dict(os.environ, PATH=f"{folder}:{os.environ['PATH']}")

    def test_a_killed_renderer_is_started_once_more(self):
        """POV-Ray that is killed at its first frame: tried again and recorded; that is always killed there: one frame less."""
        folder = self.povray_bundle("killed_renderer", 3)
        self.meniscus("work", folder, "--step", "surface")
        real = shutil.which("povray")
        always = self.programs("always", povray=f"""#!/bin/sh
case "$*" in *+SF0*) kill -9 $$;; esac
exec {real} "$@"
""")
        said = self.meniscus("work", folder, code=5, env=always)
        self.assertIn("killed, as when memory runs out, twice", said.stderr)
        records = self.records(folder, "render")
        self.assertEqual([records[frame]["state"] for frame in range(3)], ["failed", "done", "done"])
        self.assertIn("was killed", records[0]["first_try"])
        mark = self.folder / "mark"
        once = self.programs("once", povray=f"""#!/bin/sh
case "$*" in *+SF0*) if [ ! -e {mark} ]; then touch {mark}; kill -SEGV $$; fi;; esac
exec {real} "$@"
""")
        self.meniscus("work", folder, env=once)
        records = self.records(folder, "render")
        self.assertEqual({record["state"] for record in records.values()}, {"done"})
        self.assertIn("signal 11", records[0]["first_try"])
        self.assertNotIn("first_try", records[1])
        self.assertTrue(mark.exists())
        self.meniscus("farm", "verify", folder)
        self.assert_nothing_unfinished(folder)


if __name__ == "__main__":
    main()
