# SPDX-License-Identifier: BSD-3-Clause
"""The import as Blender sees it: counts, closedness, measures, attributes, normals, faults, undo of failures, pictures."""

import os
import shutil
import subprocess
import sys
import unittest
from unittest import mock

import addon_utils
import bpy
import mathutils
import numpy as np

FOLDER, ADDON, HERE, BLENDER, PROGRAM = sys.argv[sys.argv.index("--") + 1:]
sys.path.insert(0, HERE)
import samples  # noqa: E402

from meniscus_import import attributes, build, compat, looks, materials, mns_reader  # noqa: E402

STORES = ("objects", "meshes", "cameras", "collections", "materials", "lights", "images", "node_groups")


def path_of(name):
    return os.path.join(FOLDER, name + ".mns")


def everything():
    return {store: sorted(item.name for item in getattr(bpy.data, store)) for store in STORES}


def imported(name, **options):
    before = set(bpy.data.objects)
    assert bpy.ops.import_scene.meniscus(filepath=path_of(name), **options) == {"FINISHED"}
    return next(item for item in set(bpy.data.objects) - before if item.type == "MESH")


def positions(mesh):
    co = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", co)
    return co.reshape(-1, 3)


def triangles(mesh):
    corner = np.empty(len(mesh.loops), dtype=np.int32)
    mesh.loops.foreach_get("vertex_index", corner)
    return corner.reshape(-1, 3)


class Import(unittest.TestCase):
    def setUp(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        addon_utils.enable("meniscus_import")

    def test_geometry_is_that_of_the_header(self):
        for name in samples.MOLECULES:
            surface = mns_reader.read(path_of(name)).objects[0]
            mesh = imported(name, scale=1.0).data
            self.assertEqual(len(mesh.polygons), surface.header["mesh"]["triangles"])
            self.assertEqual(len(mesh.vertices), surface.header["mesh"]["vertices"])
            self.assertEqual(len(mesh.edges), len(mesh.polygons) * 3 // 2)
            self.assertTrue(mns_reader.is_closed(triangles(mesh)))
            volume = samples.signed_volume(positions(mesh), triangles(mesh))
            self.assertAlmostEqual(volume / surface.header["mesh"]["volume"], 1.0, places=5)
            self.assertAlmostEqual(volume / surface.header["volume"], 1.0, delta=0.01)
            self.assertAlmostEqual(sum(p.area for p in mesh.polygons) / surface.header["area"], 1.0, delta=0.01)

    def test_scale_multiplies_coordinates_and_nothing_else(self):
        large, small = imported("triple", scale=1.0), imported("triple")
        np.testing.assert_allclose(positions(small.data), 0.1 * positions(large.data), atol=1e-6)
        self.assertEqual(tuple(small.scale), (1.0, 1.0, 1.0))

    def test_the_camera_reaches_behind_all_of_the_body_at_any_scale(self):
        for scale in (0.1, 1.0, 10.0, 100.0):
            item = imported("triple", scale=scale)
            camera = next(other for other in item.users_collection[0].all_objects if other.type == "CAMERA")
            inverse = np.array(camera.matrix_world.inverted())
            depth = -(positions(item.data) @ inverse[2, :3] + inverse[2, 3])
            self.assertGreater(camera.data.clip_end, depth.max(), scale)
            self.assertLess(camera.data.clip_start, depth.min(), scale)

    def test_the_camera_stands_and_sees_as_the_file_says(self):
        shot = mns_reader.read(path_of("triple")).header["camera"]
        for scale in (0.1, 10.0):
            item = imported("triple", scale=scale)
            camera = next(other for other in item.users_collection[0].all_objects if other.type == "CAMERA")
            world = np.array(camera.matrix_world)
            ahead, up = np.array(shot["target"]) - shot["position"], np.array(shot["up"])
            np.testing.assert_allclose(world[:3, 3], scale * np.array(shot["position"]), rtol=1e-5, atol=1e-5 * scale)
            np.testing.assert_allclose(-world[:3, 2], ahead / np.linalg.norm(ahead), atol=1e-5)
            self.assertGreater(world[:3, 1] @ up, 0.0)
            self.assertEqual(camera.data.sensor_fit, "VERTICAL")
            self.assertAlmostEqual(np.degrees(camera.data.angle_y), shot["vertical_fov"], places=4)

    def test_coordinates_are_those_of_the_atoms_unmirrored(self):
        surface = mns_reader.read(path_of("triple")).objects[0]
        mesh = imported("triple", scale=1.0).data
        kind, atom = surface["mesh.kind"], surface["mesh.atom"]
        for polygon in list(mesh.polygons)[::37]:
            if kind[polygon.index] == 0:
                center = surface["atom.center"][atom[polygon.index]]
                offset = np.array(polygon.center) - center
                self.assertAlmostEqual(np.linalg.norm(offset), surface["atom.radius"][atom[polygon.index]], delta=0.01)
                self.assertGreater(np.dot(offset, polygon.normal), 0.0)

    def test_attributes(self):
        surface = mns_reader.read(path_of("cage")).objects[0]
        mesh = imported("cage").data
        found = {a.name: (a.data_type, a.domain) for a in mesh.attributes}
        for name in ("ses_kind", "ses_patch", "ses_component", "atom_index"):
            self.assertEqual(found[name], ("INT", "FACE"), name)
        for name in ("atomic_number", "res_id", "chain_id"):
            self.assertEqual(found[name], ("INT", "POINT"), name)
        for name in ("b_factor", "vdw_radii"):
            self.assertEqual(found[name], ("FLOAT", "POINT"), name)
        self.assertEqual(found["Color"], ("BYTE_COLOR", "CORNER"))
        for name, array in (("ses_kind", "mesh.kind"), ("ses_component", "mesh.component"), ("atom_index", "mesh.atom")):
            values = np.empty(len(mesh.polygons), dtype=np.int32)
            mesh.attributes[name].data.foreach_get("value", values)
            np.testing.assert_array_equal(values, surface[array])
        self.assertGreater(len(np.unique(surface["atom.color"], axis=0)), 3)
        color = np.empty(4 * len(mesh.loops), dtype=np.float32)
        mesh.attributes["Color"].data.foreach_get("color_srgb", color)
        wanted = np.repeat(surface["atom.color"][surface["mesh.atom"]], 3, axis=0)
        np.testing.assert_allclose(color.reshape(-1, 4)[:, :3], wanted, atol=1.01 / 255)
        slots = np.empty(len(mesh.polygons), dtype=np.int32)
        mesh.polygons.foreach_get("material_index", slots)
        np.testing.assert_array_equal(slots, surface["mesh.component"])
        self.assertEqual(set(slots), {0, 1})
        smooth = imported("cage", crisp_colors=False).data
        self.assertEqual((smooth.attributes["Color"].data_type, smooth.attributes["Color"].domain),
                         ("FLOAT_COLOR", "POINT"))

    def test_numbers_of_atoms_are_those_of_molecular_nodes(self):
        """Units of the scene, on points, and chains by their sorted names."""
        with open(path_of("triple"), "rb") as file:
            data = samples.plain(file.read())
        header, _ = samples.header_of(data)
        header["objects"][0]["chain_names"] = ["Z", "A"]
        for row, chain in enumerate((0, 1, 1)):
            data = samples.patched(data, "atom.chain_id", "i", chain, row)
        with open(path_of("chains"), "wb") as file:
            file.write(samples.with_header(data, header))
        item = imported("chains", scale=0.5)
        self.assertEqual(list(item["chain_ids"]), ["A", "Z"])
        surface, mesh = mns_reader.read(path_of("chains")).objects[0], item.data
        radii, chains = np.empty(len(mesh.vertices), dtype=np.float32), np.empty(len(mesh.vertices), dtype=np.int32)
        mesh.attributes["vdw_radii"].data.foreach_get("value", radii)
        mesh.attributes["chain_id"].data.foreach_get("value", chains)
        np.testing.assert_allclose(np.unique(radii), [0.76, 0.775, 0.85], rtol=1e-6)
        atom, corner = surface["mesh.atom"], surface["mesh.triangle"]
        inner = [v for v in range(len(mesh.vertices)) if v % 41 == 0 and len(set(atom[(corner == v).any(axis=1)])) == 1]
        self.assertGreater(len(inner), 10)
        for vertex in inner:
            of = atom[(corner == vertex).any(axis=1)][0]
            self.assertAlmostEqual(radii[vertex], 0.5 * surface["atom.radius"][of], places=5)
            self.assertEqual(chains[vertex], (1, 0, 0)[of])

    def test_numbers_of_the_surface_and_names(self):
        path = os.path.join(FOLDER, "residues.mns")
        subprocess.run([PROGRAM, "export", "blender", samples.UBIQUITIN, "--select", "resi 1-5", "--tolerance", "0.2", "--attributes", "all",
                        "-o", path, "--force", "-q"], check=True, stdout=subprocess.DEVNULL)
        surface = mns_reader.read(path).objects[0]
        item = imported("residues", scale=0.5)
        mesh = item.data
        for name in ("mean_curvature", "gaussian_curvature", "smooth_mean_curvature", "smooth_gaussian_curvature"):
            self.assertEqual((mesh.attributes[name].data_type, mesh.attributes[name].domain), ("FLOAT", "POINT"), name)
            np.testing.assert_array_equal(attributes.read(mesh, name, "FLOAT")[:, 0], surface["mesh." + name], name)  # in 1/Å at any scale
        for name in ("atom_area", "accessible_area", "buried_area"):
            self.assertEqual((mesh.attributes[name].data_type, mesh.attributes[name].domain), ("FLOAT", "POINT"), name)
        self.assertTrue(np.isin(attributes.read(mesh, "atom_area", "FLOAT"), surface["atom.area"]).all())
        self.assertEqual(mesh.attributes["patch_area"].domain, "FACE")
        np.testing.assert_array_equal(attributes.read(mesh, "patch_area", "FLOAT")[:, 0], surface["mesh.patch_area"])
        self.assertEqual(list(item["res_names"]), ["GLN", "ILE", "MET", "PHE", "VAL"])
        residue = np.array(list(item["res_names"]))[attributes.read(mesh, "res_name_id", "INT")[:, 0]]
        number = attributes.read(mesh, "res_id", "INT")[:, 0]
        np.testing.assert_array_equal(residue, np.array(["MET", "GLN", "ILE", "PHE", "VAL"])[number - 1])
        self.assertEqual(len(item["atom_names"]), len(set(surface.header["atom_names"])))
        self.assertTrue({"CURVATURE", "SMOOTH_CURVATURE", "ATOM_AREA", "ACCESSIBLE_AREA", "BURIED_AREA", "RESIDUE"} <= looks.offered(mesh))
        plain = imported("triple")
        self.assertFalse({"SMOOTH_CURVATURE", "BURIED_AREA", "RESIDUE"} & looks.offered(plain.data))

    def test_a_file_without_them_imports_as_before(self):
        """A file of version 0.1.0, without the newer arrays, imports with the same shape and offers fewer
        colourings."""
        with open(path_of("cage"), "rb") as file:
            data = file.read()
        header, _ = samples.header_of(data)
        lacking = ("curvature", "area", "name_id", "entity", "file_index", "charge", "hydrophobicity")
        header["arrays"] = [array for array in header["arrays"] if not array["name"].endswith(lacking)]
        with open(path_of("older"), "wb") as file:
            file.write(samples.with_header(data, header))
        old, new = imported("older").data, imported("cage").data
        np.testing.assert_array_equal(positions(old), positions(new))
        self.assertNotIn("mean_curvature", old.attributes)
        self.assertFalse({"CURVATURE", "ATOM_AREA"} & looks.offered(old))
        self.assertTrue({"CURVATURE", "ATOM_AREA", "ACCESSIBLE_AREA"} <= looks.offered(new))

    def test_opacity(self):
        with open(path_of("triple"), "rb") as file:
            data = file.read()
        for film in (False, True):
            with open(path_of("clear"), "wb") as file:
                file.write(samples.seen_through(data, [0.25, 1.0, 0.5], film))
            surface, mesh = mns_reader.read(path_of("clear")).objects[0], imported("clear").data
            self.assertEqual((mesh.attributes["opacity"].data_type, mesh.attributes["opacity"].domain), ("FLOAT", "FACE"))
            values = np.empty(len(mesh.polygons), dtype=np.float32)
            mesh.attributes["opacity"].data.foreach_get("value", values)
            np.testing.assert_array_equal(values, np.float32([0.25, 1.0, 0.5])[surface["mesh.atom"]])
            for material in mesh.materials:
                shader = materials.shader_of(material)
                self.assertTrue(shader.inputs["Alpha"].is_linked)
                self.assertEqual(any(node.type == "NEW_GEOMETRY" for node in material.node_tree.nodes), film)
        plain = imported("triple").data  # A surface without opacity has a material without a node for it.
        self.assertNotIn("opacity", plain.attributes)
        self.assertFalse(any(materials.shader_of(material).inputs["Alpha"].is_linked for material in plain.materials))
        for wrong in ([0.25, 1.0], [0.5, 0.5, float("nan")], [0.5, 0.5, 1.5]):
            with open(path_of("clear"), "wb") as file:
                file.write(samples.seen_through(data, wrong, False))
            with self.assertRaises(RuntimeError) as caught:
                imported("clear")
            self.assertIn("atom.opacity", str(caught.exception))

    def test_caps_have_a_material_and_colours_of_their_own(self):
        folder = os.path.join(FOLDER, "cut")
        os.makedirs(folder, exist_ok=True)
        path = samples.export(PROGRAM, folder, "cage", "--clip", "z<0.3", "--cap-color", "#ff0000", "--cap-hatching", "0.5",
                              "--opacity", "0.5", "--film-opacity")
        bpy.ops.import_scene.meniscus(filepath=path, scale=1.0)
        mesh = bpy.context.view_layer.objects.active.data
        self.assertEqual([material["meniscus_material"].split()[:2] for material in mesh.materials],
                         [["outer", "film"], ["cavity", "film"], ["cap", "translucent"]])
        surface = mns_reader.read(path).objects[0]
        cap = surface["mesh.kind"] == mns_reader.CAP
        slots, planes = np.empty(len(cap), dtype=np.int32), np.empty(len(cap), dtype=np.int32)
        mesh.polygons.foreach_get("material_index", slots)
        mesh.attributes["ses_cap"].data.foreach_get("value", planes)
        np.testing.assert_array_equal(slots == 2, cap)
        np.testing.assert_array_equal(planes, np.where(cap, 0, -1))
        color = np.empty(4 * len(mesh.loops), dtype=np.float32)
        mesh.attributes["Color"].data.foreach_get("color_srgb", color)
        red = (np.abs(color.reshape(-1, 3, 4) - [1, 0, 0, 1]).max(axis=2) < 0.01).all(axis=1)
        np.testing.assert_array_equal(red, cap)
        normals = samples.corner_normals(mesh).reshape(-1, 3, 3)[cap]
        np.testing.assert_allclose(normals, np.broadcast_to([0, 0, 1], normals.shape), atol=2e-3)
        stripe = np.empty(len(mesh.loops), dtype=np.float32)
        mesh.attributes["cap_stripe"].data.foreach_get("value", stripe)
        across = surface.header["caps"]["hatching"]["across"][0]
        points = positions(mesh)[triangles(mesh)[cap]]
        np.testing.assert_allclose(stripe.reshape(-1, 3)[cap], points @ across / 0.5, atol=1e-4)

    def test_a_scene_keeps_its_camera_and_size_when_asked(self):
        scene = bpy.context.scene
        own = bpy.data.objects.new("own", bpy.data.cameras.new("own"))
        scene.collection.objects.link(own)
        scene.camera, scene.render.resolution_x = own, 1234
        imported("pair", use_camera=False)
        self.assertEqual((scene.camera, scene.render.resolution_x), (own, 1234))
        self.assertEqual(len(bpy.data.cameras), 2)
        imported("pair", import_camera=False)
        self.assertEqual((scene.camera, scene.render.resolution_x, len(bpy.data.cameras)), (own, 1234, 2))
        imported("pair")
        self.assertNotEqual(scene.camera, own)
        self.assertEqual(scene.render.resolution_x, 160)

    def test_what_is_imported_is_selected_and_shows_its_colours(self):
        bpy.ops.wm.read_factory_settings()
        addon_utils.enable("meniscus_import")
        item = imported("pair")
        self.assertEqual([other for other in bpy.context.view_layer.objects if other.select_get()], [item])
        self.assertEqual(bpy.context.view_layer.objects.active, item)
        self.assertEqual(item.data.color_attributes.active_color.name, "Color")
        self.assertEqual({space.shading.color_type for space in build.views_of(bpy.context)} - {"VERTEX"}, set())

    def test_colours_as_they_are_on_request(self):
        view = bpy.context.scene.view_settings
        before = view.view_transform
        imported("pair")
        self.assertEqual(view.view_transform, before)
        imported("pair", standard_view=True)
        self.assertEqual(view.view_transform, "Standard")

    def test_centred_surfaces_of_one_molecule_stay_together(self):
        """A part under the molecule's name lies where the whole does; another molecule lies around its own middle."""
        part = os.path.join(FOLDER, "part.mns")
        subprocess.run([PROGRAM, "export", "blender", os.path.join(FOLDER, "triple.xyzr"), "--select", "index 0 1", "-o", part, "--force", "-q"],
                       check=True, stdout=subprocess.DEVNULL)
        items = [imported(name, center=True, scale=0.5) for name in ("triple", "part", "pair")]
        middles = []
        for name in ("triple", "pair"):
            centers = mns_reader.read(path_of(name)).objects[0]["atom.center"]
            middles.append(0.5 * (centers.min(axis=0) + centers.max(axis=0)))
        for item, name, middle in zip(items, ("triple", "part", "pair"), (middles[0], middles[0], middles[1])):
            surface = mns_reader.read(path_of(name)).objects[0]
            world = np.array([item.matrix_world @ vertex.co for vertex in item.data.vertices])
            there = 0.5 * (surface["mesh.position"] + np.array(surface.header["mesh"]["origin"]) - middle)
            np.testing.assert_allclose(world, there, atol=1e-5, err_msg=name)

    def test_a_material_of_the_user_is_not_taken_for_ours(self):
        theirs = bpy.data.materials.new("Meniscus outer")
        mesh = imported("pair").data
        self.assertNotEqual(mesh.materials[0], theirs)
        shader = materials.shader_of(mesh.materials[0])
        self.assertTrue(shader.inputs["Base Color"].is_linked)
        # A material that an earlier version of the add-on made without a mark is taken for ours.
        del mesh.materials[0]["meniscus_material"]
        bpy.data.materials.remove(theirs)
        mesh.materials[0].name = "Meniscus outer"
        self.assertEqual(imported("pair").data.materials[0], mesh.materials[0])

    def test_an_import_has_materials_of_its_own_on_request(self):
        shared = imported("pair").data.materials[0]
        own = [imported("pair", own_materials=True).data.materials[0] for _ in range(2)]
        self.assertEqual(len({shared, *own}), 3)
        self.assertEqual(imported("pair").data.materials[0], shared)

    def test_a_new_material_shows_its_colour(self):
        material = imported("pair").data.materials[0]
        output = next(node for node in material.node_tree.nodes if node.type == "OUTPUT_MATERIAL")
        shader = output.inputs["Surface"].links[0].from_node
        self.assertEqual(shader.type, "BSDF_PRINCIPLED")
        self.assertEqual(shader.inputs["Base Color"].links[0].from_node.attribute_name, "Color")

    def test_cavities_apart(self):
        whole = imported("cage", scale=1.0).data
        before = set(bpy.data.objects)
        self.assertEqual(bpy.ops.import_scene.meniscus(filepath=path_of("cage"), scale=1.0, parts=True), {"FINISHED"})
        items = {item["meniscus_part"]: item for item in set(bpy.data.objects) - before if item.type == "MESH"}
        self.assertEqual(set(items), {"outer", "cavities"})
        self.assertEqual(sum(len(item.data.polygons) for item in items.values()), len(whole.polygons))
        volumes = {}
        for role, item in items.items():
            mesh = item.data
            self.assertTrue(mns_reader.is_closed(triangles(mesh)))
            volumes[role] = samples.signed_volume(positions(mesh), triangles(mesh))
            self.assertAlmostEqual(volumes[role] / item["meniscus_volume"], 1.0, delta=0.01)
        self.assertGreater(volumes["outer"], 0.0)
        self.assertLess(volumes["cavities"], 0.0)
        self.assertAlmostEqual(sum(volumes.values()), samples.signed_volume(positions(whole), triangles(whole)), places=2)
        normals = {role: samples.corner_normals(item.data) for role, item in items.items()}
        together = samples.corner_normals(whole)
        outer = np.repeat(np.array([p.material_index == 0 for p in whole.polygons]), 3)
        np.testing.assert_allclose(normals["outer"], together[outer], atol=2e-3)
        np.testing.assert_allclose(normals["cavities"], together[~outer], atol=2e-3)

    def dress(self, item):
        """Gives the object a parent, a collection, a constraint, keys and properties, as dressing_of describes them."""
        scene = bpy.context.scene
        item.parent = bpy.data.objects.new("stand", None)
        mine = bpy.data.collections.new("mine")
        scene.collection.objects.link(item.parent)
        scene.collection.children.link(mine)
        mine.objects.link(item)
        item.constraints.new("LIMIT_SCALE")
        item["note"], item.data["note"], item.pass_index = "object", "mesh", 7
        for owner, path in ((item, "location"), (item.data, '["heat"]')):
            owner["heat"] = 0.5
            owner.keyframe_insert(path, frame=12)
        return self.dressing_of(item)

    def dressing_of(self, item):
        mesh = item.data
        return (item.parent.name, sorted(each.name for each in item.users_collection), item.constraints.keys(), item["note"], mesh["note"],
                item.pass_index, item.animation_data.action.name, mesh.animation_data.action.name, mesh["heat"], len(mesh.materials))

    def test_reload_in_place(self):
        shutil.copy(path_of("triple"), path_of("changing"))
        item = imported("changing", scale=0.5, center=True)
        twin = item.copy()
        bpy.context.scene.collection.objects.link(twin)
        place, material = item.matrix_world.copy(), bpy.data.materials.new("mine")
        item.data.materials[0] = material
        item.modifiers.new("mine", "DECIMATE")
        dressing = self.dress(item)
        mask = item.data.attributes.new("mask", "FLOAT", "FACE")
        values = np.empty(len(item.data.polygons), dtype=np.int32)
        item.data.attributes["atom_index"].data.foreach_get("value", values)
        mask.data.foreach_set("value", values.astype(np.float32) + 1.0)
        shutil.copy(samples.export(PROGRAM, FOLDER, "triple", "--size", "160x120", "--tolerance", "0.05"), path_of("changing"))
        count, name = len(item.data.polygons), item.data.name
        try:
            bpy.context.view_layer.objects.active = item
            self.assertEqual(bpy.ops.object.meniscus_reload(), {"FINISHED"})
            self.assertLess(len(item.data.polygons), 0.5 * count)
            self.assertEqual((item.data, item.data.name, item.matrix_world), (twin.data, name, place))
            self.assertEqual((item.data.materials[0], list(item.modifiers.keys())), (material, ["mine"]))
            self.assertEqual(self.dressing_of(item), dressing)
            kept, atoms = (np.empty(len(item.data.polygons), dtype=kind) for kind in (np.float32, np.int32))
            item.data.attributes["mask"].data.foreach_get("value", kept)
            item.data.attributes["atom_index"].data.foreach_get("value", atoms)
            np.testing.assert_array_equal(kept, atoms + 1.0)
            before = everything()
            with open(path_of("changing"), "r+b") as file:
                file.truncate(1000)
            with self.assertRaises(RuntimeError):
                bpy.ops.object.meniscus_reload()
            self.assertEqual(everything(), before)
            self.assertGreater(len(item.data.polygons), 100)
        finally:
            samples.export(PROGRAM, FOLDER, "triple", "--size", "160x120", "--tolerance", "0.004")

    def test_normals_are_exact_where_smooth_and_at_cusps(self):
        for name in ("triple", "drops", "cage"):
            surface = mns_reader.read(path_of(name)).objects[0]
            mesh = imported(name).data
            wanted = surface["mesh.normal"][surface["mesh.triangle"].ravel()].copy()
            wanted[surface["mesh.sharp_corner"]] = surface["mesh.sharp_corner_normal"]
            cosine = np.clip((samples.corner_normals(mesh) * wanted).sum(axis=1), -1, 1)
            angle = np.degrees(np.arccos(cosine))
            self.assertLess(np.mean(angle), 0.05)
            self.assertLess(np.percentile(angle, 99), 0.25)
            flat = np.repeat(np.array([p.normal for p in mesh.polygons]), 3, axis=0)
            self.assertGreater(np.degrees(np.arccos(np.clip((flat * wanted).sum(axis=1), -1, 1))).mean(), 0.3)

    def test_a_bad_file_says_why_and_leaves_nothing(self):
        with open(path_of("triple"), "rb") as file:
            good = file.read()
        before = everything()
        for name, (data, word) in samples.damaged_files(good).items():
            with open(path_of("bad"), "wb") as file:
                file.write(data)
            with self.assertRaises(RuntimeError, msg=name) as caught:
                bpy.ops.import_scene.meniscus(filepath=path_of("bad"))
            self.assertIn(word, str(caught.exception), name)
            self.assertEqual(everything(), before, name)
        with self.assertRaises(RuntimeError):
            bpy.ops.import_scene.meniscus(filepath=path_of("no_such_file"))
        self.assertEqual(everything(), before)

    def test_a_failure_half_way_leaves_nothing(self):
        before = everything()
        for module, step in ((attributes, "add"), (compat, "set_normals"), (build, "place_camera")):
            with mock.patch.object(module, step, side_effect=MemoryError(step)):
                with self.assertRaises(MemoryError):
                    build.import_file(path_of("triple"))
            self.assertEqual(everything(), before, step)

    def test_a_second_import_reuses_materials_and_gets_its_own_collection(self):
        imported("pair")
        bpy.data.materials["Meniscus outer"].diffuse_color = (1, 0, 0, 1)
        imported("pair")
        self.assertEqual(len([m for m in bpy.data.materials if m.name.startswith("Meniscus outer")]), 1)
        self.assertEqual(tuple(bpy.data.materials["Meniscus outer"].diffuse_color), (1, 0, 0, 1))
        self.assertEqual(len([c for c in bpy.data.collections if c.name.startswith("pair")]), 2)

    def test_copies_share_their_mesh_and_stand_where_they_should(self):
        with open(path_of("triple"), "rb") as file:
            data = file.read()
        with open(path_of("two"), "wb") as file:
            file.write(samples.as_two_objects(data))
        made = build.import_file(path_of("two"), scale=0.5)
        self.assertEqual([item.name for item in made.surfaces], ["two.A", "two.A.001", "two.B"])
        self.assertEqual(made.surfaces[0].data, made.surfaces[1].data)
        self.assertNotEqual(made.surfaces[0].data, made.surfaces[2].data)
        local = positions(made.surfaces[0].data)
        placed = np.array([made.surfaces[1].matrix_world @ v.co for v in made.surfaces[1].data.vertices])
        wanted = np.stack([-local[:, 1] + 5.0, local[:, 0] + 10.0, local[:, 2] + 15.0], axis=1)
        np.testing.assert_allclose(placed, wanted, atol=1e-5)
        self.assertEqual(made.surfaces[0].matrix_world, mathutils.Matrix.Identity(4))

    def test_version_1_files_still_import(self):
        with open(path_of("cage"), "rb") as file:
            data = file.read()
        with open(path_of("old"), "wb") as file:
            file.write(samples.as_version_1(data))
        old, new = imported("old").data, imported("cage").data
        np.testing.assert_array_equal(positions(old), positions(new))
        for name in ("atom_index", "ses_kind"):
            values = [np.empty(len(mesh.polygons), dtype=np.int32) for mesh in (old, new)]
            for mesh, found in zip((old, new), values):
                mesh.attributes[name].data.foreach_get("value", found)
            np.testing.assert_array_equal(*values)

    def test_register_twice(self):
        for _ in range(2):
            addon_utils.disable("meniscus_import")
            self.assertFalse(hasattr(bpy.types, "IMPORT_SCENE_OT_meniscus"))
            addon_utils.enable("meniscus_import")
            self.assertTrue(hasattr(bpy.types, "IMPORT_SCENE_OT_meniscus"))

    def test_the_driver_renders_and_has_true_exit_codes(self):
        def drive(*arguments):
            command = [BLENDER, "-b", "--factory-startup", "--python-exit-code", "3", "--python",
                       os.path.join(ADDON, "render_mns.py"), "--", *arguments]
            return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False).returncode

        picture, passes = os.path.join(FOLDER, "triple.png"), os.path.join(FOLDER, "triple.exr")
        self.assertEqual(drive(path_of("triple"), "--output", picture, "--passes", passes, "--samples", "4"), 0)
        self.assertGreater(os.path.getsize(picture), 1000)
        self.assertGreater(os.path.getsize(passes), 1000)
        self.assertEqual(drive(path_of("triple")), 2)
        self.assertEqual(drive(path_of("no_such_file"), "--output", picture), 3)
        self.assertEqual(drive(path_of("triple"), "--output", picture, "--camera", path_of("triple")), 3)


if not unittest.main(argv=["inside_blender"], exit=False).result.wasSuccessful():
    sys.exit(1)
