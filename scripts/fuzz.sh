#!/usr/bin/env bash
# Fuzzes the readers: scripts/fuzz.sh SECONDS [TARGET...] (names of tests/fuzz/targets, and mns). Every target runs for
# that time, as many at once as there are cores (or MENISCUS_JOBS). New inputs that fail are minimized and kept in
# tests/fuzz/crashes/TARGET, where the tests replay them.
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/packages.sh

if (($# == 0)) || ! [[ $1 =~ ^[1-9][0-9]*$ ]]; then
  echo "usage: scripts/fuzz.sh SECONDS [TARGET...]; targets: tests/fuzz/targets" >&2
  exit 2
fi
seconds=$1
shift
targets=("$@")
if ((${#targets[@]} == 0)); then
  for file in tests/fuzz/targets/*.cpp; do targets+=("$(basename "$file" .cpp)"); done
  targets+=(mns)
fi
built=()
for target in "${targets[@]}"; do
  [[ $target == mns ]] && continue
  built+=("fuzz_$target")
  [[ -f tests/fuzz/targets/$target.cpp ]] || { echo "there is no target $target in tests/fuzz/targets" >&2; exit 2; }
done
jobs=${MENISCUS_JOBS:-$(nproc)}

install_packages "${build_packages[@]}" "${fuzz_packages[@]}"
if ((${#built[@]} > 0)); then
  cmake --preset fuzz >/dev/null
  cmake --build build/fuzz -j "$jobs" --target "${built[@]}" >&2
fi

# The files are in memory if possible: targets write a file per execution, and would mostly wait for a disk.
base=/dev/shm
[[ -d $base && -w $base ]] || base=${TMPDIR:-/tmp}
work=$(mktemp -d -p "$base")
trap 'rm -rf "$work"' EXIT
export TMPDIR=$work
# Requests for more than 1,000 MB are refused: C libraries then return an error as on a machine without memory, while a
# request of C++, which our own code uses, ends the run.
export ASAN_OPTIONS=allocator_may_return_null=1:max_allocation_size_mb=1000:detect_leaks=1
export UBSAN_OPTIONS=print_stacktrace=1
limits=(-timeout=5 -rss_limit_mb=2048 -malloc_limit_mb=1024)

# fuzz_one TARGET: writes its line to $work/TARGET.line. Starts from the seeds and from inputs that ever failed.
fuzz_one() {
  local target=$1 program=build/fuzz/tests/fuzz/fuzz_$1 corpus=$work/$1.corpus found=$work/$1.found log=$work/$1.log
  local kept=tests/fuzz/crashes/$1 inputs=(tests/fuzz/seeds/"$1") options=() failures=0
  mkdir -p "$corpus" "$found"
  [[ -d $kept ]] && inputs+=("$kept")
  # HDF5 itself leaks the header of an object that it cannot read; its target counts open objects instead.
  [[ $target != h5md ]] || export ASAN_OPTIONS=$ASAN_OPTIONS:detect_leaks=0
  [[ -f tests/fuzz/dictionaries/$target.dict ]] && options+=(-dict=tests/fuzz/dictionaries/"$target".dict)
  local status=0
  "$program" "${limits[@]}" "${options[@]}" -max_len=16384 -max_total_time="$seconds" -print_final_stats=1 -verbosity=0 \
    -artifact_prefix="$found/" "$corpus" "${inputs[@]}" >"$log" 2>&1 || status=$?
  for input in "$found"/*; do
    [[ -f $input ]] || continue
    failures=$((failures + 1))
    mkdir -p "$kept"
    local small=$kept/$(basename "$input")
    "$program" "${limits[@]}" -minimize_crash=1 -max_total_time=30 -exact_artifact_path="$small" "$input" \
      >"$log.minimize" 2>&1 || true
    [[ -s $small ]] || cp "$input" "$small"
  done
  # A target that ended for another reason, or that executed nothing, has proved nothing.
  local executions rate
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  rate=$(sed -n 's/^stat::average_exec_per_sec: *//p' "$log")
  ((failures > 0)) || { ((status == 0 && ${executions:-0} > 0)) || failures=1; }
  ((failures == 0)) || grep -m 3 -E 'ERROR:|runtime error:|SUMMARY:|does not hold|libFuzzer:' "$log" >"$work/$target.why" || true
  printf '%s %s %s %s\n' "$target" "${executions:-0}" "${rate:-0}" "$failures" >"$work/$target.line"
}

printf '%-18s %12s %8s %12s\n' target executions exec/s 'new crashes'
cases=0
failures=0
# mutate_mns: writes a line for the readers of the Blender add-on, which are Python: cases by a seed, 300 per second.
mutate_mns() {
  local log=$work/mns.log begin=$SECONDS last
  /usr/bin/python3 tests/fuzz/mns_mutation_test.py exporters/blender/addon $((300 * seconds)) "$RANDOM" >"$log" 2>&1 || true
  last=$(tail -n 1 "$log")
  if [[ $last =~ ^cases\ ([0-9]+)\ failures\ ([0-9]+)$ ]]; then
    echo "mns ${BASH_REMATCH[1]} $((BASH_REMATCH[1] / (SECONDS - begin + 1))) ${BASH_REMATCH[2]}" >"$work/mns.line"
  else
    echo "mns 0 0 1" >"$work/mns.line"
  fi
  grep -m 3 -E 'Error|case ' "$log" >"$work/mns.why" || rm -f "$work/mns.why"
}

next=0
running=()
while ((next < ${#targets[@]})) || ((${#running[@]} > 0)); do
  if ((next < ${#targets[@]})) && ((${#running[@]} < jobs)); then
    target=${targets[next]}
    next=$((next + 1))
    if [[ $target == mns ]]; then mutate_mns & else fuzz_one "$target" & fi
    running+=("$!:$target")
    continue
  fi
  first=${running[0]}
  running=("${running[@]:1}")
  wait "${first%%:*}" || true
  read -r target executions rate crashes <"$work/${first#*:}.line" ||
    { target=${first#*:} executions=0 rate=0 crashes=1; }
  printf '%-18s %12d %8d %12d\n' "$target" "$executions" "$rate" "$crashes"
  [[ -f $work/$target.why ]] && sed 's/^/    /' "$work/$target.why"
  cases=$((cases + executions))
  failures=$((failures + crashes))
done
echo "cases $cases failures $failures"
((failures == 0))
