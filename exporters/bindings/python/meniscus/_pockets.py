# SPDX-License-Identifier: BSD-3-Clause
"""Pockets, tunnels and cavities between the atoms of a surface."""
from __future__ import annotations

import ctypes
from typing import NamedTuple

import numpy as np

from . import _header as header
from . import _library as lib
from ._arrays import view
from ._types import AnyArray, Floats, Indices, PocketKind


class Pocket(NamedTuple):
    """One connected part of what the probe can fill of the solid that a large one rolls over. Arrays are read-only.

    volume: Å³. volume_excess: Å³ by which that is too large at most, to first order, for mouths lie outside.
    area: Å² of its whole border. mouth_areas: (n,) Å², the largest first.
    depth: Å, of the deepest probe at rest below the large probe's surface.
    middle: (3,) Å, the mean of the probes at rest.
    atoms: (n,) those that line it, which the probe in it can touch; ascending.
    probes: (n, 3) Å, centres of the probe at rest in it, where it touches three atoms or more.

    >>> pocket = meniscus.surface(meniscus.read("helix.pdb")).pockets()[0]
    >>> round(pocket.volume, 2), round(pocket.depth, 2), len(pocket.atoms)
    (317.02, 3.35, 60)"""
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
        """"cavity" without a mouth, "pocket" with one, "tunnel" with more.

        >>> pocket.kind
        'cavity'"""
        kinds: tuple[PocketKind, PocketKind, PocketKind] = ("cavity", "pocket", "tunnel")
        return kinds[min(len(self.mouth_areas), 2)]

    @property
    def wall_area(self) -> float:
        """Å² of its border that is not one of its mouths.

        >>> round(pocket.wall_area, 2)
        386.13"""
        return self.area - float(self.mouth_areas.sum())


def pockets_of(surface: lib.Handle, large_probe: float, trim: float, min_volume: float,
               mouth_tolerance: float) -> list[Pocket]:
    options = lib.default("pocket_options", header.PocketOptions())
    options.large_probe_radius, options.trim = large_probe, trim
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
