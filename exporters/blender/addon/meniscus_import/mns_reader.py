# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads and checks .mns files (FORMAT.md of Meniscus), and checks values of headers and manifests before they are used.
Uses numpy only, not Blender."""

import json
import mmap
import os
import reprlib
import struct
import zlib

import numpy as np

#: Larger numbers have no finite square, or none that Blender's single precision can hold after scaling.
TOO_LARGE = 1e30
#: Returns a shortened text of a value for messages.
shortened = reprlib.repr


def is_number(value, low=-TOO_LARGE, high=TOO_LARGE):
    """Returns True if a value is a finite number from low to high. Booleans are not numbers."""
    return type(value) in (int, float) and low <= value <= high


def are_numbers(values, count, low=-TOO_LARGE, high=TOO_LARGE):
    """Returns True if a value is a list of `count` numbers from low to high."""
    return isinstance(values, list) and len(values) == count and all(is_number(value, low, high) for value in values)


def is_text(value):
    """Returns True if a value is a text that Blender accepts: without zero characters and lone surrogates."""
    return isinstance(value, str) and not any(each == "\0" or "\ud800" <= each <= "\udfff" for each in value)


def _number(low, high, words):
    return lambda value: is_number(value, low, high), words


def _list_of(count, words):
    return lambda value: isinstance(value, list) and len(value) > 0 and all(are_numbers(each, count)
                                                                            for each in value), words


#: Pairs of a test and a description of the values that pass it.
TEXT = (is_text, "a text")
TEXTS = (lambda value: isinstance(value, list) and all(map(is_text, value)), "a list of texts")
DICT = (lambda value: isinstance(value, dict), "an object")
NUMBER = _number(-TOO_LARGE, TOO_LARGE, "a number")
SHARE = _number(0.0, 1.0, "a number from 0 to 1")
POSITIVE = _number(1e-9, 1e9, "a number above 0")
SHININESS = _number(1.0, 1000.0, "a number from 1 to 1000")
VECTOR = (lambda value: are_numbers(value, 3), "three numbers")
PLANES = _list_of(4, "a list of planes, each a normal and an offset")
DIRECTIONS = _list_of(3, "a list of directions")
COLOR = (lambda value: are_numbers(value, 3, 0.0, 1.0), "three numbers from 0 to 1")
COLORS = (lambda value: isinstance(value, list) and len(value) == 3 and all(map(COLOR[0], value)), "three colours")
SIZE = (lambda value: are_numbers(value, 2, 1, 65536) and all(type(each) is int
                                                              for each in value), "two whole numbers from 1 to 65536")
SOURCE = {"source": DICT, "source.file": TEXT}
#: The key of a camera's field of view by its projection, the keys of its vectors, and the tests of all keys.
SIZES = {"perspective": "vertical_fov", "orthographic": "height"}
VECTORS = ("position", "target", "up")
CAMERA = {
    **{key: VECTOR for key in VECTORS}, "size": SIZE, "shadows": SHARE,
    "shadow_softness": _number(0.0, 90.0, "a number from 0 to 90"),
    "projection": (lambda value: isinstance(value, str) and value in SIZES, "perspective or orthographic"),
    "vertical_fov": _number(1e-9, 179.999999, "a number above 0 and below 180"), "height": POSITIVE}


def check(header, table, needed=()):
    """Raises ValueError with one sentence for the first value of a header that fails its test. table: key -> a pair of
    a test and a description; a dot separates a key from a key inside it. needed: the keys that must exist."""
    for key, (is_good, words) in table.items():
        holder = header
        *outer, last = key.split(".")
        for each in outer:
            holder = holder.get(each, {})
        if last in holder and not is_good(holder[last]):
            raise ValueError(f"{key} is {shortened(holder[last])}, not {words}")
        if last not in holder and key in needed:
            raise ValueError(f"{key} is missing")


def check_camera(camera):
    """Raises ValueError with one sentence if a camera lacks a key or has invalid values."""
    if not isinstance(camera, dict):
        raise ValueError(f"it is {shortened(camera)}, not an object")
    check(camera, CAMERA, (*VECTORS, "projection"))
    check(camera, CAMERA, (SIZES[camera["projection"]],))
    position, target, up = (np.array(camera[key], dtype=np.float64) for key in VECTORS)
    view = target - position
    if np.linalg.norm(np.cross(view, up)) <= 1e-9 * np.linalg.norm(view) * np.linalg.norm(up):
        raise ValueError("position equals target, or up points along the view")


MAGIC = b"\x89MNS\r\n\x1a\n"
VERSION = 4
PROLOGUE = 64
TYPES = ("<f4", "<f8", "<u4", "<i4", "|u1")
#: Arrays that a mesh must have, and their columns.
NEEDED = {
    "mesh.position": 3, "mesh.normal": 3, "mesh.triangle": 3, "mesh.kind": 1, "mesh.patch": 1, "mesh.component": 1,
    "mesh.atom": 1, "mesh.sharp_corner": 1, "mesh.sharp_corner_normal": 3, "mesh.sharp_edge": 2, "atom.center": 3,
    "atom.radius": 1, "atom.color": 3}
#: Optional numbers of atoms and of vertices.
OF_ATOMS = ("b_factor", "charge", "hydrophobicity", "atomic_number", "res_id", "chain_id", "name_id", "residue_name_id",
            "entity", "area", "accessible_area", "buried_area", "index", "file_index", "opacity", "own_color")
OF_VERTICES = ("mean_curvature", "gaussian_curvature", "smooth_mean_curvature", "smooth_gaussian_curvature", "open_sky",
               "map_value", "map_known")
#: Arrays that a mesh may have, and their columns.
OPTIONAL = {"mesh.velocity": 3, "mesh.cap_plane": 1, "mesh.map_color": 3, "mesh.patch_area": 1,
            **{f"mesh.{name}": 1 for name in OF_VERTICES}, **{f"atom.{name}": 1 for name in OF_ATOMS}}
#: Optional numbers of atoms that are integers.
WHOLE = ("atomic_number", "res_id", "chain_id", "name_id", "residue_name_id", "entity", "index", "file_index",
         "own_color")
#: The value of mesh.kind for caps.
CAP = 4
#: Tests of the values of headers. Values of an object are in its own part of the header.
VALUES = {
    "generator": TEXT, **SOURCE, "name": TEXT, "mesh": DICT,
    "mesh.origin": VECTOR, "mesh.tolerance": NUMBER, "kind_colors": COLORS,
    **{key: NUMBER for key in ("probe_radius", "area", "volume")},
    **{key: TEXTS for key in ("chain_names", "atom_names", "residue_names")},
    "material": DICT,
    **{f"material.{key}": SHARE for key in ("ambient", "roughness", "specular")},
    "material.shininess": SHININESS, "caps": DICT, "caps.planes": PLANES,
    "caps.color": COLOR, "caps.hatching": DICT,
    "caps.hatching.across": DIRECTIONS, "caps.hatching.distance": POSITIVE,
    "caps.hatching.share": SHARE, "caps.hatching.light": SHARE}
#: Tests of the values of an entry of the components.
COMPONENT = {
    "components": DICT, "components.kind": TEXT, "components.area": NUMBER,
    "components.volume": NUMBER}


class MnsError(Exception):
    """The file is not a complete and valid .mns file of a version that this reader knows."""


#: The greatest number of columns of an array. No array of the format has more than four.
MOST_COLUMNS = 64

#: Keys of headers that joined.py adds. They are ignored in files.
OF_JOINED = ("moved_by",)
#: The placement of a surface that is not moved: three rows of four numbers.
IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]


def read_json(path, what=""):
    """Returns the content of a JSON file that belongs to .mns files. what: a note on its origin for the message. Raises
    MnsError or OSError."""
    with open(path, encoding="utf-8") as file:
        try:
            return json.load(file)
        except (ValueError, RecursionError) as error:
            raise MnsError(f"{path}: no JSON{what} ({error})") from None


def read_manifest(path, kind, words, version, values, needed, what=""):
    """Returns the checked header of a JSON file that belongs to .mns files. kind: its format. words: its description
    for messages. version: the newest known version. values, needed: arguments of check(). what: a note on
    its origin. Raises MnsError or OSError."""
    header = read_json(path, what)
    if not isinstance(header, dict) or header.get("format") != kind:
        raise MnsError(f"{path}: not {words}")
    found = header.get("version")
    if type(found) is not int or found < 1:
        raise MnsError(f"{path}: version {shortened(found)} does not exist")
    if found > version:
        raise MnsError(f"{path}: version {found} is newer than this add-on knows ({version}); update it")
    try:
        check(header, values, needed)
    except ValueError as error:
        raise MnsError(f"{path}: {error}") from None
    return header


class File:
    """The content of a .mns file. header: dict. objects: the surfaces, at least one."""

    def __init__(self, header, objects):
        self.header = header
        self.objects = objects


class Surface:
    """One object of a file. header: dict with the keys of the file and of the object. arrays: name without prefix ->
    read-only numpy array, (rows,) or (rows, columns). copies: 3x4 matrices [rotation | translation in Å]."""

    def __init__(self, path, header, arrays):
        self.path = path
        self.header = header
        self.arrays = arrays
        self.known_closed = False
        self.name = str(header.get("name", ""))
        self.copies = [np.array(copy, dtype=np.float64).reshape(3, 4) for copy in header.get("copies", [IDENTITY])]

    def __getitem__(self, name):
        return self.arrays[name]

    def get(self, name):
        return self.arrays.get(name)

    def check_closed(self):
        """Raises MnsError if the mesh must be closed and is not. The mesh is checked only once."""
        if not self.known_closed and self.header["mesh"].get("closed", True) and not is_closed(self["mesh.triangle"]):
            raise MnsError(f"{self.path}: the mesh is not closed")
        self.known_closed = True

    @property
    def triangle_count(self):
        return len(self.arrays["mesh.triangle"])


def stamp(path):
    """Returns a value that changes when a file is written again. Raises OSError."""
    found = os.stat(path)
    return found.st_mtime_ns, found.st_size, found.st_ino


def read(path):
    """Reads a file and returns a File. Raises MnsError with one sentence, or OSError."""
    header, arrays = read_arrays(path)
    if header.get("format") == "meniscus atoms":
        raise MnsError(f"{path}: it holds atoms, not a surface")
    try:
        if "camera" in header:
            check_camera(header["camera"])
    except ValueError as error:
        raise MnsError(f"{path}: camera: {error}") from None
    return File(header, _objects(path, header, arrays))


def read_arrays(path):
    """Returns the header and the arrays by name of any file in this container format, after checking its checksum.
    Raises MnsError with one sentence, or OSError."""
    with open(path, "rb") as file:
        try:
            data = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
        except ValueError:
            raise MnsError(f"{path}: the file is empty") from None
    header, start = _read_header(path, data)
    arrays = {}
    entries = header.get("arrays")
    if not isinstance(entries, list):
        raise MnsError(f"{path}: the header lists no arrays")
    for entry in entries:
        name, array = _read_array(path, data, start, entry)
        if name in arrays:
            raise MnsError(f"{path}: array {name} appears twice")
        arrays[name] = array
    return header, arrays


def _objects(path, header, arrays):
    entries = header.get("objects", [header])  # a file of version 1 is one object
    if not isinstance(entries, list) or not entries or not all(isinstance(entry, dict) for entry in entries):
        raise MnsError(f"{path}: the header lists no objects")
    surfaces = []
    for entry in entries:
        prefix = str(entry.get("prefix", ""))
        own = {name[len(prefix):]: array for name, array in arrays.items() if name.startswith(prefix)}
        _check_copies(path, entry)
        surfaces.append(
            Surface(path, {key: value for key, value in {**header, **entry}.items() if key not in OF_JOINED}, own))
        _check(surfaces[-1])
    return surfaces


def _check_copies(path, entry):
    """Raises MnsError if a copy is not a rotation and a translation, because Blender would show a mirrored or sheared
    molecule without a warning."""
    copies = entry.get("copies", [IDENTITY])
    if not isinstance(copies, list) or not all(are_numbers(copy, 12) for copy in copies):
        raise MnsError(f"{path}: copies are not lists of twelve numbers")
    matrices = np.array(copies, dtype=np.float64).reshape(-1, 3, 4)
    turns = matrices[:, :, :3]
    if not len(matrices):
        raise MnsError(f"{path}: copies are missing")
    if not np.allclose(turns @ turns.transpose(0, 2, 1), np.eye(3), atol=1e-6) or (np.linalg.det(turns) < 0).any():
        raise MnsError(f"{path}: a copy is not a rotation and a translation")


def _read_header(path, data):
    if len(data) < PROLOGUE:
        raise MnsError(f"{path}: {len(data)} bytes are too few for a .mns file")
    if data[:8] != MAGIC:
        raise MnsError(f"{path}: not a .mns file (it begins with other bytes)")
    version, crc, header_size, file_size = struct.unpack_from("<IIQQ", data, 8)
    if version > VERSION:
        raise MnsError(f"{path}: version {version} is newer than this add-on knows ({VERSION}); update the add-on")
    if version < 1:
        raise MnsError(f"{path}: version {version} does not exist")
    if file_size != len(data):
        raise MnsError(f"{path}: {len(data)} bytes of {file_size}; the file is incomplete or has been changed")
    if header_size > len(data) - PROLOGUE:
        raise MnsError(f"{path}: the header is longer than the file")
    with memoryview(data) as view, view[PROLOGUE:] as rest:
        found = zlib.crc32(rest)
    if found != crc:
        raise MnsError(f"{path}: checksum {found:08x} instead of {crc:08x}; the file is damaged, export it again")
    start = PROLOGUE + header_size
    try:
        header = json.loads(data[PROLOGUE:start].decode("utf-8"))
    except (ValueError, RecursionError) as error:
        raise MnsError(f"{path}: the header is not JSON ({error})") from None
    if not isinstance(header, dict):
        raise MnsError(f"{path}: the header is not a JSON object")
    return header, start


def _read_array(path, data, start, entry):
    try:
        name, kind = str(entry["name"]), entry["type"]
        rows, columns, offset = (entry[key] for key in ("rows", "columns", "offset"))
    except (TypeError, KeyError):
        raise MnsError(f"{path}: an entry of the array list is malformed") from None
    if kind not in TYPES:
        raise MnsError(f"{path}: array {name} has the unknown type {kind}")
    dtype = np.dtype(kind)
    stored = entry.get("bytes")
    if not all(type(number) is int for number in (rows, columns, offset, 0 if stored is None else stored)):
        raise MnsError(f"{path}: an entry of the array list is malformed")
    size = rows * columns * dtype.itemsize
    end = start + offset + (size if stored is None else stored)
    if rows < 0 or not 1 <= columns <= MOST_COLUMNS or not start <= start + offset <= end <= len(data):
        raise MnsError(f"{path}: array {name} lies outside the file")
    if rows == 0:
        array = np.empty(0, dtype)
    elif stored is not None:
        array = _unpacked(path, name, data[start + offset:end], size, dtype)
    else:
        array = np.frombuffer(data, dtype, rows * columns, start + offset)
    return name, array if columns == 1 else array.reshape(rows, columns)


def _unpacked(path, name, stored, size, dtype):
    """Returns the values of an array that is packed, in one dimension."""
    try:
        unpacked = zlib.decompressobj().decompress(stored, size + 1)
    except (zlib.error, OverflowError) as error:
        raise MnsError(f"{path}: array {name} cannot be unpacked ({error})") from None
    if len(unpacked) != size:
        raise MnsError(f"{path}: array {name} does not have {size} bytes")
    return np.frombuffer(unpacked, dtype)


def _check(surface):
    path, arrays = surface.path, surface.arrays
    _check_values(surface)
    for name, columns in {**NEEDED, **OPTIONAL}.items():
        if name not in arrays:
            if name in OPTIONAL:
                continue
            raise MnsError(f"{path}: array {name} is missing")
        found = 1 if arrays[name].ndim == 1 else arrays[name].shape[1]
        if found != columns:
            raise MnsError(f"{path}: array {name} has {found} columns instead of {columns}")
    for name, array in arrays.items():
        if array.dtype.kind == "f" and not (np.abs(array) <= TOO_LARGE).all():
            raise MnsError(f"{path}: array {name} holds a number that is not finite, or larger than {TOO_LARGE:g}")
    vertices, triangles, atoms = (len(arrays[n]) for n in ("mesh.position", "mesh.triangle", "atom.center"))
    if vertices == 0 or triangles == 0:
        raise MnsError(f"{path}: the mesh is empty")
    if "caps" in surface.header:
        _check_caps(surface)
    elif "mesh.cap_plane" in arrays:
        raise MnsError(f"{path}: array mesh.cap_plane is there, but the header has no caps")
    if ("mesh.map_value" in arrays) != ("mesh.map_color" in arrays):
        raise MnsError(f"{path}: of mesh.map_value and mesh.map_color one is missing")
    opacity = arrays.get("atom.opacity")
    if opacity is not None and len(opacity) and not 0.0 <= opacity.min() <= opacity.max() <= 1.0:
        raise MnsError(f"{path}: array atom.opacity holds a number outside of 0 to 1")
    mesh = surface.header.get("mesh")
    if not isinstance(mesh, dict) or mesh.get("vertices") != vertices or mesh.get("triangles") != triangles:
        raise MnsError(f"{path}: header and arrays disagree on the number of vertices or triangles")
    components = len(surface.header.get("components", ()))
    lengths = {
        "mesh.normal": vertices, "mesh.velocity": vertices, "mesh.kind": triangles, "mesh.patch": triangles,
        "mesh.component": triangles, "mesh.atom": triangles, "mesh.cap_plane": triangles, "mesh.patch_area": triangles,
        "mesh.map_color": vertices, "atom.radius": atoms, "atom.color": atoms,
        **{f"mesh.{name}": vertices for name in OF_VERTICES}, **{f"atom.{name}": atoms for name in OF_ATOMS},
        "mesh.sharp_corner_normal": len(arrays["mesh.sharp_corner"])}
    for name, rows in lengths.items():
        if name in arrays and len(arrays[name]) != rows:
            raise MnsError(f"{path}: array {name} has {len(arrays[name])} rows instead of {rows}")
    limits = {
        "mesh.triangle": vertices, "mesh.sharp_edge": vertices, "mesh.sharp_corner": 3 * triangles,
        "mesh.kind": CAP + 1 if "caps" in surface.header else 3, "mesh.component": components, "mesh.atom": atoms}
    for name in [f"atom.{name}" for name in WHOLE if f"atom.{name}" in arrays]:
        if arrays[name].dtype.kind not in "iu":
            raise MnsError(f"{path}: array {name} does not hold whole numbers")
    for name, limit in limits.items():
        if arrays[name].dtype.kind not in "iu" or (arrays[name].size and int(arrays[name].min()) < 0):
            raise MnsError(f"{path}: array {name} does not hold indices")
        if arrays[name].size and int(arrays[name].max()) >= limit:
            raise MnsError(f"{path}: array {name} holds the index {int(arrays[name].max())}, the limit is {limit - 1}")


def _check_values(surface):
    """Raises MnsError for a value of the header that the add-on could not use."""
    header = surface.header
    needed = ["mesh", "mesh.origin", *(["caps.planes"] if "caps" in header else ())]
    try:
        check(header, VALUES, needed)
        if "hatching" in header.get("caps", ()):
            check(header, VALUES, [key for key in VALUES if key.startswith("caps.hatching.")])
        listed = header.get("components", [])
        if not isinstance(listed, list):
            raise ValueError(f"components is {shortened(listed)}, not a list")
        for component in listed:
            check({"components": component}, COMPONENT, ("components", "components.kind"))
    except ValueError as error:
        raise MnsError(f"{surface.path}: {error}") from None


def _check_caps(surface):
    """Raises MnsError if a cap lies on no plane, or if hatching lacks a direction for a plane."""
    path, caps = surface.path, surface.header["caps"]
    planes = caps["planes"]
    if "hatching" in caps and len(caps["hatching"]["across"]) != len(planes):
        raise MnsError(
            f"{path}: caps.hatching.across has {len(caps['hatching']['across'])} directions for {len(planes)} planes")
    cap, plane = surface["mesh.kind"] == CAP, surface.get("mesh.cap_plane")
    if cap.any() and (plane is None or plane.dtype.kind not in "iu" or int(plane[cap].max()) >= len(planes)):
        raise MnsError(f"{path}: a cap lies on no plane")
    if (surface["mesh.kind"] == 3).any():
        raise MnsError(f"{path}: array mesh.kind holds the kind 3, which no triangle has")


def check_names(path, array, numbers, names):
    """Raises MnsError if numbers, the array of this name, are not indices into the list `names`."""
    if not isinstance(names, list) or (len(numbers) and not 0 <= numbers.min() <= numbers.max() < len(names)):
        raise MnsError(f"{path}: array {array} points to no name")


def is_closed(triangles):
    """Returns True if every edge has exactly two triangles, which traverse it in opposite directions."""
    t = triangles.astype(np.uint64)
    a, b = t.ravel(), np.roll(t, -1, axis=1).ravel()
    forward = np.sort(a << np.uint64(32) | b)
    if (forward[1:] == forward[:-1]).any() or (a == b).any():
        return False
    return np.array_equal(forward, np.sort(b << np.uint64(32) | a))
