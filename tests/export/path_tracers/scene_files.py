# SPDX-License-Identifier: BSD-3-Clause
"""Readers of scene files by strict grammars of our own: Mitsuba's XML, pbrt's statements, PLY meshes."""

import pathlib
import re
import xml.etree.ElementTree as ElementTree

import numpy as np


class Mesh:
    """A binary PLY file: .positions, .normals, .colors (None if there are none), .triangles. Raises ValueError."""

    def __init__(self, path):
        data = pathlib.Path(path).read_bytes()
        head, end, rest = data.partition(b"end_header\n")
        lines = head.decode("ascii").split("\n")
        if not end or lines[:2] != ["ply", "format binary_little_endian 1.0"]:
            raise ValueError(f"{path}: no binary PLY")
        words = [line.split() for line in lines[2:] if line]
        vertices = int(next(w[2] for w in words if w[:2] == ["element", "vertex"]))
        faces = int(next(w[2] for w in words if w[:2] == ["element", "face"]))
        columns = [w[2] for w in words if w[:2] == ["property", "float"]]
        rows = np.frombuffer(rest, "<f4", vertices * len(columns)).reshape(vertices, len(columns))
        face = np.dtype([("count", "u1"), ("corner", "<u4", 3)])
        behind = rest[rows.nbytes:]
        if len(behind) != faces * face.itemsize:
            raise ValueError(f"{path}: {len(behind)} bytes of triangles, {faces * face.itemsize} awaited")
        triangles = np.frombuffer(behind, face)
        if not faces or (triangles["count"] != 3).any() or triangles["corner"].max() >= vertices:
            raise ValueError(f"{path}: no mesh of triangles")
        if not np.isfinite(rows).all() or len(np.unique(triangles["corner"])) != vertices:
            raise ValueError(f"{path}: vertices that are not numbers, or are not used")
        self.positions, self.normals = rows[:, 0:3], rows[:, 3:6]
        self.colors = rows[:, 6:9] if columns[6:] == ["r", "g", "b"] else None
        if columns[:6] != ["x", "y", "z", "nx", "ny", "nz"] or (self.colors is None and columns[6:]):
            raise ValueError(f"{path}: columns {columns}")
        self.triangles = triangles["corner"]


def mitsuba_scene(path):
    """Returns the root of a scene whose references lead somewhere, and the Mesh of each file named. Raises
    ValueError."""
    root = ElementTree.parse(path).getroot()
    if root.tag != "scene" or root.get("version") != "3.0.0":
        raise ValueError(f"{path}: no scene")
    known, defaults, meshes = set(), {e.get("name") for e in root.iter("default")}, {}
    for element in root.iter():
        if element.tag == "ref" and element.get("id") not in known:
            raise ValueError(f"{path}: nothing before has the id {element.get('id')}")
        value = element.get("value", "")
        if value.startswith("$") and value[1:] not in defaults:
            raise ValueError(f"{path}: {value} has no default")
        if element.get("name") == "filename":
            if "/" in value:
                raise ValueError(f"{path}: {value} is not beside it")
            meshes[value] = Mesh(pathlib.Path(path).parent / value)
        if element.get("id") and element.tag != "ref":
            if element.get("id") in known:
                raise ValueError(f"{path}: two have the id {element.get('id')}")
            known.add(element.get("id"))
    return root, meshes


#: Statements of pbrt-v4 that we write: how many numbers and strings each has, and whether parameters may follow.
PBRT_STATEMENTS = {
    "Scale": (3, 0, False), "LookAt": (9, 0, False), "Translate": (3, 0, False), "ConcatTransform": (16, 0, False),
    "Camera": (0, 1, True), "Sampler": (0, 1, True), "Integrator": (0, 1, True), "PixelFilter": (0, 1, True),
    "Film": (0, 1, True), "WorldBegin": (0, 0, False), "LightSource": (0, 1, True), "AreaLightSource": (0, 1, True),
    "MakeNamedMaterial": (0, 1, True), "NamedMaterial": (0, 1, False), "MakeNamedMedium": (0, 1, True),
    "MediumInterface": (0, 2, False), "Shape": (0, 1, True), "AttributeBegin": (0, 0, False),
    "AttributeEnd": (0, 0, False), "ObjectBegin": (0, 1, False), "ObjectEnd": (0, 0, False),
    "ObjectInstance": (0, 1, False),
}
BEFORE_WORLD = {"Scale", "LookAt", "Camera", "Sampler", "Integrator", "PixelFilter", "Film"}
#: Number of values that make one of each type.
PBRT_TYPES = {"float": 1, "integer": 1, "string": 1, "bool": 1, "rgb": 3, "point3": 3}
TOKEN = re.compile(r'\s*(?:#[^\n]*\n\s*)*("[^"\\\n]*"|\[|\]|[A-Za-z]+|[-+]?[0-9.][0-9.eE+-]*)')


def pbrt_tokens(text, path):
    tokens, at = [], 0
    text = text.rstrip()
    while at < len(text):
        found = TOKEN.match(text, at)
        if not found:
            raise ValueError(f"{path}: no token of pbrt: {text[at:at + 40]!r}")
        tokens.append(found.group(1))
        at = found.end()
    return tokens


def pbrt_scene(path):
    """Returns the statements (name, values, parameters) of a scene whose names lead somewhere and whose blocks are
    closed, and the Mesh of each file it names. Raises ValueError."""
    tokens = pbrt_tokens(pathlib.Path(path).read_text(encoding="ascii"), path)
    statements, meshes, at = [], {}, 0

    def take(kind):
        nonlocal at
        token = tokens[at] if at < len(tokens) else "the end"
        at += 1
        if kind == "string" and token.startswith('"'):
            return token[1:-1]
        if kind == "number":
            return float(token)
        if kind == "bool" and token in ("true", "false"):
            return token == "true"
        raise ValueError(f"{path}: {token} where a {kind} should be")

    while at < len(tokens):
        name = tokens[at]
        if name not in PBRT_STATEMENTS:
            raise ValueError(f"{path}: no statement: {name}")
        at += 1
        numbers, strings, has_parameters = PBRT_STATEMENTS[name]
        bracket = numbers == 16
        if bracket and tokens[at] != "[":
            raise ValueError(f"{path}: {name} without [")
        at += bracket
        values = [take("number") for _ in range(numbers)] + [take("string") for _ in range(strings)]
        if bracket and tokens[at] != "]":
            raise ValueError(f"{path}: {name} without ]")
        at += bracket
        parameters = {}
        while has_parameters and at < len(tokens) and tokens[at].startswith('"'):
            kind, key = take("string").split(" ")
            if kind not in PBRT_TYPES or tokens[at] != "[" or key in parameters:
                raise ValueError(f"{path}: {name}: {kind} {key}")
            at += 1
            read = []
            while tokens[at] != "]":
                read.append(take({"string": "string", "bool": "bool"}.get(kind, "number")))
            at += 1
            if len(read) % PBRT_TYPES[kind] or not read or (kind != "float" and len(read) != PBRT_TYPES[kind]):
                raise ValueError(f"{path}: {name}: {key} has {len(read)} values")
            parameters[key] = read[0] if len(read) == 1 else read
        statements.append((name, values, parameters))

    world, blocks, materials, media, objects = False, [], set(), {""}, set()
    for name, values, parameters in statements:
        if (name in BEFORE_WORLD) != (not world) and name != "WorldBegin":
            raise ValueError(f"{path}: {name} on the wrong side of WorldBegin")
        if name == "WorldBegin":
            world = True
        elif name in ("AttributeBegin", "ObjectBegin"):
            blocks.append(name)
        elif name in ("AttributeEnd", "ObjectEnd"):
            if not blocks or blocks.pop()[:-5] != name[:-3]:
                raise ValueError(f"{path}: {name} ends nothing")
        known = {"NamedMaterial": materials, "MediumInterface": media, "ObjectInstance": objects}.get(name)
        if known is not None and not set(values) <= known:
            raise ValueError(f"{path}: {name} {values}: not made before")
        made = {"MakeNamedMaterial": materials, "MakeNamedMedium": media, "ObjectBegin": objects}.get(name)
        if made is not None:
            if values[0] in made:
                raise ValueError(f"{path}: {name} {values[0]} twice")
            made.add(values[0])
        if name == "Shape" and values[0] == "plymesh":
            file = parameters["filename"]
            if "/" in file:
                raise ValueError(f"{path}: {file} is not beside it")
            meshes[file] = Mesh(pathlib.Path(path).parent / file)
    if blocks or not world:
        raise ValueError(f"{path}: {blocks or 'WorldBegin'} is missing its end")
    return statements, meshes
