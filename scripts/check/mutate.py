#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Plants faults into the program, one at a time, and shows which test turns red.

  mutate.py [--only NAME ...] [--tree DIR] [--jobs N] [--faults FILE] [--list | --check]

The faults are data: tests/mutation/faults.toml. The working tree is copied to a folder of its own (a temporary one, or
DIR, whose build is used again), so nothing is ever planted here. First all tests that the faults name must be green,
and be of programs that the fault builds; then each fault is planted, what its tests need is built, and its tests run
until one is red. A fault that no test finds survives; one whose text is not in its file exactly once no longer applies.
All of these are failures: exit code 1.
"""

import argparse
import dataclasses
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
FAULTS = ROOT / "tests" / "mutation" / "faults.toml"
TEST_SECONDS = 300  # a fault may make a loop endless
RED = re.compile(r"Test\s+#\d+: (\S+) .*\*\*\*")


STATEMENT = re.compile(r" *(?:\} *)?(?://|#|\*|(?:if|for|while|switch|return|else|case|throw|do)\b)")


def closing(text, begin):
    """Returns the index of the parenthesis that closes the one at `begin`."""
    depth = 0
    for at in range(begin, len(text)):
        depth += {"(": 1, ")": -1}.get(text[at], 0)
        if depth == 0:
            return at
    return len(text)


def bodies(text, name, python):
    """Returns (begin, end) of each definition of a function `name`, which formatted code ends at its own indent."""
    found = []
    before = r"(?:async )?def " if python else r"(?:\S[^\n]*?)?(?<![\w.>])"
    for line in re.finditer(rf"^( *){before}{re.escape(name)}\(", text, re.MULTILINE):
        head = re.compile(r"\)[^:]*:" if python else r"\)[^;{]*\{").match(text, closing(text, line.end() - 1))
        if STATEMENT.match(line[0]) or not head:
            continue
        line_end = text.find("\n", head.end())
        one_line = not python and text[head.end():line_end].strip()
        last = re.compile(rf"\n(?= {{0,{len(line[1])}}}\S)" if python else rf"\n{line[1]}\}}").search(text, line_end)
        found.append((line.start(), line_end if one_line else last.end() if last else len(text)))
    return found


@dataclasses.dataclass(frozen=True)
class Fault:
    """A fault replaces `old` by `new` in a function of `file`; the tests that match `tests` need the targets `build`.

    `old` quotes as few words as name the place within the function, and a blank in it is any white space, so that a
    fault survives another indent, line break or change elsewhere. Without a function the place is unique in the file.
    """

    name: str
    file: str
    old: str
    new: str
    build: tuple[str, ...]
    tests: str
    function: str = ""

    def planted_in(self, root):
        """Returns the faulty text of the file. Raises ValueError if the fault does not apply to it."""
        text = (root / self.file).read_text(encoding="utf-8")
        places = bodies(text, self.function, self.file.endswith(".py")) if self.function else [(0, len(text))]
        if not places:
            raise ValueError(f"{self.file} defines no function {self.function}")
        quoted = re.compile(r"\s+".join(re.escape(part) for part in re.split(r"\s+", self.old)))
        found = {match.span() for begin, end in places for match in quoted.finditer(text, begin, end)}
        if len(found) != 1:
            raise ValueError(f"it fits {len(found)} places of {self.function or self.file}, not one")
        [(begin, end)] = found
        return text[:begin] + self.new + text[end:]


def read_faults(path):
    with open(path, "rb") as file:
        entries = tomllib.load(file)["fault"]
    keys = {field.name for field in dataclasses.fields(Fault)}
    faults = []
    for entry in entries:
        if set(entry) | {"function"} != keys:
            sys.exit(f"mutate: error: {path}: {entry.get('name')}: keys are {sorted(entry)}, not {sorted(keys)}")
        faults.append(Fault(**{**entry, "build": tuple(entry["build"])}))
    names = [fault.name for fault in faults]
    for name in names:
        if names.count(name) > 1:
            sys.exit(f"mutate: error: {path}: two faults are called {name!r}")
    return faults


def check(faults, root):
    """Returns the reasons why faults do not apply to the tree, by name."""
    wrong = {}
    for fault in faults:
        try:
            if fault.planted_in(root) == (root / fault.file).read_text(encoding="utf-8"):
                raise ValueError("it changes nothing")
        except (OSError, ValueError) as error:
            wrong[fault.name] = str(error)
    return wrong


def project_files():
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT,
                            check=True, capture_output=True, text=True).stdout
    return [name for name in listed.split("\0") if name and (ROOT / name).is_file()]


def copy_tree(target):
    """Copies the tree; equal files keep their times, so that nothing is built twice."""
    wanted = set(project_files())
    for name in wanted:
        source, copy = ROOT / name, target / name
        if copy.is_file() and copy.read_bytes() == source.read_bytes():
            continue
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source, copy)
    for path in target.rglob("*"):
        name = path.relative_to(target)
        if path.is_file() and name.parts[0] != "build" and str(name) not in wanted:
            path.unlink()


class Copy:
    """A copy of the working tree, and its build."""

    def __init__(self, folder, jobs):
        self.folder = folder
        self.build_folder = folder / "build" / "test"
        self.jobs = jobs
        copy_tree(folder)
        self.run(["cmake", "-S", folder, "-B", self.build_folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                  "-DMENISCUS_TESTS=ON", "-DMENISCUS_UNITY=OFF"])

    def run(self, command):
        done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, errors="replace")
        if done.returncode != 0:
            raise subprocess.CalledProcessError(done.returncode, command, done.stdout)
        return done.stdout

    def build(self, targets):
        self.run(["cmake", "--build", self.build_folder, "-j", self.jobs, "--target", *sorted(targets)])

    def not_built(self, fault):
        """Returns programs that the fault's tests run but that it does not build: they may have an earlier fault."""
        listed = self.run(["ctest", "--test-dir", self.build_folder, "-R", fault.tests, "--no-tests=error",
                           "--show-only=json-v1"])
        words = {pathlib.Path(word) for test in json.loads(listed)["tests"] for word in test.get("command", [])}
        programs = {word.name for word in words if self.build_folder in word.parents and os.access(word, os.X_OK)}
        return sorted(programs - set(fault.build))

    def first_red(self, tests):
        """Returns the first test that fails among those that match, or None."""
        try:
            self.run(["ctest", "--test-dir", self.build_folder, "-R", tests, "--no-tests=error", "--stop-on-failure",
                      "--timeout", TEST_SECONDS])
        except subprocess.CalledProcessError as failed:
            red = RED.search(failed.output)
            if not red:
                raise
            return red[1]
        return None


class Table:
    """Prints one line per fault, as soon as its result is known."""

    def __init__(self, names):
        self.width = max(len(name) for name in names)
        self.cases = self.failures = 0
        self.row("fault", "test that turned red", "seconds")

    def row(self, name, what, seconds):
        print(f"{name:<{self.width}}  {what:<60}  {seconds:>7}", flush=True)

    def add(self, name, what, begin, failed):
        self.cases += 1
        self.failures += failed
        self.row(name, what, f"{time.monotonic() - begin:.1f}")

    def end(self):
        print(f"cases {self.cases} failures {self.failures}")
        return 1 if self.failures else 0


def last_lines(error):
    return "\n".join((error.output or "").splitlines()[-15:])


def plant(copy, fault):
    """Returns the result of one fault, and whether it is a failure."""
    path = copy.folder / fault.file
    original = path.read_text(encoding="utf-8")
    try:
        path.write_text(fault.planted_in(copy.folder), encoding="utf-8")
        copy.build(fault.build)
        red = copy.first_red(fault.tests)
        return (red, False) if red else ("SURVIVED", True)
    except ValueError as error:
        return f"DOES NOT APPLY: {error}", True
    except subprocess.CalledProcessError as error:
        print(last_lines(error), file=sys.stderr)
        return "CANNOT BE BUILT OR TESTED", True
    finally:
        path.write_text(original, encoding="utf-8")


def control(copy, faults, table):
    """Checks that all tests pass without a fault, and that each fault builds what its tests run."""
    begin = time.monotonic()
    try:
        copy.build({target for fault in faults for target in fault.build})
        for fault in faults:
            if programs := copy.not_built(fault):
                table.add(fault.name, f"DOES NOT BUILD {', '.join(programs)}, WHICH ITS TESTS RUN", begin, True)
        if table.failures:
            return False
        red = copy.first_red("|".join(sorted({fault.tests for fault in faults})))
    except subprocess.CalledProcessError as error:
        print(last_lines(error), file=sys.stderr)
        red = "cannot be built"
    table.add("(none)", f"RED WITHOUT A FAULT: {red}" if red else "none, as it should be", begin, bool(red))
    return not red


def run(faults, folder, jobs):
    table = Table([fault.name for fault in faults])
    copy = Copy(folder, jobs)
    if control(copy, faults, table):
        for fault in faults:
            begin = time.monotonic()
            what, failed = plant(copy, fault)
            table.add(fault.name, what, begin, failed)
    return table.end()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", metavar="NAME", help="these faults, by the beginning of their names")
    parser.add_argument("--tree", type=pathlib.Path, metavar="DIR", help="copy the working tree here, and keep it")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), metavar="N", help="compilers at a time")
    parser.add_argument("--faults", type=pathlib.Path, default=FAULTS, metavar="FILE")
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--list", action="store_true", help="print the faults and where they are planted")
    what.add_argument("--check", action="store_true", help="only see whether every fault still applies to this tree")
    options = parser.parse_args()

    faults = read_faults(options.faults)
    if options.only:
        faults = [fault for fault in faults if fault.name.startswith(tuple(options.only))]
    if not faults:
        sys.exit("mutate: error: no such fault; --list names them all")
    if options.list:
        for fault in faults:
            print(f"{fault.name}: {fault.file}: {fault.tests}")
        return 0
    if options.check:
        wrong = check(faults, ROOT)
        for name, why in wrong.items():
            print(f"{name}: {why}")
        print(f"cases {len(faults)} failures {len(wrong)}")
        return 1 if wrong else 0
    if options.tree:
        options.tree.mkdir(parents=True, exist_ok=True)
        return run(faults, options.tree.resolve(), options.jobs)
    with tempfile.TemporaryDirectory(prefix="meniscus-mutations-") as folder:
        return run(faults, pathlib.Path(folder).resolve(), options.jobs)


if __name__ == "__main__":
    sys.exit(main())
