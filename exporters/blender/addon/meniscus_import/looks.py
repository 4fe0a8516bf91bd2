# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials that colour by attributes, so that colours of a mesh can change without a new computation."""

import functools

import bpy

from . import compat, materials, mns_reader
from .mesh_arrays import SLOTS

#: The custom property that identifies node groups and materials of this module.
MARK = "meniscus_look"
#: The scattering distance of light in wax in Å, and its factors for red, green and blue.
WAX_RADIUS, WAX_COLORS = 2.5, (1.0, 0.45, 0.25)
#: The indices of refraction of glass for reflection and for refraction. Refraction is weaker than in real glass: at
#: 1.45 bumps of atoms are lenses with 4 Å focal length, and after a few of them light comes from any direction, so that
#: a protein looks like crushed ice, in exact renderers, too.
GLASS_IOR, GLASS_BENDS = 1.45, 1.1
LINE_WIDTH = 0.24  # Å
MOST_STOPS = 32  # the greatest number of stops of a colour ramp

_GREY = "#c8c8c8"
#: Colourings by steps: the attribute, and pairs of the lowest value and the colour (sRGB) of each step.
STEPS = {
    # The pLDDT of predictions is in the column of B-factors; bands and colours are those of the AlphaFold database.
    "CONFIDENCE": ("b_factor", ((0, "#ff7d45"), (50, "#ffdb13"), (70, "#65cbf3"), (90, "#0053d6"))),
    # The hues are those of the scheme "element" of the program.
    "ELEMENT": ("atomic_number", ((0, _GREY), (1, "#ffffff"), (2, _GREY), (7, "#8fa6f5"), (8, "#f58f8f"),
                                  (9, "#a9e2a0"), (10, _GREY), (15, "#f5c08f"), (16, "#f5e88f"), (17, "#a9e2a0"),
                                  (18, _GREY), (26, "#e0a080"), (27, _GREY), (30, "#b0b5d8"), (31, _GREY))),
    # The colours are those of Okabe and Ito.
    "KIND": ("ses_kind", ((0, "#e69f00"), (1, "#56b4e9"), (2, "#009e73"))),
}
#: Colourings by a scale: the attribute, its values at both ends, and colours at equal distances.
SCALES = {
    "B_FACTOR": ("b_factor", 0.0, 100.0, ("#440154", "#414487", "#2a788e", "#22a884", "#7ad151", "#fde725")),
    "CHARGE": ("charge", -1.0, 1.0, ("#d6412f", "#ffffff", "#3a5fcd")),
    "POTENTIAL": ("map_value", -10.0, 10.0, ("#d6412f", "#ffffff", "#3a5fcd")),
    "CURVATURE": ("mean_curvature", -0.75, 0.75, ("#3a5fcd", "#ffffff", "#d6412f")),
    "SMOOTH_CURVATURE": ("smooth_mean_curvature", -0.3, 0.3, ("#3a5fcd", "#ffffff", "#d6412f")),
    "ATOM_AREA": ("atom_area", 0.0, 30.0, ("#440154", "#414487", "#2a788e", "#22a884", "#7ad151", "#fde725")),
    "ACCESSIBLE_AREA": ("accessible_area", 0.0, 40.0, ("#440154", "#414487", "#2a788e", "#22a884", "#7ad151",
                                                       "#fde725")),
    "BURIED_AREA": ("buried_area", 0.0, 40.0, ("#ffffff", "#fecc5c", "#fd8d3c", "#e31a1c", "#800026")),
    "HYDROPHOBICITY": ("hydrophobicity", -4.5, 4.5, ("#3a5fcd", "#ffffff", "#d6412f")),
    "LIPOPHILICITY": ("lipophobicity", -2.0, 2.0, ("#3a5fcd", "#ffffff", "#d6412f")),
}
#: Colourings by a hue for each integer, and their attributes.
HUES = {"CHAIN": "chain_id", "RESIDUE": "res_name_id"}
#: Name of a colouring -> its label.
COLORINGS = {
    "COLOR": "As computed", "ELEMENT": "Element", "CHAIN": "Chain", "RESIDUE": "Residue name",
    "CONFIDENCE": "Confidence (pLDDT)", "B_FACTOR": "B-factor", "CHARGE": "Charge", "POTENTIAL": "Potential map",
    "HYDROPHOBICITY": "Hydrophobicity (Kyte & Doolittle)", "LIPOPHILICITY": "Lipophilicity", "KIND": "Patch kind",
    "CURVATURE": "Curvature", "SMOOTH_CURVATURE": "Curvature, smooth", "ATOM_AREA": "Area of the atom",
    "ACCESSIBLE_AREA": "Accessible area of the atom", "BURIED_AREA": "Buried area of the atom"}
#: Name of a colouring -> its attribute.
ATTRIBUTES = {"COLOR": "Color", **HUES, **{name: of[0] for of_all in (STEPS, SCALES) for name, of in of_all.items()}}
#: Name of a look -> its label.
LOOKS = {"PAINT": "Paint", "CLAY": "Clay", "WAX": "Wax", "GLASS": "Glass", "FLAT": "Flat"}


def offered(mesh):
    """Returns the names of the colourings whose attribute a mesh has. "As computed" is always among them."""
    return {name for name, attribute in ATTRIBUTES.items() if name == "COLOR" or attribute in mesh.attributes}


def coloring_group(name):
    """Returns the shader node group of a colouring, and creates it if needed. It has the output Color, and the inputs
    Low and High if the colouring has a scale."""
    for tree in bpy.data.node_groups:
        if tree.get(MARK) == name:
            return tree
    tree = bpy.data.node_groups.new(f"Meniscus colour: {COLORINGS[name]}", "ShaderNodeTree")
    tree[MARK] = name
    compat.add_output(tree, "Color", "NodeSocketColor")
    if name in SCALES:
        for socket, value in zip(("Low", "High"), SCALES[name][1:3]):
            compat.add_input(tree, socket, "NodeSocketFloat", value)
    output = tree.nodes.new("NodeGroupOutput")
    tree.links.new(_color(tree, name), output.inputs[0])
    for column, node in enumerate(tree.nodes):
        node.location = (200 * column, 0)
    return tree


def _color(tree, name):
    if name in STEPS:
        return _steps(tree, *STEPS[name])
    if name in SCALES:
        return _scale(tree, *SCALES[name])
    if name in HUES:
        return _hues(tree, HUES[name])
    return _attribute(tree, "Color").outputs["Color"]


def _attribute(tree, name):
    return compat.add_node(tree, "ShaderNodeAttribute", attribute_name=name)


def _steps(tree, attribute, steps):
    """Adds a colour ramp that is constant between values. Integers are interpolated between points, so their bounds lie
    half way."""
    last = steps[-1][0] + 1.0
    half = 0.5 if attribute != "b_factor" else 0.0
    value = compat.math_node(tree, "DIVIDE", _attribute(tree, attribute).outputs["Fac"], last)
    ramp = _ramp(tree, [(max(0.0, (low - half) / last), color) for low, color in steps])
    ramp.color_ramp.interpolation = "CONSTANT"
    tree.links.new(value, ramp.inputs["Fac"])
    return ramp.outputs["Color"]


def _scale(tree, attribute, _low, _high, colors):
    given = tree.nodes.new("NodeGroupInput").outputs
    above = compat.math_node(tree, "SUBTRACT", _attribute(tree, attribute).outputs["Fac"], given["Low"])
    value = compat.math_node(tree, "DIVIDE", above, compat.math_node(tree, "SUBTRACT", given["High"], given["Low"]))
    ramp = _ramp(tree, [(place / (len(colors) - 1), color) for place, color in enumerate(colors)])
    tree.links.new(value, ramp.inputs["Fac"])
    return ramp.outputs["Color"]


def _ramp(tree, stops):
    assert len(stops) <= MOST_STOPS
    node = tree.nodes.new("ShaderNodeValToRGB")
    elements = node.color_ramp.elements
    while len(elements) > 1:
        elements.remove(elements[-1])
    elements[0].position, elements[0].color = stops[0][0], linear(stops[0][1])
    for position, color in stops[1:]:
        elements.new(position).color = linear(color)
    return node


def _hues(tree, attribute):
    """Adds nodes with a hue for each integer. Multiples of the golden section are never near one another."""
    math = functools.partial(compat.math_node, tree)
    number = math("FLOOR", math("ADD", _attribute(tree, attribute).outputs["Fac"], 0.5))
    hue = math("FRACT", math("ADD", math("MULTIPLY", number, 0.6180340), 0.58))
    node = compat.hsv_node(tree, 0.45, 0.85)
    tree.links.new(hue, node.inputs[0])
    return node.outputs[0]


def linear(text):
    """Returns the colour "#rrggbb" as scene-linear RGBA."""
    values = [int(text[place:place + 2], 16) / 255.0 for place in (1, 3, 5)]
    return (*(value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4 for value in values), 1.0)


def check(look, fades, looks):
    """Raises mns_reader.MnsError if a look cannot represent the requested material: fades: True for fading objects;
    looks: the parameters of the object's own material."""
    if looks and look not in MAKERS:
        raise mns_reader.MnsError(
            f"the look {LOOKS[look].lower()} has no place for {', '.join(sorted(looks))}, which an object has of its "
            "own; "
            f"take {', '.join(LOOKS[name].lower() for name in MAKERS)}, or export it without")
    if fades and look == "GLASS":
        raise mns_reader.MnsError("the look glass cannot fade, as objects of a storyboard do; take another look")


def material(look, coloring, scale=0.1, kind=materials.OPAQUE, fades=False, looks=None):
    """Returns the material of a look and a colouring, and creates it if needed. scale: Blender units per Å, for the
    depth of light. kind, fades, looks: results of materials.stored_requirements()."""
    looks = looks or {}
    check(look, fades, looks)
    mark = f"{look} {coloring} {scale:.6g}" + (f" {kind}" if kind != materials.OPAQUE else "") + (" fading"
                                                                                                  if fades else "")
    mark += "".join(f" {key} {value:g}" for key, value in sorted(looks.items()))
    for each in bpy.data.materials:
        if each.get(MARK) == mark:
            return each
    made = bpy.data.materials.new(f"Meniscus {LOOKS[look].lower()}, {COLORINGS[coloring].lower()}")
    made[MARK] = mark
    tree = compat.node_tree(made)
    output = compat.find_or_add(tree, "OUTPUT_MATERIAL", "ShaderNodeOutputMaterial")
    group = compat.add_node(tree, "ShaderNodeGroup", node_tree=coloring_group(coloring), location=(-400, 0))
    color = group.outputs["Color"]
    if look == "FLAT":
        shader = compat.add_node(tree, "ShaderNodeEmission", color)
        for node in [node for node in tree.nodes if node.type == "BSDF_PRINCIPLED"]:
            tree.nodes.remove(node)
    else:
        shader = compat.find_or_add(tree, "BSDF_PRINCIPLED", "ShaderNodeBsdfPrincipled")
        if look in MAKERS:
            MAKERS[look](tree, shader, color, scale)
            materials.set_looks(tree, shader, looks)
    if look == "GLASS":
        _glass(tree, shader, color, output, scale)
        compat.refract(made)
    else:
        tree.links.new(shader.outputs[0], output.inputs["Surface"])
    if kind != materials.OPAQUE:
        for each in [node for node in tree.nodes if node.type == "OUTPUT_MATERIAL"]:
            surface = each.inputs["Surface"]
            tree.links.new(materials.let_through(tree, kind, surface.links[0].from_socket, shader), surface)
        compat.let_through(made)
    if fades:
        materials.add_fade(made)
    return made


def _set(shader, value, *names):
    socket = compat.principled_input(shader, *names)
    if socket is not None:
        socket.default_value = value


def _paint(tree, shader, color, _scale_):
    tree.links.new(color, shader.inputs["Base Color"])
    _set(shader, 0.45, "Roughness")


def _clay(tree, shader, color, _scale_):
    mixed = compat.mix_colors(tree, 0.75, color, linear("#c9a48c"))
    tree.links.new(mixed, shader.inputs["Base Color"])
    _set(shader, 0.95, "Roughness")
    _set(shader, 0.15, "Specular IOR Level", "Specular")


def _wax(tree, shader, color, scale):
    tree.links.new(color, shader.inputs["Base Color"])
    if "Subsurface Color" in shader.inputs:  # before 4.0
        tree.links.new(color, shader.inputs["Subsurface Color"])
    _set(shader, 0.35, "Roughness")
    _set(shader, 1.0, "Subsurface Weight", "Subsurface")
    _set(shader, [WAX_RADIUS * scale * each for each in WAX_COLORS], "Subsurface Radius")
    _set(shader, 1.0, "Subsurface Scale")
    compat.scatter_smoothly(shader)


def _glass(tree, shader, color, output, scale):
    """Adds the nodes of glass. Attributes belong to the surface and not to the volume, so light is coloured where it
    enters, and absorbed along its way inside. That works in Cycles. Eevee fills the whole bounding box with a volume,
    so there the surface has more of the colour."""
    tree.links.new(_clear(tree, shader, color, 0.5), output.inputs["Surface"])
    absorption = compat.add_node(tree, "ShaderNodeVolumeAbsorption", (0.75, 0.85, 0.9, 1.0), 0.02 / scale,
                                 location=(output.location[0] - 220, output.location[1] - 200))
    tree.links.new(absorption.outputs[0], output.inputs["Volume"])
    other, in_color = tree.nodes.new("ShaderNodeOutputMaterial"), tree.nodes.new("ShaderNodeBsdfPrincipled")
    output.target, other.target = "CYCLES", "EEVEE"
    tree.links.new(_clear(tree, in_color, color, 0.3), other.inputs["Surface"])
    in_color.location, other.location = ((node.location[0], node.location[1] - 700) for node in (shader, output))


def _clear(tree, shader, color, white):
    """Returns the output of a surface that reflects on its outside according to Fresnel's equations with GLASS_IOR, and
    refracts the rest by a Principled shader with GLASS_BENDS. white: the share of white in its colour."""
    _set(shader, 0.02, "Roughness")  # lamps make black pixels in Eevee 3.4 if it is 0
    _set(shader, GLASS_BENDS, "IOR")
    _set(shader, 1.0, "Transmission Weight", "Transmission")
    tree.links.new(compat.mix_colors(tree, white, color, (1.0, 1.0, 1.0, 1.0)), shader.inputs["Base Color"])
    # This roughness is enough to sample lamps without grain.
    mirror = compat.add_node(tree, "ShaderNodeBsdfGlossy", (1.0, 1.0, 1.0, 1.0), 0.08)
    fresnel = compat.add_node(tree, "ShaderNodeFresnel", GLASS_IOR)
    side = tree.nodes.new("ShaderNodeNewGeometry")
    outside = compat.math_node(tree, "SUBTRACT", 1.0, side.outputs["Backfacing"])
    share = compat.math_node(tree, "MULTIPLY", fresnel.outputs[0], outside)
    return compat.add_node(tree, "ShaderNodeMixShader", share, shader.outputs[0], mirror.outputs[0]).outputs[0]


MAKERS = {"PAINT": _paint, "CLAY": _clay, "WAX": _wax}


def dress(item, look, coloring):
    """Gives a look to the outer surface and the cavities of an object. Caps keep their material."""
    return dress_mesh(item.data, look, coloring, float(item.get("meniscus_scale", 0.1)))


def dress_mesh(mesh, look, coloring, scale):
    """Gives a look to the outer surface and the cavities of a mesh, and returns its material. Opacity, parameters of
    the object's own material and fading remain. scale: Blender units per Å. Raises mns_reader.MnsError if the look
    cannot represent one of them."""
    made = material(look, coloring, scale, *materials.stored_requirements(mesh))
    slots = mesh.materials
    while len(slots) < 2:
        slots.append(None)
    for slot, role in enumerate(SLOTS[:len(slots)]):
        if role != "cap":
            slots[slot] = made
    return made


def renewed(mesh, surface, scale):
    """Returns the materials of a mesh for a new surface. Materials of imports and of looks change as the surface
    requests; the user's own materials remain. Raises mns_reader.MnsError if a look cannot represent the request."""
    fades, slots = materials.stored_requirements(mesh)[1], list(mesh.materials)
    for slot, (role, kind) in enumerate(materials.wanted(surface)):
        old = slots[slot] if slot < len(slots) else None
        if old is not None and MARK in old:
            look, coloring = old[MARK].split()[:2]
            slots[slot] = material(look, coloring, scale, kind, fades, dict(materials.looks_of(surface)))
        elif old is None or materials.MARK in old:
            own = old is not None and " own" in old[materials.MARK]
            made = materials.find_or_make(role, kind, [each for each in slots if each is not None], own,
                                          materials.hatching_of(surface, role), materials.looks_of(surface), fades)
            slots[slot:slot + 1] = [made]
    return slots


def add_lines(context, item):
    """Adds and returns an object that draws the outlines of another object by Line Art."""
    lines = compat.line_art(item, item.name + ".lines", LINE_WIDTH * float(item.get("meniscus_scale", 0.1)))
    (item.users_collection[0] if item.users_collection else context.scene.collection).objects.link(lines)
    return lines
