#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""header_weight.py [BUILD] [--top N]: how much of the compile time of `meniscus` lies behind each header of ours.

A header's share is the time of the objects that are compiled again when it changes. Times come from the build's
.ninja_log, so they are those of a build without ccache: CCACHE_DISABLE=1 ninja -C build/release meniscus.
"""

import argparse
import collections
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]


def ninja(build, *arguments):
    return subprocess.run(["ninja", "-C", build, *arguments], check=True, capture_output=True, text=True).stdout


def durations(build):
    """Seconds of each output; the last line of a log is the one that counts."""
    times = {}
    for line in (build / ".ninja_log").read_text().splitlines():
        if not line.startswith("#"):
            start, end, _, output, _ = line.split("\t")
            times[output] = (int(end) - int(start)) / 1000
    return times


def objects_of(build, target):
    commands = ninja(build, "-t", "commands", target).splitlines()
    words = (command.split() for command in commands if " -c " in command)
    return {command[command.index("-o") + 1] for command in words if "-o" in command}


def headers_of(build):
    """Our own headers behind each object."""
    found, output = collections.defaultdict(set), None
    for line in ninja(build, "-t", "deps").splitlines():
        if line and not line.startswith(" "):
            output = line.split(":")[0]
        elif line.strip():
            path = (build / line.strip()).resolve()
            if path.suffix in {".h", ".hpp", ".glsl"} and path.is_relative_to(ROOT) and not path.is_relative_to(build):
                found[output].add(str(path.relative_to(ROOT)))
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", nargs="?", type=pathlib.Path, default=ROOT / "build/release")
    parser.add_argument("--target", default="meniscus")
    parser.add_argument("--top", type=int, default=10)
    arguments = parser.parse_args()
    build = arguments.build.resolve()

    times, headers = durations(build), headers_of(build)
    objects = [name for name in objects_of(build, arguments.target) if name in times]
    total = sum(times[name] for name in objects)
    seconds, counts = collections.Counter(), collections.Counter()
    for name in objects:
        for header in headers[name]:
            seconds[header] += times[name]
            counts[header] += 1
    print(f"{total:.0f} s in {len(objects)} objects")
    for header, time in seconds.most_common(arguments.top):
        print(f"{time / total:4.0%} {counts[header]:4} objects  {header}")


if __name__ == "__main__":
    main()
