# SPDX-License-Identifier: BSD-3-Clause
"""The surface of atoms: its area and volume, patches, meshes, distances and pictures."""
from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any, Literal, Optional, Union, overload

import numpy as np

from . import _header as header
from . import _library as lib
from ._arguments import (AnyArray, Device, Floats, Indices, Kind, Projection, Quantity, Rows, flag, number,
                         warn_of_nanometres, word)
from ._arrays import doubles, numbers, real_array, view
from ._columns import frame_of, sums_of
from ._errors import GpuError, InputError
from ._mesh import Mesh
from ._page import Page, made
from ._picture import DEVICES, Camera, Picture, framed, of_picture, painted
from ._scene import Scene
from ._patches import Patches, Pocket, pockets_of
from ._structure import Structure

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._scene_values import SurfaceValues

_KINDS = {"ses": header.SES, "sas": header.SAS, "vdw": header.VDW}
_GRADIENTS = {"area": header.GRADIENT_AREA, "volume": header.GRADIENT_VOLUME, "sas_area": header.GRADIENT_SAS_AREA,
              "sas_volume": header.GRADIENT_SAS_VOLUME}
_COUNTS = [field[0] for field in header.Summary._fields_ if field[1] is ctypes.c_uint64]


def _radii_of(radii: Any) -> AnyArray:
    """Returns a copy of the radii in Å: (n,), or () if one radius is that of all atoms."""
    array = real_array(radii, "radii", power=1)
    return np.array(array, dtype=np.float64) if array.ndim == 0 else np.array(numbers(array, "radii")[0])


def _summary_of(handle: lib.Handle) -> header.Summary:
    """Returns the numbers of a surface."""
    summary = header.Summary(ctypes.sizeof(header.Summary))
    lib.call("surface_summary", handle.pointer, ctypes.byref(summary))
    summary.owner = handle  # owns the text in summary.device
    return summary


class Surface:
    """The exact, closed surface of atoms, which surface() and the from_...() functions compute.

    In the shapes of arrays, n is the number of atoms; arrays are read-only views. Many threads may use a surface at
    once: after update(), they get the arrays of the new frame, while the arrays that they have remain those of the old
    one.

    >>> s = meniscus.surface([[0, 0, 0], [1.5, 0, 0], [2.3, 1.3, 0], [6, 0, 0]], [1.7, 1.7, 1.52, 1.7])
    >>> s
    <meniscus.Surface: ses of 4 atoms, 100.83 Å², 67.39 Å³, 1 component>"""

    __slots__ = ("_computer", "_handle", "_kind", "_options", "_radii", "_structure", "__weakref__")

    def __init__(self, xyz: Any, radii: Any, probe: float, kind: Kind, device: Device, threads: int,
                 verify: bool, structure: Optional[Structure] = None) -> None:
        self._structure = structure
        options = lib.default("options", header.Options())
        options.probe_radius, options.threads = number("probe", probe), threads
        options.verify = flag("verify", verify)
        options.kind = word("kind", kind, _KINDS)
        if options.probe_radius == 0 and kind != "vdw":
            raise InputError('probe is 0; kind="vdw" is the surface without a probe')
        options.device = word("device", device, DEVICES)
        self._kind: Kind = kind
        self._options = (float(options.probe_radius), kind, device, int(options.threads), bool(options.verify))
        self._computer = lib.Handle("computer", "computer_new", ctypes.byref(options))
        self._radii = _radii_of(radii)
        self._handle = self._computed(xyz, self._radii)

    def _computed(self, xyz: Any, radii: AnyArray) -> lib.Handle:
        positions, positions_type = numbers(xyz, "xyz", 3, power=1)
        if radii.ndim == 1 and len(radii) != len(positions):
            raise InputError(f"there are {len(positions)} positions and {len(radii)} radii")
        radii_type = header.FLOAT if radii.dtype == np.float32 else header.DOUBLE
        atoms = header.Atoms(ctypes.sizeof(header.Atoms), len(positions), positions.ctypes.data, radii.ctypes.data,
                          positions.strides[0], 0, positions_type, radii_type, int(radii.ndim == 0), 0)
        handle = lib.Handle("surface", "compute", self._computer.pointer, ctypes.byref(atoms),
                            long=len(positions) > 2000)
        warn_of_nanometres(positions)
        return handle

    def update(self, xyz: Any, radii: Optional[Any] = None) -> Surface:
        """Computes the surface of the next frame in this object, and returns the object. Arrays that exist already
        remain those of the previous frame.

        xyz: the new positions, (n, 3) Å. radii: the new radii in Å, (n,) or one for all atoms; None if they do not
        change. Raises the errors of surface(); the object then remains at the previous frame.

        >>> round(s.update([[0, 0, 0], [1.5, 0, 0], [2.3, 1.3, 0], [9, 0, 0]]).area, 2)
        99.87"""
        if radii is not None:
            radii = _radii_of(radii)
        wanted = self._radii if radii is None else radii
        self._handle = self._computed(xyz, wanted)
        self._radii = wanted
        if self._structure is not None:
            same = len(self._structure) == len(self)
            self._structure = self._structure._moved(self.balls["center"]) if same else None
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickles have the atoms and the options. Unpickling computes the surface again, with bitwise equal results."""
        return Surface, (np.array(self.balls["center"]), self._radii, *self._options, self._structure)

    def __copy__(self) -> Surface:
        """Returns a surface of the same frame without computing it again. update() of one does not change the other."""
        other = Surface.__new__(Surface)
        other._computer, other._handle, other._kind = self._computer, self._handle, self._kind
        other._options, other._radii, other._structure = self._options, self._radii, self._structure
        return other

    def __deepcopy__(self, memo: Any) -> Surface:
        return self.__copy__()

    # ---- numbers

    def _summary(self) -> header.Summary:
        return _summary_of(self._handle)

    @property
    def area(self) -> float:
        """The area of all components in Å².

        >>> round(s.area, 2)
        100.83"""
        return float(self._summary().area)

    @property
    def volume(self) -> float:
        """The volume of the solid in Å³: of outer components without cavities.

        >>> round(s.volume, 2)
        67.39"""
        return float(self._summary().volume)

    @property
    def probe(self) -> float:
        """The radius of the probe in Å; 0 for kind "vdw".

        >>> s.probe
        1.4"""
        return float(self._summary().probe_radius)

    @property
    def kind(self) -> Kind:
        """The kind of surface: "ses", "sas" or "vdw".

        >>> s.kind
        'ses'"""
        return self._kind

    @property
    def device(self) -> str:
        """The device that computed the surface: "cpu (16 threads)", or the GL renderer and version.

        >>> s.device.startswith("cpu")
        True"""
        return str(self._summary().device.decode())

    @property
    def grown_by(self) -> float:
        """The largest amount in Å by which radii were increased to resolve ties; usually 0.

        >>> s.grown_by
        0.0"""
        return float(self._summary().grown_by)

    @property
    def exact_within(self) -> float:
        """A distance in Å: the surface is exact for radii that differ from the given ones by at most this. It is 0 if
        the surface is exact for the given radii.

        >>> s.exact_within
        0.0"""
        return float(self._summary().exact_within)

    @property
    def counts(self) -> dict[str, int]:
        """The numbers of atoms, patches of each kind, faces, borders, vertices, components and cavities, by their names
        in meniscus_summary of meniscus.h.

        >>> s.counts["atoms"], s.counts["cavities"]
        (4, 0)"""
        summary = self._summary()
        return {name: getattr(summary, name) for name in _COUNTS}

    def __len__(self) -> int:
        return int(self._summary().atoms)

    # ---- the molecule

    @property
    def structure(self) -> Optional[Structure]:
        """The molecule that the surface is of, with the positions of this frame; None for bare positions and radii.

        >>> len(meniscus.surface(meniscus.read("helix.pdb")).structure)
        64"""
        return self._structure

    def _named(self) -> Structure:
        if self._structure is None:
            raise InputError("the surface is of bare positions and radii; give surface() a meniscus.Structure, which "
                             "knows residues and chains")
        return self._structure

    def _areas(self) -> dict[str, AnyArray]:
        return {"area": self.atom_areas, **({"sas_area": self.atom_sas_areas} if self._kind == "ses" else {})}

    def areas_by(self, by: Literal["residue", "chain", "model"] = "residue") -> Rows:
        """Returns a structured array with a row per residue, chain or model of the molecule: its names, atoms (their
        number), area in Å² and, for kind "ses", sas_area in Å². Raises InputError if the surface is of bare atoms.

        >>> helix = meniscus.surface(meniscus.read("helix.pdb"))
        >>> rows = helix.areas_by("chain")
        >>> rows["chain"].tolist(), rows["area"].round(2).tolist()
        (['A', 'B'], [754.65, 754.33])"""
        return sums_of(self._named(), by, self._areas())

    def to_dataframe(self, by: Literal["atom", "residue", "chain", "model"] = "atom") -> Any:
        """Returns a pandas.DataFrame of the areas in Å² of each atom, residue, chain or model.

        >>> import pandas
        >>> list(s.to_dataframe().columns)
        ['area', 'sas_area']"""
        if by != "atom":
            table = self.areas_by(by)
            return frame_of({name: table[name] for name in table.dtype.names or ()})
        frame = frame_of(self._areas())
        return frame if self._structure is None else self._structure.to_dataframe().join(frame)

    # ---- tables

    def _table(self, table: int, row: Any, columns: int = 0) -> AnyArray:
        return view(self._handle, "surface_table", table, row, columns)

    @property
    def components(self) -> Rows:
        """A structured array with a row per component, outer ones first: kind (0 outer, 1 cavity), area in Å², volume
        in Å³ (negative for cavities, so that the sum is that of the solid), and euler, the Euler characteristic.

        >>> s.components["area"].round(2).tolist()
        [100.83]"""
        return self._table(header.COMPONENTS, header.Component)

    @property
    def atom_areas(self) -> Floats:
        """The areas of the atoms in Å², (n,): for each atom, the area of the part of the surface whose nearest contact
        point is on the atom. The sum is the area of the surface.

        >>> s.atom_areas.round(2).tolist()
        [26.13, 17.92, 19.86, 36.92]"""
        return self._table(header.ATOM_AREAS, np.float64)

    @property
    def atom_sas_areas(self) -> Floats:
        """The solvent-accessible areas of the atoms in Å², (n,). Raises UsageError unless the kind is "ses".

        >>> s.atom_sas_areas.round(2).tolist()
        [72.11, 34.64, 43.29, 98.04]"""
        return self._table(header.ATOM_SAS_AREAS, np.float64)

    @property
    def patches(self) -> Patches:
        """The analytic patches, with the tables to which they refer.

        >>> s.patches.convex["atom"].tolist()
        [0, 1, 2, 3]"""
        handle = self._handle
        tables = ((header.CONVEX, header.Convex), (header.TOROIDAL, header.Toroidal), (header.CONCAVE, header.Concave),
                  (header.PLANES, header.Plane), (header.CONTACTS, np.uint32), (header.CUTS, np.uint32))
        return Patches(*(view(handle, "surface_table", table, row) for table, row in tables))

    @property
    def balls(self) -> Rows:
        """A structured array, (n,), with the center and the radius of each atom in Å; for kind "sas", the radius
        includes the probe's.

        >>> s.balls["radius"].tolist()
        [1.7, 1.7, 1.52, 1.7]"""
        return self._table(header.ATOMS, header.Ball)

    @property
    def faces(self) -> Rows:
        """A structured array with a row per connected piece of a patch: kind (0 convex, 1 toroidal, 2 concave), patch,
        loops, component, tip, and area in Å². meniscus.h describes the rows, also those of the tables below.

        >>> round(float(s.faces["area"].sum()), 2)
        100.83"""
        return self._table(header.FACES, header.Face)

    @property
    def borders(self) -> Rows:
        """A structured array with a row per arc where two faces meet.

        >>> s.borders["radius"].round(2).tolist()[:3]
        [1.65, 1.65, 1.4]"""
        return self._table(header.BORDERS, header.Border)

    @property
    def half_borders(self) -> Indices:
        """The half-borders, (m,): 2 * border, plus 1 if the border is traversed backwards.

        >>> len(s.half_borders) == 2 * len(s.borders)
        True"""
        return self._table(header.HALF_BORDERS, np.uint32)

    @property
    def loops(self) -> Rows:
        """A structured array with a row per closed chain of half_borders, which have their face to the left.

        >>> int(s.loops["half_border_count"].sum()) == len(s.half_borders)
        True"""
        return self._table(header.LOOPS, header.Loop)

    @property
    def vertices(self) -> Floats:
        """The ends of borders in Å, (m, 3).

        >>> s.vertices.shape
        (12, 3)"""
        return self._table(header.VERTICES, np.float64, 3)

    # ---- computations with the surface

    def mesh(self, tolerance: float = 0.01, *, split_colors: bool = True, density: Optional[float] = None,
             even: bool = False) -> Mesh:
        """Returns a triangle mesh of the surface.

        tolerance: the largest distance of the mesh from the surface, 0.00001 to 1 Å. split_colors: whether triangles
        are cut where the nearest contact point changes to another atom; without `even` and `density` only. even:
        whether triangles are nearly equilateral and cross borders of patches. density: None, or the number of vertices
        per Å² of nearly equilateral triangles, 0.005 to 1,000, instead of a tolerance. Raises InputError for numbers
        outside of these ranges, and CapacityError if the mesh does not fit into memory.

        >>> s.mesh(0.05)
        <meniscus.Mesh: 481 vertices, 958 triangles>
        >>> s.mesh(density=1.0)
        <meniscus.Mesh: 102 vertices, 200 triangles>"""
        return Mesh(self, tolerance, split_colors, density, even)

    @overload
    def distance(self, points: Any, *, nearest: Literal[False] = False) -> Floats: ...
    @overload
    def distance(self, points: Any, *, nearest: Literal[True]) -> tuple[Floats, Floats]: ...
    @overload
    def distance(self, points: Any, *, nearest: bool) -> Union[Floats, tuple[Floats, Floats]]: ...

    def distance(self, points: Any, *, nearest: bool = False) -> Union[Floats, tuple[Floats, Floats]]:
        """Returns the exact distances of points from the surface in Å, (m,): above 0 in the solvent, below 0 in the
        solid. For one point, (3,), it is a single number.

        points: (m, 3) or (3,) Å. nearest: whether the nearest points of the surface, (m, 3) Å, are returned, too.
        Raises InputError for points that are not finite.

        >>> s.distance([[0, 0, 0], [6, 0, 3]]).round(2).tolist()
        [-1.7, 1.3]
        >>> round(float(s.distance([6, 0, 3])), 2)
        1.3
        >>> distances, feet = s.distance([[6, 0, 3]], nearest=True)
        >>> feet.round(2).tolist()
        [[6.0, 0.0, 1.7]]"""
        given = real_array(points, "points", 1)
        array = doubles(given.reshape(1, -1) if given.ndim == 1 and len(given) == 3 else given, "points", 3)
        distances = np.empty(len(array))
        feet = np.empty((len(array), 3)) if flag("nearest", nearest) else None
        handle = self._handle
        lib.call("surface_distance", handle.pointer, len(array), array.ctypes.data, distances.ctypes.data,
                 None if feet is None else feet.ctypes.data, long=len(array) > 10_000)
        one = given.ndim == 1
        result: Floats = distances.reshape(()) if one else distances
        return result if feet is None else (result, feet[0] if one else feet)

    def gradient(self, of: Quantity = "area", weights: Optional[Any] = None) -> Floats:
        """Returns the exact derivative of a quantity with respect to the position of each atom, (n, 3), in Å²/Å or
        Å³/Å.

        of: "area" or "volume"; for kind "ses" also "sas_area" or "sas_volume". weights: None, or factors of the
        accessible areas of the atoms, (n,), for "sas_area", and for "area" of the kinds "sas" and "vdw". Raises
        UsageError for other quantities and weights, and InputError for the area and the volume of kind "ses" if a probe
        touches more than three atoms at once, because they are not differentiable then.

        >>> s.gradient("sas_area").shape
        (4, 3)
        >>> np.allclose(s.gradient("volume").sum(axis=0), 0)
        True"""
        handle = self._handle
        quantity = word("of", of, _GRADIENTS)
        summary = _summary_of(handle)
        factors = None if weights is None else doubles(weights, "weights")
        if factors is not None and factors.shape != (summary.atoms,):
            raise InputError(f"weights has the shape {factors.shape}; it has to be ({summary.atoms},)")
        gradient = np.empty((summary.atoms, 3))
        lib.call("surface_gradient", handle.pointer, quantity, None if factors is None else factors.ctypes.data,
                 gradient.ctypes.data, long=summary.atoms > 20_000)
        return gradient

    def pockets(self, large_probe: float = 4.0, *, trim: float = 1.0, min_volume: float = 30.0,
                mouth_tolerance: float = 0.1) -> list[Pocket]:
        """Returns pockets, tunnels and cavities in order of descending volume: the connected spaces that the probe can
        fill inside the surface of a large probe. They are computed in closed form, on the CPU.

        large_probe: the radius of the large probe in Å, above that of the surface's probe and at most 100. trim: 0 to
        100 Å; pockets begin this far below the large probe's surface. min_volume: Å³; smaller pockets are ignored.
        mouth_tolerance: 0.001 to 1 Å; the largest error of the position of a mouth. Raises UsageError unless the kind
        is "ses", and InputError for numbers outside of these ranges.

        >>> meniscus.surface(meniscus.read("helix.pdb")).pockets(min_volume=100)[0].kind
        'cavity'"""
        return pockets_of(self._handle, large_probe, trim, min_volume, mouth_tolerance)

    def camera(self, aspect: float = 4 / 3, projection: Projection = "perspective") -> Camera:
        """Returns the camera that shows all atoms, with their widest side across the picture.

        aspect: width / height of the picture. projection: "perspective" or "orthographic". Raises InputError for an
        aspect of which there is no picture.

        >>> s.camera(projection="orthographic").projection
        'orthographic'"""
        return framed(self._handle, aspect, projection)

    def render(self, *, colors: Optional[Any] = None, camera: Optional[Camera] = None, device: Device = "auto",
               **values: Unpack[SurfaceValues]) -> Picture:
        """Returns a picture of the surface with the program's look.

        colors: sRGB in [0, 1], (3,) or one per atom, (n, 3); or names such as "red" and "#rrggbb". camera: None for
        that of camera(). device: "cpu", "gpu", "software" (GL on the CPU), or "auto", a hardware GPU if one works, else
        the CPU. values: properties of a Scene that concern the look and the image, such as size="800x600" and
        background="white". Raises UsageError for other properties, and GpuError if the device needs GL and there is
        none.

        >>> s.render(size="80x60", background="white", device="cpu")
        <meniscus.Picture: 80x60>"""
        handle = self._handle
        summary = _summary_of(handle)
        scene = Scene()
        for name, value in values.items():
            scene[name] = value
        return painted(handle, summary.atoms, scene._handle, colors, camera, device)

    def show(self, *, structure: Optional[Structure] = None, colors: Optional[Any] = None,
             camera: Optional[Camera] = None, frame_height: int = 480, **values: Unpack[SurfaceValues]) -> Page:
        """Returns a web page in which readers can rotate the surface. A notebook shows it.

        structure: None, or the Structure of the atoms, in the same order, such as s.structure: then the page shows the
        names of atoms, and its readers can choose colour schemes. frame_height: the height of the page in a notebook,
        in CSS pixels. The other parameters and the errors are those of render().

        >>> s.show(color="teal").title
        'Surface of 4 atoms'
        >>> helix = meniscus.read("helix.pdb")
        >>> meniscus.surface(helix).show(structure=helix, colors=helix.colors("residue")).title
        'helix.pdb'"""
        names = None if structure is None else structure._library_object()
        scene = Scene(**values)
        of_atoms, seen_by = of_picture(colors, len(self), camera)
        return made("surface_page", self._handle.pointer, names.pointer if names else None,
                    scene._handle.pointer, ctypes.byref(seen_by) if seen_by else None,
                    None if of_atoms is None else of_atoms.ctypes.data, height=frame_height)

    def _repr_png_(self) -> Optional[bytes]:
        try:
            return self.render(size="640x480").png()
        except GpuError:
            return None  # a notebook shows __repr__() then

    def __repr__(self) -> str:
        s = self._summary()
        return (f"<meniscus.Surface: {self._kind} of {s.atoms} atoms, {s.area:.2f} Å², {s.volume:.2f} Å³, "
                f"{s.components} component{'s' * (s.components != 1)}>")
