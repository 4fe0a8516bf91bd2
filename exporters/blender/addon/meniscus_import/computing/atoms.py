# SPDX-License-Identifier: GPL-3.0-or-later
"""The atoms of a surface, and files of atoms (`meniscus export atoms`, FORMAT.md of Meniscus)."""

import numpy as np

from .. import joined, mns_reader

#: Arrays that a file of atoms must have, and their columns.
NEEDED = {"atom.center": 3, "atom.radius": 1, "atom.color": 3, "atom.index": 1}
#: Numbers by atom that a file may have.
NUMBERS = ("atom.file_index", "atom.b_factor", "atom.atomic_number", "atom.res_id", "atom.chain_id", "atom.name_id",
           "atom.residue_name_id", "atom.entity", "atom.charge", "atom.hydrophobicity")


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
