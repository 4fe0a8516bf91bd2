# SPDX-License-Identifier: GPL-3.0-or-later
"""What may be changed of data from other .blend files, where the files of objects lie, and what becomes of objects that cannot be shown."""

import os
import sys

import bpy
from bpy.app.handlers import persistent

from . import compat, motion

#: Of an object: what went wrong when it was last shown.
ERROR = "meniscus_error"
#: Where objects store paths: in custom properties, and in their settings.
CUSTOM, SETTINGS = ("meniscus_file", "meniscus_sequence"), ("file", "trajectory", "numbers")
#: The custom property beside each: the path as it is stored, and the absolute one that it stands for.
AT = "meniscus_at_"
#: Blender's options that render from the command line.
RENDERS = {"-a", "--render-anim", "-f", "--render-frame"}

_said = {}  # identity of an object -> what was last said of it


def is_fixed(item):
    """True of an object of a library, which nothing here may change. That is said once."""
    if item.library is None:
        return False
    say(item, f"{item.name} comes from {item.library.filepath} and stays as it was saved there; a library override of it follows its run")
    return True


def own_mesh(item, shows_the_same):
    """The mesh of an object, which gets one of its own if it is a library's or that of an object for which shows_the_same is false."""
    mesh = item.data
    if mesh.library is not None or mesh.users > 1 and any(
            other.data == mesh and other != item and not shows_the_same(other) for other in bpy.data.objects):
        item.data = mesh.copy()
    return item.data


def say(item, sentence):
    """On standard error, unless it was the last that was said of the object."""
    if _said.get(compat.identity(item)) != sentence:
        _said[compat.identity(item)] = sentence
        sys.stderr.write(f"meniscus: {sentence}\n")


def fail(item, error):
    """Tells that an object does not show what it should. A render from the command line ends: its picture would be another."""
    item[ERROR] = str(error) or type(error).__name__
    say(item, f"error: {item.name}: {item[ERROR]}")
    if motion.is_rendering() and bpy.app.background and RENDERS & set(sys.argv) and not item.hide_render:
        sys.stderr.write(f"meniscus: error: no picture of frame {bpy.context.scene.frame_current}: {item.name}: {item[ERROR]}\n")
        sys.stderr.flush()
        os._exit(3)  # an exception in a handler changes nothing


def succeed(item):
    item[ERROR] = ""
    _said.pop(compat.identity(item), None)


def _stored(item, name):
    return getattr(getattr(item, "meniscus", None), name, "") if name in SETTINGS else str(item.get(name, ""))


def path_of(item, name):
    """The absolute path of a file that an object names. What is relative counts from the .blend that the object comes from; if that was
    saved elsewhere, or the object appended, it is still found where it was."""
    stored, override = _stored(item, name), item.override_library
    library = item.library
    if override is not None and _stored(override.reference, name) == stored:
        library = override.reference.library
    found = os.path.normpath(bpy.path.abspath(stored, library=library)) if stored else ""
    told, at = item.get(AT + name, ("", ""))
    is_elsewhere = stored.startswith("//") and told == stored and os.path.exists(at) and not (library is not None and os.path.exists(found))
    return at if is_elsewhere else found


def gone(item, *names):
    """A sentence about the first of the files of an object that is not there, or None."""
    paths = [path_of(item, name) for name in names]
    return next((f"{path}: no such file; what was last read stays" for path in paths if path and not os.path.exists(path)), None)


def note(item):
    """Remembers where relative paths of an object lead, if that is new or there is a file."""
    for name in (*CUSTOM, *SETTINGS):
        stored = _stored(item, name)
        found = os.path.normpath(bpy.path.abspath(stored)) if stored.startswith("//") else ""
        if found and (os.path.exists(found) or item.get(AT + name, ("",))[0] != stored):
            item[AT + name] = [stored, found]


def _local():
    return [item for item in bpy.data.objects if item.library is None and item.override_library is None]


def _count_from(folder):
    """Has relative paths of this file's own objects count from another folder, as Blender does with those of its own."""
    for item in _local():
        for name in (*CUSTOM, *SETTINGS):
            stored = _stored(item, name)
            if not stored.startswith("//"):
                continue
            told, at = item.get(AT + name, ("", ""))
            path = at if told == stored else path_of(item, name)
            try:
                wanted = bpy.path.relpath(path, start=folder)
            except ValueError:  # on another drive of Windows
                wanted = path
            item[AT + name] = [wanted, path]
            if wanted != stored and name in SETTINGS:
                setattr(item.meniscus, name, wanted)
            elif wanted != stored:
                item[name] = wanted


@persistent
def on_save(path=None, *_arguments):
    """Before and after. path: of the file that is written, which Blender tells before it is from 4.0 on."""
    target = path if isinstance(path, str) and path else bpy.data.filepath
    if target:
        _count_from(os.path.dirname(target))


@persistent
def on_saved(*_arguments):
    on_save(bpy.data.filepath)


@persistent
def on_load(*_arguments):
    _said.clear()
    for item in _local():
        note(item)


HANDLERS = (("save_pre", on_save), ("save_post", on_saved), ("load_post", on_load))
