#!/usr/bin/env bash
# Installs what Meniscus needs, builds it, makes a picture of 1TII, and then the same view by ray casting, by POV-Ray
# and by Blender from our exports. Safe to run again. Results are in quickstart/ below the current folder.
set -euo pipefail
here=$(cd "$(dirname "$0")/.." && pwd)
source "$here/scripts/packages.sh"

size=${MENISCUS_QUICKSTART_SIZE:-800x640}
out=$PWD/quickstart
step() { printf '\n== %s (%s s)\n' "$1" "$SECONDS"; }

step "1/5 packages"
to_build=("${build_packages[@]}" "${run_packages[@]}")
others=("${film_packages[@]}" "${sample_packages[@]}" "${compare_packages[@]}")
((EUID == 0)) || install_packages "${to_build[@]}" "${others[@]}"  # reports all that are missing
install_packages "${to_build[@]}"

step "2/5 build, and beside it the packages of the other programs"
build=${MENISCUS_BUILD:-$here/build/release}
log=$out/build.log
mkdir -p "$out"
echo "this takes minutes; its words go to $log"
{
  cmake -S "$here" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DMENISCUS_TESTS=OFF &&
    cmake --build "$build" --target meniscus
} >"$log" 2>&1 &
building=$!
install_packages "${others[@]}"
wait "$building" || {
  tail -n 20 "$log" >&2
  echo "the build failed; its whole log: $log" >&2
  exit 1
}
meniscus=$build/meniscus

molecule=$(dpkg -L pymol-data | awk '/\/1tii\.pdb$/ && !n++')
[[ $molecule ]] || {
  echo "the package pymol-data has no 1tii.pdb; give another file to $meniscus" >&2
  exit 1
}

step "3/5 a picture"
"$meniscus" render "$molecule" -o "$out/1tii_chains.png" --size "$size" --background white --force
echo "look at it: $out/1tii_chains.png"

step "4/5 the same surface here, in POV-Ray and in Blender"
"$meniscus" surface "$molecule" --json >"$out/1tii.json"
"$meniscus" render "$molecule" -o "$out/1tii.png" --size "$size" --background white --save-camera "$out/camera.json" --force
"$meniscus" render "$molecule" -o "$out/1tii.exr" --size "$size" --samples 1 --aovs --camera "$out/camera.json" --force --quiet

"$meniscus" export povray "$molecule" -o "$out/povray" --size "$size" --camera "$out/camera.json" --force
(cd "$out/povray" && povray surface.ini -GA && povray "surface.ini[normal]" -GA) 2>"$out/povray.log" || {
  tail -n 20 "$out/povray.log" >&2
  echo "POV-Ray failed; its whole log: $out/povray.log" >&2
  exit 1
}

"$meniscus" export blender "$molecule" -o "$out/1tii.mns" --size "$size" --camera "$out/camera.json" --tolerance 0.01 --force
blender -b --factory-startup --python-exit-code 3 --python "$here/exporters/blender/addon/render_mns.py" -- \
  "$out/1tii.mns" --output "$out/1tii_blender.png" --passes "$out/1tii_blender.exr" --size "$size" --samples 16 --transparent \
  >"$out/blender.log" 2>&1 || {
  tail -n 20 "$out/blender.log" >&2
  echo "Blender failed; its whole log: $out/blender.log" >&2
  exit 1
}

step "5/5 compare the three"
/usr/bin/python3 "$here/scripts/check/compare_pictures.py" "$out/1tii.exr" "$out/povray/surface_normal.png" \
  "$out/1tii_blender.exr"
echo "pictures: $out/1tii_chains.png $out/1tii.png $out/povray/surface.png $out/1tii_blender.png"

cat <<EOF

Now your own molecule:
  $meniscus my.pdb                                           # a picture: my.png
  $meniscus preview my.pdb                                   # opens a browser; --no-open: prints the address
  $meniscus render my.pdb -o pocket.png --look-into ligand   # meniscus render --help has all
EOF
