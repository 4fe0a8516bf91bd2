# SPDX-License-Identifier: BSD-3-Clause
"""A picture of Blender's window as it opens a file, without the add-on: arguments PICTURE."""

import sys

import bpy

(PICTURE,) = sys.argv[sys.argv.index("--") + 1:]
bpy.context.preferences.view.show_splash = False
assert not any("meniscus" in name for name in bpy.context.preferences.addons.keys())
assert not hasattr(bpy.types.Object, "meniscus")


def look():
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
        bpy.ops.screen.screenshot(filepath=PICTURE)
        bpy.ops.wm.quit_blender()


bpy.app.timers.register(look, first_interval=2.0)
