# SPDX-License-Identifier: BSD-3-Clause
"""One shot with a linked, an overridden, a duplicated and a renamed run side by side, rendered: each shows its own frame and settings.
The picture stays where MENISCUS_SHOT says."""

import os
import sys
import unittest

import bpy
import mathutils
import numpy as np

sys.path.insert(0, sys.argv[sys.argv.index("--") + 3])
from computed_case import FOLDER, ComputedCase, of_file, start_anew, update  # noqa: E402
import samples  # noqa: E402

from meniscus_import import compat  # noqa: E402

PICTURE = os.environ.get("MENISCUS_SHOT", os.path.join(FOLDER, "shot.png"))
APART = 2.4
SIZE = (640, 200)


def run(name):
    item = of_file(samples.UBIQUITIN, "PROXY", selection="resi 1-15", is_run=True, center=False)
    item.meniscus.density, item.meniscus.color = 4.0, "residue"
    assert update() == {"FINISHED"}
    item.name = name
    return item


def place(item, column):
    item.location.x += APART * column
    return item


def linked(library):
    with bpy.data.libraries.load(library, link=True) as (_there, found):
        found.objects = ["run"]
    bpy.context.scene.collection.objects.link(found.objects[0])
    return found.objects[0]


def render(items):
    scene = bpy.context.scene
    corners = np.array([item.matrix_world @ mathutils.Vector(corner) for item in items for corner in item.bound_box])
    low, high = corners.min(axis=0), corners.max(axis=0)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type, camera.data.ortho_scale = "ORTHO", 4 * APART  # The picture has a column for each object.
    camera.location = (*(0.5 * (low + high))[:2], high[2] + 5.0)
    lamp = bpy.data.objects.new("lamp", bpy.data.lights.new("lamp", "SUN"))
    lamp.data.energy, lamp.rotation_euler = 3.0, (0.3, 0.3, 0.0)
    compat.cast_shadows(lamp.data, False)
    for item in (camera, lamp):
        scene.collection.objects.link(item)
    scene.camera, scene.render.engine, scene.cycles.samples, scene.render.film_transparent = camera, "CYCLES", 16, True
    scene.cycles.use_denoising = False
    scene.view_settings.view_transform = "Standard"
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    scene.render.resolution_percentage, scene.render.filepath = 100, PICTURE
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(PICTURE)
    pixels = np.array(image.pixels[:]).reshape(image.size[1], image.size[0], 4)
    return np.split(pixels, 4, axis=1)


class Shot(ComputedCase):
    def test_each_shows_its_own(self):
        library = os.path.join(FOLDER, "library.blend")
        run("run")
        bpy.context.scene.frame_set(1)
        bpy.ops.wm.save_as_mainfile(filepath=library)
        start_anew()
        bpy.ops.wm.save_as_mainfile(filepath=os.path.join(FOLDER, "shot.blend"))
        override = place(linked(library).override_create(remap_local_usages=True), 1)
        other = linked(library)
        local = place(run("local"), 3)
        bpy.ops.object.duplicate(linked=True)
        copy = bpy.context.view_layer.objects.active
        copy.location.x -= APART
        copy.meniscus.probe = 4.0
        update()
        local.name = "renamed"
        bpy.context.scene.frame_set(7)
        items = [other, override, copy, local]
        bpy.context.view_layer.update()
        first, second, third, fourth = render(items)
        for column in (first, second, third, fourth):
            self.assertGreater((column[:, :, 3] > 0.5).mean(), 0.1)
        for different in (first, third):  # The linked object stays at frame 1, and the copy has a larger probe.
            self.assertGreater((np.abs(different - second).max(axis=2) > 0.3).mean(), 0.02)
        self.assertLess((np.abs(second - fourth).max(axis=2) > 0.3).mean(), 0.01)


if not unittest.main(argv=["inside_shot"], exit=False).result.wasSuccessful():
    sys.exit(1)
