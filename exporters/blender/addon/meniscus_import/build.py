# SPDX-License-Identifier: GPL-3.0-or-later
"""Turns a surface that mns_reader has checked into Blender data. Whole or not at all: on an error everything is removed."""

import math
import os

import bpy
import mathutils
import numpy as np

from . import attributes, compat, joined, materials, mns_reader

#: Of a surface that is seen through, along one ray.
MOST_LAYERS = 256
#: Attribute -> array; on faces, where they stay whole numbers. ses_object: only of joined objects.
FACE_INTEGERS = {
    "ses_kind": "mesh.kind", "ses_patch": "mesh.patch", "ses_component": "mesh.component", "ses_object": "mesh.object",
}
#: The attributes of Molecular Nodes, on points as there: the array of the atoms, the type. vdw_radii in Blender units, chain_id
#: the place of the chain's name among the sorted ones.
POINT_NUMBERS = {
    "atomic_number": ("atom.atomic_number", "INT"), "res_id": ("atom.res_id", "INT"), "chain_id": ("atom.chain_id", "INT"),
    "b_factor": ("atom.b_factor", "FLOAT"), "vdw_radii": ("atom.radius", "FLOAT"),
}
#: All that an import makes.
OURS = {"atom_index", "opacity", "velocity", "Color", "ses_cap", "cap_stripe", "map_value", "map_known", *FACE_INTEGERS, *POINT_NUMBERS}


class Options:
    """How surfaces come into a scene. scale: Blender units per Å. crisp_colors: they change at edges, not between vertices.
    own_materials: not those that all imports share. parts: an object for what is outside and one for the cavities.
    center: moved by the origin of the scene (scene_origin). import_camera: the file's; use_camera: as the scene's, with the
    size of its picture."""

    def __init__(self, scale=0.1, crisp_colors=True, own_materials=False, parts=False, center=False, import_camera=True,
                 use_camera=True):
        if not (math.isfinite(scale) and scale > 0.0):
            raise mns_reader.MnsError(f"scale {scale} is not a positive number")
        self.scale, self.crisp_colors, self.own_materials, self.parts = scale, crisp_colors, own_materials, parts
        self.center, self.import_camera, self.use_camera = center, import_camera, use_camera


class Import:
    """What one import made: the collection, an object for every copy of every surface, the camera's object or None."""

    def __init__(self):
        self.collection = None
        self.surfaces = []
        self.camera = None


def import_file(path, context=None, **options):
    """Reads a .mns file into a new collection; options: of Options. Raises mns_reader.MnsError or OSError and then leaves
    nothing behind."""
    context = context or bpy.context
    file = mns_reader.read(path)
    options = Options(**options)
    origin = scene_origin(context.scene, lambda: middle_of(file)) if options.center else np.zeros(3)
    stem = os.path.splitext(os.path.basename(path))[0]
    made = Import()
    camera = None
    meshes, new_materials = [], []
    try:
        made.collection = bpy.data.collections.new(stem)
        chains = sorted({str(name) for surface in file.objects for name in surface.header.get("chain_names", [])})
        for key, surface in parts_of(file, options.parts):
            name = f"{stem}.{key if len(file.objects) > 1 or options.parts else 'surface'}"
            meshes.append(build_mesh(surface, name, options, new_materials, fps_of(context.scene), chains))
            for copy in surface.copies:  # linked: all copies share one mesh
                made.surfaces.append(bpy.data.objects.new(name, meshes[-1]))
                made.surfaces[-1].matrix_world = placement(copy, options.scale, origin)
                set_provenance(made.surfaces[-1], surface, options, chains)
                made.surfaces[-1]["meniscus_file"] = remembered_path(path)
                made.surfaces[-1]["meniscus_part"] = key
                made.surfaces[-1]["meniscus_origin"] = [float(value) for value in origin]
                made.collection.objects.link(made.surfaces[-1])
        if options.import_camera and "camera" in file.header:
            camera = bpy.data.cameras.new(stem + ".camera")
            made.camera = bpy.data.objects.new(camera.name, camera)
            place_camera(made.camera, file.header["camera"], options.scale, origin)
            reach_all(made.camera, file, options.scale, origin)
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
    if made.camera is not None and options.use_camera:
        context.scene.camera = made.camera
        use_picture_size(context.scene, file.header["camera"])
    let_rays_through(context.scene, meshes)
    present(context, made.surfaces)
    return made


def parts_of(file, apart):
    """Pairs: a name that tells a mesh from the others of its file, and its surface. apart: cavities by themselves."""
    for surface in file.objects:
        name = surface.name if len(file.objects) > 1 else "surface"
        if not apart:
            yield name, surface
            continue
        for role, part in joined.by_role(surface):
            yield (f"{name}.{role}" if len(file.objects) > 1 else role), part


def reload(item, context=None):
    """Reads the file of an imported object again into its mesh: materials, modifiers, attributes of the user and where the
    object stands remain. Raises mns_reader.MnsError or OSError and then changes nothing."""
    context = context or bpy.context
    if item is None or "meniscus_file" not in item:
        raise mns_reader.MnsError("the active object was not imported from a .mns file")
    path = bpy.path.abspath(item["meniscus_file"])
    file = mns_reader.read(path)
    options = Options(scale=item["meniscus_scale"], crisp_colors=bool(item["meniscus_crisp"]), parts=bool(item["meniscus_parts"]))
    surface = dict(parts_of(file, options.parts)).get(item["meniscus_part"])
    if surface is None:
        raise mns_reader.MnsError(f"{path}: it has no surface {item['meniscus_part']} any more")
    chains = sorted({str(name) for each in file.objects for name in each.header.get("chain_names", [])})
    old = item.data
    kept = attributes.keep(old, OURS)
    fresh = bpy.data.meshes.new(old.name)
    try:
        for material in old.materials:
            fresh.materials.append(material)
        fill_mesh(fresh, surface, options.scale, options.crisp_colors, fps_of(context.scene), chains)
        attributes.give_back(fresh, kept)
    except BaseException:
        bpy.data.meshes.remove(fresh)
        raise
    users = [other for other in bpy.data.objects if other.data == old]
    old.user_remap(fresh)
    name = old.name
    bpy.data.meshes.remove(old)
    fresh.name = name
    for other in users:
        set_provenance(other, surface, options, chains)
    let_rays_through(context.scene, [fresh])


def remembered_path(path):
    path = os.path.abspath(path)
    return bpy.path.relpath(path) if bpy.data.filepath else path


def middle_of(file):
    """Å: the middle of all atoms in all places."""
    points = np.concatenate([surface["atom.center"] @ copy[:, :3].T + copy[:, 3]
                             for surface in file.objects for copy in surface.copies])
    return 0.5 * (points.min(axis=0) + points.max(axis=0))


def scene_origin(scene, otherwise):
    """Å: what an earlier import took from all coordinates, so that things of one molecule stay together; else otherwise()."""
    for item in scene.objects:
        if "meniscus_origin" in item and any(item["meniscus_origin"]):
            return np.array(item["meniscus_origin"][:], dtype=np.float64)
    return np.asarray(otherwise(), dtype=np.float64)


def present(context, items):
    """Selects them, the first as the active one, and shows their colours in solid views that show those of materials."""
    context.view_layer.update()  # without objects that have just been removed
    for other in context.view_layer.objects:
        other.select_set(False)
    for item in items:
        item.select_set(True)
        show_all_in_viewports(context, item)
    context.view_layer.objects.active = items[0]
    for space in views_of(context):
        if space.shading.color_type == "MATERIAL":
            space.shading.color_type = "VERTEX"


def let_rays_through(scene, meshes):
    """Cycles shows black behind more layers than the scene allows, eight by default; never fewer than it had."""
    if any("opacity" in mesh.attributes for mesh in meshes) and hasattr(scene, "cycles"):
        scene.cycles.transparent_max_bounces = max(scene.cycles.transparent_max_bounces, MOST_LAYERS)


def placement(copy, scale, origin):
    """The object's matrix: mesh coordinates are already scaled, so only the translation is. origin: Å, taken away."""
    matrix = mathutils.Matrix([[float(value) for value in row] for row in copy] + [[0.0, 0.0, 0.0, 1.0]])
    matrix.translation = (matrix.translation - mathutils.Vector(origin)) * scale
    return matrix


def positions_of(surface, scale):
    """Vertex positions in Blender units, float32: Å times scale, in the input file's own coordinates."""
    origin = np.array(surface.header["mesh"]["origin"], dtype=np.float64)
    return ((surface["mesh.position"].astype(np.float64) + origin) * scale).astype(np.float32)


def fps_of(scene):
    return scene.render.fps / scene.render.fps_base


def build_mesh(surface, name, options, new_materials, fps, chains):
    mesh = bpy.data.meshes.new(name)
    try:
        add_materials(mesh, surface, new_materials, options.own_materials)
        fill_mesh(mesh, surface, options.scale, options.crisp_colors, fps, chains)
    except BaseException:
        bpy.data.meshes.remove(mesh)
        raise
    return mesh


def fill_mesh(mesh, surface, scale, crisp_colors, fps, chains, trusted=False):
    """Puts a surface into a mesh without geometry. Materials stay. fps: scene frames a second, for velocities. chains: sorted
    names, whose places are chain_id. trusted: it was never in a file, so Blender need not look for faults. On an error the mesh
    is half filled."""
    surface.check_closed()
    positions = positions_of(surface, scale)
    triangles = surface["mesh.triangle"]
    mesh.vertices.add(len(positions))
    mesh.vertices.foreach_set("co", positions.ravel())
    compat.set_triangles(mesh, triangles)
    mesh.update(calc_edges=True)
    add_attributes(mesh, surface, scale, crisp_colors, chains)
    if surface.get("mesh.velocity") is not None:  # Cycles blurs by the attribute of this name: units per second
        add_attribute(mesh, "velocity", "FLOAT_VECTOR", "POINT",
                      (surface["mesh.velocity"] * (scale * fps)).astype(np.float32), "vector")
    cavity = np.array([part["kind"] == "cavity" for part in surface.header["components"]], dtype=np.int32)
    slots = np.where(caps_of(surface), materials.SLOTS.index("cap"), cavity[surface["mesh.component"]])
    mesh.polygons.foreach_set("material_index", slots.astype(np.int32))
    add_sharp_edges(mesh, surface)
    if not trusted and mesh.validate(clean_customdata=False):
        raise mns_reader.MnsError(f"{surface.path}: Blender found faults in the mesh")
    add_normals(mesh, surface)
    compat.set_active_color(mesh, "Color")


def add_attribute(mesh, name, kind, domain, values, field="value"):
    attribute = mesh.attributes.new(name, kind, domain)
    attribute.data.foreach_set(field, np.ascontiguousarray(values).ravel())


def add_attributes(mesh, surface, scale, crisp_colors, chains):
    atom = surface["mesh.atom"]
    triangles = surface["mesh.triangle"]
    for name, array in FACE_INTEGERS.items():  # INT, not INT8: Cycles 3.4 reads INT8 as 0
        if surface.get(array) is not None:
            add_attribute(mesh, name, "INT", "FACE", surface[array].astype(np.int32))
    index = surface.get("atom.index")  # before version 2 one object, whose atoms are those of the molecule in order
    add_attribute(mesh, "atom_index", "INT", "FACE", (atom if index is None else index[atom]).astype(np.int32))
    if surface.get("atom.opacity") is not None:  # on faces, as colours: it changes at edges
        add_attribute(mesh, "opacity", "FLOAT", "FACE", surface["atom.opacity"][atom].astype(np.float32))
    of_vertex = vertex_atoms(triangles, atom, len(mesh.vertices))
    for name, (array, kind) in POINT_NUMBERS.items():
        if surface.get(array) is None:
            continue
        values = surface[array]
        if name == "vdw_radii":
            values = values * scale
        elif name == "chain_id":
            values = chain_places(surface, chains)[values]
        add_attribute(mesh, name, kind, "POINT", values[of_vertex].astype(np.int32 if kind == "INT" else np.float32))
    if surface.get("mesh.map_value") is not None:
        add_attribute(mesh, "map_value", "FLOAT", "POINT", surface["mesh.map_value"])
        if surface.get("mesh.map_known") is not None:
            add_attribute(mesh, "map_known", "BOOLEAN", "POINT", surface["mesh.map_known"].astype(bool))
    if surface.get("mesh.cap_plane") is not None:
        add_attribute(mesh, "ses_cap", "INT", "FACE", np.where(caps_of(surface), surface["mesh.cap_plane"], -1).astype(np.int32))
        if "hatching" in surface.header["caps"]:
            add_attribute(mesh, "cap_stripe", "FLOAT", "CORNER", stripes(surface))
    colors = linear(corner_colors(surface))
    if crisp_colors:
        rgba = np.ones((len(triangles), 3, 4), dtype=np.float32)
        rgba[:, :, :3] = colors
        add_attribute(mesh, "Color", "BYTE_COLOR", "CORNER", rgba, "color")
    else:
        around = np.maximum(np.bincount(triangles.ravel(), minlength=len(mesh.vertices)), 1)
        rgba = np.ones((len(mesh.vertices), 4), dtype=np.float32)
        for channel in range(3):
            rgba[:, channel] = np.bincount(triangles.ravel(), colors[:, :, channel].ravel(), len(mesh.vertices)) / around
        add_attribute(mesh, "Color", "FLOAT_COLOR", "POINT", rgba, "color")


def caps_of(surface):
    """Which triangles are caps."""
    return surface["mesh.kind"] == mns_reader.CAP


def stripes(surface):
    """Of each corner of a cap how many lines of hatching lie before it; elsewhere between two of them."""
    hatching, cap = surface.header["caps"]["hatching"], caps_of(surface)
    origin = np.array(surface.header["mesh"]["origin"])
    across = np.array(hatching["across"], dtype=np.float64)[surface["mesh.cap_plane"][cap]]
    points = surface["mesh.position"][surface["mesh.triangle"][cap]].astype(np.float64) + origin + surface.header.get("moved_by", 0.0)
    values = np.full((len(cap), 3), 0.5 + 0.5 * hatching["share"], dtype=np.float32)
    values[cap] = np.einsum("tkx,tx->tk", points, across) / hatching["distance"]
    return values


def corner_colors(surface):
    """sRGB per corner of each triangle: (triangles, 3, 3)."""
    colors = np.repeat(face_colors(surface)[:, None, :], 3, axis=1).astype(np.float64)
    of_map = surface.get("mesh.map_color")
    if of_map is not None:
        own = surface.get("atom.own_color")
        by_map = ~caps_of(surface) if own is None else ~caps_of(surface) & (own[surface["mesh.atom"]] == 0)
        colors[by_map] = of_map[surface["mesh.triangle"][by_map]]
    return colors


def vertex_atoms(triangles, atom, count):
    """Of each vertex the atom of one of its triangles, that with the lowest index."""
    found = np.zeros(count, dtype=np.int64)
    found[triangles[::-1].ravel()] = np.repeat(atom[::-1], 3)
    return found


def chain_places(surface, chains):
    """From chain numbers of the file to places in `chains`."""
    names, ids = surface.header.get("chain_names", []), surface["atom.chain_id"]
    if len(ids) and not 0 <= ids.min() <= ids.max() < len(names):
        raise mns_reader.MnsError(f"{surface.path}: array atom.chain_id points to no chain name")
    return np.array([chains.index(str(name)) for name in names] or [0], dtype=np.int32)


def face_colors(surface):
    """sRGB per triangle, but of volume maps."""
    kinds, cap = surface.header.get("kind_colors"), caps_of(surface)
    colors = surface["atom.color"][surface["mesh.atom"]]
    if kinds is not None:
        colors = np.where(cap[:, None], colors, np.array(kinds, dtype=np.float32)[np.where(cap, 0, surface["mesh.kind"])])
    if "color" in surface.header.get("caps", {}):
        colors = np.where(cap[:, None], np.array(surface.header["caps"]["color"], dtype=np.float32), colors)
    return colors


def linear(srgb):
    """Scene-linear Rec. 709, which Blender's colour attributes hold."""
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4).astype(np.float32)


def add_materials(mesh, surface, new_materials, own=False):
    """own: not those that all imports share."""
    for role, kind in materials.wanted(surface):
        mesh.materials.append(materials.find_or_make(role, kind, new_materials, own, materials.hatching_of(surface, role), materials.looks_of(surface)))


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


def set_provenance(item, surface, options, chains):
    header = surface.header
    item["meniscus_generator"] = str(header.get("generator", ""))
    item["meniscus_source"] = str(header.get("source", {}).get("file", ""))
    item["meniscus_probe_radius"] = float(header.get("probe_radius", 0.0))
    item["meniscus_tolerance"] = float(header["mesh"].get("tolerance", 0.0))
    item["meniscus_scale"] = float(options.scale)
    item["meniscus_crisp"] = int(options.crisp_colors)
    item["meniscus_parts"] = int(options.parts)
    item["chain_ids"] = chains  # as Molecular Nodes has them
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


def views_of(context):
    """The 3-D views of all windows."""
    for window in getattr(context.window_manager, "windows", ()):
        for area in window.screen.areas:
            for space in area.spaces:
                if space.type == "VIEW_3D":
                    yield space


def show_all_in_viewports(context, item):
    """Raises clip_end of 3-D views only if the body would be cut off."""
    corners = (item.matrix_world @ mathutils.Vector(corner) for corner in item.bound_box)
    reach = 4.0 * max((corner.length for corner in corners), default=0.0)
    for space in views_of(context):
        space.clip_end = max(space.clip_end, reach)
