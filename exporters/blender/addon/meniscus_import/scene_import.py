# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads and imports scene files of Meniscus. A scene becomes a surface of the panel if the panel has fields for all of its
values. Otherwise the program exports it, and the export is imported."""

import dataclasses
import json
import os
import subprocess
import tempfile

import bpy
from bpy_extras.io_utils import ImportHelper

from . import build, computed, mns_reader, panel, sequence
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
    """Returns True if a file is in the folder of the scene or below it."""
    return isinstance(name, str) and not os.path.isabs(name) and "\\" not in name and ".." not in name.split("/")


class OBJECT_OT_meniscus_from_scene(panel.Waiting, bpy.types.Operator, ImportHelper):
    """Show what a scene file of Meniscus shows; parts that the panel has no fields for come as the program meniscus
    exports them"""

    bl_idname = "object.meniscus_from_scene"
    bl_label = "Surface of a scene"
    bl_options = {"UNDO"}

    filename_ext = ".json"
    filter_glob: bpy.props.StringProperty(default="*.json", options={"HIDDEN"})
    filepath: bpy.props.StringProperty(subtype="FILE_PATH", options={"SKIP_SAVE"})

    @build.reports_errors
    def execute(self, context):
        scene = read(self.filepath)
        if scene.others:
            self.import_exported(context, scene)
            return {"FINISHED"}
        item = self.make(context, scene)
        if scene.unseen:
            self.report({"INFO"}, f"Left out: {', '.join(scene.unseen)}")
        return panel.start(self, item)

    def make(self, context, scene):
        """Returns an object of the panel. It computes nothing before all of its fields are set."""
        fields = dict(scene.fields)
        for name in set(fields) & set(FILES):
            fields[name] = build.remembered_path(fields[name])
        detail = "PROXY" if "density" in fields else "FINE" if "tolerance" in fields else "AUTO"
        return panel.new_object(context, build.stem_of(self.filepath) + ".surface", "FILE", detail=detail, **fields)

    def import_exported(self, context, scene):
        program = computed.working().describe_tools()["program"]
        if not program:
            raise mns_reader.MnsError(
                f"{self.filepath}: the panel has no fields for {', '.join(scene.others)}; the program meniscus, which "
                "exports "
                "them, is not found; name it in the add-on's preferences")
        is_run = any(key.startswith("frames.") for key in scene.others) or scene.fields["is_run"]
        with tempfile.TemporaryDirectory(prefix="meniscus_") as folder:
            target = os.path.join(folder, build.stem_of(self.filepath) + ("" if is_run else ".mns"))
            done = subprocess.run([program, "export", "blender", "--scene", self.filepath, "-o", target],
                                  stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                  check=False)
            lines = [line.removeprefix("meniscus: ") for line in done.stderr.decode("utf-8", "replace").splitlines()]
            if done.returncode:
                errors = (line.removeprefix("error: ") for line in lines if line.startswith("error: "))
                raise mns_reader.MnsError(next(errors, f"{program} ended with {done.returncode}"))
            for line in lines:
                if line.startswith(("note: ", "warning: ")):
                    self.report({"INFO"}, line)
            if is_run:
                sequence.bake(os.path.join(target, "surface_sequence.json"), context)
                return
            for item in build.import_file(target, context).surfaces:
                del item["meniscus_file"]  # the file is temporary


register, unregister = bpy.utils.register_classes_factory([OBJECT_OT_meniscus_from_scene])
