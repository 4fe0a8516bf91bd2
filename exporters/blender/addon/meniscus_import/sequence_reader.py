# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads and checks manifests of sequences of .mns files and storyboards (FORMAT.md), cameras that --save-camera writes,
and frames of a sequence as data of a mesh. It uses numpy only, not Blender, so that another process can read frames
ahead."""

import dataclasses
import math
import os
import re

import numpy as np

from . import joined, mesh_arrays, mns_reader

VERSION = 1
#: The greatest number of frames, which is longer than any film.
MOST_FRAMES = 10_000_000
#: Tests of the values of a manifest. The first four are needed.
VALUES = {
    "run": mns_reader.TEXT, "origin": mns_reader.VECTOR, "scale": mns_reader.POSITIVE,
    "fps": mns_reader.POSITIVE, "atoms": mns_reader.NUMBER, **mns_reader.SOURCE}
#: The choices for times before and after a run.
OUTSIDE = ("EMPTY", "HOLD", "LOOP", "PINGPONG")


class Timing:
    """The times of a run in a scene. start: the scene frame that shows its first frame. speed: frames of the run per
    scene frame, above 0. outside: one of OUTSIDE. Raises MnsError for invalid values."""

    def __init__(self, start=1.0, speed=1.0, outside="EMPTY"):
        if not (math.isfinite(start) and math.isfinite(speed) and speed > 0.0 and outside in OUTSIDE):
            raise mns_reader.MnsError(f"start {start}, speed {speed} or {outside} outside of the run is not valid")
        self.start, self.speed, self.outside = start, speed, outside

    def scene_time(self, place):
        """Returns the time of the scene at which the frame at a place of the run, from 1, is shown."""
        return self.start + (place - 1) / self.speed

    def place(self, time, count):
        """Returns the place in a run of `count` frames that is nearest to a time of the scene, or None if nothing is
        shown."""
        return self.within((time - self.start) * self.speed + 1.0, count)

    def within(self, place, count):
        """Returns the place in a run of `count` frames for a place that may be fractional or outside of the run, or
        None if nothing is shown."""
        index = math.floor(place + 0.5) - 1
        if self.outside == "LOOP":
            index %= count
        elif self.outside == "PINGPONG":
            index %= max(2 * count - 2, 1)
            index = min(index, 2 * count - 2 - index)
        elif self.outside == "HOLD":
            index = min(max(index, 0), count - 1)
        return index + 1 if 0 <= index < count else None


class Frame:
    """A frame of a sequence. number: its frame number in the trajectory. path: its .mns file. camera: a dict with the
    keys of a .mns header, or None."""

    def __init__(self, number, path, camera):
        self.number = number
        self.path = path
        self.camera = camera


class Sequence:
    """A sequence of surfaces. frames: list of Frame; scene frame n, from 1, is frames[n - 1]. origin: Å. scale: Blender
    units per Å. fps: frames per second. run: the name of the run."""

    def __init__(self, path, header, frames):
        self.path = path
        self.header = header
        self.frames = frames
        self.origin = np.array(header["origin"], dtype=np.float64)
        self.scale = float(header["scale"])
        self.fps = float(header["fps"])
        self.run = header["run"]
        self._scene_frame = {frame.number: index for index, frame in enumerate(frames, 1)}

    @property
    def stem(self):
        return os.path.splitext(os.path.basename(self.path))[0]

    @property
    def camera_moves(self):
        return any(frame.camera != self.frames[0].camera for frame in self.frames)

    def set_camera(self, camera):
        """Sets the camera of all frames to a dict. Pictures keep their size."""
        for frame in self.frames:
            size = {key: value for key, value in (frame.camera or {}).items() if key == "size"}
            frame.camera = {**camera, **size}

    def scene_frame(self, number):
        """Returns the scene frame of a frame number of the trajectory, or None if it is not in the run."""
        return self._scene_frame.get(number)

    def read(self, scene_frame):
        """Reads the .mns file of a scene frame. Raises MnsError or OSError if it is missing, damaged, or of another
        run."""
        frame = self.frames[scene_frame - 1]
        if not os.path.exists(frame.path):
            raise mns_reader.MnsError(f"{frame.path}: missing; it is frame {frame.number} (scene frame {scene_frame})")
        file = mns_reader.read(frame.path)
        place = file.header.get("sequence")
        if not isinstance(place, dict) or place.get("run") != self.run or place.get("frame") != frame.number:
            raise mns_reader.MnsError(
                f"{frame.path}: not frame {frame.number} of this run ({self.path}); export it again")
        return file


def read(path):
    """Returns the sequence that a manifest describes. Its .mns files need not exist yet. Raises MnsError or OSError."""
    header = mns_reader.read_manifest(path, "meniscus surface sequence", "the manifest of a sequence of surfaces",
                                      VERSION, VALUES, ("run", "origin", "scale", "fps"))
    entries = header.get("frames")
    if not isinstance(entries, list) or not entries:
        raise mns_reader.MnsError(f"{path}: it lists no frames")
    frames = [_frame(path, header, entry) for entry in entries]
    if len({frame.number for frame in frames}) != len(frames):
        raise mns_reader.MnsError(f"{path}: a frame appears twice")
    return Sequence(path, header, frames)


def is_plain(name):
    """Returns True if a value is the name of a file in the folder of its manifest."""
    return (isinstance(name, str) and name == os.path.basename(name) and "\\" not in name and
            name not in ("", ".", ".."))


def _frame(path, header, entry):
    try:
        number, name = entry["frame"], entry["file"]
        if not is_plain(name) or isinstance(number, bool) or not isinstance(number, int) or number < 0:
            raise ValueError(f"no frame is {mns_reader.shortened(number)} in a file {mns_reader.shortened(name)}")
        camera = entry.get("camera", header.get("camera"))
        if camera is not None:
            mns_reader.check_camera(camera)
    except (KeyError, TypeError, ValueError) as error:
        raise mns_reader.MnsError(f"{path}: an entry of the list of frames is not valid: {error}") from None
    return Frame(number, os.path.join(os.path.dirname(path), name), camera)


def parse_frames(text, known):
    """Returns the frame numbers of a text such as "0-99:10,250,300-", each once and in order. Its parts are frames,
    first-last:step, or first- up to the last of `known`. "all" means all of `known`. Raises ValueError with one
    sentence."""
    known = list(known)
    if text == "all":
        return known
    numbers = []
    for part in text.split(","):
        found = re.fullmatch(r"([0-9]+)(?:(-)([0-9]*)(?::([0-9]+))?)?", part)
        if not found:
            raise ValueError(f"'{part}' is not a frame, first-last, or first-last:step")
        first, dash, last, step = found.groups()
        begin, stride = int(first), int(step or 1)
        end = int(last) if last else max(known) if dash else begin
        if end < begin or stride < 1 or (end - begin) // stride >= MOST_FRAMES:
            raise ValueError(f"'{part}' names no frames, or too many")
        numbers.extend(range(begin, end + 1, stride))
    return list(dict.fromkeys(numbers))


def read_camera(path):
    """Returns the camera of a file as a dict with the keys of a .mns header. Raises MnsError or OSError."""
    camera = mns_reader.read_json(path, ", such as --save-camera writes")
    if not isinstance(camera, dict) or str(camera.get("projection")) not in mns_reader.SIZES:
        raise mns_reader.MnsError(f"{path}: no camera: its projection is neither perspective nor orthographic")
    unknown = set(camera) - {*mns_reader.VECTORS, "projection", mns_reader.SIZES[camera["projection"]]}
    if unknown:
        raise mns_reader.MnsError(f"{path}: camera: '{min(unknown)}' is not a key of a camera of this projection")
    try:
        mns_reader.check_camera(camera)
    except ValueError as error:
        raise mns_reader.MnsError(f"{path}: camera: {error}") from None
    return camera


#: Tests of the values of a storyboard, all of which are needed, and of a scene, of which title and background are
#: optional.
OF_STORYBOARD = {
    "origin": mns_reader.VECTOR, "scale": mns_reader.POSITIVE, "fps": mns_reader.POSITIVE,
    "ease": (lambda value: value in ("smooth", "even"), "smooth or even")}
OF_SCENE = {
    "name": mns_reader.TEXT, "title": mns_reader.TEXT, "file": mns_reader.TEXT, "camera": mns_reader.DICT,
    "background": (lambda value: value is None or mns_reader.COLOR[0](value), mns_reader.COLOR[1])}


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

    def share(self, time):
        """Returns the progress of a transition, from 0 to 1, after a share of its time."""
        return time * time * (3.0 - 2.0 * time) if self.is_smooth else time


def read_storyboard(path):
    """Returns the storyboard that a file describes. Its .mns files need not exist yet. Raises MnsError or OSError."""
    header = mns_reader.read_manifest(path, "meniscus storyboard", "a storyboard of Meniscus", VERSION, OF_STORYBOARD,
                                      OF_STORYBOARD, ", such as meniscus film --to blender writes")
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
        mns_reader.check(entry, OF_SCENE, ("name", "file", "camera"))
        name, file, first, last = (entry[key] for key in ("name", "file", "first", "last"))
        title, background = entry.get("title", ""), entry.get("background")
        if not is_plain(file):
            raise ValueError(f"file is {mns_reader.shortened(file)}, not a name in the storyboard's folder")
        if type(first) is not int or type(last) is not int or not 1 <= first <= last <= MOST_FRAMES:
            raise ValueError(
                f"it cannot last from frame {mns_reader.shortened(first)} to {mns_reader.shortened(last)}")
        mns_reader.check_camera(entry["camera"])
    except KeyError as error:
        raise mns_reader.MnsError(f"{path}: scene {number}: {error} is missing or unknown") from None
    except (TypeError, ValueError) as error:
        raise mns_reader.MnsError(f"{path}: scene {number}: {error}") from None
    return Scene(name, title, os.path.join(os.path.dirname(path), file), first, last, entry["camera"], background)


@dataclasses.dataclass
class Prepared:
    """A frame that is ready for a mesh. surface: all objects and copies as one, with their materials and chains.
    arrays: the arrays of its mesh. points: all atoms in all places, (n, 3) Å. triangles: the expected number of
    triangles."""

    surface: mns_reader.Surface
    arrays: mesh_arrays.MeshArrays
    points: np.ndarray
    triangles: int


def prepare(sequence, scene_frame, origin, scale, crisp):
    """Returns the Prepared of a scene frame. sequence: a Sequence. origin: Å. scale, crisp: arguments
    of mesh_arrays.of_surface(). Raises MnsError or OSError."""
    file = sequence.read(scene_frame)
    surface = joined.joined(file, origin)
    arrays = mesh_arrays.of_surface(surface, scale, crisp, mesh_arrays.names_of(surface))
    triangles = sum(len(each.copies) * each.header["mesh"]["triangles"] for each in file.objects)
    return Prepared(surface, arrays, points_of(file), triangles)


def points_of(file):
    """Returns the centres of all atoms of a file in all places, (n, 3) Å."""
    return np.concatenate(
        [surface["atom.center"] @ copy[:, :3].T + copy[:, 3] for surface in file.objects for copy in surface.copies])


def packed(prepared):
    """Returns a Prepared as plain values and arrays, which can be sent to another process."""
    surface = prepared.surface
    # Empty arrays show only which of these exist.
    existing = {name: np.empty(0) for name in ("atom.opacity", "mesh.cap_plane") if surface.get(name) is not None}
    return {
        "path": surface.path, "header": surface.header, "existing": existing, "arrays": vars(prepared.arrays),
        "points": prepared.points, "triangles": prepared.triangles}


def unpacked(given):
    """Returns the Prepared that was packed. The arrays of its surface are empty; they only determine its materials."""
    surface = mns_reader.Surface(given["path"], given["header"], given["existing"])
    return Prepared(surface, mesh_arrays.MeshArrays(**given["arrays"]), given["points"], given["triangles"])


class Manifests:
    """A cache of sequences by the paths of their manifests. A manifest is read again when its file has changed."""

    def __init__(self):
        self._read = {}  # path -> ((modification time, size), sequence)

    def get(self, path):
        """Returns the sequence of a manifest. Raises MnsError or OSError."""
        stamp = mns_reader.stamp(path)
        if self._read.get(path, (None,))[0] != stamp:
            self._read[path] = (stamp, read(path))
        return self._read[path][1]

    def clear(self):
        self._read.clear()
