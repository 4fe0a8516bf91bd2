#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""python_header.py [--check]: writes exporters/bindings/python/meniscus/_header.py, the constants, structs and function signatures
of meniscus.h in terms of ctypes. --check writes nothing and fails if the file is out of date."""
import pathlib
import re
import sys
import textwrap

BINDINGS = pathlib.Path(__file__).resolve().parents[2] / "exporters/bindings"
HEADER = BINDINGS / "c/include/meniscus/meniscus.h"
MODULE = BINDINGS / "python/meniscus/_header.py"
HEAD = '''# SPDX-License-Identifier: BSD-3-Clause
"""The constants, structs and functions of meniscus.h without "meniscus_", written by scripts/check/python_header.py."""
from __future__ import annotations

from ctypes import POINTER, c_char_p, c_double, c_float, c_int32, c_size_t, c_uint8, c_uint32, c_uint64, c_void_p
from typing import Any

from ._arguments import Struct

'''
DECLARATION = re.compile(r"typedef enum (?P<enum>\w+) \{(?P<constants>[^}]*)\} \w+;|"
                         r"typedef struct meniscus_(?P<struct>\w+) \{(?P<fields>[^}]*)\} \w+;|"
                         r"typedef struct (?P<handle>\w+) \w+;|"
                         r"(?P<result>[\w *]+?) ?\bmeniscus_(?P<function>\w+)\((?P<arguments>[^)]*)\);")


def declarations():
    """Yields the matches of DECLARATION in the order of the header; ends the program at text that does not match."""
    text = re.sub(r"/\*.*?\*/", "", HEADER.read_text(encoding="utf-8"), flags=re.S)
    text = re.sub(r"^[ \t]*#(?:.*\\\n)*.*$", "", text, flags=re.M)
    text = " ".join(re.sub(r'\bMENISCUS_(API|WORDS)\b|extern "C" \{', "", text).split()).removesuffix("}")
    rest = DECLARATION.sub("", text).strip()
    if rest:
        sys.exit(f"python_header.py does not understand this text of meniscus.h: {rest[:200]}")
    return list(DECLARATION.finditer(text))


def ctype(declared, classes):
    """Returns the ctypes expression of a C type such as "const double*". Pointers to numbers and to handles are plain addresses."""
    base, stars = re.sub(r"\bconst\b|[* ]", "", declared), declared.count("*")
    if base == "char":
        return ("c_char_p", "POINTER(c_char_p)")[stars - 1]
    if not stars:
        return "None" if base == "void" else classes.get(base, "c_" + re.sub(r"(?<=\d)_t$", "", base))
    return f"POINTER({classes[base]})" if base in classes else "POINTER(c_void_p)" if stars == 2 else "c_void_p"


def listed(before, items, after, indent):
    """Returns a list as lines of at most 120 columns, which are broken between items only."""
    text = before + ", ".join(item.replace(" ", "~") for item in items) + after
    return textwrap.fill(text, 120, subsequent_indent=" " * indent, break_on_hyphens=False).replace("~", " ") + "\n"


def module_text():
    text, functions, classes = HEAD, [], {}  # classes: the Python type of each enumeration and struct
    for found in declarations():
        if found["enum"]:
            classes[found["enum"]] = "c_int32"
            names, values = zip(*re.findall(r"MENISCUS_(\w+) = (\d+)", found["constants"]))
            assert [int(value) for value in values] == list(range(len(values))), found["enum"]
            text += listed("(", names, f") = range({len(names)})", 1)
        elif found["struct"]:
            name = classes["meniscus_" + found["struct"]] = found["struct"].title().replace("_", "")
            fields = [f'("{field}", {ctype(declared, classes)}{f" * {size}" if size else ""})'
                      for declared, names in re.findall(r"((?:const )?\w+(?:\* ?const)?\*?) ([^;]+);", found["fields"])
                      for field, size in re.findall(r"(\w+)(?:\[(\d+)\])?", names)]
            text += f"\nclass {name}(Struct):\n" + listed("    _fields_ = [", fields, "]", 16) + "\n"
        elif found["function"]:
            types = [ctype(re.sub(r"\w+$", "", argument), classes)
                     for argument in found["arguments"].split(",") if argument != "void"]
            functions.append(f'"{found["function"]}": ({ctype(found["result"], classes)}, [{", ".join(types)}])')
    text += "\n\n#: The types of the result and of the arguments of each function.\n"
    text += "FUNCTIONS: dict[str, tuple[Any, list[Any]]] = {\n" + listed("    ", functions, "}", 4)
    return re.sub(r"\n{3,}", "\n\n", text)


if __name__ == "__main__":
    if "--check" not in sys.argv[1:]:
        MODULE.write_text(module_text(), encoding="utf-8")
    elif not MODULE.is_file() or MODULE.read_text(encoding="utf-8") != module_text():
        sys.exit("_header.py is not what meniscus.h says: run scripts/check/python_header.py")
