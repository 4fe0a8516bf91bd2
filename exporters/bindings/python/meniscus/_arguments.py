# SPDX-License-Identifier: BSD-3-Clause
"""Types of arguments and results, and the checks of arguments. Values with units become plain numbers in Å without an
import of their packages."""
from __future__ import annotations

import numbers
import operator
import os
import reprlib
import sys
from ctypes import Structure, c_double, c_float, c_int32
from typing import Any, Literal, Optional, TypedDict, Union

import numpy as np
from numpy.typing import NDArray

from ._errors import InputError, UsageError, warn, wrong_type

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
Bytes = NDArray[np.uint8]
Indices = NDArray[np.uint32]
Numbers = NDArray[np.int32]
Texts = NDArray[np.str_]
Rows = NDArray[np.void]  # a structured array
AnyArray = NDArray[Any]

Path = Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]

Kind = Literal["ses", "sas", "vdw"]
Device = Literal["cpu", "auto", "gpu", "software"]
Projection = Literal["perspective", "orthographic"]
Quantity = Literal["area", "volume", "sas_area", "sas_volume"]
MeshFormat = Literal["stl", "3mf", "obj", "off", "glb", "vtp", "smesh", "dms", "ply", "ply-ascii", "py", "usda", "usdz"]
PocketKind = Literal["cavity", "pocket", "tunnel"]
RadiiSet = Literal["bondi", "united", "protor", "martini2", "martini3", "file"]
Hydrogens = Literal["auto", "keep", "drop"]
UnknownElement = Literal["halt", "guess", "skip"]


class SurfaceOptions(TypedDict, total=False):
    """The keyword arguments of surface()."""
    probe: float
    kind: Kind
    device: Device
    threads: int
    verify: bool


#: Methods that convert units: of OpenMM and ParmEd, of pint, and of astropy and unyt.
_CONVERSIONS = ("value_in_unit", "m_as", "to_value")
_NAMES_OF_ANGSTROM = ("Å", "A", "angstrom", "angstroms", "ångström")
#: The number of atoms whose nearest neighbour warn_of_nanometres() finds.
_SAMPLE = 16
#: Å. Atoms are closer than this only if their positions are in nm.
_CLOSEST_ATOMS = 0.5

#: The units of the fields of structs, as powers of Å.
_POWERS = {"probe": 1, "large_probe": 1, "trim": 1, "mouth_tolerance": 1, "tolerance": 1, "height": 1,
           "min_volume": 3, "density": -2}


def has_unit(values: Any) -> bool:
    return any(hasattr(values, method) for method in _CONVERSIONS)


def _unit_of(values: Any) -> str:
    return str(getattr(values, "unit", None) or getattr(values, "units", None))


def _converted(values: Any, power: int) -> Any:
    if hasattr(values, "value_in_unit"):
        units = sys.modules[type(values).__module__.rpartition(".")[0]]
        return values.value_in_unit(units.angstrom ** power)
    return values.m_as(f"angstrom**{power}") if hasattr(values, "m_as") else values.to_value(f"angstrom**{power}")


def plain(values: Any, name: str, power: Optional[int]) -> Any:
    """Returns values with a unit as plain numbers in Å to this power, and other values as they are.

    power: None if the values must not have a unit. name: what messages call the values. Raises InputError for values in
    a unit of another kind."""
    if isinstance(values, (list, tuple)) and any(has_unit(value) for value in values):
        return [plain(value, name, power) for value in values]
    if has_unit(values):
        if power is None:
            raise InputError(f"{name} is in {_unit_of(values)}; give numbers without a unit")
        try:
            return _converted(values, power)
        except Exception as error:  # the class depends on the package
            raise InputError(f"{name} is in {_unit_of(values)}, not in a unit of Å^{power}: {error}") from None
    units = getattr(values, "attrs", {}).get("units")  # xarray
    if units is not None and units not in _NAMES_OF_ANGSTROM:
        raise InputError(f"{name} says that it is in {units}; give it in Å, without that attribute")
    return values


def warn_of_nanometres(positions: AnyArray) -> None:
    """Warns if half of the atoms have a neighbour within 0.5 Å, which no molecule has.

    positions: (n, 3). Only a sample of the atoms is compared with all others."""
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
    if middle < _CLOSEST_ATOMS:
        warn(f"the nearest neighbours of atoms are {middle:.3g} Å away: do the positions look like nanometres? "
             "They have to be in Å")


def whole_number(name: str, value: Any) -> int:
    """Returns the value as an int. Raises InputError for other types, and for numbers beyond 32 bits, which ctypes
    would truncate."""
    try:
        number = int(value) if isinstance(value, np.bool_) else operator.index(value)
    except TypeError:
        raise wrong_type(f"{name} is {reprlib.repr(value)}, not a whole number") from None
    if not -2**31 <= number < 2**31:
        raise InputError(f"{name} is {reprlib.repr(number)}, which 32 bits cannot count")
    return number


def positive(name: str, value: Any) -> int:
    """Returns a whole number of at least 1. Raises InputError for other types, and UsageError below 1."""
    number = whole_number(name, value)
    if number < 1:
        raise UsageError(f"{name} is {number}; it counts from 1")
    return number


def number(name: str, value: Any) -> float:
    """Returns the value as a float. A value with a unit is converted to the unit of the field of this name in
    meniscus.h. Raises InputError for anything but a single real number."""
    plain_value = plain(value, name, _POWERS.get(name))
    single = isinstance(plain_value, numbers.Real) or getattr(plain_value, "ndim", None) == 0
    try:
        if single and np.asarray(plain_value).dtype.kind in "fiuO":  # "O" has fractions and integers beyond 64 bits
            return float(plain_value)
    except (OverflowError, TypeError, ValueError):
        pass
    raise wrong_type(f"{name} is {reprlib.repr(value)}, not a number")


def flag(name: str, value: Any) -> bool:
    """Returns the value as a bool. Raises InputError for anything but True, False, 1 and 0."""
    if not isinstance(value, (bool, np.bool_, int, np.integer)) or value not in (0, 1):
        raise wrong_type(f"{name} is {reprlib.repr(value)}, neither True nor False")
    return bool(value)


def listed(name: str, values: Any, what: str) -> list[Any]:
    """Returns the values as a list. Raises InputError for texts and for what cannot be iterated over.

    what: the plural that the message calls the items."""
    try:
        if not isinstance(values, (str, bytes)):
            return list(values)
    except TypeError:
        pass
    raise wrong_type(f"{name} is {reprlib.repr(values)}, not a list of {what}")


def file_name(name: str, path: Any) -> bytes:
    """Returns a path in the encoding of the system's file names. Raises InputError for a path with a zero byte."""
    if not isinstance(path, (str, bytes, os.PathLike)):
        raise wrong_type(f"{name} is {reprlib.repr(path)}, not a path")
    encoded = os.fsencode(path)
    if b"\0" in encoded:
        raise InputError(f"{name} {path!r} has a zero in it, which no file's name may have")
    return encoded


def text(name: str, value: Optional[str]) -> Optional[bytes]:
    """Returns a text as a C string in UTF-8, and None as None. Raises InputError for other types, and for a text with a
    zero byte."""
    if value is None:
        return None
    if not isinstance(value, str) or "\0" in value:
        raise wrong_type(f"{name} is {reprlib.repr(value)}, not a text without zeros")
    return value.encode("utf-8", "surrogateescape")


class Struct(Structure):
    """The base class of the structs of meniscus.h. It checks numbers that are assigned to fields, which ctypes would
    truncate or convert."""

    def __setattr__(self, name: str, value: Any) -> None:
        kind = next((field[1] for field in self._fields_ if field[0] == name), None)
        if kind is c_int32:
            value = whole_number(name, value)
        elif kind in (c_double, c_float):
            value = number(name, value)
        super().__setattr__(name, value)


def word(name: str, given: str, words: dict[str, int]) -> int:
    """Returns the constant that a word means. Raises UsageError, with the list of words, for others."""
    if not isinstance(given, str) or given not in words:
        raise UsageError(f"{name} is {reprlib.repr(given)}, none of {', '.join(words)}")
    return words[given]
