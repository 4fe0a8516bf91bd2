# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that differs between Blender 3.4 and 5.x. Run here on 3.4.1; the other branches follow the API's change logs."""

import math

import numpy as np


def set_smooth_with_normals(mesh, corner_normals):
    """Gives every corner of `mesh` its normal: float array (3 * triangles, 3). Call last, after positions and edges."""
    if hasattr(mesh, "use_auto_smooth"):  # before 4.1 custom normals are ignored without it
        mesh.polygons.foreach_set("use_smooth", np.ones(len(mesh.polygons), dtype=bool))
        mesh.use_auto_smooth = True
        mesh.auto_smooth_angle = math.pi
    else:
        mesh.shade_smooth()
    mesh.normals_split_custom_set(corner_normals)


def set_smooth_with_vertex_normals(mesh, vertex_normals):
    """The same for meshes without sharp corners, at half the time."""
    if hasattr(mesh, "use_auto_smooth"):
        mesh.polygons.foreach_set("use_smooth", np.ones(len(mesh.polygons), dtype=bool))
        mesh.use_auto_smooth = True
        mesh.auto_smooth_angle = math.pi
    else:
        mesh.shade_smooth()
    mesh.normals_split_custom_set_from_vertices(vertex_normals)


def set_triangles(mesh, triangles):
    """Makes the faces: int array (triangles, 3). loop_total became read-only in 3.6."""
    count = len(triangles)
    mesh.loops.add(3 * count)
    mesh.polygons.add(count)
    mesh.loops.foreach_set("vertex_index", np.ascontiguousarray(triangles, dtype=np.int32).ravel())
    mesh.polygons.foreach_set("loop_start", np.arange(0, 3 * count, 3, dtype=np.int32))
    try:
        mesh.polygons.foreach_set("loop_total", np.full(count, 3, dtype=np.int32))
    except (AttributeError, RuntimeError, TypeError):
        pass


def mark_sharp(mesh, keys):
    """Marks the edges whose sorted vertex pair a << 32 | b is in `keys` (uint64) as sharp."""
    pairs = np.empty(2 * len(mesh.edges), dtype=np.int32)
    mesh.edges.foreach_get("vertices", pairs)
    pairs = np.sort(pairs.reshape(-1, 2), axis=1).astype(np.uint64)
    sharp = np.isin(pairs[:, 0] << np.uint64(32) | pairs[:, 1], keys)
    if hasattr(mesh.edges[0], "use_edge_sharp"):
        mesh.edges.foreach_set("use_edge_sharp", sharp)
    else:
        attribute = mesh.attributes.get("sharp_edge") or mesh.attributes.new("sharp_edge", "BOOLEAN", "EDGE")
        attribute.data.foreach_set("value", sharp)
    return int(sharp.sum())


def corner_normals(mesh):
    """The normals Blender will shade with, (corners, 3)."""
    if hasattr(mesh, "calc_normals_split"):
        mesh.calc_normals_split()
        normals = np.empty(3 * len(mesh.loops), dtype=np.float32)
        mesh.loops.foreach_get("normal", normals)
        mesh.free_normals_split()
    else:
        normals = np.empty(3 * len(mesh.loops), dtype=np.float32)
        mesh.corner_normals.foreach_get("vector", normals)
    return normals.reshape(-1, 3)


def use_nodes(material):
    """Node trees are always there from 5.0 on."""
    if not material.use_nodes or material.node_tree is None:
        material.use_nodes = True


def principled_input(node, *names):
    """The first socket of these names that this version has: 4.0 renamed several."""
    for name in names:
        if name in node.inputs:
            return node.inputs[name]
    return None


def can_drop_files(bpy):
    """FileHandler came with 4.1."""
    return hasattr(bpy.types, "FileHandler")


def add_geometry_sockets(tree):
    """One geometry in, one out: 4.0 moved the sockets of a node group to its interface."""
    if hasattr(tree, "interface"):
        tree.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
        tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    else:
        tree.inputs.new("NodeSocketGeometry", "Geometry")
        tree.outputs.new("NodeSocketGeometry", "Geometry")
    if hasattr(tree, "is_modifier"):  # 4.0 and later offer only such trees to modifiers
        tree.is_modifier = True


def frame_rate(fps):
    """fps and fps_base of the render settings: the first is a whole number before 5.0."""
    whole = max(1, round(fps))
    return whole, whole / fps


def show_message(bpy, title, text):
    """A message in the window, if there is one."""
    if bpy.app.background or not getattr(bpy.context, "window", None):
        return
    bpy.context.window_manager.popup_menu(lambda menu, _context: menu.layout.label(text=text), title=title, icon="ERROR")
