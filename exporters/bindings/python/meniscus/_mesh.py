# SPDX-License-Identifier: BSD-3-Clause
"""Closed triangle meshes of a surface, and their conversion to objects of other packages."""
from __future__ import annotations

import copy
import ctypes
import importlib
import os
import re
import tempfile
from typing import IO, Any, Optional, Protocol, Union

import numpy as np

from . import _header as header
from . import _library as lib
from ._arguments import AnyArray, Bytes, Floats, Indices, MeshFormat, Path, Singles, file_name, flag, text
from ._arrays import view
from ._errors import UsageError
from ._picture import atom_colors
from ._written import save_by_library

_TYPES = {"float": "<f4", "uchar": "u1", "int": "<i4", "double": "<f8"}
#: The properties of vertices in PLY files that are no attributes.
_OTHERS = ("x", "y", "z", "nx", "ny", "nz", "red", "green", "blue")


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


class Computed(Protocol):
    """The parts of a Surface that its meshes use."""

    _handle: lib.Handle

    def __len__(self) -> int: ...


class Mesh:
    """A closed triangle mesh, which Surface.mesh() makes. It never changes, and all threads may use it at once.

    All vertices lie on the exact surface. Triangles are counter-clockwise as seen from the solvent. In the shapes of
    arrays, n is the number of vertices and m that of triangles; the arrays are read-only views.

    >>> mesh = meniscus.surface([[0, 0, 0], [3, 0, 0]], 1.7).mesh(0.1)
    >>> mesh
    <meniscus.Mesh: 184 vertices, 364 triangles>"""

    __slots__ = ("_handle", "_options", "_surface", "__weakref__")

    def __init__(self, surface: Computed, tolerance: float, split_colors: bool, density: Optional[float],
                 even: bool) -> None:
        options = lib.default("mesh_options", header.MeshOptions())
        options.tolerance, options.split_colors = tolerance, flag("split_colors", split_colors)
        options.method = header.MESH_EVEN if flag("even", even) else header.MESH_BY_PATCH
        if density is not None:
            options.method, options.density = header.MESH_BY_DENSITY, density
        self._surface = copy.copy(surface)  # because update() changes the original
        self._handle = lib.Handle("mesh", "surface_mesh", self._surface._handle.pointer, ctypes.byref(options))
        self._options = (tolerance, split_colors, density, even)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickles have the atoms and the options. Unpickling computes the mesh again, with bitwise equal results."""
        return Mesh, (self._surface, *self._options)

    def __copy__(self) -> Mesh:
        """Returns this object, because it never changes."""
        return self

    def __deepcopy__(self, memo: Any) -> Mesh:
        return self

    def _table(self, table: int, dtype: Any, columns: int = 0) -> AnyArray:
        return view(self._handle, "mesh_table", table, dtype, columns)

    @property
    def vertices(self) -> Floats:
        """The positions of the vertices in Å, (n, 3).

        >>> mesh.vertices.shape
        (184, 3)"""
        return self._table(header.MESH_POSITIONS, np.float64, 3)

    @property
    def normals(self) -> Floats:
        """The exact unit normals at the vertices, (n, 3); at cusps their mean.

        >>> np.allclose(np.linalg.norm(mesh.normals, axis=1), 1)
        True"""
        return self._table(header.MESH_NORMALS, np.float64, 3)

    @property
    def triangles(self) -> Indices:
        """The vertices of each triangle, (m, 3).

        >>> len(mesh.triangles) == 2 * len(mesh.vertices) - 4
        True"""
        return self._table(header.MESH_TRIANGLES, np.uint32, 3)

    @property
    def triangle_atoms(self) -> Indices:
        """The atom of each triangle, (m,): the atom whose contact point is nearest.

        >>> np.bincount(mesh.triangle_atoms).tolist()
        [182, 182]"""
        return self._table(header.MESH_TRIANGLE_ATOMS, np.uint32)

    @property
    def triangle_kinds(self) -> Bytes:
        """The kind of patch of each triangle, (m,): 0 convex, 1 toroidal, 2 concave.

        >>> np.bincount(mesh.triangle_kinds).tolist()
        [252, 112]"""
        return self._table(header.MESH_TRIANGLE_KINDS, np.uint8)

    @property
    def triangle_faces(self) -> Indices:
        """The row of Surface.faces of each triangle, (m,).

        >>> int(mesh.triangle_faces.max())
        2"""
        return self._table(header.MESH_TRIANGLE_FACES, np.uint32)

    @property
    def triangle_patches(self) -> Indices:
        """The patch of each triangle, (m,): a row of the patches of its kind in Surface.patches.

        >>> int(mesh.triangle_patches.max())
        1"""
        return self._table(header.MESH_TRIANGLE_PATCHES, np.uint32)

    @property
    def triangle_components(self) -> Indices:
        """The row of Surface.components of each triangle, (m,).

        >>> int(mesh.triangle_components.max())
        0"""
        return self._table(header.MESH_TRIANGLE_COMPONENTS, np.uint32)

    @property
    def vertex_atoms(self) -> Indices:
        """The atom of each vertex, (n,): the atom whose contact point is nearest.

        >>> np.bincount(mesh.vertex_atoms).tolist()
        [103, 81]"""
        return self._table(header.MESH_VERTEX_ATOMS, np.uint32)

    @property
    def sharp_corners(self) -> Indices:
        """The corners of triangles at cusps, (k,), as 3 * triangle + 0, 1 or 2, in ascending order.

        >>> mesh.sharp_corners.tolist()
        []"""
        return self._table(header.MESH_SHARP_CORNERS, np.uint32)

    @property
    def sharp_normals(self) -> Floats:
        """The exact unit normals at sharp_corners, (k, 3).

        >>> mesh.sharp_normals.shape
        (0, 3)"""
        return self._table(header.MESH_SHARP_NORMALS, np.float64, 3)

    def __repr__(self) -> str:
        return f"<meniscus.Mesh: {len(self.vertices)} vertices, {len(self.triangles)} triangles>"

    def save(self, path: Union[Path, IO[bytes]], *, format: Optional[MeshFormat] = None, colors: Optional[Any] = None,
             attributes: str = "usual", scale: float = 1.0, replace: bool = False) -> None:
        """Writes the mesh to a file, completely or not at all. Edges shorter than 0.001 Å and triangles without area in
        single precision are welded in the file.

        path: a path, or a binary file object. format: "stl", "3mf", "obj", "off", "glb", "vtp", "smesh", "dms", "ply",
        "ply-ascii", "usda", "usdz" or "py", a script for PyMOL; None for that of the path's extension, which file
        objects need. colors: sRGB in [0, 1], (3,) or one per atom. attributes: numbers of vertices in GLB, PLY, VTP and
        USD files, separated by commas. "usual" means "vdw_radii", "atom_index", "ses_kind" and "ses_component"; the
        others are "mean_curvature", "gaussian_curvature", "smooth_mean_curvature", "smooth_gaussian_curvature",
        "atom_area", "accessible_area", "patch_area", "open_sky" and "atom_open_sky". "all" means all but the last two,
        and "none" none. scale: the length of 1 Å in the file. replace: whether an existing file is replaced.

        Raises OutputError if the file cannot be written, or exists and is not replaced; UsageError for an unknown
        format or attribute; InputError for impossible colours; NotClosedError if "smesh" finds no point inside a
        component.

        >>> mesh.save("pair.ply", colors=(0.9, 0.6, 0.3))
        >>> import io
        >>> file = io.BytesIO()
        >>> mesh.save(file, format="stl", colors="teal")
        """
        if hasattr(path, "write"):
            if format is None:
                raise UsageError("format is missing: a file object has no extension; give a format such as \"stl\"")
            save_by_library(path, "", lambda file: self.save(file, format=format, colors=colors, attributes=attributes,
                                                             scale=scale))
            return
        name = file_name("path", path)
        file = lib.default("mesh_file", header.MeshFile())
        file.format, file.attributes = text("format", format), text("attributes", attributes)
        file.scale, file.replace = scale, flag("replace", replace)
        if colors is not None:
            of_atoms = atom_colors(colors, len(self._surface))
            file.atom_colors = of_atoms.ctypes.data
        lib.call("mesh_save", self._handle.pointer, name, ctypes.byref(file))

    def attribute(self, name: str) -> Singles:
        """Returns numbers of the vertices, (n,), in single precision.

        name: one of the attributes of save(), such as "mean_curvature" (1/Å, positive where the solid is convex),
        "gaussian_curvature" (1/Å²), "smooth_mean_curvature" or "atom_area" (Å²). Raises UsageError for other names.

        >>> round(float(mesh.attribute("mean_curvature").max()), 3)
        0.588"""
        if not isinstance(name, str) or name in ("all", "usual", "none") or "," in name:
            raise UsageError(f"name is {name!r}; give the name of one attribute, such as mean_curvature")
        with tempfile.TemporaryDirectory(prefix="meniscus-") as folder:
            path = os.path.join(folder, "mesh.ply")
            self.save(path, attributes=name)
            with open(path, "rb") as file:
                table = _vertices_of(file.read())
        values: Any = table[next(column for column in table.dtype.names or () if column not in _OTHERS)]
        saved = np.stack([table[axis] for axis in "xyz"], axis=1)
        row_of = dict(zip(reversed(_places(saved)), range(len(saved) - 1, -1, -1)))
        rows = [row_of.get(place, -1) for place in _places(np.asarray(self.vertices))]
        for vertex in (n for n, row in enumerate(rows) if row < 0):  # the file has welded it with a neighbour
            rows[vertex] = int(np.argmin(((saved - self.vertices[vertex]) ** 2).sum(axis=1)))
        return np.asarray(values[rows], np.float32)

    def to_trimesh(self) -> Any:
        """Returns a trimesh.Trimesh with "atom", "kind" and "component" in its face_attributes.

        >>> import trimesh
        >>> mesh.to_trimesh().is_watertight
        True"""
        trimesh = importlib.import_module("trimesh")
        return trimesh.Trimesh(np.array(self.vertices), np.array(self.triangles, dtype=np.int64),
                               vertex_normals=np.array(self.normals), process=False,
                               face_attributes={"atom": np.array(self.triangle_atoms),
                                                "kind": np.array(self.triangle_kinds),
                                                "component": np.array(self.triangle_components)})

    def to_pyvista(self) -> Any:
        """Returns a pyvista.PolyData with "Normals" as point data and "atom", "kind" and "component" as cell data.

        >>> import pyvista
        >>> mesh.to_pyvista().n_open_edges
        0"""
        pyvista = importlib.import_module("pyvista")
        triangles = self.triangles
        faces = np.empty((len(triangles), 4), dtype=np.int64)
        faces[:, 0], faces[:, 1:] = 3, triangles
        mesh = pyvista.PolyData(np.array(self.vertices), faces.ravel())
        mesh.point_data["Normals"] = np.array(self.normals)
        mesh.cell_data["atom"] = np.array(self.triangle_atoms)
        mesh.cell_data["kind"] = np.array(self.triangle_kinds)
        mesh.cell_data["component"] = np.array(self.triangle_components)
        return mesh

    def to_open3d(self) -> Any:
        """Returns an open3d.geometry.TriangleMesh with vertex normals.

        >>> import open3d
        >>> mesh.to_open3d().is_watertight()
        True"""
        open3d = importlib.import_module("open3d")
        mesh = open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(np.array(self.vertices)),
                                            open3d.utility.Vector3iVector(np.array(self.triangles, dtype=np.int32)))
        mesh.vertex_normals = open3d.utility.Vector3dVector(np.array(self.normals))  # Open3D needs writeable arrays
        return mesh
