# SPDX-License-Identifier: BSD-3-Clause
"""Scenes: all settings of a picture, by the names of the program's properties."""
from __future__ import annotations

import ctypes
import os
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple, Optional, Union

import numpy as np

from . import _header as header
from . import _library as lib
from ._arguments import plain
from ._errors import InputError, UsageError
from ._page import Page, made
from ._picture import Picture, blank, renderer
from ._types import Device, Path

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._scene_values import SceneValues

Value = Union[bool, int, float, str]


class Property(NamedTuple):
    """A property of scenes.

    name: such as "depth_cue". key: the key in scene files, such as "look.depth_cue". value: the placeholder for the
    value in the help, such as "WIDTH". help: the sentence of the help. words: all values of a property that is a word,
    or usual values. initial: the default in the help. lowest, highest: the range of numbers and of lengths in pixels;
    equal for any number. type: a meniscus_value_type of meniscus.h. repeatable: whether the property has a list of
    values. of_surface: whether Surface.render() has the property, too.

    >>> known = {p.name: p for p in meniscus.properties()}
    >>> known["depth_cue"].key, known["depth_cue"].highest
    ('look.depth_cue', 1.0)"""
    name: str
    key: str
    value: str
    help: str
    words: list[str]
    initial: str
    lowest: float
    highest: float
    type: int
    repeatable: bool
    of_surface: bool


def properties() -> list[Property]:
    """Returns all properties of scenes, in the order of the program's help.

    >>> [p.name for p in meniscus.properties() if p.of_surface][:3]
    ['color', 'preset', 'light']"""
    array = header.Array()
    lib.call("scene_properties", ctypes.byref(array))

    def property_of(row: header.Property) -> Property:
        texts = [getattr(row, field).decode() for field in ("name", "key", "value", "help", "words", "initial")]
        words = [word for word in texts.pop(4).split("|") if word]
        name, key, value, help_text, initial = texts
        return Property(name, key, value, help_text, words, initial, row.lowest, row.highest, row.type,
                        bool(row.repeatable), bool(row.of_surface))

    return [property_of(header.Property.from_address(array.data + n * array.stride)) for n in range(array.count)]


def _text_of(name: str, value: Any) -> bytes:
    """Returns a value of a property as the text that the program takes. Raises InputError for other types, for a value
    with a unit, and for a text with a zero byte."""
    if isinstance(value, (bool, np.bool_)):
        return b"true" if value else b"false"
    if isinstance(value, (str, bytes, os.PathLike)):
        text = os.fsencode(value)
        if b"\0" in text:
            raise InputError(f"{name} is {value!r}, which has a zero in it")
        return text
    number = plain(value, name, None)
    if isinstance(number, (int, np.integer)):
        return str(int(number)).encode()
    if not isinstance(number, (float, np.floating)):
        raise InputError(f"{name} is {value!r}, neither a text nor a number")
    return repr(float(number)).encode()


#: The size in bytes of the largest page that a notebook shows for a scene; for larger ones it shows a picture.
_LARGEST_SHOWN = 15_000_000


class Scene:
    """All settings of a picture, with the defaults of the program: Scene("1ubq.cif", color="chain", legend=True).

    Properties are read and set as attributes, scene.depth_cue, or by their names or keys, scene["look.depth_cue"]. None
    means the default. A repeatable property has a list of values. An unknown name or an invalid value raises
    UsageError, whose text begins with the name.

    >>> scene = meniscus.Scene("helix.pdb", color="chain", size="80x60")
    >>> scene["look.depth_cue"] = 0.5
    >>> scene.depth_cue, scene.color, scene.samples
    (0.5, ['chain'], None)"""

    _handle: lib.Handle

    def __init__(self, molecule: Optional[Path] = None, /, **values: Unpack[SceneValues]) -> None:
        object.__setattr__(self, "_handle", lib.Handle("scene", "scene_new"))
        if molecule is not None:
            self["file"] = molecule
        self.set(**values)

    @classmethod
    def read(cls, path: Path) -> Scene:
        """Reads a scene file of the program. Paths in the file must not lead out of its folder, because a scene may
        come from anyone. Raises InputError for an invalid file, with the line or the key.

        >>> _ = open("scene.json", "w").write(scene.json())
        >>> meniscus.Scene.read("scene.json").color
        ['chain']"""
        return cls._of(lib.Handle("scene", "scene_read", _text_of("path", path)))

    @classmethod
    def parse(cls, json: str) -> Scene:
        """Reads the text of a scene file. Paths are relative to the working directory. Raises InputError for an invalid
        text, with the line or the key.

        >>> meniscus.Scene.parse(scene.json()).size
        '80x60'"""
        return cls._of(lib.Handle("scene", "scene_parse", _text_of("json", json)))

    @classmethod
    def _of(cls, handle: lib.Handle) -> Scene:
        scene = cls.__new__(cls)
        object.__setattr__(scene, "_handle", handle)
        return scene

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickles and copies have the text of the scene file, with paths relative to the working directory."""
        return Scene.parse, (self.json(),)

    def set(self, **values: Unpack[SceneValues]) -> Scene:
        """Sets several properties, and returns this scene. Raises UsageError for an unknown name or an invalid value.

        >>> scene.set(preset="flat", samples=4).samples
        4"""
        for name, value in values.items():
            self[name] = value
        return self

    def __setitem__(self, name: str, value: Any) -> None:
        encoded = _text_of("name", name)
        texts = [_text_of(name, one) for one in (value if isinstance(value, (list, tuple)) else [value]) if one is not None]
        lib.call("scene_set", self._handle.pointer, encoded, None)
        for text in texts:
            lib.call("scene_set", self._handle.pointer, encoded, text)

    def __getitem__(self, name: str) -> Any:
        texts = list(self._texts(name))
        if not texts:
            return None
        known = next(p for p in properties() if name in (p.name, p.key))
        if known.repeatable:
            return texts
        if known.type == header.VALUE_FLAG:
            return texts[0] == "true"
        if known.type == header.VALUE_COUNT:
            return int(texts[0])
        return float(texts[0]) if known.type == header.VALUE_NUMBER else texts[0]

    def _texts(self, name: str) -> Iterator[str]:
        """Yields the values of a property as texts."""
        text = ctypes.c_char_p()
        n = 0
        while True:
            lib.call("scene_get", self._handle.pointer, _text_of("name", name), n, ctypes.byref(text))
            if text.value is None:
                return
            yield os.fsdecode(text.value)
            n += 1

    def __setattr__(self, name: str, value: Any) -> None:
        self[name] = value

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):  # such as __deepcopy__
            raise AttributeError(name)
        try:
            return self[name]
        except UsageError as error:
            raise AttributeError(str(error)) from None

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(known.name for known in properties())]

    def json(self, folder: Optional[Path] = None) -> str:
        """Returns the text of a scene file, without the properties that have their defaults. folder: paths in the text
        are relative to this folder; None: to the working directory.

        >>> "depth_cue" in scene.json()
        True"""
        text = ctypes.c_char_p()
        lib.call("scene_json", self._handle.pointer, None if folder is None else _text_of("folder", folder),
                 ctypes.byref(text))
        return (text.value or b"").decode("utf-8", "replace")

    def render(self, device: Device = "auto") -> Picture:
        """Returns the picture that `meniscus render` draws of the scene, byte for byte.

        device: "cpu", "gpu", "software" (GL on the CPU), or "auto", a hardware GPU if one works, else the CPU. Raises
        UsageError if the scene has no molecule or values that contradict each other, InputError if a file cannot be
        read, and GpuError if the device needs GL and there is none.

        >>> scene.render(device="cpu")
        <meniscus.Picture: 80x60>"""
        picture = blank(self._handle)
        lib.call("render_scene", renderer(device).pointer, self._handle.pointer, picture.pixels.ctypes.data,
                 picture.pixels.nbytes)
        return picture

    def show(self, *, frame_height: int = 480) -> Page:
        """Returns the page that `meniscus export page` makes of the scene. A notebook shows it.

        frame_height: the height of the page in a notebook, in CSS pixels. Raises UsageError for properties that pages
        do not show, and the errors of render().

        >>> scene.show().save("turns.html", replace=True)"""
        return made("scene_page", self._handle.pointer, height=frame_height)

    def _repr_html_(self) -> Optional[str]:
        if self["file"] is None:
            return None
        try:
            page = self.show()
        except UsageError:
            return None  # a notebook shows _repr_png_() then
        return page._repr_html_() if len(page.html) <= _LARGEST_SHOWN else None

    def _repr_png_(self) -> Optional[bytes]:
        return None if self["file"] is None else self.render().png()

    def __repr__(self) -> str:
        return f"<meniscus.Scene of {self['file'] or 'no molecule yet'}>"
