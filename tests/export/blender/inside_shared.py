# SPDX-License-Identifier: BSD-3-Clause
"""Runs as studios share them: in other view layers, linked, appended, overridden, saved elsewhere, moved, and with their files gone."""

import contextlib
import io
import os
import shutil
import subprocess
import sys
import unittest

import bpy
import numpy as np

sys.path.insert(0, sys.argv[sys.argv.index("--") + 3])
from computed_case import BLENDER, FOLDER, PACKAGE, of_file, start_anew  # noqa: E402
import samples  # noqa: E402

from meniscus_import import sequence  # noqa: E402

RUN = os.path.join(FOLDER, "run")
KINDS = ("stream", "panel")


def told(mesh):
    """Returns numbers that distinguish a mesh from the next frame's."""
    places = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", places)
    return len(mesh.polygons), round(float(np.abs(places).sum()), 1)


def shown(layer=None):
    """Returns those numbers for each mesh that a view layer shows, instances included."""
    layer = layer or bpy.context.view_layer
    layer.update()
    graph = layer.depsgraph
    graph.update()
    return sorted(told(each.object.data) for each in graph.object_instances
                  if each.object.type == "MESH" and len(each.object.data.polygons))


def at_frames(scene=None, layer=None):
    found = []
    for frame in (1, 2, 3):
        (scene or bpy.context.scene).frame_set(frame)
        found.append(shown(layer))
    return found


class Shared(unittest.TestCase):
    def setUp(self):
        start_anew()
        self.folder = os.path.join(FOLDER, self.id())
        for name in ("library", "shot"):
            os.makedirs(os.path.join(self.folder, name))
        shutil.copytree(RUN, os.path.join(self.folder, "library", "run"))
        with open(samples.UBIQUITIN, encoding="ascii") as file, open(self.path("library", "models.pdb"), "w", encoding="ascii") as target:
            target.writelines(line for line in file if line[:4] != "ATOM" or int(line[22:26]) < 6)
        self.library, self.shot = self.path("library", "library.blend"), self.path("shot", "shot.blend")

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def make(self, kind):
        """Saves a file with a run whose paths are relative, and returns its meshes at three frames."""
        start_anew()
        bpy.ops.wm.save_as_mainfile(filepath=self.library)
        if kind == "panel":
            item = of_file(self.path("library", "models.pdb"), "PROXY", is_run=True)
            self.assertEqual(item.meniscus.file, "//models.pdb")
        else:
            item = getattr(sequence, kind)(self.path("library", "run", "surface_sequence.json"))
            self.assertEqual(item["meniscus_sequence"], "//run/surface_sequence.json")
        wanted = at_frames()
        self.assertEqual([len(each) for each in wanted], [1, 1, 1])
        self.assertEqual(len({each[0] for each in wanted}), 3)
        bpy.context.scene.frame_set(1)
        bpy.ops.wm.save_as_mainfile(filepath=self.library)
        return wanted

    def load(self, link):
        """Links or appends the object in a new file in another folder."""
        start_anew()
        bpy.ops.wm.save_as_mainfile(filepath=self.shot)
        with bpy.data.libraries.load(self.library, link=link) as (there, found):
            found.objects = [name for name in there.objects if "surface" in name or "models" in name]
        for item in found.objects:
            bpy.context.scene.collection.objects.link(item)
        return found.objects[0]

    def test_a_bake_shows_one_frame_everywhere(self):
        wanted, scene = self.make("bake"), bpy.context.scene
        layer = scene.view_layers.new("matte")
        self.assertEqual(at_frames(layer=layer), wanted)
        other = bpy.data.scenes.new("other")
        other.collection.children.link(bpy.data.collections["surface_sequence"])
        self.assertEqual(at_frames(other, other.view_layers[0]), wanted)
        bpy.ops.wm.open_mainfile(filepath=self.library)
        self.assertEqual(at_frames(), wanted)
        for link in (True, False):
            start_anew()
            with bpy.data.libraries.load(self.library, link=link) as (_there, found):
                found.collections = ["surface_sequence"]
            bpy.context.scene.collection.children.link(found.collections[0])
            self.assertEqual(at_frames(), wanted, link)
            bpy.context.scene.collection.children.unlink(found.collections[0])
            empty = bpy.data.objects.new("instance", None)
            empty.instance_type, empty.instance_collection = "COLLECTION", found.collections[0]
            bpy.context.scene.collection.objects.link(empty)
            self.assertEqual(at_frames(), wanted, link)

    def test_linked_runs_stay_as_they_are_and_that_is_said_once(self):
        for kind in KINDS:
            wanted = self.make(kind)
            self.load(link=True)
            with contextlib.redirect_stderr(io.StringIO()) as said:
                self.assertEqual(at_frames() + at_frames(), [wanted[0]] * 6, kind)
            self.assertEqual(said.getvalue().count("\n"), 1, said.getvalue())
            self.assertIn("library override", said.getvalue())

    def test_library_overrides_follow(self):
        for kind in KINDS:
            wanted = self.make(kind)
            item = self.load(link=True).override_create(remap_local_usages=True)
            self.assertEqual(at_frames(), wanted, kind)
            self.assertIsNone(item.data.library)
            bpy.ops.wm.save_as_mainfile(filepath=self.shot)
            bpy.ops.wm.open_mainfile(filepath=self.shot)
            self.assertEqual(at_frames(), wanted, kind)
            item = next(each for each in bpy.data.objects if each.override_library)
            if kind == "panel":
                item.meniscus.start = 0.0
                bpy.ops.wm.save_as_mainfile(filepath=self.shot)
                bpy.ops.wm.open_mainfile(filepath=self.shot)
                self.assertEqual(at_frames()[:2], wanted[1:], kind)

    def test_appended_runs_find_their_files(self):
        for kind in KINDS:
            wanted = self.make(kind)
            item = self.load(link=False)
            self.assertEqual(at_frames(), wanted, kind)
            bpy.ops.wm.save_as_mainfile(filepath=self.shot)
            self.assertTrue((item.meniscus.file or item["meniscus_sequence"]).startswith("//../library/"))
            bpy.ops.wm.open_mainfile(filepath=self.shot)
            self.assertEqual(at_frames(), wanted, kind)

    def test_a_file_saved_elsewhere_finds_them(self):
        for kind in KINDS:
            wanted = self.make(kind)
            bpy.ops.wm.save_as_mainfile(filepath=self.shot)
            self.assertEqual(at_frames(), wanted, kind)
            bpy.ops.wm.save_as_mainfile(filepath=self.library, copy=True)
            self.assertEqual(at_frames(), wanted, kind)
            for path in (self.shot, self.library):
                bpy.ops.wm.open_mainfile(filepath=path)
                self.assertEqual(at_frames(), wanted, (kind, path))

    def test_a_folder_that_moves_takes_them_with_it(self):
        for kind in KINDS:
            wanted = self.make(kind)
            moved = self.path("moved" + kind)
            shutil.copytree(self.path("library"), moved)
            with open(self.path("library", "models.pdb"), "a", encoding="ascii") as file:
                file.write("REMARK the older one has changed\n")
            bpy.ops.wm.open_mainfile(filepath=os.path.join(moved, "library.blend"))
            self.assertEqual(at_frames(), wanted, kind)
            item = next(each for each in bpy.data.objects if each.type == "MESH")
            self.assertIn(moved, next(value[1] for key, value in item.items() if key.startswith("meniscus_at_")))

    def test_what_is_gone_leaves_the_last_mesh_and_a_line(self):
        for kind in KINDS:
            wanted = self.make(kind)
            place = self.path("library", "models.pdb" if kind == "panel" else "run")
            os.rename(place, place + ".away")
            bpy.ops.wm.open_mainfile(filepath=self.library)
            with contextlib.redirect_stderr(io.StringIO()) as said:
                self.assertEqual(at_frames() + at_frames(), [wanted[0]] * 6, kind)
            self.assertEqual(said.getvalue().count("\n"), 1, said.getvalue())
            item = next(each for each in bpy.data.objects if each.type == "MESH")
            self.assertIn("no such file", item["meniscus_error"])
            os.rename(place + ".away", place)
            self.assertEqual(at_frames(), wanted, kind)
            self.assertEqual(item["meniscus_error"], "")

    def test_a_render_from_the_command_line_ends_where_a_frame_is_not_to_be_had(self):
        for kind in KINDS:
            self.make(kind)
            camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
            bpy.context.scene.collection.objects.link(camera)
            scene = bpy.context.scene
            scene.camera, scene.render.engine, scene.render.resolution_percentage = camera, "CYCLES", 2
            scene.cycles.samples, scene.cycles.use_denoising = 1, False
            bpy.ops.wm.save_as_mainfile(filepath=self.library)
            gone = self.path("library", "models.pdb" if kind == "panel" else "run/surface_00005.mns")  # of frame 3
            tools = self.path("tools.py")
            with open(tools, "w", encoding="utf-8") as file:
                file.write("import addon_utils, bpy\naddon_utils.enable('meniscus_import', default_set=True)\n"
                           f"bpy.context.preferences.addons['meniscus_import'].preferences.package = {PACKAGE!r}\n")
            for is_there, code, pictures in ((True, 0, 3), (False, 3, 0 if kind == "panel" else 2)):
                if not is_there:
                    os.remove(gone)
                target = self.path(f"{kind}{code}")
                done = subprocess.run([BLENDER, "-b", "--factory-startup", "--addons", "meniscus_import", "--python-exit-code", "3", "--python", tools,
                                       self.library, "-o", os.path.join(target, "frame_####"), "-F", "PNG", "-s", "1", "-e", "3", "-a"],
                                      capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, code, done.stderr[-2000:])
                self.assertEqual(len(os.listdir(target)) if os.path.isdir(target) else 0, pictures, kind)
                if code:
                    self.assertIn(f"no picture of frame {pictures + 1}", done.stderr)

    def test_duplicates_of_a_stream_at_other_times(self):
        wanted = self.make("stream")
        item = next(each for each in bpy.data.objects if each.get("meniscus_stream"))
        twin = item.copy()  # The copy uses the same mesh.
        bpy.context.scene.collection.objects.link(twin)
        twin["meniscus_start"], twin["meniscus_outside"] = 0.0, "HOLD"
        for frame in (2, 1, 3, 2):
            bpy.context.scene.frame_set(frame)
            self.assertEqual([told(item.data)], wanted[frame - 1], frame)
            self.assertEqual([told(twin.data)], wanted[min(frame, 2)], frame)


if not unittest.main(argv=["inside_shared"], exit=False).result.wasSuccessful():
    sys.exit(1)
