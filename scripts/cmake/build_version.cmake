# Writes one C++ file with the version of the sources: version, commit and its date, and a checksum of what differs from
# the commit; without git, as from a tarball, a checksum of all sources. The file changes only when the answer does. Run
# as: cmake -DSOURCE=<root of the tree> -DVERSION=<number> -DOUTPUT=<file.cpp> -P build_version.cmake
cmake_minimum_required(VERSION 3.25)
set(compiled app core exporters gpu_shaders scripts/cmake CMakeLists.txt)

# Computes a checksum of files below SOURCE from their paths and contents.
function(checksum_of result)
  set(sums "")
  foreach(path IN LISTS ARGN)
    file(SHA256 "${SOURCE}/${path}" sum)
    string(APPEND sums "${sum} ${path}\n")
  endforeach()
  string(SHA256 all "${sums}")
  string(SUBSTRING ${all} 0 12 all)
  set(${result} ${all} PARENT_SCOPE)
endfunction()

function(git result)
  execute_process(COMMAND git -C "${SOURCE}" ${ARGN} OUTPUT_VARIABLE text ERROR_QUIET RESULT_VARIABLE failed
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(failed)
    set(text "")
  endif()
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

# A tree inside another repository is not under its version control.
git(root rev-parse --show-toplevel)
file(REAL_PATH "${SOURCE}" real_source)
git(commit describe --always --abbrev=12 --exclude=*)
file(TIMESTAMP "${SOURCE}/CHANGELOG.md" date "%Y-%m-%d" UTC)
if(commit AND root STREQUAL real_source)
  set(build "g${commit}")
  git(date log -1 --format=%cs)
  git(changed diff HEAD --binary --no-ext-diff -- ${compiled})
  git(added ls-files --others --exclude-standard -- ${compiled})
  if(NOT "${changed}${added}" STREQUAL "")
    string(REPLACE "\n" ";" added "${added}")
    checksum_of(added_sum ${added})
    string(SHA256 dirt "${changed} ${added_sum}")
    string(SUBSTRING ${dirt} 0 12 dirt)
    string(APPEND build ".dirty.${dirt}")
  endif()
else()
  set(sources "")
  foreach(part IN LISTS compiled)
    if(IS_DIRECTORY "${SOURCE}/${part}")
      file(GLOB_RECURSE found RELATIVE "${SOURCE}" "${SOURCE}/${part}/*")
      list(APPEND sources ${found})
    else()
      list(APPEND sources ${part})
    endif()
  endforeach()
  list(SORT sources)
  checksum_of(sum ${sources})
  set(build "s${sum}")
endif()

file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT "// SPDX-License-Identifier: BSD-3-Clause
// Which sources this program is made of, written by scripts/cmake/build_version.cmake.
#include \"app/process/program_main.h\"

namespace meniscus {

const char* build_version() { return \"${VERSION}+${build}\"; }
const char* build_date() { return \"${date}\"; }

}  // namespace meniscus
")
