#!/usr/bin/env bash
# Reads scenes for path tracers in their programs, as far as registries have them: Mitsuba 3 of PyPI, in a virtual
# environment below build/film_renderers, and pbrt4 of crates.io, which reads scenes for pbrt but does not render them
# (both are kept). The last line says "cases N failures M".
#
#   scripts/check/film_renderers.sh PROGRAM
set -euo pipefail
cd "$(dirname "$0")/../.."
program=$(realpath "${1:?usage: scripts/check/film_renderers.sh PROGRAM}")
home=$PWD/build/film_renderers
tests=$PWD/tests/export/path_tracers
# scripts/packages.sh does not install cargo, because Debian's Rust is older than the crate requires.
command -v cargo >/dev/null || { echo "film_renderers.sh: cargo is not installed; it brings a reader of pbrt's files" >&2; exit 1; }

if [[ ! -x $home/mitsuba/bin/mitsuba ]]; then
  rm -rf "$home/mitsuba"
  /usr/bin/python3 -m venv "$home/mitsuba"
  "$home/mitsuba/bin/pip" install --quiet --disable-pip-version-check mitsuba==3.9.1 "numpy<3"
fi
if [[ ! -x $home/read_pbrt/target/release/read_pbrt ]]; then
  mkdir -p "$home/read_pbrt"
  printf '%s\n' '[package]' 'name = "read_pbrt"' 'version = "0.1.0"' 'edition = "2021"' '[[bin]]' 'name = "read_pbrt"' \
    "path = \"$tests/read_pbrt.rs\"" '[dependencies]' 'pbrt4 = "=0.2.0"' >"$home/read_pbrt/Cargo.toml"
  cargo build --quiet --release --manifest-path "$home/read_pbrt/Cargo.toml"
fi

cases=0
failures=0
# count PYTHON SCRIPT WORDS...: runs a test, and adds up the numbers of its last line.
count() {
  local last
  last=$("$1" -B "$tests/$2" "$program" "${@:3}" 2>&1 | tee /dev/stderr | tail -n 1 || true)
  [[ $last =~ ^cases\ ([0-9]+)\ failures\ ([0-9]+)$ ]] || { cases=$((cases + 1)) failures=$((failures + 1)); return; }
  cases=$((cases + BASH_REMATCH[1]))
  failures=$((failures + BASH_REMATCH[2]))
}
count "$home/mitsuba/bin/python" inside_mitsuba.py
count /usr/bin/python3 pbrt_reader_test.py "$home/read_pbrt/target/release/read_pbrt"
echo "cases $cases failures $failures"
((failures == 0))
