# SPDX-License-Identifier: BSD-3-Clause
"""Makes a Structure of a molecule of another package."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional

from ._computed import surface
from ._errors import warn, wrong_type
from ._read import structure_of
from ._sources import TAKEN_BY, package_of
from ._structure import Structure
from ._surface import Surface

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._arguments import SurfaceOptions


class _Taken(Structure):
    """A Structure that has the attributes of a Surface, too, which the functions below returned before."""

    __slots__ = ("_options", "_surface")

    _options: SurfaceOptions
    _surface: Optional[Surface]

    if not TYPE_CHECKING:
        def __getattr__(self, name: str) -> Any:
            if name.startswith("_") or not hasattr(Surface, name):
                raise AttributeError(f"a Structure has no {name!r}")
            warn(f"the from_...() functions return a Structure; {name} is of meniscus.surface(structure)",
                 DeprecationWarning)
            if self._surface is None:
                self._surface = surface(self, **self._options)
            return getattr(self._surface, name)


def _first(molecule: Any, package: str, radii: Optional[Any], options: SurfaceOptions) -> Structure:
    """Returns the molecule in the current or first frame. Raises InputError for an object of another package."""
    if package_of(molecule) != package:
        kind = f"{type(molecule).__module__}.{type(molecule).__qualname__}"
        raise wrong_type(f"{TAKEN_BY[package]}() does not take a {kind}")
    structure = structure_of(molecule, radii)
    if options:
        warn(f"{TAKEN_BY[package]}() returns a Structure: {', '.join(options)} belongs to meniscus.surface()",
             FutureWarning)
    taken = _Taken._of(structure._report, len(structure), structure._columns)
    assert isinstance(taken, _Taken)
    taken._options, taken._surface = options, None
    return taken


def from_mdanalysis(atoms: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Structure:
    """Returns the atoms of an AtomGroup or Universe in its current frame, for surface(). Elements that the topology
    does not have are guessed from the names, as read() does, with a UserWarning.

    radii: van der Waals radii in Å, (n,) or one for all atoms; None for those of the elements. options: those of
    surface(), which belong there (deprecated here). Raises InputError if radii is None and the element of an atom is
    unknown. The functions below have the same parameters and errors.

    >>> import MDAnalysis
    >>> universe = MDAnalysis.Universe("helix.pdb")
    >>> meniscus.from_mdanalysis(universe.select_atoms("protein"))
    <meniscus.Structure: 64 atoms of helix.pdb>
    >>> meniscus.surface(universe.select_atoms("protein"))
    <meniscus.Surface: ses of 64 atoms, 1508.98 Å², 1465.44 Å³, 1 component>"""
    return _first(atoms, "MDAnalysis", radii, options)


def from_mdtraj(trajectory: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Structure:
    """Returns the atoms of the first frame of an mdtraj.Trajectory, whose positions are converted from nm to Å. Pass
    trajectory[7] for the eighth frame.

    >>> import mdtraj
    >>> trajectory = mdtraj.load("helix.pdb")
    >>> meniscus.from_mdtraj(trajectory.atom_slice(trajectory.top.select("not water")))
    <meniscus.Structure: 64 atoms>"""
    return _first(trajectory, "mdtraj", radii, options)


def from_prody(atoms: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Structure:
    """Returns the atoms of an AtomGroup or Selection with its active coordinate set.

    >>> import prody
    >>> meniscus.from_prody(prody.parsePDB("helix.pdb").select("not water"))
    <meniscus.Structure: 64 atoms>"""
    return _first(atoms, "prody", radii, options)


def from_biotite(array: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Structure:
    """Returns the atoms of an AtomArray, or of the first model of an AtomArrayStack.

    >>> import biotite.structure.io.pdb
    >>> array = biotite.structure.io.pdb.PDBFile.read("helix.pdb").get_structure(model=1)
    >>> meniscus.from_biotite(array[array.res_name != "HOH"])
    <meniscus.Structure: 64 atoms>"""
    return _first(array, "biotite", radii, options)


def from_biopython(entity: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Structure:
    """Returns the atoms of the first model of a Bio.PDB Structure, of a Model, Chain or Residue, or of a list of
    atoms. The atoms are in the order of get_atoms(), and have their selected alternate location.

    >>> import Bio.PDB
    >>> structure = Bio.PDB.PDBParser().get_structure("helix", "helix.pdb")
    >>> meniscus.from_biopython([atom for atom in structure.get_atoms() if atom.parent.id[0] != "W"])
    <meniscus.Structure: 64 atoms>"""
    return _first(entity, "Bio", radii, options)


def from_ase(atoms: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Structure:
    """Returns the atoms of an ase.Atoms, or of the first one in a list or trajectory. Periodic images are ignored.

    >>> import ase.build
    >>> meniscus.from_ase(ase.build.molecule("CH3CH2OH"))
    <meniscus.Structure: 9 atoms>"""
    return _first(atoms, "ase", radii, options)


def from_rdkit(molecule: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Structure:
    """Returns the atoms of the first conformer of a Mol, or of a Conformer such as mol.GetConformer(7). Hydrogens are
    included if they are atoms of the molecule (rdkit.Chem.AddHs). Raises InputError also if there is no conformer, or
    only a two-dimensional one.

    >>> from rdkit import Chem
    >>> molecule = Chem.MolFromPDBFile("helix.pdb", sanitize=False)
    >>> meniscus.from_rdkit(molecule)
    <meniscus.Structure: 65 atoms>"""
    return _first(molecule, "rdkit", radii, options)


def from_openmm(source: Any, positions: Optional[Any] = None, *, radii: Optional[Any] = None,
                **options: Unpack[SurfaceOptions]) -> Structure:
    """Returns the atoms of a PDBFile, PDBxFile or Modeller, of the current state of a Simulation, or of a Topology
    and its positions, (n, 3), which must have a unit.

    >>> import openmm.app
    >>> file = openmm.app.PDBFile("helix.pdb")
    >>> modeller = openmm.app.Modeller(file.topology, file.positions)
    >>> modeller.deleteWater()
    >>> meniscus.from_openmm(modeller)
    <meniscus.Structure: 64 atoms>"""
    return _first(source if positions is None else (source, positions), "openmm", radii, options)


def from_gemmi(part: Any, *, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Structure:
    """Returns the atoms of the first model of a gemmi.Structure, or of a Model, Chain, Residue or span of residues.
    The atoms are in the order of Model.all(). All alternate locations are included, with a warning;
    remove_alternative_conformations() removes them.

    >>> import gemmi
    >>> structure = gemmi.read_structure("helix.pdb")
    >>> structure.remove_waters()
    >>> meniscus.from_gemmi(structure)
    <meniscus.Structure: 64 atoms>"""
    return _first(part, "gemmi", radii, options)
