# SPDX-License-Identifier: GPL-3.0-or-later
"""A request for a surface: its atoms, its kind, and the fineness of its mesh, as plain values."""

import dataclasses
import hashlib
import json
import os

import numpy as np

from . import preparation_table

KINDS = ("SES", "SAS", "VDW")
#: The choices for cavities: shown, left out, or shown alone.
CAVITIES = ("KEEP", "DROP", "ONLY")


@dataclasses.dataclass(frozen=True)
class Request:
    """A request for a surface.

    file: the absolute path of a molecule; "" if the atoms come from Blender.
    trajectory, frames, trajectory_atoms: values of the program's options for a run; "" for none.
    preparation: the result of preparation.changed_fields().
    selection, color: values of the program's options. Several colours are separated by ";".
    numbers: the path of a file with numbers, for colour schemes that need one.
    place: the place of the frame in the run, from 1; 0 if there is no run.
    kind: one of KINDS.
    probe, tolerance: Å.
    density: vertices per Å² of a proxy, an even mesh without a bound on its distance from the surface; 0 for a mesh
    within the tolerance.
    cavities: one of CAVITIES."""

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
        """Returns the requested colours: schemes, colours, or EXPR=COLOR."""
        return [part.strip() for part in self.color.split(";") if part.strip()] or ["element"]

    def needs_program(self):
        """True for colours that only the program computes: schemes that need more than single atoms, and several
        rules."""
        (first, *more) = self.colors()
        return bool(more) or "=" in first or first != "kind" and dict(preparation_table.SCHEMES).get(first, False)

    def atoms_key(self):
        """Returns a text that is equal for requests about the same atoms of the same files."""
        return json.dumps([
            self.selection, self.color, self.frames, self.trajectory_atoms, self.preparation,
            *(stamp(path) for path in (self.file, self.trajectory, self.numbers))])

    def key(self, atoms=None, others=()):
        """Returns a text that is equal for requests with equal surfaces. atoms: the atoms that come from Blender, or
        None; others: further arrays of these atoms."""
        values = dataclasses.asdict(self)
        if self.kind == "VDW":
            values["probe"] = 0.0
        if self.density:
            values["tolerance"] = 0.0
        values["files"] = [stamp(self.file), stamp(self.trajectory), stamp(self.numbers)]
        if atoms is not None:
            values["atoms"] = _digest(atoms.positions, atoms.radii, atoms.colors, atoms.index, *atoms.numbers.values(),
                                      *others)
        return hashlib.sha256(json.dumps(values, sort_keys=True).encode()).hexdigest()

    def shape_key(self, atoms):
        """Returns a text that is equal for requests whose surfaces, including cavities, have the same triangles."""
        probe = 0.0 if self.kind == "VDW" else self.probe
        detail = ("density", self.density) if self.density else ("tolerance", self.tolerance)
        return json.dumps([self.kind, probe, *detail, _digest(atoms.positions, atoms.radii)])


def stamp(path):
    """Returns values that identify a file and its state: path, modification time in ns, and size. Returns the path
    alone if the file does not exist, and None for no path."""
    if not path or not os.path.exists(path):
        return path or None
    found = os.stat(path)
    return [path, found.st_mtime_ns, found.st_size]


def _digest(*arrays):
    digest = hashlib.blake2b(digest_size=16)
    for values in arrays:
        digest.update(np.ascontiguousarray(values))
    return digest.hexdigest()
