#!/usr/bin/env bash
# Builds the wheel, installs it into a fresh virtual environment together with the newest packages of PyPI that it
# supports, and runs its tests there, outside the tree. The last line has the number of cases.
set -euo pipefail
cd "$(dirname "$0")/../.."
export CMAKE_BUILD_PARALLEL_LEVEL=${MENISCUS_JOBS:-$(nproc)}
tests=$PWD/tests/python
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

python3 -m venv "$folder/venv"
python=$folder/venv/bin/python
"$python" -m pip install -q --disable-pip-version-check --upgrade pip
"$python" -m pip wheel -q --no-deps -w "$folder/dist" .
ls -l "$folder/dist"
packages=(MDAnalysis mdtraj prody biotite biopython ase rdkit openmm gemmi pint astropy unyt joblib dask trimesh pyvista open3d)
"$python" -m pip install -q "$folder"/dist/meniscus_ses-*.whl "${packages[@]}" anywidget mypy pyright
MENISCUS_PACKAGE=$PWD/exporters/bindings/python "$python" -B "$tests/types_test.py" mypy pyright
cd "$folder"
unset MENISCUS_LIBRARY MENISCUS_PACKAGE
"$python" -c 'import meniscus; print("libmeniscus", meniscus.version(), meniscus.library_path())'
"$python" -B "$tests/package_test.py"
"$python" -B "$tests/structure_test.py"
"$python" -B "$tests/python_pages_test.py"
"$python" -B "$tests/examples_test.py" "${packages[@]}" anywidget
"$python" -B "$tests/adapters_test.py" "${packages[@]}"
