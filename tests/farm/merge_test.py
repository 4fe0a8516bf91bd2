# SPDX-License-Identifier: BSD-3-Clause
"""Copies of a bundle in folders that share nothing: what was made in each is brought together by meniscus farm merge."""

import hashlib
import json
import os
import shutil
import signal
import subprocess
import time

from farm_case import MENISCUS, WorkCase, main, sums, wait_until

FRAMES = 8
OPTIONS = ("--chunk-frames", "5", "--film", "film.mp4")


class Merge(WorkCase):
    def copies(self, name, count):
        """A new bundle, and copies of it elsewhere."""
        folder = self.povray_bundle(name, options=OPTIONS)
        found = [self.folder / f"{name}_{number}" for number in range(count)]
        for copy in found:
            shutil.copytree(folder, copy)
        return folder, found

    def finished_copy(self, name):
        """The run made in one go, elsewhere."""
        copy = self.folder / name
        shutil.copytree(self.reference, copy)
        return copy

    def kill_after(self, folder, step, count, *more):
        """Starts a worker and ends it by SIGKILL when so many more frames of the step are made; its process is gone."""
        before = len(self.records(folder, step))
        worker = self.start(folder, *more)
        wait_until(lambda: len(self.records(folder, step)) >= before + count, what=f"{count} frames of {step}")
        worker.kill()
        worker.wait()
        self.assertEqual(worker.returncode, -signal.SIGKILL)

    def renew(self, folder, step, frame, path, content):
        """Another file with a record that fits it, as if the frame had been made so."""
        (folder / path).write_bytes(content)
        record_path = folder / "state" / step / f"frame_{frame:05}.json"
        record = json.loads(record_path.read_text())
        for file in record["files"]:
            if file["path"] == path:
                file.update(bytes=len(content), sha256=hashlib.sha256(content).hexdigest())
        record_path.write_text(json.dumps(record))

    def assert_only_whole_files(self, folder):
        """Whatever has its final name is as the run alone made it, and each record tells the truth."""
        for place, pattern in (("images", "*.png"), ("scene", "*")):
            expected = sums(self.reference / place, pattern)
            for name, found in sums(folder / place, pattern).items():
                self.assertEqual(found, expected[name], name)
        for step in ("surface", "render"):
            for record in self.records(folder, step).values():
                for file in record["files"]:
                    self.assertEqual(hashlib.sha256((folder / file["path"]).read_bytes()).hexdigest(), file["sha256"])

    def test_three_folders_that_share_nothing(self):
        """Workers killed in each; what is there is brought home on the way and at the end: the film of a run alone."""
        folder, copies = self.copies("home", 3)
        taken = 0
        for number, copy in enumerate(copies):
            chunk = ("--chunk", f"{number + 1}/3")
            self.kill_after(copy, "surface", 1, *chunk)
            self.kill_after(copy, "render", 1, *chunk)
        said = self.meniscus("farm", "merge", folder, *copies).stdout
        self.assert_only_whole_files(folder)
        for copy in copies:
            (line,) = [line for line in said.splitlines() if line.startswith(f"{copy}: ")]
            taken += int(line.split(": ")[1].split()[0])
        # A frame's geometry and its picture count each, what frames have in common does not.
        self.assertEqual(taken, len(self.records(folder, "surface")) + len(self.records(folder, "render")))
        self.assertGreaterEqual(taken, 6)
        self.assertIn("frames are not good", self.meniscus("farm", "verify", folder, code=3).stderr)
        for number, copy in enumerate(copies):
            self.meniscus("work", copy, "--chunk", f"{number + 1}/3")
            self.meniscus("farm", "verify", copy, code=3)
        said = self.meniscus("farm", "merge", folder, *copies).stdout
        self.assertIn(f"surface: {FRAMES} of {FRAMES} frames are made\nrender: {FRAMES} of {FRAMES} frames", said)
        self.meniscus("farm", "verify", folder)
        self.assert_equals_reference(folder)
        self.assert_nothing_unfinished(folder)
        self.meniscus("farm", "verify", self.reference)
        self.assertEqual(sums(folder, "film.mp4"), sums(self.reference, "film.mp4"))
        # Once more: nothing is written.
        before = {path: path.stat().st_mtime_ns for path in folder.rglob("*") if path.is_file()}
        for line in self.meniscus("farm", "merge", folder, *copies).stdout.splitlines()[:3]:
            self.assertIn(": 0 taken, 0 bytes; ", line)
        self.assertEqual({path: path.stat().st_mtime_ns for path in folder.rglob("*") if path.is_file()}, before)
        # Who made a frame, and what was said of it, came along.
        self.assertIn("Persistence of Vision", self.meniscus("farm", "log", folder, "0").stdout)

    def test_what_is_brought_home_is_gone_on_with(self):
        """Geometry from elsewhere, pictures made here."""
        folder, (copy,) = self.copies("onward", 1)
        self.meniscus("work", copy, "--step", "surface")
        self.meniscus("farm", "merge", folder, copy)
        self.meniscus("work", folder, "--step", "render")
        self.assert_equals_reference(folder)

    def test_a_merge_may_be_killed_at_any_moment(self):
        folder, _ = self.copies("killed", 0)
        copy = self.finished_copy("killed_from")
        kills = 0
        for goal in range(1, 2 * FRAMES, 3):
            merge = subprocess.Popen([MENISCUS, "farm", "merge", folder, copy], stdout=subprocess.DEVNULL)
            while merge.poll() is None:
                if len(list((folder / "state").glob("*/frame_*.json"))) >= goal:
                    merge.kill()
                time.sleep(0.0005)
            kills += merge.returncode == -signal.SIGKILL
            self.assert_only_whole_files(folder)
        self.assertGreaterEqual(kills, 1)
        # A claim that a merge was killed in the middle of writing names nobody, and counts for a minute.
        end = time.monotonic() + 90
        while "being made here" in self.meniscus("farm", "merge", folder, copy).stdout and time.monotonic() < end:
            time.sleep(3)
        self.meniscus("farm", "verify", folder)
        self.assert_equals_reference(folder)
        self.assert_nothing_unfinished(folder)

    def test_workers_may_run_where_it_takes_frames_to(self):
        folder, _ = self.copies("busy", 0)
        copy = self.finished_copy("busy_from")
        worker = self.start(folder)
        wait_until(lambda: self.records(folder, "surface"), what="a frame")
        self.meniscus("farm", "merge", folder, copy)
        self.assertEqual(worker.wait(240), 0)
        self.meniscus("farm", "merge", folder, copy)
        self.meniscus("farm", "verify", folder)
        self.assert_equals_reference(folder)
        self.assertEqual(list((folder / "state").rglob("*claim*")), [])

    def test_what_is_broken_or_differs_is_named_and_not_taken(self):
        folder, _ = self.copies("strict", 0)
        self.meniscus("work", folder, "--frames", "0")
        copy = self.finished_copy("strict_from")
        images, records = copy / "images", copy / "state" / "render"
        self.renew(copy, "render", 0, "images/frame_00000.png", (images / "frame_00007.png").read_bytes())
        (images / "frame_00001.png").write_bytes((images / "frame_00001.png").read_bytes()[:-5])
        changed = bytearray((images / "frame_00002.png").read_bytes())
        changed[len(changed) // 2] ^= 1
        (images / "frame_00002.png").write_bytes(changed)
        (records / "frame_00003.json").write_text("{")
        shutil.copy(records / "frame_00005.json", records / "frame_00004.json")
        self.renew(copy, "render", 5, "images/frame_00005.png", bytes(changed))
        (images / "frame_00006.png").rename(copy / "elsewhere.png")
        (images / "frame_00006.png").symlink_to(copy / "elsewhere.png")
        (copy / "scene" / "surface_geometry_00007.inc").write_bytes(b"")
        own = sums(folder / "images", "*")
        told = self.meniscus("farm", "merge", folder, copy, code=3).stderr
        for frame, what in ((0, "images/frame_00000.png: is good here and differs"), (1, "bytes, not"), (2, "SHA-256"),
                            (3, "its record is damaged"), (4, "its record is damaged"), (5, "cannot be read as a picture"),
                            (6, "symbolic link")):
            self.assertRegex(told, rf"(?m)^meniscus: {copy}: render frame {frame} is not taken: .*{what}")
        self.assertRegex(told, rf"(?m)^meniscus: {copy}: surface frame 7 is not taken: scene/surface_geometry_00007.inc: ")
        self.assertIn("8 frames and 0 copies are not taken", told)
        self.assertEqual(sums(folder / "images", "*"), {**own, "frame_00007.png": sums(images, "frame_00007.png")["frame_00007.png"]})
        self.assertEqual(sorted(self.records(folder, "render")), [0, 7])
        self.assertEqual(sorted(self.records(folder, "surface")), list(range(7)))
        self.meniscus("work", folder)
        self.assert_equals_reference(folder)

    def test_what_frames_have_in_common_comes_along_and_what_differs_does_not(self):
        folder, (empty,) = self.copies("shared", 1)
        self.meniscus("work", folder, "--frames", "0-1")
        copy = self.finished_copy("shared_from")
        record = copy / "state" / "surface" / "shared.json"
        names = {file["path"] for file in json.loads(record.read_text())["files"]}
        self.assertEqual(names, {f"scene/{path.name}" for path in (copy / "scene").iterdir() if "_0000" not in path.name})
        style = copy / "scene" / "surface_style.inc"
        content = style.read_bytes()
        style.write_bytes(content + b" ")
        said = self.meniscus("farm", "merge", empty, copy, code=3).stderr
        self.assertIn("surface files of all frames are not taken: scene/surface_style.inc: has ", said)
        self.assertFalse((empty / "scene" / "surface.ini").exists())
        style.write_bytes(content[:-1] + b" ")
        sums_of = json.loads(record.read_text())
        for file in sums_of["files"]:
            if file["path"] == "scene/surface_style.inc":
                file["sha256"] = hashlib.sha256(style.read_bytes()).hexdigest()
        record.write_text(json.dumps(sums_of))
        said = self.meniscus("farm", "merge", folder, copy, code=3).stderr
        self.assertIn("surface files of all frames are not taken: scene/surface_style.inc: is good here and differs", said)
        self.assert_equals_reference(folder)

    def test_a_frame_replaces_no_file_of_another(self):
        """Whatever its record says."""
        folder, _ = self.copies("greedy", 0)
        self.meniscus("work", folder, "--frames", "0")
        copy = self.finished_copy("greedy_from")
        path = copy / "state" / "render" / "frame_00003.json"
        record = json.loads(path.read_text())
        record["files"][0]["path"] = "images/frame_00000.png"
        path.write_text(json.dumps(record))
        (copy / "images" / "frame_00003.png").rename(copy / "images" / "frame_00000.png")
        told = self.meniscus("farm", "merge", folder, copy, code=3).stderr
        self.assertIn("render frame 3 is not taken: images/frame_00000.png: is good here and differs", told)
        self.assertEqual(sums(folder / "images", "frame_00000.png"), sums(self.reference / "images", "frame_00000.png"))

    def test_other_bundles_are_no_copies(self):
        folder, (copy, versioned) = self.copies("other", 2)
        self.meniscus("work", copy, "--frames", "2")
        molecule = next((folder / "inputs").glob("*.pdb"))
        another = self.bundle("another", "export", "povray", molecule, "--frames", "all", "--size", "80x60", "--device", "cpu")
        manifest = json.loads((versioned / "bundle.json").read_text())
        (versioned / "bundle.json").write_text(json.dumps({**manifest, "program_version": "9.9.9+gabc"}))
        told = self.meniscus("farm", "merge", folder, another, self.folder / "nowhere", versioned, copy, code=3).stderr
        self.assertIn(f"nothing is taken from {another}: {another}/bundle.json: is another bundle", told)
        self.assertIn(f"nothing is taken from {self.folder / 'nowhere'}: ", told)
        self.assertIn("was made by meniscus '9.9.9+gabc'", told)
        self.assertIn("0 frames and 3 copies are not taken", told)
        self.assertEqual(sorted(self.records(folder, "render")), [2])
        self.assertIn("leave it out", self.meniscus("farm", "merge", folder, os.path.relpath(folder), code=2).stderr)

    def of_version(self, folder, version):
        """The bundle and its records as if a program of that version had made them."""
        manifest = json.loads((folder / "bundle.json").read_text())
        manifest["program_version"] = version
        (folder / "bundle.json").write_text(json.dumps(manifest))
        keys = ("schema", "schema_version", "program_version", "command", "frames", "frame_count", "size", "steps", "inputs")
        text = json.dumps({key: manifest[key] for key in keys}, separators=(",", ":"))
        for path in (folder / "state").glob("*/*.json"):
            record = {**json.loads(path.read_text()), "bundle": hashlib.sha256(text.encode()).hexdigest()}
            path.write_text(json.dumps(record))

    def test_what_a_program_of_another_version_may_do(self):
        """It makes no frame of the film, but counts, merges and shows those of the program that made the bundle."""
        folder, _ = self.copies("older", 0)
        copy, of_now = self.finished_copy("older_from"), self.finished_copy("newer_from")
        for place in (folder, copy):
            self.of_version(place, "0.0.1+gabcdef012345")
        self.assertIn("was made by meniscus", self.meniscus("farm", "merge", folder, of_now, code=3).stderr)
        self.assertEqual(self.records(folder, "render"), {})
        self.meniscus("farm", "merge", folder, copy)
        self.assertEqual(json.loads(self.meniscus("farm", "status", folder, "--json").stdout)["steps"][1]["done"], FRAMES)
        self.assertIn("made by", self.meniscus("farm", "log", folder, "3").stdout)
        self.meniscus("farm", "verify", folder)
        self.assert_equals_reference(folder)
        (folder / "images" / "frame_00003.png").unlink()
        self.assertIn("use one build on all machines", self.meniscus("work", folder, code=3).stderr)

    def test_frames_that_failed_elsewhere_are_known_here(self):
        folder, (first, second) = self.copies("failing", 2)
        for copy in (first, second):
            self.meniscus("work", copy, "--frames", "1-2")
        path = first / "state" / "render" / "frame_00002.json"
        record = json.loads(path.read_text())
        path.write_text(json.dumps({**record, "state": "failed", "exit": 5, "error": "no memory", "files": []}))
        self.assertIn(", 1 failed there", self.meniscus("farm", "merge", folder, first).stdout)
        self.assertIn("frame 2, exit code 5: no memory", self.meniscus("farm", "status", folder).stdout)
        self.meniscus("farm", "merge", folder, second)
        self.assertEqual(self.records(folder, "render")[2]["state"], "done")
        self.assertNotIn("failed there", self.meniscus("farm", "merge", folder, first).stdout)
        self.assertEqual(self.records(folder, "render")[2]["state"], "done")


if __name__ == "__main__":
    main()
