# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces that Blender computes itself: fields that prepare molecules and runs, proxies in motion, fine meshes at rest."""

import os
import sys
import unittest
import unittest.mock

import bpy
import numpy as np

sys.path.insert(0, sys.argv[sys.argv.index("--") + 3])
import samples  # noqa: E402
from computed_case import FOLDER, TRIPLE, UBIQUITIN, ComputedCase, measures, of_file, positions, update, wanted  # noqa: E402
from meniscus_import import compat, computed, motion  # noqa: E402
from meniscus_import.computing import preparation  # noqa: E402


class Prepared(ComputedCase):
    def test_fields_are_rows_of_the_table(self):
        fields = of_file().meniscus.bl_rna.properties
        for row in preparation.ROWS:
            field = fields[preparation.name_of(row)]
            self.assertEqual((field.name, field.description.startswith(row.help)), (preparation.label_of(row), True), row.key)
            self.assertEqual(field.default, preparation.default_of(row), row.key)
            if row.type == "word":
                self.assertEqual(tuple(each.identifier for each in field.enum_items), row.words)
            if row.type == "count":
                self.assertEqual((field.hard_min, field.hard_max), (row.lowest, row.highest))

    def test_a_molecule_is_prepared(self):
        item = of_file(UBIQUITIN, selection="resi 1-20")
        self.assertEqual(measures(item), wanted(UBIQUITIN, "--select", "resi 1-20")[0])
        item.meniscus.selection, item.meniscus.keep_water, item.meniscus.radii = "resi 1-80", True, "united"
        update()
        self.assertEqual(measures(item), wanted(UBIQUITIN, "--select", "resi 1-80", "--keep-water", "--radii", "united")[0])
        item.meniscus.radii = "none"
        with self.assertRaisesRegex(RuntimeError, "(?i)radii"):
            update()

    def test_a_run_is_superposed(self):
        scene = bpy.context.scene
        item = of_file(samples.UBIQUITIN, selection="resi 1-15", is_run=True, center=False)
        found = {}
        for atoms in ("", "name CA"):
            item.meniscus.superpose = atoms
            update()
            middles = []
            for frame in range(1, 5):
                scene.frame_set(frame)
                self.assertEqual(item.get("meniscus_error", ""), "")
                middles.append(positions(item.data).mean(axis=0) / item.meniscus.scale)
            found[atoms] = float(np.linalg.norm(np.diff(middles, axis=0), axis=1).max())
        print(f"middle of the surface moves by {found} Å")
        self.assertLess(found["name CA"], 0.5 * found[""])

    def test_a_fine_mesh_follows_a_proxy_when_nothing_moves(self):
        item = of_file(TRIPLE, detail="AUTO")
        fine = len(item.data.polygons)
        self.assertEqual(fine, len(of_file(TRIPLE, detail="FINE").data.polygons))
        item.meniscus.probe = 2.0
        with unittest.mock.patch.object(motion, "REST", 1e6):
            computed.update_in_background(item, in_motion=True)
        computed.wait()
        proxy = len(item.data.polygons)
        self.assertEqual(measures(item), wanted(TRIPLE, "--probe", "2")[0])
        self.assertLess(2 * proxy, fine)
        computed._come_to_rest()  # This call comes too early to compute anything.
        self.assertFalse(computed.working().is_busy())
        with unittest.mock.patch.object(motion, "REST", 0.0):
            motion.moves(compat.identity(item))
        with unittest.mock.patch.object(motion, "is_playing", return_value=True):
            computed._come_to_rest()
        self.assertFalse(computed.working().is_busy())
        computed._come_to_rest()
        computed.wait()
        self.assertGreater(len(item.data.polygons), 2 * proxy)
        self.assertFalse(motion.any_moves())
        item.meniscus.probe = 1.4  # The fine mesh for this probe is kept.
        computed.update_in_background(item, in_motion=True)
        self.assertEqual(len(item.data.polygons), fine)
        item.meniscus.probe = 1.7
        computed.update_in_background(item, in_motion=True)
        computed.wait()
        self.assertLess(2 * len(item.data.polygons), fine)
        scene = bpy.context.scene
        scene.camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
        scene.collection.objects.link(scene.camera)
        scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 1, False
        scene.render.resolution_x = scene.render.resolution_y = 8
        bpy.ops.render.render()
        self.assertGreater(len(item.data.polygons), 2 * proxy)
        item.meniscus.detail, item.meniscus.probe = "FINE", 1.9
        computed.update_in_background(item, in_motion=True)
        self.assertFalse(motion.is_moving(compat.identity(item)))

    def test_frames_that_play_are_proxies_and_pictures_are_not(self):
        item = of_file(samples.UBIQUITIN, detail="AUTO", selection="resi 1-15", is_run=True)
        counts = []
        for frame, plays in ((2, False), (3, True), (4, False)):
            with unittest.mock.patch.object(motion, "is_playing", return_value=plays):
                bpy.context.scene.frame_set(frame)
            self.assertEqual(item["meniscus_error"], "")
            counts.append(len(item.data.polygons))
        self.assertLess(2 * counts[1], min(counts[0], counts[2]))
        self.assertFalse(motion.is_moving(compat.identity(item)))

    def test_solid_views_show_the_colours(self):
        """Solid views that show a colour of the user's choice stay."""
        views = [area.spaces.active.shading for window in bpy.context.window_manager.windows for area in window.screen.areas
                 if area.type == "VIEW_3D"]
        if not views:
            self.skipTest("there is no view")
        for before, after in (("MATERIAL", "VERTEX"), ("RANDOM", "RANDOM")):
            for make in (of_file, lambda: bpy.ops.import_scene.meniscus(filepath=os.path.join(FOLDER, "pair.mns"))):
                for shading in views:
                    shading.color_type = before
                make()
                self.assertEqual({shading.color_type for shading in views}, {after})


if not unittest.main(argv=["inside_prepared"], exit=False).result.wasSuccessful():
    sys.exit(1)
