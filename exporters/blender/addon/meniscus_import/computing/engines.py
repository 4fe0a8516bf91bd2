# SPDX-License-Identifier: GPL-3.0-or-later
"""The engines that compute surfaces: libmeniscus through its Python package, or the program meniscus."""

import dataclasses
import importlib
import importlib.util
import os
import shutil
import re
import subprocess
import sys
import tempfile
import threading

import numpy as np

from .. import joined, mns_reader
from . import atoms as atom_files
from . import preparation

#: The kind of a surface in a request -> the value of the program's option.
SURFACES = {"SES": "ses", "SAS": "sas", "VDW": "vdw"}
ERROR_PREFIX = "meniscus: error: "
POLL = 0.05  # s between two checks if the program has ended and if its result is still needed

#: Options of the program -> labels of fields of the panel, or of values of fields.
FIELDS = {
    "--select": "Selection", "--color": "Colour", "--surface": "Surface", "--probe": "Probe",
    "--tolerance": "Tolerance", "--density": "Density", "--trajectory": "Trajectory",
    "--trajectory-atoms": "Trajectory's atoms", "--frames": "Frames", "--cavities": "Cavities",
    "--color-by-file": "Numbers", **{preparation.option_of(row): preparation.label_of(row) for row in preparation.ROWS}}
#: Options in the spelling of libmeniscus.
OF_LIBRARY = re.compile(r"\A(?:select|%s)(?=: )|\b(?:keep_water|keep_ions|unknown_element)\b|(?<=another )color\b" %
                        "|".join(map(preparation.name_of, preparation.OF_MOLECULE)))
OPTION = re.compile(r"(?<![\w/-])--([a-z][a-z0-9]*(?:-[a-z0-9]+)*)")


def for_panel(text):
    """Returns a message with labels of fields in place of options. Options without a field are quoted without dashes,
    and the message explains them."""
    lacking = []

    def field(found):
        name = FIELDS.get(found.group(0))
        if name is None and found.group(1) not in lacking:
            lacking.append(found.group(1))
        return name or f"\"{found.group(1)}\""

    text = OF_LIBRARY.sub(lambda found: "--" + found.group(0).replace("_", "-"), text)
    worded = OPTION.sub(field, text)
    if not lacking:
        return worded
    return (f"{worded} ({', '.join(lacking)}: {'an option' if len(lacking) == 1 else 'options'} "
            "of the program meniscus that this panel does not have)")


class EngineError(mns_reader.MnsError):
    """The program or the library is missing, or reported an error. The text is one sentence in the terms of the
    panel."""

    def __init__(self, text):
        super().__init__(for_panel(text))


class Cancelled(Exception):
    """The result of a task is no longer needed."""


class Tools:
    """The tools that compute. library: the package meniscus with libmeniscus, or None. program: the path of the
    program, or None. missing: the reason why there is no library."""

    def __init__(self, library, program, missing=""):
        self.library, self.program, self.missing = library, program, missing

    def needed_program(self, purpose, instead=""):
        """Returns the path of the program, or raises EngineError. purpose: the task that needs it; instead: an
        alternative that does not, both as parts of the message."""
        if self.program is None:
            raise EngineError(
                f"{purpose} needs the program meniscus, which is not found; name it in the add-on's "
                f"preferences{instead}")
        return self.program

    def program_for_files(self):
        """Returns the path of the program for reading a file without the library, or raises EngineError."""
        return self.needed_program(f"without libmeniscus ({self.missing}) a file")


def find_tools(package="", program=""):
    """Returns the Tools. package: the folder of the Python package; "" searches where Python does. program: the path of
    the program; "" searches where the shell does."""
    library, missing = None, ""
    try:
        library = _import(package)
        library.version()  # loads libmeniscus
    except Exception as error:  # the package and the loader may raise anything
        library, missing = None, str(error) or type(error).__name__
    found = shutil.which(program or "meniscus")
    return Tools(library, found and os.path.abspath(found), missing)


def _import(folder):
    if not folder:
        return importlib.import_module("meniscus")
    known = sys.modules.get("meniscus")
    file = os.path.join(folder, "__init__.py")
    if known is not None and getattr(known, "__file__", None) == file:
        return known
    spec = importlib.util.spec_from_file_location("meniscus", file, submodule_search_locations=[folder])
    if spec is None or not os.path.exists(file):
        raise ImportError(f"{folder}: no Python package")
    module = importlib.util.module_from_spec(spec)
    sys.modules["meniscus"] = module  # the module's own imports look for it there
    try:
        spec.loader.exec_module(module)
    except BaseException:
        del sys.modules["meniscus"]
        raise
    return module


def surface_by_library(library, atoms, request, task):
    """Returns a mns_reader.Surface of atoms.Atoms with all components. Raises EngineError with the library's
    message."""
    if not len(atoms):
        raise EngineError("there are no atoms")
    key = request.shape_key(atoms)
    shape = _shapes.get(key)
    if shape is None:
        shape = _call(library, _shape, library, atoms, request, task)
        with _reading:
            while len(_shapes) >= MOST_SHAPES:
                del _shapes[next(iter(_shapes))]
            _shapes[key] = shape
    task.check()
    return _painted(shape, atoms)


def _shape(library, atoms, request, task):
    """Returns header and arrays like those of a .mns file, without the arrays of atoms."""
    task.report("Surface")
    made = library.surface(atoms.positions, atoms.radii, request.probe, kind=SURFACES[request.kind])
    task.check()
    task.report("Mesh")
    mesh = made.mesh(density=request.density) if request.density else made.mesh(request.tolerance)
    vertices = mesh.vertices
    origin = 0.5 * (vertices.min(axis=0) + vertices.max(axis=0))
    arrays = {
        "mesh.position": (vertices - origin).astype(np.float32), "mesh.normal": mesh.normals.astype(np.float32),
        "mesh.triangle": mesh.triangles, "mesh.kind": mesh.triangle_kinds, "mesh.patch": mesh.triangle_patches,
        "mesh.component": mesh.triangle_components, "mesh.atom": mesh.triangle_atoms,
        "mesh.sharp_corner": mesh.sharp_corners, "mesh.sharp_corner_normal": mesh.sharp_normals.astype(np.float32),
        "mesh.sharp_edge": np.empty((0, 2), np.uint32), **measures_of(library, made, mesh)}
    header = {
        "generator": f"libmeniscus {library.version()}",
        "device": made.device,
        "unit": "angstrom",
        "name": "surface",
        "probe_radius": made.probe,
        "area": made.area,
        "volume": made.volume,
        "mesh": {
            "origin": [float(value) for value in origin], "vertices": len(vertices), "triangles": len(mesh.triangles),
            "closed": True, "tolerance": 0.0 if request.density else request.tolerance},
        "components": [{
            "kind": "cavity" if part["kind"] else "outer", "area": float(part["area"]), "volume": float(part["volume"]),
            "euler": int(part["euler"])} for part in made.components]}
    return header, arrays


#: Points nearer than this (Å) to the axis of a spindle torus get the curvature at this distance, as in Meniscus.
CORE = 0.001


def measures_of(library, made, mesh):
    """Returns arrays by their names in .mns files. made, mesh: a surface and a mesh of the package `library`."""
    mean, gaussian = curvatures(made, mesh)
    arrays = {"mesh.mean_curvature": mean, "mesh.gaussian_curvature": gaussian}
    try:
        arrays["atom.area"] = made.atom_areas.astype(np.float32)
        arrays["atom.accessible_area"] = (made.atom_sas_areas.astype(np.float32) if made.kind == "ses" else
                                          arrays["atom.area"])
    except library.Error:
        pass  # the areas of the atoms do not add up, so they are left out rather than wrong
    return arrays


def curvatures(made, mesh):
    """Returns the mean and the Gaussian curvature at vertices, in 1/Å and 1/Å². Among the patches of a vertex's
    triangles, the one that it lies on counts."""
    corner, x = mesh.triangles.ravel(), mesh.vertices
    kind, patch = np.repeat(mesh.triangle_kinds, 3), np.repeat(mesh.triangle_patches, 3)
    # The principal curvatures, and the distance from the surface of the patch in Å.
    along, around, off = (np.zeros(len(corner)) for _ in range(3))
    patches, balls = made.patches, made.balls
    convex, torus, concave = (np.flatnonzero(kind == which) for which in range(3))
    if len(convex):
        atom = patches.convex["atom"][patch[convex]]
        radius = balls["radius"][atom]
        along[convex] = around[convex] = 1.0 / radius
        off[convex] = np.abs(np.linalg.norm(x[corner[convex]] - balls["center"][atom], axis=1) - radius)
    if len(torus):
        rows = patches.toroidal[patch[torus]]
        offset = x[corner[torus]] - rows["center"]
        height = np.einsum("nx,nx->n", offset, rows["axis"])
        out = np.linalg.norm(offset - height[:, None] * rows["axis"], axis=1)
        along[torus] = -1.0 / made.probe
        around[torus] = (rows["radius"] - out) / made.probe / np.maximum(out, CORE)
        off[torus] = np.abs(np.hypot(rows["radius"] - out, height) - made.probe)
    if len(concave):
        along[concave] = around[concave] = -1.0 / made.probe
        off[concave] = np.abs(
            np.linalg.norm(x[corner[concave]] - patches.concave["center"][patch[concave]], axis=1) - made.probe)
    # The last assignment to a vertex counts: that of the nearest patch, and of equally near ones the first.
    order = np.lexsort((-np.arange(len(corner)), -np.round(off, 6)))
    mean, gaussian = (np.zeros(len(x), dtype=np.float32) for _ in range(2))
    mean[corner[order]] = 0.5 * (along + around)[order]
    gaussian[corner[order]] = (along * around)[order]
    return mean, gaussian


def _painted(shape, atoms):
    """Returns the surface of a shape with the current atoms, so that a change of colours needs no computation."""
    header, arrays = shape
    header = {**header, "source": {"file": atoms.source}, "chain_names": atoms.chain_names, **atoms.names}
    if atoms.kind_colors is not None:
        header["kind_colors"] = atoms.kind_colors
    arrays = {
        **arrays, "atom.center": np.asarray(atoms.positions,
                                            np.float64), "atom.radius": np.asarray(atoms.radii, np.float64),
        "atom.color": np.asarray(atoms.colors, np.float32), "atom.index": np.asarray(atoms.index), **atoms.numbers}
    surface = mns_reader.Surface(f"{atoms.source or 'atoms'} in memory", header, arrays)
    surface.known_closed = True  # surfaces of the library are always closed
    return surface


def surface_by_program(tools, request, folder, task):
    """Returns a mns_reader.Surface of a request about a file. folder: a folder for temporary files. Raises
    EngineError."""
    program = tools.program_for_files()
    task.report("Program")
    with tempfile.TemporaryDirectory(dir=folder, prefix="surface_") as inner:
        target = os.path.join(inner, "run" if request.place else "surface.mns")
        words = [
            program, "export", "blender", request.file, *_atom_options(request), "--surface", SURFACES[request.kind],
            f"--probe={request.probe!r}",
            f"--density={request.density!r}" if request.density else f"--tolerance={request.tolerance!r}", "--force",
            "-q", "-o", target]
        if request.kind == "VDW":
            words.remove(f"--probe={request.probe!r}")
        if request.place:
            number = read_atoms(tools, request, folder, task).numbers[request.place - 1]
            words += [*_run_options(request, str(number))]
        _run(words, task)
        if request.place:
            target = next(os.path.join(target, name) for name in os.listdir(target) if name.endswith(".mns"))
        file = mns_reader.read(target)
    if len(file.objects) != 1 or len(file.objects[0].copies) != 1:
        raise EngineError(f"{request.file}: {len(file.objects)} objects instead of one")
    return file.objects[0]


def read_atoms(tools, request, folder, task):
    """Returns the atoms.AtomFile of a request about a file, with all frames of its run if it has a place there. The
    last files are kept."""
    if request.needs_program():  # the colours belong to the surface, not to the atoms
        request = dataclasses.replace(request, color="element", numbers="")
    key = (request.atoms_key(), request.place > 0)
    with _reading:
        if key not in _files:
            task.report("Frames" if request.place else "Atoms")
            found = _fresh_atoms(tools, request, folder, task)
            while len(_files) >= MOST_FILES:
                del _files[next(iter(_files))]
            _files[key] = found
        return _files[key]


def _fresh_atoms(tools, request, folder, task):
    """Reads atoms by the library or, for trajectories and prepared frames, by the program."""
    prepared = preparation.run_names(request.preparation)
    if tools.library is not None and not request.trajectory and not prepared:
        return _call(tools.library, atom_files.read_molecule, tools.library, request)
    if request.trajectory:
        program = tools.needed_program("a trajectory", ", or read it by Molecular Nodes and take its atoms")
    elif prepared:
        program = tools.needed_program(f"--{prepared[0]}")
    else:
        program = tools.program_for_files()
    descriptor, path = tempfile.mkstemp(dir=folder, prefix="atoms_")
    os.close(descriptor)
    try:
        run = _run_options(request, request.frames or "all") if request.place else []
        _run([program, "export", "atoms", request.file, *_atom_options(request), *run, "--force", "-q", "-o", path],
             task)
        return atom_files.read(path)
    finally:
        os.remove(path)  # a mapped file stays readable


#: Files that were read and shapes that were computed, by the keys of their requests, the oldest first.
_files, _shapes = {}, {}
_reading = threading.Lock()
MOST_FILES, MOST_SHAPES = 4, 4


def forget():
    with _reading:
        _files.clear()
        _shapes.clear()


def _call(library, work, *arguments):
    """Returns work(*arguments). Raises EngineError with the message of the library or of a file."""
    try:
        return work(*arguments)
    except (library.Error, mns_reader.MnsError) as error:
        raise EngineError(str(error).splitlines()[0]) from None  # further lines mark a place in a selection


def _atom_options(request):
    words = [f"--color={color}" for color in request.colors()]
    if request.numbers:
        words.append(f"--color-by-file={request.numbers}")
    if request.selection:
        words.append(f"--select={request.selection}")
    return words + preparation.program_words(request.preparation, False)


def _run_options(request, frames):
    words = [f"--frames={frames}"]
    if request.trajectory:
        words.append(f"--trajectory={request.trajectory}")
        if request.trajectory_atoms:
            words.append(f"--trajectory-atoms={request.trajectory_atoms}")
    return words + preparation.program_words(request.preparation, True)


def _run(words, task):
    """Runs the program to its end, or kills it when its result is no longer needed. Raises EngineError with its
    message, or Cancelled."""
    with tempfile.TemporaryFile() as log:
        child = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=log)
        try:
            while True:
                try:
                    code = child.wait(POLL)
                    break
                except subprocess.TimeoutExpired:
                    task.check()
        finally:
            if child.poll() is None:
                child.kill()
                child.wait()
        if code:
            log.seek(0)
            lines = log.read().decode("utf-8", "replace").strip().splitlines() or [f"{words[0]} ended with {code}"]
            errors = [line[len(ERROR_PREFIX):] for line in lines if line.startswith(ERROR_PREFIX)]
            raise EngineError(errors[0] if errors else lines[-1])


def compute(tools, request, atoms, folder, task):
    """Returns the mns_reader.Surface of a request, or None if it asks for parts that do not exist, such as cavities.
    atoms: atoms that come from Blender, or None for those of the request's file. folder: a folder for temporary files.
    """
    surface = _all_of_it(tools, request, atoms, folder, task)
    if request.cavities == "KEEP":
        return surface
    return dict(joined.by_role(surface)).get("cavities" if request.cavities == "ONLY" else "outer")


def _all_of_it(tools, request, atoms, folder, task):
    if tools.library is None:
        if atoms is not None:
            raise EngineError(f"atoms of Blender need libmeniscus: {tools.missing}")
        return surface_by_program(tools, request, folder, task)
    if atoms is None and request.needs_program():
        tools.needed_program(f"the colour {request.color}")
        return surface_by_program(tools, request, folder, task)
    if atoms is None:
        file = read_atoms(tools, request, folder, task)
        atoms = _call(tools.library, file.frame, request.place) if request.place else file.atoms
    return surface_by_library(tools.library, atoms, request, task)
