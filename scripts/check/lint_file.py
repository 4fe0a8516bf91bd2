#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs clang-tidy on one file: lint_file.py BUILD_FOLDER FILE [OPTIONS OF CLANG-TIDY...].

A sound file is remembered by what the compiler sees of it, its comments, .clang-tidy and the options; the same is not
checked again, in whatever checkout. Prints what clang-tidy found, and then "FAILED FILE".
"""

import hashlib
import json
import os
import shlex
import subprocess
import sys
from pathlib import Path

BUILD, FILE, *OPTIONS = sys.argv[1:]
ROOT = os.getcwd()
SOUND = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "meniscus" / "lint"


def as_compiled():
    """Returns the command that compiles the file, from the compiler's name on. A file that only other builds compile,
    such as core/surface/gpu_engine_without_gl.cpp, gets that of a neighbour, as clang-tidy does."""
    entries = {os.path.relpath(entry["file"], ROOT): entry
               for entry in json.loads(Path(BUILD, "compile_commands.json").read_text())}
    entry = entries.get(FILE) or next(
        (entries[name] for name in sorted(entries) if os.path.dirname(name) == os.path.dirname(FILE)), None)
    if entry is None:
        sys.exit(f"lint_file.py: {BUILD} compiles no file in the folder of {FILE}")
    words = shlex.split(entry["command"])
    first = next(n for n, word in enumerate(words) if os.path.basename(word).startswith("clang++"))
    return words[first:words.index("-o")], entry["directory"]


def fingerprint():
    command, folder = as_compiled()
    text = subprocess.run([*command, "-E", "-C", "-dD", os.path.join(ROOT, FILE)], cwd=folder, capture_output=True, check=True).stdout
    known = hashlib.sha256(text.replace(ROOT.encode(), b""))
    known.update(Path(".clang-tidy").read_bytes())
    known.update(subprocess.run(["clang-tidy-14", "--version"], capture_output=True, check=True).stdout)
    known.update(" ".join(OPTIONS).encode())
    return known.hexdigest()


sound = SOUND / fingerprint()
if not sound.exists():
    done = subprocess.run(["clang-tidy-14", "-p", BUILD, "--quiet", "--warnings-as-errors=*", *OPTIONS, FILE],
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=False)
    if done.returncode:
        print(done.stdout + "FAILED " + FILE, flush=True)
    else:
        SOUND.mkdir(parents=True, exist_ok=True)
        sound.touch()
