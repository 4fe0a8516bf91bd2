#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""scene_values.py [--check]: writes two files from the table of properties of the library that MENISCUS_LIBRARY names: the
types of a scene's values for Python, exporters/bindings/python/meniscus/_scene_values.py, and of the panel in Blender the fields
about molecules and runs and the colour schemes, exporters/blender/addon/meniscus_import/computing/preparation_table.py. --check:
writes nothing, and fails where a file is not what it would write."""
import pathlib
import re
import sys
import tempfile
import textwrap

EXPORTERS = pathlib.Path(__file__).resolve().parents[2] / "exporters"
PACKAGE = EXPORTERS / "bindings/python"
sys.path.insert(0, str(PACKAGE))

import meniscus
from meniscus import _library as lib

HEAD = '''# SPDX-License-Identifier: BSD-3-Clause
"""The types of a scene's values, written by scripts/check/scene_values.py from the table of properties."""
from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Literal, TypedDict, Union

Path = Union[str, "os.PathLike[str]"]
Text = Union[str, float]
'''
TYPES = {lib.VALUE_FLAG: "bool", lib.VALUE_NUMBER: "float", lib.VALUE_COUNT: "int", lib.VALUE_TEXT: "Text",
         lib.VALUE_FILE: "Path", lib.VALUE_NEW_FILE: "Path", lib.VALUE_CAMERA: "Path"}


#: What the panel has, in its order.
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
PANEL_TYPES = {lib.VALUE_FLAG: "flag", lib.VALUE_COUNT: "count", lib.VALUE_WORD: "word", lib.VALUE_TEXT: "text"}


def refusal(atoms, scheme):
    """Returns the message of the library about a colour scheme that it does not compute, else an empty text."""
    try:
        atoms.colors(scheme)
    except meniscus.Error as error:
        return str(error)
    return ""


def schemes():
    """Pairs of a colour scheme's word and whether it needs more than the atoms of a file."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "atom.xyz"
        path.write_text("1\n\nC 0 0 0\n")
        atom = meniscus.read(path)
    words = re.search(r" is not one of (.*), a name such as red", refusal(atom, "?")).group(1).split(", ")
    return [(word, "needs more than the atoms" in refusal(atom, word)) for word in words]


def panel_text():
    known = {p.key: p for p in meniscus.properties()}
    rows = [known[key] for key in PANEL]
    return PANEL_HEAD + "".join(
        f"    Row({p.key!r}, {PANEL_TYPES[p.type]!r}, {tuple(p.words)!r}, {p.initial!r}, {p.lowest:g}, {p.highest:g},\n        {p.help!r}),\n"
        for p in rows) + ")\n\n#: Colour schemes, and True for those that need more than the atoms of a file.\nSCHEMES = (\n" + textwrap.fill(
            ", ".join(map(repr, schemes())), 140, initial_indent="    ", subsequent_indent="    ") + ")\n"


def type_of(known):
    if known.type == lib.VALUE_WORD:
        one = "Literal[" + ", ".join(f'"{word}"' for word in known.words) + "]"
    else:
        one = TYPES[known.type]
    return f"Union[{one}, Sequence[{one}]]" if known.repeatable else one


def lines_of(known):
    default = f" [{known.initial}]" if known.initial else ""
    value = f"{known.value}: " if known.value else ""
    help_lines = textwrap.wrap(f"{value}{known.help}{default}", 112, initial_indent="    #: ", subsequent_indent="    #: ")
    return [*help_lines, *textwrap.wrap(f"{known.name}: {type_of(known)}", 112, initial_indent="    ",
                                        subsequent_indent="        ", break_long_words=False)]


def file_text():
    known = meniscus.properties()
    text = HEAD
    for name, base, said, chosen in (
            ("SurfaceValues", "TypedDict", "Of the picture of a surface: look and size.", [p for p in known if p.of_surface]),
            ("SceneValues", "SurfaceValues", "Of a scene.", [p for p in known if not p.of_surface])):
        text += f'\n\nclass {name}({base}, total=False):\n    """{said}"""\n'
        text += "\n".join(line for p in chosen for line in lines_of(p)) + "\n"
    return text


if __name__ == "__main__":
    for path, text in ((PACKAGE / "meniscus/_scene_values.py", file_text()),
                       (EXPORTERS / "blender/addon/meniscus_import/computing/preparation_table.py", panel_text())):
        if "--check" not in sys.argv[1:]:
            path.write_text(text)
        elif not path.is_file() or path.read_text() != text:
            sys.exit(f"{path.name} is not what the table of properties says: run scripts/check/scene_values.py")
