# SPDX-License-Identifier: GPL-3.0-or-later
"""Handles data from other .blend files, paths of objects, and objects that cannot be shown."""

import os
import sys

import bpy
from bpy.app.handlers import persistent

from . import compat, motion

#: The custom property of an object with the error that occurred when it was last shown.
ERROR = "meniscus_error"
#: The custom properties and the settings in which objects store paths.
CUSTOM, SETTINGS = ("meniscus_file", "meniscus_sequence"), ("file", "trajectory", "numbers")
#: The prefix of a custom property for each of them, with the stored path and the absolute path that it means.
AT = "meniscus_at_"
#: Options of Blender that render from the command line.
RENDERS = {"-a", "--render-anim", "-f", "--render-frame"}

_last_message = {}  # identity of an object -> the last message about it


def is_fixed(item):
    """Returns True if an object belongs to a library, so that it must not be changed. A message says so once."""
    if item.library is None:
        return False
    report(item, f"{item.name} comes from {item.library.filepath} and stays as it was saved there; a library override "
           "of it follows its run")
    return True


def own_mesh(item, shows_the_same):
    """Returns the mesh of an object. The object gets a copy if the mesh belongs to a library, or to another object for
    which shows_the_same() is false."""
    mesh = item.data
    if mesh.library is not None or mesh.users > 1 and any(
            other.data == mesh and other != item and not shows_the_same(other) for other in bpy.data.objects):
        item.data = mesh.copy()
    return item.data


def report(item, sentence):
    """Prints a message about an object on standard error, unless it was the last message about it."""
    if _last_message.get(compat.identity(item)) != sentence:
        _last_message[compat.identity(item)] = sentence
        sys.stderr.write(f"meniscus: {sentence}\n")


def fail(item, error):
    """Reports that an object cannot be shown. A render from the command line ends, because its picture would be
    wrong."""
    item[ERROR] = str(error) or type(error).__name__
    report(item, f"error: {item.name}: {item[ERROR]}")
    if motion.is_rendering() and bpy.app.background and RENDERS & set(sys.argv) and not item.hide_render:
        sys.stderr.write(
            f"meniscus: error: no picture of frame {bpy.context.scene.frame_current}: {item.name}: {item[ERROR]}\n")
        sys.stderr.flush()
        os._exit(3)  # Blender ignores exceptions of handlers


def succeed(item):
    item[ERROR] = ""
    _last_message.pop(compat.identity(item), None)


def _stored(item, name):
    return getattr(getattr(item, "meniscus", None), name, "") if name in SETTINGS else str(item.get(name, ""))


def path_of(item, name):
    """Returns the absolute path of a file that an object names. A relative path is relative to the .blend of the
    object. If that was saved to another folder, or the object was appended, the file is still found in its old
    place."""
    stored, override = _stored(item, name), item.override_library
    library = item.library
    if override is not None and _stored(override.reference, name) == stored:
        library = override.reference.library
    found = os.path.normpath(bpy.path.abspath(stored, library=library)) if stored else ""
    noted, at = item.get(AT + name, ("", ""))
    is_elsewhere = (stored.startswith("//") and noted == stored and os.path.exists(at) and
                    not (library is not None and os.path.exists(found)))
    return at if is_elsewhere else found


def gone(item, *names):
    """Returns a sentence about the first file of an object that does not exist, or None."""
    paths = [path_of(item, name) for name in names]
    return next((f"{path}: no such file; what was last read stays"
                 for path in paths if path and not os.path.exists(path)), None)


def note(item):
    """Stores the absolute paths that the relative paths of an object mean, if a relative path is new or its file
    exists."""
    for name in (*CUSTOM, *SETTINGS):
        stored = _stored(item, name)
        found = os.path.normpath(bpy.path.abspath(stored)) if stored.startswith("//") else ""
        if found and (os.path.exists(found) or item.get(AT + name, ("",))[0] != stored):
            item[AT + name] = [stored, found]


def _local():
    return [item for item in bpy.data.objects if item.library is None and item.override_library is None]


def _count_from(folder):
    """Makes the relative paths of this file's own objects relative to another folder, as Blender does with its own
    paths."""
    for item in _local():
        for name in (*CUSTOM, *SETTINGS):
            stored = _stored(item, name)
            if not stored.startswith("//"):
                continue
            noted, at = item.get(AT + name, ("", ""))
            path = at if noted == stored else path_of(item, name)
            try:
                wanted = bpy.path.relpath(path, start=folder)
            except ValueError:  # the file is on another drive of Windows
                wanted = path
            item[AT + name] = [wanted, path]
            if wanted != stored and name in SETTINGS:
                setattr(item.meniscus, name, wanted)
            elif wanted != stored:
                item[name] = wanted


@persistent
def on_save(path=None, *_arguments):
    """Updates relative paths before and after saving. path: the path of the written file, which Blender passes from 4.0
    on."""
    target = path if isinstance(path, str) and path else bpy.data.filepath
    if target:
        _count_from(os.path.dirname(target))


@persistent
def on_saved(*_arguments):
    on_save(bpy.data.filepath)


@persistent
def on_load(*_arguments):
    _last_message.clear()
    for item in _local():
        note(item)


HANDLERS = (("save_pre", on_save), ("save_post", on_saved), ("load_post", on_load))
