# SPDX-License-Identifier: BSD-3-Clause
"""libmeniscus by ctypes: where it is, its structs and functions as meniscus.h has them, its errors as exceptions."""
from __future__ import annotations

import ctypes
import numbers
import operator
import os
import pathlib
import reprlib
import sys
import threading
from ctypes import (POINTER, Structure, byref, c_char_p, c_double, c_float, c_int, c_int32, c_size_t, c_uint8, c_uint32,
                    c_uint64, c_void_p)
from typing import Any, Callable, Optional

import numpy as np

from ._errors import (CapacityError, Error, GpuError, InputError, InternalError, NotClosedError, OutputError,
                      UsageError)
from ._loading import why_not_loaded
from ._arguments import plain

NONE = 0xFFFFFFFF
SES, SAS, VDW = range(3)
CPU, AUTO, GPU, SOFTWARE = range(4)
DOUBLE, FLOAT = range(2)
PERSPECTIVE, ORTHOGRAPHIC = range(2)
(COMPONENTS, ATOM_AREAS, ATOM_SAS_AREAS, ATOMS, CONVEX, TOROIDAL, CONCAVE, PLANES, CONTACTS, CUTS, VERTICES, BORDERS,
 HALF_BORDERS, LOOPS, FACES) = range(15)
GRADIENT_AREA, GRADIENT_VOLUME, GRADIENT_SAS_AREA, GRADIENT_SAS_VOLUME = range(4)
POCKETS, POCKET_MOUTHS, POCKET_ATOMS, POCKET_PROBES = range(4)
(MESH_POSITIONS, MESH_NORMALS, MESH_TRIANGLES, MESH_TRIANGLE_ATOMS, MESH_TRIANGLE_KINDS, MESH_TRIANGLE_FACES,
 MESH_TRIANGLE_PATCHES, MESH_TRIANGLE_COMPONENTS, MESH_SHARP_CORNERS, MESH_SHARP_NORMALS, MESH_VERTEX_ATOMS) = range(11)

MESH_BY_PATCH, MESH_EVEN, MESH_BY_DENSITY = range(3)
HYDROGENS_AUTO, HYDROGENS_KEEP, HYDROGENS_DROP = range(3)
UNKNOWN_HALT, UNKNOWN_GUESS, UNKNOWN_SKIP = range(3)
(VALUE_FLAG, VALUE_NUMBER, VALUE_COUNT, VALUE_WORD, VALUE_TEXT, VALUE_FILE, VALUE_NEW_FILE, VALUE_CAMERA) = range(8)
(STRUCTURE_POSITIONS, STRUCTURE_RADII, STRUCTURE_ELEMENTS, STRUCTURE_INDICES, STRUCTURE_NAMES, STRUCTURE_RESIDUE_NAMES,
 STRUCTURE_CHAINS, STRUCTURE_SEGMENTS, STRUCTURE_RESIDUE_NUMBERS, STRUCTURE_INSERTION_CODES, STRUCTURE_ALTLOCS,
 STRUCTURE_RESIDUES, STRUCTURE_MODELS, STRUCTURE_COPIES, STRUCTURE_CHARGES, STRUCTURE_B_FACTORS, STRUCTURE_OCCUPANCIES,
 STRUCTURE_CLASSES, STRUCTURE_WARNINGS, STRUCTURE_HYDROPATHIES) = range(20)

OK, INTERNAL, USAGE, INPUT, NO_GPU, CAPACITY, OUTPUT, NOT_CLOSED = range(8)
_EXCEPTIONS = {INTERNAL: InternalError, USAGE: UsageError, INPUT: InputError, NO_GPU: GpuError,
               CAPACITY: CapacityError, OUTPUT: OutputError, NOT_CLOSED: NotClosedError}

# Lengths, areas and volumes of structs: the power of Å of their unit.
_POWERS = {"probe_radius": 1, "large_probe_radius": 1, "trim": 1, "mouth_tolerance": 1, "tolerance": 1, "height": 1,
           "min_volume": 3, "density": -2}


def whole_number(name: str, value: Any) -> int:
    """Of 32 bits, to which ctypes would cut a larger one without a word."""
    try:
        number = int(value) if isinstance(value, np.bool_) else operator.index(value)
    except TypeError:
        raise InputError(f"{name} is {reprlib.repr(value)}, not a whole number") from None
    if not -2**31 <= number < 2**31:
        raise InputError(f"{name} is {reprlib.repr(number)}, which 32 bits cannot count")
    return number


def positive(name: str, value: Any) -> int:
    number = whole_number(name, value)
    if number < 1:
        raise UsageError(f"{name} is {number}; it counts from 1")
    return number


def number(name: str, value: Any) -> float:
    """In Å, or a power of it, where that is what it counts."""
    plain_value = plain(value, name, _POWERS.get(name))
    single = isinstance(plain_value, numbers.Real) or getattr(plain_value, "ndim", None) == 0
    try:
        if single and np.asarray(plain_value).dtype.kind in "fiuO":  # O: fractions, and integers beyond 64 bits
            return float(plain_value)
    except (OverflowError, TypeError, ValueError):
        pass
    raise InputError(f"{name} is {reprlib.repr(value)}, not a number")


def flag(name: str, value: Any) -> bool:
    """Of True and False, or 1 and 0; other words would all be true."""
    if not isinstance(value, (bool, np.bool_, int, np.integer)) or value not in (0, 1):
        raise InputError(f"{name} is {reprlib.repr(value)}, neither True nor False")
    return bool(value)


def listed(name: str, values: Any, what: str) -> list[Any]:
    """Of what can be walked through and is not a text."""
    try:
        if not isinstance(values, (str, bytes)):
            return list(values)
    except TypeError:
        pass
    raise InputError(f"{name} is {reprlib.repr(values)}, not a list of {what}")


def text(name: str, value: Optional[str]) -> Optional[bytes]:
    """As C has it; None stays None."""
    if value is None:
        return None
    if not isinstance(value, str) or "\0" in value:
        raise InputError(f"{name} is {reprlib.repr(value)}, not a text without zeros")
    return value.encode("utf-8", "surrogateescape")


class _Given(Structure):
    """A struct whose numbers come from callers: each is looked at before ctypes makes something of it."""

    def __setattr__(self, name: str, value: Any) -> None:
        kind = next((field[1] for field in self._fields_ if field[0] == name), None)
        if kind is c_int32:
            value = whole_number(name, value)
        elif kind in (c_double, c_float):
            value = number(name, value)
        super().__setattr__(name, value)


class Options(_Given):
    _fields_ = [("size", c_size_t), ("probe_radius", c_double), ("kind", c_int32), ("device", c_int32),
                ("threads", c_int32), ("verify", c_int32)]


class Atoms(Structure):
    _fields_ = [("size", c_size_t), ("count", c_size_t), ("positions", c_void_p), ("radii", c_void_p),
                ("positions_stride", c_size_t), ("radii_stride", c_size_t), ("positions_type", c_int32),
                ("radii_type", c_int32), ("equal_radii", c_int32), ("reserved", c_int32)]


class Summary(Structure):
    _fields_ = [("size", c_size_t), ("area", c_double), ("volume", c_double), ("probe_radius", c_double),
                ("grown_by", c_double), ("atoms", c_uint64), ("convex", c_uint64), ("toroidal", c_uint64),
                ("concave", c_uint64), ("free_edges", c_uint64), ("spindle", c_uint64), ("fixed_probes", c_uint64),
                ("arcs", c_uint64), ("faces", c_uint64), ("borders", c_uint64), ("vertices", c_uint64),
                ("components", c_uint64), ("cavities", c_uint64), ("device", c_char_p),
                ("exact_within", c_double)]


COUNTS = [field[0] for field in Summary._fields_ if field[1] is c_uint64]


class Array(Structure):
    _fields_ = [("data", c_void_p), ("count", c_size_t), ("stride", c_size_t)]


class Component(Structure):
    _fields_ = [("kind", c_uint8), ("area", c_double), ("volume", c_double), ("euler", c_int32)]


class Ball(Structure):
    _fields_ = [("center", c_double * 3), ("radius", c_double)]


class Plane(Structure):
    _fields_ = [("normal", c_double * 3), ("offset", c_double)]


class Convex(Structure):
    _fields_ = [(name, c_uint32) for name in ("atom", "first_plane", "plane_count", "first_face", "face_count")]


class Toroidal(Structure):
    _fields_ = [("atom", c_uint32 * 2), ("probe", c_uint32 * 2), ("center", c_double * 3), ("axis", c_double * 3),
                ("radius", c_double), ("start", c_double * 3), ("sweep", c_double), ("first_face", c_uint32),
                ("face_count", c_uint32), ("has_piece", c_uint8 * 2)]


class Concave(Structure):
    _fields_ = [("center", c_double * 3)] + [
        (name, c_uint32) for name in ("first_contact", "contact_count", "first_plane", "side_count", "cut_count",
                                      "other_count", "first_cut", "first_face", "face_count")]


class Border(Structure):
    _fields_ = [("kind", c_uint8), ("center", c_double * 3), ("axis", c_double * 3), ("radius", c_double),
                ("start", c_double * 3), ("sweep", c_double), ("vertex", c_uint32 * 2), ("face", c_uint32 * 2)]


class Loop(Structure):
    _fields_ = [("first_half_border", c_uint32), ("half_border_count", c_uint32)]


class Face(Structure):
    _fields_ = [("kind", c_uint8), ("patch", c_uint32), ("first_loop", c_uint32), ("loop_count", c_uint32),
                ("component", c_uint32), ("tip", c_uint32), ("area", c_double)]


class ReadOptions(_Given):
    _fields_ = [("size", c_size_t), ("select", c_char_p), ("assembly", c_char_p), ("altloc", c_char_p),
                ("radii", c_char_p), ("radii_files", c_void_p), ("radius", c_void_p), ("radii_file_count", c_size_t),
                ("radius_count", c_size_t), ("model", c_int32), ("hydrogens", c_int32), ("unknown_element", c_int32),
                ("keep_water", c_int32), ("keep_ions", c_int32), ("reserved", c_int32)]


class ReadReport(Structure):
    _fields_ = [("size", c_size_t), ("file", c_char_p), ("format", c_char_p), ("radii_set", c_char_p),
                ("sentence", c_char_p), ("read", c_uint64), ("atoms", c_uint64), ("models", c_uint64)]


class MeshOptions(_Given):
    _fields_ = [("size", c_size_t), ("method", c_int32), ("split_colors", c_int32), ("tolerance", c_double),
                ("density", c_double)]


class PocketOptions(_Given):
    _fields_ = [("size", c_size_t), ("large_probe_radius", c_double), ("trim", c_double), ("min_volume", c_double),
                ("mouth_tolerance", c_double)]


class PocketRow(Structure):
    _fields_ = [("volume", c_double), ("volume_excess", c_double), ("area", c_double), ("mouth_area", c_double),
                ("depth", c_double), ("middle", c_double * 3), ("first_mouth", c_uint32), ("mouth_count", c_uint32),
                ("first_atom", c_uint32), ("atom_count", c_uint32), ("first_probe", c_uint32),
                ("probe_count", c_uint32)]


class MeshFile(_Given):
    _fields_ = [("size", c_size_t), ("format", c_char_p), ("attributes", c_char_p), ("atom_colors", c_void_p),
                ("scale", c_double), ("color", c_float * 3), ("replace", c_int32)]


class CameraStruct(_Given):
    _fields_ = [("size", c_size_t), ("position", c_double * 3), ("target", c_double * 3), ("up", c_double * 3),
                ("vertical_fov", c_double), ("height", c_double), ("projection", c_int32), ("reserved", c_int32)]


class Property(Structure):
    _fields_ = [("name", c_char_p), ("key", c_char_p), ("value", c_char_p), ("help", c_char_p), ("words", c_char_p),
                ("initial", c_char_p), ("lowest", c_double), ("highest", c_double), ("type", c_int32),
                ("repeatable", c_int32), ("of_surface", c_int32), ("reserved", c_int32)]


# Functions that fail: their arguments. All return a status.
_CALLS: dict[str, list[Any]] = {
    "element_of_symbol": [c_char_p, POINTER(c_int32)],
    "element_radius": [c_int32, POINTER(c_double), POINTER(c_char_p)],
    "default_options": [POINTER(Options)],
    "computer_new": [POINTER(Options), POINTER(c_void_p)],
    "compute": [c_void_p, POINTER(Atoms), POINTER(c_void_p)],
    "surface_summary": [c_void_p, POINTER(Summary)],
    "surface_table": [c_void_p, c_int32, POINTER(Array)],
    "surface_distance": [c_void_p, c_size_t, c_void_p, c_void_p, c_void_p],
    "surface_gradient": [c_void_p, c_int32, c_void_p, c_void_p],
    "default_read_options": [POINTER(ReadOptions)],
    "read": [c_char_p, POINTER(ReadOptions), POINTER(c_void_p)],
    "structure_report": [c_void_p, POINTER(ReadReport)],
    "structure_table": [c_void_p, c_int32, POINTER(Array)],
    "structure_colors": [c_void_p, c_char_p, c_void_p],
    "default_pocket_options": [POINTER(PocketOptions)],
    "surface_pockets": [c_void_p, POINTER(PocketOptions), POINTER(c_void_p)],
    "pockets_table": [c_void_p, c_int32, POINTER(Array)],
    "default_mesh_options": [POINTER(MeshOptions)],
    "surface_mesh": [c_void_p, POINTER(MeshOptions), POINTER(c_void_p)],
    "mesh_table": [c_void_p, c_int32, POINTER(Array)],
    "default_mesh_file": [POINTER(MeshFile)],
    "mesh_save": [c_void_p, c_char_p, POINTER(MeshFile)],
    "surface_camera": [c_void_p, c_double, c_int32, POINTER(CameraStruct)],
    "scene_new": [POINTER(c_void_p)],
    "scene_read": [c_char_p, POINTER(c_void_p)],
    "scene_parse": [c_char_p, POINTER(c_void_p)],
    "scene_set": [c_void_p, c_char_p, c_char_p],
    "scene_get": [c_void_p, c_char_p, c_size_t, POINTER(c_char_p)],
    "scene_json": [c_void_p, c_char_p, POINTER(c_char_p)],
    "scene_size": [c_void_p, POINTER(c_int32), POINTER(c_int32)],
    "scene_properties": [POINTER(Array)],
    "scene_page": [c_void_p, POINTER(c_void_p)],
    "surface_page": [c_void_p, c_void_p, c_void_p, POINTER(CameraStruct), c_void_p, POINTER(c_void_p)],
    "page_html": [c_void_p, POINTER(c_char_p), POINTER(c_size_t)],
    "renderer_new": [c_int32, POINTER(c_void_p)],
    "render_scene": [c_void_p, c_void_p, c_void_p, c_size_t],
    "render": [c_void_p, c_void_p, c_void_p, POINTER(CameraStruct), c_void_p, c_void_p, c_size_t],
}
_RELEASES = ("computer_release", "structure_release", "surface_release", "pockets_release", "mesh_release",
             "page_release", "renderer_release", "scene_release")


def _place() -> str:
    """Of the library: what MENISCUS_LIBRARY names, the file beside this one, or what the system has."""
    named = os.environ.get("MENISCUS_LIBRARY")
    if named:
        return named
    own = {"win32": "meniscus.dll", "darwin": "libmeniscus.dylib"}.get(sys.platform, "libmeniscus.so")
    beside = pathlib.Path(__file__).with_name(own)
    if beside.exists():
        return str(beside)
    if sys.platform == "linux":
        return "libmeniscus.so.0"
    import ctypes.util  # which takes its time
    return ctypes.util.find_library("meniscus") or own


def _open() -> tuple[ctypes.CDLL, str]:
    place = _place()
    try:
        return ctypes.CDLL(place), place
    except OSError as error:
        raise ImportError("libmeniscus cannot be loaded: " + why_not_loaded(place, error)) from None


class _Library:
    """The library with its prototypes, opened when it is first needed."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._dll: Optional[ctypes.CDLL] = None
        self.path = ""

    def dll(self) -> ctypes.CDLL:
        if self._dll is None:
            with self._lock:
                if self._dll is None:
                    self._dll = self._prepared()
        return self._dll

    def _prepared(self) -> ctypes.CDLL:
        dll, self.path = _open()
        prototypes: list[tuple[str, list[Any], Any]] = [(name, arguments, c_int) for name, arguments in _CALLS.items()]
        prototypes += [(name, [c_void_p], None) for name in _RELEASES]
        prototypes += [(name, [], c_char_p) for name in ("version", "last_error")]
        for name, arguments, result in prototypes:
            try:
                function = getattr(dll, "meniscus_" + name)
            except AttributeError:
                raise ImportError(f"{self.path} has no meniscus_{name}(): it is not libmeniscus, or of another version "
                                  "than this package; install both of one version") from None
            function.argtypes, function.restype = arguments, result
        return dll


_library = _Library()


def call(name: str, *arguments: Any) -> None:
    """Calls meniscus_NAME; other threads of Python go on meanwhile. Raises what its status means."""
    dll = _library.dll()
    status = getattr(dll, "meniscus_" + name)(*arguments)
    if status != OK:
        raise _EXCEPTIONS.get(status, Error)(dll.meniscus_last_error().decode("utf-8", "replace"))


def default(name: str, struct: Any) -> Any:
    """The struct with the library's defaults, by meniscus_default_NAME."""
    struct.size = ctypes.sizeof(struct)
    call("default_" + name, byref(struct))
    return struct


class Handle:
    """One reference to an object of the library, released when Python no longer holds it."""

    def __init__(self, kind: str, make: str, *arguments: Any) -> None:
        """The last argument of meniscus_MAKE takes the object."""
        self.pointer: c_void_p = c_void_p()
        self._release: Callable[[c_void_p], None] = getattr(_library.dll(), f"meniscus_{kind}_release")
        call(make, *arguments, byref(self.pointer))

    def __del__(self) -> None:
        # When Python ends the names of this module may be gone already.
        if self.pointer:
            self._release(self.pointer)
            self.pointer.value = None


def version() -> str:
    """That of the library, which is meniscus.__version__, too.

    >>> meniscus.version() == meniscus.__version__
    True"""
    return str(_library.dll().meniscus_version().decode())


def library_path() -> str:
    """The file or name that was loaded.

    >>> "meniscus" in meniscus.library_path()
    True"""
    _library.dll()
    return _library.path


def word(name: str, given: str, words: dict[str, int]) -> int:
    """The constant that a word means."""
    if not isinstance(given, str) or given not in words:
        raise UsageError(f"{name} is {reprlib.repr(given)}, none of {', '.join(words)}")
    return words[given]


GRADIENTS = {"area": GRADIENT_AREA, "volume": GRADIENT_VOLUME, "sas_area": GRADIENT_SAS_AREA,
             "sas_volume": GRADIENT_SAS_VOLUME}
KINDS = {"ses": SES, "sas": SAS, "vdw": VDW}
DEVICES = {"cpu": CPU, "auto": AUTO, "gpu": GPU, "software": SOFTWARE}
HYDROGENS = {"auto": HYDROGENS_AUTO, "keep": HYDROGENS_KEEP, "drop": HYDROGENS_DROP}
UNKNOWN_ELEMENTS = {"halt": UNKNOWN_HALT, "guess": UNKNOWN_GUESS, "skip": UNKNOWN_SKIP}
PROJECTIONS = {"perspective": PERSPECTIVE, "orthographic": ORTHOGRAPHIC}
