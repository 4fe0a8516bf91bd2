#!/usr/bin/env bash
# Runs the long proofs and prints one table: name, cases, failures, seconds.
#
#   scripts/prove.sh [--seconds N] [--cases N] [--limit MINUTES] [--list] [NAME...]
#
# Without names all rows, one after another: some hours on two cores. --seconds is how long each fuzz target runs (300),
# --cases how many molecules each family of the generators gives (10000), --limit how long a row may take (180 minutes).
# The output of a row is in build/prove/NAME.log. Exit code 1 if a row failed, or did not report success.
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/packages.sh

seconds=300
cases=10000
limit=180
list=
names=()
while (($#)); do
  case $1 in
    --seconds | --cases | --limit)
      [[ ${2:-} =~ ^[1-9][0-9]*$ ]] || { echo "prove.sh: $1 needs a whole number above 0, not '${2:-}'" >&2; exit 2; }
      printf -v "${1#--}" %s "$2"
      shift
      ;;
    --list) list=yes ;;
    -h | --help) sed -n '2,9s/^# \{0,1\}//p' "$0"; exit ;;
    -*) echo "prove.sh: unknown option $1" >&2; exit 2 ;;
    *) names+=("$1") ;;
  esac
  shift
done
jobs=$(nproc)
export MENISCUS_JOBS=$jobs

[[ $list ]] || install_packages "${build_packages[@]}" "${run_packages[@]}" "${film_packages[@]}" "${sample_packages[@]}" \
  "${test_packages[@]}" "${check_packages[@]}" "${prove_packages[@]}"

# This is a second GL driver: zink on lavapipe, also software, but with another compiler and another arithmetic.
zink="env LIBGL_ALWAYS_SOFTWARE=1 MESA_LOADER_DRIVER_OVERRIDE=zink VK_ICD_FILENAMES=$(
  compgen -G '/usr/share/vulkan/icd.d/lvp_icd*.json' | head -n 1 || true)"
proteins="/usr/share/freesasa/test-data/1ubq.pdb $(dpkg -L pymol-data 2>/dev/null | awk '/\/1tii\.pdb$/ && !n++' || true)"

# Columns: name | proof | command, whose last line "cases N failures M", or that of ctest, counts.
rows=(
  "tests|every test, as released|ctest --test-dir build/test --timeout 900 -j $jobs"
  "sanitizers|every test, renderers too, with asserts, ASan and UBSan|ctest --preset asan-all --timeout 1800 -j $jobs"
  "tidy|clang-tidy and its analyzer over every file|bash scripts/lint.sh --all"
  "fuzz|each reader and parser, $seconds s of libFuzzer a target (executions)|bash scripts/fuzz.sh $seconds"
  "families|balls made to tie, rotated and jittered, against an oracle|build/test/tests/prove/prove_surfaces $cases"
  "views|views against complete pictures, bit for bit|build/test/tests/view/view_equality $proteins --probes 0.7 1.4 3 10 --outside 200 --inside 50"
  "dropped|a GPU that drops work, runs out of memory, is reset, at every call|ctest --test-dir build/test -R LostWork|StoppingGpu"
  "poisoned|fresh buffers full of any word|ctest --test-dir build/test -R FreshBuffers"
  "inexact|less exact shader arithmetic, with a control that must fail|ctest --test-dir build/test -R InexactGpu"
  "zink|tests of GPU and pictures on a second GL driver|$zink ctest --test-dir build/test -L gpu|image -E SecondDriver --timeout 900 -j $jobs"
  "python|the wheel in a fresh environment, with other packages from PyPI|bash scripts/package/test_wheel.sh"
  "notebooks|pages and widgets in a real JupyterLab, views of MolViewSpec in Mol*, figures by hand in the preview, from PyPI and npm|bash scripts/check/notebooks.sh build/test"
  "blenders|the Blender add-on in Blender 4.2 to 5.3, with Molecular Nodes up to 5.0, from PyPI|bash scripts/check/newer_blenders.sh build/test/meniscus"
  "schedulers|files of docs/reference/schedulers.md in HTCondor's, Kubernetes', AWS' and OpenJD's own code, and in Nextflow|bash scripts/check/schedulers.sh build/test/meniscus"
  "meshes|PyPI's PyMOL and PyVOL; mesh files in OpenUSD, PrusaSlicer, VTK and Khronos' glTF validator|bash scripts/check/more_mesh_readers.sh build/test/meniscus"
  "renderers|scenes for path tracers in Mitsuba 3 itself, from PyPI, beside the ray caster|bash scripts/check/film_renderers.sh build/test/meniscus"
  "faults|calls that fail, full disks, kills, other writers|ctest --test-dir build/test -L fault --timeout 1800 -j $jobs"
  "ligands|how much of the ligands of Debian's complexes is seen behind a cut that finds itself|/usr/bin/python3 tests/image/seen_ligands.py build/test/meniscus"
  "packages|the Debian packages in a bare Debian 12: installed, used, taken away|bash scripts/package/try_package.sh"
  "targets|the library for Linux, Windows and macOS, and the same results of all that run here|bash scripts/package/targets.sh"
  "alone|the library alone, built and used in a bare Debian 12 with its three dependencies|bash scripts/package/try_library.sh"
  "trixie|the same in a bare Debian 13|MENISCUS_SUITE=trixie bash scripts/package/try_library.sh"
  "quickstart|quickstart.sh and tests of core in a bare Debian 13|bash scripts/package/try_quickstart.sh"
  "manual|the manual as a site: dead links, search, and axe-core in Chromium at two widths|bash scripts/manual.sh --look"
  "image|the image of a farm node, built and at work on a film|bash scripts/package/try_image.sh"
  "exporter|an exporter is added as a folder and a command, and help, completion, manual and scenes follow|bash scripts/check/add_exporter.sh"
  "option|an option is added in three files, and works through every door|bash scripts/check/add_option.sh"
  "includes|every file without precompiled headers|bash scripts/check/includes.sh"
  "mutations|planted faults that the tests must find|/usr/bin/python3 scripts/check/mutate.py --jobs $jobs"
)

# one_of WORD WORDS...: succeeds if the first word is among the others.
one_of() {
  local word
  for word in "${@:2}"; do [[ $word == "$1" ]] && return; done
  return 1
}
for name in "${names[@]}"; do
  one_of "$name" "${rows[@]%%|*}" || { echo "prove.sh: there is no row $name; see --list" >&2; exit 2; }
done
chosen() { ((${#names[@]} == 0)) || one_of "$1" "${names[@]}"; }

# split ROW: sets name, what, command; only the first two bars separate them.
split() {
  name=${1%%|*}
  local rest=${1#*|}
  what=${rest%%|*}
  command=${rest#*|}
}

if [[ $list ]]; then
  for row in "${rows[@]}"; do
    split "$row"
    printf '%-11s %s\n' "$name" "$what"
  done
  exit
fi

logs=$PWD/build/prove
mkdir -p "$logs"

# Everything is built before the clock of any row runs.
build() { "$@" >"$logs/build.log" 2>&1 || { tail -n 30 "$logs/build.log" >&2; echo "failed: $*" >&2; exit 1; }; }
build cmake -S . -B build/test -G Ninja -DCMAKE_BUILD_TYPE=Release -DMENISCUS_TESTS=ON
build cmake --build build/test --target all view_equality
if chosen sanitizers; then
  build cmake --preset asan
  build cmake --build --preset asan-all
fi

# counted LOG: prints "CASES FAILURES" of its last line with numbers; nothing if there is none.
counted() {
  sed -nE -e 's/^cases ([0-9]+) failures ([0-9]+)$/\1 \2/p' \
    -e 's/^[0-9]+% tests passed, ([0-9]+) tests? failed out of ([0-9]+)$/\2 \1/p' "$1" | tail -n 1
}

printf '%-11s %12s %9s %8s  %s\n' name cases failures seconds what
bad=()
for row in "${rows[@]}"; do
  split "$row"
  chosen "$name" || continue
  log=$logs/$name.log
  began=$SECONDS
  status=0
  # The words of the command are not expanded again.
  read -ra words <<<"$command"
  timeout --kill-after=30 "${limit}m" "${words[@]}" >"$log" 2>&1 </dev/null || status=$?
  read -r tried failures <<<"$(counted "$log")" || true
  remark=
  if ((status == 124)); then remark="; out of time"
  elif [[ -z $tried ]]; then remark="; did not say what it tried, exit code $status"
  elif ((tried == 0)); then remark="; tried nothing"
  elif ((status != 0 && failures == 0)); then remark="; exit code $status"
  fi
  skipped=$(grep -cE '^\s+[0-9]+ - .* \((Skipped|Disabled)\)$' "$log" || true)
  ((skipped == 0)) || what+=" ($skipped could not run)"
  printf '%-11s %12s %9s %8d  %s\n' "$name" "${tried:--}" "${failures:--}" $((SECONDS - began)) "$what$remark"
  if [[ $remark ]] || ((failures > 0)); then bad+=("$name"); fi
done

if ((${#bad[@]})); then
  echo "failed: ${bad[*]}; see $logs"
  exit 1
fi
echo "nothing failed"
