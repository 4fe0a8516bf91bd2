# SPDX-License-Identifier: GPL-3.0-or-later
"""Key frames of a storyboard, whose curves are fitted to a path, and its camera: poses and the path from one to the next,
and an object with key frames at the beginning and the end of each transition."""

import math

import bpy
import numpy as np

from . import compat

CONSTANT, LINEAR = "CONSTANT", "LINEAR"
#: The times at which a path is fitted.
TIMES = np.linspace(0.0, 1.0, 201)
#: The handles of a straight line, and of a curve that starts and ends slowly: t² (3 - 2 t).
EVEN, SMOOTH = (1 / 3, 1 / 3, 2 / 3, 2 / 3), (1 / 3, 0.0, 2 / 3, 1.0)


def bezier(handles, times=TIMES):
    """Returns the heights at `times` of Blender's curve from (0, 0) to (1, 1) with the handles (x, y, x, y)."""
    x1, y1, x2, y2 = handles
    place = times.copy()
    low, high = np.zeros_like(times), np.ones_like(times)
    for _ in range(50):  # bisection works even where the slope is zero
        along = 3 * (1 - place) ** 2 * place * x1 + 3 * (1 - place) * place ** 2 * x2 + place ** 3
        low, high = np.where(along < times, place, low), np.where(along < times, high, place)
        place = 0.5 * (low + high)
    return 3 * (1 - place) ** 2 * place * y1 + 3 * (1 - place) * place ** 2 * y2 + place ** 3


def fitted(way, start):
    """Returns the handles of the curve nearest to a path, and the largest distance between both. The path is given by
    its heights at TIMES. The fit uses the method of Levenberg and Marquardt from the handles `start`."""
    handles = np.array(start, dtype=np.float64)
    rest, damping = bezier(handles) - way, 1e-6
    for _ in range(40):
        if np.abs(rest).max() < 1e-9:
            break
        slopes = np.stack([(bezier(handles + step) - bezier(handles - step)) / 2e-5 for step in 1e-5 * np.eye(4)],
                          axis=1)
        change = np.linalg.solve(slopes.T @ slopes + damping * np.eye(4), -slopes.T @ rest)
        tried = handles + change
        tried[[0, 2]] = np.clip(tried[[0, 2]], 1e-3, 1.0 - 1e-3)
        found = bezier(tried) - way
        if found @ found < rest @ rest:
            handles, rest, damping = tried, found, damping * 0.3
        else:
            damping *= 10.0
    return tuple(handles), float(np.abs(rest).max())


class Way:
    """Key frames of one value. points: pairs of a frame and a value. ways: the curve between two successive points,
    which is CONSTANT, LINEAR or the handles of bezier()."""

    def __init__(self, frame, value):
        self.points, self.ways = [(frame, value)], []

    def append(self, frame, value, way=LINEAR):
        """Appends a key frame. It does nothing at the frame of the last point, and if a value that changes in steps
        only remains the same."""
        if frame > self.points[-1][0] and not (way == CONSTANT and value == self.points[-1][1] and
                                               {CONSTANT}.issuperset(self.ways)):
            self.points.append((frame, value))
            self.ways.append(way)

    def insert(self, owner, path, index=-1):
        """Inserts the key frames into the animation of a data block. index: the index of an array element, or -1."""
        owner.keyframe_insert(path, index=index, frame=self.points[0][0])
        curve = next(each for each in compat.action_curves(owner)
                     if each.data_path == path and each.array_index == max(index, 0))
        curve.keyframe_points[0].co[1] = self.points[0][1]
        for frame, value in self.points[1:]:
            curve.keyframe_points.insert(frame, value, options={"FAST"})
        for point in curve.keyframe_points:
            point.handle_left_type = point.handle_right_type = "FREE"
            point.interpolation = CONSTANT
            point.handle_left, point.handle_right = (np.array(point.co) + (step, 0.0) for step in (-1.0, 1.0))
        for number, way in enumerate(self.ways):
            start, end = curve.keyframe_points[number], curve.keyframe_points[number + 1]
            start.interpolation = way if isinstance(way, str) else "BEZIER"
            if not isinstance(way, str):
                size = np.array(end.co) - np.array(start.co)
                start.handle_right, end.handle_left = (np.array(start.co) + size * part for part in (way[:2], way[2:]))


def follow(ways, frames, ends, share, tolerance, start, most=2):
    """Appends key frames to several Ways, from the first to the second of `frames`, and from the values of the first to
    those of the second of `ends`. share(time): returns the share of the path that is done at a share of the time. If
    the curve would deviate by more than `tolerance` of the path, keys are added by halving the time, up to `most`
    times. start: the initial handles of the fit."""
    low, high = (float(share(time)) for time in (0.0, 1.0))
    handles, missed = fitted((share(TIMES) - low) / (high - low), start)
    if missed * abs(high - low) > tolerance and most > 0 and frames[1] - frames[0] >= 2:
        middle = round(0.5 * (frames[0] + frames[1]))
        part = (middle - frames[0]) / (frames[1] - frames[0])
        reached = (float(share(part)) - low) / (high - low)
        between = [one + (other - one) * reached for one, other in zip(*ends)]
        follow(ways, (frames[0], middle), (ends[0], between), lambda time: share(part * time), tolerance, start,
               most - 1)
        follow(ways, (middle, frames[1]), (between, ends[1]), lambda time: share(part + (1.0 - part) * time), tolerance,
               start, most - 1)
        return
    for way, value in zip(ways, ends[1]):
        way.append(frames[1], value, handles)


#: The tolerance of a camera's path: the angle seen from its target in degrees, and the relative error of its distance,
#: angle of view and height.
TURN, SIZE = 0.2, 1e-3


class Pose:
    """The pose of a camera.

    target: the point it looks at, Å.
    turn: quaternion (w, x, y, z) of the axes right, up, back.
    distance: from the target, Å.
    tangent: the tangent of half the vertical angle of view, or None.
    height: the height of the picture at the target, Å, or None.
    is_flat: True if the projection is orthographic."""

    def __init__(self, target, turn, distance, tangent, height, is_flat):
        self.target, self.turn, self.distance = target, turn, distance
        self.tangent, self.height, self.is_flat = tangent, height, is_flat


def pose_of(camera):
    """Returns the Pose of a camera of a .mns header. The member that its projection does not have is None."""
    position, target, up = (np.array(camera[key], dtype=np.float64) for key in ("position", "target", "up"))
    distance = float(np.linalg.norm(target - position))
    forward = (target - position) / distance
    right = np.cross(forward, up)
    right /= np.linalg.norm(right)
    is_flat = camera["projection"] == "orthographic"
    return Pose(target, quaternion(np.stack([right, np.cross(right, forward), -forward], axis=1)), distance,
                None if is_flat else math.tan(math.radians(camera["vertical_fov"]) / 2),
                camera["height"] if is_flat else None, is_flat)


def quaternion(matrix):
    """Returns the quaternion (w, x, y, z) of a rotation matrix with w >= 0: the eigenvector of the greatest eigenvalue
    of a symmetric form (I. Y. Bar-Itzhack, 2000)."""
    (a, b, c), (d, e, f), (g, h, i) = matrix
    form = np.array([[a + e + i, h - f, c - g, d - b], [h - f, a - e - i, b + d, c + g],
                     [c - g, b + d, e - a - i, f + h], [d - b, c + g, f + h, i - a - e]])
    turn = np.linalg.eigh(form)[1][:, -1]
    return -turn if turn[0] < 0 else turn


def complete(poses):
    """Sets the members of poses that their projections lack, in the same way as the film, and returns the poses in
    their order. During a transition to another projection the first projection remains, and ends with a picture that
    agrees with the second in the plane of its target. So an orthographic pose gets the angle of the previous pose, and
    the distance from which that angle shows the same height. `extra`: the true distance of its camera minus this
    one."""
    lens = next((pose.tangent for pose in poses if not pose.is_flat), math.tan(math.radians(15.0)))
    for number, pose in enumerate(poses):
        pose.extra = 0.0
        if not pose.is_flat:
            pose.height = 2.0 * pose.distance * pose.tangent
            lens = pose.tangent
            continue
        pose.tangent = lens
        if number and not poses[number - 1].is_flat:
            own, pose.distance = pose.distance, pose.height / (2.0 * lens)
            pose.extra = own - pose.distance
    for before, pose in zip(poses, poses[1:]):  # takes the shorter of both rotations
        if np.dot(before.turn, pose.turn) < 0.0:
            pose.turn = -pose.turn
    return poses


def slerp_progress(one, other, share):
    """Returns the share of a normalized straight line from one quaternion to another (nlerp) at which a `share` of the
    rotation angle is done (slerp)."""
    half = math.acos(min(max(float(np.dot(one, other)), -1.0), 1.0))
    if half < 1e-6:
        return np.asarray(share, dtype=np.float64)
    before, after = np.sin((1.0 - share) * half), np.sin(share * half)
    return after / (before + after)


def log_progress(one, other, share):
    """Returns the share of the difference between two positive numbers at which their logarithm has changed by `share`.
    """
    ratio = math.log(other / one)
    return np.asarray(share, dtype=np.float64) if abs(ratio) < 1e-9 else np.expm1(ratio * share) / math.expm1(ratio)


def lens_progress(one, other, share):
    """Returns the share of the difference between two lenses at which the logarithm of the angle of view has changed by
    `share`. The lens is 1 / tan(half the angle), and `one` and `other` are tangents of half the angles."""
    angles = np.arctan([one, other])
    lens = 1.0 / np.tan(np.exp(np.log(angles[0]) + share * np.log(angles[1] / angles[0])))
    return np.asarray(share, dtype=np.float64) if abs(one / other -
                                                      1.0) < 1e-9 else (lens - 1.0 / one) / (1.0 / other - 1.0 / one)


def add(collection, board, name, scale, origin):
    """Adds the camera of a storyboard to a collection and returns its object. Its parent is an empty object at the
    target."""
    poses = complete([pose_of(scene.camera) for scene in board.scenes])
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
        slerp_progress, _tolerance_of_turn)
    key(board, item, "location", [(0.0, 0.0, pose.distance * scale) for pose in poses], item.location, _log_progress,
        _tolerance_of_size, (2,))
    data.lens, data.ortho_scale = half / poses[0].tangent, poses[0].height * scale
    key(board, data, "lens", [(half / pose.tangent,) for pose in poses], None,
        lambda before, after, share: lens_progress(half / before[0], half / after[0], share), _tolerance_of_size)
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
    return log_progress(before[0], after[0], share)


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
    tolerance(before, after): the tolerance of follow().
    channels: the channels to key; None for all."""
    channels = tuple(range(len(values[0]))) if channels is None else channels
    values = [[float(value[channel]) for channel in channels] for value in values]
    ways = [Way(board.scenes[0].last, part) for part in values[0]]
    start = SMOOTH if board.is_smooth else EVEN
    for (before, after, dissolves), one, other in zip(transitions(board), values, values[1:]):
        for each, part in zip(ways, one):
            each.append(before.last, part)
        if dissolves and one != other:
            follow(ways, (before.last, after.first), (one, other), lambda time: way(one, other, board.share(time)),
                        tolerance(one, other), start)
        for each, part in zip(ways, other):
            each.append(after.first, part, LINEAR if dissolves else CONSTANT)
    for channel, each in zip(channels, ways):
        if now is not None:
            now[channel] = each.points[0][1]
        each.insert(owner, path, -1 if now is None else channel)


def _step(board, owner, path, values, index=-1):
    """Adds key frames to a property that is constant until the next scene begins."""
    way = Way(board.scenes[0].first, values[0])
    for scene, value in zip(board.scenes[1:], values[1:]):
        way.append(scene.first, value, CONSTANT)
    way.insert(owner, path, index)
