# SPDX-License-Identifier: BSD-3-Clause
"""Reads elements and positions from the molecules of other packages, without importing these packages."""
from __future__ import annotations

import os
from typing import Any, Callable, Iterator, NamedTuple

import numpy as np

from ._errors import InputError, warn, wrong_type


class Source(NamedTuple):
    """The atoms of a molecule of another package.

    elements: symbols or atomic numbers, (n,), or None. frames: positions, (n, 3), in Å or with a unit, of one frame
    after the other. altlocs: the letters of alternate locations, if several may be present. columns: a function that
    returns other arrays by the names of the parameters of Structure(); arrays that the package does not have are
    missing or None."""
    elements: Any
    frames: Iterator[Any]
    altlocs: Any = ()
    columns: Callable[[], dict[str, Any]] = dict


def _attributes(thing: Any, names: dict[str, str]) -> dict[str, Any]:
    """Returns attributes of an object by other names, without those that it does not have."""
    return {name: getattr(thing, attribute, None) for name, attribute in names.items()}


def _listed(atoms: Any, names: dict[str, Callable[[Any], Any]]) -> dict[str, Any]:
    """Returns the results of functions of each atom as lists by name."""
    return {name: [of_atom(atom) for atom in atoms] for name, of_atom in names.items()}


def _mdanalysis(atoms: Any, every: bool) -> Source:
    atoms = atoms.atoms
    frames = (atoms.positions for _ in atoms.universe.trajectory) if every else iter([atoms.positions])

    def columns() -> dict[str, Any]:
        found = _attributes(atoms, {"names": "names", "residue_names": "resnames", "residue_numbers": "resids",
                                    "insertion_codes": "icodes", "segments": "segids", "charges": "charges",
                                    "b_factors": "tempfactors", "occupancies": "occupancies", "chains": "chainIDs"})
        if found["chains"] is None or not any(found["chains"]):
            found["chains"] = found["segments"]
        if found["chains"] is not None:
            found["chains"] = ["" if chain == "SYSTEM" else chain for chain in found["chains"]]  # SYSTEM: no chain
        file = getattr(getattr(atoms, "universe", None), "filename", None)
        return {**found, "name": os.path.basename(str(file or ""))}

    return Source(getattr(atoms, "elements", None), frames, getattr(atoms, "altLocs", ()), columns)


def _mdtraj(trajectory: Any, every: bool) -> Source:
    atoms = list(trajectory.topology.atoms)
    elements = [atom.element.symbol if atom.element else "" for atom in atoms]
    return Source(elements, (np.multiply(frame, 10.0, dtype=np.float64) for frame in trajectory.xyz),  # nm to Å
                  columns=lambda: _listed(atoms, {
                      "names": lambda a: a.name, "residue_names": lambda a: a.residue.name,
                      "residue_numbers": lambda a: a.residue.resSeq, "segments": lambda a: a.residue.segment_id or "",
                      "chains": lambda a: getattr(a.residue.chain, "chain_id", None) or str(a.residue.chain.index + 1)}))


def _prody(atoms: Any, every: bool) -> Source:
    altlocs = atoms.getAltlocs() if hasattr(atoms, "getAltlocs") else None
    frames = atoms.iterCoordsets() if every else iter([atoms.getCoords()])
    methods = {"names": "getNames", "residue_names": "getResnames", "residue_numbers": "getResnums",
               "insertion_codes": "getIcodes", "chains": "getChids", "segments": "getSegnames", "charges": "getCharges",
               "b_factors": "getBetas", "occupancies": "getOccupancies"}
    return Source(atoms.getElements(), frames, () if altlocs is None else altlocs,
                  lambda: {name: getattr(atoms, method, lambda: None)() for name, method in methods.items()})


def _biotite(array: Any, every: bool) -> Source:
    coordinates = array.coord if array.coord.ndim == 3 else array.coord[np.newaxis]
    return Source(array.element, iter(coordinates), getattr(array, "altloc_id", ()), lambda: _attributes(array, {
        "names": "atom_name", "residue_names": "res_name", "residue_numbers": "res_id", "insertion_codes": "ins_code",
        "chains": "chain_id", "b_factors": "b_factor", "occupancies": "occupancy", "charges": "partial_charge"}))


def _biopython(entity: Any, every: bool) -> Source:
    def atoms(part: Any) -> list[Any]:
        return list(part.get_atoms() if hasattr(part, "get_atoms") else part)

    def parent(atom: Any, level: int) -> Any:
        for _ in range(level):
            atom = getattr(atom, "parent", None)
        return atom

    models = list(entity) if getattr(entity, "level", "") == "S" else [entity]
    first = atoms(models[0])
    return Source([atom.element for atom in first],
                  (np.array([atom.coord for atom in atoms(model)]) for model in models),
                  columns=lambda: _listed(first, {
                      "names": lambda a: a.name, "residue_names": lambda a: getattr(parent(a, 1), "resname", ""),
                      "residue_numbers": lambda a: parent(a, 1).id[1] if parent(a, 1) else 0,
                      "insertion_codes": lambda a: parent(a, 1).id[2].strip() if parent(a, 1) else "",
                      "chains": lambda a: parent(a, 2).id if parent(a, 2) else "",
                      "b_factors": lambda a: a.bfactor if a.bfactor is not None else np.nan,
                      "occupancies": lambda a: a.occupancy if a.occupancy is not None else np.nan}))


def _ase(atoms: Any, every: bool) -> Source:
    images = [atoms] if hasattr(atoms, "get_positions") else atoms
    numbers = images[0].get_atomic_numbers()

    def positions(n: int, image: Any) -> Any:
        if not np.array_equal(image.get_atomic_numbers(), numbers):
            raise InputError(f"image {n} has other atoms than the first")
        return image.get_positions()

    arrays = getattr(images[0], "arrays", {})
    return Source(numbers, (positions(n, image) for n, image in enumerate(images)), columns=lambda: {
        "names": arrays.get("atomtypes"), "residue_names": arrays.get("residuenames"),
        "residue_numbers": arrays.get("residuenumbers"), "b_factors": arrays.get("bfactor"),
        "occupancies": arrays.get("occupancy")})


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

    def columns() -> dict[str, Any]:
        residues = [atom.GetPDBResidueInfo() for atom in molecule.GetAtoms()]
        found = {"name": molecule.GetProp("_Name") if molecule.HasProp("_Name") else ""}
        return found if not all(residues) else {**found, **_listed(residues, {
            "names": lambda r: r.GetName().strip(), "residue_names": lambda r: r.GetResidueName().strip(),
            "residue_numbers": lambda r: r.GetResidueNumber(), "chains": lambda r: r.GetChainId().strip(),
            "insertion_codes": lambda r: r.GetInsertionCode().strip(), "b_factors": lambda r: r.GetTempFactor(),
            "occupancies": lambda r: r.GetOccupancy()})}

    return Source([atom.GetAtomicNum() for atom in molecule.GetAtoms()], map(positions, conformers), columns=columns)


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
    atoms = list(topology.atoms())
    return Source([atom.element.symbol if atom.element else "" for atom in atoms], map(checked, frames()),
                  columns=lambda: _listed(atoms, {
                      "names": lambda a: a.name, "residue_names": lambda a: a.residue.name,
                      "residue_numbers": lambda a: int(a.residue.id) if a.residue.id.lstrip("-").isdigit() else 0,
                      "insertion_codes": lambda a: a.residue.insertionCode.strip(),
                      "chains": lambda a: a.residue.chain.id}))


def _gemmi(part: Any, every: bool) -> Source:
    def atoms(part: Any, parents: tuple[Any, ...] = ()) -> list[Any]:
        return [(part, parents)] if hasattr(part, "element") else [
            atom for child in part for atom in atoms(child, (*parents, part))]

    def parent(atom: Any, attribute: str) -> Any:
        """Returns the residue, which has a seqid, or the chain, which has a name only."""
        return next((p for p in reversed(atom[1]) if hasattr(p, attribute)
                     and hasattr(p, "seqid") == (attribute == "seqid")), None)

    models = list(part) if hasattr(part, "assemblies") else [part]  # a Structure has several
    first = atoms(models[0])
    return Source([atom.element.atomic_number for atom, _ in first],
                  (np.array([atom.pos.tolist() for atom, _ in atoms(model)]) for model in models),
                  [atom.altloc for atom, _ in first], lambda: _listed(first, {
                      "names": lambda a: a[0].name, "b_factors": lambda a: a[0].b_iso,
                      "occupancies": lambda a: a[0].occ,
                      "residue_names": lambda a: getattr(parent(a, "seqid"), "name", ""),
                      "residue_numbers": lambda a: parent(a, "seqid").seqid.num or 0 if parent(a, "seqid") else 0,
                      "insertion_codes": lambda a: parent(a, "seqid").seqid.icode.strip() if parent(a, "seqid") else "",
                      "chains": lambda a: getattr(parent(a, "name"), "name", "")}))


_READERS: dict[str, Callable[[Any, bool], Source]] = {
    "MDAnalysis": _mdanalysis, "mdtraj": _mdtraj, "prody": _prody, "biotite": _biotite, "Bio": _biopython, "ase": _ase,
    "rdkit": _rdkit, "openmm": _openmm, "gemmi": _gemmi}
#: The functions of _adapters.py that take the objects of each package.
TAKEN_BY = {package: "from" + reader.__name__ for package, reader in _READERS.items()}


def package_of(value: Any) -> str:
    """Returns the package that defines an object, or the first object of a list; "" for packages that are not
    supported."""
    if isinstance(value, (list, tuple)):
        return package_of(value[0]) if value else ""
    names = (kind.__module__.split(".")[0] for kind in type(value).__mro__)
    return next((name for name in names if name in _READERS), "")


def is_molecule(value: Any) -> bool:
    """Returns true for a molecule of another package; false for its positions with a unit, and for other objects."""
    package = "" if isinstance(value, np.ndarray) else package_of(value)
    if package == "openmm":
        return hasattr(value, "topology") or (isinstance(value, tuple) and hasattr(value[0], "atoms"))
    return bool(package)


def opened(molecule: Any, package: str, every: bool) -> Source:
    """Returns the atoms of a molecule of a package. every: whether the source has all frames, not only the current one.
    Raises InputError if the object has no atoms."""
    try:
        source = _READERS[package](molecule, every)
    except (AttributeError, IndexError, TypeError) as error:
        raise wrong_type(f"a {package}.{type(molecule).__name__} has no atoms that {TAKEN_BY[package]}() takes: "
                         f"{error}") from error
    letters = {str(letter).strip(" .\0") for letter in source.altlocs} - {""}
    if len(letters) > 1:
        warn(f"atoms at the alternate locations {', '.join(sorted(letters))} all count; leave all but one out")
    return source
