# SPDX-License-Identifier: GPL-3.0-or-later
"""Fits the handles of curves between key frames to a path. Uses numpy only, not Blender."""

import numpy as np

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
