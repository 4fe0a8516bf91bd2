#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""list_messages.py [FOLDER...]: prints every message that the program and its add-ons can show, grouped by folder.

A message is a text in the sources that is thrown, returned as a reason, or given as a warning or a note; {} stands for
a value. Without folders those of core, app and exporters are listed. Read the whole list after you change messages.
"""

import ast
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("core", "app", "exporters")

TOKEN = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(\w*)\((.*?)\)\1"|\'(?:\\.|[^\'\\\n])\'|"((?:\\.|[^"\\\n])*)"|#include[^\n]*|[A-Za-z_]\w*'
    r'|\d[\w\'.]*|\s+|.', re.S)
#: Words in the statement around a text that mean that it is shown to people.
SAYS = re.compile(r"throw|return|fail|fault|refuse|warn|note|say|log_line|complain|trouble|error|why|reason|notes|hints|advice"
                  r"|Error|emplace_back|push_back|missing|advice", re.I)
#: Beginnings of the texts of generated files and of tables of help.
GENERATED = re.compile(r"\s*(<|#|//|\$|\{|ply\\n|[a-z]+ \\\"|%)")


def texts_of_cpp(source):
    """Yields (line, text, identifiers before it in the statement) for each text; adjacent texts are joined."""
    line, before, joined = 1, [], None
    for match in TOKEN.finditer(source):
        token = match.group(0)
        text = match.group(3) if match.group(3) is not None else match.group(2)
        if text is not None:
            joined = (joined[0], joined[1] + text, joined[2]) if joined else (line, text, " ".join(before))
        elif not token.isspace() and not token.startswith(("//", "/*")):
            if joined:
                yield joined
                joined = None
            if token in ";{}" and (token != "{" or not before or before[-1] in (")", "else", "do", "try")):
                before = []
            else:
                before.append(token)
        line += token.count("\n")
    if joined:
        yield joined


def is_sentence(text):
    return bool(re.search(r"[a-z]{2,} +[a-z({'\"-]", text)) and not GENERATED.match(text)


def messages_of_cpp(source):
    for line, text, before in texts_of_cpp(source):
        if is_sentence(text) and SAYS.search(before) and "Property" not in before:
            yield line, text.replace("\\\"", "\"").replace("\\n", " ").strip()


def as_text(node):
    """Returns the text of a string, an f-string with {} for its values, or a sum of them; None for anything else."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    if isinstance(node, ast.JoinedStr):
        return "".join(part.value if isinstance(part, ast.Constant) else "{}" for part in node.values)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        left, right = as_text(node.left), as_text(node.right)
        return None if left is None and right is None else (left or "{}") + (right or "{}")
    return None


def messages_of_python(source):
    for node in ast.walk(ast.parse(source)):
        said = []
        if isinstance(node, ast.Raise) and isinstance(node.exc, ast.Call):
            said = node.exc.args
        elif isinstance(node, ast.Call):
            name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
            said = node.args if name in ("error", "report", "warn", "warning", "fail", "refuse") else []
        for text in map(as_text, said):
            if text and " " in text.strip():
                yield node.lineno, text.replace("\n", " ")


def messages(folders=FOLDERS):
    """Yields (path from the root, line, text) for each message, in the order of paths and lines."""
    for folder in folders:
        for path in sorted((ROOT / folder).rglob("*")):
            name = path.relative_to(ROOT).as_posix()
            if path.suffix in (".cpp", ".h", ".hpp"):
                found = messages_of_cpp(path.read_text(encoding="utf-8"))
            elif path.suffix == ".py" and path.name != "_scene_values.py":
                found = messages_of_python(path.read_text(encoding="utf-8"))
            else:
                continue
            for line, text in sorted(set(found)):
                yield name, line, text


def main():
    folder = None
    count = 0
    for name, line, text in messages(sys.argv[1:] or FOLDERS):
        if pathlib.PurePosixPath(name).parent != folder:
            folder = pathlib.PurePosixPath(name).parent
            print(f"\n{folder}")
        print(f"  {pathlib.PurePosixPath(name).name}:{line}: {text}")
        count += 1
    print(f"\nmessages {count}")


if __name__ == "__main__":
    main()
