# SPDX-License-Identifier: GPL-3.0-or-later
"""Turns a checked surface into Blender data, completely or not at all: after an error, everything new is removed."""

import contextlib
import functools
import math
import os

import bmesh
import bpy
import mathutils
import numpy as np

from . import attributes, compat, joined, libraries, looks, materials, mns_reader, sequence_reader
from .mesh_arrays import NAMES, OURS, names_of, of_surface

#: Two molecules with equal numbers of atoms are taken for the same if they have at least this many.
MANY_ATOMS = 100
#: The greatest number of layers of translucent surfaces along one ray.
MOST_LAYERS = 256


class Options:
    """The options of an import. Raises MnsError if the scale is not a positive number.

    scale: Blender units per Å.
    crisp_colors: True if colours change at edges, False if they blend between vertices.
    own_materials: True for new materials, False for those that all imports share.
    parts: True for one object for the outer surface and one for the cavities.
    center: True if coordinates are relative to the origin of the scene (scene_origin()).
    import_camera: True to import the camera of the file.
    use_camera: True to make it the camera of the scene, with the size of its picture.
    camera: a dict that replaces the camera of the file, or None."""

    def __init__(self, scale=0.1, crisp_colors=True, own_materials=False, parts=False, center=False, import_camera=True,
                 use_camera=True, camera=None):
        if not (math.isfinite(scale) and scale > 0.0):
            raise mns_reader.MnsError(f"scale {scale} is not a positive number")
        self.scale, self.crisp_colors, self.own_materials, self.parts = scale, crisp_colors, own_materials, parts
        self.center, self.import_camera, self.use_camera = center, import_camera, use_camera
        self.camera = camera


class Import:
    """The result of an import: the collection, an object for every copy of every surface, and the camera's object or
    None."""

    def __init__(self):
        self.collection = None
        self.surfaces = []
        self.camera = None


@contextlib.contextmanager
def whole_or_nothing():
    """Removes all data that was added to the file within the context if an exception ends it."""
    before = {store: set(store) for store in (bpy.data.objects, bpy.data.meshes, bpy.data.cameras, bpy.data.collections,
                                              bpy.data.materials, bpy.data.node_groups, bpy.data.actions)}
    try:
        yield
    except BaseException:
        for store, kept in before.items():
            for item in set(store) - kept:
                store.remove(item)
        raise


def reports_errors(execute):
    """Decorates an operator's function so that it reports MnsError and OSError, and ends as cancelled."""

    @functools.wraps(execute)
    def reporting(operator, context):
        try:
            return execute(operator, context)
        except (mns_reader.MnsError, OSError) as error:
            operator.report({"ERROR"}, str(error))
            return {"CANCELLED"}

    return reporting


def import_file(path, context=None, **options):
    """Reads a .mns file into a new collection, and returns an Import. options: arguments of Options. After
    mns_reader.MnsError or OSError nothing is left in the scene."""
    context = context or bpy.context
    file = mns_reader.read(path)
    options = Options(**options)
    source, atoms = source_of(file.header), sum(len(surface["atom.center"]) for surface in file.objects)
    origin = scene_origin(context.scene, lambda: middle_of(sequence_reader.points_of(file)), source,
                          atoms) if options.center else np.zeros(3)
    stem = os.path.splitext(os.path.basename(path))[0]
    made = Import()
    shot = {**file.header.get("camera", {}), **(options.camera or {})}
    meshes, new_materials = [], []
    with whole_or_nothing():
        made.collection = bpy.data.collections.new(stem)
        names = names_of(*file.objects)
        for key, surface in parts_of(file, options.parts):
            name = f"{stem}.{key if len(file.objects) > 1 or options.parts else 'surface'}"
            meshes.append(build_mesh(surface, name, options, new_materials, fps_of(context.scene), names))
            for copy in surface.copies:  # all copies share one mesh
                made.surfaces.append(add_copy(meshes[-1], copy, surface, path, file, options, origin, key))
                made.collection.objects.link(made.surfaces[-1])
        if options.import_camera and shot:
            camera = bpy.data.cameras.new(stem + ".camera")
            made.camera = bpy.data.objects.new(camera.name, camera)
            place_camera(made.camera, shot, options.scale, origin)
            reach_all(made.camera, sequence_reader.points_of(file), options.scale, origin)
            made.collection.objects.link(made.camera)
        context.scene.collection.children.link(made.collection)
    if made.camera is not None and options.use_camera:
        context.scene.camera = made.camera
        use_picture_size(context.scene, shot)
    let_rays_through(context.scene, meshes)
    present(context, made.surfaces)
    return made


def add_copy(mesh, copy, surface, path, file, options, origin, part=None):
    """Returns a new object for a copy of a surface of a file. Reload finds the surface by `part`, its name in
    parts_of()."""
    item = bpy.data.objects.new(mesh.name, mesh)
    item.matrix_world = placement(copy, options.scale, origin)
    set_provenance(item, surface, options, names_of(*file.objects))
    item["meniscus_file"] = remembered_path(path)
    libraries.note(item)
    item["meniscus_part"] = part or next(name for name, each in parts_of(file, False) if each is surface)
    item["meniscus_atoms"] = sum(len(each["atom.center"]) for each in file.objects)
    item["meniscus_origin"] = [float(value) for value in origin]
    return item


def parts_of(file, apart):
    """Yields pairs of a name, which is unique in the file, and a surface. apart: True to separate cavities from outer
    surfaces."""
    for surface in file.objects:
        name = surface.name if len(file.objects) > 1 else "surface"
        if not apart:
            yield name, surface
            continue
        for role, part in joined.by_role(surface):
            yield (f"{name}.{role}" if len(file.objects) > 1 else role), part


def reload(item, context=None):
    """Reads the file of an imported object again into its mesh. All changes to the object and its mesh remain, and the
    user's attributes follow their atoms. Raises mns_reader.MnsError or OSError, and then changes nothing."""
    context = context or bpy.context
    if item is None or "meniscus_file" not in item:
        raise mns_reader.MnsError("the active object was not imported from a .mns file")
    path = libraries.path_of(item, "meniscus_file")
    file = mns_reader.read(path)
    options = Options(scale=item["meniscus_scale"], crisp_colors=bool(item["meniscus_crisp"]),
                      parts=bool(item["meniscus_parts"]))
    surface = dict(parts_of(file, options.parts)).get(item["meniscus_part"])
    if surface is None:
        raise mns_reader.MnsError(f"{path}: it has no surface {item['meniscus_part']} any more")
    names = names_of(*file.objects)
    mesh, arrays = item.data, of_surface(surface, options.scale, options.crisp_colors, names)
    check_with_blender(arrays)
    dressing = looks.renewed(mesh, surface, options.scale)
    kept = attributes.keep(mesh, OURS)
    clear_geometry(mesh)
    fill_mesh(mesh, arrays, fps_of(context.scene), trusted=True)
    attributes.restore(mesh, kept, arrays)
    mesh[materials.REQUIREMENTS] = materials.requirements_of(surface, materials.stored_requirements(mesh)[1])
    for slot, material in enumerate(dressing):
        if slot == len(mesh.materials):
            mesh.materials.append(None)
        mesh.materials[slot] = material
    mesh.update()
    for other in bpy.data.objects:
        if other.data == mesh:
            set_provenance(other, surface, options, names)
    let_rays_through(context.scene, [mesh])


def check_with_blender(arrays):
    """Raises mns_reader.MnsError if Blender finds faults in a mesh with these arrays. It uses a temporary mesh, so that
    a shown mesh is not changed."""
    mesh = bpy.data.meshes.new("check")
    try:
        fill_mesh(mesh, arrays, 1.0)
    finally:
        bpy.data.meshes.remove(mesh)


def remembered_path(path):
    path = os.path.abspath(path)
    try:
        return bpy.path.relpath(path) if bpy.data.filepath else path
    except ValueError:  # the file is on another drive of Windows
        return path


def middle_of(points):
    """Returns the middle of the bounding box of points (n, 3)."""
    return 0.5 * (points.min(axis=0) + points.max(axis=0))


def scene_origin(scene, otherwise, source, atoms):
    """Returns the origin of coordinates in Å that an earlier import of the same molecule used, so that its surfaces
    stay together, or otherwise() if there is none. Two molecules are the same if their files (source) have the same
    name without endings, or if their numbers of atoms agree and are at least MANY_ATOMS, which is unlikely by
    chance."""
    for item in scene.objects:
        same_name = stem_of(source) and stem_of(source) == stem_of(item.get("meniscus_source", ""))
        is_same = same_name or (atoms >= MANY_ATOMS and atoms == item.get("meniscus_atoms"))
        if "meniscus_origin" in item and any(item["meniscus_origin"]) and is_same:
            return np.array(item["meniscus_origin"][:], dtype=np.float64)
    return np.asarray(otherwise(), dtype=np.float64)


def stem_of(name):
    """Returns the name of a file without its endings."""
    return os.path.basename(name).split(".")[0]


def present(context, items):
    """Selects objects, makes the first active, and shows their colours in solid views that show colours of
    materials."""
    context.view_layer.update()  # drops objects that have just been removed
    for other in context.view_layer.objects:
        other.select_set(False)
    for item in items:
        item.select_set(True)
        show_all_in_viewports(context, item)
    context.view_layer.objects.active = items[0]
    compat.color_solid_views(context)


def let_rays_through(scene, meshes):
    """Raises the number of transparent layers that Cycles renders, if a mesh has opacities. Cycles shows black after
    more layers, and allows eight by default. The number never becomes smaller."""
    if any("opacity" in mesh.attributes for mesh in meshes) and hasattr(scene, "cycles"):
        scene.cycles.transparent_max_bounces = max(scene.cycles.transparent_max_bounces, MOST_LAYERS)


def placement(copy, scale, origin):
    """Returns the matrix of an object. Only the translation is scaled, because mesh coordinates are scaled already.
    origin: the origin of coordinates in Å, which is subtracted."""
    matrix = mathutils.Matrix([[float(value) for value in row] for row in copy] + [[0.0, 0.0, 0.0, 1.0]])
    matrix.translation = (matrix.translation - mathutils.Vector(origin)) * scale
    return matrix


def fps_of(scene):
    return scene.render.fps / scene.render.fps_base


def build_mesh(surface, name, options, new_materials, fps, names, fades=False):
    """Returns a new mesh of a surface. fades: True for materials that fade by the object's colour."""
    mesh = bpy.data.meshes.new(name)
    add_materials(mesh, surface, new_materials, options.own_materials, fades)
    fill_mesh(mesh, of_surface(surface, options.scale, options.crisp_colors, names), fps)
    return mesh


def let_exporters_follow(mesh):
    """Adds a key to a mesh. Exporters of Alembic and USD write a mesh again in later frames only if it has keys, a
    modifier or the like."""
    if mesh.animation_data is None:
        mesh["meniscus_moves"] = 1.0
        mesh.keyframe_insert('["meniscus_moves"]', frame=1.0)


def clear_geometry(mesh):
    """Removes the geometry of a mesh. Materials, properties and animation remain; Mesh.clear_geometry() would remove
    the animation."""
    if mesh.animation_data is None:
        mesh.clear_geometry()
        return
    nothing = bmesh.new()
    nothing.to_mesh(mesh)
    nothing.free()


def fill_mesh(mesh, arrays, fps, trusted=False):
    """Puts mesh_arrays.MeshArrays into a mesh without geometry. Materials remain. fps: frames of the run per second,
    for velocities. trusted: True if the arrays were never in a file, so that Blender need not validate them. After an
    error the mesh is half filled."""
    mesh.vertices.add(len(arrays.positions))
    mesh.vertices.foreach_set("co", arrays.positions.ravel())
    compat.set_triangles(mesh, arrays.triangles)
    mesh.update(calc_edges=True)
    for each in arrays.attributes:
        attributes.add(mesh, *each)
    if arrays.velocity is not None:  # Cycles blurs motion by the attribute of this name, in units per second
        attributes.add(mesh, "velocity", "FLOAT_VECTOR", "POINT", arrays.velocity * np.float32(fps))
    mesh.polygons.foreach_set("material_index", arrays.slots)
    if len(arrays.sharp_edges):
        compat.mark_sharp(mesh, arrays.sharp_edges)
    if not trusted and mesh.validate(clean_customdata=False):
        raise mns_reader.MnsError("Blender found faults in the mesh")
    compat.set_normals(mesh, arrays.normals)
    compat.set_active_color(mesh, "Color")


def add_materials(mesh, surface, new_materials, own=False, fades=False):
    """Adds the materials of a surface to a mesh. own: True for new materials, False for those that all imports share.
    fades: True for materials that fade by the object's colour."""
    mesh[materials.REQUIREMENTS] = materials.requirements_of(surface, fades)
    for role, kind in materials.wanted(surface):
        mesh.materials.append(
            materials.find_or_make(role, kind, new_materials, own, materials.hatching_of(surface, role),
                                   materials.looks_of(surface), fades))


def source_of(header):
    """Returns the name of the molecule's file from the header of a file or a manifest, or "" if it is not there."""
    return str(header.get("source", {}).get("file", ""))


def set_provenance(item, surface, options, names):
    header = surface.header
    item["meniscus_generator"] = str(header.get("generator", ""))
    item["meniscus_source"] = source_of(header)
    item["meniscus_probe_radius"] = float(header.get("probe_radius", 0.0))
    item["meniscus_tolerance"] = float(header["mesh"].get("tolerance", 0.0))
    item["meniscus_scale"] = float(options.scale)
    item["meniscus_crisp"] = int(options.crisp_colors)
    item["meniscus_parts"] = int(options.parts)
    set_names(item, names)
    item["meniscus_area"] = float(header.get("area", 0.0))
    item["meniscus_volume"] = float(header.get("volume", 0.0))


def set_names(item, names):
    """Sets the custom properties with the lists of names that attributes of a mesh refer to by index. Molecular Nodes
    uses chain_ids in the same way."""
    for attribute, (_, key) in NAMES.items():
        wanted = list(names.get(attribute, ()))
        if wanted != list(item.get(key, ())):
            item[key] = wanted


def place_camera(item, shot, scale, origin=(0.0, 0.0, 0.0)):
    """Moves a camera's object to the place of `shot`, the camera of a file. origin: the origin of the scene's
    coordinates in Å."""
    item["meniscus_shadows"], item["meniscus_shadow_softness"] = shot.get("shadows",
                                                                          0.0), shot.get("shadow_softness", 0.0)
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


def reach_all(item, points, scale, origin=(0.0, 0.0, 0.0)):
    """Sets the clipping of a camera so that no atom at `points`, (n, 3) Å, is cut off. The far end never becomes
    nearer."""
    place = np.array(item.matrix_world.translation) / scale + np.array(origin)
    reach = float(np.linalg.norm(points - place, axis=1).max()) * scale
    item.data.clip_start = max(1e-4 * reach, 1e-6)
    item.data.clip_end = max(item.data.clip_end, 4.0 * reach)


def use_picture_size(scene, shot):
    size = shot.get("size")
    if size:
        scene.render.resolution_x, scene.render.resolution_y = int(size[0]), int(size[1])
        scene.render.resolution_percentage = 100
        scene.render.pixel_aspect_x = scene.render.pixel_aspect_y = 1.0


def views_of(context):
    """Yields the 3-D views of all windows."""
    for window in getattr(context.window_manager, "windows", ()):
        for area in window.screen.areas:
            for space in area.spaces:
                if space.type == "VIEW_3D":
                    yield space


def show_all_in_viewports(context, item):
    """Raises clip_end of 3-D views if they would cut off the object."""
    corners = (item.matrix_world @ mathutils.Vector(corner) for corner in item.bound_box)
    reach = 4.0 * max((corner.length for corner in corners), default=0.0)
    for space in views_of(context):
        space.clip_end = max(space.clip_end, reach)
