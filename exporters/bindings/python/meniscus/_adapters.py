# SPDX-License-Identifier: BSD-3-Clause
"""Atoms and frames as MDAnalysis, MDTraj, ProDy and Biotite have them; none of these is imported here."""
from __future__ import annotations

import copy
from typing import Any, Iterator, NamedTuple, Optional

import numpy as np

from ._errors import InputError
from ._radii import radii_of
from ._surface import Surface, surface
from ._types import AnyArray, Rows


class _Source(NamedTuple):
    elements: Any                  # symbols, one per atom
    frames: Iterator[AnyArray]     # positions in Å, the frame at hand first


def _elements(found: Any, count: int) -> Any:
    if found is None or len(found) != count or any(not str(symbol).strip() for symbol in found):
        raise InputError("some atoms have no element; give radii")
    return found


def _mdanalysis(atoms: Any, every: bool) -> _Source:
    atoms = atoms.atoms
    try:
        elements = atoms.elements
    except AttributeError:  # MDAnalysis.NoDataError is one
        elements = None
    if every:
        return _Source(elements, (atoms.positions for _ in atoms.universe.trajectory))
    return _Source(elements, iter([atoms.positions]))


def _mdtraj(trajectory: Any, every: bool) -> _Source:
    elements = [atom.element.symbol if atom.element else "" for atom in trajectory.topology.atoms]
    frames = trajectory.xyz if every else trajectory.xyz[:1]
    return _Source(elements, (np.multiply(frame, 10.0, dtype=np.float64) for frame in frames))  # nm


def _prody(atoms: Any, every: bool) -> _Source:
    return _Source(atoms.getElements(), atoms.iterCoordsets() if every else iter([atoms.getCoords()]))


def _biotite(array: Any, every: bool) -> _Source:
    coordinates = array.coord if array.coord.ndim == 3 else array.coord[np.newaxis]
    return _Source(array.element, iter(coordinates if every else coordinates[:1]))


_READERS = {"MDAnalysis": _mdanalysis, "mdtraj": _mdtraj, "prody": _prody, "biotite": _biotite}


def _surfaces(source: _Source, radii: Optional[Any], options: dict[str, Any]) -> Iterator[Surface]:
    made = None
    for positions in source.frames:
        if made is None:
            if radii is None:
                radii = radii_of(_elements(source.elements, len(positions)))
            made = surface(positions, radii, **options)
        else:
            made = copy.copy(made).update(positions)
        yield made


def _first(source: _Source, radii: Optional[Any], options: dict[str, Any]) -> Surface:
    return next(_surfaces(source, radii, options))


def from_mdanalysis(atoms: Any, *, radii: Optional[Any] = None, **options: Any) -> Surface:
    """Of an AtomGroup or Universe in its current frame. radii: by element, unless given. options: as surface() has
    them. For the next frame: s.update(atoms.positions)."""
    return _first(_mdanalysis(atoms, False), radii, options)


def from_mdtraj(trajectory: Any, *, radii: Optional[Any] = None, **options: Any) -> Surface:
    """Of the first frame of an mdtraj.Trajectory: trajectory[7] is the eighth."""
    return _first(_mdtraj(trajectory, False), radii, options)


def from_prody(atoms: Any, *, radii: Optional[Any] = None, **options: Any) -> Surface:
    """Of an AtomGroup or Selection with its active coordinates."""
    return _first(_prody(atoms, False), radii, options)


def from_biotite(array: Any, *, radii: Optional[Any] = None, **options: Any) -> Surface:
    """Of an AtomArray, or of the first model of an AtomArrayStack."""
    return _first(_biotite(array, False), radii, options)


def series(source: Any, *, radii: Optional[Any] = None, **options: Any) -> Rows:
    """The numbers of all frames of what frames() takes, a row each: area (Å²), of kind "ses" also sas_area, volume
    (Å³), components, cavities, cavity_area, cavity_volume (positive). One surface is in memory at a time."""
    rows = []
    for s in frames(source, radii=radii, **options):
        parts = s.components
        cavities = parts[parts["kind"] == 1]
        row = {"area": s.area, "volume": s.volume, "components": len(parts), "cavities": len(cavities),
               "cavity_area": cavities["area"].sum(), "cavity_volume": -cavities["volume"].sum()}
        if s.kind == "ses":
            row["sas_area"] = s.atom_sas_areas.sum()
        rows.append(row)
    names = list(rows[0]) if rows else ["area", "volume", "components", "cavities", "cavity_area", "cavity_volume"]
    kinds = [(name, np.int64 if name in ("components", "cavities") else np.float64) for name in names]
    return np.array([tuple(row.values()) for row in rows], dtype=kinds)


def frames(source: Any, *, radii: Optional[Any] = None, **options: Any) -> Iterator[Surface]:
    """One surface after the other for all frames of what the functions above take; each may be kept."""
    for kind in type(source).__mro__:
        reader = _READERS.get(kind.__module__.split(".")[0])
        if reader:
            return _surfaces(reader(source, True), radii, options)
    raise InputError(f"a {type(source).__module__}.{type(source).__qualname__} is nothing that frames can be taken "
                     f"of; known are those of {', '.join(_READERS)}")
