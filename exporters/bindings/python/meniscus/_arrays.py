# SPDX-License-Identifier: BSD-3-Clause
"""Passes arrays between numpy and the library, without copies where possible, and molecules of paths, bytes and file
objects."""
from __future__ import annotations

import contextlib
import ctypes
import os
import tempfile
from numbers import Real
from typing import Any, Iterable, Iterator, Literal, Mapping, NamedTuple, Optional, Sequence, Union

import numpy as np

from . import _header as header
from . import _library as lib
from ._arguments import (AnyArray, Floats, Hydrogens, Path, RadiiSet, Texts, UnknownElement, file_name, flag, listed,
                         number, plain, positive, text, word)
from ._columns import NUMBERS
from ._errors import Error, InputError, wrong_type
from ._sources import TAKEN_BY, package_of

#: The tables whose rows are single letters.
_LETTERS = (header.STRUCTURE_INSERTION_CODES, header.STRUCTURE_ALTLOCS)


class _Rows:
    """The array interface of the rows of a table. An array that numpy makes of it keeps this object alive, and this
    object keeps the owner of the memory alive."""

    def __init__(self, owner: lib.Handle, array: header.Array, dtype: Any, columns: tuple[int, ...]) -> None:
        self.owner = owner
        strides = (array.stride,) + (dtype.itemsize,) * len(columns)
        self.__array_interface__ = {"version": 3, "shape": (array.count,) + columns, "typestr": dtype.str,
                                    "data": (array.data, True), "strides": strides}


def view(owner: lib.Handle, function: str, table: int, row: Any, columns: int = 0) -> AnyArray:
    """Returns a read-only view of a table: (n,), or (n, columns) if there are columns.

    function: the part of the C function's name after "meniscus_". row: the ctypes struct of a row, or the dtype of its
    numbers."""
    array = header.Array()
    lib.call(function, owner.pointer, table, ctypes.byref(array))
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


def texts(owner: lib.Handle, function: str, table: int) -> Texts:
    """Returns a table of texts or letters as an array of str, (n,). Bytes that are not UTF-8 become surrogate
    escapes."""
    array = header.Array()
    lib.call(function, owner.pointer, table, ctypes.byref(array))
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
    except Exception as error:  # the class depends on the package
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


_HYDROGENS = {"auto": header.HYDROGENS_AUTO, "keep": header.HYDROGENS_KEEP, "drop": header.HYDROGENS_DROP}
_UNKNOWN_ELEMENTS = {"halt": header.UNKNOWN_HALT, "guess": header.UNKNOWN_GUESS, "skip": header.UNKNOWN_SKIP}

#: The options that leave no atom of a file out.
WHOLE: dict[str, Any] = {"select": "all", "model": "all", "altloc": "all", "hydrogens": "keep", "keep_water": True,
                         "keep_ions": True, "unknown_element": "guess"}


class Report(NamedTuple):
    """The fields of meniscus_read_report that Structure has."""
    file: str
    format: str
    radii_set: str
    sentence: str
    models: int


def _overrides(radius: Union[Mapping[str, float], Iterable[str], None]) -> list[str]:
    """Returns the overrides of radii as texts "EXPR=R"."""
    if radius is None:
        return []
    if isinstance(radius, str):
        return [radius]
    if isinstance(radius, Mapping):
        return [f"{selection}={number('radius', value)!r}" for selection, value in radius.items()]
    return listed("radius", radius, "texts such as 'element Zn=1.1'")


def _c_array(texts: Sequence[bytes]) -> Any:
    return (ctypes.c_char_p * len(texts))(*texts)


def handle_of(path: Path, *, select: Optional[str] = None, assembly: Union[str, int, None] = None,
           model: Union[int, Literal["all"]] = 1, altloc: str = "best", hydrogens: Hydrogens = "auto",
           radii: Optional[RadiiSet] = None, radii_files: Union[Path, Sequence[Path]] = (),
           radius: Union[Mapping[str, float], Iterable[str], None] = None, keep_water: bool = False,
           keep_ions: bool = False, unknown_element: UnknownElement = "halt") -> lib.Handle:
    """Returns the molecule of a file. Options and errors are those of read()."""
    options = lib.default("read_options", header.ReadOptions())
    options.select, options.altloc = text("select", select), text("altloc", altloc)
    options.assembly = None if assembly is None else text("assembly", str(assembly))
    options.radii = text("radii", radii)
    options.model = 0 if isinstance(model, str) and model == "all" else positive("model", model)
    options.hydrogens = word("hydrogens", hydrogens, _HYDROGENS)
    options.unknown_element = word("unknown_element", unknown_element, _UNKNOWN_ELEMENTS)
    options.keep_water, options.keep_ions = flag("keep_water", keep_water), flag("keep_ions", keep_ions)
    files = ([radii_files] if isinstance(radii_files, (str, bytes, os.PathLike)) else
             listed("radii_files", radii_files, "files"))
    tables = _c_array([file_name("radii_files", file) for file in files])
    overrides = _c_array([text("radius", override) or b"" for override in _overrides(radius)])
    options.radii_files, options.radii_file_count = tables, len(tables)
    options.radius, options.radius_count = overrides, len(overrides)
    return lib.Handle("structure", "read", file_name("path", path), ctypes.byref(options))


def report_of(handle: lib.Handle) -> tuple[Report, int]:
    """Returns what the library says of a molecule, and the number of its atoms."""
    report = header.ReadReport(ctypes.sizeof(header.ReadReport))
    lib.call("structure_report", handle.pointer, ctypes.byref(report))
    return Report(os.fsdecode(report.file), report.format.decode(), report.radii_set.decode("utf-8", "replace"),
                  report.sentence.decode("utf-8", "replace"), report.models), report.atoms


def column_of(handle: lib.Handle, column: int) -> AnyArray:
    """Returns a column of a molecule, such as header.STRUCTURE_NAMES."""
    row = NUMBERS.get(column)
    return view(handle, "structure_table", column, *row) if row else texts(handle, "structure_table", column)


def is_content(source: Any) -> bool:
    """Returns true for a file object, and for bytes that are the content of a file and not a path."""
    return hasattr(source, "read") or (isinstance(source, (bytes, bytearray)) and (b"\n" in source or b"\0" in source))


@contextlib.contextmanager
def as_file(source: Any) -> Iterator[Path]:
    """Gives the path of a source for the duration of a `with` statement: that of a temporary file for a file object, or
    for bytes that are the content of a file. Messages name the source instead of the temporary file."""
    if not is_content(source):
        if not isinstance(source, (str, bytes, os.PathLike)):
            raise wrong_type(f"path is of the type {type(source).__name__}, neither a path nor a file object nor the "
                             "bytes of a file")
        yield source
        return
    content = source.read() if hasattr(source, "read") else bytes(source)
    data = content.encode("utf-8", "surrogateescape") if isinstance(content, str) else content
    given = getattr(source, "name", None)
    name = os.path.basename(given) if isinstance(given, str) else "content"
    with tempfile.TemporaryDirectory(prefix="meniscus-") as folder:
        path = os.path.join(folder, name)
        with open(path, "wb") as file:
            file.write(data)
        with renamed(path, name):
            yield path


@contextlib.contextmanager
def renamed(path: str, name: str) -> Iterator[None]:
    """Replaces the path of a temporary file by another name in the messages of errors in a `with` statement."""
    try:
        yield
    except Error as error:
        error.args = (str(error).replace(path, name), *error.args[1:])
        raise
