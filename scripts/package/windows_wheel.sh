#!/usr/bin/env bash
# Uses the wheel for Windows in a Python for Windows, under Wine: pip of that Python installs it, the package computes and
# draws, and the programs are run by the names that pip gave them. The last line says "cases N failures M".
#
#   scripts/package/windows_wheel.sh WHEEL
set -euo pipefail
cd "$(dirname "$0")/../.."
wheel=$(realpath "${1:?usage: scripts/package/windows_wheel.sh WHEEL}")
source scripts/package/windows_python.sh
molecule=/usr/share/freesasa/test-data/1ubq.pdb
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cases=0 failures=0
# check WHAT COMMAND...: counts a case, and prints its result and time.
check() {
  local what=$1 begin=$EPOCHREALTIME
  shift
  cases=$((cases + 1))
  if "$@" < /dev/null 2>&1 | cat > "$work/log"; then
    echo "good    $what ($(bc <<< "scale=1; ($EPOCHREALTIME - $begin) / 1") s): $(tail -n 1 "$work/log" | tr -d '\r' | cut -c 1-120)"
  else
    failures=$((failures + 1))
    echo "FAILED  $what"
    tail -n 5 "$work/log"
  fi
}

pip() { wine "$python" -B "$(there "$(ls "$(dirname "$python")"/lib/ensurepip/_bundled/pip-*.whl)")/pip" "$@"; }
# pip installs these files: Python with the package in its path, and the programs.
inside() { PYTHONPATH=$(there "$work/prefix/Lib/site-packages") wine "$python" -B "$@"; }
program() { wine "$work/prefix/Scripts/meniscus-$1.exe" "${@:2}"; }
first_area() {
  pip install -q --no-index --find-links "$(there "$work")" --prefix "$(there "$work/prefix")" "$(there "$wheel")" && inside -c "$compute"
}
compute="
import meniscus
surface = meniscus.surface(meniscus.read(r'$(there $molecule)'))
picture = surface.render(size='160x120')
assert picture.png().startswith(b'\x89PNG') and picture.pixels.any()
print(f'area {surface.area:.15g}, volume {surface.volume:.15g}')"
spheres() { program pdb_to_xyzr "$molecule" > "$work/$1.xyzr" && program pdb_to_xyzrn "$molecule" > "$work/$1.xyzrn" && wc -l "$work/$1.xyzrn"; }
msms() { cd "$work" && program msms -if Å.xyzr -of Å -af Å -density 3 && ls Å.vert Å.face Å.area; }
picture() { cd "$work" && cp "$molecule" Å.pdb && wine "$work/prefix/Scripts/meniscus.exe" render Å.pdb -o Å.png --size 160x120 && ls Å.png; }
nanoshaper() { cd "$work" && printf 'XYZR_FileName = Å.xyzr\nRoot_FileName = Å.\n' > Å.prm && program nanoshaper Å.prm; }

python3 -m pip download -q --disable-pip-version-check --no-deps --only-binary=:all: --platform win_amd64 --python-version 3.11 -d "$work" "numpy==1.26.*"
check "installed by pip, to the first area" first_area
check "the area again" inside -c "$compute"
check "spheres, with and without names" spheres Å
check "meniscus render" picture
check "meniscus-msms" msms
check "meniscus-nanoshaper" nanoshaper
echo "cases $cases failures $failures"
((failures == 0))
