# SPDX-License-Identifier: GPL-3.0-or-later
"""Key frames of a property, and the curves between them, which are fitted to a path."""

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
