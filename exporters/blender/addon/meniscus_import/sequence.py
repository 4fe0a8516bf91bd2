# SPDX-License-Identifier: GPL-3.0-or-later
"""Imports sequences of surfaces: all frames are baked into the file, or a handler reads one frame at a time."""

import math
import os

import bpy
from bpy.app.handlers import persistent

from . import attributes, build, compat, frame_picker, libraries, mesh_arrays, mns_reader, sequence_reader
from .computing import process


class Placement:
    """The options for the surfaces of a sequence in a scene.

    scale: Blender units per Å; None for that of the sequence.
    center, origin: the origin of the scene's coordinates for all frames, Å; if it is None, the origin of the sequence
    is used if `center` is True, and zero otherwise.
    crisp_colors, own_materials: arguments of build.Options.
    timing: a sequence_reader.Timing, or None for the default.
    scene: the scene whose frame rate applies to velocities; None for the rate of the sequence.
    names: the result of mesh_arrays.names_of() for all frames, to which new names are appended."""

    def __init__(self, sequence, scale=None, center=True, crisp_colors=True, timing=None, scene=None, origin=None,
                 own_materials=False, names=None):
        self.sequence = sequence
        self.names = {} if names is None else names
        self.scale = sequence.scale if scale is None else scale
        self.origin = origin if origin is not None else sequence.origin if center else sequence.origin * 0.0
        self.crisp_colors = crisp_colors
        self.timing = timing or sequence_reader.Timing()
        self.scene = scene
        self.own_materials = own_materials
        self.new_materials = []

    def refill(self, mesh, scene_frame, kept=()):
        """Puts a frame into a mesh, with the kept attributes of the user, and returns its Prepared. scene_frame:
        its place in the run, from 1. After an error the mesh has no geometry, because another frame would be wrong."""
        try:
            build.clear_geometry(mesh)
            prepared = _ahead.take(self, scene_frame)
            mesh_arrays.renumber(prepared.arrays, mesh_arrays.names_of(prepared.surface), self.names)
            if not mesh.materials:
                build.add_materials(mesh, prepared.surface, self.new_materials, self.own_materials)
            fps = self.sequence.fps if self.scene is None else build.fps_of(self.scene)
            build.fill_mesh(mesh, prepared.arrays, fps * self.timing.speed)
            attributes.restore(mesh, kept, prepared.arrays)
            if len(mesh.polygons) != prepared.triangles:
                raise mns_reader.MnsError(
                    f"{self.sequence.frames[scene_frame - 1].path}: {len(mesh.polygons)} triangles of "
                    f"{prepared.triangles}")
        except BaseException:
            build.clear_geometry(mesh)
            raise
        return prepared

    def prepared(self, scene_frame):
        return sequence_reader.prepare(self.sequence, scene_frame, self.origin, self.scale, self.crisp_colors)


class Ahead:
    """Frames that another process reads in advance. It does everything except filling meshes of Blender, which is most
    of the work."""

    MOST = 2

    def __init__(self):
        self.process = process.Process()
        self.waiting = {}  # key -> process.Job, the oldest first

    @staticmethod
    def key(placement, scene_frame):
        path = placement.sequence.frames[scene_frame - 1].path
        return (path, placement.sequence.run, tuple(placement.origin), placement.scale, placement.crisp_colors,
                mns_reader.stamp(path) if os.path.exists(path) else None)

    def take(self, placement, scene_frame):
        """Returns the Prepared of a frame. If the other process failed, the frame is read here, which reports
        the reason. Raises MnsError or OSError."""
        job = self.waiting.pop(self.key(placement, scene_frame), None)
        if job is not None:
            self.process.wait(job)
            if job.error is None:
                return sequence_reader.unpacked(job.result)
        return placement.prepared(scene_frame)

    def request(self, placement, scene_frame):
        key = self.key(placement, scene_frame)
        if key in self.waiting:
            return
        about = {
            "path": os.path.abspath(placement.sequence.path), "scene_frame": scene_frame, "origin": placement.origin,
            "scale": placement.scale, "crisp": placement.crisp_colors}
        try:
            self.waiting[key] = self.process.submit(key, key, "frame", about)
        except mns_reader.MnsError:
            return  # the frame is read when it is needed
        while len(self.waiting) > self.MOST:
            self.process.drop(self.waiting.pop(next(iter(self.waiting))).owner)

    def forget(self):
        self.process.end()
        self.waiting.clear()


_ahead = Ahead()


def set_up_scene(scene, sequence, timing):
    """Sets the range of frames of a scene, and the frame rate that velocities assume."""
    scene.frame_start = math.floor(timing.start)
    scene.frame_end = max(scene.frame_start, math.ceil(timing.scene_time(len(sequence.frames)) - 1e-6))
    scene.render.fps, scene.render.fps_base = compat.frame_rate(sequence.fps)


def add_camera(collection, placement):
    """Adds the camera of the run, with key frames if it moves, and returns its object, or None if the manifest has
    none. Its clipping must be set by build.reach_all() for the frames."""
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
    return item


def use_camera(scene, item, sequence):
    scene.camera = item
    build.use_picture_size(scene, sequence.frames[0].camera)


def set_key_frames(item, placement):
    before = None
    for scene_frame, frame in enumerate(placement.sequence.frames, 1):
        build.place_camera(item, frame.camera, placement.scale, placement.origin)
        location, turn, _ = item.matrix_world.decompose()
        if before is not None:
            turn.make_compatible(before)  # takes the shorter of both rotations
        item.location, item.rotation_quaternion, before = location, turn, turn
        time = placement.timing.scene_time(scene_frame)
        for path in ("location", "rotation_quaternion"):
            item.keyframe_insert(path, frame=time)
        for path in ("lens", "ortho_scale"):
            item.data.keyframe_insert(path, frame=time)


def remember(item, placement):
    """Stores a placement in plain custom properties of an object, which survive saving and need no registration."""
    sequence = placement.sequence
    item["meniscus_sequence"] = build.remembered_path(sequence.path)
    libraries.note(item)
    item["meniscus_run"] = sequence.run
    item["meniscus_source"], item["meniscus_atoms"] = (build.source_of(sequence.header),
                                                       int(sequence.header.get("atoms", 0)))
    item["meniscus_scale"] = placement.scale
    item["meniscus_origin"] = [float(value) for value in placement.origin]
    item["meniscus_crisp"] = int(placement.crisp_colors)
    item["meniscus_own_rate"] = int(placement.scene is None)
    build.set_names(item, placement.names)


class Run:
    """The import of a sequence into a scene.

    import_camera: True to import the camera of the run. use_camera: True to make it the camera of the scene, with its
    picture size. camera: a dict that replaces the camera of the run, or None. set_time: True if the scene gets the
    range of frames and the frame rate of the run. options: arguments of Placement."""

    def __init__(self, path, context, center=True, import_camera=True, use_camera=True, set_time=True, camera=None,
                 **options):
        self.sequence = sequence_reader.read(path)
        if camera:
            self.sequence.set_camera(camera)
        scene = context.scene
        header = self.sequence.header
        origin = self.sequence.origin * 0.0
        if center:
            origin = build.scene_origin(scene, lambda: self.sequence.origin, build.source_of(header),
                                        header.get("atoms", 0))
        self.placement = Placement(self.sequence, origin=origin, scene=None if set_time else scene, **options)
        self.import_camera, self.use_camera, self.set_time = import_camera, use_camera, set_time

    def finish(self, context, item, camera, meshes):
        if self.set_time:
            set_up_scene(context.scene, self.sequence, self.placement.timing)
        if camera is not None and self.use_camera:
            use_camera(context.scene, camera, self.sequence)
        build.let_rays_through(context.scene, meshes)
        build.present(context, [item])


def bake(path, context=None, progress=None, **options):
    """Reads all frames into the file, and returns an object whose Geometry Nodes show the frame of the scene's time. It
    renders anywhere without this add-on. options: arguments of Run. After MnsError or OSError nothing is left."""
    context = context or bpy.context
    run = Run(path, context, **options)
    sequence, placement = run.sequence, run.placement
    camera = None
    try:
        with build.whole_or_nothing():
            store = frame_picker.Frames(sequence.stem)
            collection = bpy.data.collections.new(sequence.stem)
            if run.import_camera:
                camera = add_camera(collection, placement)
            for scene_frame in range(1, len(sequence.frames) + 1):
                mesh = bpy.data.meshes.new(sequence.stem)
                read_ahead(placement, scene_frame + 1)
                prepared = placement.refill(mesh, scene_frame)
                store.add(mesh)
                if camera is not None:
                    build.reach_all(camera, prepared.points, placement.scale, placement.origin)
                if progress:
                    progress(scene_frame, len(sequence.frames))
            name = sequence.stem + ".surface"
            item = bpy.data.objects.new(name, bpy.data.meshes.new(name))
            store.show_in(item, placement.timing)
            remember(item, placement)
            collection.objects.link(item)
    finally:
        _ahead.forget()
    context.scene.collection.children.link(collection)
    run.finish(context, item, camera, [each.data for each in store.collection.objects])
    return item


def stream(path, context=None, **options):
    """Returns an object that a handler of this add-on fills with the frame of the scene's time, so that only one frame
    is in memory. options: arguments of Run."""
    context = context or bpy.context
    run = Run(path, context, **options)
    sequence, placement = run.sequence, run.placement
    camera = None
    with build.whole_or_nothing():
        collection = bpy.data.collections.new(sequence.stem)
        mesh = bpy.data.meshes.new(sequence.stem + ".surface")
        item = bpy.data.objects.new(mesh.name, mesh)
        collection.objects.link(item)
        prepared = placement.refill(mesh, 1)
        mesh["meniscus_shown"] = shown_key(sequence, 1)
        build.let_exporters_follow(mesh)
        if run.import_camera:
            camera = add_camera(collection, placement)
        if camera is not None:
            build.reach_all(camera, prepared.points, placement.scale, placement.origin)
        remember(item, placement)
        item["meniscus_stream"] = 1
        item["meniscus_start"], item["meniscus_speed"] = placement.timing.start, placement.timing.speed
        item["meniscus_outside"] = placement.timing.outside
        item["meniscus_by_hand"], item["meniscus_frame"] = False, 1.0
    context.scene.collection.children.link(collection)
    context.scene.render.use_lock_interface = True  # the window must not read a mesh while a render refills it
    run.finish(context, item, camera, [mesh])
    show_frame(context.scene)
    return item


_manifests = sequence_reader.Manifests()


def placement_of(item, scene):
    sequence = _manifests.get(libraries.path_of(item, "meniscus_sequence"))
    timing = sequence_reader.Timing(item.get("meniscus_start", 1.0), item.get("meniscus_speed", 1.0),
                                    item.get("meniscus_outside", "EMPTY"))
    return Placement(
        sequence, item["meniscus_scale"], True, bool(item["meniscus_crisp"]), timing,
        None if item.get("meniscus_own_rate", 1) else scene, sequence.origin * 0.0 + list(item["meniscus_origin"]),
        names={attribute: list(item[key]) for attribute, (_, key) in mesh_arrays.NAMES.items() if item.get(key)})


def place_at(item, placement, time):
    """Returns the place of the frame that an object shows at a time of the scene, from 1, or None if it shows
    nothing."""
    count = len(placement.sequence.frames)
    if item.get("meniscus_by_hand") and "meniscus_frame" in item:
        return placement.timing.within(compat.value_at(item, '["meniscus_frame"]', time), count)
    return placement.timing.place(time, count)


def shown_key(sequence, scene_frame):
    return f"{sequence.run}/{scene_frame}"


def show_frame(scene):
    """Fills every streamed object of the scene with its frame, unless it has the frame already: for motion blur Blender
    visits times between frames, whose nearest frame is the same. Meshes in edit mode do not change."""
    for item in list(scene.objects):
        if (item.type == "MESH" and item.get("meniscus_stream") and not item.data.is_editmode and
                not libraries.is_fixed(item)):
            refresh(item, scene)


def shows(item, scene):
    """Returns the placement that a stream must show now, its place in the run or None, and a key that is equal for
    streams with equal meshes."""
    placement = placement_of(item, scene)
    scene_frame = place_at(item, placement, scene.frame_current_final)
    return placement, scene_frame, (shown_key(placement.sequence,
                                              scene_frame), placement.scale, *placement.origin, placement.crisp_colors)


def show_place(item, placement, scene_frame):
    """Fills the mesh of an object with a frame of its run. The user's attributes follow their atoms. scene_frame: None
    for an empty mesh."""
    kept = attributes.keep_through(item.data, build.OURS, placement.sequence.run)
    if scene_frame is None:
        build.clear_geometry(item.data)
    else:
        placement.refill(item.data, scene_frame, kept)
        build.set_names(item, placement.names)


def read_ahead(placement, scene_frame):
    """Requests a frame of a run from the other process, if the frame exists."""
    if scene_frame is not None and scene_frame <= len(placement.sequence.frames):
        _ahead.request(placement, scene_frame)


def refresh(item, scene):
    gone = libraries.gone(item, "meniscus_sequence")
    if gone:
        libraries.fail(item, gone)
        return
    mesh = item.data
    try:
        placement, scene_frame, key = shows(item, scene)
        if mesh.get("meniscus_shown") == key[0]:
            libraries.succeed(item)
            return
        mesh = libraries.own_mesh(item, lambda other: not other.get("meniscus_stream") or shows(other, scene)[2] == key)
        mesh["meniscus_shown"] = ""
        show_place(item, placement, scene_frame)
        after = place_at(item, placement, scene.frame_current_final + 1.0)
        if scene_frame is not None and after != scene_frame:
            read_ahead(placement, after)
        mesh["meniscus_shown"] = key[0]
        libraries.succeed(item)
    except Exception as error:  # Blender ignores exceptions of handlers, and would render a wrong picture
        mesh = libraries.own_mesh(item, lambda _other: True)
        build.clear_geometry(mesh)
        mesh["meniscus_shown"] = ""
        libraries.fail(item, error)
        compat.show_message("Meniscus", item["meniscus_error"])
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
    _ahead.forget()
