# SPDX-License-Identifier: BSD-3-Clause
"""Writes files completely or not at all, to paths and to file objects; molecules as mmCIF and PDB."""
from __future__ import annotations

import importlib
import os
import re
import tempfile
from typing import Any, Callable, Optional

import numpy as np

from . import _header as header
from ._arguments import AnyArray, Path, Texts, flag
from ._errors import OutputError, UsageError, wrong_type
from ._library import about_file

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


_KEYS = ("group_PDB id type_symbol label_atom_id label_alt_id label_comp_id label_asym_id label_entity_id label_seq_id "
         "pdbx_PDB_ins_code Cartn_x Cartn_y Cartn_z occupancy B_iso_or_equiv auth_seq_id auth_comp_id auth_asym_id "
         "auth_atom_id pdbx_PDB_model_num").split()
#: The group and the entity of each class of atoms: polymer, ligand, water, ion, and those without a class.
_GROUPS = np.array(["ATOM", "HETATM", "HETATM", "HETATM", "ATOM"])
_ENTITIES = np.array(["1", "2", "3", "2", "."])
_ENTITY_TABLE = "loop_\n_entity.id\n_entity.type\n1 polymer\n2 non-polymer\n3 water\n#\n"
_BARE = re.compile(r"(?!_|\$|[.?]$|data_|save_|loop_|stop_|global_)[^\s'\"#;\[\]{}][^\s'\"]*", re.ASCII | re.IGNORECASE)


def _quoted(text: str) -> str:
    """Returns a text as a value of CIF. A text that is empty or consists of blanks becomes a dot."""
    text = " ".join(text.replace("\0", " ").split())
    if not text:
        return "."
    if _BARE.fullmatch(text):
        return text
    return f'"{text}"' if '"' not in text else f"'{text}'"


def _values(texts: AnyArray) -> list[str]:
    """Returns the values of a column of texts. Each distinct text is quoted once."""
    distinct, places = np.unique(np.asarray(texts), return_inverse=True)
    quoted = [_quoted(str(text)) for text in distinct]
    return [quoted[place] for place in places.reshape(-1)]


def _numbers(numbers: AnyArray) -> list[str]:
    """Returns the values of a column of numbers with all their digits, and question marks where there is none."""
    return ["?" if number != number else repr(number) for number in np.asarray(numbers).tolist()]


def cif_of(column: Callable[[int], AnyArray], classes: AnyArray, elements: Texts, name: str = "molecule") -> str:
    """Returns the text of an mmCIF file. Positions have all their digits.

    column: a function that returns a column of a structure, such as header.STRUCTURE_NAMES. classes: rows of
    _columns.CLASSES, (n,). elements: symbols, (n,); "" for unknown ones. name: that of the data block."""
    positions = np.asarray(column(header.STRUCTURE_POSITIONS))
    names, residues, chains, codes, altlocs, segments = (_values(column(key)) for key in (
        header.STRUCTURE_NAMES, header.STRUCTURE_RESIDUE_NAMES, header.STRUCTURE_CHAINS,
        header.STRUCTURE_INSERTION_CODES, header.STRUCTURE_ALTLOCS, header.STRUCTURE_SEGMENTS))
    numbers, models, occupancies, b_factors, charges = (_numbers(column(key)) for key in (
        header.STRUCTURE_RESIDUE_NUMBERS, header.STRUCTURE_MODELS, header.STRUCTURE_OCCUPANCIES,
        header.STRUCTURE_B_FACTORS, header.STRUCTURE_CHARGES))
    fields = [_GROUPS[classes].tolist(), map(str, range(1, len(positions) + 1)),
              np.where(elements == "", "?", elements).tolist(), names, altlocs, residues, chains,
              _ENTITIES[classes].tolist(), np.where(classes == 0, numbers, ".").tolist(), codes,
              *(_numbers(positions[:, axis]) for axis in range(3)), occupancies, b_factors, numbers, residues, chains,
              names, models]
    head = "".join(f"_atom_site.{key}\n" for key in _KEYS)
    for key, values in (("charge", charges), ("auth_segid", segments)):  # other programs read these, too
        if any(value not in "?." for value in values):
            head += f"_atom_site.{key}\n"
            fields.append(values)
    block = re.sub(r"[^A-Za-z0-9_.-]", "_", name) or "molecule"
    return f"data_{block}\n{_ENTITY_TABLE}loop_\n{head}" + "\n".join(map(" ".join, zip(*fields))) + "\n#\n"
