# SPDX-License-Identifier: BSD-3-Clause
"""Writes files completely or not at all: to paths, and to file objects."""
from __future__ import annotations

import importlib
import os
import tempfile
from typing import Any, Callable, Optional

from ._arguments import flag
from ._errors import OutputError, UsageError, wrong_type
from ._messages import about_file
from ._types import Path

_ENDINGS = {".cif": "cif", ".mmcif": "cif", ".pdb": "pdb", ".ent": "pdb"}


def save_bytes(content: bytes, target: Any, replace: bool) -> None:
    """Writes bytes to a path or a file object. Raises OutputError if the file cannot be written, or exists and is not
    replaced."""
    if hasattr(target, "write"):
        target.write(content)
        return
    if not isinstance(target, (str, bytes, os.PathLike)):
        raise wrong_type(f"path is of the type {type(target).__name__}, neither a path nor a file object")
    path = os.fsdecode(target)
    if not flag("replace", replace) and os.path.lexists(path):
        raise about_file(OutputError, f"{path}: exists already; replace=True replaces it", path)
    try:
        handle, temporary = tempfile.mkstemp(suffix=".part", dir=os.path.dirname(path) or ".")
        try:
            with open(handle, "wb") as file:
                file.write(content)
            mask = os.umask(0)
            os.umask(mask)
            os.chmod(temporary, 0o666 & ~mask)
            os.replace(temporary, path)
        except BaseException:
            os.unlink(temporary)
            raise
    except OSError as error:
        raise about_file(OutputError, f"{path}: cannot be written: {error.strerror}", path) from None


def save_by_library(target: Any, ending: str, save: Callable[[str], None]) -> None:
    """Writes what the library saves to a temporary file to a file object. save: a function that takes the path."""
    with tempfile.TemporaryDirectory(prefix="meniscus-") as folder:
        path = os.path.join(folder, "file" + ending)
        save(path)
        with open(path, "rb") as file:
            target.write(file.read())


def _pdb_of(cif: str) -> str:
    """Returns the text of a PDB file of an mmCIF text."""
    try:
        gemmi: Any = importlib.import_module("gemmi")
    except ImportError as error:
        raise ImportError(f"writing PDB needs gemmi ({error}): python -m pip install gemmi, or write .cif") from error
    structure = gemmi.make_structure_from_block(gemmi.cif.read_string(cif).sole_block())
    structure.setup_entities()
    structure.shorten_chain_names()
    return str(structure.make_pdb_string())


def written(cif: str, path: Path, format: Optional[str], replace: bool) -> None:
    """Writes a molecule. Parameters and errors are those of Structure.write(). cif: the text of its mmCIF file."""
    name = "" if hasattr(path, "write") else os.fsdecode(path)
    chosen = _ENDINGS.get(os.path.splitext(name)[1].lower()) if format is None else format
    if chosen not in ("cif", "pdb"):
        raise UsageError(f"{name!r} does not end like a molecule file; give a format: cif, pdb" if format is None else
                         f"format is {format!r}, none of cif, pdb")
    text = _pdb_of(cif) if chosen == "pdb" else cif
    save_bytes(text.encode("utf-8", "surrogateescape"), path, replace)
