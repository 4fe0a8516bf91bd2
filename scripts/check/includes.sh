#!/usr/bin/env bash
# Checks that every file includes what it needs: checks the syntax of each separately, without precompiled headers. The
# last line has the numbers of files and of failures.
set -euo pipefail
cd "$(dirname "$0")/../.."
build=build/plain
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DMENISCUS_PRECOMPILED=OFF \
  -DMENISCUS_UNITY=OFF >/dev/null

# commands: prints a line of words separated by tabs for each file: the file, and its compile command.
commands() {
  /usr/bin/python3 - "$build/compile_commands.json" "$PWD" "$@" <<'PYTHON'
import json, shlex, sys
database, root, wanted = sys.argv[1], sys.argv[2], sys.argv[3:]
for entry in json.load(open(database)):
    name = entry["file"].removeprefix(root + "/")
    if name in wanted if wanted else name.startswith(("core/", "exporters/", "app/", "tests/")):
        words = shlex.split(entry["command"])
        print(name, *words[:words.index("-o")], "-fsyntax-only", entry["file"], sep="\t")
PYTHON
}

try() {
  IFS=$'\t' read -ra words <<<"$1"
  "${words[@]:1}" >/dev/null 2>"$2.$$" && rm "$2.$$" || { cat "$2.$$"; rm "$2.$$"; echo "FAILED ${words[0]}"; }
}
export -f try

log=$build/includes.log
commands "$@" | tee "$build/includes.list" |
  xargs -d '\n' -P "${MENISCUS_JOBS:-$(nproc)}" -n 1 bash -c 'try "$2" "$1"' - "$build/errors" | tee "$log"
failures=$(grep -c '^FAILED ' "$log" || true)
echo "cases $(wc -l <"$build/includes.list") failures $failures"
((failures == 0))
