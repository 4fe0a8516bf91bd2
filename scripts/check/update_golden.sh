#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Writes the pictures of tests/data/golden again; look at each. Usage: update_golden.sh [build folder]
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${1:-$root/build}
program=$build/tests/image/golden_test
if [ ! -x "$program" ]; then
  echo "update_golden.sh: $program is missing; build the tests first" >&2
  exit 1
fi
mkdir -p "$root/tests/data/golden"
MENISCUS_UPDATE_GOLDEN=1 "$program"
