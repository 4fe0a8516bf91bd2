# SPDX-License-Identifier: BSD-3-Clause
"""The steps of window_test.py in Blender's window, one after another between its redraws; the results go to a file."""

import faulthandler
import json
import os
import sys
import threading
import traceback

import addon_utils
import bpy

faulthandler.enable()  # A crash of Blender prints the place in Python.
TOLD, MOLECULE, MODELS, PROGRAM, PACKAGE = sys.argv[sys.argv.index("--") + 1:]
FOLDER = os.path.dirname(TOLD)
#: Pixels of the view that lie under its tools, header and navigation.
MARGIN = 90
addon_utils.enable("meniscus_import", default_set=True)
bpy.context.preferences.view.show_splash = False
from meniscus_import import bake_run, computed, panel  # noqa: E402

found = {"error": "", "shown_while_dragging": 0, "threads": 1, "played": []}


def drawn(kind):
    """Returns the class's draw wrapped so that it records errors: Blender itself only prints them."""
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


def push(message):
    with bpy.context.temp_override(**view()):
        bpy.ops.ed.undo_push(message=message)


def picture(name):
    """Takes a screenshot after steps that let the window draw the present state."""
    view()["area"].tag_redraw()
    for _ in range(5):
        yield
    with bpy.context.temp_override(**view()):
        bpy.ops.screen.screenshot(filepath=os.path.join(FOLDER, name + ".png"))


def set_up():
    """Shows the panel in an open tab, and nothing but objects in the view."""
    preferences = bpy.context.preferences.addons[computed.__package__].preferences
    preferences.package, preferences.program = PACKAGE, PROGRAM
    # The panel moves to the tab Tool, which is open: no script of 3.4 can open another.
    kinds = [kind for kind in panel.CLASSES if issubclass(kind, bpy.types.Panel)]
    for kind in reversed(kinds):
        bpy.utils.unregister_class(kind)
    for kind in kinds:
        kind.bl_category, kind.bl_order = "Tool", -1
        kind.draw = drawn(kind)
        bpy.utils.register_class(kind)
    for item in list(bpy.data.objects):
        if item.type == "MESH":
            bpy.data.objects.remove(item)
    area = view()["area"]
    space = area.spaces.active
    space.show_region_ui = True
    space.overlay.show_overlays = space.show_gizmo = False


def bare_view():
    """Returns the pixels of a screenshot where only objects show: left, bottom, right, top."""
    area = view()["area"]
    side = next(region for region in area.regions if region.type == "UI")
    return [area.x + MARGIN, area.y + MARGIN, side.x - 10, area.y + area.height - MARGIN]


def compute_drag_and_undo():
    with bpy.context.temp_override(**view()):
        bpy.ops.object.meniscus_from_file("EXEC_DEFAULT", True, filepath=MOLECULE, selection="resi 1-20", detail="PROXY")
    item = bpy.context.view_layer.objects.active
    name = item.name
    while not at_rest(item):
        yield
    found["first"] = item["meniscus_area"]
    with bpy.context.temp_override(**view()):
        bpy.ops.view3d.view_selected(use_all_regions=True)
    push("Before the slider moves")
    yield from picture("computed")
    for step in range(1, 11):
        item.meniscus.probe = 1.4 + 0.06 * step
        yield
        yield
        found["shown_while_dragging"] += item["meniscus_area"] not in (found["first"], found.get("last"))
        found["last"] = item["meniscus_area"]
    while not at_rest(item):
        yield
    found["dragged"] = item["meniscus_area"]
    push("Probe")
    yield from picture("dragged")
    with bpy.context.temp_override(**view()):
        bpy.ops.ed.undo()
    for _ in range(3):
        yield
    while not at_rest(bpy.data.objects[name]):
        yield
    found["undone"] = bpy.data.objects[name]["meniscus_area"]
    yield from picture("undone")
    return bpy.data.objects[name]


def rest(item):
    """Checks that a fine mesh follows the proxy, and a proxy the slider."""
    item.meniscus.detail = "AUTO"
    counts = [len(item.data.polygons)]

    def settle():
        while computed.motion.any_moves() or not at_rest(item):
            yield
            if len(item.data.polygons) != counts[-1]:
                counts.append(len(item.data.polygons))

    yield from settle()
    item.meniscus.probe = 1.8
    yield from settle()
    found["triangles"] = counts
    item.meniscus.detail, item.meniscus.probe = "PROXY", 1.4
    yield from settle()


def recolour(item):
    item.meniscus.color = "residue"
    yield
    while not at_rest(item):
        yield
    found["recoloured"] = item["meniscus_area"]
    yield from picture("recoloured")


def play(before):
    """Plays a run on the timeline as the button does."""
    before.hide_set(True)
    scene = bpy.context.scene
    with bpy.context.temp_override(**view()):
        bpy.ops.object.meniscus_from_file("EXEC_DEFAULT", True, filepath=MODELS, selection="resi 1-20", is_run=True, detail="PROXY")
    item = bpy.context.view_layer.objects.active
    while not at_rest(item):
        yield
    found["frames"] = scene.frame_end = computed.frame_count(item)
    with bpy.context.temp_override(**view()):
        bpy.ops.view3d.view_selected(use_all_regions=True)
        bpy.ops.screen.animation_play()
    while len(found["played"]) < found["frames"]:
        shown = [scene.frame_current, item["meniscus_area"]]
        if shown not in found["played"]:
            found["played"].append(shown)
        if len(found["played"]) == found["frames"] // 2 and "playing" not in found:
            found["playing"] = bpy.context.screen.is_animation_playing
            with bpy.context.temp_override(**view()):
                bpy.ops.screen.screenshot(filepath=os.path.join(FOLDER, "playing.png"))
        yield
    with bpy.context.temp_override(**view()):
        bpy.ops.screen.animation_cancel(restore_frame=False)
    yield
    scene.frame_set(1)
    while not at_rest(item):
        yield
    yield from picture("saved")
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(FOLDER, "saved.blend"))
    return item


def bake(item):
    """Bakes in steps, between which the window goes on."""
    with bpy.context.temp_override(**view()):
        found["baking"] = list(bpy.ops.object.meniscus_bake("INVOKE_DEFAULT"))
    while bake_run.kind_of(item) is not None:
        yield
    found["baked"] = [modifier.name for modifier in item.modifiers]


def steps():
    """Runs the whole test and yields whenever the window may go on."""
    set_up()
    yield
    found["view"] = bare_view()
    item = yield from compute_drag_and_undo()
    yield from rest(item)
    yield from recolour(item)
    item = yield from play(item)
    yield from bake(item)


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
