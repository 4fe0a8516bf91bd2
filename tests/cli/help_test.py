# SPDX-License-Identifier: BSD-3-Clause
"""The help of every command has short headings, sentences with a capital letter, and units outside of brackets."""

import re
import subprocess
import sys
import unittest

PROGRAM = sys.argv.pop(1)
LONGEST_SECTION = 15  # options under one heading that a reader can take in at once


def help_of(*command):
    return subprocess.run([PROGRAM, *command, "--help-all"], capture_output=True, text=True, check=True).stdout


def commands():
    """Returns all commands as lists of words, including those below export and farm."""
    def below(*command):
        lists = re.split(r"\n(?:Commands|Formats):\n", help_of(*command))[1:]
        return [name for text in lists for name in re.findall(r"^  ([a-z]+) ", text, re.M)]
    found = []
    for name in below():
        inner = below(name)
        found += [[name, word] for word in inner] or [[name]]
    return found


def sections(text):
    """Returns the headings of a help and the names of the options under each."""
    found = {}
    for line in text.splitlines():
        if re.fullmatch(r"\w[\w ]*:", line):
            names = found.setdefault(line[:-1], [])
        elif option := re.match(r"  (-\w,)?(--[\w-]+)", line):
            names.append(option.group(2))
    return found


class Help(unittest.TestCase):
    def test_headings_are_short(self):
        names = commands()
        self.assertGreater(len(names), 15)
        for command in names:
            for heading, options in sections(help_of(*command)).items():
                with self.subTest(command=command, heading=heading):
                    self.assertLessEqual(len(options), LONGEST_SECTION, options)

    def test_options_of_render_have_headings(self):
        found = sections(help_of("render"))
        self.assertLess(len(found["Options"]), 4, found["Options"])
        for heading, option in (("Light", "--shininess"), ("Lines", "--silhouettes"), ("Legend", "--legend-size"),
                                ("Camera", "--turn"), ("Film", "--crf"), ("Labels", "--scale-bar")):
            self.assertIn(option, found[heading])

    def test_columns_stand_below_each_other(self):
        """A unit such as Å is one letter wide, however many bytes it has."""
        for line in help_of("render").splitlines():
            if match := re.match(r"(  --[\w-]+ Å\s+)\S", line):
                self.assertEqual(len(match.group(1)), self.column(), line)

    @staticmethod
    def column():
        return len(re.search(r"^(  --shininess F\s+)\S", help_of("render"), re.M).group(1))


if __name__ == "__main__":
    unittest.main()
