#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""No text of core names an option of the command line: messages name a property as "@NAME@", and each door spells it.
Every name is an option's of the table of properties."""

import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts/check"))
from list_messages import texts_of_cpp  # noqa: E402

OPTION = re.compile(r"(?:-\w,)?--([a-z][a-z-]*)")
#: An option of another program.
FOREIGN = re.compile(r"pdb2pqr --drop-water")


def texts():
    for path in sorted((ROOT / "core").rglob("*")):
        if path.suffix in (".cpp", ".h", ".hpp"):
            for line, text, before in texts_of_cpp(path.read_text(encoding="utf-8")):
                yield path.relative_to(ROOT).as_posix(), line, text, before


class MuteCore(unittest.TestCase):
    def test_no_text_has_an_option(self):
        literal = [f"{name}:{line}: {text}" for name, line, text, _ in texts()
                   if OPTION.search(FOREIGN.sub("", text))
                   and not (name.startswith("core/properties/") and OPTION.fullmatch(text))]
        self.assertEqual(literal, [])

    def test_names_are_those_of_properties(self):
        known = {OPTION.fullmatch(text).group(1) for name, _, text, _ in texts()
                 if name.startswith("core/properties/") and OPTION.fullmatch(text)}
        named = [(f"{name}:{line}", found) for name, line, text, before in texts()
                 for found in re.findall(r"@([a-z][a-z-]*)(?: [^@]*)?@", text)
                 + ([text] if before.endswith("option_name (") else [])]
        self.assertGreater(len(named), 150)
        self.assertEqual([place for place in named if place[1] not in known], [])


if __name__ == "__main__":
    unittest.main()
