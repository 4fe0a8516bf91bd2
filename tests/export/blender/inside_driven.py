# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of sequences by the driver: baked, streamed and driven frames are the same, and an error is an exit code."""

import json
import os
import shutil
import subprocess
import sys
import unittest

import addon_utils
import bpy
import numpy as np

FOLDER, ADDON, HERE, BLENDER = sys.argv[sys.argv.index("--") + 1:][:4]
sys.path.insert(0, HERE)
import samples  # noqa: E402

from meniscus_import import sequence_reader  # noqa: E402

RUN = os.path.join(FOLDER, "run")
MANIFEST = os.path.join(RUN, "surface_sequence.json")
NUMBERS = [1, 3, 5]  # Frames of the trajectory in scene frames 1, 2, 3.
#: Pictures of one scene differ where threads add up in another order, and where a ray just meets an edge.
ROUNDING = 1.01 / 255
FEW = 0.001


def drive(*arguments):
    """Returns the exit code, JSON lines and standard error of the driver in a Blender of its own."""
    command = [BLENDER, "-b", "--factory-startup", "--python-exit-code", "3", "--python",
               os.path.join(ADDON, "render_mns.py"), "--", *arguments]
    environment = {key: value for key, value in os.environ.items() if key != "BLENDER_USER_SCRIPTS"}
    done = subprocess.run(command, capture_output=True, text=True, env=environment, check=False)
    lines = [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]
    return done.returncode, lines, done.stderr


def pixels(path):
    image = bpy.data.images.load(path)
    try:
        values = np.empty(len(image.pixels), dtype=np.float32)
        image.pixels.foreach_get(values)
        return values.reshape(image.size[1], image.size[0], 4)[:, :, :3]
    finally:
        bpy.data.images.remove(image)


def other(a, b):
    """Returns the share of pixels that differ by more than rounding."""
    return float((np.abs(a - b).max(axis=2) > ROUNDING).mean())


class Driven(unittest.TestCase):
    driven_once = None

    def setUp(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        addon_utils.enable("meniscus_import")
        self.folder = os.path.join(FOLDER, self.id())
        os.makedirs(self.folder)

    def pictures(self, name, *options, manifest=MANIFEST):
        code, lines, error = drive(manifest, "--output", os.path.join(self.folder, name + "_##"), "--samples", "4", *options)
        self.assertEqual(code, 0, error)
        self.assertTrue(all(line["state"] == "done" and line["triangles"] > 1000 for line in lines), lines)
        return {line["frame"]: pixels(line["files"][0]) for line in lines}

    def driven(self):
        """The pictures of the driver, made once for all tests."""
        if Driven.driven_once is None:
            Driven.driven_once = self.pictures("driver")
        return Driven.driven_once

    def test_driver_bake_and_stream_are_the_same_pictures(self):
        driven = self.driven()
        self.assertEqual(list(driven), NUMBERS)
        self.assertGreater(other(driven[1], driven[3]), 0.05)
        for mode in ("bake", "stream"):
            made = self.pictures(mode, "--mode", mode)
            for number in NUMBERS:
                self.assertLess(other(made[number], driven[number]), FEW, (mode, number))
        # Frames are chosen by number or by place in the run; buffers between pictures leave the pictures unchanged.
        self.assertEqual(list(self.pictures("place", "--scene-frames", "2")), [3])
        beside = self.pictures("beside", "--frames", "5,1-4:4", "--passes", os.path.join(self.folder, "passes_#.exr"))
        self.assertEqual(list(beside), [5, 1])
        for number in beside:
            self.assertLess(other(beside[number], driven[number]), FEW, number)
            self.assertGreater(os.path.getsize(os.path.join(self.folder, f"passes_{number}.exr")), 1000)

    def test_a_camera_of_the_command_stays_for_all_frames(self):
        """A run whose camera moves gives the pictures of the run that has the command's camera."""
        turning = os.path.join(FOLDER, "turning", "surface_sequence.json")
        camera = os.path.join(self.folder, "camera.json")
        with open(camera, "w", encoding="utf-8") as file:
            still = sequence_reader.read(MANIFEST).frames[0].camera
            json.dump({key: value for key, value in still.items() if key != "size"}, file)
        driven = self.driven()
        self.assertGreater(other(self.pictures("turned", manifest=turning)[3], driven[3]), 0.05)
        for mode in ("driver", "bake", "stream"):
            made = self.pictures(mode, "--mode", mode, "--camera", camera, manifest=turning)
            for number in NUMBERS:
                self.assertLess(other(made[number], driven[number]), FEW, (mode, number))

    def test_a_baked_file_renders_without_add_on_and_scripts(self):
        driven = self.driven()
        blend = os.path.join(self.folder, "baked.blend")
        self.assertEqual(drive(MANIFEST, "--mode", "bake", "--blend", blend, "--samples", "4")[0], 0)
        moved = os.path.join(self.folder, "elsewhere.blend")
        os.replace(blend, moved)
        subprocess.run([BLENDER, "-b", "--factory-startup", "--disable-autoexec", moved, "-o",
                        os.path.join(self.folder, "farm_##"), "-F", "PNG", "-s", "1", "-e", "3", "-a"],
                       check=True, stdout=subprocess.DEVNULL,
                       env={key: value for key, value in os.environ.items() if key != "BLENDER_USER_SCRIPTS"})
        for place, number in enumerate(NUMBERS, 1):
            picture = pixels(os.path.join(self.folder, f"farm_{place:02d}.png"))
            for compared in NUMBERS:
                difference = other(picture, driven[compared])
                if compared == number:
                    self.assertLess(difference, FEW, number)
                else:
                    self.assertGreater(difference, 0.05, (number, compared))

    def test_motion_blur_follows_the_velocity_in_every_mode(self):
        sharp = self.driven()[3]
        blurred = {mode: self.pictures(mode, "--mode", mode, "--motion-blur", "0.5", "--frames", "3")[3]
                   for mode in ("driver", "bake", "stream")}
        self.assertGreater(other(blurred["driver"], sharp), 0.05)
        for mode in ("bake", "stream"):  # A few samples fall to another surface in the same place.
            self.assertLess(other(blurred[mode], blurred["driver"]), 2 * FEW, mode)
        # Nothing is blurred without the attribute, so the velocity makes the blur.
        folder = shutil.copytree(RUN, os.path.join(self.folder, "copy"))
        path = os.path.join(folder, "surface_00003.mns")
        with open(path, "rb") as file:
            data = file.read()
        header, _ = samples.header_of(data)
        header["arrays"] = [array for array in header["arrays"] if not array["name"].endswith("mesh.velocity")]
        with open(path, "wb") as file:
            file.write(samples.with_header(data, header))
        still = self.pictures("still", "--motion-blur", "0.5", "--frames", "3",
                              manifest=os.path.join(folder, "surface_sequence.json"))[3]
        self.assertLess(other(still, sharp), other(blurred["driver"], sharp) / 4)

    def test_the_driver_goes_on_behind_a_fault_and_exits_with_it(self):
        folder = shutil.copytree(RUN, os.path.join(self.folder, "copy"))
        manifest = os.path.join(folder, "surface_sequence.json")
        bad = os.path.join(folder, "surface_00003.mns")
        with open(bad, "rb") as file:
            data = bytearray(file.read())
        data[len(data) // 2] ^= 1
        with open(bad, "wb") as file:
            file.write(data)
        pattern = os.path.join(self.folder, "fault_#####")
        for mode in ("driver", "stream"):
            code, lines, error = drive(manifest, "--mode", mode, "--output", pattern, "--samples", "1")
            self.assertEqual(code, 3, error)
            self.assertEqual([line["state"] for line in lines], ["done", "failed", "done"])
            self.assertIn("checksum", lines[1]["error"])
            self.assertFalse(os.path.exists(pattern.replace("#####", "00003") + ".png"))
        os.remove(bad)
        self.assertEqual(drive(manifest, "--frames", "3", "--output", pattern)[0], 3)
        self.assertEqual(drive(manifest, "--mode", "bake", "--output", pattern)[0], 3)
        self.assertEqual(drive(manifest, "--frames", "1", "--output", os.path.join(manifest, "no_#.png"))[0], 6)
        self.assertEqual(drive(manifest, "--frames", "2", "--output", pattern)[0], 2)
        self.assertEqual(drive(manifest, "--frames", "3-1", "--output", pattern)[0], 2)
        self.assertEqual(drive(manifest, "--output", os.path.join(self.folder, "same.png"))[0], 2)
        self.assertFalse([name for name in os.listdir(self.folder) if "unfinished" in name])


if not unittest.main(argv=["inside_driven"], exit=False).result.wasSuccessful():
    sys.exit(1)
