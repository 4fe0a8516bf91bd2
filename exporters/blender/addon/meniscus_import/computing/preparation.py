# SPDX-License-Identifier: GPL-3.0-or-later
"""How a molecule and its run are prepared: the rows of preparation_table.py as fields of the panel, options of the program and
arguments of the library. What is not changed is not passed on."""

from .preparation_table import ROWS


def name_of(row):
    """Of the field, and of the library's argument."""
    return row.key.split(".")[1]


def label_of(row):
    return name_of(row).replace("_", " ").capitalize()


def option_of(row):
    return "--" + name_of(row).replace("_", "-")


def help_of(row):
    return f"{row.help} [{row.initial}]" if row.initial else row.help


def default_of(row):
    """The value of a field that asks for nothing."""
    if row.type == "count":
        return int(row.initial)
    return {"flag": False, "word": row.initial, "text": ""}[row.type]


#: Of the molecule; of its frames, which only the program prepares.
OF_MOLECULE = tuple(row for row in ROWS if row.key.startswith("molecule."))
OF_RUN = tuple(row for row in ROWS if row.key.startswith("frames."))
_RUN_NAMES = frozenset(map(name_of, OF_RUN))


def asked(rows, value):
    """Pairs of name and value. value: of a name, gives what the field has."""
    pairs = ((row, value(name_of(row))) for row in rows)
    return tuple((name_of(row), found) for row, found in pairs if found != default_of(row))


def run_names(pairs):
    """Of those that prepare frames."""
    return [name for name, _ in pairs if name in _RUN_NAMES]


def program_words(pairs, of_run):
    """Options of the program, of a run or of a molecule."""
    rows = {name_of(row): row for row in (OF_RUN if of_run else OF_MOLECULE)}
    return [option_of(rows[name]) + ("" if value is True else f"={value}") for name, value in pairs if name in rows]


def library_arguments(pairs):
    """Arguments of meniscus.read()."""
    found = {name: value for name, value in pairs if name not in _RUN_NAMES}
    if str(found.get("model", "")).isdecimal():
        found["model"] = int(found["model"])
    return found
