# SPDX-License-Identifier: GPL-3.0-or-later
"""Cameras as a target, a turn and a distance, and the way from one to the next, with numpy alone; knows nothing of Blender."""

import math

import numpy as np


class Pose:
    """target: Å. turn: quaternion (w, x, y, z) of the axes right, up, back. distance: Å. tangent: of half the vertical angle.
    height: Å. is_flat: the projection is orthographic."""

    def __init__(self, target, turn, distance, tangent, height, is_flat):
        self.target, self.turn, self.distance = target, turn, distance
        self.tangent, self.height, self.is_flat = tangent, height, is_flat


def pose_of(camera):
    """Of a camera as in a .mns header. What its projection has not is None."""
    position, target, up = (np.array(camera[key], dtype=np.float64) for key in ("position", "target", "up"))
    distance = float(np.linalg.norm(target - position))
    forward = (target - position) / distance
    right = np.cross(forward, up)
    right /= np.linalg.norm(right)
    is_flat = camera["projection"] == "orthographic"
    return Pose(target, quaternion(np.stack([right, np.cross(right, forward), -forward], axis=1)), distance,
                None if is_flat else math.tan(math.radians(camera["vertical_fov"]) / 2), camera["height"] if is_flat else None, is_flat)


def quaternion(matrix):
    """Of a rotation: the eigenvector of the greatest eigenvalue (I. Y. Bar-Itzhack, 2000), with w >= 0."""
    (a, b, c), (d, e, f), (g, h, i) = matrix
    form = np.array([[a + e + i, h - f, c - g, d - b], [h - f, a - e - i, b + d, c + g],
                     [c - g, b + d, e - a - i, f + h], [d - b, c + g, f + h, i - a - e]])
    turn = np.linalg.eigh(form)[1][:, -1]
    return -turn if turn[0] < 0 else turn


def complete(poses):
    """Gives poses, in their order, what their projections lack, as the film has it: on the way to another projection the first one
    stays, and ends with what the second shows in the plane of its target. So an orthographic pose gets the angle of the one before
    and the distance from which that shows as much. `extra`: how much farther away its camera is in truth."""
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
    for before, pose in zip(poses, poses[1:]):  # the short way round
        if np.dot(before.turn, pose.turn) < 0.0:
            pose.turn = -pose.turn
    return poses


def turned(one, other, share):
    """How much of the way from one quaternion to another is done along a straight line whose points are made unit ones, where the
    turn has done a share of its way."""
    half = math.acos(min(max(float(np.dot(one, other)), -1.0), 1.0))
    if half < 1e-6:
        return np.asarray(share, dtype=np.float64)
    before, after = np.sin((1.0 - share) * half), np.sin(share * half)
    return after / (before + after)


def grown(one, other, share):
    """How much of the way from one number above 0 to another is done where their logarithms have done a share of theirs."""
    ratio = math.log(other / one)
    return np.asarray(share, dtype=np.float64) if abs(ratio) < 1e-9 else np.expm1(ratio * share) / math.expm1(ratio)


def grown_lens(one, other, share):
    """The same of the lens of a camera, which is 1 / tan(half the angle): the angle's logarithm goes on steadily."""
    angles = np.arctan([one, other])
    lens = 1.0 / np.tan(np.exp(np.log(angles[0]) + share * np.log(angles[1] / angles[0])))
    return np.asarray(share, dtype=np.float64) if abs(one / other - 1.0) < 1e-9 else (lens - 1.0 / one) / (1.0 / other - 1.0 / one)
