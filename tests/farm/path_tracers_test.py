# SPDX-License-Identifier: BSD-3-Clause
"""Bundles of export mitsuba and export pbrt: workers make the scenes, no renderer is started."""

import json
import shutil

from farm_case import FarmCase, main, processes_in, sample_run, sums, wait_until

FRAMES = 8


class PathTracers(FarmCase):
    def scenes(self, name, renderer, bad_frame=None, *more, options=("--chunk-frames", "5")):
        molecule = self.folder / f"{bad_frame}.pdb"
        if not molecule.exists():
            sample_run(molecule, FRAMES, bad_frame)
        return self.bundle(name, "export", renderer, molecule, "--frames", "all", "--size", "320x240", "--device", "cpu",
                           "--jobs", "1", *more, options=options)

    def test_kill_and_resume(self):
        """The same bytes as by one command without a farm; what was there is not made twice."""
        for renderer, ending in (("mitsuba", "xml"), ("pbrt", "pbrt")):
            folder = self.scenes(f"killed_{renderer}", renderer, None, "--tolerance", "0.003")
            worker = self.start(folder)
            wait_until(lambda: len(self.records(folder, "surface")) >= 2, what="2 frames")
            worker.kill()
            worker.wait()
            wait_until(lambda: not processes_in(folder), 5, "the children to end")
            made = {frame: (folder / "scene" / f"surface_{frame:05}.{ending}").stat().st_mtime_ns
                    for frame in self.records(folder, "surface")}
            self.assertLess(len(made), FRAMES)
            self.meniscus("work", folder)
            for frame, when in made.items():
                self.assertEqual((folder / "scene" / f"surface_{frame:05}.{ending}").stat().st_mtime_ns, when, "made twice")
            self.meniscus("farm", "verify", folder)
            self.assert_nothing_unfinished(folder)
            alone = self.folder / f"alone_{renderer}"
            self.meniscus("export", renderer, self.folder / "None.pdb", "--frames", "all", "--size", "320x240", "--device",
                          "cpu", "--tolerance", "0.003", "-o", alone, "-q")
            self.assertEqual(len(sums(alone, f"*.{ending}")), FRAMES)
            self.assertEqual(sums(folder / "scene", "*"), sums(alone, "*"))
            # A mesh that is gone is made again.
            (folder / "scene" / "surface_00003_1.ply").unlink()
            self.assertIn("frame 3", self.meniscus("farm", "verify", folder, code=3).stderr)
            self.meniscus("work", folder)
            self.assertEqual(sums(folder / "scene", "*"), sums(alone, "*"))

    def test_a_failing_frame_has_its_own_code(self):
        for renderer in ("mitsuba", "pbrt"):
            folder = self.scenes(f"failing_{renderer}", renderer, 3)
            self.assertIn("1 of 8 frames failed; the first, frame 3", self.meniscus("work", folder, code=3).stderr)
            self.assertEqual(len([r for r in self.records(folder, "surface").values() if r["state"] == "done"]), 7)
            self.assertIn("frame 3: failed", self.meniscus("farm", "verify", folder, code=3).stderr)

    def test_tasks_have_one_step(self):
        folder = self.scenes("engines", "pbrt", None, options=("--chunk-frames", "3", "--engine", "make,slurm,openjd,flamenco"))
        steps = json.loads((folder / "template.json").read_text())["steps"]
        self.assertEqual([step["name"] for step in steps], ["surface", "verify"])
        self.assertIn("--step surface", (folder / "Makefile").read_text())

    def test_what_there_is_no_renderer_for(self):
        run = ("export", "mitsuba", sample_run(self.folder / "refused.pdb", 2), "--frames", "all", "--size", "40x30")
        to = ("farm", "bundle", self.folder / "refused", "--chunk-frames", "1")
        self.assertIn("--film", self.meniscus(*to, "--film", "film.mp4", "--", *run, code=2).stderr)
        self.assertIn("no renderer is started", self.meniscus(*to, "--", *run, "--", "-m", "scalar_rgb", code=2).stderr)
        self.assertFalse((self.folder / "refused").exists())

    def test_other_steps_and_films_in_the_manifest_are_refused(self):
        good = self.scenes("good", "mitsuba")
        step = {"name": "render", "maker": "povray", "arguments": []}
        film = {"file": "film.mp4", "frames_per_second": 25.0}
        for change, word in (({"steps": [step]}, "its steps are not those of its command"), ({"film": film}, "has a film, and no pictures"),
                             ({"command": ["export", "mitsuba"]}, "has no command")):
            folder = self.folder / "changed"
            shutil.rmtree(folder, ignore_errors=True)
            shutil.copytree(good, folder)
            manifest = json.loads((folder / "bundle.json").read_text())
            (folder / "bundle.json").write_text(json.dumps({**manifest, **change}))
            self.assertIn(word, self.meniscus("work", folder, code=3).stderr)
            self.assertFalse((folder / "scene").exists())


if __name__ == "__main__":
    main()
