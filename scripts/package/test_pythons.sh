#!/usr/bin/env bash
# Installs a wheel into fresh environments of several Pythons, with each requested numpy that PyPI has for them, and runs
# the package's tests there.
#
#   scripts/package/test_pythons.sh WHEEL [PYTHON...]      python3.9 to python3.14, as far as they are there, by default
#
# MENISCUS_NUMPY: the versions of numpy, such as "1.26 2". The last line says `cases N failures M`.
set -euo pipefail
cd "$(dirname "$0")/../.."
(($#)) || { sed -n '2,7s/^# \{0,1\}//p' "$0" >&2; exit 2; }
wheel=$(realpath "$1")
shift
pythons=("$@")
((${#pythons[@]})) || mapfile -t pythons < <(compgen -c python3. | grep -xE 'python3\.(9|1[0-4])' | sort -uV)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
unset MENISCUS_LIBRARY MENISCUS_PACKAGE

cases=0 failures=0
for python in "${pythons[@]}"; do
  for numpy in ${MENISCUS_NUMPY:-1.26 2}; do
    venv=$folder/$cases
    cases=$((cases + 1))
    what=$("$python" -c 'import sys; print("CPython", sys.version.split()[0])')
    if ! { "$python" -m venv "$venv" && "$venv/bin/python" -m pip install -q --disable-pip-version-check --only-binary=:all: \
      "$wheel" "numpy==$numpy.*"; } > "$folder/log" 2>&1; then
      if grep -qE "requirement numpy.*from versions: [0-9]" "$folder/log"; then
        cases=$((cases - 1))
        echo "none    $what: PyPI has no numpy $numpy for it"
        continue
      fi
    elif (cd "$folder" && "$venv/bin/python" -B "$OLDPWD/tests/python/package_test.py") > "$folder/log" 2>&1; then
      echo "good    $what, numpy $("$venv/bin/python" -c 'import numpy; print(numpy.__version__)'): $(grep -oE 'Ran .* tests' "$folder/log")"
      continue
    fi
    failures=$((failures + 1))
    echo "FAILED  $what, numpy $numpy"
    tail -n 5 "$folder/log"
  done
done
echo "cases $cases failures $failures"
((cases && failures == 0))
