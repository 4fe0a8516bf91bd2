# SPDX-License-Identifier: BSD-3-Clause
"""Reads molecules by the library, from paths, bytes and file objects."""
from __future__ import annotations

import contextlib
import ctypes
import os
import tempfile
from typing import Any, Iterable, Iterator, Literal, Mapping, NamedTuple, Optional, Sequence, Union

from . import _header as header
from . import _library as lib
from ._arguments import (AnyArray, Hydrogens, Path, RadiiSet, UnknownElement, file_name, flag, listed, number, positive,
                         text, word)
from ._arrays import texts, view
from ._columns import NUMBERS
from ._errors import Error, wrong_type

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
