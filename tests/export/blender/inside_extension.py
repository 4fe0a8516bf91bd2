# SPDX-License-Identifier: BSD-3-Clause
"""The extension in an empty profile, installed by Blender itself: arguments EXTENSION.zip MOLECULE AREA PICTURE.png.
MOLECULE: a file of 1TII. AREA: Å² of its surface, as the program says; nothing here finds the program."""

import os
import shutil
import sys
import unittest

import bpy

EXTENSION, MOLECULE, AREA, PICTURE = sys.argv[sys.argv.index("--") + 1:]
NAME = "bl_ext.user_default.meniscus_import"


class Extension(unittest.TestCase):
    def test_it_computes_at_once(self):
        self.assertIsNone(shutil.which("meniscus"))
        self.assertEqual([name for name in os.environ if name.startswith("MENISCUS_")], [])
        profile = os.environ["BLENDER_USER_RESOURCES"]
        self.assertEqual(bpy.ops.extensions.package_install_files(filepath=EXTENSION, repo="user_default", enable_on_install=True), {"FINISHED"})
        self.assertIn(NAME, bpy.context.preferences.addons)
        computed = sys.modules[NAME + ".computed"]
        told = computed.working().describe_tools()
        self.assertTrue(told["library"].startswith(profile), told)
        self.assertEqual(told["program"], "")

        bpy.ops.wm.read_homefile(use_empty=True, load_ui=False)
        self.assertEqual(bpy.ops.object.meniscus_from_file(filepath=MOLECULE, wait=True, detail="FINE"), {"FINISHED"})
        item = bpy.context.view_layer.objects.active
        self.assertAlmostEqual(item["meniscus_area"] / float(AREA), 1.0, places=9)  # Another compiler rounds differently.
        item.meniscus.color = "chain"
        self.assertEqual(bpy.ops.object.meniscus_update(wait=True), {"FINISHED"})
        self.render(item)

        item.meniscus.is_run, item.meniscus.trajectory = True, MOLECULE
        with self.assertRaisesRegex(RuntimeError, "a trajectory needs the program meniscus"):
            bpy.ops.object.meniscus_update(wait=True)

        repository = [each.module for each in bpy.context.preferences.extensions.repos].index("user_default")
        self.assertEqual(bpy.ops.extensions.package_uninstall(repo_index=repository, pkg_id="meniscus_import"), {"FINISHED"})
        self.assertFalse([name for _, _, names in os.walk(profile) for name in names if "libmeniscus" in name])

    def render(self, item):
        scene = bpy.context.scene
        for data, place in ((bpy.data.cameras.new("camera"), (0.0, -20.0, 0.0)), (bpy.data.lights.new("sun", "SUN"), (0.0, 0.0, 0.0))):
            made = bpy.data.objects.new(data.name, data)
            made.location, made.rotation_euler = place, (1.3 if data.name == "camera" else 0.8, 0.0, 0.3)
            scene.collection.objects.link(made)
        scene.camera = bpy.data.objects["camera"]
        scene.camera.rotation_euler = (1.5708, 0.0, 0.0)
        bpy.data.lights["sun"].energy = 3.0
        scene.world = scene.world or bpy.data.worlds.new("world")
        scene.world.color = (0.4, 0.4, 0.4)
        scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 16, False
        scene.render.resolution_x, scene.render.resolution_y, scene.render.filepath = 320, 240, PICTURE
        bpy.ops.render.render(write_still=True)
        self.assertGreater(os.path.getsize(PICTURE), 20_000)  # An empty picture is far smaller.


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
