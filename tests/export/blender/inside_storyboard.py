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

from meniscus_import import compat, materials, mesh_arrays, mns_reader, storyboard  # noqa: E402

UBIQUITIN = "/usr/share/freesasa/test-data/1ubq.pdb"
SIZE = (240, 180)
LOOK = ["--size", "%dx%d" % SIZE, "--samples", "1", "--select", "resi 1-30", "--device", "cpu", "-q"]
#: Looks from another side, in another colour, with a cut, or without perspective.
SCENES = {
    "one": ["--color", "element", "--background", "white"],
    "side": ["--color", "element", "--background", "white", "--view", "x"],
    "blue": ["--color", "#3060c0", "--background", "#406080", "--view", "x"],
    "cut": ["--color", "#3060c0", "--background", "#406080", "--view", "y", "--clip", "depth>0.5"],
    "flat": ["--color", "#3060c0", "--background", "#406080", "--view", "y", "--clip", "depth>0.5", "--projection", "orthographic"],
}
SCENES["all"], SCENES["half"] = (["--color", "#3060c0", "--view", "x", "--silhouettes", "0", *more] for more in ((), ("--show", "resi 1-15")))
SCENES["tele"] = SCENES["side"]  # A lens of a third of the angle sees it from three times as far.
FILM = ["--fps", "10", "--hold", "0.4", "--device", "cpu", "-q"]
HELD, BETWEEN = 4, 7
#: Largest error of a camera in pixels of a picture of 1,080 rows.
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
        camera = ["--camera", tele_camera(molecule)] if name == "tele" else []
        look = [word for word in SCENES[name] if not camera or word not in ("--view", "x")]
        run("render", molecule, "-o", os.path.join(FOLDER, f"story_{name}.png"), "--save-scene", path, *LOOK, *look, *camera)
    return path


def tele_camera(molecule):
    """Writes the camera of "side" with a third of its angle, so far away that the molecule looks as large."""
    path = os.path.join(FOLDER, "story_tele_camera.json")
    run("render", molecule, "-o", os.path.join(FOLDER, "story_tele_side.png"), "--save-camera", path, *LOOK, *SCENES["side"])
    with open(path, encoding="utf-8") as file:
        camera = json.load(file)
    position, target, angle = np.array(camera["position"]), np.array(camera["target"]), np.radians(camera["vertical_fov"])
    farther = np.tan(angle / 2) / np.tan(angle / 6)
    camera |= {"position": list(target + farther * (position - target)), "vertical_fov": np.degrees(angle / 3)}
    with open(path, "w", encoding="utf-8") as file:
        json.dump(camera, file)
    return path


def written(names, *options, to="blender"):
    """Exports the film of these scenes and returns its folder."""
    folder = os.path.join(FOLDER, "_".join((to, *names, *(option.strip("-") for option in options))))
    if not os.path.exists(folder):
        time = [] if "--transition" in options else ["--transition", "0.7"]
        run("film", *(scene_file(name) for name in names), *FILM, *time, *options, "--to", to, "-o", folder)
    return folder


class FilmCameras:
    """Cameras of the film for POV-Ray, which writes each one out: they place points in its pictures."""

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
        """Returns shares of the picture's size from its middle. first_camera: its place in Å, which gives the scene's
        shift."""
        place = self.places[frame - 1]
        right, up, forward, eye = (axis[place] for axis in self.axes)
        ways = points - (np.array(first_camera) - self.axes[3][self.places[0]]) - eye
        flat = self.sizes[2][place]
        size = np.array([self.sizes[0][place], self.sizes[1][place]])
        return np.stack([ways @ right, ways @ up], axis=1) / (size if flat else (ways @ forward)[:, None] * size)


def read_story(folder):
    with open(os.path.join(folder, "story.json"), encoding="ascii") as file:
        return json.load(file)


def pixels(path):
    """Reads a picture as Blender does, (rows from the bottom, columns, 4)."""
    image = bpy.data.images.load(path)
    values = np.array(image.pixels[:]).reshape(image.size[1], image.size[0], 4)
    bpy.data.images.remove(image)
    return values


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
        """Returns the largest distance in pixels of a picture of 1,080 rows."""
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
        for case in (("side", "blue", "cut"), ("flat", "one", "flat", "side"), ("one", "flat", "--ease", "even"),
                     ("one", "tele", "side")):
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

    def test_objects_fade_at_the_pace_of_the_film(self):
        """Objects of only one of two scenes fade from start to end, and objects of both stay."""
        names = ("side", "one", "cut")
        for options, share in ((), lambda time: time * time * (3 - 2 * time)), (("--ease", "even"), lambda time: time):
            bpy.ops.wm.read_factory_settings(use_empty=True)
            made = self.imported(names, *options)
            (whole,), (cut,) = made.items[0], made.items[2]
            for frame in range(1, bpy.context.scene.frame_end + 1):
                bpy.context.scene.frame_set(frame)
                part = share(max(0.0, min(1.0, (frame - 2 * HELD - BETWEEN) / (BETWEEN + 1))))
                self.assertAlmostEqual(whole.color[3], 1.0 + part, delta=1e-4)
                self.assertAlmostEqual(cut.color[3], part, delta=1e-4)
            self.assertEqual({counted for (_, path, _), counted in self.counts(whole, cut).items() if path == "color"}, {3})
            for item in whole, cut:
                self.assertTrue(any(node.type == "GROUP" and node.node_tree.name == materials.FADE for node in item.data.materials[0].node_tree.nodes))

    def test_the_background_is_that_of_the_film(self):
        """Backgrounds are blended in linear light; a cut changes them at once, and a clear one stays clear."""
        def color():
            node = bpy.context.scene.world.node_tree.nodes["Seen"]
            return np.array(node.inputs["Color"].default_value[:3])
        self.imported(("side", "blue"))
        scene = bpy.context.scene
        ends = [mesh_arrays.linear(color) for color in ((1.0, 1.0, 1.0), (0x40 / 255, 0x60 / 255, 0x80 / 255))]
        for frame in range(1, scene.frame_end + 1):
            scene.frame_set(frame)
            time = max(0.0, min(1.0, (frame - HELD) / (BETWEEN + 1)))
            np.testing.assert_allclose(color(), ends[0] + (ends[1] - ends[0]) * time * time * (3 - 2 * time), atol=1e-4)
        bpy.ops.wm.read_factory_settings(use_empty=True)
        made = self.imported(("side", "cut"), "--transition", "0")
        for frame, end in ((HELD, 0), (HELD + 0.9, 0), (HELD + 1, 1)):
            bpy.context.scene.frame_set(int(frame), subframe=frame % 1)
            np.testing.assert_allclose(color(), ends[end], atol=1e-6)
            self.assertEqual([items[0].hide_render for items in made.items], [end == 1, end == 0])
            np.testing.assert_allclose(made.camera.matrix_world.translation, np.array(read_story(written(("side", "cut"), "--transition", "0"))[
                "scenes"][end]["camera"]["position"]) * 0.1, atol=1e-4)

    def test_a_damaged_storyboard_is_one_sentence_and_leaves_nothing(self):
        good = read_story(written(("side", "cut")))
        folder = os.path.join(FOLDER, "damaged")
        shutil.copytree(written(("side", "cut")), folder)
        path = os.path.join(folder, "story.json")

        def scene(**changes):
            return {**good, "scenes": [good["scenes"][0], {**good["scenes"][1], **changes}]}
        cases = [("text", "no JSON"), ([1], "not a storyboard"), ({**good, "format": "meniscus surface sequence"}, "not a storyboard"),
                 ({**good, "version": 2}, "newer"), ({**good, "version": "1"}, "does not exist"), ({**good, "fps": 0}, "fps"),
                 ({**good, "scale": "0.1"}, "scale"), ({**good, "origin": [0, 0]}, "origin"), ({**good, "ease": "bounce"}, "ease"),
                 ({**good, "scenes": good["scenes"][:1]}, "fewer than two scenes"), ({**good, "scenes": [1, 2]}, "scene 1"),
                 (scene(first=1), "scene 2 begins"), (scene(last=0), "cannot last"), (scene(first=True), "cannot last"),
                 (scene(file="../scene_1.mns"), "not a name in the storyboard's folder"), (scene(file="absent.mns"), "absent.mns"), (scene(name=3), "name is 3, not a text"),
                 (scene(background=[0, 0, 2]), "background"), (scene(camera={"projection": "fisheye"}), "scene 2"),
                 (scene(camera=None), "camera"), (scene(camera={**good["scenes"][1]["camera"], "vertical_fov": 0}), "vertical_fov")]
        stores = (bpy.data.objects, bpy.data.meshes, bpy.data.materials, bpy.data.collections, bpy.data.cameras, bpy.data.actions,
                  bpy.data.worlds, bpy.data.node_groups)
        before = [len(store) for store in stores]
        for content, said in cases:
            with open(path, "w", encoding="ascii") as file:
                file.write(content if isinstance(content, str) else json.dumps(content))
            with self.assertRaisesRegex((mns_reader.MnsError, OSError), said):
                storyboard.import_file(path)
        with open(path, "w", encoding="ascii") as file:
            json.dump(good, file)
        with open(os.path.join(folder, good["scenes"][1]["file"]), "r+b") as file:
            file.seek(-1000, os.SEEK_END)
            file.write(b"?")
        with self.assertRaisesRegex(RuntimeError, "checksum"):
            bpy.ops.import_scene.meniscus_storyboard(filepath=path)
        self.assertEqual([len(store) for store in stores], before)

    def test_text_of_files_stays_text(self):
        """A title is the name of a marker, whichever characters it holds."""
        title = "'); import os; os.abort() #"
        path = os.path.join(FOLDER, "story_titled.json")
        scene_file("side")
        run("render", os.path.join(FOLDER, os.path.basename(UBIQUITIN)), "-o", os.path.join(FOLDER, "titled.png"), "--save-scene", path,
            *LOOK, "--title", title)
        said = run("film", path, scene_file("side"), *FILM[:-1], "--to", "blender", "-o", os.path.join(FOLDER, "titled")).stderr
        self.assertIn("note: titles, labels, legends", said)
        storyboard.import_file(os.path.join(FOLDER, "titled", "story.json"))
        self.assertEqual([marker.name for marker in bpy.context.scene.timeline_markers], [title, "story_side"])

    def test_what_cannot_be_is_refused(self):
        path = os.path.join(FOLDER, "story_run.json")
        molecule = os.path.join(FOLDER, "1d3z.pdb")
        shutil.copy(os.path.join(os.path.dirname(UBIQUITIN), "1d3z.pdb"), molecule)
        run("render", molecule, "-o", os.path.join(FOLDER, "run_#.png"), "--frames", "1-2", "--save-scene", path, *LOOK)
        said = run("film", path, scene_file("side"), *FILM, "--to", "blender", "-o", os.path.join(FOLDER, "never"), code=2).stderr
        self.assertIn("this is one of a run of frames", said)
        self.assertFalse(os.path.exists(os.path.join(FOLDER, "never")))
        two = [scene_file("side"), scene_file("cut")]
        said = run("film", *two, *FILM, "--to", "blender", "-o", os.path.join(FOLDER, "never.mp4"), code=2).stderr
        self.assertIn("--to blender writes a folder", said)
        written(("side", "cut"))
        self.assertIn("exists already", run("film", *two, *FILM, "--to", "blender", "-o", written(("side", "cut")), code=6).stderr)

    def test_scale_and_centre(self):
        plain = self.imported(("side", "cut"))
        names = ("side", "cut")
        origin = np.array(read_story(written(names))["origin"])
        places = [np.array(each.matrix_world.translation) for each in (plain.camera, plain.camera.parent)]
        bpy.ops.wm.read_factory_settings(use_empty=True)
        moved = self.imported(names, scale=1.0, center=True)
        for each, place in zip((moved.camera, moved.camera.parent), places):
            np.testing.assert_allclose(each.matrix_world.translation, place * 10.0 - origin, atol=1e-3)
        corners = np.array(moved.items[0][0].bound_box)
        middle = 0.5 * (corners.min(axis=0) + corners.max(axis=0)) + np.array(moved.items[0][0].matrix_world.translation)
        self.assertLess(np.abs(middle).max(), 1.0)

    def test_a_picture_between_two_scenes_is_the_blend_of_both(self):
        """Cycles renders the middle of a transition that takes half of the residues away; it covers the film's
        pixels."""
        names = ("all", "half")
        made = self.imported(names)
        frame = HELD + (BETWEEN + 1) // 2
        run("film", *(scene_file(name) for name in names), *FILM, "--transition", "0.7", "--samples", "16", "-o", os.path.join(FOLDER, "blend_##.png"))
        film = pixels(os.path.join(FOLDER, f"blend_{frame - 1:02d}.png"))[:, :, 3]
        scene = bpy.context.scene
        scene.frame_set(frame)
        self.assertEqual([items[0].hide_render for items in made.items], [False, False])
        self.assertTrue(scene.render.film_transparent)
        scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 64, False
        scene.render.filepath = os.path.join(FOLDER, "blend.png")
        compat.set_format(scene.render.image_settings, "PNG")
        scene.render.image_settings.color_mode = "RGBA"
        bpy.ops.render.render(write_still=True)
        ours = pixels(scene.render.filepath)[:, :, 3]
        off, aside = (float(np.abs(other - ours).mean() / film.mean()) for other in (film, np.roll(film, 2, axis=1)))
        halves = float(((film > 0.4) & (film < 0.6)).mean())
        print(f"coverage in the middle: {film.mean():.4f} in the film, {ours.mean():.4f} by Cycles; off by {100 * off:.2f} % a pixel, "
              f"two pixels aside {100 * aside:.2f} %; half covered {100 * halves:.1f} %")
        self.assertGreater(halves, 0.02)
        self.assertLess(abs(ours.mean() / film.mean() - 1.0), 0.01)
        self.assertLess(off, 0.04)
        self.assertGreater(aside, 2.0 * off)

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
