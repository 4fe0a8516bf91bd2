# SPDX-License-Identifier: BSD-3-Clause
"""Computes surfaces of the molecules of other packages, for one frame or for all frames."""
from __future__ import annotations

import copy
from typing import TYPE_CHECKING, Any, Iterator, Optional

import numpy as np

from ._errors import InputError
from ._sources import TAKEN_BY, Source, opened, package_of
from ._structure import radii_of
from ._surface import Surface, surface
from ._types import Rows

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._types import SurfaceOptions


def _checked_elements(elements: Any, count: int) -> Any:
    """Returns the elements. Raises InputError unless each of `count` atoms has one."""
    if elements is None or len(elements) != count or any(not str(symbol).strip() for symbol in elements):
        raise InputError("some atoms have no element; give radii")
    return elements


def _surfaces(source: Source, radii: Optional[Any], options: SurfaceOptions) -> Iterator[Surface]:
    """Yields a new surface for each frame of the source. radii: None for those of the elements."""
    last = None
    for positions in source.frames:
        if positions is None:
            raise InputError("the atoms have no positions")
        if last is None:
            if radii is None:
                radii = radii_of(_checked_elements(source.elements, len(positions)))
            last = surface(positions, radii, **options)
        else:
            last = copy.copy(last).update(positions)
        yield last


def _first(molecule: Any, package: str, radii: Optional[Any], options: SurfaceOptions) -> Surface:
    """Returns the surface of the current or first frame. Raises InputError for an object of another package."""
    if package_of(molecule) != package:
        kind = f"{type(molecule).__module__}.{type(molecule).__qualname__}"
        raise InputError(f"{TAKEN_BY[package]}() does not take a {kind}")
    return next(_surfaces(opened(molecule, package, False), radii, options))


def from_mdanalysis(atoms: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Surface:
    """Returns the surface of an AtomGroup or Universe in its current frame. s.update(atoms.positions) computes another
    frame.

    radii: van der Waals radii in Å, (n,) or one for all atoms; None for those of the elements. options: those of
    surface(). Raises InputError if radii is None and an atom has no element; otherwise the errors of surface(). The
    functions below have the same parameters and errors.

    >>> import MDAnalysis
    >>> universe = MDAnalysis.Universe("helix.pdb")
    >>> meniscus.from_mdanalysis(universe.select_atoms("protein"))
    <meniscus.Surface: ses of 64 atoms, 1508.98 Å², 1465.44 Å³, 1 components>"""
    return _first(atoms, "MDAnalysis", radii, options)


def from_mdtraj(trajectory: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Surface:
    """Returns the surface of the first frame of an mdtraj.Trajectory, whose positions are converted from nm to Å. Pass
    trajectory[7] for the eighth frame.

    >>> import mdtraj
    >>> trajectory = mdtraj.load("helix.pdb")
    >>> meniscus.from_mdtraj(trajectory.atom_slice(trajectory.top.select("not water")))
    <meniscus.Surface: ses of 64 atoms, 1508.98 Å², 1465.44 Å³, 1 components>"""
    return _first(trajectory, "mdtraj", radii, options)


def from_prody(atoms: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Surface:
    """Returns the surface of an AtomGroup or Selection with its active coordinate set.

    >>> import prody
    >>> meniscus.from_prody(prody.parsePDB("helix.pdb").select("not water"))
    <meniscus.Surface: ses of 64 atoms, 1508.98 Å², 1465.44 Å³, 1 components>"""
    return _first(atoms, "prody", radii, options)


def from_biotite(array: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Surface:
    """Returns the surface of an AtomArray, or of the first model of an AtomArrayStack.

    >>> import biotite.structure.io.pdb
    >>> array = biotite.structure.io.pdb.PDBFile.read("helix.pdb").get_structure(model=1)
    >>> meniscus.from_biotite(array[array.res_name != "HOH"])
    <meniscus.Surface: ses of 64 atoms, 1508.98 Å², 1465.44 Å³, 1 components>"""
    return _first(array, "biotite", radii, options)


def from_biopython(entity: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Surface:
    """Returns the surface of the first model of a Bio.PDB Structure, of a Model, Chain or Residue, or of a list of
    atoms. The atoms are in the order of get_atoms(), and have their selected alternate location.

    >>> import Bio.PDB
    >>> structure = Bio.PDB.PDBParser().get_structure("helix", "helix.pdb")
    >>> meniscus.from_biopython([atom for atom in structure.get_atoms() if atom.parent.id[0] != "W"])
    <meniscus.Surface: ses of 64 atoms, 1508.98 Å², 1465.44 Å³, 1 components>"""
    return _first(entity, "Bio", radii, options)


def from_ase(atoms: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Surface:
    """Returns the surface of an ase.Atoms, or of the first one in a list or trajectory. Periodic images are ignored.

    >>> import ase.build
    >>> meniscus.from_ase(ase.build.molecule("CH3CH2OH"))
    <meniscus.Surface: ses of 9 atoms, 78.82 Å², 55.73 Å³, 1 components>"""
    return _first(atoms, "ase", radii, options)


def from_rdkit(molecule: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Surface:
    """Returns the surface of the first conformer of a Mol, or of a Conformer such as mol.GetConformer(7). Hydrogens are
    included if they are atoms of the molecule (rdkit.Chem.AddHs). Raises InputError also if there is no conformer, or
    only a two-dimensional one.

    >>> from rdkit import Chem
    >>> molecule = Chem.MolFromPDBFile("helix.pdb", sanitize=False)
    >>> meniscus.from_rdkit(molecule)
    <meniscus.Surface: ses of 65 atoms, 1538.01 Å², 1480.15 Å³, 2 components>"""
    return _first(molecule, "rdkit", radii, options)


def from_openmm(source: Any, positions: Optional[Any] = None, *, radii: Optional[Any] = None,
                **options: Unpack[SurfaceOptions]) -> Surface:
    """Returns the surface of a PDBFile, PDBxFile or Modeller, of the current state of a Simulation, or of a Topology
    and its positions, (n, 3), which must have a unit.

    >>> import openmm.app
    >>> file = openmm.app.PDBFile("helix.pdb")
    >>> modeller = openmm.app.Modeller(file.topology, file.positions)
    >>> modeller.deleteWater()
    >>> meniscus.from_openmm(modeller)
    <meniscus.Surface: ses of 64 atoms, 1508.98 Å², 1465.44 Å³, 1 components>"""
    return _first(source if positions is None else (source, positions), "openmm", radii, options)


def from_gemmi(part: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Surface:
    """Returns the surface of the first model of a gemmi.Structure, or of a Model, Chain, Residue or span of residues.
    The atoms are in the order of Model.all(). All alternate locations are included, with a warning;
    remove_alternative_conformations() removes them.

    >>> import gemmi
    >>> structure = gemmi.read_structure("helix.pdb")
    >>> structure.remove_waters()
    >>> meniscus.from_gemmi(structure)
    <meniscus.Surface: ses of 64 atoms, 1508.98 Å², 1465.44 Å³, 1 components>"""
    return _first(part, "gemmi", radii, options)


def series(source: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Rows:
    """Returns a structured array with a row for each frame of what frames() takes: area (Å²), volume (Å³), components,
    cavities, cavity_area (Å²) and cavity_volume (Å³, positive); for kind "ses" also sas_area (Å²). Only one surface is
    in memory at a time. Errors are those of frames().

    >>> import Bio.PDB
    >>> structure = Bio.PDB.PDBParser().get_structure("two", "models.pdb")
    >>> meniscus.series(structure)["area"].round(2).tolist()
    [1508.98, 1867.1]"""
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


def frames(source: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Iterator[Surface]:
    """Yields the surface of each frame of what the functions above take: frames of trajectories, models of structures,
    conformers of molecules, or a list of ase.Atoms. The surfaces are independent of each other. Errors are those of the
    functions above.

    >>> import Bio.PDB
    >>> structure = Bio.PDB.PDBParser().get_structure("two", "models.pdb")
    >>> [round(s.area, 2) for s in meniscus.frames(structure, kind="vdw")]
    [1796.57, 1972.7]"""
    package = package_of(source)
    if not package:
        raise InputError(f"a {type(source).__module__}.{type(source).__qualname__} has no frames that can be read; "
                         f"supported are those of {', '.join(TAKEN_BY)}")
    return _surfaces(opened(source, package, True), radii, options)
