# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads and checks a storyboard, and computes its cameras between scenes, with numpy alone; knows nothing of Blender (FORMAT.md)."""

import math
import os

import numpy as np

try:
    from . import camera_reader, mns_reader
except ImportError:  # outside of the add-on
    import camera_reader
    import mns_reader

VERSION = 1
#: Longer than any film.
MOST_FRAMES = 10_000_000


class Scene:
    """name, title: texts. path: of its .mns file. first, last: the frames that show it. camera: a dict as in a .mns header.
    background: sRGB, or None."""

    def __init__(self, name, title, path, first, last, camera, background):
        self.name, self.title, self.path = name, title, path
        self.first, self.last = first, last
        self.camera, self.background = camera, background


class Storyboard:
    """scenes: list of Scene, two or more. origin: Å. scale: Blender units per Å. is_smooth: transitions start and end slowly."""

    def __init__(self, path, header, scenes):
        self.path, self.scenes = path, scenes
        self.origin = np.array(header["origin"], dtype=np.float64)
        self.scale, self.fps = float(header["scale"]), float(header["fps"])
        self.is_smooth = header["ease"] == "smooth"

    @property
    def stem(self):
        return os.path.splitext(os.path.basename(self.path))[0]

    def share(self, time):
        """How much of the way of a transition is done after a share of its time."""
        return time * time * (3.0 - 2.0 * time) if self.is_smooth else time


def read(path):
    """The storyboard that a file describes. Its .mns files may not be there yet. Raises MnsError or OSError."""
    header = mns_reader.read_json(path, ", such as meniscus film --to blender writes")
    if not isinstance(header, dict) or header.get("format") != "meniscus storyboard":
        raise mns_reader.MnsError(f"{path}: not a storyboard of Meniscus")
    version = header.get("version")
    if not isinstance(version, int) or isinstance(version, bool) or version < 1:
        raise mns_reader.MnsError(f"{path}: version {version!r} does not exist")
    if version > VERSION:
        raise mns_reader.MnsError(f"{path}: version {version} is newer than this add-on knows ({VERSION}); update it")
    try:
        good = _are_numbers(header["origin"], 3) and all(_are_numbers([header[key]], 1) and header[key] > 0 for key in ("scale", "fps"))
        good = good and header["ease"] in ("smooth", "even")
    except (KeyError, TypeError):
        good = False
    if not good:
        raise mns_reader.MnsError(f"{path}: origin, scale, fps or ease is missing or not valid")
    entries = header.get("scenes")
    if not isinstance(entries, list) or len(entries) < 2:
        raise mns_reader.MnsError(f"{path}: it lists fewer than two scenes")
    scenes = [_scene(path, entry, number) for number, entry in enumerate(entries, 1)]
    for number, (before, after) in enumerate(zip(scenes, scenes[1:]), 2):
        if after.first <= before.last:
            raise mns_reader.MnsError(f"{path}: scene {number} begins at frame {after.first}, before the one before it has ended")
    return Storyboard(path, header, scenes)


def _are_numbers(values, count):
    return (isinstance(values, list) and len(values) == count
            and all(type(value) in (int, float) and abs(value) < 1e100 for value in values))


def _scene(path, entry, number):
    try:
        name, file, first, last = (entry[key] for key in ("name", "file", "first", "last"))
        title, background = entry.get("title", ""), entry.get("background")
        plain = isinstance(file, str) and file == os.path.basename(file) and "\\" not in file and file not in ("", ".", "..")
        if not plain or not isinstance(name, str) or not isinstance(title, str):
            raise ValueError("name, title or file is not a plain text")
        if type(first) is not int or type(last) is not int or not 1 <= first <= last <= MOST_FRAMES:
            raise ValueError(f"it cannot last from frame {first!r} to {last!r}")
        if background is not None and not (_are_numbers(background, 3) and 0.0 <= min(background) <= max(background) <= 1.0):
            raise ValueError("background is not three numbers from 0 to 1")
        if not isinstance(entry["camera"], dict):
            raise ValueError("camera is not an object")
        camera_reader.check(entry["camera"])
    except KeyError as error:
        raise mns_reader.MnsError(f"{path}: scene {number}: {error} is missing or unknown") from None
    except (TypeError, ValueError, OverflowError, AttributeError) as error:
        raise mns_reader.MnsError(f"{path}: scene {number}: {error}") from None
    return Scene(name, title, os.path.join(os.path.dirname(path), file), first, last, entry["camera"], background)
