# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks the values of headers and manifests before they are used. It does not use Blender."""

import reprlib

import numpy as np

#: Larger numbers have no finite square, or none that Blender's single precision can hold after scaling.
TOO_LARGE = 1e30
#: Returns a shortened text of a value for messages.
shortened = reprlib.repr


def is_number(value, low=-TOO_LARGE, high=TOO_LARGE):
    """True if a value is a finite number from low to high. Booleans are not numbers."""
    return type(value) in (int, float) and low <= value <= high


def are_numbers(values, count, low=-TOO_LARGE, high=TOO_LARGE):
    """True if a value is a list of `count` numbers from low to high."""
    return isinstance(values, list) and len(values) == count and all(is_number(value, low, high) for value in values)


def is_text(value):
    """True if a value is a text that Blender accepts: without zero characters and lone surrogates."""
    return isinstance(value, str) and not any(each == "\0" or "\ud800" <= each <= "\udfff" for each in value)


def _number(low, high, words):
    return lambda value: is_number(value, low, high), words


def _list_of(count, words):
    return lambda value: isinstance(value, list) and len(value) > 0 and all(are_numbers(each, count)
                                                                            for each in value), words


#: Pairs of a test and a description of the values that pass it.
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
SIZE = (lambda value: are_numbers(value, 2, 1, 65536) and all(type(each) is int
                                                              for each in value), "two whole numbers from 1 to 65536")
SOURCE = {"source": DICT, "source.file": TEXT}
#: The key of a camera's field of view by its projection, the keys of its vectors, and the tests of all keys.
SIZES = {"perspective": "vertical_fov", "orthographic": "height"}
VECTORS = ("position", "target", "up")
CAMERA = {
    **{key: VECTOR for key in VECTORS}, "size": SIZE, "shadows": SHARE,
    "shadow_softness": _number(0.0, 90.0, "a number from 0 to 90"),
    "projection": (lambda value: isinstance(value, str) and value in SIZES, "perspective or orthographic"),
    "vertical_fov": _number(1e-9, 179.999999, "a number above 0 and below 180"), "height": POSITIVE}


def check(header, table, needed=()):
    """Raises ValueError with one sentence for the first value of a header that fails its test. table: key -> a pair of
    a test and a description; a dot separates a key from a key inside it. needed: the keys that must exist."""
    for key, (is_good, words) in table.items():
        holder = header
        *outer, last = key.split(".")
        for each in outer:
            holder = holder.get(each, {})
        if last in holder and not is_good(holder[last]):
            raise ValueError(f"{key} is {shortened(holder[last])}, not {words}")
        if last not in holder and key in needed:
            raise ValueError(f"{key} is missing")


def check_camera(camera):
    """Raises ValueError with one sentence if a camera lacks a key or has invalid values."""
    if not isinstance(camera, dict):
        raise ValueError(f"it is {shortened(camera)}, not an object")
    check(camera, CAMERA, (*VECTORS, "projection"))
    check(camera, CAMERA, (SIZES[camera["projection"]],))
    position, target, up = (np.array(camera[key], dtype=np.float64) for key in VECTORS)
    view = target - position
    if np.linalg.norm(np.cross(view, up)) <= 1e-9 * np.linalg.norm(view) * np.linalg.norm(up):
        raise ValueError("position equals target, or up points along the view")
