# SPDX-License-Identifier: GPL-3.0-or-later
"""Bakes the surfaces that an object shows while the timeline plays into the file: a mesh for each frame, which needs
neither this add-on nor other files."""

import bpy

from . import (attributes, build, compat, computed, frame_picker, libraries, mesh_arrays, mns_reader, sequence,
               sequence_reader, showing)

#: Bytes per value of an attribute, by its type.
VALUE_BYTES = {
    "FLOAT": 4, "INT": 4, "INT8": 1, "BOOLEAN": 1, "BYTE_COLOR": 4, "FLOAT_COLOR": 16, "FLOAT_VECTOR": 12, "FLOAT2": 8}
#: Bytes of a vertex, an edge, a corner and a face, without attributes.
ELEMENT_BYTES = (12, 8, 12, 8)
#: The share of these bytes that remains in a compressed .blend.
COMPRESSED = 0.3
#: Attributes whose bytes ELEMENT_BYTES includes.
IN_ELEMENTS = {"position", "material_index"}
#: Custom properties of streams and of objects that show a single frame, which baked objects do not have.
LIVE_PROPERTIES = ("meniscus_stream", "meniscus_start", "meniscus_speed", "meniscus_outside", "meniscus_by_hand",
           "meniscus_frame", "meniscus_frames", "meniscus_frames_of", "meniscus_area", "meniscus_volume",
           libraries.ERROR)


class Stream:
    """An object that shows frames of files, which are read while the timeline plays."""

    TIMES = {
        f'["meniscus_{name.lower()}"]': name for name in (frame_picker.START, frame_picker.SPEED, frame_picker.FRAME)}
    TIMES['["meniscus_by_hand"]'] = frame_picker.BY_HAND

    def __init__(self, item, scene):
        self.placement = sequence.placement_of(item, scene)
        self.count, self.timing = len(self.placement.sequence.frames), self.placement.timing
        self.by_hand, self.frame = bool(item.get("meniscus_by_hand")), float(item.get("meniscus_frame", 1.0))

    def show(self, item, place):
        sequence.read_ahead(self.placement, place + 1)
        sequence.show_place(item, self.placement, place)

    def end(self, item):
        pass


class Panel:
    """An object that shows frames of a run, which are computed while the timeline plays."""

    TIMES = {f"meniscus.{name}": socket for name, socket in (
        ("start", frame_picker.START), ("speed", frame_picker.SPEED), ("outside", frame_picker.OUTSIDE),
        ("by_hand", frame_picker.BY_HAND), ("frame", frame_picker.FRAME))}

    def __init__(self, item, _scene):
        settings = item.meniscus
        self.count, self.timing = computed.frame_count(item), settings.timing()
        self.by_hand, self.frame = settings.by_hand, settings.frame

    def show(self, item, place):
        computed.show_place(item, place)
        if item.meniscus.source == "FILE":
            computed.compute_ahead(item, range(place + 1, min(place + computed.AHEAD, self.count) + 1))

    def end(self, item):
        computed.compute_ahead(item, ())


class Followed:
    """An object that shows the surface of another object's atoms, which something else moves. Each frame of the scene
    is a frame of the run."""

    TIMES = {}
    by_hand, frame = False, 1.0

    def __init__(self, _item, scene):
        self.scene, self.before = scene, (scene.frame_current, scene.frame_subframe)
        self.first, self.count = scene.frame_start, scene.frame_end - scene.frame_start + 1
        self.timing = sequence_reader.Timing(self.first, 1.0, "HOLD")

    def show(self, item, place):
        self.scene.frame_set(self.first + place - 1)
        computed.show_place(item, 0)

    def end(self, item):
        self.scene.frame_set(self.before[0], subframe=self.before[1])


def kind_of(item):
    """Returns the class that describes how the mesh of an object follows the timeline: Stream, Panel or Followed.
    Returns None if it does not follow, or if the object belongs to a library."""
    if item is None or item.type != "MESH" or item.library is not None or item.override_library is not None:
        return None
    if item.get("meniscus_stream"):
        return Stream
    if not showing.is_computed(item):
        return None
    if item.meniscus.source == "FILE":
        return Panel if item.meniscus.is_run else None
    return Panel if showing.frame_count(item) else Followed


def frame_bytes(mesh):
    """Estimates the bytes of a mesh in memory and in an uncompressed file, to within 20 %."""
    parts = zip(ELEMENT_BYTES, (mesh.vertices, mesh.edges, mesh.loops, mesh.polygons))
    own = [each for each in mesh.attributes if each.name not in IN_ELEMENTS and not each.name.startswith(".")]
    return sum(size * len(part)
               for size, part in parts) + sum(VALUE_BYTES.get(each.data_type, 4) * len(each.data) for each in own)


def size_lines(item, scene):
    """Returns short lines about the number of frames and their size, if all of them are like the one that shows."""
    try:
        count = kind_of(item)(item, scene).count
    except (mns_reader.MnsError, OSError):
        count = 0  # the same as for a run that was not read yet
    size = count * frame_bytes(item.data) / 1e6
    return (f"{count:,} frames, {_rounded(size)}",
            f"{_rounded(COMPRESSED * size)} compressed") if size else ("Frames of unknown size",)


def _rounded(megabytes):
    return (f"{megabytes / 1000:.1f} GB" if megabytes >= 1000 else
            f"{megabytes:.0f} MB" if megabytes >= 10 else f"{megabytes:.1f} MB")


def bake(item, scene):
    """Bakes the run of an object, and yields the number of finished frames and of all frames after each. At the end the
    object shows meshes of the file. If the generator is closed earlier, or raises MnsError or OSError, nothing has
    changed."""
    if kind_of(item) is Panel:
        computed.count_frames(item)
    live = kind_of(item)(item, scene)
    frames = frame_picker.Frames(item.name)
    stand_in = item.copy()  # it is in no scene, so that the object itself does not change
    stand_in.data = item.data.copy()
    try:
        stand_in.data.animation_data_clear()
        attributes.copy_kept(item.data, stand_in.data)
        for place in range(1, live.count + 1):
            live.show(stand_in, place)
            frames.add(_frame_of(stand_in.data, item))
            yield place, live.count
        _replace(item, stand_in, live, frames)
    except BaseException:
        frames.remove()
        raise
    finally:
        live.end(stand_in)
        bpy.data.meshes.remove(stand_in.data)  # removes the object, too


def _frame_of(shown, item):
    """Returns a copy of the shown mesh that does not change with time, with the materials of the object."""
    mesh = shown.copy()
    mesh.animation_data_clear()
    for key in (showing.SHOWN, "meniscus_moves"):
        if key in mesh:
            del mesh[key]
    for number, slot in enumerate(item.material_slots):
        mesh.materials[number] = slot.material
    return mesh


def _replace(item, stand_in, live, frames):
    """Makes the object show the baked frames. Its place, parents, modifiers and keys of its times remain."""
    before = item.data
    item.data = bpy.data.meshes.new(item.name)
    modifier = frames.show_in(item, live.timing, live.by_hand, live.frame)
    compat.rename_curves(item, {path: compat.input_path(modifier, socket) for path, socket in live.TIMES.items()})
    build.set_names(item, {attribute: stand_in.get(key, ()) for attribute, (_, key) in mesh_arrays.NAMES.items()})
    for key in LIVE_PROPERTIES:
        if key in item:
            del item[key]
    item.meniscus.source = "NONE"
    if not before.users:
        bpy.data.meshes.remove(before)


class OBJECT_OT_meniscus_bake(bpy.types.Operator):
    """Turn the run into a mesh for each frame in this file, which then opens and renders without this add-on"""

    bl_idname = "object.meniscus_bake"
    bl_label = "Bake run"
    bl_options = {"UNDO"}

    @classmethod
    def poll(cls, context):
        return kind_of(context.active_object) is not None and context.active_object.mode == "OBJECT"

    def invoke(self, context, _event):
        """Bakes in steps while the window shows the progress. All other events are blocked, because an undo would
        remove the new data."""
        self.steps = bake(context.active_object, context.scene)
        self.timer = context.window_manager.event_timer_add(0.01, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self.steps.close()
            return self.end(context, {"CANCELLED"})
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
        result = self.step(context)
        return result if result == {"RUNNING_MODAL"} else self.end(context, result)

    @build.reports_errors
    def step(self, context):
        for done, count in self.steps:
            context.workspace.status_text_set(f"Frame {done:,} of {count:,} is baked; Esc cancels")
            return {"RUNNING_MODAL"}
        return {"FINISHED"}

    def end(self, context, result):
        context.window_manager.event_timer_remove(self.timer)
        context.workspace.status_text_set(None)
        return result

    @build.reports_errors
    def execute(self, context):
        for _ in bake(context.active_object, context.scene):
            pass
        return {"FINISHED"}


def draw(layout, context):
    """Draws the button and the estimated size of the file."""
    item = context.active_object
    if kind_of(item) is not None:
        layout.operator("object.meniscus_bake", icon="RENDER_ANIMATION")
        for line in size_lines(item, context.scene):
            layout.label(text=line)


register, unregister = bpy.utils.register_classes_factory([OBJECT_OT_meniscus_bake])
