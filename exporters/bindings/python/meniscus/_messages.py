# SPDX-License-Identifier: BSD-3-Clause
"""Turns the status and the message of a call of the library into an exception of the package, in words of Python."""
from __future__ import annotations

import os
import re
from typing import Optional

from . import _header as header
from ._errors import (CapacityError, Error, GpuError, InputError, InternalError, NotClosedError, OutputError,
                      UsageError, also, unknown_name)

_EXCEPTIONS: dict[int, type[Error]] = {
    header.INTERNAL: InternalError, header.USAGE: UsageError, header.INPUT: InputError, header.NO_GPU: GpuError,
    header.CAPACITY: CapacityError, header.OUTPUT: OutputError, header.NOT_CLOSED: NotClosedError}

#: Words of C and of the command line in messages, and those of the package.
_WORDS = [(re.compile(words), python) for words, python in (
    (r"use the program's --force to replace it", "replace=True replaces it"),
    (r", and format is NULL; the formats are ", "; give a format: "),
    (r": meniscus_atoms\.count is 0", ""),
    (r"\bprobe_radius\b", "probe"),
    (r"\blarge_probe_radius\b", "large_probe"),
    (r"give one colour, or atom_colors", "give one colour, or colors with one for each atom"),
    (r"or the van der Waals surface", 'or kind="vdw"'),
    (r"which MENISCUS_MESH_BY_DENSITY does not keep to; leave it at \S+", "which a mesh of a density does not keep to; "
     "leave it out"),
    (r"MENISCUS_ATOM_SAS_AREAS are of MENISCUS_SES surfaces; see MENISCUS_ATOM_AREAS",
     'atom_sas_areas are of surfaces of kind "ses"; atom_areas has those of other kinds'),
    (r"gradients of MENISCUS_GRADIENT_SAS_\.\.\. are of MENISCUS_SES surfaces; see MENISCUS_GRADIENT_AREA",
     'gradients of "sas_area" and "sas_volume" are of surfaces of kind "ses"; "area" and "volume" are those of others'),
    (r"a surface of MENISCUS_SES", 'a surface of kind "ses"'),
    (r"meniscus_render_scene\(\)", "a meniscus.Scene"),
    (r"lists atoms without coordinates; add trajectory with a file that has them",
     "lists atoms without coordinates; meniscus.frames(trajectory, topology=...) reads both"),
    (r"(\.(?:xtc|trr|dcd|nc|ncdf|nctraj|h5md|lammpstrj)): is in none of the formats that are read .*",
     r"\1: is a trajectory; meniscus.frames(trajectory, topology=...) reads it"),
    (r"the program's --(\w+)", r"the program's option \1"))]

#: The ends of messages about files, and Python's exceptions for them.
_ABOUT_FILES: tuple[tuple[str, type[Exception]], ...] = (
    ("No such file or directory", FileNotFoundError), ("Permission denied", PermissionError),
    ("Operation not permitted", PermissionError), ("Read-only file system", PermissionError),
    ("Is a directory", IsADirectoryError), ("is a folder; give the name of a molecule file", IsADirectoryError),
    ("Not a directory", NotADirectoryError))


def in_words_of_python(message: str) -> str:
    """Returns a message of the library with the names that the package has."""
    for words, python in _WORDS:
        message = words.sub(python, message)
    return message


def about_file(base: type[Error], message: str, file: Optional[str] = None) -> Error:
    """Returns an error about a file, which is also Python's exception for the reason that the message ends with."""
    path = message.split(": ")[0] if file is None else file
    if ": exists already; " in message:
        return also(base, (FileExistsError,), message, path)
    kind = next((kind for end, kind in _ABOUT_FILES if message.endswith(end)), None)
    if kind is None and isinstance(base, type) and issubclass(base, OutputError) and os.path.isdir(path):
        kind = IsADirectoryError
    return base(message) if kind is None else also(base, (kind,), message, path)


def error_of(status: int, message: str) -> Error:
    """Returns the exception of a call that failed. message: that of meniscus_last_error()."""
    text = in_words_of_python(message)
    base = _EXCEPTIONS.get(status, Error)
    if base is UsageError and (text.endswith(" is not a value of a scene") or "; did you mean " in text):
        return unknown_name(text)
    return about_file(base, text) if base in (InputError, OutputError) else base(text)
