#!/usr/bin/env bash
# figures_beside_pymol.sh [MENISCUS] [FOLDER]: the figures of docs/how-to/figures.md and later ones by Meniscus and by PyMOL as Debian ships
# it, each with one script a program, the same view, size, background and two cores. Prints a table in Markdown and leaves
# pictures, scripts and contact sheets in FOLDER. MENISCUS is build/release/meniscus if it is not named. Structures that Debian
# does not ship are fetched from the PDB, or taken from the folder that MENISCUS_STRUCTURES names.
set -euo pipefail
cd "$(dirname "$0")/../.."
source scripts/packages.sh
program=${1:-build/release/meniscus}
folder=${2:-figures}
[[ -x $program ]] || { echo "figures_beside_pymol: $program is no program; build it, or name one" >&2; exit 2; }
install_packages "${peer_packages[@]}" >&2
# Debian's PyMOL starts the first python3 it finds, and needs Debian's.
exec env PATH=/usr/bin:/bin taskset -c 0,1 /usr/bin/python3 scripts/measure/figures_beside_pymol.py "$program" "$folder"
