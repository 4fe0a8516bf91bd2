# SPDX-License-Identifier: BSD-3-Clause
"""Makes a Structure of a molecule of another package."""
from __future__ import annotations

from typing import Any, Optional

import numpy as np

from ._errors import InputError, warn
from ._sources import Source, opened, package_of
from ._structure import Structure


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
