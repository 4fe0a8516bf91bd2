#!/usr/bin/env bash
# Installs what the tests need, checks the code's form, builds everything and runs the tests: as released all but those
# labelled "long" (scripts/prove.sh runs these), and the unit, property and trajectory tests with asserts, warnings as
# errors, AddressSanitizer and UBSan. At the end it names what could not run; with CI=true a skip that
# scripts/check/expected_skips.txt does not name is a failure. The code's form and the sanitizers need clang 14, which
# Debian 13 does not have: there these steps are left out, and all skips are allowed.
# Safe to run again; options go to ctest (-R NAME, -L LABEL).
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/packages.sh

step() { printf '\n== %s (%s s)\n' "$1" "$SECONDS"; }
failed=()

step "1/8 packages"
install_packages "${build_packages[@]}" "${run_packages[@]}" "${film_packages[@]}" "${sample_packages[@]}" \
  "${test_packages[@]}" "${compiler_packages[@]}" "${check_packages[@]}"

clang=$(command -v clang++-14) || echo "clang++-14 is not installed: steps 2, 5, 6 and 7 are left out"

step "2/8 format"
[[ ! $clang ]] || bash scripts/format.sh --check || failed+=("format")

step "3/8 build"
build=${MENISCUS_BUILD:-$PWD/build/test}
results=$PWD/build/results
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DMENISCUS_TESTS=ON >/dev/null
cmake --build "$build"
rm -rf "$results"
mkdir -p "$results"

# Tests wait for each other, for screens and for clocks. The next configuration is built in the idle processor time.
step "4/8 tests, and beside them the build with asserts and sanitizers, where warnings are errors"
if [[ $clang ]]; then
  cmake --preset asan >/dev/null
  nice -n 19 cmake --build --preset asan >"$results/sanitized_build.log" 2>&1 &
  sanitized_build=$!
fi
ctest --test-dir "$build" -LE long --output-on-failure --timeout 600 -j "$(nproc)" --output-junit "$results/release.xml" \
  --test-output-size-passed 16384 "$@" || failed+=("tests")

# Blender's tests follow one another, so they run during the next steps.
if [[ $(uname -m) == x86_64 ]]; then  # PyPI has no other platform
  MENISCUS_INSIDE="inside_baked inside_blender inside_handed_on inside_sequence inside_shot" \
    bash scripts/check/newer_blenders.sh "$build/meniscus" newest >"$results/newest_blender.log" 2>&1 &
  newest_blender=$!
fi

if [[ $clang ]]; then
  step "5/8 the rest of that build"
  wait "$sanitized_build" || { tail -n 100 "$results/sanitized_build.log" >&2; exit 1; }

  step "6/8 tests with asserts and sanitizers"
  ctest --preset asan --timeout 600 -j "$(nproc)" --output-junit "$results/sanitized.xml" \
    --test-output-size-passed 16384 "$@" || failed+=("sanitized tests")

  step "7/8 clang-tidy"
  bash scripts/lint.sh || failed+=("clang-tidy")
fi

step "8/8 the add-on in the newest Blender"
if [[ ${newest_blender:-} ]]; then
  wait "$newest_blender" && newest=0 || newest=$?
  cat "$results/newest_blender.log"
  ((newest == 0 || newest == 77)) || failed+=("newest Blender")  # 77: the registry was not reached
fi

step "what was tried"
strict=()
[[ ${CI:-} == true && $clang ]] && strict=(--strict)
/usr/bin/python3 scripts/check/test_summary.py "${strict[@]}" --expected scripts/check/expected_skips.txt \
  "release=$results/release.xml" ${clang:+"sanitized=$results/sanitized.xml"} || failed+=("summary")
if ((${#failed[@]})); then
  echo "failed: ${failed[*]}" >&2
  exit 1
fi
