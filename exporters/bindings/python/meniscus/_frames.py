# SPDX-License-Identifier: BSD-3-Clause
"""Computes the surfaces of all frames of a run: of another package's trajectory, of a file with models, or of poses."""
from __future__ import annotations

import copy
import importlib
import os
from typing import TYPE_CHECKING, Any, Iterator, Optional

import numpy as np

from ._computed import surface
from ._errors import InputError, wrong_type
from ._messages import about_file
from ._molecule_file import is_content
from ._packages import first_of
from ._read import models_of
from ._sources import TAKEN_BY, Source, opened, package_of
from ._structure import Structure
from ._surface import Surface
from ._types import Rows

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._types import SurfaceOptions


def _surfaces(source: Source, radii: Optional[Any], options: SurfaceOptions) -> Iterator[Surface]:
    """Yields a new surface for each frame of the source. radii: None for those of the elements."""
    last = surface(first_of(source, radii), **options)
    yield last
    for positions in source.frames:
        last = copy.copy(last).update(positions)
        yield last


def _of_models(models: list[Structure], radii: Optional[Any], options: SurfaceOptions) -> Iterator[Surface]:
    """Yields the surface of each molecule. Those with the radii of the one before share its computer."""
    last = None
    for model in models:
        wanted = model.radii if radii is None else radii
        if last is None or len(last) != len(model):
            last = surface(model, wanted, **options)
        else:
            last = copy.copy(last).update(model.positions, wanted)
            last._structure = model
        yield last


def _of_molecules(molecules: Any, radii: Optional[Any], options: SurfaceOptions) -> Iterator[Surface]:
    """Yields the surface of each conformer of each molecule of RDKit, which may have different atoms."""
    for n, molecule in enumerate(molecules):
        if molecule is None:
            raise InputError(f"molecule {n} is None; RDKit could not read it")
        yield from _surfaces(opened(molecule, "rdkit", True), radii, options)


def _of_run(path: Any, topology: Any, radii: Optional[Any], options: SurfaceOptions) -> Iterator[Surface]:
    """Yields the surface of each frame of a trajectory file, which MDAnalysis reads: that of the atoms that read() would
    use."""
    try:
        analysis: Any = importlib.import_module("MDAnalysis")
    except ImportError as error:
        raise ImportError(f"frames() of a trajectory with a topology needs MDAnalysis ({error}): python -m pip install "
                          "MDAnalysis") from error
    for name, file in (("source", path), ("topology", topology)):
        if not os.path.exists(file):
            raise about_file(InputError, f"{name}: {os.fsdecode(file)}: No such file or directory", os.fsdecode(file))
    universe = analysis.Universe(os.fspath(topology), os.fspath(path))
    rows, part = first_of(opened(universe, "MDAnalysis", True), 1.0)._usual()
    last: Any = None
    for _ in universe.trajectory:
        positions = universe.atoms.positions[rows]
        last = (surface(part._moved(positions), radii, **options) if last is None else
                copy.copy(last).update(positions))
        yield last


def frames(source: Any, *, topology: Any = None, radii: Optional[Any] = None,
           **options: Unpack[SurfaceOptions]) -> Iterator[Surface]:
    """Yields the surface of each frame of a source: the frames of a trajectory, the models of a structure or the
    conformers of a molecule that a from_...() function takes; a list of ase.Atoms; a list or an SDMolSupplier of
    molecules of RDKit; or the models of a file that read() reads, such as the poses of an SDF file. The surfaces are
    independent of each other, and each has its `structure`.

    topology: the path of a topology, if source is that of a trajectory such as "run.xtc". Then MDAnalysis reads both,
    and the atoms are those that read() would use. radii: van der Waals radii in Å, (n,) or one for all atoms; None for
    those of the elements. options: those of surface(). Raises InputError for other sources, and the errors of read(),
    surface() and the from_...() functions.

    >>> [round(s.area, 2) for s in meniscus.frames("models.pdb", kind="vdw")]
    [1796.57, 1972.7]
    >>> import Bio.PDB
    >>> structure = Bio.PDB.PDBParser().get_structure("two", "models.pdb")
    >>> [round(s.area, 2) for s in meniscus.frames(structure, kind="vdw")]
    [1796.57, 1972.7]"""
    if topology is not None:
        return _of_run(source, topology, radii, options)
    if isinstance(source, (str, bytes, os.PathLike)) or is_content(source):
        return _of_models(models_of(source), radii, options)
    package = package_of(source)
    if not package:
        raise wrong_type(f"a {type(source).__module__}.{type(source).__qualname__} has no frames that can be read; "
                         f"supported are files, and molecules of {', '.join(TAKEN_BY)}")
    if package == "rdkit" and hasattr(source, "__getitem__"):
        return _of_molecules(source, radii, options)
    return _surfaces(opened(source, package, True), radii, options)


def series(source: Any, *, topology: Any = None, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Rows:
    """Returns a structured array with a row for each frame of what frames() takes: area (Å²), volume (Å³), components,
    cavities, cavity_area (Å²) and cavity_volume (Å³, positive); for kind "ses" also sas_area (Å²). pandas.DataFrame()
    takes it. Only one surface is in memory at a time. Errors are those of frames().

    >>> meniscus.series("models.pdb")["area"].round(2).tolist()
    [1508.98, 1867.1]"""
    rows = []
    for s in frames(source, topology=topology, radii=radii, **options):
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
