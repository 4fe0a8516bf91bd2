# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads scene files of Meniscus, and separates values with a field of the panel from values that only the program can
show, and from values that Blender cannot show."""

import dataclasses
import json
import os

from . import mns_reader
from .computing import preparation, preparation_table, request

#: Fields of the panel by the keys of scenes.
FIELDS = {
    "molecule.file": "file", "molecule.select": "selection", "frames.trajectory": "trajectory",
    "frames.trajectory_atoms": "trajectory_atoms", "frames.frames": "frames", "surface.kind": "kind",
    "surface.probe": "probe", "surface.cavities": "cavities", "surface.color": "colors",
    "surface.color_by_file": "numbers", "mesh.tolerance": "tolerance", "mesh.density": "density",
    **{row.key: preparation.name_of(row) for row in preparation.ROWS}}
FILES = ("file", "trajectory", "numbers")
#: The ranges of numbers in the panel. Those of the program are wider.
NUMBERS = {"probe": (0.0, 100.0), "tolerance": (1e-5, 1.0), "density": (0.005, 1000.0)}
WORDS = {"surface.kind": request.KINDS, "surface.cavities": request.CAVITIES}
#: Keys without effect on the surface: the output, the device, and the compression of films.
IDLE = {
    "output.file", "surface.device", "surface.require_gpu", "surface.threads", "surface.verify",
    "surface.representation", "frames.codec", "frames.crf", "frames.bits", "frames.chroma"}
#: Sections about parts of a picture that have no counterpart in Blender.
UNSEEN = ("look", "legend", "annotations", "image")


@dataclasses.dataclass
class Scene:
    """A scene file. fields: values of the panel by name. others: keys that only the program supports. unseen: keys that
    have no counterpart in Blender."""

    fields: dict
    others: list
    unseen: list


def read(path):
    """Reads a scene file and returns a Scene. Raises MnsError or OSError."""
    with open(path, encoding="utf-8") as file:
        try:
            given = json.load(file)
        except (ValueError, RecursionError) as error:
            raise mns_reader.MnsError(f"{path}: not a scene: {error}") from None
    if not isinstance(given, dict) or given.get("meniscus_scene") != 1:
        raise mns_reader.MnsError(f'{path}: not a scene: its key "meniscus_scene" is not 1')
    scene = Scene({}, [], [])
    for key, value in _settings(path, given):
        if key in FIELDS:
            _take(scene, path, key, value)
        elif key.split(".")[0] in UNSEEN:
            scene.unseen.append(key)
        elif key not in IDLE:
            scene.others.append(key)
    if "file" not in scene.fields and "molecule.file" not in scene.others:
        raise mns_reader.MnsError(f"{path}: it names no molecule.file")
    scene.fields["is_run"] = any(name in scene.fields for name in ("trajectory", "frames"))
    return scene


def _settings(path, given):
    """Yields pairs of key and value. A list of objects with a single surface yields the keys of the surface; any other
    list is a single value."""
    for section, values in given.items():
        if section == "objects" and isinstance(values, list) and len(values) == 1 and isinstance(values[0], dict) \
                and values[0].get("representation") == "surface":
            section, values = "surface", values[0]
        if section in ("meniscus_scene", "superposed"):
            continue
        if section != "objects" and not isinstance(values, dict):
            raise mns_reader.MnsError(f"{path}: {section} is {mns_reader.shortened(values)}, not a section")
        yield from [(section, values)] if section == "objects" else ((f"{section}.{name}", value)
                                                                     for name, value in values.items())


def _take(scene, path, key, value):
    name = FIELDS[key]
    values = value if isinstance(value, list) else [value]
    if not values or not all(isinstance(each, (str, int, float)) for each in values):
        raise mns_reader.MnsError(f"{path}: {key} is {mns_reader.shortened(value)}")
    if name == "colors":
        scene.fields.update(_colors(values))
        return
    try:
        found = None if len(values) > 1 else _plain(key, name, values[0])
    except ValueError as error:
        raise mns_reader.MnsError(f"{path}: {key} is {mns_reader.shortened(value)}, not {error}") from None
    if found is None or name in FILES and not _is_beside(found):
        scene.others.append(key)  # the program takes several values, and checks files in other folders
    else:
        scene.fields[name] = os.path.join(os.path.dirname(os.path.abspath(path)), found) if name in FILES else found


def _plain(key, name, value):
    """Returns the value of a field, or None if it is outside of the panel's range. Raises ValueError with a description
    of valid values."""
    row = next((row for row in preparation.ROWS if row.key == key), None)
    if name in NUMBERS:
        try:
            number = float(value)
        except ValueError:
            raise ValueError("a number") from None
        low, high = NUMBERS[name]
        return number if low <= number <= high else None
    if row is not None and row.type == "flag" and type(value) is not bool:
        raise ValueError("true or false")
    if row is not None and row.type == "count":
        return value if type(value) is int and row.lowest <= value <= row.highest else None
    words = WORDS.get(key, row.words if row is not None and row.type == "word" else ())
    text = str(value).upper() if key in WORDS else str(value)
    if words and text not in words:
        raise ValueError(f"one of {', '.join(words).lower()}")
    return value if row is not None and row.type == "flag" else text


def _colors(values):
    """Returns the fields of colours: a scheme of the menu, or the text of all other colours."""
    if len(values) == 1 and values[0] in dict(preparation_table.SCHEMES):
        return {"color": values[0]}
    return {"color": "own", "colors": "; ".join(str(value) for value in values)}


def _is_beside(name):
    """True if a file is in the folder of the scene or below it."""
    return isinstance(name, str) and not os.path.isabs(name) and "\\" not in name and ".." not in name.split("/")
