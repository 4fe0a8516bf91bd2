# SPDX-License-Identifier: GPL-3.0-or-later
"""The frames of a run as meshes of the file. Geometry Nodes of an object show the mesh of the scene's time, without
scripts."""

import functools

import bpy

from . import compat, sequence_reader

#: The greatest number of frames in a nested node group.
MOST_OF_A_GROUP = 16
#: Inputs of the node group after the geometry. The modifier shows them, and they can be keyed.
START, SPEED, OUTSIDE, BY_HAND, FRAME = ("Start", "Speed", "Outside: empty, hold, loop, ping-pong", "Frame by hand",
                                         "Frame")
OWN = "Own mesh, for modifiers and exports"
TYPES = {START: "NodeSocketFloat", SPEED: "NodeSocketFloat", OUTSIDE: "NodeSocketInt", BY_HAND: "NodeSocketBool",
         FRAME: "NodeSocketFloat", OWN: "NodeSocketBool"}


class Frames:
    """Meshes in the order of their frames, in a collection that is in no scene. Objects in a scene that are hidden in
    one view layer would show in others."""

    def __init__(self, stem):
        self.stem, self.collection = stem[:40], bpy.data.collections.new(stem + ".frames")

    def add(self, mesh):
        # Geometry Nodes sort a collection by name. Names are short, because Blender truncates long ones.
        mesh.name = f"{self.stem}.{len(self.collection.objects) + 1:07d}"
        self.collection.objects.link(bpy.data.objects.new(mesh.name, mesh))

    def remove(self):
        for item in list(self.collection.objects):
            bpy.data.meshes.remove(item.data)  # removes the object, too
        bpy.data.collections.remove(self.collection)

    def show_in(self, item, timing, by_hand=False, frame=1.0):
        """Makes an object show the frame of a sequence_reader.Timing at the scene's time, or `frame` if `by_hand`.
        Returns the modifier that does so, which is the first of the object."""
        tree = bpy.data.node_groups.new(item.name + " by frame", "GeometryNodeTree")
        values = {START: timing.start, SPEED: timing.speed, OUTSIDE: sequence_reader.OUTSIDE.index(timing.outside),
                  BY_HAND: by_hand, FRAME: frame, OWN: True}
        _fill(tree, self.collection, len(self.collection.objects), values)
        modifier = item.modifiers.new("Frame", "NODES")
        modifier.node_group = tree
        for socket, value in values.items():
            compat.set_input(modifier, socket, value)
        compat.move_first(item, modifier)
        return modifier


def _fill(tree, collection, count, values):
    compat.add_geometry_sockets(tree)
    for socket, kind in TYPES.items():
        compat.add_input(tree, socket, kind, values[socket])
    group_input = tree.nodes.new("NodeGroupInput")
    group_output = tree.nodes.new("NodeGroupOutput")
    index, inside = _index(tree, group_input.outputs, count)

    frames = tree.nodes.new("GeometryNodeCollectionInfo")
    frames.inputs["Collection"].default_value = collection
    frames.inputs["Separate Children"].default_value = True
    place = tree.nodes.new("GeometryNodeMeshLine")  # a single point at the origin
    place.inputs["Count"].default_value = 1
    show = tree.nodes.new("GeometryNodeInstanceOnPoints")
    show.inputs["Pick Instance"].default_value = True
    tree.links.new(place.outputs[0], show.inputs["Points"])
    tree.links.new(inside, show.inputs["Selection"])
    tree.links.new(frames.outputs[0], show.inputs["Instance"])
    tree.links.new(index, show.inputs["Instance Index"])
    # Later modifiers and exporters (Alembic, USD) use the object's own mesh, not its instances.
    material = next((each for item in collection.objects for each in item.data.materials), None)
    own = (_realized(tree, show.outputs[0], material) if compat.keeps_realized_normals() else
           _chosen(tree, collection, index, inside))
    shown = compat.switch_geometry(tree, group_input.outputs[OWN], own, show.outputs[0])
    tree.links.new(shown, group_output.inputs[0])
    for column, node in enumerate(tree.nodes):
        node.location = (180 * (column // 3), -200 * (column % 3))


def _realized(tree, instances, material):
    """Returns the output with the mesh of the shown frame under a name that does not change. Exporters of 5.2 make a
    mesh for each name, and a single realized instance has the name of its frame. So a face is joined to it and deleted
    again. The face has a material of the frame, so that no other slot is needed."""
    realize = tree.nodes.new("GeometryNodeRealizeInstances")
    if not compat.exports_by_mesh_name():
        tree.links.new(instances, realize.inputs[0])
        return realize.outputs[0]
    face, dressed, filled, both, rest = (tree.nodes.new("GeometryNode" + name) for name in (
        "MeshGrid", "SetMaterial", "ReplaceMaterial", "JoinGeometry", "DeleteGeometry"))
    face.inputs["Vertices X"].default_value = face.inputs["Vertices Y"].default_value = 2
    # Set Material leaves an empty slot, which Replace Material fills.
    dressed.inputs["Material"].default_value = filled.inputs["New"].default_value = material
    rest.domain = "FACE"
    for source, target in ((face, dressed), (dressed, filled), (filled, both), (both, realize), (realize, rest)):
        tree.links.new(source.outputs[0], target.inputs[0])
    tree.links.new(instances, both.inputs[0])  # joins the instances after the face
    is_first = compat.math_node(tree, "LESS_THAN", tree.nodes.new("GeometryNodeInputIndex").outputs[0], 0.5)
    tree.links.new(is_first, rest.inputs["Selection"])
    return rest.outputs[0]


def _chosen(tree, collection, index, inside):
    """Returns the output with the mesh of the shown frame and its normals, which realized instances lose before Blender
    4.5. There is a node for each frame, and switches between halves of them, of which only the chosen ones are
    evaluated."""
    items = sorted(collection.objects, key=lambda item: item.name)
    return compat.switch_geometry(tree, inside, _one_of(tree, items, 0, index, True), None)


def _one_of(tree, items, first, index, may_group):
    """Returns the output with the geometry of the item at the place `index`. The places of `items` begin with `first`.
    may_group: True if a small number of items may become a node group."""
    if len(items) == 1:
        return compat.add_node(tree, "GeometryNodeObjectInfo", items[0]).outputs["Geometry"]
    if may_group and len(items) <= MOST_OF_A_GROUP:
        return _group_of(tree, items, first, index)
    half = len(items) // 2
    later = compat.math_node(tree, "GREATER_THAN", index, first + half - 0.5)
    return compat.switch_geometry(tree, later, _one_of(tree, items[half:], first + half, index, may_group),
                                  _one_of(tree, items[:half], first, index, may_group))


def _group_of(tree, items, first, index):
    """Returns the output of _one_of() in a node group of its own, because Blender walks the whole tree for each new
    link."""
    inner = bpy.data.node_groups.new(f"{tree.name} {first + 1}", "GeometryNodeTree")
    compat.add_input(inner, "Index", "NodeSocketFloat", 0.0)
    compat.add_output(inner, "Geometry", "NodeSocketGeometry")
    given, result = inner.nodes.new("NodeGroupInput"), inner.nodes.new("NodeGroupOutput")
    inner.links.new(_one_of(inner, items, first, given.outputs[0], False), result.inputs[0])
    return compat.add_node(tree, "GeometryNodeGroup", index, node_tree=inner).outputs[0]


def _index(tree, given, count):
    """Returns two sockets: the index of the shown frame from 0, and 1 if a frame is shown or 0. The nodes compute what
    sequence_reader.Timing does."""
    math = functools.partial(compat.math_node, tree)

    def choose(condition, if_true, otherwise):  # the condition is 0 or 1
        return math("ADD", otherwise, math("MULTIPLY", condition, math("SUBTRACT", if_true, otherwise)))

    time = tree.nodes.new("GeometryNodeInputSceneTime").outputs["Frame"]
    by_time = math("MULTIPLY", math("SUBTRACT", time, given[START]), given[SPEED])
    at = math("FLOOR", math("ADD", choose(given[BY_HAND], math("SUBTRACT", given[FRAME], 1.0), by_time), 0.5))

    held = math("MINIMUM", math("MAXIMUM", at, 0.0), count - 1.0)
    looped = math("SUBTRACT", at, math("MULTIPLY", float(count), math("FLOOR", math("DIVIDE", at, float(count)))))
    to_and_fro = math("PINGPONG", at, count - 1.0)
    loops, turns = (math("COMPARE", given[OUTSIDE], float(sequence_reader.OUTSIDE.index(word)), 0.5)
                    for word in ("LOOP", "PINGPONG"))
    index = math("FLOOR", math("ADD", choose(turns, to_and_fro, choose(loops, looped, held)), 0.5))

    within = math("COMPARE", at, held, 0.5)
    return index, math("MAXIMUM", within, math("GREATER_THAN", given[OUTSIDE], 0.5))
