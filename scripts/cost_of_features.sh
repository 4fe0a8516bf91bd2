#!/usr/bin/env bash
# cost_of_features.sh [MENISCUS] [BEFORE]: what features of figures cost, as instructions of one thread that callgrind counts:
# `render` of 1TII at 320x240 with one sample, without and with each. Prints a table in Markdown. BEFORE: another build, whose
# plain picture stands beside that of MENISCUS, which is build/release/meniscus if it is not named. Takes minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
program=${1:-build/release/meniscus}
before=${2:-}
molecule=/usr/share/pymol/data/demo/1tii.pdb
command -v valgrind >/dev/null || { echo "cost_of_features: valgrind is missing: apt-get install valgrind" >&2; exit 2; }
[[ -x $program ]] || { echo "cost_of_features: $program is no program; build it, or name one" >&2; exit 2; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# A map of 1TII's place: a wave on a grid of 32 points a side.
/usr/bin/python3 - "$folder/map.dx" <<'END'
import math
import sys

with open(sys.argv[1], "w", encoding="ascii") as file:
    file.write("object 1 class gridpositions counts 32 32 32\norigin -60 -60 -60\n")
    file.write("delta 5 0 0\ndelta 0 5 0\ndelta 0 0 5\nobject 2 class gridconnections counts 32 32 32\n")
    file.write("object 3 class array type double rank 0 items 32768 data follows\n")
    for n in range(32768):
        file.write(f"{math.sin(n / 700):.5f}\n")
END

# count PROGRAM OPTION...: millions of instructions.
count() {
  local binary=$1
  shift
  valgrind --tool=callgrind --callgrind-out-file=/dev/null "$binary" render "$molecule" -o "$folder/a.png" --force -q --device cpu \
    --threads 1 --size 320x240 --samples 1 --no-provenance "$@" 2>"$folder/log" || { cat "$folder/log" >&2; exit 1; }
  awk '/Collected/ { printf "%.0f", $NF / 1e6 }' "$folder/log"
}

plain=$(count "$program")
row() {
  local name=$1 millions
  shift
  millions=$(count "$program" "$@")
  awk -v n="$name" -v a="$millions" -v b="$plain" 'BEGIN { printf "| %s | %d | %+.1f %% |\n", n, a, 100 * (a / b - 1) }'
}
echo "| picture of 1TII | million instructions | beside the plain one |"
echo "|---|---|---|"
if [[ -n $before ]]; then
  was=$(count "$before")
  awk -v a="$was" -v b="$plain" 'BEGIN { printf "| plain, by the build before | %d | %+.1f %% |\n", a, 100 * (a / b - 1) }'
fi
echo "| plain | $plain | |"
row '`--sticks`' --sticks 'chain C'
row '`--spheres`' --spheres 'chain C'
row '`--tube`' --tube all
row '`--opacity 0.4`' --opacity 0.4
row '`--opacity 0.4 --film-opacity`' --opacity 0.4 --film-opacity
row '`--clip`' --clip 'depth>0.5'
row '`--clip`, hatched' --clip 'depth>0.5' --cap-hatching 2
row '`--color-map-file`' --color-map-file "$folder/map.dx" --color-range=-1:1
row '`--object`, a surface of chain C more' --object '{"representation": "surface", "selection": "chain C", "color": "red"}'
row '`--interface`' --interface 'D,E,F,G,H:A'
row 'shade and lines' --ambient-occlusion 0.8 --silhouettes 1
row 'shade and lines, `--opacity 0.4`' --ambient-occlusion 0.8 --silhouettes 1 --opacity 0.4
