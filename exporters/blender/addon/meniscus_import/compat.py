# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that differs between Blender 3.4 and 5.3. It was run on 3.4.1, and by scripts/check/newer_blenders.sh on
the versions that it lists."""

import math

import numpy as np

try:
    import bpy
except ImportError:  # functions that need numbers only are tested without Blender
    bpy = None


def set_normals(mesh, normals):
    """Sets smooth shading with the normals of vertices, (vertices, 3), or of corners, (3 * triangles, 3), as float32.
    It must be called last, after positions and edges are set."""
    of_corners = len(normals) != len(mesh.vertices)
    if hasattr(mesh, "use_auto_smooth"):  # before 4.1 custom normals are ignored without it
        mesh.polygons.foreach_set("use_smooth", np.ones(len(mesh.polygons), dtype=bool))
        mesh.use_auto_smooth = True
        mesh.auto_smooth_angle = math.pi
    else:
        mesh.shade_smooth()
    if bpy.app.version >= (4, 5, 0):  # earlier versions encode normals, which takes half of the time of an import
        attribute = mesh.attributes.new("custom_normal", "FLOAT_VECTOR", "CORNER" if of_corners else "POINT")
        attribute.data.foreach_set("vector", normals.ravel())
    elif of_corners:
        mesh.normals_split_custom_set(normals)
    else:
        mesh.normals_split_custom_set_from_vertices(normals)


def set_triangles(mesh, triangles):
    """Adds the faces of a mesh. triangles: integers, (triangles, 3). loop_total became read-only in 3.6."""
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
    """Marks the edges whose sorted vertex pair a << 32 | b is in `keys` (uint64) as sharp, and returns their number."""
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


def node_tree(owner):
    """Returns the node tree of a material or a world. Before 5.0 new ones have none, and it is added."""
    if owner.node_tree is None:
        owner.use_nodes = True
    return owner.node_tree


def find_or_add(tree, kind, name):
    """Returns a node by its type, such as "BACKGROUND", or adds it by the name of its class, such as
    "ShaderNodeBackground". A new tree of 5.x may lack it, and labels of nodes are translated, so they identify none."""
    return next((node for node in tree.nodes if node.type == kind), None) or tree.nodes.new(name)


def set_format(settings, file_format):
    """Sets the file format of rendered pictures. From 5.0 on it must be known first if they have layers."""
    if hasattr(settings, "media_type"):
        settings.media_type = "MULTI_LAYER_IMAGE" if file_format == "OPEN_EXR_MULTILAYER" else "IMAGE"
    settings.file_format = file_format
    if hasattr(settings, "use_exr_interleave"):  # all passes in one part of the file, as before 5.0
        settings.use_exr_interleave = True


def principled_input(node, *names):
    """Returns the first of the inputs with these names that this version has, or None. 4.0 renamed several inputs."""
    for name in names:
        if name in node.inputs:
            return node.inputs[name]
    return None


def let_through(material):
    """Makes Eevee show alpha independently of the order of faces. From 4.2 on this is the default, without settings."""
    if not hasattr(material, "surface_render_method"):
        material.blend_method = "HASHED"
        material.shadow_method = "HASHED"


def scatter_smoothly(shader):
    """Selects a smooth method of subsurface scattering before 4.0, whose default random walk makes grain below surfaces
    of saturated colours."""
    if bpy.app.version < (4, 0, 0):
        shader.subsurface_method = "BURLEY"


def refract(material):
    """Makes Eevee refract light in a transmitting surface, if the settings of the scene allow it. The setting has
    another name since 4.2."""
    for name in ("use_screen_refraction", "use_raytrace_refraction"):
        if hasattr(material, name):
            setattr(material, name, True)
            return


def eevee():
    """Returns the identifier of Eevee as an engine, which was another one from 4.2 to 4.5."""
    names = {item.identifier for item in bpy.types.RenderSettings.bl_rna.properties["engine"].enum_items}
    return "BLENDER_EEVEE_NEXT" if "BLENDER_EEVEE_NEXT" in names else "BLENDER_EEVEE"


def set_up_eevee(scene, samples):
    """Sets the samples per pixel of Eevee, and screen-space reflection and refraction, which have other names since
    4.2."""
    scene.eevee.taa_render_samples = samples
    for name in ("use_ssr", "use_ssr_refraction", "use_soft_shadows", "use_gtao", "use_raytracing"):
        if hasattr(scene.eevee, name):
            setattr(scene.eevee, name, True)


def denoise(scene):
    """Makes Cycles denoise its pictures by OpenImageDenoise. Debian's Blender is built without it."""
    import _cycles

    if _cycles.with_openimagedenoise:
        scene.cycles.use_denoising, scene.cycles.denoiser = True, "OPENIMAGEDENOISE"


def cast_shadows(light, wanted):
    """Sets if a light casts shadows. Cycles had a setting of its own before 4.2."""
    light.use_shadow = wanted
    if hasattr(getattr(light, "cycles", None), "cast_shadow"):
        light.cycles.cast_shadow = wanted


def set_active_color(mesh, name):
    """Sets the colour attribute of a mesh that solid views and paint modes show."""
    colors = mesh.color_attributes
    colors.active_color_index = colors.render_color_index = colors.find(name)


def add_node(tree, kind, *inputs, **values):
    """Adds a node by the name of its class, such as "ShaderNodeMath", and returns it. inputs: sockets that are linked to
    its first inputs, or their values; None for the default. values: attributes of the node."""
    node = tree.nodes.new(kind)
    for name, value in values.items():
        setattr(node, name, value)
    for socket, value in zip(node.inputs, inputs):
        if value is not None:
            set_socket(tree, socket, value)
    return node


def set_socket(tree, socket, value):
    """Sets an input to a value, or links it to another socket."""
    if isinstance(value, bpy.types.NodeSocket):
        tree.links.new(value, socket)
    else:
        socket.default_value = value


def math_node(tree, operation, *operands):
    """Adds a node that computes with numbers and sockets, and returns its output."""
    return add_node(tree, "ShaderNodeMath", *operands, operation=operation).outputs[0]


def can_drop_files():
    """Returns True if files can be dropped into the window. FileHandler was added in 4.1."""
    return hasattr(bpy.types, "FileHandler")


def add_geometry_sockets(tree):
    """Adds a geometry input and a geometry output to a node group. 4.0 moved its sockets to its interface."""
    if hasattr(tree, "interface"):
        tree.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
        tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    else:
        tree.inputs.new("NodeSocketGeometry", "Geometry")
        tree.outputs.new("NodeSocketGeometry", "Geometry")
    if hasattr(tree, "is_modifier"):  # from 4.0 on, only such trees can be chosen in modifiers
        tree.is_modifier = True


def add_input(tree, name, kind, value):
    """Adds an input to a node group. kind: such as "NodeSocketFloat". value: the default value, or None if the kind has
    none."""
    if hasattr(tree, "interface"):
        socket = tree.interface.new_socket(name, in_out="INPUT", socket_type=kind)
    else:
        socket = tree.inputs.new(kind, name)
    if value is not None:
        socket.default_value = value


def add_output(tree, name, kind):
    """Adds an output to a node group."""
    if hasattr(tree, "interface"):
        tree.interface.new_socket(name, in_out="OUTPUT", socket_type=kind)
    else:
        tree.outputs.new(kind, name)


def hsv_node(tree, saturation, value):
    """Adds a node that makes a colour from its hue, which is the first input. 3.3 joined the nodes of all colour spaces
    into one."""
    return add_node(tree, "ShaderNodeCombineColor", None, saturation, value, mode="HSV")


def mix_colors(tree, share, color, other):
    """Adds a node that mixes the colour of a socket with `other`, and returns its output. share: the weight of `other`,
    a number or a socket."""
    node = add_node(tree, "ShaderNodeMix", data_type="RGBA")
    factor, first, second = (next(socket for socket in node.inputs if socket.identifier == name)
                             for name in ("Factor_Float", "A_Color", "B_Color"))
    for socket, value in ((factor, share), (first, color), (second, other)):
        set_socket(tree, socket, value)
    return next(socket for socket in node.outputs if socket.identifier == "Result_Color")


def line_art(item, name, width):
    """Returns an object with a Line Art modifier that draws the outlines of `item`. width: Blender units. Blender 4.3
    replaced the grease pencil."""
    anew = bpy.app.version >= (4, 3, 0)
    store = getattr(bpy.data, "grease_pencils_v3", bpy.data.grease_pencils) if anew else bpy.data.grease_pencils
    drawing = store.new(name)
    layer = drawing.layers.new("Lines")
    layer.frames.new(1)
    ink = bpy.data.materials.new(name)
    bpy.data.materials.create_gpencil_data(ink)
    drawing.materials.append(ink)
    lines = bpy.data.objects.new(name, drawing)
    modifier = (lines.modifiers.new("Line Art", "LINEART") if anew else
                lines.grease_pencil_modifiers.new("Line Art", "GP_LINEART"))
    modifier.source_type, modifier.source_object = "OBJECT", item
    modifier.target_layer = layer.name if anew else layer.info
    modifier.target_material = ink
    for kind in ("use_crease", "use_material", "use_edge_mark", "use_loose", "use_intersection"):
        setattr(modifier, kind, False)  # leaves contours only
    if hasattr(modifier, "radius"):
        modifier.radius = 0.5 * width
    elif anew:  # in 4.3 and 4.4 lines of their own have a whole number of thousandths of a unit
        even = lines.modifiers.new("Width", "GREASE_PENCIL_THICKNESS")
        even.use_uniform_thickness, even.thickness = True, 0.5 * width  # the radius
    else:
        modifier.thickness, drawing.pixel_factor = 20, width / 0.02  # a Blender unit has 1,000 pixels
    return lines


def switch_geometry(tree, condition, if_true, otherwise):
    """Adds a node that chooses between two geometries, and returns its output. None stands for an empty geometry."""
    node = add_node(tree, "GeometryNodeSwitch", input_type="GEOMETRY")
    for socket, source in zip((socket for socket in node.inputs if socket.enabled), (condition, otherwise, if_true)):
        if source is not None:
            tree.links.new(source, socket)
    return next(socket for socket in node.outputs if socket.enabled)


def keeps_realized_normals():
    """Returns True if realized instances keep their custom normals, which are an attribute from 4.5 on."""
    return bpy.app.version >= (4, 5, 0)


def exports_by_mesh_name():
    """Returns True if the exporters of Alembic and USD write a new mesh whenever the name of the shown mesh changes."""
    return bpy.app.version >= (5, 2, 0)


def input_identifier(tree, name):
    """Returns the identifier of an input of a node group, by which modifiers store its value."""
    sockets = tree.interface.items_tree if hasattr(tree, "interface") else tree.inputs
    return next(socket.identifier for socket in sockets if socket.name == name)


def identity(item):
    """Returns a number that identifies an object or a mesh while Blender runs, independently of its name. From 4.2 on
    it survives undo."""
    return item.session_uid if hasattr(item, "session_uid") else item.as_pointer()


def of_identity(number):
    """Returns the object with an identity(), or None."""
    return next((item for item in bpy.data.objects if identity(item) == number), None)


def set_input(modifier, name, value):
    """Sets an input of a node group in its modifier. Before 5.2 it is a custom property, then a property of Blender."""
    identifier = input_identifier(modifier.node_group, name)
    if hasattr(modifier, "properties"):
        getattr(modifier.properties.inputs, identifier).value = value
    else:
        modifier[identifier] = value


def input_path(modifier, name):
    """Returns the data path of an input of a modifier's node group, relative to its object."""
    identifier, modifiers = (input_identifier(modifier.node_group, name),
                             f'modifiers["{bpy.utils.escape_identifier(modifier.name)}"]')
    return (f"{modifiers}.properties.inputs.{identifier}.value" if hasattr(modifier, "properties") else
            f'{modifiers}["{identifier}"]')


def move_first(item, modifier):
    """Moves the last modifier of an object before all others."""
    if hasattr(item.modifiers, "move"):
        item.modifiers.move(len(item.modifiers) - 1, 0)
    elif len(item.modifiers) > 1:
        with bpy.context.temp_override(object=item):
            bpy.ops.object.modifier_move_to_index(modifier=modifier.name, index=0)


def value_at(item, path, time):
    """Returns the value of a property at a time of the scene: by its curve in the object's action, or its current
    value.
    path: its data path, such as '["name"]'."""
    found = next((curve for curve in action_curves(item) if curve.data_path == path), None)
    return item.path_resolve(path) if found is None else found.evaluate(time)


def action_curves(item):
    """Returns the curves that animate an object. From 4.4 on an object and its mesh share an action, with a channel bag
    for each."""
    animation = item.animation_data
    if animation is None or animation.action is None:
        return []
    if not hasattr(animation, "action_slot"):
        return animation.action.fcurves
    bags = [strip.channelbag(animation.action_slot) for layer in animation.action.layers for strip in layer.strips]
    return [curve for bag in bags if bag is not None for curve in bag.fcurves]


def rename_curves(item, paths):
    """Redirects curves and drivers of an object to other properties. paths: old data paths and their new ones."""
    animation = item.animation_data
    if animation is None:
        return
    if animation.action is not None and animation.action.users > 1 and any(curve.data_path in paths
                                                                           for curve in action_curves(item)):
        animation.action = animation.action.copy()
    for curve in (*action_curves(item), *animation.drivers):
        curve.data_path = paths.get(curve.data_path, curve.data_path)


def frame_rate(fps):
    """Returns fps and fps_base of the render settings for a rate. fps is a whole number before 5.0."""
    whole = max(1, round(fps))
    return whole, whole / fps


def show_message(title, text):
    """Shows a message in the window, if there is one."""
    if bpy.app.background or not getattr(bpy.context, "window", None):
        return
    bpy.context.window_manager.popup_menu(lambda menu, _context: menu.layout.label(text=text), title=title,
                                          icon="ERROR")


def color_solid_views(context):
    """Makes solid views that show colours of materials, their default, show the attribute "Color" of surfaces
    instead."""
    for window in getattr(context.window_manager, "windows", ()):
        for area in window.screen.areas:
            shading = area.spaces.active.shading if area.type == "VIEW_3D" else None
            if shading is not None and shading.color_type == "MATERIAL":
                shading.color_type = "VERTEX"
