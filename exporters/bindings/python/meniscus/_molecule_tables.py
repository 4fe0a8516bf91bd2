# SPDX-License-Identifier: BSD-3-Clause
"""Single atoms, parts and tables of a molecule."""
from __future__ import annotations

import importlib
from collections.abc import Iterable, Iterator
from typing import Any, Literal, NamedTuple

import numpy as np

from ._columns import Columns
from ._errors import UsageError
from ._types import AnyArray


class Atom(NamedTuple):
    """An atom of a Structure.

    row: its row in the structure. name, element, residue_name, residue_number, insertion_code, chain: as in the arrays
    of Structure. position: Å. radius: the van der Waals radius in Å.

    >>> atom = meniscus.read("helix.pdb")[1]
    >>> atom.name, atom.element, atom.residue_name, atom.residue_number, atom.chain, atom.radius
    ('CA', 'C', 'ALA', 1, 'A', 1.7)"""
    row: int
    name: str
    element: str
    residue_name: str
    residue_number: int
    insertion_code: str
    chain: str
    position: tuple[float, float, float]
    radius: float


def atoms_of(molecule: Columns, rows: Iterable[int]) -> Iterator[Atom]:
    """Yields atoms of a molecule."""
    chosen = list(rows)
    columns = [np.asarray(column)[chosen].tolist() for column in (
        molecule.names, molecule.elements, molecule.residue_names, molecule.residue_numbers, molecule.insertion_codes,
        molecule.chains, molecule.positions, molecule.radii)]
    for row, (name, element, residue, number, code, chain, (x, y, z), radius) in zip(chosen, zip(*columns)):
        yield Atom(row, name, element, residue, number, code, chain, (x, y, z), radius)


def groups_of(molecule: Columns, by: str) -> tuple[AnyArray, AnyArray]:
    """Returns the first row of each residue, chain or model in their order, and the number of the group of each atom.
    Raises UsageError for other words."""
    keys: dict[str, tuple[Any, ...]] = {"residue": (molecule.models, molecule.copies, molecule.residues),
                                        "chain": (molecule.models, molecule.chains), "model": (molecule.models,)}
    if by not in keys:
        raise UsageError(f"by is {by!r}, none of {', '.join(keys)}")
    codes = np.zeros(len(molecule.radii), np.int64)
    for key in keys[by]:
        distinct, places = np.unique(np.asarray(key), return_inverse=True)
        codes = np.unique(codes * len(distinct) + places.reshape(-1), return_inverse=True)[1].reshape(-1)
    first = np.unique(codes, return_index=True)[1]
    order = np.argsort(first)
    numbers = np.empty(len(order), np.int64)
    numbers[order] = np.arange(len(order))
    return first[order], numbers[codes] if len(codes) else codes


def parts_of(molecule: Columns, by: Literal["residue", "chain", "model"]) -> list[AnyArray]:
    """Returns the rows of each residue, chain or model."""
    first, group = groups_of(molecule, by)
    return np.split(np.argsort(group, kind="stable"), np.cumsum(np.bincount(group, minlength=len(first)))[:-1])


def frame_of(columns: dict[str, Any]) -> Any:
    """Returns a pandas.DataFrame. Raises ImportError if pandas is not installed."""
    try:
        pandas = importlib.import_module("pandas")
    except ImportError as error:
        raise ImportError(f"to_dataframe() needs pandas ({error}): python -m pip install pandas") from error
    return pandas.DataFrame({name: np.asarray(values) for name, values in columns.items()})


def dataframe_of(molecule: Columns) -> Any:
    """Returns a table of the atoms."""
    x, y, z = np.asarray(molecule.positions).T
    return frame_of({"index": molecule.indices, "name": molecule.names, "element": molecule.elements,
                     "residue_name": molecule.residue_names, "residue_number": molecule.residue_numbers,
                     "insertion_code": molecule.insertion_codes, "chain": molecule.chains, "model": molecule.models,
                     "class": molecule.classes, "x": x, "y": y, "z": z, "radius": molecule.radii,
                     "charge": molecule.charges, "b_factor": molecule.b_factors, "occupancy": molecule.occupancies})


def sums_of(molecule: Columns, by: str, values: dict[str, AnyArray]) -> AnyArray:
    """Returns a structured array with the sums of values of atoms for each residue, chain or model."""
    first, group = groups_of(molecule, by)
    keys: dict[str, Any] = {"model": molecule.models, "chain": molecule.chains}
    if by == "residue":
        keys.update(residue_name=molecule.residue_names, residue_number=molecule.residue_numbers,
                    insertion_code=molecule.insertion_codes)
    elif by == "model":
        del keys["chain"]
    columns = {name: np.asarray(column)[first] for name, column in keys.items()}
    columns["atoms"] = np.bincount(group, minlength=len(first))
    columns.update({name: np.bincount(group, of_atoms, len(first)) for name, of_atoms in values.items()})
    table = np.empty(len(first), [(name, column.dtype) for name, column in columns.items()])
    for name, column in columns.items():
        table[name] = column
    return table
