# SPDX-License-Identifier: GPL-3.0-or-later
"""An object whose Geometry Nodes show one object of a collection: that of the scene's time. No script is needed."""

import bpy

from . import compat


def add(name, collection, count):
    """An object that shows the n-th object of `collection`, by name, at the times nearest to scene frame n = 1 ... count, and
    nothing at other times."""
    tree = bpy.data.node_groups.new(name + " by frame", "GeometryNodeTree")
    mesh = bpy.data.meshes.new(name)
    item = bpy.data.objects.new(name, mesh)
    modifier = item.modifiers.new("Frame", "NODES")
    modifier.node_group = tree
    _fill(tree, collection, count)
    return item


def _fill(tree, collection, count):
    compat.add_geometry_sockets(tree)
    group_output = tree.nodes.new("NodeGroupOutput")
    index, inside = _index(tree, count)

    frames = tree.nodes.new("GeometryNodeCollectionInfo")
    frames.inputs["Collection"].default_value = collection
    frames.inputs["Separate Children"].default_value = True
    place = tree.nodes.new("GeometryNodeMeshLine")  # one point, at the origin
    place.inputs["Count"].default_value = 1
    show = tree.nodes.new("GeometryNodeInstanceOnPoints")
    show.inputs["Pick Instance"].default_value = True
    tree.links.new(place.outputs[0], show.inputs["Points"])
    tree.links.new(inside, show.inputs["Selection"])
    tree.links.new(frames.outputs[0], show.inputs["Instance"])
    tree.links.new(index, show.inputs["Instance Index"])
    tree.links.new(show.outputs[0], group_output.inputs[0])
    for column, node in enumerate(tree.nodes):
        node.location = (180 * column, -60 * (column % 3))


def _index(tree, count):
    """Sockets: the scene frame nearest to the time, from 0; and whether there is such a frame."""

    def math(operation, first, second):
        node = tree.nodes.new("ShaderNodeMath")
        node.operation = operation
        for socket, value in zip(node.inputs, (first, second)):
            if isinstance(value, (int, float)):
                socket.default_value = value
            else:
                tree.links.new(value, socket)
        return node.outputs[0]

    time = tree.nodes.new("GeometryNodeInputSceneTime")
    index = math("SUBTRACT", math("FLOOR", math("ADD", time.outputs["Frame"], 0.5), 0.0), 1.0)
    inside = math("MULTIPLY", math("GREATER_THAN", index, -0.5), math("LESS_THAN", index, count - 0.5))
    return index, inside
