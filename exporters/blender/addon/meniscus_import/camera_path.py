# SPDX-License-Identifier: GPL-3.0-or-later
"""Cameras as a target, a rotation and a distance, and the path from one to the next. Uses numpy only, not Blender."""

import math

import numpy as np


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
