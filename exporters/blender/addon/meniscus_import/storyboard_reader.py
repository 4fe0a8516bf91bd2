# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads and checks a storyboard (FORMAT.md), and computes the progress of its transitions. Uses numpy only, not
Blender."""

import os

import numpy as np

try:
    from . import header_values, mns_reader
except ImportError:  # imported outside of the add-on
    import header_values
    import mns_reader

VERSION = 1
#: The greatest number of frames, which is longer than any film.
MOST_FRAMES = 10_000_000
#: Tests of the values of a storyboard, all of which are needed, and of a scene, of which title and background are
#: optional.
VALUES = {"origin": header_values.VECTOR, "scale": header_values.POSITIVE, "fps": header_values.POSITIVE,
          "ease": (lambda value: value in ("smooth", "even"), "smooth or even")}
OF_SCENE = {
    "name": header_values.TEXT, "title": header_values.TEXT, "file": header_values.TEXT, "camera": header_values.DICT,
    "background": (lambda value: value is None or header_values.COLOR[0](value), header_values.COLOR[1])}


class Scene:
    """A scene of a storyboard. name, title: texts. path: its .mns file. first, last: the range of frames that show it.
    camera: a dict with the keys of a .mns header. background: sRGB, or None."""

    def __init__(self, name, title, path, first, last, camera, background):
        self.name, self.title, self.path = name, title, path
        self.first, self.last = first, last
        self.camera, self.background = camera, background


class Storyboard:
    """A storyboard. scenes: list of two or more Scene. origin: Å. scale: Blender units per Å. fps: frames per second.
    is_smooth: True if transitions start and end slowly."""

    def __init__(self, path, header, scenes):
        self.path, self.scenes = path, scenes
        self.origin = np.array(header["origin"], dtype=np.float64)
        self.scale, self.fps = float(header["scale"]), float(header["fps"])
        self.is_smooth = header["ease"] == "smooth"

    @property
    def stem(self):
        return os.path.splitext(os.path.basename(self.path))[0]

    def share(self, time):
        """Returns the progress of a transition, from 0 to 1, after a share of its time."""
        return time * time * (3.0 - 2.0 * time) if self.is_smooth else time


def read(path):
    """Returns the storyboard that a file describes. Its .mns files need not exist yet. Raises MnsError or OSError."""
    header = mns_reader.read_manifest(path, "meniscus storyboard", "a storyboard of Meniscus", VERSION, VALUES, VALUES,
                                      ", such as meniscus film --to blender writes")
    entries = header.get("scenes")
    if not isinstance(entries, list) or len(entries) < 2:
        raise mns_reader.MnsError(f"{path}: it lists fewer than two scenes")
    scenes = [_scene(path, entry, number) for number, entry in enumerate(entries, 1)]
    for number, (before, after) in enumerate(zip(scenes, scenes[1:]), 2):
        if after.first <= before.last:
            raise mns_reader.MnsError(
                f"{path}: scene {number} begins at frame {after.first}, before the one before it has ended")
    return Storyboard(path, header, scenes)


def _scene(path, entry, number):
    try:
        header_values.check(entry, OF_SCENE, ("name", "file", "camera"))
        name, file, first, last = (entry[key] for key in ("name", "file", "first", "last"))
        title, background = entry.get("title", ""), entry.get("background")
        if file != os.path.basename(file) or "\\" in file or file in ("", ".", ".."):
            raise ValueError(f"file is {header_values.shortened(file)}, not a name in the storyboard's folder")
        if type(first) is not int or type(last) is not int or not 1 <= first <= last <= MOST_FRAMES:
            raise ValueError(f"it cannot last from frame {header_values.shortened(first)} to "
                             f"{header_values.shortened(last)}")
        header_values.check_camera(entry["camera"])
    except KeyError as error:
        raise mns_reader.MnsError(f"{path}: scene {number}: {error} is missing or unknown") from None
    except (TypeError, ValueError) as error:
        raise mns_reader.MnsError(f"{path}: scene {number}: {error}") from None
    return Scene(name, title, os.path.join(os.path.dirname(path), file), first, last, entry["camera"], background)
