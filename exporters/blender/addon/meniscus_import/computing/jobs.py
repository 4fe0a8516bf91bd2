# SPDX-License-Identifier: GPL-3.0-or-later
"""The tasks of the other process, and threads that do one after another: surfaces as arrays of a mesh, frames of runs,
and other things that take time. Only the latest request of each object is computed."""

import collections
import threading

import numpy as np

from .. import attributes, mesh_arrays, sequence_reader
from . import engines
from .atoms import Atoms
from .request import Request


class Task:
    """A task for a thread. owner: identifies the object that needs the result. key: identifies the task. work: a
    function of the task that returns the result. urgency: waiting tasks are done in this order."""

    def __init__(self, owner, key, work, urgency=0):
        self.owner, self.key, self.work, self.urgency = owner, key, work, urgency
        self.result = self.error = None
        self.finished = threading.Event()
        self._unwanted = threading.Event()

    def report(self, stage):
        """Receives the name of the current stage for the user. It does nothing by default."""

    def cancel(self):
        self._unwanted.set()

    def check(self):
        """Raises engines.Cancelled if the result is no longer needed."""
        if self._unwanted.is_set():
            raise engines.Cancelled()

    @property
    def is_cancelled(self):
        return self._unwanted.is_set()

    def run(self):
        """Runs the task to its end, and sets result or error. A cancelled task has neither."""
        try:
            self.check()
            self.result = self.work(self)
            self.check()
        except engines.Cancelled:
            self.result = None
        except Exception as error:  # reported where the result is used
            self.error = error
        finally:
            self.finished.set()


class Worker:
    """A pool of threads that live while there are tasks. They do one task of each owner at a time."""

    def __init__(self, give, threads=1):
        """give: a function that receives each finished task on its thread, except cancelled ones. threads: their
        greatest number."""
        self._give, self._most = give, threads
        self._lock = threading.Lock()
        self._waiting = collections.OrderedDict()  # owner -> Task
        self._running = []
        self._threads = 0

    def submit(self, task):
        """Adds a task after waiting ones of the same urgency. A waiting task of the same owner is dropped, and a
        running one continues."""
        with self._lock:
            self._waiting.pop(task.owner, None)
            self._waiting[task.owner] = task
            if self._threads < self._most:
                self._threads += 1
                threading.Thread(target=self._work, name="meniscus", daemon=True).start()

    def cancel(self, owner):
        """Cancels the tasks of an owner. Returns True if there was one that waited or ran."""
        with self._lock:
            found = [
                task for task in (self._waiting.pop(owner, None), *self._running)
                if task is not None and task.owner == owner]
            for task in found:
                task.cancel()
            return bool(found)

    def _work(self):
        done = None
        while True:
            with self._lock:
                if done is not None:
                    self._running.remove(done)
                done = self._next()
                if done is None:
                    self._threads -= 1
                    return
                self._running.append(done)
            done.run()
            if not done.is_cancelled:
                self._give(done)

    def _next(self):
        """Removes and returns the most urgent waiting task whose owner has none running, or returns None."""
        busy = {task.owner for task in self._running}
        free = [task for task in self._waiting.values() if task.owner not in busy]
        return self._waiting.pop(min(free, key=lambda task: task.urgency).owner) if free else None


class Tools:
    """Tasks by name. Each takes a jobs.Task and plain values, and returns plain values and arrays."""

    def __init__(self, package, program, folder):
        """package, program: arguments of engines.find_tools(). folder: a folder for temporary files, or None."""
        self._named, self.folder = (package, program), folder
        self._found, self._finding = None, threading.Lock()
        self._manifests = sequence_reader.Manifests()

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
        """Returns a packed frame of the sequence with the manifest `path`. about: arguments of prepare()."""
        return sequence_reader.packed(sequence_reader.prepare(self._manifests.get(path), **about))

    def count(self, task, request):
        """Returns the number of frames in the run of a request."""
        return len(engines.read_atoms(self.tools, Request(**request), self.folder, task).numbers)
