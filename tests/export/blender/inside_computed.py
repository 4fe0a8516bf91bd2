# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces that Blender computes itself: of files and of atoms in objects, stored, undone, on the timeline, in the background."""

import os
import subprocess
import sys
import threading
import unittest
import unittest.mock

import addon_utils
import bpy
import numpy as np

sys.path.insert(0, sys.argv[sys.argv.index("--") + 3])
import samples  # noqa: E402
from computed_case import (ADDON, BLENDER, CAGE, FOLDER, PACKAGE, PROGRAM, TRIPLE, UBIQUITIN, ComputedCase, measures, of_file, positions,  # noqa: E402
                           start_anew, update, wanted)
from meniscus_import import attributes, build, compat, computed, mns_reader, molecular_nodes  # noqa: E402


def signed_volume(item):
    corner = np.empty(len(item.data.loops), dtype=np.int32)
    item.data.loops.foreach_get("vertex_index", corner)
    return samples.signed_volume(positions(item.data) / item.meniscus.scale, corner.reshape(-1, 3))


def atoms_object(name="atoms", scale=0.01, molecule="triple"):
    """Makes atoms like those of Molecular Nodes: a vertex per atom, attributes, units of its own."""
    rows = np.array(samples.MOLECULES[molecule], dtype=np.float32)
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(rows))
    mesh.vertices.foreach_set("co", (rows[:, :3] * scale).ravel())
    numbers = np.arange(len(rows))
    for key, kind, values in (("vdw_radii", "FLOAT", rows[:, 3] * scale), ("atomic_number", "INT", numbers + 6), ("b_factor", "FLOAT", numbers * 10.0),
                              ("res_id", "INT", numbers + 100), ("chain_id", "INT", numbers % 2), ("is_even", "BOOLEAN", numbers % 2 == 0),
                              ("lipophobicity", "FLOAT", numbers * 0.5)):
        attributes.add(mesh, key, kind, "POINT", values.astype({"FLOAT": np.float32, "INT": np.int32, "BOOLEAN": bool}[kind]))
    item = bpy.data.objects.new(name, mesh)
    item["chain_ids"] = ["A", "B"]
    bpy.context.scene.collection.objects.link(item)
    bpy.context.view_layer.objects.active = item
    return item


class Computed(ComputedCase):
    def test_a_file_gives_the_surface_that_the_program_computes(self):
        item = of_file()
        self.assertEqual(measures(item), wanted(TRIPLE)[0])
        self.assertAlmostEqual(signed_volume(item) / item["meniscus_volume"], 1.0, delta=0.1)
        for change, words in (({"probe": 2.0}, ["--probe", "2"]), ({"kind": "SAS"}, ["--probe", "2", "--surface", "sas"]),
                              ({"kind": "VDW"}, ["--surface", "vdw"])):
            for name, value in change.items():
                setattr(item.meniscus, name, value)
            self.assertEqual(update(), {"FINISHED"})
            self.assertEqual(measures(item), wanted(TRIPLE, *words)[0])

    def test_the_tolerance_tells_how_fine_it_is(self):
        item = of_file(CAGE)
        counts = []
        for tolerance in (0.05, 0.005):
            item.meniscus.tolerance = tolerance
            update()
            counts.append(len(item.data.polygons))
            self.assertEqual(len(item.data.edges) * 2, 3 * len(item.data.polygons))
            self.assertEqual({0, 1}, {polygon.material_index for polygon in item.data.polygons})
        self.assertLess(counts[0], counts[1])
        self.assertAlmostEqual(signed_volume(item) / item["meniscus_volume"], 1.0, delta=0.01)

    def test_by_the_program_where_there_is_no_library(self):
        bpy.context.preferences.addons[computed.__package__].preferences.package = FOLDER
        item = of_file()
        self.assertEqual(measures(item), wanted(TRIPLE)[0])
        bpy.context.view_layer.objects.active = atoms_object()
        with self.assertRaisesRegex(RuntimeError, "libmeniscus"):
            bpy.ops.object.meniscus_from_atoms(wait=True)

    def test_what_is_wrong_is_said_and_the_surface_stays(self):
        item = of_file()
        before = positions(item.data)
        for word, change in (("chain Q", {"selection": "chain Q"}), ("Selection", {"selection": "chain ("}),
                             ("no_such_file", {"file": os.path.join(FOLDER, "no_such_file.pdb"), "selection": ""})):
            for name, value in change.items():
                setattr(item.meniscus, name, value)
            with self.assertRaises(RuntimeError) as caught:
                update()
            self.assertIn(word, str(caught.exception))
            self.assertIn(word, item["meniscus_error"])
            np.testing.assert_array_equal(positions(item.data), before)
        item.meniscus.file, item.meniscus.selection = TRIPLE, ""
        update()
        self.assertEqual(item["meniscus_error"], "")

    def test_a_file_on_another_drive_is_named_whole(self):
        """On Windows no relative path leads from one drive to another."""
        bpy.ops.wm.save_as_mainfile(filepath=os.path.join(FOLDER, "drive.blend"))
        self.assertTrue(build.remembered_path(TRIPLE).startswith("//"))
        with unittest.mock.patch.object(os.path, "relpath", side_effect=ValueError("path is on mount 'D:'")):
            self.assertEqual(build.remembered_path(TRIPLE), TRIPLE)

    def test_the_request_is_stored_and_computed_again(self):
        item = of_file(CAGE)
        item.meniscus.probe, item.meniscus.tolerance = 1.1, 0.05
        update()
        area, shape, name = item["meniscus_area"], positions(item.data), item.name
        path = os.path.join(FOLDER, "stored.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.ops.wm.open_mainfile(filepath=path)
        addon_utils.enable("meniscus_import", default_set=True)
        item = bpy.data.objects[name]
        np.testing.assert_array_equal(positions(item.data), shape)
        settings = item.meniscus
        self.assertEqual((settings.source, round(settings.tolerance, 6), round(settings.probe, 6)), ("FILE", 0.05, 1.1))
        item.data.clear_geometry()
        preferences = bpy.context.preferences.addons[computed.__package__].preferences
        preferences.package, preferences.program = PACKAGE, PROGRAM
        bpy.context.view_layer.objects.active = item
        self.assertEqual(update(), {"FINISHED"})
        np.testing.assert_array_equal(positions(item.data), shape)
        self.assertEqual(item["meniscus_area"], area)

    def test_undo_brings_back_the_surface_of_before(self):
        item = of_file()
        bpy.ops.ed.undo_push(message="before")
        first = measures(item)
        item.meniscus.probe = 2.5
        bpy.ops.ed.undo_push(message="after")  # The surface comes after this step, as it does when a slider is let go.
        name = item.name
        computed.compute_now(item)
        self.assertNotEqual(measures(item), first)
        bpy.ops.ed.undo()
        computed.catch_up()
        computed.wait()
        item = bpy.data.objects[name]
        self.assertAlmostEqual(item.meniscus.probe, 1.4, places=6)
        self.assertEqual(measures(item), first)
        self.assertAlmostEqual(signed_volume(item) / first[1], 1.0, delta=0.1)
        bpy.ops.ed.redo()
        computed.catch_up()
        computed.wait()
        item = bpy.data.objects[name]
        self.assertEqual(measures(item), wanted(TRIPLE, "--probe", "2.5")[0])
        self.assertAlmostEqual(signed_volume(item) / item["meniscus_volume"], 1.0, delta=0.1)

    def test_proxies(self):
        item = of_file(UBIQUITIN, selection="resi 1-20", detail="PROXY")
        area, volume = measures(item)
        self.assertAlmostEqual(sum(polygon.area for polygon in item.data.polygons) / item.meniscus.scale**2 / area, 1.0, delta=0.06)
        self.assertAlmostEqual(signed_volume(item) / volume, 1.0, delta=0.03)  # The mesh shows single atoms.
        counts = []
        for density in (0.5, 1.0):
            item.meniscus.density = density
            self.assertEqual(update(), {"FINISHED"})
            counts.append(len(item.data.vertices))
            self.assertAlmostEqual(counts[-1] / (density * item["meniscus_area"]), 1.0, delta=0.25)
            self.assertEqual(len(item.data.edges) * 2, 3 * len(item.data.polygons))
            self.assertAlmostEqual(signed_volume(item) / item["meniscus_volume"], 1.0, delta=0.1)
        self.assertLess(1.5 * counts[0], counts[1])

    def test_colours_scale_and_crispness_follow(self):
        item = of_file()
        before = positions(item.data)
        colors = attributes.read(item.data, "Color", "FLOAT_COLOR")
        item.meniscus.color = "chain"
        update()
        np.testing.assert_array_equal(positions(item.data), before)
        self.assertGreater(np.abs(attributes.read(item.data, "Color", "FLOAT_COLOR") - colors).max(), 0.05)
        item.meniscus.crisp, item.meniscus.scale = True, 0.2
        update()
        np.testing.assert_allclose(positions(item.data), 2.0 * before, rtol=1e-6)
        self.assertEqual(item.data.attributes["Color"].domain, "CORNER")

    def test_cavities_by_themselves_or_not_at_all(self):
        item = of_file(CAGE)
        whole = len(item.data.polygons)
        parts = {}
        for cavities in ("DROP", "ONLY"):
            item.meniscus.cavities = cavities
            update()
            parts[cavities] = len(item.data.polygons), item["meniscus_area"], {polygon.material_index for polygon in item.data.polygons}
        self.assertEqual(parts["DROP"][0] + parts["ONLY"][0], whole)
        self.assertEqual((parts["DROP"][2], parts["ONLY"][2]), ({0}, {1}))
        self.assertAlmostEqual(parts["DROP"][1] + parts["ONLY"][1], wanted(CAGE)[0][0], places=6)
        item.meniscus.file = TRIPLE  # TRIPLE has no cavities.
        self.assertEqual(update(), {"FINISHED"})
        self.assertEqual(len(item.data.polygons), 0)

    def test_no_thread_of_python_lives_beside_blender(self):
        item = of_file(samples.UBIQUITIN, selection="resi 1-15", is_run=True)
        bpy.context.scene.frame_set(2)
        item.meniscus.probe = 2.0
        computed.update_in_background(item)
        self.assertEqual(threading.enumerate(), [threading.main_thread()])
        computed.wait()
        self.assertEqual(item["meniscus_probe_radius"], 2.0)

    def test_blender_ends_well_after_a_script_that_imports_the_add_on(self):
        script = os.path.join(FOLDER, "imports.py")
        with open(script, "w", encoding="utf-8") as file:
            file.write(f"import sys\nsys.path.insert(0, {ADDON!r})\nimport meniscus_import\nfrom meniscus_import.computing import process\n")
        done = subprocess.run([BLENDER, "-b", "--factory-startup", "--python-exit-code", "3", "--python", script], stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL, check=False)
        self.assertEqual(done.returncode, 0)

    def test_in_the_background_the_newest_request_wins(self):
        item = of_file()
        for probe in (1.5, 1.6, 1.7, 1.8, 1.9, 2.0):
            item.meniscus.probe = probe
            computed.update_in_background(item)
        computed.wait()
        self.assertEqual(measures(item), wanted(TRIPLE, "--probe", "2")[0])
        item.meniscus.probe = 2.2
        computed.update_in_background(item)
        computed.cancel(item)
        computed.wait()
        self.assertEqual(measures(item), wanted(TRIPLE, "--probe", "2")[0])
        item.meniscus.probe = 2.4
        computed.update_in_background(item)
        bpy.data.objects.remove(item)  # No object is left to take the result.
        computed.wait()

    def test_materials_modifiers_and_attributes_of_the_user_stay(self):
        item = of_file()
        own = bpy.data.materials.new("own")
        item.data.materials[0] = own
        item.modifiers.new("smooth", "SMOOTH")
        item.data["heat"] = 0.5
        item.data.keyframe_insert('["heat"]', frame=3)
        attributes.add(item.data, "marks", "FLOAT", "FACE", attributes.read(item.data, "atom_index", "INT")[:, 0].astype(np.float32))
        item.meniscus.probe = 2.0
        update()
        self.assertEqual((item.data.materials[0], len(item.modifiers)), (own, 1))
        self.assertIsNotNone(item.data.animation_data.action)
        np.testing.assert_array_equal(attributes.read(item.data, "marks", "FLOAT"), attributes.read(item.data, "atom_index", "INT"))
        item.meniscus.cavities = "ONLY"  # The surface has no cavities.
        update()
        self.assertEqual(len(item.data.polygons), 0)
        item.meniscus.cavities = "KEEP"
        update()
        np.testing.assert_array_equal(attributes.read(item.data, "marks", "FLOAT"), attributes.read(item.data, "atom_index", "INT"))

    def test_frames_of_a_file_without_an_export(self):
        item = of_file(samples.UBIQUITIN, selection="resi 1-15", is_run=True)
        item.meniscus.frames = "1-5:2"
        item.meniscus.outside = "HOLD"
        update()
        self.assertEqual(computed.frame_count(item), 3)
        areas = [pair[0] for pair in wanted(samples.UBIQUITIN, "--select", "resi 1-15", "--frames", "1-5:2")]
        for frame, place in ((1, 1), (2, 2), (3, 3), (0, 1), (9, 3), (2, 2)):
            bpy.context.scene.frame_set(frame)
            self.assertAlmostEqual(item["meniscus_area"] / areas[place - 1], 1.0, places=6, msg=f"{frame}")
        item.meniscus.outside = "EMPTY"
        bpy.context.scene.frame_set(7)
        self.assertEqual(len(item.data.vertices), 0)
        item.meniscus.by_hand, item.meniscus.outside = True, "HOLD"
        for time, place in ((10, 3.0), (20, 1.0)):
            item.meniscus.frame = place
            item.keyframe_insert("meniscus.frame", frame=time)
        for curve in compat.action_curves(item):
            for key in curve.keyframe_points:
                key.interpolation = "LINEAR"
        for time, place in ((10, 3), (15, 2), (20, 1)):
            bpy.context.scene.frame_set(time)
            self.assertAlmostEqual(item["meniscus_area"] / areas[place - 1], 1.0, places=6, msg=f"{time}")

    def test_frames_ahead_are_computed_before_they_show(self):
        item = of_file(samples.UBIQUITIN, selection="resi 1-15", is_run=True)
        bpy.context.scene.frame_set(2)
        self.assertEqual(len(computed._ahead), computed.AHEAD)
        while computed.working().is_busy():
            computed._deliver(computed.working().take(1.0))
        self.assertEqual(computed._ahead, {})
        with unittest.mock.patch.object(computed.SurfaceRequest, "submit", side_effect=AssertionError("it was not ahead")):
            with unittest.mock.patch.object(computed, "compute_ahead"):
                for frame in range(3, 3 + computed.AHEAD):
                    bpy.context.scene.frame_set(frame)
                    self.assertEqual(item["meniscus_error"], "", frame)
        bpy.context.scene.frame_set(3)
        bpy.context.scene.frame_set(9)  # Frames that were requested before are not wanted any more.
        self.assertEqual({each.key for each in computed._ahead.values()}, set(computed._ahead))
        self.assertLessEqual(len(computed._ahead), computed.AHEAD)

    def test_atoms_of_an_object(self):
        for scale in (0.01, 0.1, 1.0):
            atoms = atoms_object(f"atoms{scale}", scale)
            self.assertEqual(bpy.ops.object.meniscus_from_atoms(wait=True, detail="FINE"), {"FINISHED"})
            item = bpy.context.view_layer.objects.active
            self.assertAlmostEqual(item.meniscus.scale, scale, places=6)
            self.assertEqual(item.parent, atoms)
            self.assertAlmostEqual(item["meniscus_area"] / wanted(TRIPLE)[0][0], 1.0, places=5)
            mesh = item.data
            for name in ("atomic_number", "b_factor", "res_id", "chain_id", "vdw_radii", "lipophobicity", "is_even"):
                self.assertEqual(mesh.attributes[name].domain, "POINT", name)
            np.testing.assert_allclose(np.unique(attributes.read(mesh, "vdw_radii", "FLOAT")), np.float32([1.52, 1.55, 1.7]) * scale, rtol=1e-5)
            number = attributes.read(mesh, "atomic_number", "INT")[:, 0] - 6
            inner = self.vertices_of_one_atom(mesh)
            np.testing.assert_array_equal(attributes.read(mesh, "is_even", "BOOLEAN")[inner, 0], number[inner] % 2 == 0)
            np.testing.assert_allclose(attributes.read(mesh, "lipophobicity", "FLOAT")[inner, 0], 0.5 * number[inner])

    def vertices_of_one_atom(self, mesh):
        """Returns the vertices whose faces all touch the same atom."""
        atom, corner = attributes.read(mesh, "atom_index", "INT")[:, 0], np.empty(len(mesh.loops), dtype=np.int32)
        mesh.loops.foreach_get("vertex_index", corner)
        low, high = np.full(len(mesh.vertices), 1 << 30), np.full(len(mesh.vertices), -1)
        np.minimum.at(low, corner, np.repeat(atom, 3))
        np.maximum.at(high, corner, np.repeat(atom, 3))
        self.assertGreater((low == high).sum(), 10)
        return low == high

    def test_selected_atoms_of_an_object(self):
        atoms_object()
        self.assertEqual(bpy.ops.object.meniscus_from_atoms(selection="is_even", wait=True), {"FINISHED"})
        item = bpy.context.view_layer.objects.active
        self.assertEqual(set(attributes.read(item.data, "atom_index", "INT")[:, 0]), {0, 2})
        item.meniscus.selection = "no_such"
        with self.assertRaisesRegex(RuntimeError, "no_such"):
            update()

    def test_atoms_that_move_with_the_frame_are_followed(self):
        atoms = atoms_object()

        def move(scene, _graph=None):
            rows = np.array(samples.MOLECULES["triple"], dtype=np.float32)[:, :3]
            rows[2, 1] += 0.2 * scene.frame_current
            atoms.data.vertices.foreach_set("co", (rows * 0.01).ravel())

        bpy.app.handlers.frame_change_pre.append(move)  # It runs after the add-on's handler until an object follows.
        self.addCleanup(bpy.app.handlers.frame_change_pre.remove, move)
        bpy.ops.object.meniscus_from_atoms(wait=True)
        item = bpy.context.view_layer.objects.active
        for frame in (1, 3, 2):
            bpy.context.scene.frame_set(frame)
            path = os.path.join(FOLDER, "moved.xyzr")
            with open(path, "w", encoding="ascii") as file:
                for row, (x, y, z, radius) in enumerate(samples.MOLECULES["triple"]):
                    file.write(f"{x} {y + (0.2 * frame if row == 2 else 0.0)} {z} {radius}\n")
            self.assertAlmostEqual(item["meniscus_area"] / wanted(path)[0][0], 1.0, places=5)

    def test_models_of_molecular_nodes_show_on_the_timeline(self):
        atoms = atoms_object("model")
        store = bpy.data.collections.new(".data_model_frames")
        for number in range(12):
            mesh = bpy.data.meshes.new(f"model_frame_{number}")
            mesh.vertices.add(3)
            rows = np.array(samples.MOLECULES["triple"], dtype=np.float32)[:, :3] * 0.01
            rows[2, 1] += 0.002 * number
            mesh.vertices.foreach_set("co", rows.ravel())
            store.objects.link(bpy.data.objects.new(mesh.name, mesh))
        self.assertEqual([each.name for each in molecular_nodes.frames_of(atoms)][9:], ["model_frame_9", "model_frame_10", "model_frame_11"])
        bpy.ops.object.meniscus_from_atoms(wait=True)
        item = bpy.context.view_layer.objects.active
        areas = []
        for frame in (1, 2, 11, 12, 40):
            bpy.context.scene.frame_set(frame)
            areas.append(round(item["meniscus_area"], 6))
        self.assertEqual(len(set(areas[:4])), 4)
        self.assertEqual(areas[3], areas[4])

    def test_centred_files_stay_with_imports_of_their_molecule(self):
        def world(item):
            return np.array([item.matrix_world @ vertex.co for vertex in item.data.vertices])

        item = of_file()
        self.assertLess(np.abs(world(item)).max(), 0.5)
        bpy.context.view_layer.update()
        for name, stays in (("triple", True), ("pair", False)):
            bpy.ops.import_scene.meniscus(filepath=os.path.join(FOLDER, name + ".mns"), center=True)
            imported = bpy.context.view_layer.objects.active
            centers = mns_reader.read(os.path.join(FOLDER, name + ".mns")).objects[0]["atom.center"]
            own = 0.5 * (centers.min(axis=0) + centers.max(axis=0))
            np.testing.assert_allclose(imported["meniscus_origin"][:], own, atol=1e-6)
            self.assertEqual(np.allclose(imported["meniscus_origin"][:], item["meniscus_origin"][:]), stays, name)
        bpy.context.view_layer.objects.active = None
        other = of_file(CAGE)
        self.assertLess(np.abs(world(other).min(axis=0) + world(other).max(axis=0)).max(), 0.02)

    def test_the_origin_of_an_object_lies_in_its_molecule(self):
        """The origin follows the molecule, centred or in the file's place, at any scale and for another selection."""
        centers = np.array(samples.MOLECULES["triple"])[:, :3] + 50.0
        path = os.path.join(FOLDER, "far.xyzr")
        with open(path, "w", encoding="ascii") as file:
            for x, y, z in centers:
                file.write(f"{x} {y} {z} 1.7\n")
        middle = 0.5 * (centers.min(axis=0) + centers.max(axis=0))
        for center in (True, False):
            start_anew()
            item = of_file(path, center=center)
            for scale in (0.1, 0.5):
                item.meniscus.scale = scale
                update()
                self.assertLess(np.abs(positions(item.data)).max(), 6.0 * scale)
                np.testing.assert_allclose(item.location, middle * (0.0 if center else scale), atol=1e-4)
            item.meniscus.selection = "index 0 1"
            update()
            np.testing.assert_allclose(item.location, middle * (0.0 if center else 0.5), atol=1e-4)
            self.assertAlmostEqual(float(positions(item.data)[:, 0].min()) / 0.5, centers[:2, 0].min() - 1.7 - middle[0], delta=0.05)

    def test_an_object_of_0_1_0_stays_where_it_was(self):
        """Its mesh has the coordinates of the file, and its location takes the origin away."""
        item = of_file()
        origin = np.array(item["meniscus_origin"][:])
        world = np.array([item.matrix_world @ vertex.co for vertex in item.data.vertices])
        del item["meniscus_middle"]
        item.location = -0.1 * origin
        item.data[computed.SHOWN] = ""
        computed.compute_now(item)
        bpy.context.view_layer.update()
        np.testing.assert_allclose(np.array([item.matrix_world @ vertex.co for vertex in item.data.vertices]), world, atol=1e-5)

    def test_new_objects_go_to_the_active_collection(self):
        mine = bpy.data.collections.new("mine")
        bpy.context.scene.collection.children.link(mine)
        layer = bpy.context.view_layer.layer_collection.children["mine"]
        bpy.context.view_layer.active_layer_collection = layer
        self.assertEqual(list(of_file().users_collection), [mine])
        layer.exclude = True
        self.assertEqual(list(of_file().users_collection), [bpy.context.scene.collection])


if not unittest.main(argv=["inside_computed"], exit=False).result.wasSuccessful():
    sys.exit(1)
