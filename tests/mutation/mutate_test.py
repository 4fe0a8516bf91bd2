# SPDX-License-Identifier: BSD-3-Clause
"""What a fault quotes is found regardless of white space, in its function alone, where it is the one place that fits."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, sys.argv.pop(1))
import mutate  # noqa: E402

TEXT = """int least(int a, int b) {
  if (a < b) return least(a, b, 0);
  return
      b;
}
int most(int a, int b) { return b; }
struct Pair {
  Pair(int a, int b) : a(a), b(b) {
    if (a < b) swap();
  }
  int least() const { return a; }
};
"""
PYTHON = """def least(a, b):
    if a < b:
        return a

    return b
LAST = least(a < b, 1)
"""


class Planting(unittest.TestCase):
    def planted(self, new, text=TEXT, name="file.cpp", **quoted):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / name).write_text(text)
            fault = mutate.Fault(name="n", file=name, new=new, build=(), tests="", **quoted)
            return fault.planted_in(pathlib.Path(folder))

    def test_blanks_are_any_white_space(self):
        self.assertEqual(self.planted("return a;", old="return b; } int"), TEXT.replace("return\n      b;\n}\nint", "return a;"))

    def test_words_are_no_pattern(self):
        self.assertEqual(self.planted("a(b)", old="a(a)"), TEXT.replace("a(a)", "a(b)"))
        self.assertRaises(ValueError, self.planted, "", old="a .*")

    def test_a_function_is_searched_alone(self):
        self.assertEqual(self.planted("a;", function="most", old="b;"), TEXT.replace("{ return b; }", "{ return a; }"))
        self.assertEqual(self.planted(">", function="Pair", old="<"), TEXT[::-1].replace("<", ">", 1)[::-1])
        self.assertEqual(self.planted(">", PYTHON, "file.py", function="least", old="<"), PYTHON.replace("<", ">", 1))

    def test_definitions_of_one_name_are_all_searched(self):
        self.assertEqual(self.planted("b", function="least", old="a;"), TEXT.replace("return a; }\n}", "return b }\n}"))
        self.assertRaisesRegex(ValueError, "fits 3 places of least", self.planted, "", function="least", old="return")

    def test_one_place_fits(self):
        self.assertRaisesRegex(ValueError, "fits 4 places", self.planted, "", old="return")
        self.assertRaisesRegex(ValueError, "fits 0 places", self.planted, "", old="while")
        self.assertRaisesRegex(ValueError, "defines no function swap", self.planted, "", function="swap", old="a")


if __name__ == "__main__":
    unittest.main()
