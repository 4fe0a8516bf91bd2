# SPDX-License-Identifier: GPL-3.0-or-later
"""The preparation of a molecule and its run. The rows of preparation_table.py become fields of the panel, options of
the program, and arguments of the library. Fields with their default values are not passed on."""

from .preparation_table import ROWS


def name_of(row):
    """Returns the name of a row's field, which is also the name of the library's argument."""
    return row.key.split(".")[1]


def label_of(row):
    return name_of(row).replace("_", " ").capitalize()


def option_of(row):
    return "--" + name_of(row).replace("_", "-")


def help_of(row):
    return f"{row.help} [{row.initial}]" if row.initial else row.help


def default_of(row):
    """Returns the default value of a field."""
    if row.type == "count":
        return int(row.initial)
    return {"flag": False, "word": row.initial, "text": ""}[row.type]


#: The rows of the molecule, and the rows of its frames, which only the program prepares.
OF_MOLECULE = tuple(row for row in ROWS if row.key.startswith("molecule."))
OF_RUN = tuple(row for row in ROWS if row.key.startswith("frames."))
_RUN_NAMES = frozenset(map(name_of, OF_RUN))


def changed_fields(rows, value):
    """Returns pairs of name and value for all fields that do not have their default values. value(name): returns the
    value of a field."""
    pairs = ((row, value(name_of(row))) for row in rows)
    return tuple((name_of(row), found) for row, found in pairs if found != default_of(row))


def run_names(pairs):
    """Returns the names of the pairs that prepare frames."""
    return [name for name, _ in pairs if name in _RUN_NAMES]


def program_words(pairs, of_run):
    """Returns options of the program. of_run: True for those of a run, False for those of a molecule."""
    rows = {name_of(row): row for row in (OF_RUN if of_run else OF_MOLECULE)}
    return [option_of(rows[name]) + ("" if value is True else f"={value}") for name, value in pairs if name in rows]


def library_arguments(pairs):
    """Returns the arguments of meniscus.read()."""
    found = {name: value for name, value in pairs if name not in _RUN_NAMES}
    if str(found.get("model", "")).isdecimal():
        found["model"] = int(found["model"])
    return found
