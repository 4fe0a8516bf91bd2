# SPDX-License-Identifier: BSD-3-Clause
"""The patches of a surface, and its pockets, tunnels and cavities."""
from __future__ import annotations

import ctypes
from typing import NamedTuple

import numpy as np

from . import _header as header
from . import _library as lib
from ._arguments import AnyArray, Floats, Indices, PocketKind, Rows, number
from ._arrays import view


class Patches(NamedTuple):
    """The analytic patches of a surface. convex, toroidal, concave and planes are structured arrays, whose rows
    meniscus.h describes; contacts and cuts are arrays of indices, (k,), to which these rows refer.

    >>> patches = meniscus.surface([[0, 0, 0], [3, 0, 0]], 1.7).patches
    >>> len(patches.convex), len(patches.toroidal), len(patches.concave)
    (2, 1, 0)
    >>> patches.toroidal["atom"].tolist()
    [[0, 1]]
    >>> patches
    <meniscus.Patches: 2 convex, 1 toroidal, 0 concave>"""
    convex: Rows
    toroidal: Rows
    concave: Rows
    planes: Rows
    contacts: Indices
    cuts: Indices

    def __repr__(self) -> str:
        return (f"<meniscus.Patches: {len(self.convex)} convex, {len(self.toroidal)} toroidal, {len(self.concave)} "
                "concave>")


class Pocket(NamedTuple):
    """A pocket, tunnel or cavity: a connected space that the probe can fill inside the surface of a large probe. Arrays
    are read-only.

    volume: Å³. volume_excess: Å³; to first order, the volume is too large by at most this, because mouths lie slightly
    outside. area: Å² of the whole boundary. mouth_areas: Å², (k,), in descending order.
    depth: Å; the distance of the deepest fixed probe from the large probe's surface.
    middle: the mean of the centres of fixed probes in Å, (3,).
    atoms: the indices of the atoms that the probe can touch in the pocket, (k,), in ascending order.
    probes: the centres in Å of fixed probes, which touch three atoms or more, (k, 3).

    >>> pocket = meniscus.surface(meniscus.read("helix.pdb")).pockets()[0]
    >>> round(pocket.volume, 2), round(pocket.depth, 2), len(pocket.atoms)
    (317.02, 3.35, 60)
    >>> pocket
    <meniscus.Pocket: cavity of 317.02 Å³, 3.35 Å deep, 60 atoms>"""
    volume: float
    volume_excess: float
    area: float
    mouth_areas: Floats
    depth: float
    middle: Floats
    atoms: Indices
    probes: Floats

    @property
    def kind(self) -> PocketKind:
        """The kind: "cavity" without a mouth, "pocket" with one, and "tunnel" with more.

        >>> pocket.kind
        'cavity'"""
        kinds: tuple[PocketKind, PocketKind, PocketKind] = ("cavity", "pocket", "tunnel")
        return kinds[min(len(self.mouth_areas), 2)]

    @property
    def wall_area(self) -> float:
        """The area of the boundary in Å², without the mouths.

        >>> round(pocket.wall_area, 2)
        386.13"""
        return self.area - float(self.mouth_areas.sum())

    def __repr__(self) -> str:
        return (f"<meniscus.Pocket: {self.kind} of {self.volume:.2f} Å³, {self.depth:.2f} Å deep, {len(self.atoms)} atom"
                f"{'s' * (len(self.atoms) != 1)}>")


def pockets_of(surface: lib.Handle, large_probe: float, trim: float, min_volume: float,
               mouth_tolerance: float) -> list[Pocket]:
    """Returns the pockets of a surface. Parameters and errors are those of Surface.pockets()."""
    options = lib.default("pocket_options", header.PocketOptions())
    options.large_probe_radius, options.trim = number("large_probe", large_probe), trim
    options.min_volume, options.mouth_tolerance = min_volume, mouth_tolerance
    handle = lib.Handle("pockets", "surface_pockets", surface.pointer, ctypes.byref(options))
    rows, mouths, atoms, probes = (
        view(handle, "pockets_table", table, row, columns)
        for table, row, columns in ((header.POCKETS, header.Pocket, 0), (header.POCKET_MOUTHS, np.float64, 0),
                                    (header.POCKET_ATOMS, np.uint32, 0), (header.POCKET_PROBES, np.float64, 3)))

    def part(all_rows: AnyArray, first: int, count: int) -> AnyArray:
        return all_rows[first:first + count]

    return [Pocket(float(row["volume"]), float(row["volume_excess"]), float(row["area"]),
                   part(mouths, row["first_mouth"], row["mouth_count"]), float(row["depth"]), row["middle"],
                   part(atoms, row["first_atom"], row["atom_count"]),
                   part(probes, row["first_probe"], row["probe_count"])) for row in rows]
