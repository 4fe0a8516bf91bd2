# SPDX-License-Identifier: GPL-3.0-or-later
"""Rewrites messages of the program and of libmeniscus in the terms of the panel, which has fields instead of
options."""

import re

from . import preparation

#: Options of the program -> labels of fields of the panel, or of values of fields.
FIELDS = {
    "--select": "Selection",
    "--color": "Colour",
    "--surface": "Surface",
    "--probe": "Probe",
    "--tolerance": "Tolerance",
    "--density": "Density",
    "--trajectory": "Trajectory",
    "--trajectory-atoms": "Trajectory's atoms",
    "--frames": "Frames",
    "--cavities": "Cavities",
    "--color-by-file": "Numbers",
    **{preparation.option_of(row): preparation.label_of(row) for row in preparation.ROWS},
}
#: Options in the spelling of libmeniscus.
OF_LIBRARY = re.compile(r"\A(?:select|%s)(?=: )|\b(?:keep_water|keep_ions|unknown_element)\b|(?<=another )color\b" %
                        "|".join(map(preparation.name_of, preparation.OF_MOLECULE)))
OPTION = re.compile(r"(?<![\w/-])--([a-z][a-z0-9]*(?:-[a-z0-9]+)*)")


def for_panel(text):
    """Returns a message with labels of fields in place of options. Options without a field are quoted without dashes,
    and the message explains them."""
    lacking = []

    def field(found):
        name = FIELDS.get(found.group(0))
        if name is None and found.group(1) not in lacking:
            lacking.append(found.group(1))
        return name or f"\"{found.group(1)}\""

    text = OF_LIBRARY.sub(lambda found: "--" + found.group(0).replace("_", "-"), text)
    worded = OPTION.sub(field, text)
    if not lacking:
        return worded
    return (f"{worded} ({', '.join(lacking)}: {'an option' if len(lacking) == 1 else 'options'} "
            "of the program meniscus that this panel does not have)")
