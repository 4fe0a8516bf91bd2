# SPDX-License-Identifier: GPL-3.0-or-later
"""Turns a surface that mns_reader has checked into Blender data. Whole or not at all: on an error everything is removed."""

import math
import os

import bpy
import mathutils
import numpy as np

from . import compat, mns_reader

#: Slots by role; triangles of cavities take the second.
MATERIALS = ("Meniscus outer", "Meniscus cavity")
FACE_INTEGERS = {  # attribute -> array; on faces, where they stay whole numbers
    "ses_kind": "mesh.kind", "ses_patch": "mesh.patch", "ses_component": "mesh.component",
}
OBJECT_INTEGER = {"ses_object": "mesh.object"}  # only of joined objects
ATOM_INTEGERS = {
    "atom_index": "atom.index", "atomic_number": "atom.atomic_number", "res_id": "atom.res_id", "chain_id": "atom.chain_id",
}
ATOM_FLOATS = {"b_factor": "atom.b_factor", "vdw_radii": "atom.radius"}


class Import:
    """What one import made: the collection, an object for every copy of every surface, the camera's object or None."""

    def __init__(self):
        self.collection = None
        self.surfaces = []
        self.camera = None


def import_file(path, context=None, scale=0.1, crisp_colors=True, import_camera=True, set_size=True):
    """Reads a .mns file into a new collection. Raises mns_reader.MnsError or OSError and then leaves nothing behind."""
    context = context or bpy.context
    file = mns_reader.read(path)
    if not (math.isfinite(scale) and scale > 0.0):
        raise mns_reader.MnsError(f"scale {scale} is not a positive number")
    stem = os.path.splitext(os.path.basename(path))[0]
    made = Import()
    camera = None
    meshes, new_materials = [], []
    try:
        made.collection = bpy.data.collections.new(stem)
        for surface in file.objects:
            name = f"{stem}.{surface.name if len(file.objects) > 1 else 'surface'}"
            meshes.append(build_mesh(surface, name, scale, crisp_colors, new_materials, fps_of(context.scene)))
            for copy in surface.copies:  # linked: all copies share one mesh
                made.surfaces.append(bpy.data.objects.new(name, meshes[-1]))
                made.surfaces[-1].matrix_world = placement(copy, scale)
                set_provenance(made.surfaces[-1], surface, scale)
                made.collection.objects.link(made.surfaces[-1])
        if import_camera and "camera" in file.header:
            camera = bpy.data.cameras.new(stem + ".camera")
            made.camera = bpy.data.objects.new(camera.name, camera)
            place_camera(made.camera, file.header["camera"], scale)
            reach_all(made.camera, file, scale)
            made.collection.objects.link(made.camera)
        context.scene.collection.children.link(made.collection)
    except BaseException:
        for store, items in ((bpy.data.objects, [*made.surfaces, made.camera]), (bpy.data.collections, [made.collection]),
                             (bpy.data.meshes, meshes), (bpy.data.cameras, [camera]),
                             (bpy.data.materials, new_materials)):
            for item in items:
                if item is not None:
                    store.remove(item)
        raise
    if made.camera is not None:
        context.scene.camera = made.camera
        if set_size:
            use_picture_size(context.scene, file.header["camera"])
    for item in made.surfaces:
        show_all_in_viewports(context, item)
    return made


def placement(copy, scale):
    """The object's matrix: mesh coordinates are already scaled, so only the translation is."""
    matrix = mathutils.Matrix([[float(value) for value in row] for row in copy] + [[0.0, 0.0, 0.0, 1.0]])
    matrix.translation *= scale
    return matrix


def positions_of(surface, scale):
    """Vertex positions in Blender units, float32: Å times scale, in the input file's own coordinates."""
    origin = np.array(surface.header["mesh"]["origin"], dtype=np.float64)
    return ((surface["mesh.position"].astype(np.float64) + origin) * scale).astype(np.float32)


def fps_of(scene):
    return scene.render.fps / scene.render.fps_base


def build_mesh(surface, name, scale, crisp_colors, new_materials, fps):
    mesh = bpy.data.meshes.new(name)
    try:
        add_materials(mesh, new_materials)
        fill_mesh(mesh, surface, scale, crisp_colors, fps)
    except BaseException:
        bpy.data.meshes.remove(mesh)
        raise
    return mesh


def fill_mesh(mesh, surface, scale, crisp_colors, fps):
    """Puts a surface into a mesh without geometry. Materials stay. On an error the mesh is half filled."""
    positions = positions_of(surface, scale)
    triangles = surface["mesh.triangle"]
    if surface.header["mesh"].get("closed", True) and not mns_reader.is_closed(triangles):
        raise mns_reader.MnsError(f"{surface.path}: the mesh is not closed")
    mesh.vertices.add(len(positions))
    mesh.vertices.foreach_set("co", positions.ravel())
    compat.set_triangles(mesh, triangles)
    mesh.update(calc_edges=True)
    add_attributes(mesh, surface, crisp_colors)
    if surface.get("mesh.velocity") is not None:  # Cycles blurs by the attribute of this name: units per second
        add_attribute(mesh, "velocity", "FLOAT_VECTOR", "POINT",
                      (surface["mesh.velocity"] * (scale * fps)).astype(np.float32), "vector")
    cavity = np.array([part["kind"] == "cavity" for part in surface.header["components"]], dtype=np.int32)
    mesh.polygons.foreach_set("material_index", cavity[surface["mesh.component"]])
    add_sharp_edges(mesh, surface)
    if mesh.validate(clean_customdata=False):
        raise mns_reader.MnsError(f"{surface.path}: Blender found faults in the mesh")
    add_normals(mesh, surface)


def add_attribute(mesh, name, kind, domain, values, field="value"):
    attribute = mesh.attributes.new(name, kind, domain)
    attribute.data.foreach_set(field, np.ascontiguousarray(values).ravel())


def add_attributes(mesh, surface, crisp_colors):
    atom = surface["mesh.atom"]
    triangles = surface["mesh.triangle"]
    for name, array in {**FACE_INTEGERS, **OBJECT_INTEGER}.items():  # INT, not INT8: Cycles 3.4 reads INT8 as 0
        if surface.get(array) is not None:
            add_attribute(mesh, name, "INT", "FACE", surface[array].astype(np.int32))
    if surface.get("atom.index") is None:  # version 1: one object, whose atoms are those of the molecule in order
        add_attribute(mesh, "atom_index", "INT", "FACE", atom.astype(np.int32))
    for name, array in ATOM_INTEGERS.items():
        if surface.get(array) is not None:
            add_attribute(mesh, name, "INT", "FACE", surface[array][atom].astype(np.int32))
    corners = np.bincount(triangles.ravel(), minlength=len(mesh.vertices)).astype(np.float64)

    def mean_at_vertices(values):
        total = np.bincount(triangles.ravel(), np.repeat(values, 3), len(mesh.vertices))
        return total / np.maximum(corners, 1.0)

    for name, array in ATOM_FLOATS.items():
        if surface.get(array) is not None:
            values = mean_at_vertices(surface[array][atom].astype(np.float64))
            add_attribute(mesh, name, "FLOAT", "POINT", values.astype(np.float32))
    colors = face_colors(surface)
    if crisp_colors:
        rgba = np.ones((len(triangles), 3, 4), dtype=np.float32)
        rgba[:, :, :3] = linear(colors)[:, None, :]
        add_attribute(mesh, "Color", "BYTE_COLOR", "CORNER", rgba, "color")
    else:
        rgba = np.ones((len(mesh.vertices), 4), dtype=np.float32)
        for channel in range(3):
            rgba[:, channel] = mean_at_vertices(linear(colors)[:, channel])
        add_attribute(mesh, "Color", "FLOAT_COLOR", "POINT", rgba, "color")


def face_colors(surface):
    """sRGB per triangle."""
    kinds = surface.header.get("kind_colors")
    if kinds is not None:
        return np.array(kinds, dtype=np.float32)[surface["mesh.kind"]]
    return surface["atom.color"][surface["mesh.atom"]]


def linear(srgb):
    """Scene-linear Rec. 709, which Blender's colour attributes hold."""
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4).astype(np.float32)


def add_materials(mesh, new_materials):
    for name in MATERIALS:
        material = bpy.data.materials.get(name)  # one that a user has edited stays as it is
        if material is None:
            material = bpy.data.materials.new(name)
            new_materials.append(material)
            fill_material(material)
        mesh.materials.append(material)


def fill_material(material):
    compat.use_nodes(material)
    tree = material.node_tree
    shader = next((node for node in tree.nodes if node.type == "BSDF_PRINCIPLED"), None)
    if shader is None:
        shader = tree.nodes.new("ShaderNodeBsdfPrincipled")
    attribute = tree.nodes.new("ShaderNodeAttribute")
    attribute.attribute_name = "Color"
    attribute.location = (shader.location[0] - 220, shader.location[1])
    tree.links.new(attribute.outputs["Color"], shader.inputs["Base Color"])
    roughness = compat.principled_input(shader, "Roughness")
    if roughness is not None:
        roughness.default_value = 0.45


def add_sharp_edges(mesh, surface):
    pairs = np.sort(surface["mesh.sharp_edge"], axis=1).astype(np.uint64) if surface["mesh.sharp_edge"].size else None
    if pairs is not None:
        compat.mark_sharp(mesh, pairs[:, 0] << np.uint64(32) | pairs[:, 1])


def add_normals(mesh, surface):
    normals = surface["mesh.normal"]
    sharp = surface["mesh.sharp_corner"]
    if not len(sharp):
        compat.set_smooth_with_vertex_normals(mesh, normals)
        return
    corners = normals[surface["mesh.triangle"].ravel()]
    corners[sharp] = surface["mesh.sharp_corner_normal"]
    compat.set_smooth_with_normals(mesh, corners)


def set_provenance(item, surface, scale):
    header = surface.header
    item["meniscus_generator"] = str(header.get("generator", ""))
    item["meniscus_source"] = str(header.get("source", {}).get("file", ""))
    item["meniscus_probe_radius"] = float(header.get("probe_radius", 0.0))
    item["meniscus_tolerance"] = float(header["mesh"].get("tolerance", 0.0))
    item["meniscus_scale"] = float(scale)
    item["meniscus_area"] = float(header.get("area", 0.0))
    item["meniscus_volume"] = float(header.get("volume", 0.0))


def place_camera(item, shot, scale, origin=(0.0, 0.0, 0.0)):
    """Moves a camera's object to where `shot`, the camera of a file, stands. origin: Å, of the scene's coordinates."""
    position, target, up = (mathutils.Vector(shot[key]) for key in ("position", "target", "up"))
    forward = (target - position).normalized()
    right = forward.cross(up).normalized()
    axes = mathutils.Matrix((right, right.cross(forward), -forward)).transposed()
    item.matrix_world = mathutils.Matrix.Translation((position - mathutils.Vector(origin)) * scale) @ axes.to_4x4()
    camera = item.data
    camera.sensor_fit = "VERTICAL"
    if shot["projection"] == "orthographic":
        camera.type = "ORTHO"
        camera.ortho_scale = shot["height"] * scale
    else:
        camera.type = "PERSP"
        camera.lens_unit = "FOV"
        camera.angle_y = math.radians(shot["vertical_fov"])


def reach_all(item, file, scale, origin=(0.0, 0.0, 0.0)):
    """Sets the clipping of a camera so that no atom of the file is cut off; never brings its end nearer."""
    place = np.array(item.matrix_world.translation) / scale + np.array(origin)
    reach = max(float(np.linalg.norm(surface["atom.center"] @ copy[:, :3].T + copy[:, 3] - place, axis=1).max())
                for surface in file.objects for copy in surface.copies) * scale
    item.data.clip_start = max(1e-4 * reach, 1e-6)
    item.data.clip_end = max(item.data.clip_end, 4.0 * reach)


def use_picture_size(scene, shot):
    size = shot.get("size")
    if size:
        scene.render.resolution_x, scene.render.resolution_y = int(size[0]), int(size[1])
        scene.render.resolution_percentage = 100
        scene.render.pixel_aspect_x = scene.render.pixel_aspect_y = 1.0


def show_all_in_viewports(context, item):
    """Raises clip_end of 3-D views only if the body would be cut off."""
    corners = (item.matrix_world @ mathutils.Vector(corner) for corner in item.bound_box)
    reach = 4.0 * max((corner.length for corner in corners), default=0.0)
    for window in getattr(context.window_manager, "windows", ()):
        for area in window.screen.areas:
            for space in area.spaces:
                if space.type == "VIEW_3D" and space.clip_end < reach:
                    space.clip_end = reach
