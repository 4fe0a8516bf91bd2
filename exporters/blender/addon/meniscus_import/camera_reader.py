# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads and checks cameras that --save-camera writes. Uses numpy only, not Blender."""

try:
    from . import mns_reader
    from .header_values import SIZES, VECTORS, check_camera
except ImportError:  # imported outside of the add-on
    import mns_reader
    from header_values import SIZES, VECTORS, check_camera


def read(path):
    """Returns the camera of a file as a dict with the keys of a .mns header. Raises MnsError or OSError."""
    camera = mns_reader.read_json(path, ", such as --save-camera writes")
    if not isinstance(camera, dict) or str(camera.get("projection")) not in SIZES:
        raise mns_reader.MnsError(f"{path}: no camera: its projection is neither perspective nor orthographic")
    unknown = set(camera) - {*VECTORS, "projection", SIZES[camera["projection"]]}
    if unknown:
        raise mns_reader.MnsError(f"{path}: camera: '{min(unknown)}' is not a key of a camera of this projection")
    try:
        check_camera(camera)
    except ValueError as error:
        raise mns_reader.MnsError(f"{path}: camera: {error}") from None
    return camera
