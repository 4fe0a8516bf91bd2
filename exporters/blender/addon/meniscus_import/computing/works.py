# SPDX-License-Identifier: GPL-3.0-or-later
"""The tasks of the other process: surfaces as arrays of a mesh, frames of runs, and whatever takes time."""

import threading

import numpy as np

from .. import attributes, frames, mesh_arrays
from . import engines
from .atoms import Atoms
from .request import Request


class Tools:
    """Works by name. Each takes a task and plain values, and gives back plain values and arrays."""

    def __init__(self, package, program, folder):
        """package, program: as of engines.find_tools. folder: for files that go again, or None."""
        self._named, self.folder = (package, program), folder
        self._found, self._finding = None, threading.Lock()
        self._manifests = frames.Manifests()

    @property
    def tools(self):
        with self._finding:  # it loads a library
            if self._found is None:
                self._found = engines.find_tools(*self._named)
            return self._found

    def told(self, _task):
        """version and library: what is loaded, "" for nothing; missing: why; program: its path or ""."""
        library = self.tools.library
        return {"version": library.version() if library else "", "library": library.library_path() if library else "",
                "missing": self.tools.missing, "program": self.tools.program or ""}

    def surface(self, task, request, atoms, others, scale, crisp):
        """What shows a request: header of the surface, middle of its atoms and what was taken from positions in Å, how many atoms,
        arrays of its mesh; None for nothing to see.
        request: fields of a Request. atoms: those of an Atoms, or None. others: of attributes.Kept, attributes of these atoms.
        scale, crisp: as of mesh_arrays.of_surface."""
        found = engines.compute(self.tools, Request(**request), atoms and Atoms(**atoms), self.folder, task)
        if found is None:
            return None
        task.check()
        task.say("Arrays")
        centers = found["atom.center"]
        middle = 0.5 * (centers.min(axis=0) + centers.max(axis=0))
        base = middle if atoms is None else np.zeros(3)  # atoms of Blender stand in its own coordinates
        arrays = mesh_arrays.of_surface(found, scale, crisp, mesh_arrays.names_of(found), base)
        made = {name for name, *_ in arrays.attributes}
        for each in (attributes.Kept(**other) for other in others if other["name"] not in made):
            arrays.attributes.append((each.name, each.kind, each.domain, attributes.spread(each, arrays)))
        return {"header": found.header, "middle": middle, "base": base, "atoms": len(centers), "arrays": vars(arrays)}

    def frame(self, _task, path, **about):
        """A frame of the sequence with the manifest `path`, packed; about: as of frames.prepare."""
        return frames.packed(frames.prepare(self._manifests.get(path), **about))

    def count(self, task, request):
        """How many frames the run of a request has."""
        return len(engines.read_atoms(self.tools, Request(**request), self.folder, task).numbers)
