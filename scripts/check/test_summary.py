#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Adds up runs of ctest, names every test that failed with the end of its output, and every one that could not run,
from their JUnit files.

Usage: test_summary.py [--strict] [--expected FILE] RUN=JUNIT.xml ...

Skipped is what GoogleTest, ctest or Python's unittest skipped, in part or whole, and what is disabled. FILE has a line
for each skip that is known: a pattern of the test's name (as in a shell), a colon, the reason. Exit code 1 if a test
failed or, with --strict, if a run has no tests or a test was skipped that FILE does not name.
"""

import argparse
import dataclasses
import fnmatch
import pathlib
import re
import sys
import xml.etree.ElementTree as ElementTree

GTEST_REASON = re.compile(r": Skipped\n(.*?)\n\s*\n?\[  SKIPPED \]", re.DOTALL)
UNITTEST_REASON = re.compile(r"^(\S+).*\.\.\. skipped '(.*)'$", re.MULTILINE)
LINES_OF_A_FAILURE = 40
NOT_FOUND = "Unable to find executable"  # ctest calls this skipped; it is a failure


@dataclasses.dataclass
class Skip:
    name: str
    run: str
    reason: str
    whole: bool = True  # false for one case of several


@dataclasses.dataclass
class Failure:
    name: str
    output: str


@dataclasses.dataclass
class Run:
    passed: int = 0
    failures: list = dataclasses.field(default_factory=list)
    skips: list = dataclasses.field(default_factory=list)


def reason_of(output):
    """Returns the last meaningful line that the test printed before it ended."""
    said = GTEST_REASON.search(output)
    if said:
        return " ".join(said[1].split())
    in_part = UNITTEST_REASON.search(output)
    if in_part:
        return in_part[2]
    lines = [line.strip() for line in output.splitlines() if line.strip()]
    return lines[-1] if lines else "no reason given"


def read_run(name, path):
    run = Run()
    for case in ElementTree.parse(path).getroot().iter("testcase"):
        status, output = case.get("status"), case.findtext("system-out") or ""
        skipped = case.find("skipped")
        if skipped is not None and NOT_FOUND not in skipped.get("message", ""):
            run.skips.append(Skip(case.get("name"), name, reason_of(output)))
        elif status == "disabled":
            run.skips.append(Skip(case.get("name"), name, "disabled"))
        elif status != "run":
            run.failures.append(Failure(case.get("name"), output))
        else:
            run.passed += 1
            for method, reason in UNITTEST_REASON.findall(output):
                run.skips.append(Skip(f"{case.get('name')}.{method}", name, reason, whole=False))
    return run


def read_expected(path):
    lines = [line for line in pathlib.Path(path).read_text().splitlines() if line.strip() and not line.startswith("#")]
    return [line.split(":", 1)[0].strip() for line in lines]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--strict", action="store_true")
    parser.add_argument("--expected")
    parser.add_argument("runs", nargs="+", metavar="RUN=JUNIT.xml")
    arguments = parser.parse_args()
    expected = read_expected(arguments.expected) if arguments.expected else []

    runs = {}
    for each in arguments.runs:
        name, path = each.split("=", 1)
        if not pathlib.Path(path).is_file():
            sys.exit(f"{name}: ctest left no {path}")
        runs[name] = read_run(name, path)
    skips = [skip for run in runs.values() for skip in run.skips]
    surprises = [skip for skip in skips if not any(fnmatch.fnmatchcase(skip.name, known) for known in expected)]
    empty = [name for name, run in runs.items() if run.passed + len(run.failures) + len(run.skips) == 0]

    print(f"could not run: {len(skips)}" + ("" if skips else ", nothing was skipped"))
    for skip in skips:
        print(f"  {skip.name} ({skip.run}): {skip.reason}" + (" [NOT EXPECTED]" if skip in surprises else ""))
    for name in empty:
        print(f"  {name}: no test at all")
    for name, run in runs.items():
        for failure in run.failures:
            print(f"failed: {failure.name} ({name}), which ended with")
            for line in failure.output.rstrip().splitlines()[-LINES_OF_A_FAILURE:]:
                print(f"  | {line}")
    for name, run in runs.items():
        print(f"{name}: {run.passed} passed, {len(run.failures)} failed, {sum(skip.whole for skip in run.skips)} skipped")
    if surprises and arguments.strict:
        print(f"{len(surprises)} skipped that {arguments.expected} does not name: install what is missing, or name it there")
    failed = sum(len(run.failures) for run in runs.values())
    return 1 if failed or (arguments.strict and (empty or surprises)) else 0


if __name__ == "__main__":
    sys.exit(main())
