# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames of a sequence as data of a mesh. It does not use Blender, so that another process can read frames ahead."""

import dataclasses

import numpy as np

from . import joined, mesh_arrays, mns_reader, sequence_reader


@dataclasses.dataclass
class Prepared:
    """A frame that is ready for a mesh. surface: all objects and copies as one, with their materials and chains.
    arrays: the arrays of its mesh. points: all atoms in all places, (n, 3) Å. triangles: the expected number of
    triangles."""

    surface: mns_reader.Surface
    arrays: mesh_arrays.MeshArrays
    points: np.ndarray
    triangles: int


def prepare(sequence, scene_frame, origin, scale, crisp):
    """Returns the Prepared of a scene frame. sequence: a sequence_reader.Sequence. origin: Å. scale, crisp: arguments
    of mesh_arrays.of_surface(). Raises MnsError or OSError."""
    file = sequence.read(scene_frame)
    surface = joined.joined(file, origin)
    arrays = mesh_arrays.of_surface(surface, scale, crisp, mesh_arrays.names_of(surface))
    triangles = sum(len(each.copies) * each.header["mesh"]["triangles"] for each in file.objects)
    return Prepared(surface, arrays, points_of(file), triangles)


def points_of(file):
    """Returns the centres of all atoms of a file in all places, (n, 3) Å."""
    return np.concatenate(
        [surface["atom.center"] @ copy[:, :3].T + copy[:, 3] for surface in file.objects for copy in surface.copies])


def packed(prepared):
    """Returns a Prepared as plain values and arrays, which can be sent to another process."""
    surface = prepared.surface
    # Empty arrays show only which of these exist.
    existing = {name: np.empty(0) for name in ("atom.opacity", "mesh.cap_plane") if surface.get(name) is not None}
    return {
        "path": surface.path, "header": surface.header, "existing": existing, "arrays": vars(prepared.arrays),
        "points": prepared.points, "triangles": prepared.triangles}


def unpacked(given):
    """Returns the Prepared that was packed. The arrays of its surface are empty; they only determine its materials."""
    surface = mns_reader.Surface(given["path"], given["header"], given["existing"])
    return Prepared(surface, mesh_arrays.MeshArrays(**given["arrays"]), given["points"], given["triangles"])


class Manifests:
    """A cache of sequences by the paths of their manifests. A manifest is read again when its file has changed."""

    def __init__(self):
        self._read = {}  # path -> ((modification time, size), sequence)

    def get(self, path):
        """Returns the sequence of a manifest. Raises MnsError or OSError."""
        stamp = mns_reader.stamp(path)
        if self._read.get(path, (None,))[0] != stamp:
            self._read[path] = (stamp, sequence_reader.read(path))
        return self._read[path][1]

    def clear(self):
        self._read.clear()
