# SPDX-License-Identifier: BSD-3-Clause
"""Everything that a .blend file says about its data, as text by path, so that two moments of it can be compared."""

import hashlib

import bpy
import numpy as np

#: Properties of any struct that Blender counts or caches.
VOLATILE = {"rna_type", "bl_rna", "users", "original", "is_evaluated", "is_embedded_data", "is_library_indirect", "is_missing", "is_updated",
            "is_updated_data", "is_updated_shading", "is_valid", "library_weak_reference", "preview", "tag", "session_uid", "is_runtime_data",
            "depsgraph", "dimensions", "bound_box", "is_from_instancer", "is_from_set", "error_location", "error_rotation", "execution_time",
            "uv_sculpt"}  # Blender 4.2 crashes when its brush is read.
#: Properties whose arrays are hashed by _mesh, or whose content is reached in other ways.
ARRAYS = {"vertices", "edges", "loops", "polygons", "loop_triangles", "attributes", "color_attributes", "uv_layers", "vertex_colors",
          "vertex_normals", "polygon_normals", "corner_normals", "loop_triangle_polygons", "sculpt_vertex_colors", "face_maps", "uv_layer_clone", "uv_layer_stencil",
          "vertex_layers_float", "vertex_layers_int", "vertex_layers_string", "polygon_layers_float", "polygon_layers_int",
          "polygon_layers_string", "vertex_creases", "edge_creases", "vertex_paint_masks", "skin_vertices"}
FIELDS = {"FLOAT": ("value", 1), "INT": ("value", 1), "BOOLEAN": ("value", 1), "FLOAT_VECTOR": ("vector", 3), "FLOAT2": ("vector", 2),
          "FLOAT_COLOR": ("color", 4), "BYTE_COLOR": ("color", 4)}
NUMBERS = {"INT": np.int32, "BOOLEAN": bool}
STORES = ("actions", "cameras", "collections", "curves", "images", "lights", "lightprobes", "materials", "meshes", "node_groups", "objects",
          "scenes", "texts", "textures", "worlds")
DEEPEST = 12


def of_data():
    """Returns {ID: {path: text}}; IDs consist of store and name."""
    return {f"{store}/{item.name_full}": of_id(item) for store in STORES for item in getattr(bpy.data, store)}


def of_id(item):
    told = {}
    _struct(item, "", told, set(), 0)
    for key in item.keys():
        if key in item.bl_rna.properties:  # The walk over the struct has seen it.
            continue
        told[f'["{key}"]'] = _custom(item[key])
    if isinstance(item, bpy.types.Mesh):
        told.update(_mesh(item))
    if isinstance(item, bpy.types.Object):
        told["selected"] = item.name in bpy.context.view_layer.objects and str(item.select_get())
    return told


def differences(before, after):
    """Returns sorted texts "ID: path: this became that" for everything that existed before."""
    found = []
    for name, old in before.items():
        new = after.get(name)
        if new is None:
            found.append(f"{name}: gone")
            continue
        found += [f"{name}: {path}: {old.get(path)} became {new.get(path)}" for path in sorted({*old, *new}) if old.get(path) != new.get(path)]
    return sorted(found)


def _custom(value):
    if isinstance(value, bpy.types.ID):
        return value.name_full
    if hasattr(value, "to_dict"):
        return repr(value.to_dict())
    return repr(value.to_list() if hasattr(value, "to_list") else value)


def _struct(value, path, told, above, depth):
    """Records all properties of a struct. above: structs that hold it, for structs point back."""
    key = (value.as_pointer(), value.bl_rna.identifier)
    if key in above or depth > DEEPEST:
        return
    above = above | {key}
    for found in value.bl_rna.properties:
        name = found.identifier
        if name in VOLATILE or (isinstance(value, bpy.types.Mesh) and name in ARRAYS):
            continue
        try:
            held = getattr(value, name)
        except Exception:  # Some properties exist only in some modes.
            continue
        here = f"{path}.{name}"
        if found.type == "POINTER":
            if isinstance(held, bpy.types.ID) and not getattr(held, "is_embedded_data", False):
                told[here] = held.name_full
            elif held is not None:
                _struct(held, here, told, above, depth + 1)
        elif found.type == "COLLECTION":
            _collection(held, here, told, above, depth)
        else:
            told[here] = repr(tuple(held) if getattr(found, "is_array", False) else held)


def _collection(held, here, told, above, depth):
    told[here + ".count"] = str(len(held))
    for place, each in enumerate(held):
        if isinstance(each, bpy.types.ID):
            told[f"{here}[{place}]"] = each.name_full
        elif each is not None:
            _struct(each, f"{here}[{place}]", told, above, depth + 1)


def _mesh(mesh):
    """Returns shape, groups and attributes of a mesh as text by path."""
    corners = np.empty(len(mesh.loops), dtype=np.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    slots = np.empty(len(mesh.polygons), dtype=np.int32)
    mesh.polygons.foreach_get("material_index", slots)
    places = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", places)
    told = {"(corners)": _digest(corners), "(slots)": _digest(slots), "(places)": _digest(places),
            "(groups)": repr([[(each.group, each.weight) for each in vertex.groups] for vertex in mesh.vertices])}
    for attribute in mesh.attributes:
        if attribute.data_type in FIELDS and not attribute.name.startswith("."):
            field, columns = FIELDS[attribute.data_type]
            values = np.empty(columns * len(attribute.data), dtype=NUMBERS.get(attribute.data_type, np.float32))
            attribute.data.foreach_get(field, values)
            told[f"(attribute {attribute.name} {attribute.data_type} {attribute.domain})"] = _digest(values)
    return told


def _digest(values):
    return f"{len(values)} {hashlib.blake2b(values.tobytes(), digest_size=8).hexdigest()}"
