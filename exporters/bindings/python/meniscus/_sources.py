# SPDX-License-Identifier: BSD-3-Clause
"""Reads elements and positions from the molecules of other packages, without importing these packages."""
from __future__ import annotations

import warnings
from typing import Any, Callable, Iterator, NamedTuple

import numpy as np

from ._errors import InputError

#: The functions of _adapters.py that take the objects of each package.
TAKEN_BY = {"MDAnalysis": "from_mdanalysis", "mdtraj": "from_mdtraj", "prody": "from_prody", "biotite": "from_biotite",
            "Bio": "from_biopython", "ase": "from_ase", "rdkit": "from_rdkit", "openmm": "from_openmm",
            "gemmi": "from_gemmi"}


class Source(NamedTuple):
    """The atoms of a molecule of another package.

    elements: symbols or atomic numbers, (n,), or None. frames: positions, (n, 3), in Å or with a unit, of one frame
    after the other. altlocs: the letters of alternate locations, if several may be present."""
    elements: Any
    frames: Iterator[Any]
    altlocs: Any = ()


def _mdanalysis(atoms: Any, every: bool) -> Source:
    atoms = atoms.atoms
    frames = (atoms.positions for _ in atoms.universe.trajectory) if every else iter([atoms.positions])
    return Source(getattr(atoms, "elements", None), frames, getattr(atoms, "altLocs", ()))


def _mdtraj(trajectory: Any, every: bool) -> Source:
    elements = [atom.element.symbol if atom.element else "" for atom in trajectory.topology.atoms]
    return Source(elements, (np.multiply(frame, 10.0, dtype=np.float64) for frame in trajectory.xyz))  # nm to Å


def _prody(atoms: Any, every: bool) -> Source:
    altlocs = atoms.getAltlocs() if hasattr(atoms, "getAltlocs") else None
    frames = atoms.iterCoordsets() if every else iter([atoms.getCoords()])
    return Source(atoms.getElements(), frames, () if altlocs is None else altlocs)


def _biotite(array: Any, every: bool) -> Source:
    coordinates = array.coord if array.coord.ndim == 3 else array.coord[np.newaxis]
    return Source(array.element, iter(coordinates), getattr(array, "altloc_id", ()))


def _biopython(entity: Any, every: bool) -> Source:
    def atoms(part: Any) -> list[Any]:
        return list(part.get_atoms() if hasattr(part, "get_atoms") else part)

    models = list(entity) if getattr(entity, "level", "") == "S" else [entity]
    return Source([atom.element for atom in atoms(models[0])],
                  (np.array([atom.coord for atom in atoms(model)]) for model in models))


def _ase(atoms: Any, every: bool) -> Source:
    images = [atoms] if hasattr(atoms, "get_positions") else atoms
    numbers = images[0].get_atomic_numbers()

    def positions(n: int, image: Any) -> Any:
        if not np.array_equal(image.get_atomic_numbers(), numbers):
            raise InputError(f"image {n} has other atoms than the first")
        return image.get_positions()

    return Source(numbers, (positions(n, image) for n, image in enumerate(images)))


def _rdkit(molecule: Any, every: bool) -> Source:
    single = hasattr(molecule, "Is3D")  # a Conformer
    conformers = [molecule] if single else list(molecule.GetConformers())
    molecule = molecule.GetOwningMol() if single else molecule
    if not conformers:
        raise InputError("the molecule has no conformer; rdkit.Chem.AllChem.EmbedMolecule() makes one")

    def positions(conformer: Any) -> Any:
        if not conformer.Is3D():
            raise InputError(f"conformer {conformer.GetId()} is a drawing in two dimensions")
        return conformer.GetPositions()

    return Source([atom.GetAtomicNum() for atom in molecule.GetAtoms()], map(positions, conformers))


def _openmm(source: Any, every: bool) -> Source:
    """Refuses positions without a unit, which are nm in OpenMM but Å here."""
    def frames() -> Iterator[Any]:
        if isinstance(source, tuple):
            yield source[1]
        elif hasattr(source, "context"):  # a Simulation
            yield source.context.getState(getPositions=True).getPositions(asNumpy=True)
        elif hasattr(source, "getNumFrames"):
            yield from (source.getPositions(asNumpy=True, frame=n) for n in range(source.getNumFrames()))
        else:
            yield source.positions

    def checked(positions: Any) -> Any:
        if not hasattr(positions, "value_in_unit"):
            raise InputError("the positions have no unit; for OpenMM's nm give positions * openmm.unit.nanometer")
        return positions

    topology = source[0] if isinstance(source, tuple) else source.topology
    return Source([atom.element.symbol if atom.element else "" for atom in topology.atoms()], map(checked, frames()))


def _gemmi(part: Any, every: bool) -> Source:
    def atoms(part: Any) -> list[Any]:
        return [part] if hasattr(part, "element") else [atom for child in part for atom in atoms(child)]

    models = list(part) if hasattr(part, "assemblies") else [part]  # of a Structure
    first = atoms(models[0])
    return Source([atom.element.atomic_number for atom in first],
                  (np.array([atom.pos.tolist() for atom in atoms(model)]) for model in models),
                  [atom.altloc for atom in first])


_READERS: dict[str, Callable[[Any, bool], Source]] = {
    "MDAnalysis": _mdanalysis, "mdtraj": _mdtraj, "prody": _prody, "biotite": _biotite, "Bio": _biopython, "ase": _ase,
    "rdkit": _rdkit, "openmm": _openmm, "gemmi": _gemmi}


def package_of(value: Any) -> str:
    """Returns the package that defines an object, or the first object of a list; "" for packages that are not
    supported."""
    if isinstance(value, (list, tuple)):
        return package_of(value[0]) if value else ""
    names = (kind.__module__.split(".")[0] for kind in type(value).__mro__)
    return next((name for name in names if name in _READERS), "")


def opened(molecule: Any, package: str, every: bool) -> Source:
    """Returns the atoms of a molecule of a package. every: whether the source has all frames, not only the current one.
    Raises InputError if the object has no atoms."""
    try:
        source = _READERS[package](molecule, every)
    except (AttributeError, IndexError, TypeError) as error:
        raise InputError(f"a {package}.{type(molecule).__name__} has no atoms that {TAKEN_BY[package]}() takes: "
                         f"{error}") from error
    letters = {str(letter).strip(" .\0") for letter in source.altlocs} - {""}
    if len(letters) > 1:
        warnings.warn(f"atoms at the alternate locations {', '.join(sorted(letters))} all count; leave all but one out",
                      stacklevel=4)
    return source
