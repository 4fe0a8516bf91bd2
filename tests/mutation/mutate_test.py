# SPDX-License-Identifier: BSD-3-Clause
"""What a fault quotes is found regardless of white space, and only where it is the one place that fits."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, sys.argv.pop(1))
import mutate  # noqa: E402

TEXT = "if (a < b)\n    return f(a, b);\nreturn f(b, a) + g(1);\n"


class Planting(unittest.TestCase):
    def planted(self, new, **quoted):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "file").write_text(TEXT)
            fault = mutate.Fault(name="n", file="file", new=new, build=(), tests="", **quoted)
            return fault.planted_in(pathlib.Path(folder))

    def test_blanks_are_any_white_space(self):
        self.assertEqual(self.planted("return 0;", old="if (a < b) return f(a, b);"), "return 0;\nreturn f(b, a) + g(1);\n")

    def test_words_are_no_pattern(self):
        self.assertEqual(self.planted("- g(1)", old="+ g(1)"), TEXT.replace("+", "-"))
        self.assertRaises(ValueError, self.planted, "", old="a .*")

    def test_a_pattern_hands_on_its_groups(self):
        self.assertEqual(self.planted(r"f(\1, \1)", pattern=r"f\((b), a\)"), TEXT.replace("f(b, a)", "f(b, b)"))

    def test_one_place_fits(self):
        self.assertRaisesRegex(ValueError, "fits 2 places", self.planted, "", old="return")
        self.assertRaisesRegex(ValueError, "fits 0 places", self.planted, "", pattern="while")


if __name__ == "__main__":
    unittest.main()
