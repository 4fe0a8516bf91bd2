# SPDX-License-Identifier: BSD-3-Clause
"""Inside Blender, newer than Debian's: imports USD files of PROGRAM and compares triangles, area, box and colours frame
by frame with PLY files, also in Alembic that Blender makes of one; copies share a mesh and a material with its
colours."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import bpy
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from mesh_readers_test import COPIES, positions_of, read_ply, write_capsid  # noqa: E402

PROGRAM = sys.argv[sys.argv.index("--") + 1]
RUN = ["/usr/share/freesasa/test-data/1d3z.pdb", "--frames", "0-4", "--density", "0.5", "--color", "residue", "--device", "cpu",
       "-q"]


def area_of(points, triangles):
    a, b, c = (points[triangles[:, k]].astype(float) for k in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


class Usd(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.room = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.room.name)
        for name, words in (("run_#.ply", ()), ("run.usda", ("--scale", "0.1")), ("run.usdz", ("--scale", "0.1"))):
            subprocess.run([PROGRAM, "export", "mesh", *RUN, *words, "-o", str(cls.folder / name)], check=True,
                           stdout=subprocess.DEVNULL)

    @classmethod
    def tearDownClass(cls):
        cls.room.cleanup()

    def imported(self, name):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.ops.wm.usd_import(filepath=str(self.folder / name))
        item, = (each for each in bpy.context.scene.objects if each.type == "MESH")
        return item

    def check_frames(self, item):
        """Checks that the object shows the PLY file of each frame at its time of the scene, upright."""
        for frame in range(5):
            bpy.context.scene.frame_set(frame + 1)
            shown = item.evaluated_get(bpy.context.evaluated_depsgraph_get())
            mesh = shown.data
            points = np.empty(3 * len(mesh.vertices), dtype=np.float32)
            mesh.vertices.foreach_get("co", points)
            points = points.reshape(-1, 3)
            corners = np.empty(len(mesh.loops), dtype=np.int32)
            mesh.loops.foreach_get("vertex_index", corners)
            vertices, triangles = read_ply(self.folder / f"run_{frame}.ply")
            wanted = 0.1 * positions_of(vertices)
            self.assertEqual(len(points), len(wanted))
            self.assertEqual(len(mesh.polygons), len(triangles))
            area = area_of(points, corners.reshape(-1, 3))
            self.assertAlmostEqual(area, area_of(wanted, triangles), delta=1e-4)
            # y is up in the file, z in Blender
            placed = points @ np.array(shown.matrix_world.to_3x3()).T
            upright = np.stack([wanted[:, 0], -wanted[:, 2], wanted[:, 1]], axis=1)
            for end in (np.min, np.max):
                np.testing.assert_allclose(end(placed, axis=0), end(upright, axis=0), atol=1e-4)
            print(f"frame {frame + 1}: {len(points)} vertices, {len(triangles)} triangles, {100 * area:.2f} Å²")

    def test_every_frame_is_its_own(self):
        for name in ("run.usda", "run.usdz"):
            item = self.imported(name)
            self.assertEqual((bpy.context.scene.frame_start, bpy.context.scene.frame_end), (1, 5))
            self.check_frames(item)
            bpy.context.scene.frame_set(1)
            self.check_colors(item.evaluated_get(bpy.context.evaluated_depsgraph_get()).data,
                              read_ply(self.folder / "run_0.ply")[0])

    def test_copies_are_instances_of_one_mesh_with_its_colors(self):
        places = write_capsid(self.folder / "capsid.pdb")
        for ending in ("usda", "glb"):
            path = str(self.folder / f"copies.{ending}")
            subprocess.run([PROGRAM, "export", "mesh", str(self.folder / "capsid.pdb"), *COPIES, "--density", "0.5", "--color",
                            "residue", "--device", "cpu", "-q", "-o", path], check=True, stdout=subprocess.DEVNULL)
            bpy.ops.wm.read_factory_settings(use_empty=True)
            if ending == "usda":
                bpy.ops.wm.usd_import(filepath=path)
            else:
                bpy.ops.import_scene.gltf(filepath=path)
            mesh, = bpy.data.meshes
            shown = [each.matrix_world.copy() for each in bpy.context.evaluated_depsgraph_get().object_instances
                     if each.object.type == "MESH"]
            found = np.array(sorted(np.array(m)[:3, 3].tolist() for m in shown))
            x, y, z = places[:, :3, 3].T
            wanted = np.array(sorted(np.stack([x, -z, y], axis=1).tolist()))
            np.testing.assert_allclose(found, wanted, atol=1e-4, err_msg=ending)
            if ending == "usda" and bpy.app.version >= (4, 5):  # Blender 4.2 does not read this primvar.
                tree = mesh.materials[0].node_tree
                link, = (each for each in tree.links if each.to_socket.name == "Base Color")
                self.assertEqual(link.from_node.attribute_name, "displayColor")

    def test_alembic_that_blender_makes_of_it_moves(self):
        self.imported("run.usda")
        path = str(self.folder / "run.abc")
        bpy.ops.wm.alembic_export(filepath=path, start=1, end=5)
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.ops.wm.alembic_import(filepath=path)
        item, = (each for each in bpy.context.scene.objects if each.type == "MESH")
        self.check_frames(item)

    def check_colors(self, mesh, vertices):
        layer = mesh.color_attributes["displayColor"]
        self.assertEqual(layer.domain, "POINT")
        colors = np.empty(4 * len(layer.data), dtype=np.float32)
        layer.data.foreach_get("color_srgb", colors)
        wanted = np.stack([vertices[c] for c in ("red", "green", "blue")], axis=1) / 255
        np.testing.assert_allclose(colors.reshape(-1, 4)[:, :3], wanted, atol=0.003)
        self.assertIn("b_factor", mesh.attributes)


unittest.main(argv=["inside_blender_usd"], verbosity=2)
