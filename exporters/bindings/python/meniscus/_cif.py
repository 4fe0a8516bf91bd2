# SPDX-License-Identifier: BSD-3-Clause
"""Writes the atoms of a molecule as mmCIF, which the library and other programs read."""
from __future__ import annotations

import re
from typing import Callable

import numpy as np

from . import _header as header
from ._types import AnyArray, Texts

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
    names, residues, chains, codes, altlocs = (_values(column(key)) for key in (
        header.STRUCTURE_NAMES, header.STRUCTURE_RESIDUE_NAMES, header.STRUCTURE_CHAINS,
        header.STRUCTURE_INSERTION_CODES, header.STRUCTURE_ALTLOCS))
    numbers, models, occupancies, b_factors = (_numbers(column(key)) for key in (
        header.STRUCTURE_RESIDUE_NUMBERS, header.STRUCTURE_MODELS, header.STRUCTURE_OCCUPANCIES,
        header.STRUCTURE_B_FACTORS))
    fields = (_GROUPS[classes].tolist(), map(str, range(1, len(positions) + 1)),
              np.where(elements == "", "?", elements).tolist(), names, altlocs, residues, chains,
              _ENTITIES[classes].tolist(), np.where(classes == 0, numbers, ".").tolist(), codes,
              *(_numbers(positions[:, axis]) for axis in range(3)), occupancies, b_factors, numbers, residues, chains,
              names, models)
    head = "".join(f"_atom_site.{key}\n" for key in _KEYS)
    block = re.sub(r"[^A-Za-z0-9_.-]", "_", name) or "molecule"
    return f"data_{block}\n{_ENTITY_TABLE}loop_\n{head}" + "\n".join(map(" ".join, zip(*fields))) + "\n#\n"
