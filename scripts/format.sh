#!/usr/bin/env bash
# Formats C++ with clang-format; with --check only says what would change.
set -euo pipefail
cd "$(dirname "$0")/.."
command -v clang-format >/dev/null || { echo "clang-format is missing: apt-get install clang-format" >&2; exit 1; }
mapfile -t files < <(git ls-files 'core/*.h' 'core/*.cpp' 'exporters/*.h' 'exporters/*.cpp' 'app/*.h' 'app/*.cpp' \
  'tests/*.h' 'tests/*.cpp')
if [[ ${1:-} == --check ]]; then exec clang-format --dry-run --Werror "${files[@]}"; fi
clang-format -i "${files[@]}"
