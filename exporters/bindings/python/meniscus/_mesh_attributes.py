# SPDX-License-Identifier: BSD-3-Clause
"""Numbers of the vertices of a mesh, which the library writes to files, as arrays."""
from __future__ import annotations

import os
import re
import tempfile
from typing import Any, Protocol

import numpy as np

from ._errors import UsageError
from ._types import AnyArray, Floats, Singles

_TYPES = {"float": "<f4", "uchar": "u1", "int": "<i4", "double": "<f8"}
#: The properties of vertices in PLY files that are no attributes.
_OTHERS = ("x", "y", "z", "nx", "ny", "nz", "red", "green", "blue")


class Saved(Protocol):
    """The parts of a Mesh that this file uses."""

    @property
    def vertices(self) -> Floats: ...
    def save(self, path: str, *, attributes: str) -> None: ...


def _vertices_of(content: bytes) -> AnyArray:
    """Returns the vertices of a binary PLY file as a structured array."""
    head, rows = content.split(b"end_header\n", 1)
    text = head.decode().split("element face")[0]
    row = np.dtype([(name, _TYPES[kind]) for kind, name in re.findall(r"^property (\w+) (\w+)$", text, re.M)])
    count = re.search(r"^element vertex (\d+)$", text, re.M)
    assert count is not None
    return np.frombuffer(rows, row, int(count[1]))


def _places(points: AnyArray) -> list[bytes]:
    """Returns points as keys: their bytes in single precision."""
    rows = np.ascontiguousarray(points, "<f4") + np.float32(0)  # without negative zeros
    return [row.tobytes() for row in rows]


def attribute_of(mesh: Saved, name: str) -> Singles:
    """Returns the numbers of an attribute. Parameters and errors are those of Mesh.attribute()."""
    if not isinstance(name, str) or name in ("all", "usual", "none") or "," in name:
        raise UsageError(f"name is {name!r}; give the name of one attribute, such as mean_curvature")
    with tempfile.TemporaryDirectory(prefix="meniscus-") as folder:
        path = os.path.join(folder, "mesh.ply")
        mesh.save(path, attributes=name)
        with open(path, "rb") as file:
            table = _vertices_of(file.read())
    values: Any = table[next(column for column in table.dtype.names or () if column not in _OTHERS)]
    saved = np.stack([table[axis] for axis in "xyz"], axis=1)
    row_of = dict(zip(reversed(_places(saved)), range(len(saved) - 1, -1, -1)))
    rows = [row_of.get(place, -1) for place in _places(np.asarray(mesh.vertices))]
    for vertex in (n for n, row in enumerate(rows) if row < 0):  # the file has welded it with a neighbour
        rows[vertex] = int(np.argmin(((saved - mesh.vertices[vertex]) ** 2).sum(axis=1)))
    return np.asarray(values[rows], np.float32)
