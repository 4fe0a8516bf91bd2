# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts computed surfaces into the meshes of objects, and keeps the last ones, which may be shown again. Each object
shows the surface of its own request."""

import dataclasses

import bpy
import mathutils
import numpy as np

from . import attributes, build, compat, libraries, mesh_arrays, mns_reader, molecular_nodes

#: The custom property of a mesh with the key of the request that it shows.
SHOWN = "meniscus_shown"
#: The memory for kept surfaces in bytes. They serve undo and repeated frames.
KEPT_BYTES = 1 << 28

_kept = {}  # key -> Shown or None, the oldest first
_vertices = {}  # identity of a mesh -> number of vertices when it was last watched


class Shown:
    """A surface that a mesh can show: its header, the middle of its atoms (Å), their number, and the arrays of the
    mesh, whose positions are relative to `base` (Å)."""

    def __init__(self, result, wanted):
        self.surface = mns_reader.Surface("a computed surface", result["header"], {})
        self.middle, self.base, self.atoms = result["middle"], result["base"], result["atoms"]
        self.arrays = mesh_arrays.MeshArrays(**result["arrays"])
        self.scale, self.crisp = wanted.scale, wanted.crisp
        self.names = mesh_arrays.names_of(self.surface)
        self.others = {each.name for each in wanted.others}


def is_computed(item):
    """Returns True if an object of this file shows a computed surface."""
    return item is not None and item.type == "MESH" and item.meniscus.source != "NONE" and item.library is None


def requests_same_surface(item, other):
    """Returns True if two objects request the same surface at the current time."""
    time = bpy.context.scene.frame_current_final
    return (is_computed(other) and item.meniscus.surface_values() == other.meniscus.surface_values() and
            place_at(item, time) == place_at(other, time))


def place_at(item, time):
    """Returns the place of the frame that an object shows at a time of the scene, from 1. Returns 0 if it has no run,
    and None if nothing is shown."""
    settings = item.meniscus
    count = frame_count(item)
    if count == 0:
        return 0
    if settings.by_hand:
        return settings.timing().within(compat.value_at(item, "meniscus.frame", time), count)
    return settings.timing().place(time, count)


def frame_count(item):
    """Returns the number of frames of an object's run, or 0 if it has none or if the run was not read yet."""
    settings = item.meniscus
    if settings.source == "OBJECT":
        return len(molecular_nodes.frames_of(settings.atoms)) if settings.atoms is not None else 0
    return int(item.get("meniscus_frames", 0)) if settings.is_run else 0


def watch(item):
    """Stores the number of vertices of an object's mesh for was_changed()."""
    _vertices[compat.identity(item.data)] = len(item.data.vertices)


def was_changed(item):
    """Returns True if the user has joined or edited an object's mesh since a surface was last requested or shown."""
    return _vertices.get(compat.identity(item.data), len(item.data.vertices)) != len(item.data.vertices)


def _own_mesh(item):
    return libraries.own_mesh(item, lambda other: not is_computed(other) or requests_same_surface(item, other))


def empty(item):
    mesh, shown = _own_mesh(item), _kept.get(item.data.get(SHOWN))
    if shown is not None:
        _keep_of_user(item, shown)
    build.clear_geometry(mesh)
    mesh[SHOWN] = ""
    mesh.update()
    watch(item)


def show(item, key, shown):
    """Puts a computed surface into the mesh of an object. Materials, modifiers and the user's attributes remain. A mesh
    in edit mode does not change. shown: a Shown, or None for an empty mesh."""
    if item.data.is_editmode:
        return
    mesh = _own_mesh(item)
    if shown is None:
        empty(item)
        mesh[SHOWN] = key
        return
    users = [other for other in bpy.data.objects
             if other.data == mesh and is_computed(other)] if mesh.users > 1 else [item]
    for user in users:
        place(user, shown)
    if mesh.get(SHOWN) != key:
        _fill(item, key, shown)
    for user in users:
        build.set_provenance(user, shown.surface, build.Options(shown.scale, shown.crisp), shown.names)
        libraries.succeed(user)


def _fill(item, key, shown):
    mesh = item.data
    kept = _keep_of_user(item, shown)
    build.clear_geometry(mesh)
    if not mesh.materials:
        build.add_materials(mesh, shown.surface, [])
    build.fill_mesh(mesh, arrays_about(item, shown), build.fps_of(bpy.context.scene), trusted=True)
    attributes.restore(mesh, kept, shown.arrays)
    mesh[SHOWN] = key
    if frame_count(item) or item.meniscus.source == "OBJECT":
        build.let_exporters_follow(mesh)
    mesh.update()
    watch(item)


def _keep_of_user(item, shown):
    """Returns the attributes that the user added to the mesh of an object."""
    settings = item.meniscus
    source = settings.file if settings.source == "FILE" else settings.atoms and settings.atoms.name
    return attributes.keep_through(item.data, build.OURS | shown.others, source)


def place(item, shown):
    """Sets the place of an object when it first shows a surface of a file: its origin, about which it rotates, is in
    the middle of the molecule. If the scale changes later, the middle stays in place, or in the place that the file
    gives. Objects of 0.1.0 have the origin of the file."""
    before = item.get("meniscus_scale", shown.scale)
    if item.meniscus.source == "FILE" and "meniscus_generator" not in item:
        origin = np.zeros(3)
        if item.meniscus.center:
            source = build.source_of(shown.surface.header)
            origin = build.scene_origin(bpy.context.scene, lambda: shown.middle, source, shown.atoms)
            item["meniscus_origin"] = [float(value) for value in origin]
        item["meniscus_middle"] = [float(value) for value in shown.middle]
        item["meniscus_atoms"] = shown.atoms
        item.location += mathutils.Vector((shown.middle - origin) * shown.scale)
    elif before != shown.scale and ("meniscus_middle" in item) != ("meniscus_origin" in item):
        place = mathutils.Vector(item["meniscus_middle" if "meniscus_middle" in item else "meniscus_origin"][:])
        item.location += place * ((shown.scale - before) * (1.0 if "meniscus_middle" in item else -1.0))


def arrays_about(item, shown):
    """Returns the arrays of a Shown with positions relative to the object's origin."""
    shift = shown.base - np.array(item.get("meniscus_middle", (0.0, 0.0, 0.0))[:])
    if item.meniscus.source != "FILE" or not shift.any():
        return shown.arrays
    return dataclasses.replace(shown.arrays,
                               positions=(shown.arrays.positions + shift * shown.scale).astype(np.float32))


def keep(key, shown):
    """Keeps a surface under a key. The oldest ones are dropped if they exceed KEPT_BYTES."""
    _kept.pop(key, None)
    _kept[key] = shown
    sizes = {each: 0 if kept is None else kept.arrays.nbytes for each, kept in _kept.items()}
    total = sum(sizes.values())
    while total > KEPT_BYTES and len(_kept) > 1:
        oldest = next(iter(_kept))
        total -= sizes[oldest]
        del _kept[oldest]


def forget():
    for memory in (_kept, _vertices):
        memory.clear()
    attributes.forget()
