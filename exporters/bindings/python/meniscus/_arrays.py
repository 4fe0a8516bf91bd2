# SPDX-License-Identifier: BSD-3-Clause
"""Passes arrays between numpy and the library, without copies where possible."""
from __future__ import annotations

import ctypes
from numbers import Real
from typing import Any, Optional

import numpy as np

from . import _header as header
from ._arguments import AnyArray, Floats, Texts, plain
from ._errors import InputError, wrong_type
from ._library import Handle, call
from ._sources import TAKEN_BY, package_of


#: The tables whose rows are single letters.
_LETTERS = (header.STRUCTURE_INSERTION_CODES, header.STRUCTURE_ALTLOCS)


class _Rows:
    """The array interface of the rows of a table. An array that numpy makes of it keeps this object alive, and this
    object keeps the owner of the memory alive."""

    def __init__(self, owner: Handle, array: header.Array, dtype: Any, columns: tuple[int, ...]) -> None:
        self.owner = owner
        strides = (array.stride,) + (dtype.itemsize,) * len(columns)
        self.__array_interface__ = {"version": 3, "shape": (array.count,) + columns, "typestr": dtype.str,
                                    "data": (array.data, True), "strides": strides}


def view(owner: Handle, function: str, table: int, row: Any, columns: int = 0) -> AnyArray:
    """Returns a read-only view of a table: (n,), or (n, columns) if there are columns.

    function: the part of the C function's name after "meniscus_". row: the ctypes struct of a row, or the dtype of its
    numbers."""
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
    # The rows of a newer library may be longer than the struct.
    whole = np.dtype({"names": list(dtype.names), "formats": [dtype.fields[n][0] for n in dtype.names],
                      "offsets": [dtype.fields[n][1] for n in dtype.names], "itemsize": array.stride})
    return np.asarray(_Rows(owner, array, np.dtype((np.void, array.stride)), ())).view(whole)


def texts(owner: Handle, function: str, table: int) -> Texts:
    """Returns a table of texts or letters as an array of str, (n,). Bytes that are not UTF-8 become surrogate
    escapes."""
    array = header.Array()
    call(function, owner.pointer, table, ctypes.byref(array))
    if array.count == 0:
        return np.empty(0, np.str_)
    # The stride of letters is that of the atoms that have them.
    width = 1 if table in _LETTERS else array.stride
    rows = np.asarray(_Rows(owner, array, np.dtype((np.bytes_, width)), ()))
    return np.char.decode(rows, "utf-8", "surrogateescape")


_TYPES = {np.dtype(np.float64): header.DOUBLE, np.dtype(np.float32): header.FLOAT}


def real_array(values: Any, name: str, power: Optional[int] = None) -> AnyArray:
    """Returns an array of real numbers, converted to Å to this power if they have a unit.

    Raises InputError for masked, complex and boolean values and for text, which numpy would convert silently."""
    values = plain(values, name, power)
    package = "" if isinstance(values, (np.ndarray, list, tuple)) else package_of(values)
    if package:  # numpy would iterate over such an object
        raise wrong_type(f"{name} is a {package}.{type(values).__name__}, not an array; meniscus.{TAKEN_BY[package]}() "
                         "takes it")
    masked: Any = np.ma  # its functions have no type hints
    if masked.is_masked(values):
        raise InputError(f"{name} has {masked.count_masked(values)} masked numbers; leave these rows out, or fill them in")
    try:
        array = np.asarray(values)
        if array.dtype.kind == "O" and all(isinstance(value, Real) for value in array.flat):
            array = array.astype(np.float64)
    except Exception as error:  # which class it is depends on the package
        raise InputError(f"{name}: {error}") from None
    if array.dtype.kind not in "fiu":
        what = {"b": "true or false", "c": "complex numbers", "U": "text", "S": "text"}.get(array.dtype.kind,
                                                                                        f"of the type {array.dtype}")
        raise wrong_type(f"{name} is {what}; give real numbers")
    return array


def numbers(values: Any, name: str, columns: int = 0, power: Optional[int] = None) -> tuple[AnyArray, int]:
    """Returns an array that the library can read, and its meniscus_number_type. The array is the given one if it is
    aligned, has floats or doubles, and each row is contiguous; otherwise it is a copy.

    Raises InputError if the shape is not (n,), or (n, columns) if there are columns."""
    array = real_array(values, name, power)
    if array.dtype not in _TYPES:
        array = array.astype(np.float64)
    if array.ndim != (2 if columns else 1) or (columns and array.shape[1] != columns):
        wanted = f"(n, {columns})" if columns else "(n,)"
        raise InputError(f"{name} has the shape {array.shape}; it has to be {wanted}")
    size = array.itemsize
    rows_ascend = array.strides[0] >= max(columns, 1) * size and array.strides[0] % size == 0
    rows_are_contiguous = not columns or array.strides[1] == size
    if not (rows_ascend and rows_are_contiguous and array.flags.aligned):
        array = np.array(array, order="C")
    return array, _TYPES[array.dtype]


def doubles(values: Any, name: str, columns: int = 0, power: Optional[int] = None) -> Floats:
    """Returns a contiguous array of doubles. Raises the errors of numbers()."""
    return np.require(numbers(values, name, columns, power)[0], np.float64, ["C", "A"])
