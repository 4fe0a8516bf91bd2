#!/usr/bin/env bash
# Runs scripts/quickstart.sh in a bare Debian, and then some tests that need little there. Needs root and mmdebstrap.
#
#   scripts/package/try_quickstart.sh [BARE.tar]
#
# MENISCUS_SUITE names the release: trixie, which is Debian 13, by default. BARE.tar is a bare system made before. The last
# line says `cases N failures M`.
set -euo pipefail
cd "$(dirname "$0")/../.."
MENISCUS_SUITE=${MENISCUS_SUITE:-trixie}
source scripts/package/bare.sh
enter_bare "${1:-}"
copy_tree
tests="base_test math_test structure_test surface_test reduced_surface_test mesh_test"

check "quickstart" bash meniscus/scripts/quickstart.sh
check "the pictures" ls quickstart/{1tii_chains.png,1tii_blender.png,povray/surface.png}
check "packages of the tests" $install libgtest-dev libbenchmark-dev glslang-tools spirv-tools libvulkan-dev freesasa
check "configures" cmake -S meniscus -B tests -G Ninja -DCMAKE_BUILD_TYPE=Release -DMENISCUS_TESTS=ON
check "builds" cmake --build tests --target $tests
check "runs" "ctest --test-dir tests -L unit -E NOT_BUILT -j \$(nproc) | grep '100% tests passed'"
echo "cases $cases failures $failures"
((failures == 0))
