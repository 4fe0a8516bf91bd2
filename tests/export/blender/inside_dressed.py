# SPDX-License-Identifier: BSD-3-Clause
"""A scene that a user has edited: whatever is imported or computed again, nothing of theirs changes, in its data and in
its picture.

MENISCUS_KEEP_PICTURES: a folder for the pictures, which are larger then, to look at."""

import os
import re
import sys
import unittest

import addon_utils
import bpy
import numpy as np

FOLDER, ADDON, HERE, BLENDER, PROGRAM = sys.argv[sys.argv.index("--") + 1:]
PACKAGE = os.environ["MENISCUS_PACKAGE"]
PICTURES = os.environ.get("MENISCUS_KEEP_PICTURES", "")
SIZE = (1200, 900) if PICTURES else (120, 90)
sys.path.insert(0, HERE)
import fingerprint  # noqa: E402

from meniscus_import import attributes, compat, computed  # noqa: E402

UBIQUITIN = "/usr/share/freesasa/test-data/1ubq.pdb"
#: Differences that every new and selected object brings to the scene.
NEW_OBJECTS = (r"scenes/Scene: \.collection\.((collection_)?(children|objects)|all_objects)", r"scenes/Scene: \.(objects|view_layers\[0\]\.(objects|layer_collection))",
          r"scenes/Scene: \.(view_layers\[0\]\.)?active")


def material(name, color):
    made = bpy.data.materials.new(name)
    tree = compat.node_tree(made)
    shader = compat.find_or_add(tree, "BSDF_PRINCIPLED", "ShaderNodeBsdfPrincipled")
    output = compat.find_or_add(tree, "OUTPUT_MATERIAL", "ShaderNodeOutputMaterial")
    tree.links.new(shader.outputs[0], output.inputs["Surface"])
    checker = tree.nodes.new("ShaderNodeTexChecker")
    checker.inputs["Color1"].default_value, checker.inputs["Color2"].default_value = (*color, 1.0), (0.9, 0.9, 0.85, 1.0)
    tree.links.new(checker.outputs["Color"], shader.inputs["Base Color"])
    return made


def link(item, collection, place):
    item.location = place
    collection.objects.link(item)
    return item


def grid(name, side, cells):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([(side * (x / cells - 0.5), side * (y / cells - 0.5), 0.0) for y in range(cells + 1) for x in range(cells + 1)], [],
                     [(r + x, r + x + 1, r + x + cells + 2, r + x + cells + 1) for r in range(0, cells * (cells + 1), cells + 1) for x in range(cells)])
    return mesh


def dress():
    """Makes a floor, a waved second object, lights, world, camera, collections, keys, and unusual settings."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    addon_utils.enable("meniscus_import", default_set=True)
    preferences = bpy.context.preferences.addons[computed.__package__].preferences
    preferences.package, preferences.program = PACKAGE, PROGRAM
    scene = bpy.context.scene
    stage, props = bpy.data.collections.new("stage"), bpy.data.collections.new("props")
    scene.collection.children.link(stage)
    stage.children.link(props)
    floor = link(bpy.data.objects.new("floor", grid("floor", 12.0, 8)), stage, (0.0, 0.0, -2.2))
    floor.data.materials.append(material("tiles", (0.25, 0.3, 0.35)))
    wave = link(bpy.data.objects.new("waves", grid("waves", 2.0, 24)), props, (2.6, -0.6, -1.2))
    wave.data.materials.append(material("brass", (0.8, 0.5, 0.15)))
    wave.modifiers.new("wave", "WAVE").height = 0.3
    wave.modifiers.new("thick", "SOLIDIFY").thickness = 0.2
    group = wave.vertex_groups.new(name="half")
    group.add(range(0, 200), 0.5, "REPLACE")
    attributes.add(wave.data, "heat", "FLOAT", "POINT", np.linspace(0.0, 1.0, len(wave.data.vertices), dtype=np.float32))
    wave.shape_key_add(name="Basis")
    wave.shape_key_add(name="lifted").value = 0.25
    wave.constraints.new("LIMIT_ROTATION").use_limit_x = True
    wave["owner"] = "somebody"
    for frame, turn in ((10, 0.0), (50, 1.5)):
        wave.rotation_euler[2] = turn
        wave.keyframe_insert("rotation_euler", frame=frame)
    text = link(bpy.data.objects.new("title", bpy.data.curves.new("title", "FONT")), props, (-3.2, -1.5, -2.1))
    text.data.body, text.data.extrude = "ubiquitin", 0.08
    text.data.materials.append(bpy.data.materials["brass"])
    for name, kind, place, energy in (("key", "AREA", (-3.0, -4.0, 4.0), 500.0), ("rim", "POINT", (4.0, 3.0, 2.0), 200.0)):
        light = link(bpy.data.objects.new(name, bpy.data.lights.new(name, kind)), stage, place)
        light.data.energy, light.data.color = energy, (1.0, 0.9, 0.8)
        light.constraints.new("TRACK_TO").target = floor
    camera = link(bpy.data.objects.new("lens", bpy.data.cameras.new("lens")), stage, (0.5, -8.5, 1.6))
    camera.rotation_euler = (1.39, 0.0, 0.06)
    camera.data.lens, camera.data.dof.use_dof, camera.data.dof.focus_distance = 42.0, True, 8.5
    world = bpy.data.worlds.new("dusk")
    tree = compat.node_tree(world)
    background = compat.find_or_add(tree, "BACKGROUND", "ShaderNodeBackground")
    tree.links.new(background.outputs[0], compat.find_or_add(tree, "OUTPUT_WORLD", "ShaderNodeOutputWorld").inputs["Surface"])
    background.inputs["Color"].default_value, background.inputs["Strength"].default_value = (0.2, 0.25, 0.4, 1.0), 0.6
    scene.world, scene.camera = world, camera
    scene.frame_start, scene.frame_end, scene.render.fps, scene.render.fps_base = 10, 50, 30, 1.001
    scene.frame_set(20)
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = *SIZE, 100
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.seed = "CYCLES", 32 if PICTURES else 4, False, 7
    scene.cycles.max_bounces, scene.view_settings.exposure, scene.unit_settings.scale_length = 5, 0.3, 0.01
    scene.render.image_settings.file_format = "PNG"
    scene.timeline_markers.new("turn", frame=30)
    bpy.context.view_layer.update()


def picture(name):
    """Returns a picture of the scene, (rows, columns, 3), 0 to 1."""
    scene = bpy.context.scene
    path, before = os.path.join(PICTURES or FOLDER, f"dressed_{name}.png"), scene.render.filepath
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)
    scene.render.filepath = before
    image = bpy.data.images.load(path)
    values = np.array(image.pixels[:], dtype=np.float32).reshape(SIZE[1], SIZE[0], 4)[:, :, :3]
    bpy.data.images.remove(image)
    return values


class Dressed(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        dress()
        self.before = fingerprint.of_data()

    def check(self, *allowed):
        """Checks that earlier data has not changed, except where the scene lists and selects new objects."""
        pattern = "|".join((*NEW_OBJECTS, *allowed))
        found = [each for each in fingerprint.differences(self.before, fingerprint.of_data()) if not re.match(pattern, each)]
        self.assertEqual(found, [])

    def check_picture(self, name, before):
        """Checks that the user's picture is the same when new objects are hidden, and another when they show."""
        after = picture(name)
        self.assertGreater(float((np.abs(after - before).max(axis=2) > 0.02).mean()), 0.05)
        for item in bpy.data.objects:
            if f"objects/{item.name_full}" not in self.before:
                item.hide_render = True
        np.testing.assert_array_equal(picture(name + "_hidden"), before)
        for item in bpy.data.objects:
            if f"objects/{item.name_full}" not in self.before:
                item.hide_render = False
        return after

    def test_the_fingerprint_sees_what_changes(self):
        bpy.data.objects["waves"].modifiers["wave"].height = 0.31
        bpy.data.materials["brass"].node_tree.nodes["Checker Texture"].inputs["Scale"].default_value = 6.0
        bpy.data.meshes["waves"].vertices[3].co.z += 1e-3
        bpy.context.scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.7
        bpy.context.scene.render.fps = 24
        bpy.data.collections["props"].objects.unlink(bpy.data.objects["title"])
        found = "\n".join(fingerprint.differences(self.before, fingerprint.of_data()))
        for word in ("objects/waves: .modifiers[0].height", "materials/brass: .node_tree.nodes", "meshes/waves: (places)", "worlds/dusk: .node_tree",
                     "scenes/Scene: .render.fps: 30 became 24", "collections/props: .objects"):
            self.assertIn(word, found)

    def test_a_surface_is_imported(self):
        before = picture("alone")
        bpy.ops.import_scene.meniscus(filepath=os.path.join(FOLDER, "cage.mns"), center=True, use_camera=False, scale=0.2)
        self.check()
        self.check_picture("imported", before)

    def test_a_sequence_is_imported(self):
        for mode in ("BAKE", "STREAM"):
            with self.subTest(mode):
                dress()
                self.before = fingerprint.of_data()
                bpy.ops.import_scene.meniscus_sequence(filepath=os.path.join(FOLDER, "run", "surface_sequence.json"), mode=mode, center=True,
                                                       use_camera=False, set_time=False, start=19.0, outside="HOLD")
                self.check(r"scenes/Scene: \.render\.use_lock_interface: False became True")  # A stream refills its mesh in a render.

    def test_a_surface_is_computed_and_computed_anew(self):
        before = picture("alone")
        bpy.ops.object.meniscus_from_file(filepath=UBIQUITIN, wait=True, detail="PROXY")
        self.check()
        item = bpy.context.view_layer.objects.active
        self.check_picture("computed", before)
        self.dress_surface(item)
        self.before, marked = fingerprint.of_data(), attributes.read(item.data, "atom_index", "INT")
        first = picture("computed_dressed")
        item.meniscus.probe, item.meniscus.density = 3.0, 0.3
        self.assertEqual(bpy.ops.object.meniscus_update(wait=True), {"FINISHED"})
        name, mesh = item.name_full, item.data.name_full
        self.check(rf"objects/{name}: (\.meniscus\.(probe|density)|\[\"meniscus|\.bound_box)", rf"meshes/{mesh}: (\(|\[\"meniscus_shown|\.total_|\.texspace_|\.normals_domain)",
                   rf"objects/{name}: \.modifiers\[0\]\.face_count")
        second = picture("computed_anew")
        self.assertGreater(float((np.abs(second - first).max(axis=2) > 0.02).mean()), 0.01)
        atom, marks = attributes.read(item.data, "atom_index", "INT"), attributes.read(item.data, "marks", "FLOAT")
        known = np.isin(atom, marked)  # Faces of atoms that were absent then have no marks.
        self.assertGreater(known.mean(), 0.9)
        np.testing.assert_array_equal(marks, np.where(known, atom + 0.5, 0.0))
        item.meniscus.probe, item.meniscus.density = 1.4, 1.0
        bpy.ops.object.meniscus_update(wait=True)
        self.check()  # The old values bring the old picture back.
        np.testing.assert_array_equal(picture("computed_back"), first)

    def dress_surface(self, item):
        """A material, modifiers, keys, a parent, a constraint, a collection, attributes and properties of somebody's own."""
        item.data.materials[0] = bpy.data.materials["brass"]
        item.modifiers.new("cut", "DECIMATE").ratio = 0.8
        item.modifiers.new("smooth", "SMOOTH").iterations = 2
        item.constraints.new("LIMIT_LOCATION").use_min_z = False
        world = item.matrix_world.copy()
        item.parent = bpy.data.objects["floor"]
        item.matrix_world = world
        bpy.data.collections["props"].objects.link(item)
        item.data["heat"], item["owner"] = 0.5, "somebody"
        item.data.keyframe_insert('["heat"]', frame=12)
        item.scale = (1.1, 1.1, 1.1)
        item.keyframe_insert("scale", frame=20)
        item.pass_index, item.color, item.display_type = 3, (1.0, 0.5, 0.2, 1.0), "SOLID"
        attributes.add(item.data, "marks", "FLOAT", "FACE", attributes.read(item.data, "atom_index", "INT").astype(np.float32) + 0.5)
        bpy.context.view_layer.update()

    def test_an_import_is_read_again(self):
        bpy.ops.import_scene.meniscus(filepath=os.path.join(FOLDER, "cage.mns"), center=True, use_camera=False)
        self.dress_surface(bpy.context.view_layer.objects.active)
        self.before = fingerprint.of_data()
        self.assertEqual(bpy.ops.object.meniscus_reload(), {"FINISHED"})
        self.check()


if not unittest.main(argv=["inside_dressed"], exit=False).result.wasSuccessful():
    sys.exit(1)
