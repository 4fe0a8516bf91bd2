# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts computed surfaces into the meshes of objects, and keeps some for when they show again. Each object shows its own request."""

import dataclasses

import bpy
import mathutils
import numpy as np

from . import attributes, build, compat, libraries, mesh_arrays, mns_reader, molecular_nodes

#: Of a mesh: the key of the request that it shows.
SHOWN = "meniscus_shown"
#: Surfaces that are kept, for undo and for frames that come again; bytes.
KEPT_BYTES = 1 << 28

_kept = {}  # key -> Shown or None, the oldest first
_vertices = {}  # identity of a mesh -> how many it had when it was last watched


class Shown:
    """What a mesh shows: header of the surface, middle of its atoms in Å, how many they are, and the arrays that fill the mesh,
    whose positions lie about `base`, Å."""

    def __init__(self, result, wanted):
        self.surface = mns_reader.Surface("a computed surface", result["header"], {})
        self.middle, self.base, self.atoms = result["middle"], result["base"], result["atoms"]
        self.arrays = mesh_arrays.MeshArrays(**result["arrays"])
        self.scale, self.crisp = wanted.scale, wanted.crisp
        self.names = mesh_arrays.names_of(self.surface)
        self.others = {each.name for each in wanted.others}


def is_computed(item):
    """True of an object of this file that shows a computed surface."""
    return item is not None and item.type == "MESH" and item.meniscus.source != "NONE" and item.library is None


def asks_alike(item, other):
    """Whether two objects ask for the same surface now."""
    time = bpy.context.scene.frame_current_final
    return is_computed(other) and item.meniscus.asked() == other.meniscus.asked() and place_at(item, time) == place_at(other, time)


def place_at(item, time):
    """Which frame of its run an object shows at a moment of the scene; 0: it has no run. None: nothing shows."""
    settings = item.meniscus
    count = frame_count(item)
    if count == 0:
        return 0
    if settings.by_hand:
        return settings.timing().within(compat.value_at(item, "meniscus.frame", time), count)
    return settings.timing().place(time, count)


def frame_count(item):
    """Of its run; 0: it has none, or has not been read."""
    settings = item.meniscus
    if settings.source == "OBJECT":
        return len(molecular_nodes.frames_of(settings.atoms)) if settings.atoms is not None else 0
    return int(item.get("meniscus_frames", 0)) if settings.is_run else 0


def watch(item):
    """Remembers what its mesh is like, for was_changed."""
    _vertices[compat.identity(item.data)] = len(item.data.vertices)


def was_changed(item):
    """Whether a user has joined or edited its mesh since a surface for it was asked for or shown."""
    return _vertices.get(compat.identity(item.data), len(item.data.vertices)) != len(item.data.vertices)


def _own_mesh(item):
    return libraries.own_mesh(item, lambda other: not is_computed(other) or asks_alike(item, other))


def empty(item):
    mesh, shown = _own_mesh(item), _kept.get(item.data.get(SHOWN))
    if shown is not None:
        _keep_of_user(item, shown)
    build.clear_geometry(mesh)
    mesh[SHOWN] = ""
    mesh.update()
    watch(item)


def show(item, key, shown):
    """Puts what was computed into the mesh of an object; materials, modifiers and attributes of the user remain. While the mesh
    is edited it stays as it is."""
    if item.data.is_editmode:
        return
    mesh = _own_mesh(item)
    if shown is None:
        empty(item)
        mesh[SHOWN] = key
        return
    users = [other for other in bpy.data.objects if other.data == mesh and is_computed(other)] if mesh.users > 1 else [item]
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
    attributes.give_back(mesh, kept, shown.arrays)
    mesh[SHOWN] = key
    if frame_count(item) or item.meniscus.source == "OBJECT":
        build.let_exporters_follow(mesh)
    mesh.update()
    watch(item)


def _keep_of_user(item, shown):
    """Attributes that the user gave to the mesh."""
    settings = item.meniscus
    source = settings.file if settings.source == "FILE" else settings.atoms and settings.atoms.name
    return attributes.keep_through(item.data, build.OURS | shown.others, source)


def place(item, shown):
    """The place of the object when it first shows something of a file: its origin in the middle of the molecule, about which it
    turns. If its scale changes the middle stays where it is, or where the file has it. Objects of 0.1.0 have the file's origin."""
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
    """The arrays of what is shown, with positions about the object's origin."""
    shift = shown.base - np.array(item.get("meniscus_middle", (0.0, 0.0, 0.0))[:])
    if item.meniscus.source != "FILE" or not shift.any():
        return shown.arrays
    return dataclasses.replace(shown.arrays, positions=(shown.arrays.positions + shift * shown.scale).astype(np.float32))


def keep(key, shown):
    """For as long as there is room; the oldest go."""
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
