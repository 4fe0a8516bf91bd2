# SPDX-License-Identifier: BSD-3-Clause
"""Reads molecules from files, and takes those of other packages."""
from __future__ import annotations

import os
from typing import IO, Any, Iterable, Literal, Mapping, Optional, Sequence, Union

import numpy as np

from ._arguments import Hydrogens, Path, RadiiSet, UnknownElement
from ._arrays import as_file, handle_of, is_content
from ._errors import InputError, warn
from ._sources import Source, opened, package_of
from ._structure import Structure


def read(path: Union[Path, IO[Any]], *, select: Optional[str] = None, assembly: Union[str, int, None] = None,
         model: Union[int, Literal["all"]] = 1, altloc: str = "best", hydrogens: Hydrogens = "auto",
         radii: Optional[RadiiSet] = None, radii_files: Union[Path, Sequence[Path]] = (),
         radius: Union[Mapping[str, float], Iterable[str], None] = None, keep_water: bool = False,
         keep_ions: bool = False, unknown_element: UnknownElement = "halt") -> Structure:
    """Reads a molecule from a PDB, mmCIF, BinaryCIF, SDF, MOL2, PDBQT, PQR, GRO, XYZ or XYZR file, which may be
    compressed with gzip. By default it uses the polymers of the first model with the sugars that are bound to them, or
    all of a file without a polymer, with the most occupied conformer of each residue, but neither water nor free ions.
    Unusual things in the file are UserWarnings.

    select: a selection such as "chain A and resid 10-50", or "all" to use ligands, too. assembly: the biological
    assembly to build. model: the number of the model, from 1, or "all" for all models as one molecule. altloc: the
    alternate location of each residue: "best", "first", "all" or a letter. hydrogens: "keep", "drop", or "auto", which
    keeps them unless the radii of heavy atoms include them. radii: the set of radii, "bondi", "united", "protor" or
    "file"; None for those of the file if it has any, else "bondi". radii_files: paths of tables by residue and atom,
    which override the set. radius: radii in Å by selection, such as {"element Zn": 1.1}. keep_water, keep_ions: whether
    water and free ions are used, too. unknown_element: what happens to atoms of unknown element: "halt" raises
    InputError, "guess" gives them a radius of 2.0 Å, "skip" ignores them.

    Raises InputError if the file cannot be read, or has no such model, assembly, atoms or radii; and UsageError for an
    invalid option or selection.

    >>> len(meniscus.read("helix.pdb", select="chain A", radius={"element N": 1.6}))
    32
    >>> meniscus.read("none.pdb")
    Traceback (most recent call last):
        ...
    meniscus.InputError: none.pdb: cannot be read: No such file or directory"""
    with as_file(path) as file:
        handle = handle_of(file, select=select, assembly=assembly, model=model, altloc=altloc, hydrogens=hydrogens,
                        radii=radii, radii_files=radii_files, radius=radius, keep_water=keep_water, keep_ions=keep_ions,
                        unknown_element=unknown_element)
    structure = Structure._read(handle, os.path.basename(os.fsdecode(file)) if is_content(path) else None)
    for warning in structure.warnings:
        warn(f"{structure.file}: {warning}")
    return structure


def models_of(path: Union[Path, IO[Any]]) -> list[Structure]:
    """Returns each model of a file, with the atoms that read() uses."""
    with as_file(path) as file:
        first, whole = handle_of(file), handle_of(file, model="all")
    name = os.path.basename(os.fsdecode(file)) if is_content(path) else None
    for warning in Structure._read(first, name).warnings:
        if "model=" in warning:  # a warning that only one model is used
            continue
        warn(f"{os.fsdecode(file) if name is None else name}: {warning}")
    return Structure._read(whole, name).split("model")


def first_of(source: Source, radii: Optional[Any]) -> Structure:
    """Returns the molecule in the first frame that is left of a source. Elements that are missing are guessed from
    names with a warning. radii: see Structure."""
    positions = next(source.frames, None)
    if positions is None:
        raise InputError("the atoms have no positions")
    elements, altlocs = source.elements, source.altlocs
    if elements is not None:
        elements = np.asarray(elements)
        if elements.dtype.kind not in "iu":
            elements = np.char.strip(elements.astype(np.str_))
    columns = {name: values for name, values in source.columns().items() if values is not None}
    if len(altlocs):
        columns["altlocs"] = np.array([str(letter).strip(" .\0") for letter in altlocs], np.str_)
    for name, values in columns.items():
        if np.asarray(values).dtype.kind == "O":
            columns[name] = np.asarray(values).astype(np.str_)
    structure = Structure(positions, elements, radii=radii, **columns)
    for warning in structure.warnings:
        warn(warning)
    return structure


def structure_of(molecule: Any, radii: Optional[Any]) -> Structure:
    """Returns the current or first frame of a molecule of another package."""
    return first_of(opened(molecule, package_of(molecule), False), radii)
