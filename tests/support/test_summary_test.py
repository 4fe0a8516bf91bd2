# SPDX-License-Identifier: BSD-3-Clause
"""The summary of test runs names every reason to be skipped, and fails where it must."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

SUMMARY = sys.argv.pop(1)

PASSED = '<testcase name="A.passes" status="run"><system-out>fine</system-out></testcase>'
FAILED = '<testcase name="A.fails" status="fail"><failure message=""/><system-out>bad</system-out></testcase>'
BY_CODE = ('<testcase name="A.code" status="notrun"><skipped message="SKIP_RETURN_CODE=77"/>'
           "<system-out>blender is not installed\n</system-out></testcase>")
BY_GTEST = ('<testcase name="A.gtest" status="notrun"><skipped message="SKIP_REGULAR_EXPRESSION_MATCHED"/>'
            "<system-out>[ RUN      ] A.gtest\n/a/b.cpp:3: Skipped\nthis driver\nhas no limit\n\n"
            "[  SKIPPED ] A.gtest (0 ms)\n</system-out></testcase>")
DISABLED = '<testcase name="A.off" status="disabled"><system-out>Disabled</system-out></testcase>'
MISSING = ('<testcase name="A.gone" status="notrun"><skipped message="Unable to find executable"/>'
           "<system-out>Unable to find executable: a_test</system-out></testcase>")
IN_PART = ('<testcase name="A.part" status="run"><system-out>test_b (__main__.T.test_b) ... skipped \'no cluster\'\n'
           "test_c (__main__.T.test_c) ... ok\n\nOK (skipped=1)\n</system-out></testcase>")


class Summary(unittest.TestCase):
    def summarize(self, *cases, strict=True, expected="# none\n"):
        with tempfile.TemporaryDirectory() as folder:
            junit, known = pathlib.Path(folder, "junit.xml"), pathlib.Path(folder, "expected.txt")
            junit.write_text(f"<testsuite>{''.join(cases)}</testsuite>")
            known.write_text(expected)
            command = [sys.executable, SUMMARY, *(["--strict"] if strict else []), "--expected", known, f"run={junit}"]
            done = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(done.stderr, "")
        return done.returncode, done.stdout

    def test_all_is_well(self):
        code, out = self.summarize(PASSED)
        self.assertEqual(code, 0)
        self.assertIn("could not run: 0", out)
        self.assertIn("run: 1 passed, 0 failed, 0 skipped\n", out)

    def test_every_skip_is_named_with_its_reason(self):
        code, out = self.summarize(PASSED, BY_CODE, BY_GTEST, DISABLED, IN_PART, strict=False)
        self.assertEqual(code, 0)
        self.assertIn("could not run: 4\n", out)
        for line in ("A.code (run): blender is not installed", "A.gtest (run): this driver has no limit",
                     "A.off (run): disabled", "A.part.test_b (run): no cluster"):
            self.assertIn(line, out)
        self.assertIn("run: 2 passed, 0 failed, 3 skipped\n", out)

    def test_an_unexpected_skip_is_a_failure_where_it_must_not_be(self):
        for case in (BY_CODE, BY_GTEST, DISABLED, IN_PART):
            self.assertEqual(self.summarize(PASSED, case)[0], 1, case)
        self.assertEqual(self.summarize(PASSED, BY_CODE, expected="A.c*: no Blender there\n")[0], 0)
        self.assertEqual(self.summarize(PASSED, BY_CODE, BY_GTEST, expected="A.code: no Blender there\n")[0], 1)

    def test_failures_fail_and_are_named_with_what_they_said(self):
        code, out = self.summarize(PASSED, FAILED, strict=False)
        self.assertEqual(code, 1)
        self.assertIn("failed: A.fails (run), which ended with\n  | bad\n", out)
        self.assertIn("run: 1 passed, 1 failed, 0 skipped\n", out)
        self.assertEqual(self.summarize(PASSED, MISSING, strict=False)[0], 1)

    def test_no_tests_is_no_success(self):
        code, out = self.summarize()
        self.assertEqual(code, 1)
        self.assertIn("no test at all", out)

    def test_a_run_that_left_nothing_is_no_success(self):
        done = subprocess.run([sys.executable, SUMMARY, "run=/no/such/junit.xml"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (1, "run: ctest left no /no/such/junit.xml\n"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
