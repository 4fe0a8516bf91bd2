#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""scene_values.py [--check]: writes the types of a scene's values for Python, exporters/bindings/python/meniscus/
_scene_values.py, from the table of properties of the library that MENISCUS_LIBRARY names. --check: writes nothing, and
fails where the file is not what it would write."""
import pathlib
import sys
import textwrap

PACKAGE = pathlib.Path(__file__).resolve().parents[1] / "exporters/bindings/python"
sys.path.insert(0, str(PACKAGE))

import meniscus
from meniscus import _library as lib

HEAD = '''# SPDX-License-Identifier: BSD-3-Clause
"""The types of a scene's values, written by scripts/scene_values.py from the table of properties."""
from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Literal, TypedDict, Union

Path = Union[str, "os.PathLike[str]"]
Text = Union[str, float]
'''
TYPES = {lib.VALUE_FLAG: "bool", lib.VALUE_NUMBER: "float", lib.VALUE_COUNT: "int", lib.VALUE_TEXT: "Text",
         lib.VALUE_FILE: "Path", lib.VALUE_NEW_FILE: "Path", lib.VALUE_CAMERA: "Path"}


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
    path = PACKAGE / "meniscus/_scene_values.py"
    if "--check" not in sys.argv[1:]:
        path.write_text(file_text())
    elif not path.is_file() or path.read_text() != file_text():
        sys.exit(f"{path.name} is not what the table of properties says: run scripts/scene_values.py")
