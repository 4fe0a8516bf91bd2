# SPDX-License-Identifier: BSD-3-Clause
"""Sequences in Blender: every time shows its frame in place, missing frames are never shown, the user's data stays."""

import os
import shutil
import sys
import threading
import unittest
import unittest.mock

import addon_utils
import bpy
import numpy as np

FOLDER, HERE = sys.argv[sys.argv.index("--") + 1:][:3:2]
sys.path.insert(0, HERE)
import samples  # noqa: E402

from meniscus_import import build, compat, frame_picker, joined, mesh_arrays, mns_reader, sequence, sequence_reader  # noqa: E402

RUN = os.path.join(FOLDER, "run")
MANIFEST = os.path.join(RUN, "surface_sequence.json")


def shown(item):
    """Positions of the mesh an object shows at the scene's time, instances of Geometry Nodes included."""
    graph = bpy.context.evaluated_depsgraph_get()
    meshes = [each.object.data for each in graph.object_instances if each.is_instance and each.parent
              and each.parent.original == item] or [item.evaluated_get(graph).data]
    assert len(meshes) == 1
    co = np.empty(3 * len(meshes[0].vertices), dtype=np.float32)
    meshes[0].vertices.foreach_get("co", co)
    return co.reshape(-1, 3)


def triangles_shown(item):
    """Returns how many triangles the object's own mesh has at three times."""
    counts = []
    for time in (1, 2, 3):
        bpy.context.scene.frame_set(time)
        counts.append(len(item.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.polygons))
    return counts


def expected(scene_frame, scale=0.1, center=True):
    manifest = sequence_reader.read(MANIFEST)
    surface = manifest.read(scene_frame).objects[0]
    origin = np.array(surface.header["mesh"]["origin"]) - (manifest.origin if center else 0.0)
    return (surface["mesh.position"] + origin) * scale


class Sequence(unittest.TestCase):
    def setUp(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        addon_utils.enable("meniscus_import")
        self.folder = os.path.join(FOLDER, self.id())
        os.makedirs(self.folder)

    def test_velocity_is_in_units_a_second(self):
        item = sequence.stream(MANIFEST)
        mesh = item.data
        surface = sequence_reader.read(MANIFEST).read(1).objects[0]
        values = np.empty(3 * len(mesh.vertices), dtype=np.float32)
        mesh.attributes["velocity"].data.foreach_get("vector", values)
        np.testing.assert_allclose(values.reshape(-1, 3), surface["mesh.velocity"] * 0.1 * 25.0, atol=1e-5)
        self.assertGreater(np.abs(values).max(), 0.1)
        self.assertEqual(bpy.context.scene.render.fps / bpy.context.scene.render.fps_base, 25.0)

    def test_every_time_shows_the_nearest_frame_and_none_outside(self):
        for mode in ("BAKE", "STREAM"):
            bpy.ops.wm.read_factory_settings(use_empty=True)
            addon_utils.enable("meniscus_import")
            self.assertEqual(bpy.ops.import_scene.meniscus_sequence(filepath=MANIFEST, mode=mode, center=True), {"FINISHED"})
            scene = bpy.context.scene
            self.assertEqual((scene.frame_start, scene.frame_end), (1, 3))
            item = next(each for each in bpy.data.objects if "meniscus_sequence" in each)
            for frame, part, place in ((1, 0.0, 1), (3, 0.0, 3), (2, 0.25, 2), (1, 0.75, 2), (2, 0.5, 3)):
                scene.frame_set(frame, subframe=part)
                np.testing.assert_allclose(shown(item), expected(place), atol=1e-5, err_msg=f"{mode} {frame} {part}")
            for frame in (0, 4):
                scene.frame_set(frame)
                graph = bpy.context.evaluated_depsgraph_get()
                instances = [each for each in graph.object_instances if each.is_instance]
                self.assertFalse(instances, mode)
                self.assertEqual(len(item.evaluated_get(graph).data.vertices), 0, mode)

    def test_timing_of_a_bake_is_that_of_a_stream(self):
        """Start, speed, times outside of the run and a frame by hand act alike, each at whole and broken times."""
        cases = ({"start": 4.0}, {"speed": 0.5, "outside": "HOLD"}, {"outside": "LOOP"}, {"outside": "PINGPONG", "speed": 0.5})
        for case in cases:
            timing = sequence_reader.Timing(**case)
            for mode in ("BAKE", "STREAM"):
                bpy.ops.wm.read_factory_settings(use_empty=True)
                addon_utils.enable("meniscus_import")
                bpy.ops.import_scene.meniscus_sequence(filepath=MANIFEST, mode=mode, center=True, **case)
                scene = bpy.context.scene
                self.assertEqual(scene.frame_start, timing.start)
                self.assertEqual(scene.frame_end, timing.scene_time(3))
                item = next(each for each in bpy.data.objects if "meniscus_sequence" in each)
                for frame, part in ((-2, 0.0), (0, 0.0), (1, 0.0), (2, 0.25), (3, 0.75), (4, 0.0), (5, 0.0), (6, 0.25), (9, 0.0)):
                    scene.frame_set(frame, subframe=part)
                    place = timing.place(frame + part, 3)
                    text = f"{mode} {case} {frame + part}"
                    if place is None:
                        graph = bpy.context.evaluated_depsgraph_get()
                        self.assertFalse([each for each in graph.object_instances if each.is_instance], text)
                        self.assertEqual(len(item.evaluated_get(graph).data.vertices), 0, text)
                    else:
                        np.testing.assert_allclose(shown(item), expected(place), atol=1e-5, err_msg=text)

    def test_a_bake_has_a_mesh_of_its_own(self):
        """Modifiers behind the bake and exporters see its mesh, with its exact normals."""
        item = sequence.bake(MANIFEST)
        counts = [sequence_reader.read(MANIFEST).read(place).objects[0].triangle_count for place in (1, 2, 3)]
        self.assertEqual(triangles_shown(item), counts)
        stored = sorted(bpy.data.collections["surface_sequence.frames"].objects, key=lambda each: each.name)
        for time in (2, 3, 1):
            bpy.context.scene.frame_set(time)
            mesh = item.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
            np.testing.assert_array_equal(samples.corner_normals(mesh), samples.corner_normals(stored[time - 1].data))
            self.assertIn("velocity", mesh.attributes)
        fewer = item.modifiers.new("Fewer", "DECIMATE")
        fewer.ratio = 0.1
        for count, found in zip(counts, triangles_shown(item)):
            self.assertAlmostEqual(found / count, 0.1, delta=0.02)

    def test_a_bake_of_many_frames_shows_each(self):
        """The bake has more frames than fit into one node group."""
        count = 2 * frame_picker.MOST_OF_A_GROUP + 7
        frames = frame_picker.Frames("many")
        for number in range(count):
            mesh = bpy.data.meshes.new("many")
            mesh.from_pydata([(0, 0, 0), (1, 0, number), (0, 1, 0)], [], [(0, 1, 2)])
            frames.add(mesh)
        item = bpy.data.objects.new("many", bpy.data.meshes.new("shown"))
        frames.show_in(item, sequence_reader.Timing())
        bpy.context.scene.collection.objects.link(item)
        for time in range(0, count + 2):
            bpy.context.scene.frame_set(time)
            mesh = item.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
            self.assertEqual([vertex.co.z for vertex in mesh.vertices][1:2], [time - 1] if 1 <= time <= count else [], time)

    def test_the_frame_can_be_keyed(self):
        for mode in ("BAKE", "STREAM"):
            bpy.ops.wm.read_factory_settings(use_empty=True)
            addon_utils.enable("meniscus_import")
            bpy.ops.import_scene.meniscus_sequence(filepath=MANIFEST, mode=mode, center=True)
            scene = bpy.context.scene
            item = next(each for each in bpy.data.objects if "meniscus_sequence" in each)
            if mode == "BAKE":
                modifier = item.modifiers["Frame"]
                compat.set_input(modifier, frame_picker.BY_HAND, True)
                path = compat.input_path(modifier, frame_picker.FRAME)
            else:
                item["meniscus_by_hand"], path = True, '["meniscus_frame"]'
            for time, place in ((10, 3.0), (20, 1.0)):
                if mode == "BAKE":
                    compat.set_input(modifier, frame_picker.FRAME, place)
                else:
                    item["meniscus_frame"] = place
                item.keyframe_insert(path, frame=time)
            for curve in compat.action_curves(item):
                for key in curve.keyframe_points:
                    key.interpolation = "LINEAR"
            for time, place in ((10, 3), (14, 2), (16, 2), (20, 1), (40, 1)):
                scene.frame_set(time)
                np.testing.assert_allclose(shown(item), expected(place), atol=1e-5, err_msg=f"{mode} {time}")

    def test_velocity_follows_speed_and_frame_rate(self):
        scene = bpy.context.scene
        scene.render.fps, scene.render.fps_base = 50, 1.0
        timing = sequence_reader.Timing(speed=0.25)
        item = sequence.stream(MANIFEST, timing=timing, set_time=False)
        values = np.empty(3 * len(item.data.vertices), dtype=np.float32)
        item.data.attributes["velocity"].data.foreach_get("vector", values)
        wanted = sequence_reader.read(MANIFEST).read(1).objects[0]["mesh.velocity"] * (0.1 * 0.25 * 50.0)
        np.testing.assert_allclose(values.reshape(-1, 3), wanted, atol=1e-5)

    def test_a_dressed_scene_stays_as_it_is(self):
        scene = bpy.context.scene
        own = bpy.data.objects.new("own", bpy.data.cameras.new("own"))
        scene.collection.objects.link(own)

        def state():
            render = scene.render
            return (scene.camera, scene.frame_start, scene.frame_end, render.fps, render.fps_base, render.resolution_x,
                    render.resolution_y, scene.view_settings.view_transform)

        scene.camera, scene.frame_end, scene.render.fps = own, 77, 30
        before = state()
        for mode in ("BAKE", "STREAM"):
            bpy.ops.import_scene.meniscus_sequence(filepath=MANIFEST, mode=mode, use_camera=False, set_time=False)
            self.assertEqual(state(), before)
        bpy.ops.import_scene.meniscus_sequence(filepath=MANIFEST, mode="STREAM")
        self.assertEqual((scene.frame_start, scene.frame_end, scene.render.fps, scene.render.resolution_x), (1, 3, 25, 120))
        self.assertNotEqual(scene.camera, own)

    def test_a_still_surface_overlays_its_trajectory(self):
        still = os.path.join(RUN, "surface_00001.mns")
        for center in (False, True):
            for sequence_first in (False, True):
                bpy.ops.wm.read_factory_settings(use_empty=True)
                addon_utils.enable("meniscus_import")
                for step in (sequence_first, not sequence_first):
                    if step:
                        bpy.ops.import_scene.meniscus_sequence(filepath=MANIFEST, mode="STREAM", center=center, scale=0.1)
                    else:
                        bpy.ops.import_scene.meniscus(filepath=still, center=center)
                bpy.context.scene.frame_set(1)
                run, alone = (next(each for each in bpy.data.objects if key in each) for key in ("meniscus_sequence", "meniscus_file"))
                world = [np.array([item.matrix_world @ vertex.co for vertex in item.data.vertices]) for item in (run, alone)]
                np.testing.assert_allclose(*world, atol=1e-4)

    def test_attributes_of_the_user_go_with_their_atoms(self):
        item = sequence.stream(MANIFEST)
        mesh, scene = item.data, bpy.context.scene

        def atoms():
            values = np.empty(len(mesh.polygons), dtype=np.int32)
            mesh.attributes["atom_index"].data.foreach_get("value", values)
            return values

        first = atoms()
        for name, kind, domain in (("on_faces", "INT", "FACE"), ("on_corners", "FLOAT", "CORNER"), ("colour", "FLOAT_COLOR", "FACE"),
                                   ("marked", "BOOLEAN", "FACE"), ("on_points", "FLOAT_VECTOR", "POINT")):
            mesh.attributes.new(name, kind, domain)
        mesh.attributes["on_faces"].data.foreach_set("value", first + 7)
        mesh.attributes["on_corners"].data.foreach_set("value", np.repeat(first, 3).astype(np.float32))
        mesh.attributes["colour"].data.foreach_set("color", np.repeat(first, 4).astype(np.float32))
        mesh.attributes["marked"].data.foreach_set("value", first % 2 == 1)
        known = set(first)
        for frame in (2, 3, 5, 1, 3):  # Frame 5 lies outside of the run, where nothing is shown.
            scene.frame_set(frame)
        now = atoms()
        wanted = np.where(np.isin(now, list(known)), now + 7, 0)
        found = np.empty(len(now), dtype=np.int32)
        mesh.attributes["on_faces"].data.foreach_get("value", found)
        np.testing.assert_array_equal(found, wanted)
        self.assertGreater((found > 0).mean(), 0.9)
        corners = np.empty(3 * len(now), dtype=np.float32)
        mesh.attributes["on_corners"].data.foreach_get("value", corners)
        np.testing.assert_array_equal(corners, np.repeat(np.where(wanted > 0, now, 0), 3))
        colors = np.empty(4 * len(now), dtype=np.float32)
        mesh.attributes["colour"].data.foreach_get("color", colors)
        np.testing.assert_array_equal(colors, np.repeat(np.where(wanted > 0, now, 0), 4))
        marked = np.empty(len(now), dtype=bool)
        mesh.attributes["marked"].data.foreach_get("value", marked)
        np.testing.assert_array_equal(marked, (now % 2 == 1) & (wanted > 0))
        self.assertEqual(len(mesh.attributes["on_points"].data), len(mesh.vertices))

    def test_scrubbing_while_the_mesh_is_edited_changes_and_says_nothing(self):
        item = sequence.stream(MANIFEST)
        scene = bpy.context.scene
        bpy.context.view_layer.objects.active = item
        count = len(item.data.vertices)
        bpy.ops.object.mode_set(mode="EDIT")
        scene.frame_set(3)
        self.assertEqual(item["meniscus_error"] if "meniscus_error" in item else "", "")
        bpy.ops.object.mode_set(mode="OBJECT")
        self.assertEqual(len(item.data.vertices), count)
        scene.frame_set(2)
        np.testing.assert_allclose(shown(item), expected(2), atol=1e-5)

    def test_the_next_frame_is_read_ahead_and_no_stale_one_is_shown(self):
        folder = shutil.copytree(RUN, os.path.join(self.folder, "copy"))
        sequence.stream(os.path.join(folder, "surface_sequence.json"))
        scene = bpy.context.scene
        scene.frame_set(2)
        waiting = list(sequence._ahead.waiting.values())
        self.assertEqual(len(waiting), 1)
        sequence._ahead.process.wait(waiting[0])
        self.assertIsNone(waiting[0].error)
        bad = os.path.join(folder, "surface_00005.mns")
        with open(bad, "r+b") as file:  # The file is cut after it has been read ahead.
            file.truncate(os.path.getsize(bad) - 64)
        scene.frame_set(3)
        item = next(each for each in bpy.data.objects if each.get("meniscus_stream"))
        self.assertIn("incomplete", item["meniscus_error"])
        self.assertEqual(len(shown(item)), 0)

    def test_one_origin_for_all_frames_or_that_of_the_trajectory(self):
        item = sequence.stream(MANIFEST, center=False, scale=0.5)
        for frame in (1, 2):
            bpy.context.scene.frame_set(frame)
            np.testing.assert_allclose(shown(item), expected(frame, 0.5, False), atol=2e-4)

    def test_a_streamed_file_streams_when_it_is_opened_again(self):
        sequence.stream(MANIFEST)
        blend = os.path.join(self.folder, "streamed.blend")
        bpy.ops.wm.save_as_mainfile(filepath=blend)
        bpy.ops.wm.open_mainfile(filepath=blend)
        item = next(each for each in bpy.data.objects if each.get("meniscus_stream"))
        np.testing.assert_allclose(shown(item), expected(1), atol=1e-5)
        bpy.context.scene.frame_set(3)
        np.testing.assert_allclose(shown(item), expected(3), atol=1e-5)

    def test_a_camera_that_moves_stands_where_the_manifest_says(self):
        turning = os.path.join(FOLDER, "turning", "surface_sequence.json")
        for mode in (sequence.bake, sequence.stream):
            bpy.ops.wm.read_factory_settings(use_empty=True)
            mode(turning, scale=0.5)
            manifest = sequence_reader.read(turning)
            for place, frame in enumerate(manifest.frames, 1):
                bpy.context.scene.frame_set(place)
                matrix = np.array(bpy.context.scene.camera.matrix_world)
                position, target = (np.array(frame.camera[key]) for key in ("position", "target"))
                np.testing.assert_allclose(matrix[:3, 3], (position - manifest.origin) * 0.5, atol=1e-4)
                forward = (target - position) / np.linalg.norm(target - position)
                np.testing.assert_allclose(-matrix[:3, 2], forward, atol=1e-5)
            # The camera takes the short way between frames.
            ends = [np.array(frame.camera["position"]) - manifest.origin for frame in manifest.frames[:2]]
            bpy.context.scene.frame_set(1, subframe=0.5)
            between = np.array(bpy.context.scene.camera.matrix_world)[:3, 3] / 0.5
            self.assertLess(max(np.linalg.norm(between - end) for end in ends), np.linalg.norm(ends[0] - ends[1]))

    def test_the_handler_reads_a_frame_once_and_keeps_memory_flat(self):
        item = sequence.stream(MANIFEST)
        scene, reads = bpy.context.scene, []
        self.assertTrue(scene.render.use_lock_interface)
        original, submit = sequence_reader.Sequence.read, sequence._ahead.process.submit

        def counted(self, scene_frame):
            reads.append(scene_frame)
            return original(self, scene_frame)

        def counted_submit(owner, key, kind, about):
            reads.append((kind, about["scene_frame"]))
            return submit(owner, key, kind, about)

        with unittest.mock.patch.object(sequence_reader.Sequence, "read", counted), \
                unittest.mock.patch.object(sequence._ahead.process, "submit", counted_submit):
            for frame, part in ((2, 0.0), (1, 0.75), (2, 0.25), (2, 0.0), (3, 0.0)):
                scene.frame_set(frame, subframe=part)
        self.assertEqual(reads, [2, ("frame", 3)])
        self.assertEqual(threading.enumerate(), [threading.main_thread()])
        self.assertEqual(len([mesh for mesh in bpy.data.meshes if mesh.users]), 1)
        self.assertEqual(len(item.data.materials), 2)

    def test_a_frame_that_cannot_be_shown_is_an_error_and_not_the_last_one(self):
        folder = shutil.copytree(RUN, os.path.join(self.folder, "copy"))
        manifest = os.path.join(folder, "surface_sequence.json")
        bad = os.path.join(folder, "surface_00003.mns")
        with open(bad, "rb") as file:
            data = bytearray(file.read())
        flipped = bytearray(data)
        flipped[len(data) // 2] ^= 1
        foreign, _ = samples.header_of(data)
        foreign["sequence"]["run"] = "00000000"
        cases = {"missing": None, "checksum": bytes(flipped), "incomplete": bytes(data[:-64]),
                 "not frame 3": samples.with_header(bytes(data), foreign)}
        for word, content in cases.items():
            if os.path.exists(bad):
                os.remove(bad)
            if content is not None:
                with open(bad, "wb") as file:
                    file.write(content)
            bpy.ops.wm.read_factory_settings(use_empty=True)
            addon_utils.enable("meniscus_import")
            item = sequence.stream(manifest)
            bpy.context.scene.frame_set(2)
            self.assertEqual(len(shown(item)), 0, word)
            self.assertIn(word, item["meniscus_error"])
            bpy.context.scene.frame_set(3)
            self.assertEqual(item["meniscus_error"], "")
            self.assertGreater(len(shown(item)), 0)
            before = sorted(each.name for each in bpy.data.objects)
            with self.assertRaises(RuntimeError) as caught:
                bpy.ops.import_scene.meniscus_sequence(filepath=manifest, mode="BAKE")
            self.assertIn(word, str(caught.exception))
            self.assertEqual(sorted(each.name for each in bpy.data.objects), before)
        before = len(shown(item))
        os.remove(manifest)  # The whole run is gone, and the last mesh stays.
        bpy.context.scene.frame_set(1)
        self.assertEqual(len(shown(item)), before)
        self.assertIn("surface_sequence.json: no such file", item["meniscus_error"])

    def test_places_of_names_are_the_same_in_all_frames(self):
        """Each file numbers its own names; here the second file has other residues than the first."""
        folder = shutil.copytree(RUN, os.path.join(self.folder, "copy"))
        path = os.path.join(folder, "surface_00003.mns")
        with open(path, "rb") as file:
            data = file.read()
        header, _ = samples.header_of(data)
        names = header["objects"][0]["residue_names"]
        header["objects"][0]["residue_names"] = ["AAA" if name == names[0] else name for name in names]
        with open(path, "wb") as file:
            file.write(samples.with_header(data, header))

        def residues(mesh, item):
            values = np.empty(len(mesh.vertices), dtype=np.int32)
            mesh.attributes["res_name_id"].data.foreach_get("value", values)
            return {item["res_names"][value] for value in values}

        for mode in ("stream", "bake"):
            bpy.ops.wm.read_factory_settings(use_empty=True)
            addon_utils.enable("meniscus_import")
            item = getattr(sequence, mode)(os.path.join(folder, "surface_sequence.json"))
            stored = sorted(bpy.data.meshes, key=lambda mesh: mesh.name)
            for time in (1, 2, 3, 2):
                bpy.context.scene.frame_set(time)
                mesh = item.data if mode == "stream" else next(each for each in stored if each.name.endswith(f".{time:07d}"))
                self.assertEqual(residues(mesh, item), set(header["objects"][0]["residue_names"] if time == 2 else names), (mode, time))
            self.assertEqual(sorted(item["res_names"]), sorted({*names, "AAA"}))

    def test_objects_and_copies_are_joined(self):
        with open(os.path.join(FOLDER, "triple.mns"), "rb") as file:
            data = file.read()
        path = os.path.join(self.folder, "two.mns")
        with open(path, "wb") as file:
            file.write(samples.as_two_objects(data))
        file = mns_reader.read(path)
        surface = joined.joined(file, np.array([1.0, 2.0, 3.0]))
        alone = file.objects[0]
        count, rows = alone.triangle_count, len(alone["mesh.position"])
        self.assertEqual(surface.triangle_count, 3 * count)
        np.testing.assert_array_equal(surface["mesh.object"], np.repeat([0, 0, 1], count))
        self.assertEqual(len(surface.header["components"]), 3)
        np.testing.assert_array_equal(surface["mesh.component"], np.repeat([0, 1, 2], count))
        base = alone["mesh.position"] + np.array(alone.header["mesh"]["origin"])
        turned = np.stack([-base[:, 1] + 10.0, base[:, 0] + 20.0, base[:, 2] + 30.0], axis=1)
        np.testing.assert_allclose(surface["mesh.position"][rows:2 * rows], turned - [1, 2, 3], atol=1e-5)
        np.testing.assert_allclose(surface["mesh.normal"][rows:2 * rows, 0], -alone["mesh.normal"][:, 1], atol=1e-6)
        mesh = build.build_mesh(surface, "joined", build.Options(scale=1.0), [], 24.0, mesh_arrays.names_of(surface))
        self.assertEqual(len(mesh.polygons), 3 * count)
        corners = samples.corner_normals(mesh)
        np.testing.assert_allclose(corners[3 * count:6 * count, 0], -corners[:3 * count, 1], atol=2e-3)


if not unittest.main(argv=["inside_sequence"], exit=False).result.wasSuccessful():
    sys.exit(1)
