# SPDX-License-Identifier: BSD-3-Clause
"""Checks the arguments of callers, and converts values with units to plain numbers in Å without importing their packages."""
from __future__ import annotations

import numbers
import operator
import os
import reprlib
import sys
import warnings
from ctypes import Structure, c_double, c_float, c_int32
from typing import Any, Optional

import numpy as np

from ._errors import InputError, UsageError
from ._types import AnyArray, Path

_WAYS = ("value_in_unit", "m_as", "to_value")  # OpenMM and ParmEd; pint; astropy and unyt
_NAMES_OF_ANGSTROM = ("Å", "A", "angstrom", "angstroms", "ångström")
_SAMPLE = 16          # atoms whose nearest neighbour is looked for
_NO_MOLECULE = 0.5    # Å: nearer neighbours are bonds in nm

# Lengths, areas and volumes of structs: the power of Å of their unit.
_POWERS = {"probe_radius": 1, "large_probe_radius": 1, "trim": 1, "mouth_tolerance": 1, "tolerance": 1, "height": 1,
           "min_volume": 3, "density": -2}


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


def whole_number(name: str, value: Any) -> int:
    """Of 32 bits, to which ctypes would cut a larger one without a word."""
    try:
        number = int(value) if isinstance(value, np.bool_) else operator.index(value)
    except TypeError:
        raise InputError(f"{name} is {reprlib.repr(value)}, not a whole number") from None
    if not -2**31 <= number < 2**31:
        raise InputError(f"{name} is {reprlib.repr(number)}, which 32 bits cannot count")
    return number


def positive(name: str, value: Any) -> int:
    number = whole_number(name, value)
    if number < 1:
        raise UsageError(f"{name} is {number}; it counts from 1")
    return number


def number(name: str, value: Any) -> float:
    """In Å, or a power of it, where that is what it counts."""
    plain_value = plain(value, name, _POWERS.get(name))
    single = isinstance(plain_value, numbers.Real) or getattr(plain_value, "ndim", None) == 0
    try:
        if single and np.asarray(plain_value).dtype.kind in "fiuO":  # O: fractions, and integers beyond 64 bits
            return float(plain_value)
    except (OverflowError, TypeError, ValueError):
        pass
    raise InputError(f"{name} is {reprlib.repr(value)}, not a number")


def flag(name: str, value: Any) -> bool:
    """Of True and False, or 1 and 0; other words would all be true."""
    if not isinstance(value, (bool, np.bool_, int, np.integer)) or value not in (0, 1):
        raise InputError(f"{name} is {reprlib.repr(value)}, neither True nor False")
    return bool(value)


def listed(name: str, values: Any, what: str) -> list[Any]:
    """Of what can be walked through and is not a text."""
    try:
        if not isinstance(values, (str, bytes)):
            return list(values)
    except TypeError:
        pass
    raise InputError(f"{name} is {reprlib.repr(values)}, not a list of {what}")


def file_name(name: str, path: Path) -> bytes:
    """Returns the path in the encoding of the system's file names."""
    encoded = os.fsencode(path)
    if b"\0" in encoded:
        raise InputError(f"{name} {path!r} has a zero in it, which no file's name may have")
    return encoded


def text(name: str, value: Optional[str]) -> Optional[bytes]:
    """As C has it; None stays None."""
    if value is None:
        return None
    if not isinstance(value, str) or "\0" in value:
        raise InputError(f"{name} is {reprlib.repr(value)}, not a text without zeros")
    return value.encode("utf-8", "surrogateescape")


class Struct(Structure):
    """A struct whose numbers come from callers: each is looked at before ctypes makes something of it."""

    def __setattr__(self, name: str, value: Any) -> None:
        kind = next((field[1] for field in self._fields_ if field[0] == name), None)
        if kind is c_int32:
            value = whole_number(name, value)
        elif kind in (c_double, c_float):
            value = number(name, value)
        super().__setattr__(name, value)


def word(name: str, given: str, words: dict[str, int]) -> int:
    """The constant that a word means."""
    if not isinstance(given, str) or given not in words:
        raise UsageError(f"{name} is {reprlib.repr(given)}, none of {', '.join(words)}")
    return words[given]
