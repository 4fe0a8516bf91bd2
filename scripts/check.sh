#!/usr/bin/env bash
# Builds and runs what a change of files or folders can break first: in less than three minutes, on two cores, when all
# but the change is built.
#
#   scripts/check.sh [--list] PATH...     core/surface, core/surface/trim.cpp, app/farm, tests/image ...
#
# It runs the tests of the same folder in tests/unit; test programs that include the file's header, if ninja knows only a
# few; the tests that the table below lists for the area; and the tests of the code's form. Tests that have not ended
# after 170 seconds are stopped and named. --list only prints the tests. This is for the work on a change;
# scripts/test.sh runs everything.
set -euo pipefail
cd "$(dirname "$0")/.."

build=${MENISCUS_BUILD:-$PWD/build/test}
seconds=170
few=5

# Columns: beginning of a path | test programs | tests of ctest that are scripts.
areas=(
  "core/text|structure_test volume_test|"
  "core/structure|color_test shapes_test|"
  "core/math|reduced_surface_test surface_test property_test|"
  "core/reduced_surface|surface_test property_test|"
  "core/surface|property_test|"
  "core/queries|property_test|"
  "core/gpu|gpu_core_test kernel_parameters_test|"
  "core/render|picture_test|"
  "core/image|image_output_test|LegendColors"
  "core/color|picture_test|LegendColors"
  "core/visible_surface|view_pipeline_test|"
  "core/trajectory|trajectory_test frames_test|"
  "core/scene|frames_test picture_test|"
  "core/properties||OptionUse|Help"
  "gpu_shaders|math_test kernel_parameters_test gpu_core_test picture_test|"
  "gpu_shaders/geometry|surface_test ray_geometry_gpu_test|"
  "app/options|cli_test|OptionUse|Help"
  "app/bench|property_test|"
  "app/commands|cli_test|Help"
  "app/reports|cli_test|"
  "app/process|memory_size_test freed_memory_test fault_test|PreviewServer.Files"
  "app/film|film_check_test fault_test|"
  "app/farm|farm_parts_test|Farm.bundle|Farm.work"
  "app/msms||Msms_contract"
  "app/preview|preview_session_test session_figure_test camera_motion_test|"
  "app/preview/server||PreviewServer.Strangers|PreviewServer.Files"
  "exporters/mesh_files|mesh_files_test|"
  "exporters/povray|povray_test|"
  "exporters/bindings|c_api_test cpp_api_test|LibrarySymbols"
)

only_list=
[[ ${1:-} == --list ]] && { only_list=yes; shift; }
if (($# == 0)) || [[ $1 == -* ]]; then
  sed -n '2,11s/^# \{0,1\}//p' "$0"
  exit 2
fi
[[ -f $build/build.ninja ]] || cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DMENISCUS_TESTS=ON >/dev/null
targets=$(ninja -C "$build" -t targets all)

# programs_of PATTERN: prints test programs with an object whose path below tests/ matches, as in image/golden_test.cpp.
programs_of() {
  sed -nE 's|^tests/((.+)/)?CMakeFiles/([^/]+)\.dir/(.+)\.o: .*|\2/\4 \3|p' <<<"$targets" |
    awk -v pattern="^$1" '$1 ~ pattern {print $2}' | sort -u |
    while read -r name; do grep -qE "^tests/.*/$name: CXX_EXECUTABLE" <<<"$targets" && echo "$name" || true; done
}

# users_of HEADER: prints test programs with a source that includes it, directly or not.
users_of() {
  ninja -C "$build" -t deps 2>/dev/null |
    awk -v header="$PWD/$1" -v short="/$1" '
      /^[^ ].*: #deps/ {object = $1}
      index($1, short) && (substr($1, length($1) - length(short) + 1) == short) && object ~ /^tests\// {
        sub(/.*CMakeFiles\//, "", object); sub(/\.dir\/.*/, "", object); print object}' | sort -u |
    while read -r name; do grep -qE "^tests/.*/$name: CXX_EXECUTABLE" <<<"$targets" && echo "$name" || true; done
}

programs=()
scripts=(IncludeGraph UnitFolders Mutation.EveryFaultStillApplies)
for path in "$@"; do
  path=$(realpath --relative-to=. "$path")
  [[ -e $path ]] || { echo "check.sh: there is no $path" >&2; exit 2; }
  folder=$path
  [[ -d $path ]] || folder=$(dirname "$path")
  case $path in
    core/*) mapfile -t -O ${#programs[@]} programs < <(programs_of "unit/${folder#core/}/") ;;
    tests/*) mapfile -t -O ${#programs[@]} programs < <(programs_of "${path#tests/}") ;;
  esac
  header=${path%.*}.h
  if [[ -f $path && -f $header ]]; then
    mapfile -t users < <(users_of "$header")
    ((${#users[@]} <= few)) && programs+=("${users[@]}")
  fi
  for row in "${areas[@]}"; do
    IFS='|' read -r area names more <<<"$row"
    [[ $path/ == "$area"/* ]] || continue
    read -r -a names <<<"$names"
    programs+=("${names[@]}")
    [[ -z $more ]] || scripts+=("$more")
  done
done
mapfile -t programs < <(printf '%s\n' "${programs[@]}" | grep . | sort -u)
pattern=$(IFS='|'; echo "^(${scripts[*]})\$")
echo "programs: ${programs[*]:-none}"
echo "scripts:  $(IFS=' '; echo "${scripts[*]}")"
[[ -z $only_list ]] || exit 0

needed=("${programs[@]}")
((${#scripts[@]} == 3)) || needed+=(meniscus meniscus_c meniscus_msms)
cmake --build "$build" --target "${needed[@]:-meniscus}"
echo "built in $SECONDS s"

# run NAME COMMAND...: runs a command, and prints its output only if it fails.
end=$((SECONDS + seconds))
run() {
  local name=$1 begin=$SECONDS code=0 said
  shift
  said=$(timeout $((end > SECONDS ? end - SECONDS : 1)) "$@" 2>&1) || code=$?
  ((code == 0)) && { printf '%-28s %3s s\n' "$name" $((SECONDS - begin)); return; }
  ((code == 124)) && said="not at its end after $((SECONDS - begin)) s"
  printf '%-28s FAILED\n%s\n' "$name" "$(tail -n 40 <<<"$said")"
  return 1
}

failed=0
begun=()
for name in "${programs[@]}"; do
  file=$(sed -nE "s|^(tests/.*/$name): CXX_EXECUTABLE.*|\1|p" <<<"$targets")
  while (($(jobs -rp | wc -l) >= $(nproc))); do wait -n || failed=1; done
  run "$name" "$build/$file" --gtest_brief=1 &
  begun+=($!)
done
for job in "${begun[@]}"; do wait "$job" || failed=1; done
run scripts ctest --test-dir "$build" -R "$pattern" --output-on-failure -j "$(nproc)" || failed=1
((failed)) && echo "something failed; $SECONDS s in all" || echo "all is well; $SECONDS s in all"
exit $failed
