#!/usr/bin/env bash
# manual.sh [--look] [FOLDER]: builds the manual as a static site in FOLDER (build/manual/site), from docs/, the pages
# of the exporters and the program's help of its options; a figure of `export page` turns in it. A dead link fails. The
# site fetches nothing from elsewhere.
#
# MENISCUS names the program (build/release/meniscus, else build/test/meniscus). MkDocs Material comes from PyPI, and so does
# axe-core. With --look Chromium opens pages in two widths: axe-core must find no violation. Pictures: build/manual/look.
set -euo pipefail
cd "$(dirname "$0")/.."
look=
[[ ${1:-} == --look ]] && { look=yes; shift; }
program=${MENISCUS:-build/release/meniscus}
[[ -x $program ]] || program=build/test/meniscus
work=$PWD/build/manual
site=$(realpath -m "${1:-$work/site}")

mkdir -p "$work"
[[ -f $work/venv/complete ]] || {
  python3 -m venv --clear "$work/venv"
  "$work/venv/bin/pip" install --quiet mkdocs-material==9.8.2
  "$work/venv/bin/pip" install --quiet --no-deps axe-playwright-python==0.1.8  # contains axe-core 4.12
  touch "$work/venv/complete"
}
python3 scripts/manual.py "$program" "$work"
# --quiet would hide warnings from --strict, too.
NO_MKDOCS_2_WARNING=1 "$work/venv/bin/mkdocs" build --strict --config-file "$work/mkdocs.yml" --site-dir "$site" >"$work/log" 2>&1 ||
  { cat "$work/log" >&2; exit 1; }
cp "$work"/venv/lib/python3*/site-packages/mkdocs_material-*.dist-info/licenses/LICENSE "$site/assets"
echo "the manual is in $site/index.html"
[[ $look ]] || exit 0

axe=$(echo "$work"/venv/lib/python3*/site-packages/axe_playwright_python/axe.min.js)
/usr/bin/python3 -B tests/docs/look_at_manual.py "$site" "$axe" "$work/look"
