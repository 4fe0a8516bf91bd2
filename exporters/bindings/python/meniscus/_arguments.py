# SPDX-License-Identifier: BSD-3-Clause
"""Converts values with units to plain numbers in Å, without importing the packages that define them."""
from __future__ import annotations

import sys
import warnings
from typing import Any, Optional

import numpy as np

from ._errors import InputError
from ._types import AnyArray

_WAYS = ("value_in_unit", "m_as", "to_value")  # OpenMM and ParmEd; pint; astropy and unyt
_NAMES_OF_ANGSTROM = ("Å", "A", "angstrom", "angstroms", "ångström")
_SAMPLE = 16          # atoms whose nearest neighbour is looked for
_NO_MOLECULE = 0.5    # Å: nearer neighbours are bonds in nm


def has_unit(values: Any) -> bool:
    return any(hasattr(values, way) for way in _WAYS)


def _unit_of(values: Any) -> str:
    return str(getattr(values, "unit", None) or getattr(values, "units", None))


def _converted(values: Any, power: int) -> Any:
    if hasattr(values, "value_in_unit"):
        units = sys.modules[type(values).__module__.rpartition(".")[0]]
        return values.value_in_unit(units.angstrom ** power)
    return values.m_as(f"angstrom**{power}") if hasattr(values, "m_as") else values.to_value(f"angstrom**{power}")


def plain(values: Any, name: str, power: Optional[int]) -> Any:
    """In Å to this power if it has a unit, else as it is. power None: what may have no unit."""
    if isinstance(values, (list, tuple)) and any(has_unit(value) for value in values):
        return [plain(value, name, power) for value in values]
    if has_unit(values):
        if power is None:
            raise InputError(f"{name} is in {_unit_of(values)}; give numbers without a unit")
        try:
            return _converted(values, power)
        except Exception as error:  # each package has errors of its own
            raise InputError(f"{name} is in {_unit_of(values)}, not in a unit of Å^{power}: {error}") from None
    units = getattr(values, "attrs", {}).get("units")  # xarray
    if units is not None and units not in _NAMES_OF_ANGSTROM:
        raise InputError(f"{name} says that it is in {units}; give it in Å, without that attribute")
    return values


def warn_of_nanometres(positions: AnyArray) -> None:
    """No molecule has its atoms so near to one another that half of them have a neighbour within 0.5 Å."""
    count = len(positions)
    if count < 2:
        return
    nearest = []
    for atom in {n * count // _SAMPLE for n in range(_SAMPLE)}:
        away = positions - positions[atom]
        squares = np.einsum("ij,ij->i", away, away)
        squares[atom] = np.inf
        nearest.append(squares.min())
    middle = float(np.sqrt(np.median(nearest)))
    if middle < _NO_MOLECULE:
        warnings.warn(f"the nearest neighbours of atoms are {middle:.3g} Å away: do the positions look like nanometres? "
                      "They have to be in Å", stacklevel=5)
