#!/usr/bin/env bash
# Uses the extension in Blenders for Windows, in Wine and an empty profile: installed by Blender itself it computes, renders and
# goes again. Blender is the module bpy of PyPI. The last line says "cases N failures M".
#
#   scripts/package/windows_blender.sh PROGRAM WHEELS [VERSION...]     WHEELS: a folder with the wheel for win_amd64
#                                                              versions: 4.2, 4.5, 5.0 by default
set -euo pipefail
cd "$(dirname "$0")/../.."
usage="usage: scripts/package/windows_blender.sh PROGRAM WHEELS [VERSION...]"
program=$(realpath "${1:?$usage}")
wheels=${2:?$usage}
shift 2
(($#)) || set -- 4.2 4.5 5.0
source scripts/package/windows_python.sh
tests=$PWD/tests/export/blender
molecule=/usr/share/pymol/data/demo/1tii.pdb
extension=$(scripts/extension.sh "$wheels" "$home" windows-x64)
area=$("$program" surface $molecule --json -q --device cpu | sed -nE 's/^  "area": ([0-9.]+),$/\1/p')
cases=0
failures=0
for version; do
  if [[ ! -d $home/$version ]]; then
    pip install --quiet --disable-pip-version-check --root-user-action=ignore --no-deps --only-binary=:all: --platform win_amd64 --python-version 3.11 \
      --target "$home/$version" "bpy==$version.*" numpy==1.26.4
  fi
  rm -rf "$home/profile"
  mkdir "$home/profile"
  log=$home/$version.log
  env -u MENISCUS_LIBRARY -u MENISCUS_PACKAGE BLENDER_USER_RESOURCES="$(there "$home/profile")" PYTHONPATH="$(there "$home/$version")" \
    wine "$python" -B "$(there "$tests/bpy_as_blender.py")" -b --factory-startup --python-exit-code 3 \
    --python "$(there "$tests/inside_extension.py")" -- "$(there "$extension")" "$(there $molecule)" "$area" \
    "$(there "$home/$version.png")" </dev/null 2>&1 | cat >"$log" && failed=0 || failed=1
  echo "Blender $version for Windows, the extension in an empty profile: $failed failed; $log, $home/$version.png"
  cases=$((cases + 1))
  failures=$((failures + failed))
done
echo "cases $cases failures $failures"
((failures == 0))
