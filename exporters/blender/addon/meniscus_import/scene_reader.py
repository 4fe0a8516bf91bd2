# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads scene files of Meniscus: what the panel has fields for, what the program alone can show, and what neither shows."""

import dataclasses
import json
import os

from . import header_values, mns_reader
from .computing import preparation, preparation_table, request

#: Fields of the panel by the keys of scenes.
FIELDS = {
    "molecule.file": "file", "molecule.select": "selection", "frames.trajectory": "trajectory", "frames.trajectory_atoms": "trajectory_atoms",
    "frames.frames": "frames", "surface.kind": "kind", "surface.probe": "probe", "surface.cavities": "cavities", "surface.color": "colors",
    "surface.color_by_file": "numbers", "mesh.tolerance": "tolerance", "mesh.density": "density",
    **{row.key: preparation.name_of(row) for row in preparation.ROWS},
}
FILES = ("file", "trajectory", "numbers")
#: Least and greatest numbers of the panel; the program has wider ones.
NUMBERS = {"probe": (0.0, 100.0), "tolerance": (1e-5, 1.0), "density": (0.005, 1000.0)}
WORDS = {"surface.kind": request.KINDS, "surface.cavities": request.CAVITIES}
#: What changes nothing of the surface: where the picture goes, what computes, how a film is packed.
IDLE = {"output.file", "surface.device", "surface.require_gpu", "surface.threads", "surface.verify", "surface.representation", "frames.codec",
        "frames.crf", "frames.bits", "frames.chroma"}
#: Parts of a picture that Blender has no counterpart of.
UNSEEN = ("look", "legend", "annotations", "image")


@dataclasses.dataclass
class Scene:
    """fields: values of the panel by name. others: keys for which it has no field, but the program. unseen: keys of what does not show."""

    fields: dict
    others: list
    unseen: list


def read(path):
    """Raises MnsError or OSError."""
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
    """Pairs of key and value; the keys of a list with one surface are those of the surface, another list is one value."""
    for section, values in given.items():
        if section == "objects" and isinstance(values, list) and len(values) == 1 and isinstance(values[0], dict) \
                and values[0].get("representation") == "surface":
            section, values = "surface", values[0]
        if section in ("meniscus_scene", "superposed"):
            continue
        if section != "objects" and not isinstance(values, dict):
            raise mns_reader.MnsError(f"{path}: {section} is {header_values.told(values)}, not a section")
        yield from [(section, values)] if section == "objects" else ((f"{section}.{name}", value) for name, value in values.items())


def _take(scene, path, key, value):
    name = FIELDS[key]
    values = value if isinstance(value, list) else [value]
    if not values or not all(isinstance(each, (str, int, float)) for each in values):
        raise mns_reader.MnsError(f"{path}: {key} is {header_values.told(value)}")
    if name == "colors":
        scene.fields.update(_colors(values))
        return
    try:
        found = None if len(values) > 1 else _plain(key, name, values[0])
    except ValueError as error:
        raise mns_reader.MnsError(f"{path}: {key} is {header_values.told(value)}, not {error}") from None
    if found is None or name in FILES and not _is_beside(found):
        scene.others.append(key)  # the program takes several, and says of other folders whether it trusts the scene
    else:
        scene.fields[name] = os.path.join(os.path.dirname(os.path.abspath(path)), found) if name in FILES else found


def _plain(key, name, value):
    """The value of a field; None: the panel has a narrower range. Raises ValueError that says what it should be."""
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
    """A scheme is in the menu; all else is written."""
    if len(values) == 1 and values[0] in dict(preparation_table.SCHEMES):
        return {"color": values[0]}
    return {"color": "own", "colors": "; ".join(str(value) for value in values)}


def _is_beside(name):
    """Returns True if a file is in the scene's folder or below it."""
    return isinstance(name, str) and not os.path.isabs(name) and "\\" not in name and ".." not in name.split("/")
