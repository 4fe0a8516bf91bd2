# SPDX-License-Identifier: BSD-3-Clause
"""The manifest of a run and its files under plain Python: arguments PROGRAM ADDON_FOLDER."""

import json
import os
import subprocess
import sys
import tempfile
import types
import unittest

PROGRAM, ADDON = sys.argv[1], sys.argv[2]
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
package = sys.modules["meniscus_import"] = types.ModuleType("meniscus_import")  # The add-on is loaded without Blender.
package.__path__ = [os.path.join(ADDON, "meniscus_import")]

import numpy as np  # noqa: E402

import samples  # noqa: E402
from meniscus_import import compat, mns_reader, sequence_reader  # noqa: E402


class SequenceReader(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.whole = os.path.join(cls.folder.name, "run")
        samples.export_run(PROGRAM, cls.whole)
        cls.manifest = os.path.join(cls.whole, "surface_sequence.json")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_scene_frames_are_those_of_the_run(self):
        found = sequence_reader.read(self.manifest)
        self.assertEqual([frame.number for frame in found.frames], [1, 3, 5])
        self.assertEqual([found.scene_frame(number) for number in (1, 2, 3, 5)], [1, None, 2, 3])
        for place in (1, 2, 3):
            self.assertEqual(found.read(place).header["sequence"]["scene_frame"], place)
        self.assertFalse(found.camera_moves)

    def test_cameras_of_files(self):
        """Cameras of --save-camera are read; other files are refused with a reason."""
        path = os.path.join(self.folder.name, "camera.json")
        picture = os.path.join(self.folder.name, "a.png")
        for projection in ("perspective", "orthographic"):
            subprocess.run([PROGRAM, "render", samples.UBIQUITIN, "--select", "resi 1", "-q", "-o", picture, "--size", "40x30", "--projection",
                            projection, "--save-camera", path, "--force", "--device", "cpu"], check=True)
            with open(path, encoding="utf-8") as file:
                good = json.load(file)
            self.assertEqual(sequence_reader.read_camera(path), good)
            run = sequence_reader.read(self.manifest)
            size = run.frames[0].camera["size"]
            run.set_camera(good)
            self.assertEqual([frame.camera for frame in run.frames], [{**good, "size": size}] * 3)
            name = mns_reader.SIZES[projection]
            missing = {key: value for key, value in good.items() if key != "up"}
            for wrong, said in ((missing, "up is missing"), ({**good, "projection": "fisheye"}, "projection"), ([1, 2], "projection"),
                                ({**good, "size": [4, 3]}, "'size' is not a key"), ({**good, name: 0}, f"{name} is 0, not a number above 0"),
                                ({**good, name: "wide"}, "camera: "), ({**good, "position": good["target"]}, "position equals target"),
                                ({**good, "up": [0, 0, "x"]}, "camera: "), ({**good, "up": [0, 0]}, "camera: "),
                                ({**good, "target": [float("nan"), 0, 0]}, "target is .nan, 0, 0., not three numbers")):
                with open(path, "w", encoding="utf-8") as file:
                    json.dump(wrong, file)
                with self.assertRaisesRegex(mns_reader.MnsError, said):
                    sequence_reader.read_camera(path)
        with open(path, "w", encoding="utf-8") as file:
            json.dump({**good, "projection": "perspective", "vertical_fov": 180.0}, file)
        with self.assertRaisesRegex(mns_reader.MnsError, "'height' is not a key"):
            sequence_reader.read_camera(path)
        with open(path, "w", encoding="utf-8") as file:
            file.write("set_view (1, 2)")
        with self.assertRaisesRegex(mns_reader.MnsError, "no JSON, such as --save-camera writes"):
            sequence_reader.read_camera(path)

    def test_times_show_the_nearest_frame(self):
        def places(times, count=3, **options):
            timing = sequence_reader.Timing(**options)
            return [timing.place(time, count) for time in times]

        self.assertEqual(places((0.4, 0.5, 1.25, 1.5, 3.4, 3.5)), [None, 1, 1, 2, 3, None])
        self.assertEqual(places((-9, 0.4, 3.5, 99), outside="HOLD"), [1, 1, 3, 3])
        self.assertEqual(places(range(-3, 8), outside="LOOP"), [3, 1, 2, 3, 1, 2, 3, 1, 2, 3, 1])
        self.assertEqual(places(range(-3, 8), outside="PINGPONG"), [1, 2, 3, 2, 1, 2, 3, 2, 1, 2, 3])
        self.assertEqual(places((5, 6), count=1, outside="PINGPONG"), [1, 1])
        self.assertEqual(places((8, 9, 10, 11, 12, 13, 14, 15), start=10, speed=0.5), [None, 1, 1, 2, 2, 3, 3, None])
        self.assertEqual(places((10, 11, 12), start=10, speed=2.0), [1, 3, None])
        timing = sequence_reader.Timing(10, 0.5)
        self.assertEqual([timing.place(timing.scene_time(place), 3) for place in (1, 2, 3)], [1, 2, 3])
        self.assertEqual([timing.within(place, 3) for place in (0.4, 1.0, 2.5, 3.5)], [None, 1, 3, None])
        for wrong in ({"speed": 0.0}, {"speed": float("nan")}, {"start": float("inf")}, {"outside": "BOUNCE"}):
            with self.assertRaises(mns_reader.MnsError):
                sequence_reader.Timing(**wrong)

    def test_shares_write_the_same_bytes(self):
        shares = os.path.join(self.folder.name, "shares")
        samples.export_run(PROGRAM, shares, "1-5:2", "--only", "5")
        samples.export_run(PROGRAM, shares, "1-5:2", "--only", "1,3")
        self.assertEqual(sorted(os.listdir(shares)), sorted(os.listdir(self.whole)))
        for name in os.listdir(self.whole):
            with open(os.path.join(self.whole, name), "rb") as one, open(os.path.join(shares, name), "rb") as share:
                self.assertEqual(one.read(), share.read(), name)

    def test_cameras_move(self):
        turning = os.path.join(self.folder.name, "turning")
        samples.export_run(PROGRAM, turning, "1-5:2", "--turntable", "0.5")
        found = sequence_reader.read(os.path.join(turning, "surface_sequence.json"))
        self.assertTrue(found.camera_moves)
        self.assertEqual(len({tuple(frame.camera["position"]) for frame in found.frames}), 3)
        self.assertEqual(found.run, sequence_reader.read(self.manifest).run)  # Both cameras suit its frames.
        for place, frame in enumerate(found.frames, 1):
            self.assertEqual(found.read(place).header["camera"], frame.camera)

    def test_points_of_contact_move_with_their_atom(self):
        """Convex points move with their atom between the neighbouring frames of the run, per frame of the scene."""
        every = os.path.join(self.folder.name, "every")
        samples.export_run(PROGRAM, every, "0-9")
        all_frames = sequence_reader.read(os.path.join(every, "surface_sequence.json"))

        def centers(number):
            return all_frames.read(number + 1).objects[0]["atom.center"]

        strided = sequence_reader.read(self.manifest)
        for found, number, wanted in (
                (all_frames, 0, centers(1) - centers(0)), (all_frames, 9, centers(9) - centers(8)),
                (all_frames, 4, (centers(5) - centers(3)) / 2), (strided, 3, (centers(5) - centers(1)) / 2),
                (strided, 5, centers(5) - centers(3))):
            surface = found.read(found.scene_frame(number)).objects[0]
            triangles, atom, kind = (surface["mesh." + name] for name in ("triangle", "atom", "kind"))
            curved = set(triangles[kind != 0].ravel())
            checked = 0
            for corners, index in zip(triangles[kind == 0], atom[kind == 0]):
                for vertex in set(corners) - curved:
                    np.testing.assert_allclose(surface["mesh.velocity"][vertex], wanted[index], atol=1e-5)
                    checked += 1
            self.assertGreater(checked, 500)

    def test_a_damaged_frame_fails_alone(self):
        source, model = os.path.join(self.folder.name, "damaged.pdb"), 0
        with open(samples.UBIQUITIN, encoding="ascii") as file, open(source, "w", encoding="ascii") as target:
            for line in file:
                model += line.startswith("MODEL")
                if model == 3 and line.startswith("ATOM") and line[6:11].strip() == "3":
                    line = line[:30] + "     nan" + line[38:]
                if model <= 4 and (line.startswith(("MODEL", "ENDMDL")) or line[:4] == "ATOM" and int(line[22:26]) < 6):
                    target.write(line)
        damaged = os.path.join(self.folder.name, "damaged")
        done = subprocess.run([PROGRAM, "export", "blender", source, "--frames", "all", "-o", damaged, "--device", "cpu",
                               "--tolerance", "0.05"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=False, text=True)
        self.assertEqual(done.returncode, 3)
        self.assertIn("1 of 4 frames failed; the first, frame 2", done.stderr)
        self.assertEqual(sorted(os.listdir(damaged)), ["surface_00000.mns", "surface_00001.mns", "surface_00003.mns",
                                                       "surface_sequence.json"])

    def test_files_of_another_run_are_refused(self):
        finer = os.path.join(self.folder.name, "finer")
        samples.export_run(PROGRAM, finer, "1-5:4")
        mixed = sequence_reader.read(self.manifest)
        mixed.frames[0].path = os.path.join(finer, "surface_00001.mns")
        with self.assertRaises(mns_reader.MnsError) as caught:
            mixed.read(1)
        self.assertIn("not frame 1 of this run", str(caught.exception))

    def test_manifests_that_make_no_sense(self):
        with open(self.manifest, encoding="ascii") as file:
            good = json.load(file)
        bad = {"newer": {"version": 99}, "does not exist": {"version": 0}, "not the manifest": {"format": "x"},
               "origin": {"origin": [0, 0]}, "scale": {"scale": -1}, "fps": {"fps": float("nan")}, "no frames": {"frames": []},
               "twice": {"frames": [good["frames"][0]] * 2}, "list of frames": {"frames": [{"frame": 1, "file": "../x.mns"}]}}
        path = os.path.join(self.folder.name, "bad.json")
        for word, change in bad.items():
            with open(path, "w", encoding="ascii") as file:
                json.dump({**good, **change}, file)
            with self.assertRaises(mns_reader.MnsError, msg=word) as caught:
                sequence_reader.read(path)
            self.assertIn(word, str(caught.exception))
        with open(path, "w", encoding="ascii") as file:
            file.write("{")
        self.assertRaises(mns_reader.MnsError, sequence_reader.read, path)

    def test_lists_of_frames(self):
        parse = sequence_reader.parse_frames
        self.assertEqual(parse("0-20:10,7,5-6,20", range(30)), [0, 10, 20, 7, 5, 6])
        self.assertEqual(parse("7-", range(10)), [7, 8, 9])
        self.assertEqual(parse("all", [3, 1]), [3, 1])
        for text in ("", "3-1", "1:2", "1-5:0", "a", "-3", "1--2", "0-99999999999", "1,,2"):
            self.assertRaises(ValueError, parse, text, range(3))


class Compat(unittest.TestCase):
    def test_sockets_of_a_node_group(self):
        class Interface:
            def __init__(self):
                self.made = []

            def new_socket(self, name, in_out, socket_type):
                self.made.append((name, in_out, socket_type))

        class NewTree:  # Blender 4.0 and later
            interface = Interface()

        compat.add_geometry_sockets(NewTree)
        self.assertEqual([made[1] for made in NewTree.interface.made], ["INPUT", "OUTPUT"])

    def test_frame_rates(self):
        self.assertEqual(compat.frame_rate(25.0), (25, 1.0))
        whole, base = compat.frame_rate(23.976)
        self.assertEqual(whole, 24)
        self.assertAlmostEqual(whole / base, 23.976)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
