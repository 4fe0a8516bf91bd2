# SPDX-License-Identifier: BSD-3-Clause
"""Colours of atoms: numbers, with and without alpha, and names."""
from __future__ import annotations

import functools
from typing import Any

import numpy as np

from . import _library as lib
from ._arrays import real_array
from ._errors import InputError, UsageError
from ._molecule_file import as_file, opened
from ._types import AnyArray


@functools.lru_cache(maxsize=None)
def _atom() -> lib.Handle:
    """Returns a molecule of one atom, which the library colours."""
    with as_file(b"1\n\nC 0 0 0\n") as path:
        return opened(path)


@functools.lru_cache(maxsize=1024)
def color_of(name: str) -> tuple[float, float, float]:
    """Returns the sRGB of a name such as "red", or of "#rrggbb". Raises InputError for other texts."""
    color = np.empty(3, np.float32)
    try:
        lib.call("structure_colors", _atom().pointer, name.encode(), color.ctypes.data)
    except UsageError as error:
        if "is not one of" not in str(error):  # of a build without colours
            raise
        raise InputError(f"colors has {name!r}, no colour such as red or #rrggbb; Structure.colors() has those of "
                         "schemes") from None
    red, green, blue = color.tolist()
    return red, green, blue


def atom_colors(colors: Any, atom_count: int) -> AnyArray:
    """Returns a contiguous array of floats, (atom_count, 3), from one colour or from one colour per atom.

    colors: sRGB in [0, 1], (3,) or (n, 3), also with an alpha of 1, (4,) or (n, 4), as matplotlib has it; or one name
    or n names of colours. Raises InputError for other shapes and for colours that are not opaque."""
    names = np.asarray(colors) if isinstance(colors, (str, list, tuple, np.ndarray)) else np.empty(0)
    if names.dtype.kind == "U":
        given = np.array([color_of(str(name)) for name in names.flat], np.float32).reshape(*names.shape, 3)
    else:
        given = real_array(colors, "colors").astype(np.float32)
    if given.shape in ((4,), (atom_count, 4)):
        if (given[..., 3] != 1).any():
            raise InputError("colors has an alpha below 1, which colours of atoms do not have; opacity is a value of a "
                             "scene")
        given = given[..., :3]
    if given.shape not in ((3,), (atom_count, 3)):
        raise InputError(f"colors has the shape {given.shape}; it has to be (3,) or ({atom_count}, 3)")
    return np.array(np.broadcast_to(given, (atom_count, 3)), order="C")
