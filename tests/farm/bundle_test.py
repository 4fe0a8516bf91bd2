# SPDX-License-Identifier: BSD-3-Clause
"""Tests the files that farm bundle writes, and what it refuses."""

import json
import os
import subprocess

from farm_case import FarmCase, MENISCUS, UBIQUITIN, main, sample_run, sums


class Bundle(FarmCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.molecule = sample_run(cls.folder / "run.pdb", 6)

    def render(self, *more):
        return ("render", self.molecule, "--frames", "all", "--size", "40x30", *more)

    def files(self, folder):
        return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}

    def test_the_same_command_makes_the_same_bytes_anywhere(self):
        a, b = self.bundle("a", *self.render()), self.bundle("b", *self.render())
        self.assertEqual(self.files(a), self.files(b))
        before = self.files(a)
        again = self.meniscus("farm", "bundle", a, "--chunk-frames", "5", "--", *self.render())
        self.assertIn("was there already", again.stdout)
        self.assertEqual(self.files(a), before)
        for text in before.values():
            for word in (str(self.folder), os.uname().nodename):
                self.assertNotIn(word.encode(), text)

    def test_the_manifest_says_everything(self):
        """Options about the device and its threads are the workers' default, and no part of the command."""
        device = ["--device", "cpu", "--threads", "2", "--jobs", "3"]
        folder = self.bundle("manifest", *self.render("--stride", "2", *device))
        manifest = json.loads((folder / "bundle.json").read_text())
        self.assertEqual((manifest["schema"], manifest["schema_version"]), ("meniscus-farm-bundle", 2))
        self.assertEqual((manifest["frames"], manifest["frame_count"], manifest["size"]), ("0-4:2", 3, [40, 30]))
        self.assertEqual(manifest["command"][:2], ["render", "inputs/run.pdb"])
        self.assertEqual(manifest["command"][-2:], ["--camera", "inputs/camera.json"])
        self.assertEqual(manifest["device"], device)
        self.assertFalse({"--device", "--threads", "--jobs"} & set(manifest["command"]))
        listed = {entry["path"].split("/")[1]: entry["sha256"] for entry in manifest["inputs"]}
        self.assertEqual(listed, sums(folder / "inputs", "*"))
        self.meniscus("work", folder)
        self.meniscus("farm", "verify", folder)

    def test_what_aims_the_default_camera_is_in_its_file(self):
        cameras = []
        for number, words in enumerate([(), ("--view", "-x", "--turn", "y30", "--turn=x-10"), ("--zoom-to=index 0",)]):
            folder = self.bundle(f"aimed{number}", *self.render(*words))
            command = json.loads((folder / "bundle.json").read_text())["command"]
            self.assertEqual(command[-2:], ["--camera", "inputs/camera.json"])
            self.assertFalse([word for word in command if word.startswith(("--view", "--turn", "--zoom-to", "-x"))])
            cameras.append((folder / "inputs" / "camera.json").read_text())
        self.assertEqual(len(set(cameras)), 3)

    def test_another_bundle_is_kept_unless_forced(self):
        folder = self.bundle("kept", *self.render())
        self.meniscus("work", folder, "--frames", "0", "--progress", "none")
        refused = self.meniscus("farm", "bundle", folder, "--chunk-frames", "5", "--", *self.render("--probe", "1.2"),
                                code=6)
        self.assertIn("another bundle", refused.stderr)
        self.assertTrue((folder / "images" / "frame_00000.png").exists())
        self.meniscus("farm", "bundle", folder, "--force", "--chunk-frames", "5", "--", *self.render("--probe", "1.2"))
        self.assertFalse((folder / "images").exists())
        foreign = self.folder / "foreign"
        foreign.mkdir()
        (foreign / "thesis.tex").write_text("years")
        self.meniscus("farm", "bundle", foreign, "--force", "--chunk-frames", "5", "--", *self.render(), code=6)
        self.assertEqual((foreign / "thesis.tex").read_text(), "years")

    def test_inputs_are_not_replaced(self):
        folder = self.bundle("held", *self.render())
        before = self.files(folder)
        result = self.meniscus("farm", "bundle", folder, "--force", "--chunk-frames", "5", "--", "render",
                               folder / "inputs" / "run.pdb", "--frames", "0-1", code=6)
        self.assertIn("holds inputs/run.pdb, which this command reads", result.stderr)
        self.assertEqual(self.files(folder), before)
        camera = self.folder / "camera.png"
        camera.write_text("{}")
        result = self.meniscus("farm", "bundle", self.folder / "legend", "--force", "--", *self.render(
            "--color", "chain", "--camera", camera, "--legend-file", camera), code=6)
        self.assertIn("camera.png: is one of the files that this command reads", result.stderr)

    def test_a_full_disk_is_named(self):
        """The file system has no room for the input."""
        room = self.folder / "room"
        room.mkdir()
        script = 'mount -t tmpfs -o size=16k none "$1" || exit 77; shift; "$@"; code=$?; ls -A "$0"; exit $code'
        result = subprocess.run(["unshare", "-rm", "sh", "-c", script, room, room, MENISCUS, "farm", "bundle", room / "b",
                                 "--chunk-frames", "5", "--", *self.render()], capture_output=True, text=True, timeout=60)
        if result.returncode in (1, 77):
            self.skipTest("file systems cannot be mounted here")
        self.assertEqual((result.returncode, result.stdout), (6, ""), result.stderr)
        self.assertIn("No space left on device", result.stderr)

    def test_a_trial_frame_decides_the_chunks_and_leaves_no_trace(self):
        folder = self.bundle("trial", *self.render(), options=("--chunk-minutes", "0.01"))
        chunks = json.loads((folder / "bundle.json").read_text())["chunks"]
        per_task = max(1, int(0.6 / chunks["seconds_per_frame"]))
        self.assertEqual(chunks["count"], -(-6 // min(per_task, 6)))
        self.assertFalse((folder / "images").exists())
        before = self.files(folder)
        self.meniscus("farm", "bundle", folder, "--chunk-minutes", "0.01", "--", *self.render())
        self.assertEqual(self.files(folder), before)

    def test_a_note_says_that_tasks_are_larger_than_was_wanted(self):
        molecule = self.folder / "many.pdb"
        molecule.write_text("".join(f"MODEL {n + 1:8d}\nHETATM    1  C   LIG A   1       0.000   0.000   0.000\nENDMDL\n"
                                    for n in range(2500)))
        camera = self.bundle("with_camera", *self.render()) / "inputs" / "camera.json"
        words = ("--", "render", molecule, "--frames", "all", "--size", "8x6", "--camera", camera)
        for _ in range(2):
            notes = self.meniscus("farm", "bundle", self.folder / "many", "--chunk-frames", "1", *words).stderr
            self.assertIn("note: 2,500 tasks were wanted; queues accept 1,000, so a task has up to 3 frames", notes)
        self.assertEqual(json.loads((self.folder / "many" / "bundle.json").read_text())["chunks"]["count"], 1000)
        self.assertNotIn("wanted", self.meniscus("farm", "bundle", self.folder / "few", "--chunk-frames", "3", *words).stderr)

    def test_hostile_names_become_plain(self):
        hostile = self.folder / "a $(touch x) `b` \"c\" 'd'; é.pdb"
        os.link(self.molecule, hostile)
        folder = self.bundle("plain", "render", hostile, "--frames", "all", "--size", "40x30")
        names = [path.name for path in (folder / "inputs").iterdir() if path.suffix == ".pdb"]
        self.assertRegex(names[0], r"^[A-Za-z0-9._-]+\.pdb$")
        refused = self.meniscus("farm", "bundle", self.folder / "odd", "--farm-path", "/mnt/a $b", "--", *self.render(), code=2)
        self.assertIn("--farm-path '/mnt/a $b'", refused.stderr)

    def test_what_cannot_be_bundled_is_refused_before_any_work(self):
        cases = {
            ("surface", UBIQUITIN): "cannot be bundled",
            ("render",): "FILE",
            ("render", "-"): "standard input",
            ("render", UBIQUITIN, "-o", "x.png"): "leave it out",
            ("render", UBIQUITIN, "--only=3"): "leave it out",
            ("render", UBIQUITIN, "--nonsense"): "nonsense",
            ("render", UBIQUITIN, "--probe", "-1"): "negative",
            ("render", UBIQUITIN, "--frames", "0-9"): "asks for frame 9",
            ("export", "ply", UBIQUITIN): "cannot be bundled",
            self.render("--title", b"\xff".decode(errors="surrogateescape")): "is not UTF-8",
        }
        for command, reason in cases.items():
            result = self.meniscus("farm", "bundle", self.folder / "no", "--chunk-frames", "1", "--", *command, code=2)
            self.assertIn(reason, result.stderr)
            self.assertFalse((self.folder / "no").exists())
        for engine in ("opencue", "abacus"):
            self.meniscus("farm", "bundle", self.folder / "no", "--engine", engine, "--", *self.render(), code=2)
        self.meniscus("farm", "bundle", self.folder / "no", "--", "render", self.folder / "missing.pdb", code=3)
        self.assertEqual([path for path in self.folder.iterdir() if path.name.endswith(".part")], [])


if __name__ == "__main__":
    main()
