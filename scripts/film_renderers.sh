#!/usr/bin/env bash
# Scenes for path tracers in the programs they are for: Mitsuba 3 of PyPI, in a virtual environment below
# build/film_renderers (kept). The last line says "cases N failures M".
#
#   scripts/film_renderers.sh PROGRAM
set -euo pipefail
cd "$(dirname "$0")/.."
program=$(realpath "${1:?usage: scripts/film_renderers.sh PROGRAM}")
home=$PWD/build/film_renderers
if [[ ! -x $home/bin/mitsuba ]]; then
  rm -rf "$home"
  /usr/bin/python3 -m venv "$home"
  "$home/bin/pip" install --quiet --disable-pip-version-check mitsuba==3.9.1
fi
exec "$home/bin/python" -B tests/export/path_tracers/inside_mitsuba.py "$program"
