# SPDX-License-Identifier: GPL-3.0-or-later
"""Imports storyboards: a collection for each of its scenes, and one camera that moves between them, all by key
frames."""

import hashlib
import json
import os

import bpy
import numpy as np

from . import build, camera_rig, compat, mesh_arrays, mns_reader, sequence_reader
from .mesh_arrays import names_of

#: The keys of a surface's header that affect its look.
LOOKS = ("copies", "mesh", "kind_colors", "film_opacity", "caps", "material")
#: Each mesh is larger than the one before by this distance (Å), because parts that they share would coincide.
NUDGE = 0.002


class Imported:
    """The result of an import. items: the objects of each scene of the storyboard; scenes may share objects."""

    def __init__(self):
        self.collection = self.camera = None
        self.items = []


def import_file(path, context=None, scale=None, center=False, import_camera=True, use_camera=True, set_time=True,
                set_background=True, **options):
    """Reads a story.json and its surfaces into a new collection, and returns an Imported. scale: Blender units per Å;
    None for that of the file. set_background: True for key frames of the background. Other arguments are those of
    build.Options and sequence.Run. After MnsError or OSError nothing is left in the scene."""
    context = context or bpy.context
    board = sequence_reader.read_storyboard(path)
    options = build.Options(scale=board.scale if scale is None else scale, **options)
    files = {each: mns_reader.read(each) for each in {scene.path: None for scene in board.scenes}}
    story = _Story(path, board, files, options, _origin(context.scene, board, files, center))
    made = Imported()
    with build.whole_or_nothing():
        made.collection = bpy.data.collections.new(story.name)
        made.items = story.add_scenes(made.collection)
        if import_camera:
            made.camera = camera_rig.add(made.collection, board, story.name, options.scale, story.origin)
            points = [sequence_reader.points_of(files[scene.path]) for scene in board.scenes]
            camera_rig.reach_all(made.camera, board, points, options.scale)
        context.scene.collection.children.link(made.collection)
    if set_time:
        set_up_time(context.scene, board)
    if set_background:
        set_up_background(context.scene, board, story.name)
    if made.camera is not None and use_camera:
        context.scene.camera = made.camera
        build.use_picture_size(context.scene, board.scenes[0].camera)
    surfaces = list({item: None for items in made.items for item in items})
    build.let_rays_through(context.scene, [item.data for item in surfaces])
    context.scene.frame_set(board.scenes[0].first)
    build.present(context, surfaces)
    return made


def set_up_time(scene, board):
    """Sets the range of frames and the frame rate, and adds a marker at the first frame of each scene."""
    scene.frame_start, scene.frame_end = board.scenes[0].first, board.scenes[-1].last
    scene.render.fps, scene.render.fps_base = compat.frame_rate(board.fps)
    for each in board.scenes:
        scene.timeline_markers.new(each.title or each.name, frame=each.first)


def set_up_background(scene, board, name):
    """Adds key frames of the background colour that the camera sees, if a scene of the storyboard has one. Scenes
    without one then have white. The lighting of objects does not change."""
    colors = [each.background for each in board.scenes]
    scene.render.film_transparent = not any(colors)
    if not any(colors):
        return
    old = scene.world
    world = bpy.data.worlds.new(f"{name}.world")
    tree = compat.node_tree(world)
    light = compat.find_or_add(tree, "BACKGROUND", "ShaderNodeBackground")
    light.inputs["Color"].default_value = (*(old.color if old is not None else (0.0, 0.0, 0.0)), 1.0)
    if old is not None and old.node_tree is not None:
        shown = next((node for node in old.node_tree.nodes if node.type == "BACKGROUND"), None)
        if shown is not None:
            for socket in ("Color", "Strength"):
                light.inputs[socket].default_value = shown.inputs[socket].default_value
    seen = compat.add_node(tree, "ShaderNodeBackground", name="Seen", label="Seen")
    mix = compat.add_node(tree, "ShaderNodeMixShader", tree.nodes.new("ShaderNodeLightPath").outputs["Is Camera Ray"],
                          light.outputs[0], seen.outputs[0])
    tree.links.new(mix.outputs[0], compat.find_or_add(tree, "OUTPUT_WORLD", "ShaderNodeOutputWorld").inputs["Surface"])
    linear = [mesh_arrays.linear(color or (1.0, 1.0, 1.0)) for color in colors]
    camera_rig.key(board, tree, 'nodes["Seen"].inputs[0].default_value', linear, seen.inputs[0].default_value)
    scene.world = world


def _origin(scene, board, files, center):
    if not center:
        return np.zeros(3)
    file = next(iter(files.values()))
    atoms = sum(len(surface["atom.center"]) for surface in file.objects)
    return build.scene_origin(scene, lambda: board.origin, build.source_of(file.header), atoms)


def digest_of(surface):
    """Returns a digest that is equal for surfaces with the same look."""
    digest = hashlib.sha256(
        json.dumps({key: surface.header[key] for key in LOOKS if key in surface.header}, sort_keys=True).encode())
    for name in sorted(surface.arrays):
        digest.update(name.encode())
        digest.update(np.ascontiguousarray(surface.arrays[name]))
    return digest.digest()


class _Story:
    def __init__(self, path, board, files, options, origin):
        self.path, self.board, self.files, self.options, self.origin = path, board, files, options, origin
        self.name = os.path.basename(os.path.dirname(os.path.abspath(path))) or build.stem_of(path)
        self.made = {}  # digest of a surface -> its objects, one for each copy
        self.new_materials = []

    def add_scenes(self, parent):
        """Adds a collection to `parent` for each scene, and returns lists of the objects of each scene. An object that
        several scenes show is in the collection of each."""
        shown = []
        for number, scene in enumerate(self.board.scenes, 1):
            collection = bpy.data.collections.new(f"{number} {scene.name}")
            parent.children.link(collection)
            items = [
                item for surface in self.files[scene.path].objects
                for item in self.objects_of(surface, f"{self.name}.{number}", scene)]
            for item in items:
                collection.objects.link(item)
            shown.append(items)
        for item in {item: None for items in shown for item in items}:
            shows = [item in items for items in shown]
            hide(item, self.board, shows)
            fade(item, self.board, shows)
        return shown

    def objects_of(self, surface, stem, scene):
        key = digest_of(surface)
        if key in self.made:
            return self.made[key]
        file = self.files[scene.path]
        name = f"{stem}.{surface.name if len(file.objects) > 1 else 'surface'}"
        mesh = build.build_mesh(surface, name, self.options, self.new_materials, self.board.fps,
                                names_of(*file.objects), fades=True)
        nudge(mesh, surface["mesh.normal"], NUDGE * len(self.made) * self.options.scale)
        self.made[key] = [
            build.add_copy(mesh, copy, surface, scene.path, file, self.options, self.origin) for copy in surface.copies]
        return self.made[key]

def nudge(mesh, normals, distance):
    """Moves vertices outwards along their normals. After a transparent surface, Cycles misses a surface in the same
    place."""
    co = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", co)
    mesh.vertices.foreach_set("co", co + (normals * np.float32(distance)).ravel())
    mesh.update()


def fade(item, board, shows):
    """Adds key frames to the alpha of an object's colour: from 0 to 1 in a transition to a scene that shows it, and to
    2 in a transition to one that does not. shows: True for each scene that shows the object."""
    easing = camera_rig.SMOOTH if board.is_smooth else camera_rig.EVEN
    way = camera_rig.Way(board.scenes[0].first, float(shows[0]))
    for number, (before, after, dissolves) in enumerate(camera_rig.transitions(board), 1):
        if shows[number] != shows[number - 1]:
            start = float(shows[number - 1])
            way.append(before.last, start, camera_rig.LINEAR if way.points[-1][1] == start else camera_rig.CONSTANT)
            way.append(after.first, 1.0 if shows[number] else 2.0, easing if dissolves else camera_rig.CONSTANT)
    item.color[3] = way.points[0][1]
    if len(way.points) > 1:
        way.insert(item, "color", 3)


def hide(item, board, shows):
    """Adds key frames that show an object from the start of the transition to a scene with it until the end of the
    transition from it. shows: True for each scene that shows the object."""
    if all(shows):
        return
    way = camera_rig.Way(board.scenes[0].first, float(not shows[0]))
    for number, (before, after, _) in enumerate(camera_rig.transitions(board), 1):
        if shows[number] and not shows[number - 1]:
            way.append(before.last + 1, 0.0, camera_rig.CONSTANT)
        elif shows[number - 1] and not shows[number]:
            way.append(after.first, 1.0, camera_rig.CONSTANT)
    for path in ("hide_render", "hide_viewport"):
        way.insert(item, path)
