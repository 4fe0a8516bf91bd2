# Writes one C++ file that holds the text of the files below a folder whose paths match a pattern, or do not, sorted by
# path. Fonts (*.ttf) are written byte by byte.
# Run as: cmake -DFOLDER=<folder> -DROOT=<folder that paths are relative to> -DOUTPUT=<file.cpp> -DHEADER=<declares both>
#         -DTYPE=<struct of path and text> -DFUNCTION=<returns them all> -DFILTER=<EXCLUDE or INCLUDE> -DPATTERN=<of paths>
#         -P embed_files.cmake
file(GLOB_RECURSE paths RELATIVE ${ROOT} ${FOLDER}/*)
list(FILTER paths ${FILTER} REGEX "${PATTERN}")
list(SORT paths)

set(entries "")
foreach(path IN LISTS paths)
  if(path MATCHES "[.]ttf$")
    file(READ ${ROOT}/${path} text HEX)
    string(REGEX REPLACE "(..)" "\\\\x\\1" text "${text}")
    set(text "\"${text}\"")
  else()
    file(READ ${ROOT}/${path} text)
    set(text "R\"embedded(${text})embedded\"")
  endif()
  string(APPEND entries "    {\"${path}\",\n     ${text}sv},\n")
endforeach()
list(LENGTH paths count)

file(WRITE ${OUTPUT}.new "// SPDX-License-Identifier: BSD-3-Clause
// The text of files, written by scripts/cmake/embed_files.cmake; change the files instead.
#include \"${HEADER}\"

#include <array>
#include <string_view>

namespace meniscus {
namespace {

using namespace std::string_view_literals;  // sv takes the length from the compiler: no text is walked through

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored \"-Woverlength-strings\"  // all our compilers take longer strings than they must
constexpr std::array<${TYPE}, ${count}> kFiles = {{
${entries}}};
#pragma GCC diagnostic pop

}  // namespace

std::span<const ${TYPE}> ${FUNCTION}() { return kFiles; }

}  // namespace meniscus
")
file(RENAME ${OUTPUT}.new ${OUTPUT})
