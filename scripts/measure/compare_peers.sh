#!/usr/bin/env bash
# compare_peers.sh [MENISCUS] [FILE.pdb ...]: compares areas, areas of a trajectory, and pictures with Debian's PyMOL, FreeSASA, gmx sasa and
# MDTraj: the same atoms and radii, the same picture, two cores each, in one run. Prints tables in Markdown. Installs what
# is missing; MENISCUS is build/release/meniscus if it is not named.
set -euo pipefail
cd "$(dirname "$0")/../.."
source scripts/packages.sh
install_packages "${peer_packages[@]}" >&2
program=${1:-build/release/meniscus}
shift || true
[[ -x $program ]] || { echo "compare_peers: $program is no program; build it, or name one" >&2; exit 2; }
# Debian's PyMOL starts the first python3 it finds, and needs Debian's.
exec env PATH=/usr/bin:/bin taskset -c 0,1 /usr/bin/python3 scripts/measure/compare_peers.py "$program" "${@:-/usr/share/pymol/data/demo/1tii.pdb}"
