# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads and checks cameras as --save-camera writes them, with numpy alone; knows nothing of Blender."""

import math

import numpy as np

try:
    from . import mns_reader
except ImportError:  # outside of the add-on
    import mns_reader

SIZES = {"perspective": "vertical_fov", "orthographic": "height"}
VECTORS = ("position", "target", "up")


def check(camera):
    """Raises ValueError, KeyError or TypeError for a camera that lacks numbers or has senseless ones."""
    vectors = np.array([camera[key] for key in VECTORS], dtype=np.float64)
    size = camera[SIZES[camera["projection"]]]
    if vectors.shape != (3, 3) or not np.isfinite(vectors).all() or not (math.isfinite(size) and size > 0):
        raise ValueError("position, target, up, vertical_fov or height is not finite and positive")
    if camera["projection"] == "perspective" and size >= 180:
        raise ValueError(f"vertical_fov {size} is not below 180 degrees")
    view = vectors[1] - vectors[0]
    if np.linalg.norm(np.cross(view, vectors[2])) <= 1e-9 * np.linalg.norm(view) * np.linalg.norm(vectors[2]):
        raise ValueError("position equals target, or up points along the view")


def read(path):
    """The camera of a file, a dict as in a .mns header. Raises MnsError or OSError."""
    camera = mns_reader.read_json(path, ", such as --save-camera writes")
    if not isinstance(camera, dict) or camera.get("projection") not in SIZES:
        raise mns_reader.MnsError(f"{path}: no camera: its projection is neither perspective nor orthographic")
    unknown = set(camera) - {*VECTORS, "projection", SIZES[camera["projection"]]}
    if unknown:
        raise mns_reader.MnsError(f"{path}: camera: '{min(unknown)}' is not a key of a camera of this projection")
    try:
        check(camera)
    except KeyError as error:
        raise mns_reader.MnsError(f"{path}: camera: {error} is missing") from None
    except (TypeError, ValueError, OverflowError) as error:
        raise mns_reader.MnsError(f"{path}: camera: {error}") from None
    return camera
