# SPDX-License-Identifier: BSD-3-Clause
"""The surface of some atoms: its measures, patches, meshes, distances and pictures."""
from __future__ import annotations

import ctypes
import os
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Optional, Union, overload

import numpy as np

from . import _header as header
from . import _library as lib
from ._arguments import flag, warn_of_nanometres, word
from ._arrays import doubles, numbers, real_array, view
from ._errors import GpuError, InputError
from ._mesh import Mesh
from ._page import Page, made
from ._picture import DEVICES, Camera, Picture, framed, of_picture, painted
from ._pockets import Pocket, pockets_of
from ._scene import Scene
from ._structure import Structure
from ._types import AnyArray, Bytes, Device, Floats, Indices, Kind, Projection, Quantity, Rows

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._scene_values import SurfaceValues

_KINDS = {"ses": header.SES, "sas": header.SAS, "vdw": header.VDW}
_GRADIENTS = {"area": header.GRADIENT_AREA, "volume": header.GRADIENT_VOLUME, "sas_area": header.GRADIENT_SAS_AREA,
              "sas_volume": header.GRADIENT_SAS_VOLUME}
_COUNTS = [name for name, kind in header.Summary._fields_ if kind is ctypes.c_uint64]


class Patches(NamedTuple):
    """The analytic patches: structured arrays convex, toroidal, concave and planes, whose rows meniscus.h describes, and
    contacts and cuts, (n,), which they index.

    >>> patches = meniscus.surface([[0, 0, 0], [3, 0, 0]], 1.7).patches
    >>> len(patches.convex), len(patches.toroidal), len(patches.concave)
    (2, 1, 0)
    >>> patches.toroidal["atom"].tolist()
    [[0, 1]]"""
    convex: Rows
    toroidal: Rows
    concave: Rows
    planes: Rows
    contacts: Indices
    cuts: Indices


def _radii_of(radii: Any) -> AnyArray:
    """A copy; of no dimension where one counts for all."""
    given = real_array(radii, "radii", power=1)
    return np.array(given, dtype=np.float64) if given.ndim == 0 else np.array(numbers(given, "radii")[0])


def _summary_of(handle: lib.Handle) -> header.Summary:
    summary = header.Summary(ctypes.sizeof(header.Summary))
    lib.call("surface_summary", handle.pointer, ctypes.byref(summary))
    summary.owner = handle  # which owns the text in summary.device
    return summary


class Surface:
    """The exact, closed surface of some atoms; surface() and its like make it. Arrays are read-only views, and n counts
    atoms. May be used by many threads at once: update() replaces what the others get from then on, never what they
    have.

    >>> s = meniscus.surface([[0, 0, 0], [1.5, 0, 0], [2.3, 1.3, 0], [6, 0, 0]], [1.7, 1.7, 1.52, 1.7])
    >>> s
    <meniscus.Surface: ses of 4 atoms, 100.83 Å², 67.39 Å³, 1 components>"""

    __slots__ = ("_computer", "_handle", "_kind", "_options", "_radii", "__weakref__")

    def __init__(self, xyz: Any, radii: Any, probe: float, kind: Kind, device: Device, threads: int,
                 verify: bool) -> None:
        options = lib.default("options", header.Options())
        options.probe_radius, options.threads, options.verify = probe, threads, flag("verify", verify)
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
        handle = lib.Handle("surface", "compute", self._computer.pointer, ctypes.byref(atoms))
        warn_of_nanometres(positions)
        return handle

    def update(self, xyz: Any, radii: Optional[Any] = None) -> Surface:
        """The next frame: other positions, and radii where they change too. Returns itself. Arrays that were taken
        before keep the frame they belong to. Errors are those of surface(), and leave the frame before.

        >>> round(s.update([[0, 0, 0], [1.5, 0, 0], [2.3, 1.3, 0], [9, 0, 0]]).area, 2)
        99.87"""
        if radii is not None:
            radii = _radii_of(radii)
        wanted = self._radii if radii is None else radii
        self._handle = self._computed(xyz, wanted)
        self._radii = wanted
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickles hold the atoms and the options; what is read from one is computed again, to the same bits."""
        return Surface, (np.array(self.balls["center"]), self._radii, *self._options)

    def __copy__(self) -> Surface:
        """The same frame, which update() of the other leaves as it is; nothing is computed for it."""
        other = Surface.__new__(Surface)
        other._computer, other._handle, other._kind = self._computer, self._handle, self._kind
        other._options, other._radii = self._options, self._radii
        return other

    def __deepcopy__(self, memo: Any) -> Surface:
        return self.__copy__()

    # ---- measures

    def _summary(self) -> header.Summary:
        return _summary_of(self._handle)

    @property
    def area(self) -> float:
        """Å² of all components.

        >>> round(s.area, 2)
        100.83"""
        return float(self._summary().area)

    @property
    def volume(self) -> float:
        """Å³ of the solid: outer components less cavities.

        >>> round(s.volume, 2)
        67.39"""
        return float(self._summary().volume)

    @property
    def probe(self) -> float:
        """Å; 0 of kind "vdw".

        >>> s.probe
        1.4"""
        return float(self._summary().probe_radius)

    @property
    def kind(self) -> Kind:
        """"ses", "sas" or "vdw".

        >>> s.kind
        'ses'"""
        return self._kind

    @property
    def device(self) -> str:
        """What computed it: "cpu (16 threads)", or GL renderer and version.

        >>> s.device.startswith("cpu")
        True"""
        return str(self._summary().device.decode())

    @property
    def grown_by(self) -> float:
        """Å by which radii were grown at most to tell ties apart; 0 as a rule.

        >>> s.grown_by
        0.0"""
        return float(self._summary().grown_by)

    @property
    def exact_within(self) -> float:
        """Å: the surface is exact for radii that differ from the given ones by so much at most; 0: for the given ones.

        >>> s.exact_within
        0.0"""
        return float(self._summary().exact_within)

    @property
    def counts(self) -> dict[str, int]:
        """How many atoms, patches of each kind, faces, borders, vertices, components, cavities.

        >>> s.counts["atoms"], s.counts["cavities"]
        (4, 0)"""
        summary = self._summary()
        return {name: getattr(summary, name) for name in _COUNTS}

    def __len__(self) -> int:
        return int(self._summary().atoms)

    # ---- tables

    def _table(self, table: int, row: Any, columns: int = 0) -> AnyArray:
        return view(self._handle, "surface_table", table, row, columns)

    @property
    def components(self) -> Rows:
        """Rows of kind (0 outer, 1 cavity), area, volume (signed: a cavity has the negative of its own, so that the sum is
        the solid's), euler; outer ones first.

        >>> s.components["area"].round(2).tolist()
        [100.83]"""
        return self._table(header.COMPONENTS, header.Component)

    @property
    def atom_areas(self) -> Floats:
        """(n,) Å²: what of the surface is nearest to the contact of each atom; the sum is the area.

        >>> s.atom_areas.round(2).tolist()
        [26.13, 17.92, 19.86, 36.92]"""
        return self._table(header.ATOM_AREAS, np.float64)

    @property
    def atom_sas_areas(self) -> Floats:
        """(n,) Å² of the solvent-accessible surface, atom by atom; UsageError of kinds other than "ses".

        >>> s.atom_sas_areas.round(2).tolist()
        [72.11, 34.64, 43.29, 98.04]"""
        return self._table(header.ATOM_SAS_AREAS, np.float64)

    @property
    def patches(self) -> Patches:
        """The analytic patches and what they index.

        >>> s.patches.convex["atom"].tolist()
        [0, 1, 2, 3]"""
        handle = self._handle
        tables = ((header.CONVEX, header.Convex), (header.TOROIDAL, header.Toroidal), (header.CONCAVE, header.Concave),
                  (header.PLANES, header.Plane), (header.CONTACTS, np.uint32), (header.CUTS, np.uint32))
        return Patches(*(view(handle, "surface_table", table, row) for table, row in tables))

    @property
    def balls(self) -> Rows:
        """(n,) rows of center and radius, Å: what was computed.

        >>> s.balls["radius"].tolist()
        [1.7, 1.7, 1.52, 1.7]"""
        return self._table(header.ATOMS, header.Ball)

    @property
    def faces(self) -> Rows:
        """Connected pieces of patches: kind (0 convex, 1 toroidal, 2 concave), patch, loops, component, tip, area.

        >>> round(float(s.faces["area"].sum()), 2)
        100.83"""
        return self._table(header.FACES, header.Face)

    @property
    def borders(self) -> Rows:
        """Arcs of circles where two faces meet.

        >>> s.borders["radius"].round(2).tolist()[:3]
        [1.65, 1.65, 1.4]"""
        return self._table(header.BORDERS, header.Border)

    @property
    def half_borders(self) -> Indices:
        """(m,) twice the row of a border, and 1 more if it is walked backwards.

        >>> len(s.half_borders) == 2 * len(s.borders)
        True"""
        return self._table(header.HALF_BORDERS, np.uint32)

    @property
    def loops(self) -> Rows:
        """Closed chains of half_borders with their face on the left.

        >>> int(s.loops["half_border_count"].sum()) == len(s.half_borders)
        True"""
        return self._table(header.LOOPS, header.Loop)

    @property
    def vertices(self) -> Floats:
        """(m, 3) Å, where borders end.

        >>> s.vertices.shape
        (12, 3)"""
        return self._table(header.VERTICES, np.float64, 3)

    # ---- what is made of it

    def mesh(self, tolerance: float = 0.01, *, split_colors: bool = True, density: Optional[float] = None,
             even: bool = False) -> Mesh:
        """Triangles that are nowhere farther than `tolerance` (Å) from the surface; with split_colors cut where the
        nearest contact changes. With `even` nearly equilateral ones, which reach over borders of patches; with a
        `density` as many of these as make that many vertices per Å² (0.1: about a triangle an atom), whatever the
        distance. InputError where such a mesh cannot be, CapacityError where it does not fit into memory.

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
        """Å to the nearest point of the surface, above 0 in the solvent, below 0 in the solid; exact everywhere. With
        `nearest` these points, too. points: (m, 3) Å; distances are (m,), nearest points (m, 3). InputError where a
        point is not finite.

        >>> s.distance([[0, 0, 0], [6, 0, 3]]).round(2).tolist()
        [-1.7, 1.3]
        >>> distances, feet = s.distance([[6, 0, 3]], nearest=True)
        >>> feet.round(2).tolist()
        [[6.0, 0.0, 1.7]]"""
        given = doubles(points, "points", 3, power=1)
        distances = np.empty(len(given))
        feet = np.empty((len(given), 3)) if flag("nearest", nearest) else None
        handle = self._handle
        lib.call("surface_distance", handle.pointer, len(given), given.ctypes.data, distances.ctypes.data,
                 None if feet is None else feet.ctypes.data)
        return distances if feet is None else (distances, feet)

    def gradient(self, of: Quantity = "area", weights: Optional[Any] = None) -> Floats:
        """The exact derivative by the position of each atom, (n, 3), Å²/Å or Å³/Å. of: "area", "volume"; of kind "ses"
        also "sas_area", "sas_volume". weights, (n,): by which the accessible areas of atoms count, for "sas_area", and
        for "area" of the kinds "sas" and "vdw". InputError where a probe touches more than three atoms at once: then
        "area" and "volume" of kind "ses" have none.

        >>> s.gradient("sas_area").shape
        (4, 3)
        >>> np.allclose(s.gradient("volume").sum(axis=0), 0)
        True"""
        handle = self._handle
        quantity = word("of", of, _GRADIENTS)
        summary = _summary_of(handle)
        given = None if weights is None else doubles(weights, "weights")
        if given is not None and given.shape != (summary.atoms,):
            raise InputError(f"weights has the shape {given.shape}; it has to be ({summary.atoms},)")
        gradient = np.empty((summary.atoms, 3))
        lib.call("surface_gradient", handle.pointer, quantity, None if given is None else given.ctypes.data,
                 gradient.ctypes.data)
        return gradient

    def pockets(self, large_probe: float = 4.0, *, trim: float = 1.0, min_volume: float = 30.0,
                mouth_tolerance: float = 0.1) -> list[Pocket]:
        """Pockets, tunnels and cavities, the largest volume first: the connected parts of what the surface's probe can
        fill of the solid that a large one of this radius (Å) rolls over, begun `trim` (Å) below its surface. Smaller
        ones than min_volume (Å³) are left out. mouth_tolerance: Å by which a mouth may lie outside of where it should
        be. In closed form, on the CPU. UsageError of kinds other than "ses", InputError where a number cannot be.

        >>> meniscus.surface(meniscus.read("helix.pdb")).pockets(min_volume=100)[0].kind
        'cavity'"""
        return pockets_of(self._handle, large_probe, trim, min_volume, mouth_tolerance)

    def camera(self, aspect: float = 4 / 3, projection: Projection = "perspective") -> Camera:
        """The camera that shows everything. aspect: width / height.

        >>> s.camera(projection="orthographic").projection
        'orthographic'"""
        return framed(self._handle, aspect, projection)

    def render(self, *, colors: Optional[Any] = None, camera: Optional[Camera] = None, device: Device = "auto",
               **values: Unpack[SurfaceValues]) -> Picture:
        """A picture with the program's look: size="800x600", background="white" and what else
        SurfaceValues has are the values of a Scene. colors: one (3,), or one per atom (n, 3), in [0, 1]. device: "auto", a
        hardware GPU if there is one, else "cpu"; GpuError where "gpu" or "software" is asked for and there is no GL.

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
        """A page in which it turns, as Scene.show() makes it; a notebook shows it. structure: what names the atoms that
        readers pick, in the same order, such as read() gave; its schemes of colours can be chosen there, too. The rest is
        that of render(): color="#80c0ff", colors=structure.colors("chain").

        >>> s.show(color="teal").title
        'Surface of 4 atoms'
        >>> helix = meniscus.read("helix.pdb")
        >>> meniscus.surface(helix).show(structure=helix, colors=helix.colors("residue")).title
        'helix.pdb'"""
        names = None if structure is None else structure._handle
        if structure is not None and names is None:
            raise InputError("structure: one that was read, not one that was unpickled; read the file again")
        asked = Scene(**values)
        of_atoms, seen_by = of_picture(colors, len(self), camera)
        return made("surface_page", self._handle.pointer, names.pointer if names else None,
                    asked._handle.pointer, ctypes.byref(seen_by) if seen_by else None,
                    None if of_atoms is None else of_atoms.ctypes.data, height=frame_height)

    def _repr_png_(self) -> Optional[bytes]:
        try:
            return self.render(size="640x480").png()
        except GpuError:
            return None  # the text below will do

    def __repr__(self) -> str:
        s = self._summary()
        return (f"<meniscus.Surface: {self._kind} of {s.atoms} atoms, {s.area:.2f} Å², {s.volume:.2f} Å³, "
                f"{s.components} components>")


@overload
def surface(xyz: Structure, radii: Optional[Any] = None, probe: float = 1.4, *, kind: Kind = "ses",
            device: Device = "cpu", threads: int = 0, verify: bool = False) -> Surface: ...
@overload
def surface(xyz: Any, radii: Any, probe: float = 1.4, *, kind: Kind = "ses", device: Device = "cpu", threads: int = 0,
            verify: bool = False) -> Surface: ...


def surface(xyz: Any, radii: Optional[Any] = None, probe: float = 1.4, *, kind: Kind = "ses", device: Device = "cpu",
            threads: int = 0, verify: bool = False) -> Surface:
    """The surface of a Structure that read() gave, or of atoms at xyz, (n, 3) Å, with van der Waals radii, (n,) or one
    for all. What carries a unit, of OpenMM, pint, astropy or unyt, is converted; a warning tells where positions look
    like nanometres.

    kind: "ses", solvent-excluded; "sas", solvent-accessible; "vdw", without a probe. device: "cpu"; "gpu"; "auto", a
    hardware GPU if one works, else the CPU; "software", GL on the CPU. threads: of the CPU, 0 for all. verify: compute
    on the other device, too, and compare everything.

    >>> round(meniscus.surface([[0, 0, 0], [3, 0, 0]], [1.7, 1.52], probe=1.4).area, 2)
    60.71
    >>> meniscus.surface(meniscus.read("helix.pdb"), kind="sas")
    <meniscus.Surface: sas of 64 atoms, 1721.07 Å², 3726.61 Å³, 1 components>
    >>> meniscus.surface([[0, 0, 0]], -1.7)
    Traceback (most recent call last):
        ...
    meniscus.InputError: the radius of atom 0 is -1.7 Å; it has to be above 0, or leave the atom out"""
    if isinstance(xyz, Structure):
        return Surface(xyz.positions, xyz.radii if radii is None else radii, probe, kind, device, threads, verify)
    if isinstance(xyz, (str, bytes, os.PathLike)):
        raise InputError(f"{xyz!r} is a path; meniscus.read() reads molecules: surface(meniscus.read(path))")
    if radii is None:
        raise InputError("radii are missing; give one for each atom, or one for all (radii_of() has those of elements)")
    return Surface(xyz, radii, probe, kind, device, threads, verify)
