# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces of molecules of other packages, of one frame or of all."""
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


def _elements(found: Any, count: int) -> Any:
    if found is None or len(found) != count or any(not str(symbol).strip() for symbol in found):
        raise InputError("some atoms have no element; give radii")
    return found


def _surfaces(source: Source, radii: Optional[Any], options: SurfaceOptions) -> Iterator[Surface]:
    made = None
    for positions in source.frames:
        if positions is None:
            raise InputError("the atoms have no positions")
        if made is None:
            if radii is None:
                radii = radii_of(_elements(source.elements, len(positions)))
            made = surface(positions, radii, **options)
        else:
            made = copy.copy(made).update(positions)
        yield made


def _first(thing: Any, package: str, radii: Optional[Any], options: SurfaceOptions) -> Surface:
    if package_of(thing) != package:
        kind = f"{type(thing).__module__}.{type(thing).__qualname__}"
        raise InputError(f"{TAKEN_BY[package]}() does not take a {kind}")
    return next(_surfaces(opened(thing, package, False), radii, options))


def from_mdanalysis(atoms: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Surface:
    """The surface of an AtomGroup or Universe in its current frame. radii: by element, unless given. options: as
    surface() has them. For the next frame: s.update(atoms.positions). InputError where an atom has no element.

    >>> import MDAnalysis
    >>> universe = MDAnalysis.Universe("helix.pdb")
    >>> meniscus.from_mdanalysis(universe.select_atoms("protein"))
    <meniscus.Surface: ses of 64 atoms, 1508.98 Å², 1465.44 Å³, 1 components>"""
    return _first(atoms, "MDAnalysis", radii, options)


def from_mdtraj(trajectory: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Surface:
    """The surface of the first frame of an mdtraj.Trajectory: trajectory[7] is the eighth. Its nm become Å.

    >>> import mdtraj
    >>> trajectory = mdtraj.load("helix.pdb")
    >>> meniscus.from_mdtraj(trajectory.atom_slice(trajectory.top.select("not water")))
    <meniscus.Surface: ses of 64 atoms, 1508.98 Å², 1465.44 Å³, 1 components>"""
    return _first(trajectory, "mdtraj", radii, options)


def from_prody(atoms: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Surface:
    """The surface of an AtomGroup or Selection with its active coordinates.

    >>> import prody
    >>> meniscus.from_prody(prody.parsePDB("helix.pdb").select("not water"))
    <meniscus.Surface: ses of 64 atoms, 1508.98 Å², 1465.44 Å³, 1 components>"""
    return _first(atoms, "prody", radii, options)


def from_biotite(array: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Surface:
    """The surface of an AtomArray, or of the first model of an AtomArrayStack.

    >>> import biotite.structure.io.pdb
    >>> array = biotite.structure.io.pdb.PDBFile.read("helix.pdb").get_structure(model=1)
    >>> meniscus.from_biotite(array[array.res_name != "HOH"])
    <meniscus.Surface: ses of 64 atoms, 1508.98 Å², 1465.44 Å³, 1 components>"""
    return _first(array, "biotite", radii, options)


def from_biopython(entity: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Surface:
    """The surface of the first model of a Bio.PDB Structure, of a Model, Chain or Residue, or of a list of atoms, in the
    order of get_atoms(). Of alternate locations the selected one counts.

    >>> import Bio.PDB
    >>> structure = Bio.PDB.PDBParser().get_structure("helix", "helix.pdb")
    >>> meniscus.from_biopython([atom for atom in structure.get_atoms() if atom.parent.id[0] != "W"])
    <meniscus.Surface: ses of 64 atoms, 1508.98 Å², 1465.44 Å³, 1 components>"""
    return _first(entity, "Bio", radii, options)


def from_ase(atoms: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Surface:
    """The surface of an ase.Atoms, or of the first of a list or trajectory of them; periodic copies are left out.

    >>> import ase.build
    >>> meniscus.from_ase(ase.build.molecule("CH3CH2OH"))
    <meniscus.Surface: ses of 9 atoms, 78.82 Å², 55.73 Å³, 1 components>"""
    return _first(atoms, "ase", radii, options)


def from_rdkit(molecule: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Surface:
    """The surface of the first conformer of a Mol, or of a Conformer: mol.GetConformer(7). Hydrogens count where they are
    atoms of the molecule (rdkit.Chem.AddHs). InputError where there is no conformer, or only a drawing in two
    dimensions.

    >>> from rdkit import Chem
    >>> molecule = Chem.MolFromPDBFile("helix.pdb", sanitize=False)
    >>> meniscus.from_rdkit(molecule)
    <meniscus.Surface: ses of 65 atoms, 1538.01 Å², 1480.15 Å³, 2 components>"""
    return _first(molecule, "rdkit", radii, options)


def from_openmm(source: Any, positions: Optional[Any] = None, *, radii: Optional[Any] = None,
                **options: Unpack[SurfaceOptions]) -> Surface:
    """The surface of a PDBFile, PDBxFile or Modeller, of a Simulation as it is now, or of a Topology with positions that
    have a unit.

    >>> import openmm.app
    >>> file = openmm.app.PDBFile("helix.pdb")
    >>> modeller = openmm.app.Modeller(file.topology, file.positions)
    >>> modeller.deleteWater()
    >>> meniscus.from_openmm(modeller)
    <meniscus.Surface: ses of 64 atoms, 1508.98 Å², 1465.44 Å³, 1 components>"""
    return _first(source if positions is None else (source, positions), "openmm", radii, options)


def from_gemmi(part: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Surface:
    """The surface of the first model of a gemmi.Structure, of a Model, Chain, Residue or span of residues, in the order of
    Model.all(). A warning says where alternate locations all count: remove_alternative_conformations().

    >>> import gemmi
    >>> structure = gemmi.read_structure("helix.pdb")
    >>> structure.remove_waters()
    >>> meniscus.from_gemmi(structure)
    <meniscus.Surface: ses of 64 atoms, 1508.98 Å², 1465.44 Å³, 1 components>"""
    return _first(part, "gemmi", radii, options)


def series(source: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Rows:
    """The numbers of all frames of what frames() takes, a row each: area (Å²), of kind "ses" also sas_area, volume
    (Å³), components, cavities, cavity_area, cavity_volume (positive). One surface is in memory at a time.

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
    """One surface after the other for all frames of what the functions above take: frames of trajectories, models of
    structures, conformers of molecules, a list of ase.Atoms. Each may be kept.

    >>> import Bio.PDB
    >>> structure = Bio.PDB.PDBParser().get_structure("two", "models.pdb")
    >>> [round(s.area, 2) for s in meniscus.frames(structure, kind="vdw")]
    [1796.57, 1972.7]"""
    package = package_of(source)
    if not package:
        raise InputError(f"a {type(source).__module__}.{type(source).__qualname__} has no frames that can be read; "
                         f"supported are those of {', '.join(TAKEN_BY)}")
    return _surfaces(opened(source, package, True), radii, options)
