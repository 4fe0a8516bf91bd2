# SPDX-License-Identifier: BSD-3-Clause
"""Blender itself hands on each frame of a bake, of a stream and of a run in the panel to modifiers, Alembic and USD."""

import collections
import json
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

from meniscus_import import computed, sequence, sequence_reader  # noqa: E402

MANIFEST = os.path.join(FOLDER, "run", "surface_sequence.json")
FRAMES = (1, 2, 3)


def anew():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    addon_utils.enable("meniscus_import", default_set=True)


def of_panel(path):
    """Makes the manifest's run by computing it in Blender."""
    preferences = bpy.context.preferences.addons[computed.__package__].preferences
    preferences.package, preferences.program = os.environ["MENISCUS_PACKAGE"], PROGRAM
    bpy.ops.object.meniscus_from_file(filepath=samples.UBIQUITIN, selection="resi 1-15", is_run=True, wait=True)
    item = bpy.context.view_layer.objects.active
    item.meniscus.frames = "1-5:2"
    bpy.ops.object.meniscus_update(wait=True)
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = FRAMES[0], FRAMES[-1]
    return item


#: Ways that bring a run into a scene.
WAYS = {"bake": sequence.bake, "stream": sequence.stream, "panel": of_panel}


def scene_of(way):
    """Returns the run's object in an empty scene."""
    anew()
    return WAYS[way](MANIFEST)


def shown(item, time):
    """Returns the object's own mesh at a time."""
    bpy.context.scene.frame_set(time)
    return item.evaluated_get(bpy.context.evaluated_depsgraph_get()).data


def positions_of(mesh):
    values = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", values)
    return values.reshape(-1, 3)


def triangles_of(mesh):
    mesh.calc_loop_triangles()
    corners = np.empty(3 * len(mesh.loop_triangles), dtype=np.int32)
    mesh.loop_triangles.foreach_get("vertices", corners)
    return corners.reshape(-1, 3)


def area_of(points, triangles):
    a, b, c = (points[triangles[:, k]].astype(float) for k in range(3))
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)


def measures_of(item):
    """Returns triangles and area at each time, measured in the scene."""
    rows = []
    for time in FRAMES:
        mesh = shown(item, time)
        scale = abs(item.matrix_world.determinant()) ** (2 / 3)
        rows.append((len(mesh.polygons), area_of(positions_of(mesh), triangles_of(mesh)) * scale))
    return rows


def open_edges(mesh):
    """Returns how many edges lack a second face."""
    counts = collections.Counter(edge for face in mesh.polygons for edge in face.edge_keys)
    return sum(count != 2 for count in counts.values())


def half_box(item):
    """Makes a box that holds one half of the object."""
    corners = [(x, y, z) for x in (0.0, 9.0) for y in (-9.0, 9.0) for z in (-9.0, 9.0)]
    mesh = bpy.data.meshes.new("box")
    mesh.from_pydata(corners, [], [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])
    box = bpy.data.objects.new("box", mesh)
    bpy.context.scene.collection.objects.link(box)
    box.location = item.matrix_world @ mathutils.Vector(positions_of(shown(item, 1)).mean(axis=0).tolist())
    bpy.context.view_layer.update()
    return box


def world_normals(item):
    """Returns the normals at the corners of the object's evaluated mesh, turned into the scene."""
    item = item.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return samples.corner_normals(item.data) @ np.array(item.matrix_world.to_3x3().normalized()).T


class HandedOn(unittest.TestCase):
    def setUp(self):
        self.folder = os.path.join(FOLDER, self.id())
        os.makedirs(self.folder)
        self.counts = [sequence_reader.read(MANIFEST).read(place).objects[0].triangle_count for place in FRAMES]

    def test_modifiers_act_on_every_frame(self):
        """Decimate and Boolean give each frame another closed mesh of the right size."""
        for way in WAYS:
            item = scene_of(way)
            fewer, cut = item.modifiers.new("Fewer", "DECIMATE"), item.modifiers.new("Cut", "BOOLEAN")
            fewer.show_viewport = cut.show_viewport = False
            fewer.ratio, cut.object, cut.solver = 0.3, half_box(item), "EXACT"
            found = {}
            for chosen in ("whole", "Fewer", "DIFFERENCE", "INTERSECT"):
                fewer.show_viewport, cut.show_viewport = chosen == "Fewer", chosen in ("DIFFERENCE", "INTERSECT")
                if cut.show_viewport:
                    cut.operation = chosen
                rows = []
                for time in FRAMES:
                    mesh = shown(item, time)
                    self.assertEqual(open_edges(mesh), 0, f"{way} {chosen} {time}")
                    rows.append((len(mesh.polygons), samples.signed_volume(positions_of(mesh), triangles_of(mesh))))
                self.assertEqual(len({volume for _, volume in rows}), len(FRAMES), f"{way} {chosen}")
                found[chosen] = rows
            self.assertEqual([count for count, _ in found["whole"]], self.counts, way)
            for place, (count, volume) in enumerate(found["whole"]):
                text = f"{way} {place}"
                self.assertAlmostEqual(found["Fewer"][place][0] / count, 0.3, delta=0.02, msg=text)
                self.assertAlmostEqual(found["Fewer"][place][1] / volume, 1.0, delta=0.02, msg=text)
                halves = [found[operation][place][1] for operation in ("DIFFERENCE", "INTERSECT")]
                self.assertAlmostEqual(sum(halves) / volume, 1.0, delta=1e-3, msg=text)
                self.assertGreater(min(halves), 0.2 * volume, text)

    def test_other_programs_get_every_frame(self):
        """Alembic and USD files are read by Blender and by their own libraries. Debian's Blender has neither format."""
        kinds = [kind for kind in ("alembic", "usd") if f"{kind}_export" in dir(bpy.ops.wm)]
        if not kinds:
            self.skipTest("this Blender writes neither Alembic nor USD")
        for way in WAYS:
            for kind in kinds:
                text = f"{way} {kind}"
                item = scene_of(way)
                measures = measures_of(item)
                self.assertEqual([count for count, _ in measures], self.counts, text)
                bpy.context.scene.frame_set(2)
                normals = world_normals(item)
                path = os.path.join(self.folder, f"{way}.{'abc' if kind == 'alembic' else 'usdc'}")
                frames = {"start": FRAMES[0], "end": FRAMES[-1]} if kind == "alembic" else {"export_animation": True}
                getattr(bpy.ops.wm, kind + "_export")(filepath=path, **frames)
                self.check_by_its_library(path, measures)
                bpy.ops.wm.read_factory_settings(use_empty=True)
                getattr(bpy.ops.wm, kind + "_import")(filepath=path)
                (back,) = (each for each in bpy.data.objects if each.type == "MESH")
                bpy.context.view_layer.update()
                for (count, area), (wanted_count, wanted_area) in zip(measures_of(back), measures):
                    self.assertEqual(count, wanted_count, text)
                    self.assertAlmostEqual(area / wanted_area, 1.0, places=4, msg=text)
                bpy.context.scene.frame_set(2)
                cosines = (world_normals(back) * normals).sum(axis=1)  # Blender keeps normals to some tenths of a degree
                self.assertGreater(cosines.min(), np.cos(np.radians(1.0)), text)
                found = set(back.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.attributes.keys())
                wanted = {"velocity"} if way != "panel" else set()
                if kind == "usd":
                    wanted |= {"mean_curvature", "atom_area", "res_name_id"}
                self.assertLessEqual(wanted, found, text)

    def check_by_its_library(self, path, measures):
        """Checks triangles and area at each time by MENISCUS_READERS, a Python with usd-core and alembic3d."""
        fps = bpy.context.scene.render.fps / bpy.context.scene.render.fps_base
        words = [os.environ["MENISCUS_READERS"], os.path.join(HERE, "read_frames.py"), path, str(fps), *map(str, FRAMES)]
        found = subprocess.run(words, check=True, stdout=subprocess.PIPE, text=True, env={"PATH": os.environ["PATH"]}).stdout
        for (count, area), (wanted_count, wanted_area) in zip(json.loads(found), measures, strict=True):
            self.assertEqual(count, wanted_count, path)
            self.assertAlmostEqual(area / wanted_area, 1.0, places=4, msg=path)


if not unittest.main(argv=["inside_handed_on"], exit=False).result.wasSuccessful():
    sys.exit(1)
