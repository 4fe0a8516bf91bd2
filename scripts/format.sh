#!/usr/bin/env bash
# Formats C++ with clang-format 14; with --check it only reports differences.
set -euo pipefail
cd "$(dirname "$0")/.."
command -v clang-format-14 >/dev/null || { echo "clang-format is missing: apt-get install clang-format-14" >&2; exit 1; }
mapfile -t files < <(find core exporters app tests -name '*.h' -o -name '*.hpp' -o -name '*.cpp' | sort)
if [[ ${1:-} == --check ]]; then exec clang-format-14 --dry-run --Werror "${files[@]}"; fi
clang-format-14 -i "${files[@]}"
