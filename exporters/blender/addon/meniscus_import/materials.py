# SPDX-License-Identifier: GPL-3.0-or-later
"""The materials of imported surfaces. They are found by their purpose and shared by all imports, and edits of the user
remain."""

import functools

import bpy

from . import compat
from .mesh_arrays import SLOTS

#: The kinds of opacity of a surface, and the endings of the names of their materials.
OPAQUE, TRANSLUCENT, FILM = "opaque", "translucent", "film"
ENDINGS = {OPAQUE: "", TRANSLUCENT: " seen through", FILM: " film"}
#: The custom property that distinguishes materials of this add-on from others of the same name.
MARK = "meniscus_material"
#: The custom property of meshes with the result of requirements_of().
REQUIREMENTS = "meniscus_asked"
#: The parameters of an object's own material.
KEYS = ("ambient", "roughness", "shininess", "specular")
#: The least cosine of the viewing angle that determines the thickness of a film, as in Meniscus.
LEAST_COSINE = 0.05


def wanted(surface):
    """Yields pairs of role and kind of opacity for the slots of a surface. Caps are never films: their opacity does not
    depend on the viewing angle."""
    kind = kind_of(surface)
    yield from ((role, kind) for role in SLOTS[:2])
    if surface.get("mesh.cap_plane") is not None:
        yield SLOTS[2], OPAQUE if kind == OPAQUE else TRANSLUCENT


def hatching_of(surface, role):
    """Returns the share of the dark lines and their relative brightness, or None if there is no hatching."""
    hatching = surface.header["caps"].get("hatching") if role == "cap" else None
    return None if hatching is None else (float(hatching["share"]), float(hatching["light"]))


def looks_of(surface):
    """Returns the parameters of the object's own material as pairs of a key and a number. They are () for the default
    material."""
    return tuple(sorted(
        (key, float(value)) for key, value in surface.header.get("material", {}).items() if key in KEYS))


def requirements_of(surface, fades):
    """Returns the requirements of a surface on any material as plain values for a custom property: its kind of opacity,
    1 if it fades, and the pairs of looks_of()."""
    return {"kind": kind_of(surface), "fades": int(fades), **dict(looks_of(surface))}


def stored_requirements(mesh):
    """Returns the requirements that a mesh stores: kind of opacity, True if it fades, and a dict of parameters."""
    requirements = mesh.get(REQUIREMENTS, {})
    kind = requirements.get("kind", TRANSLUCENT if "opacity" in mesh.attributes else OPAQUE)
    return kind, bool(requirements.get("fades", 0)), {key: requirements[key] for key in KEYS if key in requirements}


def find_or_make(role, kind, new_materials, own=False, hatching=None, looks=(), fades=False):
    """Returns the material of a role for a kind of opacity. It is created if needed, and then added to new_materials.

    role: one of SLOTS. own: True for a material of this import only. hatching: the result of hatching_of(). looks: the
    result of looks_of(). fades: True if it fades by the object's colour."""
    mark = (f"{role} {kind}" + (" own" if own else "") +
            ("" if hatching is None else " hatched {:g} {:g}".format(*hatching)))
    mark += "".join(f" {key} {value:g}" for key, value in looks) + (" fading" if fades else "")
    for material in new_materials if own else bpy.data.materials:
        if material.get(MARK) == mark or (kind == OPAQUE and not (own or looks or fades) and
                                          _is_of_an_old_import(material, role)):
            return material
    material = bpy.data.materials.new(
        f"Meniscus {role}{ENDINGS[kind]}{'' if hatching is None else ' hatched'}{' fading' if fades else ''}")
    new_materials.append(material)
    material[MARK] = mark
    _fill(material, kind, hatching, dict(looks))
    if fades:
        add_fade(material)
    return material


def kind_of(surface):
    """Returns the kind of opacity of a mns_reader.Surface: OPAQUE, TRANSLUCENT or FILM."""
    if surface.get("atom.opacity") is None:
        return OPAQUE
    return FILM if surface.header.get("film_opacity") is True else TRANSLUCENT


def shader_of(material):
    return next((node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED"), None)


def _is_of_an_old_import(material, role):
    """Returns True if a material was made by a version of the add-on that did not mark its materials."""
    return (material.name == f"Meniscus {role}" and MARK not in material and material.node_tree is not None and
            any(node.type == "ATTRIBUTE" and node.attribute_name == "Color" for node in material.node_tree.nodes))


def _fill(material, kind, hatching, looks):
    tree = compat.node_tree(material)
    shader = compat.find_or_add(tree, "BSDF_PRINCIPLED", "ShaderNodeBsdfPrincipled")
    output = compat.find_or_add(tree, "OUTPUT_MATERIAL", "ShaderNodeOutputMaterial")
    output.location = (shader.location[0] + 300, shader.location[1])
    if not output.inputs["Surface"].is_linked:
        tree.links.new(shader.outputs[0], output.inputs["Surface"])
    color = _attribute(tree, "Color", shader, 0).outputs["Color"]
    if hatching is not None:
        color = _hatched(tree, color, shader, *hatching)
    shader.inputs["Roughness"].default_value = 0.45
    tree.links.new(color, shader.inputs["Base Color"])
    set_looks(tree, shader, looks)
    if kind != OPAQUE:
        tree.links.new(opacity_of(tree, kind, shader), shader.inputs["Alpha"])
        compat.let_through(material)


def opacity_of(tree, kind, near):
    """Returns the socket with the opacity of a surface. kind: TRANSLUCENT or FILM. near: the node near which new
    nodes are placed."""
    opacity = _attribute(tree, "opacity", near, -320).outputs["Fac"]
    return _through_a_film(tree, opacity) if kind == FILM else opacity


def let_through(tree, kind, surface, near):
    """Returns the output of a shader that mixes `surface` with transparency according to its opacity, like Alpha in a
    Principled shader."""
    clear = tree.nodes.new("ShaderNodeBsdfTransparent").outputs[0]
    return compat.add_node(tree, "ShaderNodeMixShader", opacity_of(tree, kind, near), clear, surface,
                           location=(near.location[0] + 200, near.location[1] - 200)).outputs[0]


def _attribute(tree, name, near, down):
    return compat.add_node(tree, "ShaderNodeAttribute", attribute_name=name,
                           location=(near.location[0] - 220, near.location[1] + down))


def _hatched(tree, color, shader, share, light):
    """Returns the socket of a colour that is darker where the fractional part of cap_stripe is below the share of the
    lines. light: the relative brightness of the lines."""
    stripe = compat.math_node(tree, "FRACT", _attribute(tree, "cap_stripe", shader, -520).outputs["Fac"])
    dark = compat.math_node(tree, "LESS_THAN", stripe, share)
    lines = compat.math_node(tree, "MULTIPLY", dark, 1.0 - light)
    return _scaled(tree, color, compat.math_node(tree, "SUBTRACT", 1.0, lines))


def _scaled(tree, color, factor):
    node = compat.add_node(tree, "ShaderNodeVectorMath", color, operation="SCALE")
    compat.set_socket(tree, node.inputs["Scale"], factor)
    return node.outputs["Vector"]


def set_looks(tree, shader, looks):
    """Sets the parameters of an object's own material in a shader whose colours are linked. Blinn-Phong highlights
    become highlights of Blender with equal strength and width; the defaults 0.1 and 40 become Blender's defaults."""
    if "specular" in looks:
        compat.principled_input(shader, "Specular IOR Level",
                                "Specular").default_value = min(5.0 * looks["specular"], 1.0)
    if "shininess" in looks:
        shader.inputs["Roughness"].default_value = (2.0 / (looks["shininess"] + 2.0)) ** 0.25
    if "roughness" in looks and "Diffuse Roughness" in shader.inputs:  # Blender 4.3 and later
        shader.inputs["Diffuse Roughness"].default_value = looks["roughness"]
    if "ambient" in looks:  # this share is emitted independently of lights; the rest is lit
        color = shader.inputs["Base Color"].links[0].from_socket
        tree.links.new(color, compat.principled_input(shader, "Emission Color", "Emission"))
        shader.inputs["Emission Strength"].default_value = looks["ambient"]
        rest = _scaled(tree, color, 1.0 - looks["ambient"])
        for socket in [
                link.to_socket for link in tree.links
                if link.to_node == shader and link.to_socket.name in ("Base Color", "Subsurface Color")]:
            tree.links.new(rest, socket)


def _through_a_film(tree, opacity):
    """Returns the socket with the opacity of a film by Bouguer's law: 1 - (1 - opacity)^(1 / c), where c is the cosine
    of the angle between the line of sight and the normal, at least LEAST_COSINE."""
    geometry = tree.nodes.new("ShaderNodeNewGeometry")
    facing = compat.add_node(tree, "ShaderNodeVectorMath", geometry.outputs["Normal"], geometry.outputs["Incoming"],
                             operation="DOT_PRODUCT")
    math = functools.partial(compat.math_node, tree)
    cosine = math("MAXIMUM", math("ABSOLUTE", facing.outputs["Value"]), LEAST_COSINE)
    return math("SUBTRACT", 1.0, math("POWER", math("SUBTRACT", 1.0, opacity), math("DIVIDE", 1.0, cosine)))


#: The node group of materials that fade objects in and out by one number, the alpha of the object's colour: 0 before the
#: object appears, 1 while it is visible, 2 after it has disappeared.
FADE = "Meniscus fade"
#: The number of stripes per pixel, across and down, a share of which is shown. They are finer than any picture and
#: incommensurable with its rows.
STRIPES = (7.31, 3.17)
#: The size in pixels of a picture with this number of stripes per pixel. Larger pictures have wider stripes.
WIDTH, HEIGHT = 4096.0, 4096.0
#: A fading object casts no shadow on points nearer than this (Å), because two scenes may have nearly the same surface.
NEAR = 0.1


def add_fade(material):
    """Makes a material fade. In Cycles, the position of a camera ray in its pixel determines if the ray sees the object
    or passes it. So a ray meets exactly one of two objects that fade into each other, and the mean of a pixel is the
    blend of their pictures. For other rays, and in Eevee, the object becomes transparent."""
    tree = material.node_tree
    output = compat.find_or_add(tree, "OUTPUT_MATERIAL", "ShaderNodeOutputMaterial")
    shader = output.inputs["Surface"].links[0].from_socket
    x, y = output.location
    fade = compat.add_node(tree, "ShaderNodeGroup", node_tree=_fade_group(), location=(x, y - 200))
    output.location[0] += 200
    for_cycles = compat.add_node(tree, "ShaderNodeOutputMaterial", target="CYCLES", location=(x + 200, y - 200))
    tree.links.new(shader, fade.inputs["Shader"])
    tree.links.new(fade.outputs["Shader"], output.inputs["Surface"])
    tree.links.new(fade.outputs["Shader of Cycles"], for_cycles.inputs["Surface"])
    compat.let_through(material)


def _fade_group():
    """Returns the node group that all fading materials share, and creates it if needed."""
    found = bpy.data.node_groups.get(FADE)
    if found is not None and found.bl_idname == "ShaderNodeTree":
        return found
    tree = bpy.data.node_groups.new(FADE, "ShaderNodeTree")
    compat.add_input(tree, "Shader", "NodeSocketShader", None)
    compat.add_output(tree, "Shader", "NodeSocketShader")
    compat.add_output(tree, "Shader of Cycles", "NodeSocketShader")
    math = functools.partial(compat.math_node, tree)
    inside, outside = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    there = tree.nodes.new("ShaderNodeObjectInfo").outputs["Alpha"]
    past = math("SUBTRACT", there, 1.0)
    opacity = math("SUBTRACT", 1.0, math("MINIMUM", math("ABSOLUTE", past), 1.0))
    window = tree.nodes.new("ShaderNodeTexCoord").outputs["Window"]
    place = compat.add_node(tree, "ShaderNodeSeparateXYZ", window).outputs
    across = math("MULTIPLY", place["X"], STRIPES[0] * WIDTH)
    stripe = math("FRACT", math("MULTIPLY_ADD", place["Y"], STRIPES[1] * HEIGHT, across))
    come = math("LESS_THAN", stripe, there)
    seen = math("MULTIPLY", come, math("SUBTRACT", 1.0, math("LESS_THAN", stripe, past)))
    path = tree.nodes.new("ShaderNodeLightPath").outputs
    scale = compat.add_node(tree, "ShaderNodeAttribute", attribute_type="OBJECT", attribute_name="meniscus_scale")
    far = math("GREATER_THAN", path["Ray Length"], math("MULTIPLY", scale.outputs["Fac"], NEAR))
    blocks = math("MAXIMUM", far, math("GREATER_THAN", opacity, 0.9999))
    other = math("MULTIPLY", math("MULTIPLY", opacity, blocks), math("SUBTRACT", 1.0, path["Is Camera Ray"]))
    of_cycles = math("MULTIPLY_ADD", seen, path["Is Camera Ray"], other)
    nothing = tree.nodes.new("ShaderNodeBsdfTransparent").outputs[0]
    for share, name in ((opacity, "Shader"), (of_cycles, "Shader of Cycles")):
        mix = compat.add_node(tree, "ShaderNodeMixShader", share, nothing, inside.outputs["Shader"])
        tree.links.new(mix.outputs[0], outside.inputs[name])
    return tree
