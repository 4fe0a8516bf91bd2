# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of the exact surface, ray cast by GL, and PNG files of them."""
from __future__ import annotations

import atexit
import ctypes
import struct
import threading
import zlib
from dataclasses import dataclass
from typing import Any, Optional

import numpy as np

from ._arrays import color_of, put_colors
from ._errors import InputError
from ._types import Bytes, Projection
from ._library import DEVICES, ORTHOGRAPHIC, PROJECTIONS, CameraStruct, Handle, Picture, call, default, word


@dataclass
class Camera:
    """Where a picture is taken from; lengths in Å."""
    position: tuple[float, float, float]
    target: tuple[float, float, float]
    up: tuple[float, float, float]
    projection: Projection = "perspective"  #: or "orthographic"
    vertical_fov: float = 30.0       #: degrees between the picture's lower and upper edge; perspective only
    height: float = 1.0              #: Å between them; orthographic only

    def _struct(self) -> CameraStruct:
        return CameraStruct(ctypes.sizeof(CameraStruct), tuple(self.position), tuple(self.target), tuple(self.up),
                            self.vertical_fov, self.height, word("projection", self.projection, PROJECTIONS), 0)


def _three(values: Any) -> tuple[float, float, float]:
    x, y, z = values
    return x, y, z


def framed(surface: Handle, aspect: float, projection: Projection) -> Camera:
    """The camera that shows all of a surface."""
    c = CameraStruct(ctypes.sizeof(CameraStruct))
    call("surface_camera", surface.pointer, aspect, word("projection", projection, PROJECTIONS), ctypes.byref(c))
    return Camera(_three(c.position), _three(c.target), _three(c.up),
                  "orthographic" if c.projection == ORTHOGRAPHIC else "perspective", c.vertical_fov, c.height)


_renderers: dict[str, Handle] = {}
_renderers_lock = threading.Lock()
atexit.register(_renderers.clear)  # while there is still a thread to end


def _renderer(device: str) -> Handle:
    """One for all pictures: kernels are compiled once."""
    number = word("device", device, DEVICES)
    with _renderers_lock:
        if device not in _renderers:
            _renderers[device] = Handle("renderer", "renderer_new", number)
        return _renderers[device]


def painted(surface: Handle, atom_count: int, width: int, height: int, colors: Any, camera: Optional[Camera],
            background: Any, device: str, look: dict[str, Any]) -> Bytes:
    """(height, width, 4) bytes; see Surface.render."""
    picture = default("picture", Picture())
    picture.width, picture.height = width, height
    for name, value in look.items():
        setattr(picture, name, value)
    put_colors(picture, colors, atom_count)
    if background is not None:
        picture.opaque, picture.background = 1, color_of(background, "background")
    seen_by = camera._struct() if camera else None
    if seen_by:
        picture.camera = ctypes.pointer(seen_by)
    if not (0 < width <= 65535 and 0 < height <= 65535):
        raise InputError(f"a picture of {width}x{height} pixels; each side has to be 1 to 65535")
    pixels = np.empty((height, width, 4), dtype=np.uint8)
    call("render", _renderer(device).pointer, surface.pointer, ctypes.byref(picture), pixels.ctypes.data, pixels.nbytes)
    return pixels


def png(pixels: Bytes) -> bytes:
    """The file of (height, width, 4) bytes as Surface.render returns them."""
    height, width, channels = pixels.shape
    if channels != 4 or pixels.dtype != np.uint8:
        raise InputError("a picture is an array (height, width, 4) of bytes")

    def chunk(name: bytes, content: bytes) -> bytes:
        return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))

    rows = np.zeros((height, 1 + 4 * width), dtype=np.uint8)  # each begins with its filter: none
    rows[:, 1:] = pixels.reshape(height, 4 * width)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)) +
            chunk(b"sRGB", b"\0") + chunk(b"IDAT", zlib.compress(rows.tobytes(), 6)) + chunk(b"IEND", b""))
