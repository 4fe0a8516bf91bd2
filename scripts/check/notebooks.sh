#!/usr/bin/env bash
# Shows pages and widgets in a real JupyterLab in Chromium, views of `export mvs` in Mol*, and the twelve figures that are
# made by hand in the preview; newest of PyPI and npm. The last line says how many cases were tried. notebooks.sh [BUILD]: the folder with the program and the library (build).
set -euo pipefail
cd "$(dirname "$0")/../.."
build=$(realpath "${1:-build}")
export MENISCUS_LIBRARY=$build/exporters/bindings/c/libmeniscus.so MENISCUS_PROGRAM=$build/meniscus
export PYTHONPATH=$PWD/exporters/bindings/python
chromium=$(command -v chromium || command -v google-chrome) || { echo "chromium is missing: apt-get install chromium" >&2; exit 1; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

python3 -m venv "$folder/venv"
python=$folder/venv/bin/python
"$python" -m pip install -q --disable-pip-version-check jupyterlab anywidget playwright numpy pillow molviewspec websockets
(cd "$folder" && npm pack --silent molstar > /dev/null && tar xzf molstar-*.tgz package/build/viewer)
cases=0 failures=0
for check in "tests/python/notebook_check.py $chromium" "tests/export/mvs_check.py $chromium $folder/package/build/viewer" \
  "tests/preview/twelve_figures_test.py $MENISCUS_PROGRAM $chromium"; do
  # shellcheck disable=SC2086
  "$python" -B $check 2>&1 | tee "$folder/said" || true
  last=$(sed -nE 's/^cases ([0-9]+) failures ([0-9]+)$/\1 \2/p' "$folder/said" | tail -1)
  read -r tried failed <<< "${last:-1 1}"
  cases=$((cases + tried)) failures=$((failures + failed))
done
echo "cases $cases failures $failures"
[[ $failures == 0 ]]
