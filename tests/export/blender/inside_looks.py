# SPDX-License-Identifier: BSD-3-Clause
"""Materials by attributes: each colouring and look in Cycles, recoloured without a new surface; the asset library."""

import os
import subprocess
import sys
import unittest

import addon_utils
import bpy
import mathutils
import numpy as np

FOLDER, ADDON, HERE, BLENDER, PROGRAM = sys.argv[sys.argv.index("--") + 1:]
sys.path.insert(0, HERE)

import samples  # noqa: E402

from meniscus_import import attributes, build, compat, looks, materials, mns_reader  # noqa: E402

SIZE = 48
WAX_GRAIN = 0.14  # standard deviation of a channel divided by its mean
#: Shares of the pixels that show glass.
GLASS_EDGES, GLASS_DOTS = 0.006, 0.002  # Blender 4.2: 0.0087, 4.5: 0.0085, 5.3: 0.0084; evenly bright room: 0


def pixel_of(_item):
    """Returns the linear colour in the middle of a picture of a face that is seen straight on."""
    return picture()[SIZE // 2, SIZE // 2]


def picture(samples=1, channels=slice(3)):
    """Returns linear colours seen from above, (rows, columns, 3); channels=3 is the alpha before nothing."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = samples, False
    scene.render.resolution_x = scene.render.resolution_y = SIZE
    scene.render.resolution_percentage = 100
    scene.view_settings.view_transform = "Raw"
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.color_depth = "16"
    scene.render.filepath = os.path.join(FOLDER, "pixel.png")
    if scene.camera is None:
        camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
        camera.data.type, camera.data.ortho_scale = "ORTHO", 1.0
        camera.matrix_world = mathutils.Matrix.Translation((0.0, 0.0, 5.0))
        scene.collection.objects.link(camera)
        scene.camera = camera
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath, check_existing=False)
    image.colorspace_settings.name = "Non-Color"
    values = np.array(image.pixels[:], dtype=np.float32).reshape(SIZE, SIZE, 4)
    bpy.data.images.remove(image)
    return values[:, :, channels]


def plate(**given):
    """Makes a square across the view with the same attribute values everywhere."""
    mesh = bpy.data.meshes.new("plate")
    mesh.from_pydata([(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0)], [], [(0, 1, 2, 3)])
    if "ses_kind" not in given:
        attributes.add(mesh, "ses_kind", "INT", "FACE", np.zeros(1, np.int32))
    for name, value in given.items():
        if name == "Color":
            attributes.add(mesh, name, "FLOAT_COLOR", "POINT", np.tile(np.float32([*value, 1.0]), (4, 1)))
        elif name == "opacity":
            attributes.add(mesh, name, "FLOAT", "FACE", np.float32([value]))
        elif name == "ses_kind":
            attributes.add(mesh, name, "INT", "FACE", np.array([value], np.int32))
        else:
            whole = isinstance(value, int)
            attributes.add(mesh, name, "INT" if whole else "FLOAT", "POINT", np.full(4, value, np.int32 if whole else np.float32))
    item = bpy.data.objects.new("plate", mesh)
    bpy.context.scene.collection.objects.link(item)
    bpy.context.view_layer.objects.active = item
    return item


def bumpy_slab(side, atom, depth):
    """Makes a closed box whose upper and lower faces are waved like a layer of atoms of a radius."""
    count = 64
    across = np.linspace(-side, side, count)
    x, y = (each.ravel() for each in np.meshgrid(across, across))
    wave = 0.5 * atom * np.cos(np.pi * x / (1.2 * atom)) * np.cos(np.pi * y / (1.2 * atom))
    points = np.concatenate([np.column_stack([x, y, wave]), np.column_stack([x, y, -depth + np.roll(wave, 3)])])
    corner = (np.arange(count - 1)[:, None] * count + np.arange(count - 1)).ravel()
    top = np.column_stack([corner, corner + 1, corner + count + 1, corner + count])
    rim = np.concatenate([np.arange(count - 1), np.arange(count - 1, count * count - 1, count),
                          np.arange(count * count - 1, count * (count - 1), -1), np.arange(count * (count - 1), 0, -count)])
    after = np.roll(rim, -1)
    walls = np.column_stack([rim, rim + count * count, after + count * count, after])
    mesh = bpy.data.meshes.new("slab")
    mesh.from_pydata(points.tolist(), [], [*top.tolist(), *(top[:, ::-1] + count * count).tolist(), *walls.tolist()])
    for face in mesh.polygons:
        face.use_smooth = True
    attributes.add(mesh, "Color", "FLOAT_COLOR", "POINT", np.ones((len(points), 4), dtype=np.float32))
    attributes.add(mesh, "ses_kind", "INT", "FACE", np.zeros(len(mesh.polygons), np.int32))
    item = bpy.data.objects.new("slab", mesh)
    bpy.context.scene.collection.objects.link(item)
    bpy.context.view_layer.objects.active = item
    return item


class Looks(unittest.TestCase):
    def setUp(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        addon_utils.enable("meniscus_import", default_set=True)

    def shown(self, coloring, **given):
        """Returns the colour by which the flat look shows a plate with these attributes."""
        item = plate(**given)
        self.assertEqual(bpy.ops.object.meniscus_look(look="FLAT", coloring=coloring), {"FINISHED"})
        color = pixel_of(item)
        bpy.data.objects.remove(item)
        return color

    def test_steps_and_scales_give_their_colours(self):
        cases = [("CONFIDENCE", {"b_factor": value}, color) for value, color in
                 ((20.0, "#ff7d45"), (55.0, "#ffdb13"), (69.0, "#ffdb13"), (71.0, "#65cbf3"), (95.0, "#0053d6"), (100.0, "#0053d6"))]
        cases += [("ELEMENT", {"atomic_number": number}, color) for number, color in
                  ((1, "#ffffff"), (6, "#c8c8c8"), (7, "#8fa6f5"), (8, "#f58f8f"), (16, "#f5e88f"), (53, "#c8c8c8"))]
        cases += [("KIND", {"ses_kind": kind}, color) for kind, color in enumerate(("#e69f00", "#56b4e9", "#009e73"))]
        cases += [("CHARGE", {"charge": value}, color) for value, color in ((-1.0, "#d6412f"), (0.0, "#ffffff"), (1.0, "#3a5fcd"), (7.0, "#3a5fcd"))]
        cases += [("CURVATURE", {"mean_curvature": value}, color) for value, color in ((-0.8, "#3a5fcd"), (0.0, "#ffffff"), (0.8, "#d6412f"))]
        cases += [("SMOOTH_CURVATURE", {"smooth_mean_curvature": -0.3}, "#3a5fcd"), ("ATOM_AREA", {"atom_area": 12.0}, "#2a788e"),
                  ("ACCESSIBLE_AREA", {"accessible_area": 40.0}, "#fde725"), ("BURIED_AREA", {"buried_area": 0.0}, "#ffffff")]
        for coloring, given, color in cases:
            np.testing.assert_allclose(self.shown(coloring, **given), looks.linear(color)[:3], atol=4e-3, err_msg=f"{coloring} {given}")
        np.testing.assert_allclose(self.shown("COLOR", Color=(0.2, 0.5, 0.8)), (0.2, 0.5, 0.8), atol=2e-3)

    def test_chains_and_residues_have_colours_of_their_own(self):
        for coloring, attribute in looks.HUES.items():
            found = [self.shown(coloring, **{attribute: number}) for number in range(6)]
            for one in range(6):
                for other in range(one):
                    self.assertGreater(np.abs(found[one] - found[other]).max(), 0.08, (coloring, one, other))

    def test_the_range_of_a_scale_is_an_input(self):
        item = plate(charge=0.25)
        bpy.ops.object.meniscus_look(look="FLAT", coloring="CHARGE")
        group = next(node for node in item.data.materials[0].node_tree.nodes if node.type == "GROUP")
        group.inputs["Low"].default_value, group.inputs["High"].default_value = -0.25, 0.25
        np.testing.assert_allclose(pixel_of(item), looks.linear("#3a5fcd")[:3], atol=4e-3)

    def test_every_look_renders_in_every_colouring(self):
        given = {"Color": (0.8, 0.3, 0.2), "b_factor": 80.0, "atomic_number": 8, "chain_id": 1, "charge": 0.4, "map_value": 2.0,
                      "hydrophobicity": 1.0, "lipophobicity": 0.3, "ses_kind": 1, "res_name_id": 2, "mean_curvature": 0.2,
                      "smooth_mean_curvature": -0.1, "atom_area": 9.0, "accessible_area": 20.0, "buried_area": 7.0}
        sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
        bpy.context.scene.collection.objects.link(sun)
        for look in looks.LOOKS:
            item = plate(**given)
            seen = []
            for coloring in looks.COLORINGS:
                self.assertEqual(bpy.ops.object.meniscus_look(look=look, coloring=coloring), {"FINISHED"})
                output = next(node for node in item.data.materials[0].node_tree.nodes if node.type == "OUTPUT_MATERIAL")
                self.assertTrue(output.inputs["Surface"].is_linked, (look, coloring))
                seen.append(item.data.materials[0].name)
            self.assertEqual(len(set(seen)), len(looks.COLORINGS))
            if look in ("PAINT", "CLAY", "FLAT"):
                self.assertGreater(pixel_of(item).max(), 0.05, look)
            bpy.data.objects.remove(item)

    def test_a_material_is_made_once_for_a_scale(self):
        names = {looks.material("WAX", "COLOR", scale).name for scale in (0.1, 0.1, 0.01)}
        self.assertEqual(len(names), 2)
        self.assertEqual(len([tree for tree in bpy.data.node_groups if looks.MARK in tree]), 1)

    def test_glass_absorbs_in_cycles_and_refracts_in_eevee(self):
        made = looks.material("GLASS", "COLOR")
        volume = {node.target: node.inputs["Volume"].is_linked for node in made.node_tree.nodes if node.type == "OUTPUT_MATERIAL"}
        self.assertEqual(volume, {"CYCLES": True, "EEVEE": False})
        rough = [node.inputs["Roughness"].default_value for node in made.node_tree.nodes if "Roughness" in node.inputs]
        self.assertEqual(len(rough), 4)
        self.assertGreater(min(rough), 0.01)  # With smooth glass Eevee 3.4 made 37 pixels of 1TII black at 1200x900.
        self.assertTrue(getattr(made, "use_screen_refraction", False) or getattr(made, "use_raytrace_refraction", False))

    def test_what_is_behind_glass_can_be_told(self):
        """Bumps of atoms leave an edge behind the glass in place; real refraction would scatter it over the picture."""
        for side, light in ((-1.0, 1.0), (1.0, 0.0)):
            half = plate(Color=(light, light, light))
            half.location = (2.0 * side, 0.0, -2.0)
            bpy.ops.object.meniscus_look(look="FLAT", coloring="COLOR")
        alone = picture()
        bumps = bumpy_slab(side=1.2, atom=0.1, depth=1.5)
        bumps["meniscus_scale"] = 0.1
        self.assertEqual(bpy.ops.object.meniscus_look(look="GLASS", coloring="COLOR"), {"FINISHED"})
        through = picture(samples=16)
        likeness = float(np.corrcoef(alone[:, :, 1].ravel(), through[:, :, 1].ravel())[0, 1])
        print(f"likeness through glass: {likeness:.3f}")
        self.assertGreater(likeness, 0.8)

    def test_glass_is_drawn_by_dark_edges_on_white(self):
        """With the driver's lights the background is white, edges are dark, and no bump mirrors a lamp as a white
        dot."""
        target = os.path.join(FOLDER, "glass.png")
        file = next(os.path.join(FOLDER, "run", name) for name in sorted(os.listdir(os.path.join(FOLDER, "run"))) if name.endswith(".mns"))
        command = [BLENDER, "-b", "--factory-startup", "--python-exit-code", "3", "--python", os.path.join(ADDON, "render_mns.py"), "--",
                   file, "--look", "glass", "--samples", "16", "--size", "160x120", "--output", target]
        self.assertEqual(subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False).returncode, 0)
        image = bpy.data.images.load(target, check_existing=False)
        image.colorspace_settings.name = "Non-Color"
        values = np.array(image.pixels[:]).reshape(120, 160, 4)[:, :, :3]
        border = np.concatenate([values[0], values[-1], values[:, 0], values[:, -1]])
        self.assertEqual(np.median(border), 1.0)
        self.assertGreater(border.mean(), 0.99)  # The denoiser of 4.2 and later changes corners.
        if bpy.app.version < (4, 0, 0):
            self.assertEqual([values[row, column].min() for row in (0, -1) for column in (0, -1)], [1.0] * 4)
        light = values.mean(axis=2)
        around = np.max([np.roll(light, step, axis) for axis in (0, 1) for step in (1, -1)], axis=0)
        glass = light < 0.96
        dark, dots = float((light[glass] < 0.45).mean()), float(((light > 0.9) & (around < 0.8)).sum() / glass.sum())
        print(f"glass: {dark:.4f} of its pixels are dark, {dots:.4f} are white dots")
        self.assertGreater(glass.mean(), 0.2)
        self.assertGreater(dark, GLASS_EDGES)
        self.assertLess(dots, GLASS_DOTS)

    def test_glass_mirrors_as_glass_does(self):
        """The lamp is seen only as its mirror image in the glass, which shows 3.4 % of it at a right angle."""
        world = bpy.data.worlds.new("bright")
        tree = compat.node_tree(world)
        background = compat.find_or_add(tree, "BACKGROUND", "ShaderNodeBackground")
        tree.links.new(background.outputs[0], compat.find_or_add(tree, "OUTPUT_WORLD", "ShaderNodeOutputWorld").inputs["Surface"])
        background.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
        bpy.context.scene.world = world
        wall = plate(Color=(0.0, 0.0, 0.0))
        wall.location, wall.scale = (0.0, 0.0, -0.5), (50.0, 50.0, 1.0)
        bpy.ops.object.meniscus_look(look="FLAT", coloring="COLOR")
        plate(Color=(1.0, 1.0, 1.0))
        bpy.ops.object.meniscus_look(look="GLASS", coloring="COLOR")
        once = ((looks.GLASS_IOR - 1.0) / (looks.GLASS_IOR + 1.0)) ** 2
        self.assertAlmostEqual(float(picture(samples=64)[4:-4, 4:-4].mean()), once + ((looks.GLASS_BENDS - 1.0) / (looks.GLASS_BENDS + 1.0)) ** 2, delta=0.006)

    def test_wax_of_one_colour_has_little_grain(self):
        """The grain is measured between two seeds with 16 samples each."""
        sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
        sun.rotation_euler = (0.6, 0.3, 0.0)
        bpy.context.scene.collection.objects.link(sun)
        item = bumpy_slab(side=1.2, atom=0.1, depth=1.5)
        colors = np.tile(np.float32([0.02, 0.2, 0.6, 1.0]), (len(item.data.vertices), 1))
        item.data.attributes["Color"].data.foreach_set("color", colors.ravel())
        bpy.ops.object.meniscus_look(look="WAX", coloring="COLOR")
        pictures = []
        for bpy.context.scene.cycles.seed in (1, 2):
            pictures.append(picture(samples=16))
        one, other = pictures
        grain = float((one - other).std() / (one + other).mean())
        print(f"grain of wax: {grain:.3f}")
        self.assertGreater(one[:, :, 2].mean(), 3.0 * one[:, :, 0].mean())
        self.assertLess(grain, WAX_GRAIN)

    def test_a_scene_of_the_driver_lets_light_through(self):
        """Glass gets its bounces and wax enough samples per pixel; other looks get neither."""
        found = {}
        for look in ("glass", "wax", "paint"):
            target = os.path.join(FOLDER, look + ".blend")
            command = [BLENDER, "-b", "--factory-startup", "--python-exit-code", "3", "--python", os.path.join(ADDON, "render_mns.py"), "--",
                       os.path.join(FOLDER, "pair.mns"), "--look", look, "--blend", target]
            self.assertEqual(subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False).returncode, 0)
            bpy.ops.wm.open_mainfile(filepath=target)
            scene = bpy.context.scene
            lamps = [item.visible_transmission for item in bpy.data.objects if item.type == "LIGHT"]
            found[look] = (scene.cycles.samples, scene.cycles.use_adaptive_sampling, scene.cycles.transmission_bounces, lamps)
        self.assertEqual(found, {"glass": (128, True, 32, [False]), "wax": (128, True, 12, [True, True]), "paint": (32, False, 12, [True, True])})

    def test_what_an_object_has_not_is_not_offered(self):
        plate()
        self.assertEqual(looks.offered(bpy.context.active_object.data), {"COLOR", "KIND"})
        for coloring, attribute in looks.ATTRIBUTES.items():
            if coloring in ("COLOR", "KIND") or attribute in bpy.context.active_object.data.attributes:
                continue
            with self.assertRaisesRegex(TypeError, coloring):
                bpy.ops.object.meniscus_look(look="PAINT", coloring=coloring)
            kind = "INT" if coloring in (*looks.HUES, "ELEMENT") else "FLOAT"
            attributes.add(bpy.context.active_object.data, attribute, kind, "POINT", np.zeros(4, np.int32 if kind == "INT" else np.float32))
            self.assertEqual(bpy.ops.object.meniscus_look(look="PAINT", coloring=coloring), {"FINISHED"})

    def test_outlines_by_line_art(self):
        item = plate(Color=(1.0, 1.0, 1.0))
        before = set(bpy.data.objects)
        self.assertEqual(bpy.ops.object.meniscus_look(look="FLAT", coloring="COLOR", lines=True), {"FINISHED"})
        (lines,) = set(bpy.data.objects) - before
        stack = lines.modifiers if len(lines.modifiers) else lines.grease_pencil_modifiers
        self.assertEqual((stack[0].source_object, stack[0].use_contour), (item, True))
        self.assertIsNotNone(stack[0].target_material)

    def test_outlines_are_as_wide_for_any_scale(self):
        """Lines are LINE_WIDTH Å wide: older Blenders count thousandths of a unit times a factor, 4.3 has a modifier of the radius, 4.5 a radius."""
        for scale in (1.0, 0.1, 0.01):
            item = plate(Color=(1.0, 1.0, 1.0))
            item["meniscus_scale"] = scale
            lines = looks.add_lines(bpy.context, item)
            stack = lines.modifiers if len(lines.modifiers) else lines.grease_pencil_modifiers
            width = (2.0 * stack[0].radius if hasattr(stack[0], "radius") else 2.0 * stack[1].thickness if len(stack) > 1 else
                     1e-3 * stack[0].thickness * lines.data.pixel_factor)
            self.assertAlmostEqual(width / (looks.LINE_WIDTH * scale), 1.0, places=5)

    def test_every_look_keeps_what_the_scene_asks(self):
        """Opacity, the opacity of a film seen at 60 degrees, and a fade set the picture's alpha before nothing."""
        bpy.context.scene.render.film_transparent = True
        bpy.context.scene.render.image_settings.color_mode = "RGBA"
        for look in looks.LOOKS:
            for kind, turn, alpha in (("opaque", 0.0, 1.0), ("translucent", 0.0, 0.25), ("translucent", 60.0, 0.25), ("film", 60.0, 1.0 - 0.75 ** 2)):
                item = plate(Color=(1.0, 1.0, 1.0), **({} if kind == "opaque" else {"opacity": 0.25}))
                item.data[materials.REQUIREMENTS] = {"kind": kind, "fades": 0}
                item.rotation_euler[0] = np.radians(turn)
                self.assertEqual(bpy.ops.object.meniscus_look(look=look, coloring="COLOR"), {"FINISHED"})
                self.assertAlmostEqual(float(picture(256, 3)[16:32, 16:32].mean()), alpha, delta=0.02, msg=f"{look} {kind} {turn}")
                bpy.data.objects.remove(item)
            item = plate(Color=(1.0, 1.0, 1.0))
            item.data[materials.REQUIREMENTS] = {"kind": "opaque", "fades": 1}
            item.color[3] = 0.5
            if look == "GLASS":
                with self.assertRaisesRegex(RuntimeError, "cannot fade"):
                    bpy.ops.object.meniscus_look(look=look, coloring="COLOR")
            else:
                bpy.ops.object.meniscus_look(look=look, coloring="COLOR")
                self.assertAlmostEqual(float(picture(64, 3)[16:32, 16:32].mean()), 0.5, delta=0.05, msg=look)
            bpy.data.objects.remove(item)

    def test_every_look_keeps_the_material_of_an_object_or_refuses_it(self):
        for look in looks.LOOKS:
            for key, value in (("ambient", 0.6), ("roughness", 0.7), ("shininess", 700.0), ("specular", 0.15)):
                item = plate(Color=(1.0, 0.2, 0.2))
                item.data[materials.REQUIREMENTS] = {"kind": "opaque", "fades": 0, key: value}
                if look in ("GLASS", "FLAT"):
                    with self.assertRaisesRegex(RuntimeError, f"{look.lower()} has no place for {key}"):
                        bpy.ops.object.meniscus_look(look=look, coloring="COLOR")
                    continue
                bpy.ops.object.meniscus_look(look=look, coloring="COLOR")
                shader = materials.shader_of(item.data.materials[0])
                found = {"ambient": shader.inputs["Emission Strength"], "shininess": shader.inputs["Roughness"],
                         "specular": compat.principled_input(shader, "Specular IOR Level", "Specular"),
                         "roughness": compat.principled_input(shader, "Diffuse Roughness")}[key]
                wanted = {"shininess": (2.0 / 702.0) ** 0.25, "specular": 0.75}.get(key, value)
                if found is not None:
                    self.assertAlmostEqual(found.default_value, wanted, places=5, msg=f"{look} {key}")
                bpy.data.objects.remove(item)

    def test_looks_of_the_driver_keep_opacity_caps_and_shadows(self):
        """The driver's command line gets a tetrahedron of four faces whose opacity is a quarter."""
        path, target = (os.path.join(FOLDER, name) for name in ("asked.mns", "asked.png"))

        def drive(look, data, *words):
            with open(path, "wb") as file:
                file.write(data)
            done = subprocess.run([BLENDER, "-b", "--factory-startup", "--python-exit-code", "3", "--python", os.path.join(ADDON, "render_mns.py"), "--", path,
                                   "--look", look, "--samples", "32", "--transparent", "--output", target, *words], capture_output=True, text=True, check=False)
            return done.returncode, done.stderr

        plain = samples.small_surface(False)
        header, _ = samples.header_of(plain)
        del header["objects"][0]["material"], header["objects"][0]["film_opacity"]
        quarter = samples.patched(samples.with_header(plain, header), "atom.opacity", "f", 0.25)
        for look in ("paint", "clay", "wax", "glass", "flat"):
            code, said = drive(look, quarter)
            self.assertEqual(code, 0, said)
            self.assertEqual("shadows are left out" in said, look in ("glass", "flat"), said)
            image = bpy.data.images.load(target, check_existing=False)
            alpha = np.array(image.pixels[:]).reshape(image.size[1], image.size[0], 4)[:, :, 3]
            bpy.data.images.remove(image)
            self.assertAlmostEqual(alpha[22:26, 30:34].mean(), 1.0 - 0.75 ** 2, delta=0.07, msg=look)
            code, said = drive(look, plain)
            self.assertEqual(code, 3 if look in ("glass", "flat") else 0, said)
            if code:
                self.assertIn("has no place for ambient, roughness, shininess, specular", said)
        self.assertEqual(drive("clay", quarter, "--style", "flat")[0], 2)

    def test_a_reload_dresses_what_became_another_kind(self):
        """A file that is exported anew with opacity gets other materials; the user's own material stays."""
        path = os.path.join(FOLDER, "renewed.mns")
        plain = samples.small_surface(False)
        header, _ = samples.header_of(plain)
        del header["objects"][0]["material"], header["objects"][0]["film_opacity"]
        seen_through = samples.with_header(plain, header)
        header["arrays"] = [each for each in header["arrays"] if each["name"] != "0/atom.opacity"]
        opaque = samples.with_header(plain, header)
        for look in (None, "CLAY", "own"):
            with open(path, "wb") as file:
                file.write(opaque)
            item = build.import_file(path).surfaces[0]
            if look == "own":
                item.data.materials[0] = bpy.data.materials.new("own")
            elif look:
                looks.dress(item, look, "COLOR")
            before = item.data.materials[0]
            with open(path, "wb") as file:
                file.write(seen_through)
            build.reload(item)
            self.assertEqual(item.data.materials[0] == before, look == "own", look)
            if look != "own":
                mark = item.data.materials[0].get(looks.MARK, item.data.materials[0].get(materials.MARK))
                self.assertIn("translucent", mark)
        header["objects"][0]["material"] = {"specular": 0.1}
        looks.dress(item, "FLAT", "COLOR")
        with open(path, "wb") as file:
            file.write(samples.with_header(plain, header))
        with self.assertRaisesRegex(mns_reader.MnsError, "no place for specular"):
            build.reload(item)

    def test_the_asset_library(self):
        target = os.path.join(FOLDER, "assets")
        script = os.path.join(os.path.dirname(ADDON), "make_assets.py")
        command = [BLENDER, "-b", "--factory-startup", "--python-exit-code", "3", "--python", script, "--", target]
        self.assertEqual(subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False).returncode, 0)
        with bpy.data.libraries.load(os.path.join(target, "meniscus_assets.blend"), assets_only=True) as (found, _):
            self.assertEqual(len(found.materials), len(looks.LOOKS) * len(looks.COLORINGS))
            self.assertEqual(len(found.node_groups), len(looks.COLORINGS))
        with open(os.path.join(target, "blender_assets.cats.txt"), encoding="utf-8") as file:
            self.assertIn(":Meniscus/Materials:", file.read())
        self.assertEqual(subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False).returncode, 2)


if not unittest.main(argv=["inside_looks"], exit=False).result.wasSuccessful():
    sys.exit(1)
