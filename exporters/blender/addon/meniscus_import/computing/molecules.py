# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads atoms of molecule files by libmeniscus, with the same content that `meniscus export atoms` writes."""

import os

import numpy as np

from .. import mns_reader, sequence_reader
from . import preparation
from .atoms import AtomFile, Atoms

#: sRGB of convex, toroidal and concave patches, which colour a surface by the kind of its patches.
_KINDS = (np.array([[0x00, 0x9e, 0x73], [0x56, 0xb4, 0xe9], [0xd5, 0x5e, 0x00]]) / 255).tolist()


def read(library, request):
    """Returns the atoms.AtomFile of a request about a file without a trajectory. Its frames are the models of the file.
    library: the package meniscus. Raises the library's Error, or MnsError."""
    if not request.place:
        return AtomFile(request.file, _atoms(_structure(library, request), request.colors()[0]), [], None)
    numbers = _frames(library, request)
    first = _structure(library, request, numbers[0])
    return AtomFile(request.file, _atoms(first, request.colors()[0]), numbers, Models(library, request, numbers, first))


class Models:
    """The positions of atoms by the place of a frame in the run, from 0. They are read when they are needed. Raises
    MnsError for a frame with other atoms than the first."""

    def __init__(self, library, request, numbers, first):
        self._library, self._request, self._numbers = library, request, numbers
        self._names = _names(first)

    def __getitem__(self, place):
        structure = _structure(self._library, self._request, self._numbers[place])
        if not np.array_equal(_names(structure), self._names):
            raise mns_reader.MnsError(
                f"{self._request.file}: frame {self._numbers[place]} has other atoms than the first one; "
                "choose a Selection that means the same in all")
        return structure.positions


def _structure(library, request, number=None):
    """Returns the structure of a request. number: the frame number, from 0; None if there is no run."""
    prepared = preparation.library_arguments(request.preparation)
    if number is not None:
        prepared["model"] = number + 1
    return library.read(request.file, select=request.selection or None, **prepared)


def _frames(library, request):
    count = library.read(request.file).model_count
    try:
        numbers = sequence_reader.parse_frames(request.frames or "all", range(count))
    except ValueError as error:
        raise mns_reader.MnsError(f"Frames: {error}") from None
    if max(numbers) >= count:
        raise mns_reader.MnsError(f"Frames: there is no frame {max(numbers)}; there are {count}, 0 to {count - 1}")
    return numbers


def _names(structure):
    return np.stack([structure.names, structure.residue_numbers.astype(str), structure.chains])


def _in_order(names):
    """Returns the distinct names in the order of their first occurrence, and the index of each name among them."""
    found, first, place = np.unique(names, return_index=True, return_inverse=True)
    order = np.argsort(first)
    rank = np.empty(len(order), dtype=np.int32)
    rank[order] = np.arange(len(order))
    return [str(name) for name in found[order]], rank[place]


def _atoms(structure, color):
    chains, chain = _in_order(structure.chains)
    numbers = {
        "atom.file_index": structure.indices, "atom.b_factor": np.nan_to_num(structure.b_factors),
        "atom.atomic_number": structure.elements.astype(np.int32), "atom.res_id": structure.residue_numbers,
        "atom.chain_id": chain
    }
    names = {}
    for key, array, texts in (("atom_names", "atom.name_id", structure.names),
                              ("residue_names", "atom.residue_name_id", structure.residue_names)):
        found, place = _in_order(texts)
        names[key] = found if any(found) else []
        if names[key]:
            numbers[array] = place
    for array, values in (("atom.charge", structure.charges), ("atom.hydrophobicity", structure.hydropathies)):
        if np.isfinite(values).any():
            numbers[array] = np.nan_to_num(values).astype(np.float32)
    classes = ["polymer", "ligand", "water", "ion", "unclassified"]
    entity = np.array([classes.index(name) for name in structure.classes], dtype=np.int32)
    if (entity != classes.index("unclassified")).any():
        numbers["atom.entity"] = entity
    kinds = _KINDS if color == "kind" else None
    return Atoms(structure.positions, structure.radii, structure.colors("grey" if kinds else color),
                 np.arange(len(structure), dtype=np.uint32), numbers, chains, kinds, os.path.basename(structure.file),
                 names)
