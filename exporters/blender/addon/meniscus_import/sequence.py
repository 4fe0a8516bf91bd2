# SPDX-License-Identifier: GPL-3.0-or-later
"""A sequence of surfaces in a scene: all frames baked into the file, or one frame at a time by a handler."""

import os
import sys

import bpy
from bpy.app.handlers import persistent

from . import build, compat, frame_picker, joined, mns_reader, sequence_reader


class Placement:
    """How the surfaces of a sequence come into a scene. origin: Å, of the scene's coordinates, for all frames."""

    def __init__(self, sequence, scale=None, center=True, crisp_colors=True):
        self.sequence = sequence
        self.scale = sequence.scale if scale is None else scale
        self.origin = sequence.origin if center else sequence.origin * 0.0
        self.crisp_colors = crisp_colors

    def refill(self, mesh, scene_frame):
        """Puts one frame into the mesh. On an error the mesh is left without geometry: no other frame stands for it."""
        try:
            mesh.clear_geometry()
            file = self.sequence.read(scene_frame)
            build.fill_mesh(mesh, joined.joined(file, self.origin), self.scale, self.crisp_colors, self.sequence.fps)
        except BaseException:
            mesh.clear_geometry()
            raise
        expected = sum(len(surface.copies) * surface.header["mesh"]["triangles"] for surface in file.objects)
        if len(mesh.polygons) != expected:
            found = len(mesh.polygons)
            mesh.clear_geometry()
            raise mns_reader.MnsError(f"{self.sequence.frames[scene_frame - 1].path}: {found} triangles of {expected}")
        return file


def set_up_scene(scene, sequence):
    """Scene frames count from 1; velocities are for this frame rate."""
    scene.frame_start, scene.frame_end = 1, len(sequence.frames)
    scene.render.fps, scene.render.fps_base = compat.frame_rate(sequence.fps)
    shot = sequence.frames[0].camera
    if shot is not None:
        build.use_picture_size(scene, shot)


def new_mesh(name):
    mesh = bpy.data.meshes.new(name)
    build.add_materials(mesh, [])
    return mesh


def add_camera(scene, collection, placement):
    """The camera of the run, with key frames if it moves; None when the manifest has none. It shows only what is near
    until build.reach_all is called for frames."""
    sequence = placement.sequence
    if sequence.frames[0].camera is None:
        return None
    camera = bpy.data.cameras.new(sequence.stem + ".camera")
    item = bpy.data.objects.new(camera.name, camera)
    item.rotation_mode = "QUATERNION"
    build.place_camera(item, sequence.frames[0].camera, placement.scale, placement.origin)
    if sequence.camera_moves:
        set_key_frames(item, placement)
    collection.objects.link(item)
    scene.camera = item
    return item


def set_key_frames(item, placement):
    before = None
    for scene_frame, frame in enumerate(placement.sequence.frames, 1):
        build.place_camera(item, frame.camera, placement.scale, placement.origin)
        location, turn, _ = item.matrix_world.decompose()
        if before is not None:
            turn.make_compatible(before)  # the short way round
        item.location, item.rotation_quaternion, before = location, turn, turn
        for path in ("location", "rotation_quaternion"):
            item.keyframe_insert(path, frame=scene_frame)
        for path in ("lens", "ortho_scale"):
            item.data.keyframe_insert(path, frame=scene_frame)


def remember(item, placement):
    """Plain custom properties: they survive saving and need no registration."""
    sequence = placement.sequence
    path = os.path.abspath(sequence.path)
    item["meniscus_sequence"] = bpy.path.relpath(path) if bpy.data.filepath else path
    item["meniscus_run"] = sequence.run
    item["meniscus_scale"] = placement.scale
    item["meniscus_origin"] = [float(value) for value in placement.origin]
    item["meniscus_crisp"] = int(placement.crisp_colors)


def bake(path, context=None, progress=None, **options):
    """Reads all frames into the file: an object whose Geometry Nodes pick that of the scene's time. Renders anywhere,
    without this add-on. Raises MnsError or OSError and then leaves nothing behind."""
    context = context or bpy.context
    sequence = sequence_reader.read(path)
    placement = Placement(sequence, **options)
    store = bpy.data.collections.new(sequence.stem + ".frames")
    collection = bpy.data.collections.new(sequence.stem)
    camera = item = None
    try:
        camera = add_camera(context.scene, collection, placement)
        for scene_frame in range(1, len(sequence.frames) + 1):
            # Geometry Nodes sort a collection by name; short names, since Blender cuts long ones.
            mesh = new_mesh(f"{sequence.stem[:40]}.{scene_frame:07d}")
            store.objects.link(bpy.data.objects.new(mesh.name, mesh))
            file = placement.refill(mesh, scene_frame)
            if camera is not None:
                build.reach_all(camera, file, placement.scale, placement.origin)
            if progress:
                progress(scene_frame, len(sequence.frames))
        item = frame_picker.add(sequence.stem + ".surface", store, len(sequence.frames))
        remember(item, placement)
        collection.objects.link(item)
    except BaseException:
        remove([item, camera, *store.objects], [store, collection])
        raise
    context.scene.collection.children.link(collection)
    collection.children.link(store)
    exclude(context.view_layer.layer_collection, store)
    set_up_scene(context.scene, sequence)
    return item


def stream(path, context=None, **options):
    """An object that a handler fills with the frame of the scene's time: one frame in memory. Needs this add-on."""
    context = context or bpy.context
    sequence = sequence_reader.read(path)
    placement = Placement(sequence, **options)
    collection = bpy.data.collections.new(sequence.stem)
    mesh = new_mesh(sequence.stem + ".surface")
    item = bpy.data.objects.new(mesh.name, mesh)
    camera = None
    try:
        collection.objects.link(item)
        file = placement.refill(mesh, 1)
        mesh["meniscus_shown"] = shown_key(sequence, 1)
        camera = add_camera(context.scene, collection, placement)
        if camera is not None:
            build.reach_all(camera, file, placement.scale, placement.origin)
        remember(item, placement)
        item["meniscus_stream"] = 1
    except BaseException:
        remove([item, camera], [collection])
        raise
    context.scene.collection.children.link(collection)
    context.scene.render.use_lock_interface = True  # the window must not read a mesh that a render refills
    set_up_scene(context.scene, sequence)
    show_frame(context.scene)
    return item


def exclude(layer, collection):
    for child in layer.children:
        if child.collection == collection:
            child.exclude = True
        exclude(child, collection)


def remove(items, collections):
    for item in items:
        if item is not None:
            data = item.data
            bpy.data.objects.remove(item)
            (bpy.data.cameras if isinstance(data, bpy.types.Camera) else bpy.data.meshes).remove(data)
    for collection in collections:
        bpy.data.collections.remove(collection)


_manifests = {}  # path -> (modification time, size, Placement)


def placement_of(item):
    """The manifest is read again when its file has changed."""
    path = bpy.path.abspath(item["meniscus_sequence"])
    stamp = os.stat(path)
    key = (stamp.st_mtime_ns, stamp.st_size, item["meniscus_scale"], tuple(item["meniscus_origin"]),
           item["meniscus_crisp"])
    if _manifests.get(path, (None,))[0] != key:
        placement = Placement(sequence_reader.read(path), item["meniscus_scale"], True, bool(item["meniscus_crisp"]))
        placement.origin = placement.origin * 0.0 + list(item["meniscus_origin"])
        _manifests[path] = (key, placement)
    return _manifests[path][1]


def shown_key(sequence, scene_frame):
    return f"{sequence.run}/{scene_frame}"


def show_frame(scene):
    """Fills every streamed object of the scene with its frame, unless it holds it already: with motion blur Blender
    asks for moments between frames, whose nearest frame is the same."""
    for item in list(scene.objects):
        if item.type == "MESH" and item.get("meniscus_stream"):
            refresh(item, scene.frame_current_final)


def refresh(item, time):
    mesh = item.data
    try:
        placement = placement_of(item)
        scene_frame = placement.sequence.resolve(time)
        key = shown_key(placement.sequence, scene_frame)
        if mesh.get("meniscus_shown") == key:
            return
        mesh["meniscus_shown"] = ""
        if scene_frame is None:  # outside of the run there is nothing to see
            mesh.clear_geometry()
        else:
            placement.refill(mesh, scene_frame)
        mesh["meniscus_shown"] = key
        item["meniscus_error"] = ""
    except Exception as error:  # a handler that raises changes nothing: Blender goes on and renders
        mesh.clear_geometry()
        mesh["meniscus_shown"] = ""
        item["meniscus_error"] = str(error) or type(error).__name__
        sys.stderr.write(f"meniscus: error: {item['meniscus_error']}\n")
        compat.show_message(bpy, "Meniscus", item["meniscus_error"])
    mesh.update()


@persistent
def on_frame_change(scene, _depsgraph=None):
    show_frame(scene)


def register():
    if on_frame_change not in bpy.app.handlers.frame_change_pre:
        bpy.app.handlers.frame_change_pre.append(on_frame_change)


def unregister():
    if on_frame_change in bpy.app.handlers.frame_change_pre:
        bpy.app.handlers.frame_change_pre.remove(on_frame_change)
    _manifests.clear()
