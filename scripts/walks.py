#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Counts the walk of a request through the code: what a reader has to follow from the command line to the result.

  walks.py [--list] [--build DIR] [--jobs N]

The program is built without optimization and runs each command below on ubiquitin under callgrind. A function of ours
that is called at most three times is a step of the walk; what is called more often is work, not way. What takes less
than a ten-thousandth of all instructions, with what it calls, is an accessor or a glance and no step either. A line says
how many steps there are, in how many files and folders; --list names them. The goal is at most 120 functions in 45
files and 14 folders a command.

A function counts once, whatever its template arguments, and a lambda belongs to the function that holds it. Constructors,
destructors and assignments do not count, for most are the compiler's.
"""

import argparse
import collections
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
MOLECULE = "/usr/share/freesasa/test-data/1ubq.pdb"
MOST_CALLS = 3
LEAST_SHARE = 1e-4
COMMANDS = {
    "render": ["render", MOLECULE, "-o", "picture.png", "--size", "64x48", "--samples", "1", "--device", "cpu"],
    "export povray": ["export", "povray", MOLECULE, "-o", "scene", "--device", "cpu"],
}


def run(command, **options):
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          errors="replace", **options)
    if done.returncode != 0:
        sys.exit(f"walks: error: {command[0]} failed:\n{done.stdout[-4000:]}")


def build(folder, jobs):
    """The program as it is written: no batches of files, nothing inlined, lines known."""
    run(["cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Debug", "-DCMAKE_CXX_FLAGS_DEBUG=-O0 -g1",
         "-DMENISCUS_TESTS=OFF", "-DMENISCUS_UNITY=OFF"])
    run(["cmake", "--build", folder, "-j", jobs, "--target", "meniscus"])


def counted(lines):
    """Calls, and instructions with those of what is called, of each (file, function); and instructions in all. From what
    callgrind wrote without compressed names."""
    calls, cost, total = collections.Counter(), collections.Counter(), 0
    here = there = function = callee = ""
    of_call = False
    for line in lines:
        key, _, value = line.rstrip("\n").partition("=")
        if key in ("fl", "fi", "fe"):
            here = value
        elif key == "fn":
            function = here, value
        elif key in ("cfi", "cfl"):
            there = value
        elif key == "cfn":
            callee = there or here, value
            there = ""
        elif key == "calls":
            calls[callee] += int(value.split()[0])
            of_call = True
        elif line[:1].isdigit() or line[:1] in ("+", "-", "*"):
            instructions = int(line.split()[1])
            cost[function] += instructions
            total += 0 if of_call else instructions
            of_call = False
    return calls, cost, total


def plain(name):
    """The function without template and other arguments."""
    name = re.sub(r"operator\s*(<=>|<<=?|>>=?|<=?|>=?|->\*?|\(\))", "operator_", name)
    name = re.sub(r"\(anonymous namespace\)::|\[abi:cxx11\]|'\d+$", "", name)
    depth, kept = 0, []
    for letter in name:
        depth += letter in "<({"
        if depth == 0:
            kept.append(letter)
        depth -= letter in ">)}"
    return "".join(kept).replace(" const", "").split(" ")[-1]


def is_step(name):
    if "{lambda" in name or name.startswith(("_GLOBAL__", "__static_init")):
        return False
    parts = plain(name).split("::")
    return not (len(parts) > 1 and parts[-1].lstrip("~") == parts[-2]) and parts[-1] != "operator="


def steps(lines):
    """The functions of the walk, by file."""
    calls, cost, total = counted(lines)
    times, share = collections.Counter(), collections.Counter()
    for file, name in calls:
        path = pathlib.Path(os.path.normpath(file))
        if path.is_relative_to(ROOT) and not path.is_relative_to(ROOT / "build") and is_step(name):
            step = str(path.relative_to(ROOT)), plain(name)
            times[step] += calls[file, name]
            share[step] += cost[file, name] / total
    return sorted(step for step in times if times[step] <= MOST_CALLS and share[step] >= LEAST_SHARE)


def walk(program, words, folder):
    """What the program calls for these words; it is run in the folder."""
    written = folder / "callgrind.out"
    run(["valgrind", "--tool=callgrind", "--compress-strings=no", "--compress-pos=no", f"--callgrind-out-file={written}",
         program, *words], cwd=folder)
    with open(written, encoding="utf-8", errors="replace") as lines:
        return steps(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--list", action="store_true", help="name the functions, file by file")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "walks", metavar="DIR")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), metavar="N", help="compilers at a time")
    options = parser.parse_args()
    if not shutil.which("valgrind"):
        run(["bash", "-c", f"source {ROOT}/scripts/packages.sh && install_packages valgrind"])
    build(options.build, options.jobs)
    for name, words in COMMANDS.items():
        with tempfile.TemporaryDirectory(prefix="meniscus-walks-") as folder:
            found = walk(options.build.resolve() / "meniscus", words, pathlib.Path(folder))
        files = {file for file, _ in found}
        folders = {os.path.dirname(file) for file in files}
        print(f"{name} {len(found)} functions in {len(files)} files and {len(folders)} folders", flush=True)
        if options.list:
            print("".join(f"  {file}  {function}\n" for file, function in found), end="", flush=True)


if __name__ == "__main__":
    main()
