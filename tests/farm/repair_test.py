# SPDX-License-Identifier: BSD-3-Clause
"""What verify and status find, and what work makes again or refuses."""

import json
import re
import shutil
import subprocess

from farm_case import WorkCase, main, sample_run, sums


class Repair(WorkCase):
    def test_verify_finds_every_damage_and_work_repairs_it(self):
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
        (folder / "state" / "render" / "frame_00006.json").write_text("{")
        (folder / "film.mp4").unlink()
        told = self.meniscus("farm", "verify", folder, code=3).stderr
        for line in ("frame 1: images/frame_00001.png: is missing", "frame 2: images/frame_00002.png: has 100 bytes",
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

    def test_a_film_without_a_frame_that_cannot_be_made(self):
        folder = self.povray_bundle("without", 8, bad_frame=5, options=("--chunk-frames", "4", "--film", "film.mp4"))
        self.meniscus("work", folder, code=3)
        told = self.meniscus("farm", "verify", folder, code=3).stderr
        self.assertIn("says why frame 5 failed", told)
        self.assertIn("--allow-missing", told)
        self.assertFalse((folder / "film.mp4").exists())
        for in_place, frames, words in (("drop", 7, "the film is shorter"), ("hold", 8, "the frame before is shown")):
            said = self.meniscus("farm", "verify", folder, "--allow-missing", in_place).stdout
            self.assertIn("7 frames are good, 1 missing: 5; film, in which " + words, said)
            self.assertEqual(self.film_frames(folder), frames)
            told = self.meniscus("farm", "status", folder).stdout
            self.assertIn("film.mp4 was made without 1 frame, 5: " + words, told)
            status = json.loads(self.meniscus("farm", "status", folder, "--json").stdout)
            self.assertEqual(status["film_without"], {"in_place": in_place, "frames": [5]})
            self.assertIn("film.mp4 was made without frame 5", self.meniscus("farm", "log", folder, "5").stdout)
            self.assertNotIn("film.mp4", self.meniscus("farm", "log", folder, "4").stdout)
        # Frames that are merely missing are made by work; a picture that is held is the one before, or the first good.
        (folder / "images" / "frame_00000.png").unlink()
        self.assertIn("makes those that did not fail", self.meniscus("farm", "verify", folder, code=3).stderr)
        self.meniscus("farm", "verify", folder, "--allow-missing", "hold")
        self.assertEqual(self.film_frames(folder), 8)
        self.assertEqual(json.loads((folder / "state" / "film.json").read_text())["missing"], [0, 5])

    def film_frames(self, folder):
        probe = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-select_streams", "v", "-show_entries",
                                "stream=nb_read_frames", "-of", "csv=p=0", folder / "film.mp4"],
                               capture_output=True, text=True, check=True)
        return int(probe.stdout)

    def test_status_sees_pictures_that_are_gone_or_cut(self):
        folder = self.povray_bundle("gone", options=("--chunk-frames", "5"))
        self.meniscus("work", folder)
        images, scene = folder / "images", folder / "scene"
        (images / "frame_00001.png").unlink()
        (images / "frame_00002.png").write_bytes(b"")
        (images / "frame_00004.png").write_bytes((images / "frame_00004.png").read_bytes()[:-1])
        (scene / "surface_geometry_00005.inc").unlink()
        surface, render = json.loads(self.meniscus("farm", "status", folder, "--json").stdout)["steps"]
        self.assertEqual((surface["done"], surface["missing"], [frame["frame"] for frame in surface["damaged"]]),
                         (7, 0, [5]))
        self.assertEqual((render["done"], render["missing"], [frame["frame"] for frame in render["damaged"]]),
                         (5, 0, [1, 2, 4]))
        self.assertGreater(render["seconds_left"], 2.9 * render["seconds_per_frame"])
        told = self.meniscus("farm", "status", folder).stdout
        self.assertIn("render frame 1: images/frame_00001.png: is missing", told)
        self.assertIn("render frame 2: images/frame_00002.png: has 0 bytes, not ", told)
        shutil.rmtree(images)
        render = json.loads(self.meniscus("farm", "status", folder, "--json").stdout)["steps"][1]
        self.assertEqual((render["done"], len(render["damaged"])), (0, 8))
        self.meniscus("work", folder)
        self.assertEqual(json.loads(self.meniscus("farm", "status", folder, "--json").stdout)["steps"][1]["done"], 8)
        self.assert_equals_reference(folder)

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
        for broken in (text[:200], text.replace('"program_version": "', '"program_version": "9'),
                       re.sub(r'("program_version": "[^"]*)[0-9a-f]"', r'\1x"', text),
                       text.replace('"schema_version": 1', '"schema_version": 2'),
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


if __name__ == "__main__":
    main()
