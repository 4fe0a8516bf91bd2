# SPDX-License-Identifier: GPL-3.0-or-later
"""The camera of a storyboard: a child of its target, with key frames at the beginning and the end of each
transition."""

import math

import bpy
import numpy as np

from . import camera_path, curves, keys

#: The tolerance of a camera's path: the angle seen from its target in degrees, and the relative error of its distance,
#: angle of view and height.
TURN, SIZE = 0.2, 1e-3


def add(collection, board, name, scale, origin):
    """Adds the camera of a storyboard to a collection and returns its object. Its parent is an empty object at the
    target."""
    poses = camera_path.complete([camera_path.pose_of(scene.camera) for scene in board.scenes])
    target = bpy.data.objects.new(f"{name}.target", None)
    target.rotation_mode = "QUATERNION"
    target.empty_display_size = 5.0 * scale
    data = bpy.data.cameras.new(f"{name}.camera")
    item = bpy.data.objects.new(data.name, data)
    item.parent = target
    data.sensor_fit = "VERTICAL"
    data.type = "ORTHO" if poses[0].is_flat else "PERSP"
    for each in target, item:
        collection.objects.link(each)
    half = 0.5 * data.sensor_height
    places = [(pose.target - origin) * scale for pose in poses]
    key(board, target, "location", places, target.location)
    key(board, target, "rotation_quaternion", [pose.turn for pose in poses], target.rotation_quaternion,
        camera_path.slerp_progress, _tolerance_of_turn)
    key(board, item, "location", [(0.0, 0.0, pose.distance * scale) for pose in poses], item.location, _log_progress,
        _tolerance_of_size, (2,))
    data.lens, data.ortho_scale = half / poses[0].tangent, poses[0].height * scale
    key(board, data, "lens", [(half / pose.tangent,) for pose in poses], None,
        lambda before, after, share: camera_path.lens_progress(before[0] / half, after[0] / half, share),
        _tolerance_of_size)
    if any(pose.is_flat for pose in poses):
        key(board, data, "ortho_scale", [(pose.height * scale,) for pose in poses], None, _log_progress,
            _tolerance_of_size)
    if len({pose.is_flat for pose in poses}) > 1:
        _step(board, data, "type", [float(pose.is_flat) for pose in poses])
    if any(pose.extra for pose in poses):
        _step(board, item, "delta_location", [pose.extra * scale for pose in poses], 2)
    return item


def reach_all(item, board, points_of_scenes, scale):
    """Sets the clipping of the camera so that it shows everything in all scenes. points_of_scenes: the atoms of each
    scene, (n, 3) Å."""
    reach = max(float(np.linalg.norm(points - np.array(scene.camera["position"]), axis=1).max())
                for scene, points in zip(board.scenes, points_of_scenes)) * scale
    item.data.clip_start, item.data.clip_end = max(1e-4 * reach, 1e-6), 4.0 * reach


def _log_progress(before, after, share):
    return camera_path.log_progress(before[0], after[0], share)


def _tolerance_of_turn(before, after):
    degrees = math.degrees(2.0 * math.acos(min(abs(float(np.dot(before, after))), 1.0)))
    return TURN / max(degrees, TURN)


def _tolerance_of_size(before, after):
    return SIZE * min(before[0], after[0]) / max(abs(after[0] - before[0]), 1e-9 * before[0])


def transitions(board):
    """Returns each pair of successive scenes, and True if there is a picture between them."""
    return [(before, after, after.first > before.last + 1) for before, after in zip(board.scenes, board.scenes[1:])]


def key(board, owner, path, values, now, way=lambda before, after, share: share, tolerance=lambda before, after: 1e-6,
        channels=None):
    """Adds key frames to a property of a data block.

    values: the values of all channels for each scene.
    now: the property, which gets the values of the first scene; None for a property without channels.
    way(before, after, share): returns how much of the straight line between the values of two scenes is done.
    tolerance(before, after): the tolerance of keys.follow().
    channels: the channels to key; None for all."""
    channels = tuple(range(len(values[0]))) if channels is None else channels
    values = [[float(value[channel]) for channel in channels] for value in values]
    ways = [keys.Way(board.scenes[0].last, part) for part in values[0]]
    start = curves.SMOOTH if board.is_smooth else curves.EVEN
    for (before, after, dissolves), one, other in zip(transitions(board), values, values[1:]):
        for each, part in zip(ways, one):
            each.append(before.last, part)
        if dissolves and one != other:
            keys.follow(ways, (before.last, after.first), (one, other), lambda time: way(one, other, board.share(time)),
                        tolerance(one, other), start)
        for each, part in zip(ways, other):
            each.append(after.first, part, keys.LINEAR if dissolves else keys.CONSTANT)
    for channel, each in zip(channels, ways):
        if now is not None:
            now[channel] = each.points[0][1]
        each.insert(owner, path, -1 if now is None else channel)


def _step(board, owner, path, values, index=-1):
    """Adds key frames to a property that is constant until the next scene begins."""
    way = keys.Way(board.scenes[0].first, values[0])
    for scene, value in zip(board.scenes[1:], values[1:]):
        way.append(scene.first, value, keys.CONSTANT)
    way.insert(owner, path, index)
