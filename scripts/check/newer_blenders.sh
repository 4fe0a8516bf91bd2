#!/usr/bin/env bash
# Runs all tests of the Blender add-on in newer Blenders than Debian's: the module bpy of PyPI, each version in a
# virtual environment below build/blenders (1.6 GB each, kept), with its Molecular Nodes. Its Python is the system's or
# pyenv's if they have it, else uv fetches it. libmeniscus is taken from the program's build. The extension is made from
# the wheel for linux-x64 in the folder MENISCUS_WHEELS, or of that libmeniscus, and used in an empty profile. The last
# line says "cases N failures M", below a table in Markdown. Exit code 77: a Blender or its Python cannot be fetched.
#
#   scripts/check/newer_blenders.sh PROGRAM [VERSION...]     versions: 4.2 to 5.3 by default; newest: the registry's
#   MENISCUS_INSIDE="inside_blender inside_shot" ...   runs only these scripts
set -euo pipefail
cd "$(dirname "$0")/../.."
program=$(realpath "${1:?usage: scripts/check/newer_blenders.sh PROGRAM [VERSION...]}")
shift
versions=("${@:-4.2}")
(($#)) || versions=(4.2 4.3 4.4 4.5 5.0 5.1 5.2 5.3)
# 4.2.12 does not specify its databpy; a newer nodebpy breaks 520.2.0.
declare -A molecular_nodes=([4.2]="4.2.12 databpy==0.0.14" [4.5]=4.5.11 [5.0]=4.5.11 [5.2]="520.2.0 nodebpy==520.30.0")
tests=$PWD/tests/export/blender
addon=$PWD/exporters/blender/addon
export MENISCUS_LIBRARY=${program%/*}/exporters/bindings/c/libmeniscus.so MENISCUS_PACKAGE=$PWD/exporters/bindings/python/meniscus
unless_fetched() { "$@" || { echo "cannot be fetched: $*" >&2; exit 77; }; }
# The libraries of USD and Alembic read the files that Blender writes.
export MENISCUS_READERS=$PWD/build/blenders/readers/bin/python
if [[ ! -x ${MENISCUS_READERS%/*}/uv ]]; then
  /usr/bin/python3 -m venv build/blenders/readers
  unless_fetched "$MENISCUS_READERS" -m pip install -q --disable-pip-version-check numpy usd-core==26.11 alembic3d==1.8.12.1 uv
fi
if [[ ${versions[0]} == newest ]]; then
  versions=("$("$MENISCUS_READERS" -m pip index versions bpy --python-version 3.13 --only-binary :all: 2>/dev/null | sed -nE '1s/.*\(([0-9]+\.[0-9]+).*/\1/p')")
  unless_fetched test "${versions[0]}"
fi
cases=0
failures=0
table="| Blender | test | cases | failed |
|---|---|---|---|"
count() {  # SENTENCE CASES FAILURES TEST
  echo "$1"
  table+="
| $release | $4 | $2 | $3 |"
  cases=$((cases + $2))
  failures=$((failures + $3))
}

wheels=${MENISCUS_WHEELS:-build/blenders/wheels}
if [[ -z ${MENISCUS_WHEELS:-} ]]; then
  rm -rf "$wheels"
  /usr/bin/python3 -B "$tests/native_wheel.py" "$MENISCUS_LIBRARY" "$MENISCUS_PACKAGE" "$wheels"
fi
extension=$(scripts/extension.sh "$wheels" "$PWD/build/blenders/extension" linux-x64)
molecule=/usr/share/pymol/data/demo/1tii.pdb
area=$("$program" surface $molecule --json -q --device cpu | sed -nE 's/^  "area": ([0-9.]+),$/\1/p')

for version in "${versions[@]}"; do
  home=$PWD/build/blenders/$version
  if [[ ! -x $home/blender ]]; then
    rm -rf "$home"
    case $version in 4.* | 5.0) python=3.11 ;; *) python=3.13 ;; esac
    PATH=$PATH$(printf ':%s' "$HOME"/.pyenv/versions/"$python"*/bin) unless_fetched "${MENISCUS_READERS%/*}/uv" venv -q --seed --python "$python" "$home"
    packages=("bpy==$version.*")
    # shellcheck disable=SC2206  # several words are several packages
    [[ ${molecular_nodes[$version]:-} ]] && packages+=(molecularnodes==${molecular_nodes[$version]})
    [[ $version == 4.[34] ]] && packages+=("numpy<2")  # they were compiled with NumPy 1, and do not say so
    unless_fetched "$home/bin/pip" install --quiet --no-compile --disable-pip-version-check "${packages[@]}"
    printf '#!/bin/sh\nexec "%s/bin/python" "%s/bpy_as_blender.py" "$@"\n' "$home" "$tests" >"$home/blender"
    chmod +x "$home/blender"
  fi
  release=$("$home/bin/python" -c "import bpy; print(bpy.app.version_string)" 2>/dev/null | head -n 1)
  # The extension is checked like an upload, a repository and Install from Disk.
  validator=$(find "$home/lib" -path '*/bl_pkg/cli/blender_ext.py' -print -quit)
  unpacked=$home/extension
  rm -rf "$unpacked" "$home/profile"
  mkdir -p "$unpacked/built" "$home/profile"
  /usr/bin/python3 -m zipfile -e "$extension" "$unpacked/source"
  for words in "validate $addon/meniscus_import" "validate $extension" \
    "build --source-dir $unpacked/source --output-dir $unpacked/built"; do
    # shellcheck disable=SC2086  # several words
    said=$("$home/bin/python" "$validator" $words 2>&1) && failed=0 || failed=1
    count "Blender $version, extension ${words%% *}: ${said//$'\n'/; }" 1 $failed "extension ${words%% *}"
  done
  log=$home/inside_extension.log
  env -i HOME="$home/profile" PATH=/usr/bin:/bin BLENDER_USER_RESOURCES="$home/profile" "$home/blender" -b --factory-startup \
    --python-exit-code 3 --python "$tests/inside_extension.py" -- "$extension" "$molecule" "$area" "$home/extension.png" >"$log" 2>&1 && failed=0 || failed=1
  count "Blender $version, the extension in an empty profile: $failed failed; $log, $home/extension.png" 1 $failed inside_extension
  log=$home/inside_usd.log
  "$home/blender" -b --factory-startup --python-exit-code 3 --python "$tests/../mesh/inside_blender_usd.py" -- "$program" >"$log" 2>&1 && failed=0 || failed=1
  count "Blender $version, USD of a run: $failed failed; $log" 1 $failed inside_blender_usd
  for script in "$tests"/inside_*.py; do
    script=$(basename "$script" .py)
    [[ ${MENISCUS_INSIDE:-$script} == *"$script"* ]] || continue
    [[ $script == inside_extension || ($script == inside_molecular_nodes && -z ${molecular_nodes[$version]:-}) ]] && continue
    log=$home/$script.log
    /usr/bin/python3 "$tests/run_blender.py" "$home/blender" "$program" "$addon" "$tests/$script.py" >"$log" 2>&1 || true
    ran=$(sed -nE 's/^Ran ([0-9]+) tests? in .*/\1/p' "$log" | tail -n 1)
    failed=$(sed -nE 's/^FAILED \((.*)\)$/\1/p' "$log" | tail -n 1 | { grep -oE '(failures|errors)=[0-9]+' || true; } | cut -d= -f2 | paste -sd+)
    failed=$((${failed:-0}))
    [[ $ran ]] || { ran=1 failed=1; tail -n 20 "$log" >&2; }
    count "Blender $version, $script: $ran tests, $failed failed; $log" "$ran" "$failed" "$script"
  done
done
echo "$table"
echo "cases $cases failures $failures"
((failures == 0))
