# SPDX-License-Identifier: GPL-3.0-or-later
"""What is asked for: a surface of which atoms, how, and meshed how finely. Plain values, which any thread may read."""

import dataclasses
import hashlib
import json
import os

KINDS = ("SES", "SAS", "VDW")


@dataclasses.dataclass(frozen=True)
class Request:
    """file: of a molecule, an absolute path; "": atoms come from Blender. trajectory, frames: of a run, as the program takes
    them; "" for none. selection, color: likewise. place: in the run, from 1; 0: none. probe, tolerance: Å."""

    file: str = ""
    trajectory: str = ""
    frames: str = ""
    selection: str = ""
    color: str = "element"
    place: int = 0
    kind: str = "SES"
    probe: float = 1.4
    tolerance: float = 0.05

    def atoms_key(self):
        """Text that two requests share if they are about the same atoms of the same files."""
        return json.dumps([self.selection, self.color, self.frames, *(stamp(path) for path in (self.file, self.trajectory))])

    def key(self, atoms=None):
        """Text that two requests share if their surfaces are the same. atoms: those that come from Blender."""
        values = dataclasses.asdict(self)
        if self.kind == "VDW":
            values["probe"] = 0.0
        values["files"] = [stamp(self.file), stamp(self.trajectory)]
        if atoms is not None:
            values["atoms"] = fingerprint(atoms)
        return hashlib.sha256(json.dumps(values, sort_keys=True).encode()).hexdigest()


def stamp(path):
    """Which file this is, in which state; None for none."""
    if not path or not os.path.exists(path):
        return path or None
    found = os.stat(path)
    return [path, found.st_mtime_ns, found.st_size]


def fingerprint(atoms):
    digest = hashlib.blake2b(digest_size=16)
    for values in (atoms.positions, atoms.radii, atoms.colors, atoms.index):
        digest.update(values.tobytes())
    return digest.hexdigest()
