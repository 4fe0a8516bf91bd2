# SPDX-License-Identifier: BSD-3-Clause
"""One object, one request: duplicates that share a mesh, and what is done to an object while its surface is computed."""

import sys
import unittest

import bpy

sys.path.insert(0, sys.argv[sys.argv.index("--") + 3])
from computed_case import CAGE, ComputedCase, measures, of_file, update  # noqa: E402
import samples  # noqa: E402

from meniscus_import import compat, computed  # noqa: E402


def duplicate(item, is_linked=True):
    for other in bpy.context.view_layer.objects:
        other.select_set(other == item)
    bpy.context.view_layer.objects.active = item
    assert bpy.ops.object.duplicate(linked=is_linked) == {"FINISHED"}
    return bpy.context.view_layer.objects.active


def faces(item):
    return len(item.data.polygons)


class Duplicates(ComputedCase):
    def test_another_request_gets_another_mesh(self):
        item = of_file()
        twin = duplicate(item)
        self.assertEqual(item.data, twin.data)
        before = faces(item), measures(item)
        twin.meniscus.probe = 3.0
        update()
        self.assertEqual((faces(item), measures(item)), before)
        self.assertNotEqual(item.data, twin.data)
        alone = of_file()
        alone.meniscus.probe = 3.0
        update()
        self.assertEqual((faces(twin), measures(twin)), (faces(alone), measures(alone)))
        self.assertEqual(twin.data.materials[0], item.data.materials[0])

    def test_the_same_request_shares_a_mesh_and_its_measures(self):
        item = of_file()
        twin = duplicate(item)
        item.meniscus.probe = twin.meniscus.probe = 2.0
        computed.update_in_background(item)
        computed.wait()
        self.assertEqual(item.data, twin.data)
        self.assertEqual(measures(item), measures(twin))
        self.assertEqual(twin["meniscus_probe_radius"], 2.0)

    def test_a_plain_object_that_shares_the_mesh_shows_what_it_shows(self):
        item = of_file()
        other = bpy.data.objects.new("plain", item.data)
        item.meniscus.probe = 2.0
        update()
        self.assertEqual(other.data, item.data)

    def test_copies_of_a_run_at_other_times(self):
        scene = bpy.context.scene
        item = of_file(samples.UBIQUITIN, "PROXY", selection="resi 1-5", is_run=True)
        alone = []
        for frame in (1, 2, 3, 4, 5, 6):
            scene.frame_set(frame)
            alone.append((faces(item), measures(item)))
        self.assertEqual(len(set(alone)), 6)
        scene.frame_set(1)
        twin = duplicate(item)
        twin.meniscus.start = -1.0
        for frame in (2, 4, 1, 3):
            scene.frame_set(frame)
            self.assertEqual((faces(item), measures(item)), alone[frame - 1], frame)
            self.assertEqual((faces(twin), measures(twin)), alone[frame + 1], frame)


class WhileComputing(ComputedCase):
    """Two objects of two molecules; the first asks for another probe, and something is done to it before that is there."""

    def setUp(self):
        super().setUp()
        self.item, self.other = of_file(), of_file(CAGE)
        self.before = faces(self.item), measures(self.item)
        self.others = faces(self.other), measures(self.other)
        alone = of_file()
        alone.meniscus.probe = 2.0
        update()
        self.wanted = faces(alone), measures(alone)
        bpy.data.objects.remove(alone)
        computed._kept.clear()  # The next update must compute it again.
        bpy.ops.ed.undo_push(message="before")

    def start(self):
        self.item.meniscus.probe = 2.0
        computed.update_in_background(self.item)
        self.assertIsNotNone(computed.progress_of(self.item))

    def check(self, item, wanted=None):
        computed.wait()
        self.assertEqual((faces(item), measures(item)), wanted or self.wanted)
        self.assertFalse(item["meniscus_error"])

    def test_rename(self):
        self.start()
        first, second = self.item.name, self.other.name
        self.item.name = "mine"
        self.check(self.item)
        self.item.meniscus.probe = 1.4
        computed.update_in_background(self.item)
        self.item.name, self.other.name = "old", first
        self.check(self.item, self.before)
        self.check(self.other, self.others)

    def test_delete(self):
        self.start()
        bpy.data.objects.remove(self.item)
        self.check(self.other, self.others)
        self.assertEqual(computed.working().is_busy(), False)

    def test_join(self):
        """An earlier request's result does not replace the joined mesh; a new request does."""
        self.start()
        bpy.context.view_layer.objects.active = self.item
        for item in (self.item, self.other):
            item.select_set(True)
        bpy.ops.object.join()
        count = faces(self.item)
        self.assertEqual(count, self.before[0] + self.others[0])
        computed.wait()
        self.assertEqual(faces(self.item), count)
        self.assertIn("was changed", self.item["meniscus_error"])
        update()
        self.check(self.item)

    def test_undo_and_redo(self):
        self.start()
        name = self.item.name
        bpy.ops.ed.undo_push(message="probe 2")
        bpy.ops.ed.undo()
        self.assertAlmostEqual(bpy.data.objects[name].meniscus.probe, 1.4, places=6)
        self.check(bpy.data.objects[name], self.before)
        bpy.ops.ed.redo()
        self.assertAlmostEqual(bpy.data.objects[name].meniscus.probe, 2.0, places=6)
        self.check(bpy.data.objects[name])

    def test_undo_of_something_else(self):
        self.start()
        name = self.item.name
        bpy.ops.ed.undo_push(message="probe 2")
        self.other.location.x = 3.0
        bpy.ops.ed.undo_push(message="moved")
        bpy.ops.ed.undo()
        self.check(bpy.data.objects[name])

    def test_copies_to_another_scene(self):
        """One scene links the object, and another gets a copy with its data."""
        self.start()
        bpy.data.scenes.new("linked").collection.objects.link(self.item)
        copy = self.item.copy()
        copy.data = self.item.data.copy()
        bpy.data.scenes.new("copied").collection.objects.link(copy)
        self.check(self.item)
        self.check(copy)
        self.assertNotEqual(copy.data, self.item.data)

    def test_a_duplicate_with_a_mesh_of_its_own(self):
        self.start()
        twin = duplicate(self.item, False)
        twin.meniscus.probe = 1.4
        self.check(self.item)
        self.check(twin, self.before)

    def test_identities_are_those_of_objects(self):
        self.assertEqual(compat.of_identity(compat.identity(self.item)), self.item)
        self.assertIsNone(compat.of_identity(-1))
        self.assertNotEqual(compat.identity(self.item), compat.identity(self.other))


if not unittest.main(argv=["inside_requests"], exit=False).result.wasSuccessful():
    sys.exit(1)
