# SPDX-License-Identifier: GPL-3.0-or-later
"""The atoms of a surface, from files of atoms (`meniscus export atoms`, FORMAT.md of Meniscus) or from molecule files
that libmeniscus reads, with the same content."""

import os

import numpy as np

from .. import joined, mns_reader, sequence_reader
from . import preparation

#: Arrays that a file of atoms must have, and their columns.
NEEDED = {"atom.center": 3, "atom.radius": 1, "atom.color": 3, "atom.index": 1}
#: Numbers by atom that a file may have.
NUMBERS = ("atom.file_index", "atom.b_factor", "atom.atomic_number", "atom.res_id", "atom.chain_id", "atom.name_id",
           "atom.residue_name_id", "atom.entity", "atom.charge", "atom.hydrophobicity")
#: sRGB of convex, toroidal and concave patches, which colour a surface by the kind of its patches.
_KINDS = (np.array([[0x00, 0x9e, 0x73], [0x56, 0xb4, 0xe9], [0xd5, 0x5e, 0x00]]) / 255).tolist()


class Atoms:
    """The atoms of a surface.

    positions: (n, 3) Å. radii: (n,) Å. colors: (n, 3) sRGB.
    index: (n,) the number of each atom, which is its place among the atoms of its source.
    numbers: name of an array of .mns files -> (n,).
    chain_names: the list that atom.chain_id refers to.
    names: key of .mns headers -> the list that another array of numbers refers to.
    kind_colors: sRGB of convex, toroidal and concave patches, which replaces colors, or None.
    source: a name for the user."""

    def __init__(self, positions, radii, colors, index, numbers=None, chain_names=(), kind_colors=None, source="",
                 names=None):
        self.positions, self.radii, self.colors, self.index = positions, radii, colors, index
        self.numbers = numbers or {}
        self.chain_names, self.names = list(chain_names), names or {}
        self.kind_colors = kind_colors
        self.source = source

    def __len__(self):
        return len(self.radii)

    def at(self, positions):
        """Returns the same atoms at other positions."""
        return Atoms(positions, self.radii, self.colors, self.index, self.numbers, self.chain_names, self.kind_colors,
                     self.source, self.names)


class AtomFile:
    """A file of atoms. atoms: the Atoms of the file. numbers: frame numbers of the trajectory; empty if there is no
    run.
    positions: (frames, n, 3) Å, or None."""

    def __init__(self, path, atoms, numbers, positions):
        self.path, self.atoms, self.numbers, self.positions = path, atoms, numbers, positions

    def frame(self, place):
        """Returns the atoms in the frame at a place of the run, from 1. They are read from the disk by this call."""
        return self.atoms.at(self.positions[place - 1])


def read(path):
    """Returns the AtomFile of a path. Raises mns_reader.MnsError with one sentence, or OSError."""
    header, arrays = mns_reader.read_arrays(path)
    if header.get("format") != "meniscus atoms":
        raise mns_reader.MnsError(f"{path}: it holds no atoms (`meniscus export atoms` writes such files)")
    for name, columns in NEEDED.items():
        if name not in arrays:
            raise mns_reader.MnsError(f"{path}: array {name} is missing")
        found = 1 if arrays[name].ndim == 1 else arrays[name].shape[1]
        if found != columns:
            raise mns_reader.MnsError(f"{path}: array {name} has {found} columns instead of {columns}")
    count = len(arrays["atom.radius"])
    for name in (*NEEDED, *NUMBERS):
        if name in arrays and len(arrays[name]) != count:
            raise mns_reader.MnsError(f"{path}: array {name} has {len(arrays[name])} rows instead of {count}")
        if name in arrays and not np.isfinite(arrays[name]).all():
            raise mns_reader.MnsError(f"{path}: array {name} holds a number that is not finite")
    names = {key: [str(name) for name in header.get(key, [])] for key in joined.NAMED.values()}
    for array, key in joined.NAMED.items():
        if array in arrays:
            mns_reader.check_names(path, array, arrays[array], names[key])
    atoms = Atoms(arrays["atom.center"], arrays["atom.radius"], arrays["atom.color"], arrays["atom.index"],
                  {name: arrays[name] for name in NUMBERS if name in arrays}, names.pop("chain_names"),
                  header.get("kind_colors"), str(header.get("source", {}).get("file", "")), names)
    numbers = header.get("frames") or []
    positions = _frames_of(path, arrays, len(numbers), count) if numbers else None
    return AtomFile(path, atoms, numbers, positions)


def _frames_of(path, arrays, frames, count):
    """Returns the positions in all frames, (frames, atoms, 3). They are mapped but not read, because a run may be
    larger than the memory."""
    positions = arrays.get("frame.position")
    if positions is None or positions.shape != (frames * count, 3):
        raise mns_reader.MnsError(f"{path}: array frame.position is not that of {frames} frames of {count} atoms")
    return positions.reshape(frames, count, 3)


def read_molecule(library, request):
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
    elements = structure.atomic_numbers if hasattr(structure, "atomic_numbers") else structure.elements  # in 0.2.0
    numbers = {
        "atom.file_index": structure.indices, "atom.b_factor": np.nan_to_num(structure.b_factors),
        "atom.atomic_number": elements.astype(np.int32), "atom.res_id": structure.residue_numbers,
        "atom.chain_id": chain}
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
