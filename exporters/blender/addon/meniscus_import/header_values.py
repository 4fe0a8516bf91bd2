# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks the values of headers and manifests before anything is made of them; knows nothing of Blender."""

import reprlib

import numpy as np

#: Above this a number has no square, or none that Blender's single precision holds once it is scaled.
TOO_LARGE = 1e30
#: A value as messages have it, cut short.
told = reprlib.repr


def is_number(value, low=-TOO_LARGE, high=TOO_LARGE):
    """True of a finite number from low to high; of True and False it is false."""
    return type(value) in (int, float) and low <= value <= high


def are_numbers(values, count, low=-TOO_LARGE, high=TOO_LARGE):
    """True of a list of `count` such numbers."""
    return isinstance(values, list) and len(values) == count and all(is_number(value, low, high) for value in values)


def is_text(value):
    """True of a text that Blender takes: without zeros and halves of characters."""
    return isinstance(value, str) and not any(each == "\0" or "\ud800" <= each <= "\udfff" for each in value)


def _number(low, high, words):
    return lambda value: is_number(value, low, high), words


def _list_of(count, words):
    return lambda value: isinstance(value, list) and len(value) > 0 and all(are_numbers(each, count) for each in value), words


#: Pairs of a test and words for what passes it.
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
SIZE = (lambda value: are_numbers(value, 2, 1, 65536) and all(type(each) is int for each in value), "two whole numbers from 1 to 65536")
SOURCE = {"source": DICT, "source.file": TEXT}
#: Of cameras: the key of what they see, by projection, and what others hold.
SIZES = {"perspective": "vertical_fov", "orthographic": "height"}
VECTORS = ("position", "target", "up")
CAMERA = {**{key: VECTOR for key in VECTORS}, "size": SIZE, "shadows": SHARE, "shadow_softness": _number(0.0, 90.0, "a number from 0 to 90"),
          "projection": (lambda value: isinstance(value, str) and value in SIZES, "perspective or orthographic"),
          "vertical_fov": _number(1e-9, 179.999999, "a number above 0 and below 180"), "height": POSITIVE}


def check(header, table, needed=()):
    """Raises ValueError with one sentence for the first value of a header that is not what the table says: key -> a pair as
    above, a dot between a key and one inside of it. Keys that are not needed may be missing."""
    for key, (is_good, words) in table.items():
        holder = header
        *outer, last = key.split(".")
        for each in outer:
            holder = holder.get(each, {})
        if last in holder and not is_good(holder[last]):
            raise ValueError(f"{key} is {told(holder[last])}, not {words}")
        if last not in holder and key in needed:
            raise ValueError(f"{key} is missing")


def check_camera(camera):
    """Raises ValueError with one sentence for a camera that lacks something or has senseless values."""
    if not isinstance(camera, dict):
        raise ValueError(f"it is {told(camera)}, not an object")
    check(camera, CAMERA, (*VECTORS, "projection"))
    check(camera, CAMERA, (SIZES[camera["projection"]],))
    position, target, up = (np.array(camera[key], dtype=np.float64) for key in VECTORS)
    view = target - position
    if np.linalg.norm(np.cross(view, up)) <= 1e-9 * np.linalg.norm(view) * np.linalg.norm(up):
        raise ValueError("position equals target, or up points along the view")
