# SPDX-License-Identifier: BSD-3-Clause
"""Arrays between numpy and the library, without copies where possible."""
from __future__ import annotations

import ctypes
from numbers import Real
from typing import Any, Optional

import numpy as np

from . import _header as header
from ._arguments import plain
from ._errors import InputError
from ._library import Handle, call
from ._sources import TAKEN_BY, package_of
from ._types import AnyArray, Floats, Texts


_LETTERS = (header.STRUCTURE_INSERTION_CODES, header.STRUCTURE_ALTLOCS)


class _Rows:
    """What numpy needs to see rows of a table; the array that it makes holds this object, and this one its owner."""

    def __init__(self, owner: Handle, array: header.Array, dtype: Any, columns: tuple[int, ...]) -> None:
        self.owner = owner
        strides = (array.stride,) + (dtype.itemsize,) * len(columns)
        self.__array_interface__ = {"version": 3, "shape": (array.count,) + columns, "typestr": dtype.str,
                                    "data": (array.data, True), "strides": strides}


def view(owner: Handle, function: str, table: int, row: Any, columns: int = 0) -> AnyArray:
    """A read-only view of a table whose rows are `row`, a ctypes struct, or numbers of that dtype."""
    array = header.Array()
    call(function, owner.pointer, table, ctypes.byref(array))
    shape = (columns,) if columns else ()
    dtype: Any = np.dtype(row)
    if array.count == 0:
        empty = np.empty((0,) + shape, dtype)
        empty.flags.writeable = False
        return empty
    if dtype.names is None:
        return np.asarray(_Rows(owner, array, dtype, shape))
    # Rows may be longer than the struct that is known here.
    whole = np.dtype({"names": list(dtype.names), "formats": [dtype.fields[n][0] for n in dtype.names],
                      "offsets": [dtype.fields[n][1] for n in dtype.names], "itemsize": array.stride})
    return np.asarray(_Rows(owner, array, np.dtype((np.void, array.stride)), ())).view(whole)


def texts(owner: Handle, function: str, table: int) -> Texts:
    """A table whose rows are texts of one length, filled with zeros, or letters. What is not UTF-8 stays as names of
    files do in Python."""
    array = header.Array()
    call(function, owner.pointer, table, ctypes.byref(array))
    if array.count == 0:
        return np.empty(0, np.str_)
    # Of letters the next stands where the next atom's does.
    width = 1 if table in _LETTERS else array.stride
    rows = np.asarray(_Rows(owner, array, np.dtype((np.bytes_, width)), ()))
    return np.char.decode(rows, "utf-8", "surrogateescape")


_TYPES = {np.dtype(np.float64): header.DOUBLE, np.dtype(np.float32): header.FLOAT}


def real_array(values: Any, name: str, power: Optional[int] = None) -> AnyArray:
    """Of real numbers, in Å to this power where they have a unit; else InputError: what is masked, complex, true or
    false, or text would silently become numbers."""
    values = plain(values, name, power)
    package = "" if isinstance(values, (np.ndarray, list, tuple)) else package_of(values)
    if package:  # some of whose things can be walked through, but are no arrays
        raise InputError(f"{name} is a {package}.{type(values).__name__}, not an array; meniscus.{TAKEN_BY[package]}() "
                         "takes it")
    masked: Any = np.ma  # whose functions have no types
    if masked.is_masked(values):
        raise InputError(f"{name} has {masked.count_masked(values)} masked numbers; leave these rows out, or fill them in")
    try:
        array = np.asarray(values)
        if array.dtype.kind == "O" and all(isinstance(value, Real) for value in array.flat):
            array = array.astype(np.float64)
    except Exception as error:  # packages have errors of their own
        raise InputError(f"{name}: {error}") from None
    if array.dtype.kind not in "fiu":
        what = {"b": "true or false", "c": "complex numbers", "U": "text", "S": "text"}.get(array.dtype.kind,
                                                                                        f"of the type {array.dtype}")
        raise InputError(f"{name} is {what}; give real numbers")
    return array


def numbers(values: Any, name: str, columns: int = 0, power: Optional[int] = None) -> tuple[AnyArray, int]:
    """An array that the library can read as it is, and its type: the one given, if it has floats or doubles with whole
    rows; else a copy in doubles."""
    array = real_array(values, name, power)
    if array.dtype not in _TYPES:
        array = array.astype(np.float64)
    if array.ndim != (2 if columns else 1) or (columns and array.shape[1] != columns):
        wanted = f"(n, {columns})" if columns else "(n,)"
        raise InputError(f"{name} has the shape {array.shape}; it has to be {wanted}")
    size = array.itemsize
    apart = array.strides[0] >= max(columns, 1) * size and array.strides[0] % size == 0
    together = not columns or array.strides[1] == size
    if not (apart and together and array.flags.aligned):
        array = np.array(array, order="C")
    return array, _TYPES[array.dtype]


def doubles(values: Any, name: str, columns: int = 0, power: Optional[int] = None) -> Floats:
    """The same without a gap, in doubles."""
    return np.require(numbers(values, name, columns, power)[0], np.float64, ["C", "A"])


def atom_colors(colors: Any, atom_count: int) -> AnyArray:
    """Three floats an atom, of one colour for all or of one each."""
    given = real_array(colors, "colors").astype(np.float32)
    if given.shape not in ((3,), (atom_count, 3)):
        raise InputError(f"colors has the shape {given.shape}; it has to be (3,) or ({atom_count}, 3)")
    return np.array(np.broadcast_to(given, (atom_count, 3)), order="C")
