# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames of a sequence as data of a mesh; knows nothing of Blender, so that another process may read them ahead."""

import dataclasses

import numpy as np

from . import joined, mesh_arrays, mns_reader, sequence_reader


@dataclasses.dataclass
class Prepared:
    """surface: all objects and copies as one, with their materials and chains. arrays: of its mesh. points: (n, 3) Å, all
    atoms in all places. triangles: how many there are."""

    surface: mns_reader.Surface
    arrays: mesh_arrays.MeshArrays
    points: np.ndarray
    triangles: int


def prepare(sequence, scene_frame, origin, scale, crisp):
    """A Prepared. sequence: a sequence_reader.Sequence; origin: Å; scale, crisp: as of mesh_arrays.of_surface. Raises MnsError or
    OSError."""
    file = sequence.read(scene_frame)
    surface = joined.joined(file, origin)
    arrays = mesh_arrays.of_surface(surface, scale, crisp, mesh_arrays.names_of(surface))
    triangles = sum(len(each.copies) * each.header["mesh"]["triangles"] for each in file.objects)
    return Prepared(surface, arrays, points_of(file), triangles)


def points_of(file):
    """(n, 3) Å: all atoms of a file in all places."""
    return np.concatenate([surface["atom.center"] @ copy[:, :3].T + copy[:, 3] for surface in file.objects for copy in surface.copies])


def packed(prepared):
    """Plain values and arrays, for a process."""
    surface = prepared.surface
    told = {name: np.empty(0) for name in ("atom.opacity", "mesh.cap_plane") if surface.get(name) is not None}  # that there are some
    return {"path": surface.path, "header": surface.header, "told": told, "arrays": vars(prepared.arrays), "points": prepared.points,
            "triangles": prepared.triangles}


def unpacked(given):
    """The Prepared that was packed; of its surface's arrays it is known only which materials they ask for."""
    surface = mns_reader.Surface(given["path"], given["header"], given["told"])
    return Prepared(surface, mesh_arrays.MeshArrays(**given["arrays"]), given["points"], given["triangles"])


class Manifests:
    """Sequences by the paths of their manifests, read again when a file has changed."""

    def __init__(self):
        self._read = {}  # path -> ((modification time, size), sequence)

    def get(self, path):
        """Raises MnsError or OSError."""
        stamp = mns_reader.stamp(path)
        if self._read.get(path, (None,))[0] != stamp:
            self._read[path] = (stamp, sequence_reader.read(path))
        return self._read[path][1]

    def clear(self):
        self._read.clear()
