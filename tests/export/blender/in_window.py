# SPDX-License-Identifier: BSD-3-Clause
"""What window_test.py does in Blender's window, step after step between its redraws; what was found goes to a file."""

import faulthandler
import json
import sys
import threading
import traceback

import addon_utils
import bpy

faulthandler.enable()  # where Python was, should Blender crash
TOLD, MOLECULE, PROGRAM, PACKAGE, PICTURE = sys.argv[sys.argv.index("--") + 1:]
addon_utils.enable("meniscus_import", default_set=True)
bpy.context.preferences.view.show_splash = False
from meniscus_import import computed, panel  # noqa: E402

found = {"error": "", "shown_while_dragging": 0, "threads": 1}


def drawn(kind):
    """Its draw, which says what goes wrong: Blender itself only prints that."""
    draw = kind.draw

    def watched_draw(self, context):
        try:
            draw(self, context)
            found["drawn"] = sorted({*found.get("drawn", ()), kind.__name__})
        except Exception:
            found["error"] = traceback.format_exc()

    return watched_draw


def view():
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    return {"window": window, "area": area, "region": next(region for region in area.regions if region.type == "WINDOW")}


def at_rest(item):
    return not computed.working().is_busy() and len(item.data.polygons) > 0


def steps():
    """Gives back whenever the window may go on."""
    preferences = bpy.context.preferences.addons[computed.__package__].preferences
    preferences.package, preferences.program = PACKAGE, PROGRAM
    # In the tab Tool, which is open, for no script of 3.4 can open another.
    for kind in (panel.VIEW3D_PT_meniscus_look, panel.VIEW3D_PT_meniscus_time, panel.VIEW3D_PT_meniscus):
        bpy.utils.unregister_class(kind)
    for kind in (panel.VIEW3D_PT_meniscus, panel.VIEW3D_PT_meniscus_time, panel.VIEW3D_PT_meniscus_look):
        kind.bl_category, kind.bl_order = "Tool", -1
        kind.draw = drawn(kind)
        bpy.utils.register_class(kind)
    for item in list(bpy.data.objects):
        if item.type == "MESH":
            bpy.data.objects.remove(item)
    where = view()
    where["area"].spaces.active.show_region_ui = True
    where["area"].spaces.active.shading.color_type = "VERTEX"
    yield
    with bpy.context.temp_override(**where):
        bpy.ops.object.meniscus_from_file("EXEC_DEFAULT", True, filepath=MOLECULE, selection="resi 1-20")
    item = bpy.context.view_layer.objects.active
    name = item.name
    while not at_rest(item):
        yield
    found["first"] = item["meniscus_area"]
    with bpy.context.temp_override(**where):
        bpy.ops.view3d.view_selected()
        bpy.ops.ed.undo_push(message="Before the slider moves")
    yield
    for step in range(1, 11):
        item.meniscus.probe = 1.4 + 0.06 * step
        yield
        yield
        found["shown_while_dragging"] += item["meniscus_area"] not in (found["first"], found.get("last"))
        found["last"] = item["meniscus_area"]
    while not at_rest(item):
        yield
    found["dragged"] = item["meniscus_area"]
    with bpy.context.temp_override(**where):
        bpy.ops.ed.undo_push(message="Probe")
    for _ in range(5):
        yield
    if PICTURE:
        with bpy.context.temp_override(**where):
            bpy.ops.screen.screenshot(filepath=PICTURE)
    with bpy.context.temp_override(**where):
        bpy.ops.ed.undo()
    for _ in range(3):
        yield
    while not at_rest(bpy.data.objects[name]):
        yield
    found["undone"] = bpy.data.objects[name]["meniscus_area"]


going = steps()


def go_on():
    found["threads"] = max(found["threads"], threading.active_count())
    try:
        next(going)
        return 0.02
    except StopIteration:
        pass
    except BaseException:
        found["error"] = traceback.format_exc()
    with open(TOLD, "w", encoding="utf-8") as file:
        json.dump(found, file)
    bpy.ops.wm.quit_blender()
    return None


bpy.app.timers.register(go_on, first_interval=1.0)
