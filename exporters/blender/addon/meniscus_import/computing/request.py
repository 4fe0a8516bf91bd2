# SPDX-License-Identifier: GPL-3.0-or-later
"""A request: which atoms, which surface, and how fine its mesh is. Plain values, which any thread may read."""

import dataclasses
import hashlib
import json
import os

import numpy as np

from . import preparation_table

KINDS = ("SES", "SAS", "VDW")
#: What becomes of cavities: they show, they do not, nothing else does.
CAVITIES = ("KEEP", "DROP", "ONLY")


@dataclasses.dataclass(frozen=True)
class Request:
    """file: of a molecule, an absolute path; "": atoms come from Blender. preparation: what preparation.asked gives. trajectory, frames, trajectory_atoms: of a run, as the
    program takes them; "" for none. selection, color: likewise; several colours have ";" between them. numbers: a file of them, for schemes that need one. place: in the run, from 1; 0: none. probe, tolerance: Å. density: vertices
    per Å² of a proxy, an even mesh however far from the surface; 0: a mesh within the tolerance. cavities: one of CAVITIES."""

    file: str = ""
    trajectory: str = ""
    frames: str = ""
    trajectory_atoms: str = ""
    preparation: tuple = ()
    selection: str = ""
    color: str = "element"
    numbers: str = ""
    place: int = 0
    kind: str = "SES"
    probe: float = 1.4
    tolerance: float = 0.05
    density: float = 0.0
    cavities: str = "KEEP"

    def colors(self):
        """Each colour that is asked for: a scheme, a colour, or EXPR=COLOR."""
        return [part.strip() for part in self.color.split(";") if part.strip()] or ["element"]

    def needs_program(self):
        """Returns True for colours that the program alone computes: schemes of more than single atoms, and several rules."""
        (first, *more) = self.colors()
        return bool(more) or "=" in first or first != "kind" and dict(preparation_table.SCHEMES).get(first, False)

    def atoms_key(self):
        """Text that two requests share if they are about the same atoms of the same files."""
        return json.dumps([self.selection, self.color, self.frames, self.trajectory_atoms, self.preparation, *(stamp(path) for path in (self.file, self.trajectory, self.numbers))])

    def key(self, atoms=None, others=()):
        """Text that two requests share if their surfaces are the same. atoms: those that come from Blender; others: more arrays
        of theirs."""
        values = dataclasses.asdict(self)
        if self.kind == "VDW":
            values["probe"] = 0.0
        if self.density:
            values["tolerance"] = 0.0
        values["files"] = [stamp(self.file), stamp(self.trajectory), stamp(self.numbers)]
        if atoms is not None:
            values["atoms"] = _digest(atoms.positions, atoms.radii, atoms.colors, atoms.index, *atoms.numbers.values(), *others)
        return hashlib.sha256(json.dumps(values, sort_keys=True).encode()).hexdigest()

    def shape_key(self, atoms):
        """Text that two requests share if the triangles of their surfaces, cavities included, are the same."""
        probe = 0.0 if self.kind == "VDW" else self.probe
        detail = ("density", self.density) if self.density else ("tolerance", self.tolerance)
        return json.dumps([self.kind, probe, *detail, _digest(atoms.positions, atoms.radii)])


def stamp(path):
    """Which file this is, in which state; None for none."""
    if not path or not os.path.exists(path):
        return path or None
    found = os.stat(path)
    return [path, found.st_mtime_ns, found.st_size]


def _digest(*arrays):
    digest = hashlib.blake2b(digest_size=16)
    for values in arrays:
        digest.update(np.ascontiguousarray(values))
    return digest.hexdigest()
