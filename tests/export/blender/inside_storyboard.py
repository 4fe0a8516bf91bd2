# SPDX-License-Identifier: BSD-3-Clause
"""A storyboard in Blender is the film, moment by moment: its camera by few key frames, what is shown and when, its background."""

import json
import os
import re
import shutil
import subprocess
import sys
import unittest

import addon_utils
import bpy
import numpy as np
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Vector

FOLDER, _, HERE, _, PROGRAM = sys.argv[sys.argv.index("--") + 1:][:5]
sys.path.insert(0, HERE)

from meniscus_import import compat, storyboard  # noqa: E402

UBIQUITIN = "/usr/share/freesasa/test-data/1ubq.pdb"
SIZE = (240, 180)
LOOK = ["--size", "%dx%d" % SIZE, "--samples", "1", "--select", "resi 1-30", "--device", "cpu", "-q"]
#: A look from another side, of another colour, cut, without perspective.
SCENES = {
    "one": ["--color", "element", "--background", "white"],
    "side": ["--color", "element", "--background", "white", "--view", "x"],
    "blue": ["--color", "#3060c0", "--background", "#406080", "--view", "x"],
    "cut": ["--color", "#3060c0", "--background", "#406080", "--view", "y", "--clip", "depth>0.5"],
    "flat": ["--color", "#3060c0", "--background", "#406080", "--view", "y", "--clip", "depth>0.5", "--projection", "orthographic"],
}
FILM = ["--fps", "10", "--hold", "0.4", "--transition", "0.7", "--device", "cpu", "-q"]
HELD, BETWEEN = 4, 7
#: What a camera may be off, in pixels of a picture of 1,080 rows.
LIMIT = 1.5


def run(*words, code=0):
    done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=False)
    assert done.returncode == code, done.stderr
    return done


def scene_file(name):
    path = os.path.join(FOLDER, f"story_{name}.json")
    if not os.path.exists(path):
        molecule = os.path.join(FOLDER, os.path.basename(UBIQUITIN))
        if not os.path.exists(molecule):
            shutil.copy(UBIQUITIN, molecule)
        run("render", molecule, "-o", os.path.join(FOLDER, f"story_{name}.png"), "--save-scene", path, *LOOK, *SCENES[name])
    return path


def written(names, *options, to="blender"):
    """The folder with the film of these scenes."""
    folder = os.path.join(FOLDER, "_".join((to, *names, *(option.strip("-") for option in options))))
    if not os.path.exists(folder):
        run("film", *(scene_file(name) for name in names), *FILM, *options, "--to", to, "-o", folder)
    return folder


class FilmCameras:
    """Those of the film for POV-Ray, which has each written out: where points are in its pictures."""

    def __init__(self, folder, names):
        with open(os.path.join(folder, "surface.pov"), encoding="utf-8") as file:
            self.text = file.read()
        with open(os.path.join(folder, "surface_story.pov"), encoding="utf-8") as file:
            found = re.search(r"Meniscus_First = array\[\d+\] \{([^}]*)\}", file.read())
        self.places = [int(number) - 1 for number in found.group(1).split(",")]
        self.axes = [self.vectors(name) for name in ("Right", "Up", "Forward", "Eye")]
        self.sizes = [self.numbers(name) for name in ("Picture_Width", "Picture_Height", "Orthographic")]

    def vectors(self, name):
        listed = re.search(r"Meniscus_%s_List = array\[\d+\] \{(.*?)\}" % name, self.text, re.S).group(1)
        return np.array([[float(number) for number in each.split(",")] for each in re.findall("<([^>]*)>", listed)])

    def numbers(self, name):
        listed = re.search(r"Meniscus_%s_List = array\[\d+\] \{(.*?)\}" % name, self.text, re.S)
        if listed:
            return [float(number) for number in listed.group(1).split(",")]
        return [float(re.search(r"Meniscus_%s = ([-\d.e]+)" % name, self.text).group(1))] * len(self.places)

    def seen(self, frame, points, first_camera):
        """Shares of the picture's width and height from its middle. first_camera: its place in Å; POV-Ray's scene is moved."""
        place = self.places[frame - 1]
        right, up, forward, eye = (axis[place] for axis in self.axes)
        ways = points - (np.array(first_camera) - self.axes[3][self.places[0]]) - eye
        flat = self.sizes[2][place]
        size = np.array([self.sizes[0][place], self.sizes[1][place]])
        return np.stack([ways @ right, ways @ up], axis=1) / (size if flat else (ways @ forward)[:, None] * size)


def read_story(folder):
    with open(os.path.join(folder, "story.json"), encoding="ascii") as file:
        return json.load(file)


def points_of(item, scale=0.1):
    co = np.empty(3 * len(item.data.vertices), dtype=np.float32)
    item.data.vertices.foreach_get("co", co)
    return co.reshape(-1, 3)[::40] / scale


class Storyboard(unittest.TestCase):
    def setUp(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        addon_utils.enable("meniscus_import")

    def imported(self, names, *options, **others):
        return storyboard.import_file(os.path.join(written(names, *options), "story.json"), **others)

    def compare_cameras(self, names, *options):
        """The largest distance in pixels of a picture of 1,080 rows."""
        made = self.imported(names, *options)
        cameras = FilmCameras(written(names, *options, to="povray"), names)
        first = read_story(written(names, *options))["scenes"][0]["camera"]["position"]
        points = points_of(made.items[0][0])
        scene, worst = bpy.context.scene, 0.0
        self.assertEqual((scene.frame_start, scene.frame_end), (1, len(cameras.places)))
        for frame in range(1, scene.frame_end + 1):
            scene.frame_set(frame)
            ours = np.array([world_to_camera_view(scene, made.camera, Vector(point * 0.1))[:2] for point in points]) - 0.5
            off = np.abs(ours - cameras.seen(frame, points, first)) * (1080 * SIZE[0] / SIZE[1], 1080)
            worst = max(worst, float(off.max()))
        print(f"cameras of {' '.join((*names, *options))}: {worst:.3f} pixels of 1,080 rows at most")
        return made, worst

    def counts(self, *owners):
        return {(owner.name, curve.data_path, curve.array_index): len(curve.keyframe_points)
                for owner in owners for curve in compat.action_curves(owner)}

    def test_the_camera_is_that_of_the_film_at_every_frame(self):
        for case in (("side", "blue", "cut"), ("flat", "one", "flat", "side"), ("one", "flat", "--ease", "even")):
            bpy.ops.wm.read_factory_settings(use_empty=True)
            names, options = [word for word in case if word in SCENES], [word for word in case if word not in SCENES]
            _, worst = self.compare_cameras(names, *options)
            self.assertLess(worst, LIMIT, case)

    def test_two_keys_a_transition(self):
        made = self.imported(("side", "blue", "cut"))
        counts = self.counts(made.camera.parent, made.camera, made.camera.data)
        self.assertEqual({path for _, path, _ in counts}, {"location", "rotation_quaternion", "lens"})
        self.assertEqual(set(counts.values()), {4}, counts)
        held = [curve for curve in compat.action_curves(made.camera.parent) if curve.data_path == "location"]
        self.assertEqual([point.co[0] for point in held[0].keyframe_points], [HELD, HELD + BETWEEN + 1, 2 * HELD + BETWEEN, 2 * (HELD + BETWEEN) + 1])

    def test_every_scene_is_a_collection_and_shares_what_is_the_same(self):
        made = self.imported(("one", "side", "cut", "one"))
        self.assertEqual(len(os.listdir(written(("one", "side", "cut", "one")))), 1 + 2)
        self.assertEqual(made.items[0], made.items[1])
        self.assertEqual(made.items[0], made.items[3])
        self.assertEqual([child.name for child in made.collection.children], ["1 story_one", "2 story_side", "3 story_cut", "4 story_one"])
        self.assertEqual([marker.frame for marker in bpy.context.scene.timeline_markers], [1 + number * (HELD + BETWEEN) for number in range(4)])
        (whole,), (cut,) = made.items[0], made.items[2]
        for frame in range(1, bpy.context.scene.frame_end + 1):
            bpy.context.scene.frame_set(frame)
            share = [max(0, min(1, (frame - HELD - number * (HELD + BETWEEN)) / (BETWEEN + 1))) for number in range(3)]
            self.assertEqual(whole.hide_render, share[1] == 1 and share[2] == 0, frame)
            self.assertEqual(cut.hide_render, share[1] == 0 or share[2] == 1, frame)
            self.assertEqual((whole.hide_viewport, cut.hide_viewport), (whole.hide_render, cut.hide_render), frame)


if not unittest.main(argv=["inside_storyboard"], exit=False).result.wasSuccessful():
    sys.exit(1)
