# SPDX-License-Identifier: BSD-3-Clause
"""Pictures, cameras, colours of atoms, and the renderers that draw pictures."""
from __future__ import annotations

import atexit
import ctypes
import functools
import os
import struct
import threading
import zlib
from dataclasses import dataclass
from typing import IO, Any, Optional, Union

import numpy as np

from . import _header as header
from ._arguments import AnyArray, Bytes, Path, Projection, number, word
from ._arrays import as_file, handle_of, real_array
from ._errors import InputError, UsageError, wrong_type
from ._library import Handle, call
from ._written import save_bytes

DEVICES = {"cpu": header.CPU, "auto": header.AUTO, "gpu": header.GPU, "software": header.SOFTWARE}
_PROJECTIONS = {"perspective": header.PERSPECTIVE, "orthographic": header.ORTHOGRAPHIC}


class _Sealed:
    """A base class that refuses attributes other than the fields of the dataclass."""

    def __setattr__(self, name: str, value: Any) -> None:
        fields = getattr(self, "__dataclass_fields__")
        if name not in fields:
            raise AttributeError(f"a {type(self).__name__} has no {name!r}, but {', '.join(fields)}")
        super().__setattr__(name, value)


@dataclass
class Camera(_Sealed):
    """A camera.

    position, target: the point from which and the point to which the camera looks, in Å. up: a direction that points to
    the upper edge of the picture. projection: "perspective" or "orthographic". vertical_fov: degrees between the lower
    and the upper edge of the picture; perspective only. height: Å between these edges; orthographic only.

    >>> camera = meniscus.surface([[0, 0, 0]], 1.7).camera(projection="orthographic")
    >>> camera.height = 10.0
    >>> camera.target, camera.up
    ((0.0, 0.0, 0.0), (0.0, 1.0, 0.0))"""
    position: tuple[float, float, float]
    target: tuple[float, float, float]
    up: tuple[float, float, float]
    projection: Projection = "perspective"
    vertical_fov: float = 30.0
    height: float = 1.0

    def _struct(self) -> header.Camera:
        struct = header.Camera(ctypes.sizeof(header.Camera))
        struct.position, struct.target = _three(self.position, "position", 1), _three(self.target, "target", 1)
        struct.up, struct.vertical_fov, struct.height = _three(self.up, "up"), self.vertical_fov, self.height
        struct.projection = word("projection", self.projection, _PROJECTIONS)
        return struct


def _three(values: Any, name: str, power: Optional[int] = None) -> tuple[float, float, float]:
    """Returns three numbers, converted to Å to this power if they have a unit. Raises InputError for other shapes."""
    array = real_array(values, name, power)
    if array.shape != (3,):
        raise InputError(f"{name} has the shape {array.shape}; it has to be (3,)")
    x, y, z = map(float, array)
    return x, y, z


def framed(surface: Handle, aspect: float, projection: Projection) -> Camera:
    """Returns the camera that shows all atoms of a surface. aspect: width / height of the picture."""
    c = header.Camera(ctypes.sizeof(header.Camera))
    call("surface_camera", surface.pointer, number("aspect", aspect), word("projection", projection, _PROJECTIONS),
         ctypes.byref(c))
    return Camera(_three(c.position, "position"), _three(c.target, "target"), _three(c.up, "up"),
                  "orthographic" if c.projection == header.ORTHOGRAPHIC else "perspective", c.vertical_fov, c.height)


@dataclass
class Picture(_Sealed):
    """A picture, which a notebook shows.

    pixels: bytes, (height, width, 4), rows from the top: sRGB red, green and blue, and alpha, which is not
    premultiplied.

    >>> picture = meniscus.surface([[0, 0, 0]], 1.7).render(size="80x60", device="cpu")
    >>> picture.pixels.shape, picture.pixels.dtype
    ((60, 80, 4), dtype('uint8'))"""
    pixels: Bytes

    @property
    def __array_interface__(self) -> dict[str, Any]:
        return {**self.pixels.__array_interface__, "strides": self.pixels.strides}  # Pillow calls tobytes() then

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> AnyArray:
        return np.array(self.pixels, dtype=dtype) if copy or dtype else self.pixels

    def tobytes(self) -> bytes:
        """Returns the bytes of the pixels.

        >>> len(picture.tobytes())
        19200"""
        return self.pixels.tobytes()

    def png(self) -> bytes:
        """Returns the bytes of a PNG file.

        >>> picture.png()[1:4]
        b'PNG'"""
        height, width, _ = self.pixels.shape

        def chunk(name: bytes, content: bytes) -> bytes:
            return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))

        rows = np.zeros((height, 1 + 4 * width), dtype=np.uint8)  # each row begins with the number of its filter, 0
        rows[:, 1:] = self.pixels.reshape(height, 4 * width)
        return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)) +
                chunk(b"sRGB", b"\0") + chunk(b"IDAT", zlib.compress(rows.tobytes(), 6)) + chunk(b"IEND", b""))

    def save(self, path: Union[Path, IO[bytes]], *, replace: bool = False) -> None:
        """Writes the picture as a PNG file, completely or not at all. PIL.Image.fromarray(picture) writes others.

        path: a path that ends with .png, or a binary file object. replace: whether an existing file is replaced. Raises
        OutputError if the file cannot be written, or exists and is not replaced; UsageError for other endings.

        >>> picture.save("atom.png")"""
        if isinstance(path, (str, bytes, os.PathLike)) and not os.fsdecode(path).lower().endswith(".png"):
            raise UsageError(f"{os.fsdecode(path)!r} does not end with .png; PIL.Image.fromarray(picture) writes others")
        save_bytes(self.png(), path, replace)

    _repr_png_ = png

    def __repr__(self) -> str:
        height, width, _ = self.pixels.shape
        return f"<meniscus.Picture: {width}x{height}>"


@functools.lru_cache(maxsize=None)
def _atom() -> Handle:
    """Returns a molecule of one atom, which the library colours."""
    with as_file(b"1\n\nC 0 0 0\n") as path:
        return handle_of(path)


@functools.lru_cache(maxsize=1024)
def color_of(name: str) -> tuple[float, float, float]:
    """Returns the sRGB of a name such as "red", or of "#rrggbb". Raises InputError for other texts."""
    color = np.empty(3, np.float32)
    try:
        call("structure_colors", _atom().pointer, name.encode(), color.ctypes.data)
    except UsageError as error:
        if "is not one of" not in str(error):  # a build without colours
            raise
        raise InputError(f"colors has {name!r}, no colour such as red or #rrggbb; Structure.colors() has those of "
                         "schemes") from None
    red, green, blue = map(float, color)
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


_renderers: dict[str, Handle] = {}
_renderers_lock = threading.Lock()
atexit.register(_renderers.clear)  # before Python ends, so that threads of renderers end regularly


def renderer(device: str) -> Handle:
    """Returns the renderer of a device. Each device has one, so that kernels are compiled once."""
    kind = word("device", device, DEVICES)
    with _renderers_lock:
        if device not in _renderers:
            _renderers[device] = Handle("renderer", "renderer_new", kind)
        return _renderers[device]


def blank(scene: Handle) -> Picture:
    """Returns a transparent picture of the size of a scene."""
    width, height = ctypes.c_int32(), ctypes.c_int32()
    call("scene_size", scene.pointer, ctypes.byref(width), ctypes.byref(height))
    return Picture(np.zeros((height.value, width.value, 4), dtype=np.uint8))


def of_picture(colors: Any, atom_count: int, camera: Optional[Camera]) -> tuple[Any, Optional[header.Camera]]:
    """Returns the colours of atoms and the camera as arguments of meniscus_render(); None stays None."""
    if camera is not None and not isinstance(camera, Camera):
        raise wrong_type(f"camera is of the type {type(camera).__name__}, not a meniscus.Camera")
    return None if colors is None else atom_colors(colors, atom_count), None if camera is None else camera._struct()


def painted(surface: Handle, atom_count: int, scene: Handle, colors: Any, camera: Optional[Camera],
            device: str) -> Picture:
    """Returns a picture of a surface, as Surface.render() does."""
    of_atoms, seen_by = of_picture(colors, atom_count, camera)
    picture = blank(scene)
    call("render", renderer(device).pointer, surface.pointer, scene.pointer, ctypes.byref(seen_by) if seen_by else None,
         None if of_atoms is None else of_atoms.ctypes.data, picture.pixels.ctypes.data, picture.pixels.nbytes)
    return picture
