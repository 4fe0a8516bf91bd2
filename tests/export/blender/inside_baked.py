# SPDX-License-Identifier: BSD-3-Clause
"""Bake run: what a stream, a run of the panel or atoms of Blender show while the timeline plays becomes meshes of the file, which open
without the add-on."""

import os
import subprocess
import sys
import unittest
import unittest.mock

import bpy
import numpy as np

sys.path.insert(0, sys.argv[sys.argv.index("--") + 3])
from computed_case import BLENDER, FOLDER, HERE, ComputedCase, of_file, start_anew  # noqa: E402
import samples  # noqa: E402
from shown_at import state  # noqa: E402

from meniscus_import import bake_run, sequence  # noqa: E402

MANIFEST = os.path.join(FOLDER, "run", "surface_sequence.json")


def stream():
    return sequence.stream(MANIFEST)


def panel():
    item = of_file(samples.UBIQUITIN, selection="resi 1-8", is_run=True)
    item.meniscus.frames = "0-2"
    bpy.ops.object.meniscus_update(wait=True)
    return item


def moving_atoms():
    """Makes three atoms that a handler moves; their surface follows."""
    mesh = bpy.data.meshes.new("atoms")
    mesh.from_pydata([(0, 0, 0), (0.39, 0, 0), (0.17, 0.36, 0.04)], [], [])
    mesh.attributes.new("vdw_radii", "FLOAT", "POINT").data.foreach_set("value", np.float32([0.17, 0.155, 0.152]))
    atoms = bpy.data.objects.new("atoms", mesh)
    bpy.context.scene.collection.objects.link(atoms)
    bpy.context.view_layer.objects.active = atoms

    def move(scene, _graph=None):
        atoms.data.vertices[1].co.x = 0.35 + 0.02 * scene.frame_current_final

    bpy.app.handlers.frame_change_pre.append(move)
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = 1, 3
    assert bpy.ops.object.meniscus_from_atoms(wait=True, detail="FINE") == {"FINISHED"}
    return bpy.context.view_layer.objects.active


WAYS = {"stream": stream, "panel": panel, "atoms": moving_atoms}


def data_counts():
    return {store: len(getattr(bpy.data, store)) for store in ("objects", "meshes", "collections", "materials", "node_groups")}


class Baked(ComputedCase):
    def make(self, way):
        start_anew()
        item = WAYS[way]()
        item.name = "run"
        bpy.context.view_layer.objects.active = item
        return item

    def read_without_add_on(self, times):
        path, target = os.path.join(FOLDER, self.id() + ".blend"), os.path.join(FOLDER, self.id() + ".npz")
        bpy.ops.wm.save_as_mainfile(filepath=path, compress=False)
        subprocess.run([BLENDER, "-b", "--factory-startup", "--python-exit-code", "3", "--python", os.path.join(HERE, "shown_at.py"), "--", path, target, *times],
                       check=True, capture_output=True, env={key: value for key, value in os.environ.items() if key != "BLENDER_USER_SCRIPTS"})
        return np.load(target)

    def test_a_baked_run_is_the_live_one_without_the_add_on(self):
        """Both agree vertex for vertex, with timing, place, materials, velocities and the user's attributes."""
        times = ("0", "1", "2", "2.25", "2.75", "3", "4", "6")
        for way in WAYS:
            item = self.make(way)
            if way == "stream":
                item["meniscus_start"], item["meniscus_speed"], item["meniscus_outside"] = 2.0, 0.5, "PINGPONG"
            elif way == "panel":
                item.meniscus.start, item.meniscus.speed, item.meniscus.outside = 2.0, 0.5, "EMPTY"
            bpy.context.scene.frame_set(2)
            item.data.attributes.new("mine", "FLOAT", "FACE").data.foreach_set("value", np.arange(len(item.data.polygons), dtype=np.float32))
            item.data.materials[0] = bpy.data.materials.new("own")
            item.location.x += 3.0
            item.keyframe_insert("rotation_euler", frame=1)
            item.rotation_euler.z = 1.0
            item.keyframe_insert("rotation_euler", frame=4)
            item.modifiers.new("Fewer", "DECIMATE").show_viewport = False
            live = state(item, ("1", "2", "3") if way == "atoms" else times)
            self.assertEqual(len({live[key].tobytes() for key in live if key.startswith("co ")} - {b""}), 3, way)
            if way != "atoms":
                self.assertIn("mine 3", live, way)
            bpy.context.scene.frame_set(3)
            before = {material.name for material in bpy.data.materials}
            self.assertEqual(bpy.ops.object.meniscus_bake("EXEC_DEFAULT"), {"FINISHED"}, way)
            self.assertEqual(bpy.context.scene.frame_current, 3, way)
            self.assertEqual([modifier.name for modifier in item.modifiers], ["Frame", "Fewer"], way)
            self.assertEqual({material.name for material in bpy.data.materials}, before, way)
            self.assertFalse([key for key in item.keys() if key in bake_run.LIVE_PROPERTIES], way)
            self.assertIsNone(bake_run.kind_of(item), way)
            found = self.read_without_add_on(("1", "2", "3") if way == "atoms" else times)
            self.assertEqual(set(found.files), set(live), way)
            for key, values in live.items():
                np.testing.assert_array_equal(found[key], values, err_msg=f"{way} {key}")

    def test_keys_of_the_frame_stay(self):
        for way in ("stream", "panel"):
            item = self.make(way)
            path = '["meniscus_frame"]' if way == "stream" else "meniscus.frame"
            if way == "stream":
                item["meniscus_by_hand"] = True
            else:
                item.meniscus.by_hand = True
            for time, place in ((10, 3.0), (20, 1.0)):
                if way == "stream":
                    item["meniscus_frame"] = place
                else:
                    item.meniscus.frame = place
                item.keyframe_insert(path, frame=time)
            times = ("10", "12", "15", "18", "20")
            live = state(item, times)
            bpy.ops.object.duplicate(linked=True)
            other = bpy.context.view_layer.objects.active
            self.assertEqual(bpy.ops.object.meniscus_bake(), {"FINISHED"}, way)
            for shown in (item, other):
                found = state(shown, times)
                for key, values in live.items():
                    np.testing.assert_array_equal(found[key], values, err_msg=f"{way} {shown.name} {key}")

    def test_a_bake_that_ends_early_changes_nothing(self):
        for way in WAYS:
            item = self.make(way)
            bpy.context.scene.frame_set(2)
            before, counts, live = item.data, data_counts(), state(item, ("2",))
            steps = bake_run.bake(item, bpy.context.scene)
            self.assertEqual(next(steps), (1, 3), way)
            next(steps)
            steps.close()
            self.assertEqual((item.data, data_counts(), bpy.context.scene.frame_current), (before, counts, 2), way)
            module, name = (sequence, "show_place") if way == "stream" else (bake_run.computed, "show_place")
            with unittest.mock.patch.object(module, name, side_effect=OSError("no room")), self.assertRaisesRegex(RuntimeError, "no room"):
                bpy.ops.object.meniscus_bake("EXEC_DEFAULT")
            self.assertEqual((item.data, data_counts()), (before, counts), way)
            found = state(item, ("2",))
            for key, values in live.items():
                np.testing.assert_array_equal(found[key], values, err_msg=f"{way} {key}")

    def test_what_is_no_live_run_has_no_button(self):
        self.assertIsNone(bake_run.kind_of(of_file()))
        self.assertIsNone(bake_run.kind_of(sequence.bake(MANIFEST)))
        self.assertIsNone(bake_run.kind_of(None))

    def test_undo_brings_the_live_run_back(self):
        item = self.make("panel")
        bpy.context.scene.frame_set(2)
        live = state(item, ("1", "2", "3"))
        bpy.ops.ed.undo_push(message="live")
        self.assertEqual(bpy.ops.object.meniscus_bake(), {"FINISHED"})
        bpy.ops.ed.undo_push(message="baked")
        bpy.ops.ed.undo()
        item = bpy.data.objects["run"]
        self.assertIs(bake_run.kind_of(item), bake_run.Panel)
        found = state(item, ("1", "2", "3"))
        for key, values in live.items():
            np.testing.assert_array_equal(found[key], values, err_msg=key)

    def test_the_size_is_said_before(self):
        """The announced size is the file's own within a fifth."""
        path = os.path.join(FOLDER, self.id() + ".blend")
        for way in ("stream", "panel"):
            item = self.make(way)
            sizes = []
            said = bake_run.size_lines(item, bpy.context.scene)
            self.assertRegex(", ".join(said), r"^3 frames, [0-9.]+ MB, [0-9.]+ MB compressed$")
            expected = 3 * bake_run.frame_bytes(item.data)
            for steps in (0, 1):
                if steps:
                    bpy.ops.object.meniscus_bake()
                bpy.ops.wm.save_as_mainfile(filepath=path, compress=False)
                sizes.append(os.path.getsize(path))
            bpy.ops.wm.save_as_mainfile(filepath=path, compress=True)
            before = sizes[0] - expected / 3  # size of the file without the mesh that shows
            self.assertAlmostEqual((sizes[1] - before) / expected, 1.0, delta=0.2, msg=way)
            self.assertAlmostEqual(os.path.getsize(path) / expected / bake_run.COMPRESSED, 1.0, delta=0.4, msg=way)


if not unittest.main(argv=["inside_baked"], exit=False).result.wasSuccessful():
    sys.exit(1)
