#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""scene_values.py [--check]: writes two files from the properties of the library at MENISCUS_LIBRARY: the types of the values of
scenes in Python, exporters/bindings/python/meniscus/_scene_values.py, and the fields and colour schemes of the panel in Blender,
exporters/blender/addon/meniscus_import/computing/preparation_table.py. --check writes nothing and fails if a file is out of date."""
import pathlib
import re
import sys
import tempfile
import textwrap

EXPORTERS = pathlib.Path(__file__).resolve().parents[2] / "exporters"
PACKAGE = EXPORTERS / "bindings/python"
sys.path.insert(0, str(PACKAGE))

import meniscus
from meniscus import _header as header

HEAD = '''# SPDX-License-Identifier: BSD-3-Clause
"""The types of the values of scenes (see meniscus.properties()), written by scripts/check/scene_values.py."""
from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Literal, Optional, TypedDict, Union

Path = Union[str, "os.PathLike[str]"]
Text = Union[str, float]
Paths = Union[Path, Sequence[Path]]
Texts = Union[Text, Sequence[Text]]
#: A text, or its numbers: the width and the height of a picture, or a direction.
Numbers = Union[Text, Sequence[float]]
'''
TYPES = {header.VALUE_FLAG: "bool", header.VALUE_NUMBER: "float", header.VALUE_COUNT: "int", header.VALUE_TEXT: "Text",
         header.VALUE_FILE: "Path", header.VALUE_NEW_FILE: "Path", header.VALUE_CAMERA: "Path"}


#: The keys of the properties in the panel, in its order.
PANEL = ("molecule.model", "molecule.altloc", "molecule.assembly", "molecule.hydrogens", "molecule.radii", "molecule.keep_water",
         "molecule.keep_ions", "frames.superpose", "frames.whole", "frames.smooth")
PANEL_HEAD = '''# SPDX-License-Identifier: GPL-3.0-or-later
"""The fields of the panel about molecules and runs. scripts/check/scene_values.py writes this file from Meniscus' table of
properties."""

import collections

#: A field. key: key in scene files. type: flag, count, word or text. words: all values of a word, or some usual values of
#: a text. initial: the default. lowest, highest: range of a count.
Row = collections.namedtuple("Row", "key type words initial lowest highest help")

ROWS = (
'''
PANEL_TYPES = {header.VALUE_FLAG: "flag", header.VALUE_COUNT: "count", header.VALUE_WORD: "word", header.VALUE_TEXT: "text"}


def refusal(atoms, scheme):
    """Returns the message of the library about a colour scheme that it does not compute, else an empty text."""
    try:
        atoms.colors(scheme)
    except meniscus.Error as error:
        return str(error)
    return ""


def schemes():
    """Returns pairs of the word of a colour scheme, and whether it needs more than the atoms of a file."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "atom.xyz"
        path.write_text("1\n\nC 0 0 0\n")
        atom = meniscus.read(path)
    words = re.search(r" is not one of (.*), a name such as red", refusal(atom, "?")).group(1).split(", ")
    return [(word, "needs more than the atoms" in refusal(atom, word)) for word in words]


def panel_text():
    """Returns the text of preparation_table.py."""
    known = {p.key: p for p in meniscus.properties()}
    rows = [known[key] for key in PANEL]
    return PANEL_HEAD + "".join(
        f"    Row({p.key!r}, {PANEL_TYPES[p.type]!r}, {tuple(p.words)!r}, {p.initial!r}, {p.lowest:g}, {p.highest:g},\n        {p.help!r}),\n"
        for p in rows) + ")\n\n#: Colour schemes, and True for those that need more than the atoms of a file.\nSCHEMES = (\n" + textwrap.fill(
            ", ".join(map(repr, schemes())), 140, initial_indent="    ", subsequent_indent="    ") + ")\n"


def type_of(known):
    """Returns the Python type of the values of a property."""
    if known.type == header.VALUE_WORD:
        one = "Literal[" + ", ".join(f'"{word}"' for word in known.words) + "]"
    else:
        one = "Numbers" if known.value in ("X,Y,Z", "WxH") else TYPES[known.type]
    return one + "s" * known.repeatable


def file_text():
    """Returns the text of _scene_values.py."""
    known = meniscus.properties()
    text = HEAD
    for head, form, chosen in (
            ('SurfaceValues(TypedDict, total=False):\n    """The properties of a picture of a surface: its look and its size."""', "{}", [p for p in known if p.of_surface]),
            ('SceneValues(SurfaceValues, total=False):\n    """The properties of a scene."""', "{}", [p for p in known if not p.of_surface]),
            ('SceneAttributes:\n    """The attributes of a Scene; None for the default."""', "Optional[{}]", [p for p in known if p.name not in vars(meniscus.Scene)])):
        fields = "; ".join(f"{p.name}: {form.format(type_of(p))}".replace(" ", "~") for p in chosen)
        lines = textwrap.wrap(fields, 120, initial_indent="    ", subsequent_indent="    ", break_long_words=False)
        text += f"\n\nclass {head}\n" + "\n".join(line.rstrip(";") for line in lines).replace("~", " ") + "\n"
    return text


if __name__ == "__main__":
    for path, text in ((PACKAGE / "meniscus/_scene_values.py", file_text()),
                       (EXPORTERS / "blender/addon/meniscus_import/computing/preparation_table.py", panel_text())):
        if "--check" not in sys.argv[1:]:
            path.write_text(text)
        elif not path.is_file() or path.read_text() != text:
            sys.exit(f"{path.name} is not what the table of properties says: run scripts/check/scene_values.py")
