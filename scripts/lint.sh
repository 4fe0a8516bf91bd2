#!/usr/bin/env bash
# Runs clang-tidy with the checks of .clang-tidy; warnings are errors. Without options it checks the folders that write
# files and compute the surface, without the static analyzer, which takes as long as all other checks; --all takes all
# of our code and all checks; or name files. Files that passed before and have not changed are skipped. The last line
# has the numbers of files and of failures.
set -euo pipefail
cd "$(dirname "$0")/.."
command -v clang-tidy-14 >/dev/null || { echo "clang-tidy is missing: apt-get install clang-tidy-14" >&2; exit 1; }

checks=(--checks=-clang-analyzer-*)
folders=(core/base core/reduced_surface core/surface core/queries)
if [[ ${1:-} == --all ]]; then
  checks=()
  folders=(core exporters app)
  shift
fi
files=("$@")
if ((${#files[@]} == 0)); then mapfile -t files < <(find "${folders[@]}" -name '*.cpp' ! -name '*_windows.cpp' | sort); fi

# These commands compile each file separately without precompiled headers, so nothing must be built before.
build=build/lint
cmake --preset asan -B "$build" -DMENISCUS_PRECOMPILED=OFF -DMENISCUS_UNITY=OFF >/dev/null

printf '%s\0' "${files[@]}" |
  xargs -0 -P "${MENISCUS_JOBS:-$(nproc)}" -I FILE /usr/bin/python3 scripts/check/lint_file.py "$build" FILE "${checks[@]}" |
  tee "$build/clang-tidy.log"
failures=$(grep -c '^FAILED ' "$build/clang-tidy.log" || true)
echo "cases ${#files[@]} failures $failures"
((failures == 0))
