# SPDX-License-Identifier: BSD-3-Clause
"""Scenes: all settings of a picture, by the names of the program's properties."""
from __future__ import annotations

import ctypes
import functools
import os
import re
import shutil
import tempfile
import weakref
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple, Optional, Union

import numpy as np

from . import _header as header
from . import _library as lib
from ._arguments import Device, Path, plain
from ._arrays import WHOLE, column_of
from ._errors import InputError, UsageError, wrong_type
from ._page import Page, made
from ._picture import Picture, blank, renderer
from ._scene_values import SceneAttributes
from ._read import structure_of
from ._sources import is_molecule
from ._structure import Structure

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
    with a unit, and for a text with a zero byte. Several numbers become "1,2,3", and those of a size "1x2"."""
    if isinstance(value, (tuple, list, np.ndarray)):
        return (b"x" if name in ("size", "image.size") else b",").join(_text_of(name, one) for one in value)
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
        raise wrong_type(f"{name} is {value!r:.60}, neither a text nor a number")
    return repr(float(number)).encode()


@functools.lru_cache(maxsize=None)
def _known() -> dict[str, Property]:
    """Returns the properties by their names and by their keys."""
    return {name: known for known in properties() for name in (known.key, known.name)}


#: The size in bytes of the largest page that a notebook shows for a scene; for larger ones it shows a picture.
_LARGEST_SHOWN = 15_000_000


def _radii_of(structure: Structure) -> list[str]:
    """Returns the overrides that give atoms the radii which the library would not give them."""
    own, usual = np.asarray(structure.radii), np.asarray(column_of(structure._library_object(), header.STRUCTURE_RADII))
    return [f"index {' '.join(map(str, np.flatnonzero((own == radius) & (own != usual))))}={radius!r}"
            for radius in np.unique(own[own != usual]).tolist()]


def _values_of(structure: Structure, folder: str) -> dict[str, Any]:
    """Writes a molecule to a folder, and returns the values of a scene that use all of its atoms with their radii."""
    stem = re.sub(r"[^\w.-]", "_", os.path.basename(structure.file).split(".")[0]) or "molecule"
    path = os.path.join(folder, stem + ".cif")
    overrides = _radii_of(structure)
    structure.write(path, replace=True)
    values = {"file": path, **WHOLE, "model": "all" if len(np.unique(structure.models)) > 1 else None,
              "altloc": "all" if (structure.altlocs != "").any() else None, "radius": overrides or None}
    return {name: value for name, value in values.items() if value is not None}


class Scene(SceneAttributes, Mapping[str, Any]):
    """All settings of a picture, with the defaults of the program: Scene("1ubq.cif", color="chain", legend=True).

    molecule: the path of a file; or a Structure or a molecule of another package, all of whose atoms are drawn, from a
    temporary file that exists as long as the scene. Properties are read and set as attributes, scene.depth_cue, or by
    their names or keys, scene["look.depth_cue"]. None means the default. A repeatable property has a list of values. An
    unknown name or an invalid value raises UsageError, whose text begins with the name; an unknown name is also a
    KeyError and an AttributeError. A scene is a mapping of the properties that are set: "color" in scene, dict(scene).

    >>> scene = meniscus.Scene("helix.pdb", color="chain", size="80x60")
    >>> scene["look.depth_cue"] = 0.5
    >>> scene.depth_cue, scene.color, scene.samples
    (0.5, ['chain'], None)
    >>> "depth_cue" in scene, list(scene)
    (True, ['file', 'color', 'depth_cue', 'size'])
    >>> meniscus.Scene(meniscus.read("helix.pdb").select("chain A"), size=(80, 60)).size
    '80x60'"""

    _handle: lib.Handle
    _molecule: Optional[Structure]  # the molecule in the temporary file

    def __init__(self, molecule: Any = None, /, **values: Unpack[SceneValues]) -> None:
        self._hold(lib.Handle("scene", "scene_new"), None)
        if molecule is None or isinstance(molecule, (str, bytes, os.PathLike)):
            self["file"] = molecule
        elif isinstance(molecule, Structure) or is_molecule(molecule):
            self._draw(molecule if isinstance(molecule, Structure) else structure_of(molecule, None))
        else:
            raise wrong_type(f"molecule is of the type {type(molecule).__name__}, neither a path nor a molecule")
        self.set(**values)

    def _hold(self, handle: lib.Handle, molecule: Optional[Structure]) -> None:
        object.__setattr__(self, "_handle", handle)
        object.__setattr__(self, "_molecule", molecule)

    def _draw(self, molecule: Structure) -> None:
        """Writes a molecule to a temporary file, and sets the values that draw it."""
        folder = tempfile.mkdtemp(prefix="meniscus-")
        weakref.finalize(self, shutil.rmtree, folder, ignore_errors=True)
        for name, value in _values_of(molecule, folder).items():
            self[name] = value
        object.__setattr__(self, "_molecule", molecule)

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
        scene._hold(handle, None)
        return scene

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickles and copies have the text of the scene file, with paths relative to the working directory, and the
        molecule of a temporary file."""
        return _again, (self.json(), self._molecule)

    def set(self, **values: Unpack[SceneValues]) -> Scene:
        """Sets several properties, and returns this scene. Raises UsageError for an unknown name or an invalid value.

        >>> scene.set(preset="flat", samples=4).samples
        4"""
        for name, value in values.items():
            self[name] = value
        return self

    def __setitem__(self, name: str, value: Any) -> None:
        encoded = _text_of("name", name)
        several = isinstance(value, (list, tuple)) and self._is_repeatable(name)
        texts = [_text_of(name, one) for one in (value if several else [value]) if one is not None]
        lib.call("scene_set", self._handle.pointer, encoded, None)
        for text in texts:
            lib.call("scene_set", self._handle.pointer, encoded, text)

    def __getitem__(self, name: str) -> Any:
        texts = list(self._texts(name))
        if not texts:
            return None
        known = _known()[name]
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

    @staticmethod
    def _is_repeatable(name: str) -> bool:
        return name in _known() and _known()[name].repeatable

    if not TYPE_CHECKING:  # type checkers know the attributes of SceneAttributes
        def __setattr__(self, name: str, value: Any) -> None:
            self[name] = value

        def __getattr__(self, name: str) -> Any:
            if name.startswith("_"):  # such as __deepcopy__
                raise AttributeError(name)
            return self[name]

    # ---- a mapping of the properties that are set

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and name in _known() and self[name] is not None

    def __iter__(self) -> Iterator[str]:
        return (known.name for known in properties() if self[known.name] is not None)

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def __bool__(self) -> bool:
        return True

    def __delitem__(self, name: str) -> None:
        self[name] = None

    def __eq__(self, other: object) -> bool:  # replaces that of mappings, because scenes change
        return self is other

    def __hash__(self) -> int:
        return id(self)

    def get(self, name: str, default: Any = None) -> Any:
        """Returns the value of a property, or `default` if it is not set.

        >>> scene.get("samples", 16)
        16"""
        return self[name] if name in self else default

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
        file = os.path.basename(self["file"]) if self._molecule else self["file"]
        return f"<meniscus.Scene of {file or 'no molecule yet'}>"


def _again(json: str, molecule: Optional[Structure]) -> Scene:
    """Returns the scene of a pickle or a copy."""
    scene = Scene.parse(json)
    if molecule is not None:
        radii = scene["radius"]
        scene._draw(molecule)
        scene["radius"] = radii
    return scene
