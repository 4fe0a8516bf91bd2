# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials that fade objects in and out by one number, the alpha of the object's colour: 0 before the object appears,
1 while it is visible, 2 after it has disappeared."""

from . import compat

NAME = "Meniscus fade"
#: The number of stripes per pixel, across and down, a share of which is shown. They are finer than any picture and
#: incommensurable with its rows.
STRIPES = (7.31, 3.17)
#: The size in pixels of a picture with this number of stripes per pixel. Larger pictures have wider stripes.
WIDTH, HEIGHT = 4096.0, 4096.0
#: A fading object casts no shadow on points nearer than this (Å), because two scenes may have nearly the same surface.
NEAR = 0.1


def add(material):
    """Makes a material fade. In Cycles, the position of a camera ray in its pixel determines if the ray sees the object
    or passes it. So a ray meets exactly one of two objects that fade into each other, and the mean of a pixel is the
    blend of their pictures. For other rays, and in Eevee, the object becomes transparent."""
    tree = material.node_tree
    output = compat.find_or_add(tree, "OUTPUT_MATERIAL", "ShaderNodeOutputMaterial")
    shader = output.inputs["Surface"].links[0].from_socket
    fade = tree.nodes.new("ShaderNodeGroup")
    fade.node_tree = _group()
    fade.location = (output.location[0], output.location[1] - 200)
    output.location[0] += 200
    for_cycles = tree.nodes.new("ShaderNodeOutputMaterial")
    for_cycles.target = "CYCLES"
    for_cycles.location = (output.location[0], output.location[1] - 200)
    tree.links.new(shader, fade.inputs["Shader"])
    tree.links.new(fade.outputs["Shader"], output.inputs["Surface"])
    tree.links.new(fade.outputs["Shader of Cycles"], for_cycles.inputs["Surface"])
    compat.let_through(material)


def _group():
    """Returns the node group that all fading materials share, and creates it if needed."""
    import bpy

    found = bpy.data.node_groups.get(NAME)
    if found is not None and found.bl_idname == "ShaderNodeTree":
        return found
    tree = bpy.data.node_groups.new(NAME, "ShaderNodeTree")
    compat.add_input(tree, "Shader", "NodeSocketShader", None)
    compat.add_output(tree, "Shader", "NodeSocketShader")
    compat.add_output(tree, "Shader of Cycles", "NodeSocketShader")
    inside, outside = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    there = tree.nodes.new("ShaderNodeObjectInfo").outputs["Alpha"]
    past = compat.math_node(tree, "SUBTRACT", there, 1.0)
    opacity = compat.math_node(tree, "SUBTRACT", 1.0,
                               compat.math_node(tree, "MINIMUM", compat.math_node(tree, "ABSOLUTE", past), 1.0))
    place = tree.nodes.new("ShaderNodeSeparateXYZ")
    tree.links.new(tree.nodes.new("ShaderNodeTexCoord").outputs["Window"], place.inputs[0])
    across = compat.math_node(tree, "MULTIPLY", place.outputs["X"], STRIPES[0] * WIDTH)
    stripe = compat.math_node(tree, "FRACT",
                              compat.math_node(tree, "MULTIPLY_ADD", place.outputs["Y"], STRIPES[1] * HEIGHT, across))
    come = compat.math_node(tree, "LESS_THAN", stripe, there)
    stays = compat.math_node(tree, "SUBTRACT", 1.0, compat.math_node(tree, "LESS_THAN", stripe, past))
    seen = compat.math_node(tree, "MULTIPLY", come, stays)
    path = tree.nodes.new("ShaderNodeLightPath").outputs
    scale = tree.nodes.new("ShaderNodeAttribute")
    scale.attribute_type, scale.attribute_name = "OBJECT", "meniscus_scale"
    far = compat.math_node(tree, "GREATER_THAN", path["Ray Length"],
                           compat.math_node(tree, "MULTIPLY", scale.outputs["Fac"], NEAR))
    blocks = compat.math_node(tree, "MAXIMUM", far, compat.math_node(tree, "GREATER_THAN", opacity, 0.9999))
    other = compat.math_node(tree, "MULTIPLY", opacity, blocks)
    other = compat.math_node(tree, "MULTIPLY", other, compat.math_node(tree, "SUBTRACT", 1.0, path["Is Camera Ray"]))
    of_cycles = compat.math_node(tree, "MULTIPLY_ADD", seen, path["Is Camera Ray"], other)
    nothing = tree.nodes.new("ShaderNodeBsdfTransparent").outputs[0]
    for share, name in ((opacity, "Shader"), (of_cycles, "Shader of Cycles")):
        mix = tree.nodes.new("ShaderNodeMixShader")
        tree.links.new(share, mix.inputs[0])
        tree.links.new(nothing, mix.inputs[1])
        tree.links.new(inside.outputs["Shader"], mix.inputs[2])
        tree.links.new(mix.outputs[0], outside.inputs[name])
    return tree
