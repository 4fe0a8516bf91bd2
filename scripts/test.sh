#!/usr/bin/env bash
# Installs what the tests need, builds everything and runs all tests. Safe to run again; options go to ctest.
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/packages.sh

step() { printf '\n== %s (%s s)\n' "$1" "$SECONDS"; }

step "1/3 packages"
install_packages "${build_packages[@]}" "${run_packages[@]}" "${film_packages[@]}" "${sample_packages[@]}" \
  "${test_packages[@]}"

step "2/3 build"
build=${MENISCUS_BUILD:-build/test}
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DMENISCUS_TESTS=ON >/dev/null
cmake --build "$build"

step "3/3 tests"
ctest --test-dir "$build" --output-on-failure --timeout 600 -j "$(nproc)" "$@"
step "all tests passed"
