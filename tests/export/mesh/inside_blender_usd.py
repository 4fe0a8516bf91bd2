# SPDX-License-Identifier: BSD-3-Clause
"""Inside Blender, newer than Debian's: imports USD files of PROGRAM, and finds frame by frame the triangles, the area, the box
and the colours of PLY files."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import bpy
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from mesh_readers_test import positions_of, read_ply  # noqa: E402

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

    def test_every_frame_is_its_own(self):
        for name in ("run.usda", "run.usdz"):
            item = self.imported(name)
            self.assertEqual((bpy.context.scene.frame_start, bpy.context.scene.frame_end), (1, 5))
            for frame in range(5):
                bpy.context.scene.frame_set(frame + 1)
                shown = item.evaluated_get(bpy.context.evaluated_depsgraph_get())
                mesh = shown.data
                points = np.empty(3 * len(mesh.vertices), dtype=np.float32)
                mesh.vertices.foreach_get("co", points)
                points = points.reshape(-1, 3)
                corners = np.empty(len(mesh.loops), dtype=np.int32)
                mesh.loops.foreach_get("vertex_index", corners)
                corners = corners.reshape(-1, 3)
                vertices, triangles = read_ply(self.folder / f"run_{frame}.ply")
                wanted = 0.1 * positions_of(vertices)
                self.assertEqual(len(points), len(wanted))
                self.assertEqual(len(mesh.polygons), len(triangles))
                np.testing.assert_allclose(points, wanted, atol=1e-5)
                self.assertAlmostEqual(area_of(points, corners), area_of(wanted, triangles), delta=1e-4)
                # y is up in the file, z in Blender
                placed = points @ np.array(shown.matrix_world.to_3x3()).T
                turned = np.stack([wanted[:, 0], -wanted[:, 2], wanted[:, 1]], axis=1)
                np.testing.assert_allclose(placed, turned, atol=1e-4)
                print(f"{name}, frame {frame + 1}: {len(points)} vertices, area {100 * area_of(points, corners):.2f} Å²")
                if frame == 0:
                    self.check_colors(mesh, vertices)

    def check_colors(self, mesh, vertices):
        layer = mesh.color_attributes["displayColor"]
        self.assertEqual(layer.domain, "POINT")
        colors = np.empty(4 * len(layer.data), dtype=np.float32)
        layer.data.foreach_get("color_srgb", colors)
        wanted = np.stack([vertices[c] for c in ("red", "green", "blue")], axis=1) / 255
        np.testing.assert_allclose(colors.reshape(-1, 4)[:, :3], wanted, atol=0.003)
        self.assertIn("b_factor", mesh.attributes)


unittest.main(argv=["inside_blender_usd"], verbosity=2)
