#!/usr/bin/env bash
# Mesh files in programs that are large or not Debian's: PrusaSlicer, VTK, and Khronos' glTF validator of npm below
# build/gltf-validator. Three proteins, each at a tolerance and at a density, some by chain. The last line says
# "cases N failures M".
#
#   scripts/more_mesh_readers.sh PROGRAM
set -euo pipefail
cd "$(dirname "$0")/.."
program=$(realpath "${1:?usage: scripts/more_mesh_readers.sh PROGRAM}")
validator=$PWD/build/gltf-validator
# Not a package that scripts/packages.sh asks for: Debian's npm cannot stand beside other builds of node.
command -v npm >/dev/null || { echo "more_mesh_readers.sh: npm is not installed; it brings the validator" >&2; exit 1; }
mkdir -p "$validator"
[[ -d $validator/node_modules/gltf-validator ]] ||
  npm install --silent --no-audit --no-fund --prefix "$validator" gltf-validator@2.0.0-dev.3.10
exec env NODE_PATH="$validator/node_modules" /usr/bin/python3 -B tests/export/mesh/more_readers.py "$program"
