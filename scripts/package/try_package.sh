#!/usr/bin/env bash
# Installs the Debian packages into a bare Debian 12 and uses them there: Python computes with the library, a C and a C++
# program are compiled against its headers, through pkg-config and CMake, the program computes, draws by software GL and
# has its manual and completion, and all say the same numbers; then takes everything away again. As root, with mmdebstrap.
#
#   scripts/package/try_package.sh [FOLDER [BARE.tar]]
#
# Without a folder of packages they are made from build/test; BARE.tar is a bare system made before (mmdebstrap
# --variant=minbase bookworm BARE.tar). The last line says `cases N failures M`.
set -euo pipefail
cd "$(dirname "$0")/../.."
source scripts/package/bare.sh
take_packages "${1:-}"
enter_bare "${2:-}"

# The script that runs in /root of the bare system.
mkdir -p "$home/c" "$home/cpp"
for package in meniscus libmeniscus0 libmeniscus-dev python3-meniscus meniscus-doc; do
  cp "$packages/$package"_*.deb "$home/$package.deb"
done
cp "$(dpkg -L pymol-data | awk '/\/1tii\.pdb$/ && !n++')" "$home/1tii.pdb"
cp exporters/bindings/c/example/* "$home/c/"
awk '/^```cpp$/ { on = 1; next } /^```$/ { on = 0 } on' docs/reference/library.md >"$home/cpp/balls.cpp"
cat >"$home/cpp/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.16)
project(balls LANGUAGES CXX)
find_package(Meniscus 0.3 REQUIRED)
add_executable(balls balls.cpp)
target_link_libraries(balls PRIVATE Meniscus::cpp)
CMAKE
# This script reads a molecule, computes it, and leaves its atoms and measures for the others.
cat >"$home/compute.py" <<'PYTHON'
import meniscus
import numpy as np

atoms = [line for line in open("/root/1tii.pdb") if line.startswith("ATOM")]
xyz = np.array([[float(line[30:38]), float(line[38:46]), float(line[46:54])] for line in atoms])
radii = meniscus.radii_of([line[76:78].strip() or line[12:16].strip(" 0123456789")[0] for line in atoms])
surface = meniscus.surface(xyz, radii)
np.savetxt("/root/atoms.xyzr", np.column_stack([xyz, radii]), fmt="%.17g")
print(f"area {surface.area:.17g}, volume {surface.volume:.17g}", file=open("/root/measures", "w"))
assert abs(surface.atom_areas.sum() - surface.area) < 1e-6 * surface.area
print(f"{len(atoms)} atoms, {surface.area} Å^2, {surface.volume} Å^3, libmeniscus {meniscus.version()} in "
      + meniscus.library_path())
PYTHON

same_numbers='grep -F "$(cat measures)"'

check "lists of packages" apt-get update
check "the library installs with what it depends on" $install ./libmeniscus0.deb
check "the Python package, too" $install ./python3-meniscus.deb
check "Python computes, without GL" '! ldconfig -p | grep -E "libEGL|libGL\." && python3 compute.py'
check "the headers, and compilers" $install ./libmeniscus-dev.deb gcc g++ make cmake pkg-config
check "C by pkg-config" 'cc -std=c99 c/areas.c $(pkg-config --cflags --libs meniscus) -o areas'
check "it says what Python says" "./areas < atoms.xyzr | $same_numbers"
check "C by find_package" 'cmake -S c -B c/build && cmake --build c/build'
check "it says what Python says" "c/build/areas < atoms.xyzr | $same_numbers"
check "C++ by pkg-config" 'c++ -std=c++20 cpp/balls.cpp $(pkg-config --cflags --libs meniscus) -o balls && ./balls | head -n 1'
check "C++ by find_package" 'cmake -S cpp -B cpp/build && cmake --build cpp/build && cpp/build/balls | cmp - <(./balls)'
check "the program installs with what it depends on" $install ./meniscus.deb
check "version" meniscus --version
check "surface on the CPU" meniscus surface 1tii.pdb --device cpu
check "it says what the library says" 'meniscus surface -q --device cpu --json atoms.xyzr | python3 -c "
import json, sys
told = json.load(sys.stdin)
print(\"area {area:.17g}, volume {volume:.17g}\".format(**told))" | cmp - measures'
check "help of a command" meniscus render --help
check "manual" test -s /usr/share/man/man1/meniscus-render.1.gz
check "the manual's pages" "$install ./meniscus-doc.deb && ls /usr/share/doc/meniscus/*/index.*"
check "completion" 'source /usr/share/bash-completion/completions/meniscus && complete -p meniscus'
check "installs software GL" $install libegl-mesa0 libgl1-mesa-dri
check "picture by software GL" meniscus render 1tii.pdb -o 1tii.png --size 320x240 --device software
check "the picture is one" 'head -c 4 1tii.png | tail -c 3 | grep PNG'
check "Python draws" "python3 -c 'import meniscus
s = meniscus.surface([[0, 0, 0]], [2.0])
print(s.render(size=\"40x30\").pixels.shape, s.render(size=\"40x30\").png()[1:4])'"
check "versions" meniscus --version --verbose
check "files are as they were packed" dpkg -V meniscus libmeniscus0 libmeniscus-dev python3-meniscus meniscus-doc
check "goes away again" apt-get purge -y meniscus libmeniscus0 libmeniscus-dev python3-meniscus meniscus-doc
check "leaves nothing behind" '! find /usr -name "*meniscus*" | grep .'
echo "cases $cases failures $failures"
((failures == 0))
