# SPDX-License-Identifier: GPL-3.0-or-later
"""The tasks of the other process: surfaces as arrays of a mesh, frames of runs, and other things that take time."""

import threading

import numpy as np

from .. import attributes, frames, mesh_arrays
from . import engines
from .atoms import Atoms
from .request import Request


class Tools:
    """Tasks by name. Each takes a jobs.Task and plain values, and returns plain values and arrays."""

    def __init__(self, package, program, folder):
        """package, program: arguments of engines.find_tools(). folder: a folder for temporary files, or None."""
        self._named, self.folder = (package, program), folder
        self._found, self._finding = None, threading.Lock()
        self._manifests = frames.Manifests()

    @property
    def tools(self):
        with self._finding:  # finding the tools loads a library
            if self._found is None:
                self._found = engines.find_tools(*self._named)
            return self._found

    def describe_tools(self, _task):
        """Returns a dict about the tools that were found. version, library: version and path of libmeniscus, or "".
        missing: the reason why there is no library. program: the path of the program, or ""."""
        library = self.tools.library
        return {"version": library.version() if library else "", "library": library.library_path() if library else "",
                "missing": self.tools.missing, "program": self.tools.program or ""}

    def surface(self, task, request, atoms, others, scale, crisp):
        """Returns a dict that shows a request: header of the surface, middle of its atoms (Å), base that was subtracted
        from positions (Å), number of atoms, and arrays of its mesh. Returns None if there is nothing to show.

        request: the fields of a Request. atoms: the fields of an Atoms, or None. others: the fields of each
        attributes.Kept of these atoms. scale, crisp: arguments of mesh_arrays.of_surface()."""
        found = engines.compute(self.tools, Request(**request), atoms and Atoms(**atoms), self.folder, task)
        if found is None:
            return None
        task.check()
        task.report("Arrays")
        centers = found["atom.center"]
        middle = 0.5 * (centers.min(axis=0) + centers.max(axis=0))
        base = middle if atoms is None else np.zeros(3)  # atoms of Blender have its own coordinates
        arrays = mesh_arrays.of_surface(found, scale, crisp, mesh_arrays.names_of(found), base)
        made = {name for name, *_ in arrays.attributes}
        for each in (attributes.Kept(**other) for other in others if other["name"] not in made):
            arrays.attributes.append((each.name, each.kind, each.domain, attributes.spread(each, arrays)))
        return {"header": found.header, "middle": middle, "base": base, "atoms": len(centers), "arrays": vars(arrays)}

    def frame(self, _task, path, **about):
        """Returns a packed frame of the sequence with the manifest `path`. about: arguments of frames.prepare()."""
        return frames.packed(frames.prepare(self._manifests.get(path), **about))

    def count(self, task, request):
        """Returns the number of frames in the run of a request."""
        return len(engines.read_atoms(self.tools, Request(**request), self.folder, task).numbers)
