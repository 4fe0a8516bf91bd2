# Writes one C++ file that holds every file of the preview's page.
# Run as: cmake -DFOLDER=<page> -DOUTPUT=<file.cpp> -P embed_page.cmake
file(GLOB files RELATIVE ${FOLDER} ${FOLDER}/*)
list(SORT files)

set(entries "")
foreach(name IN LISTS files)
  file(READ ${FOLDER}/${name} text)
  string(APPEND entries "    {\"${name}\", R\"page(${text})page\"},\n")
endforeach()
list(LENGTH files count)

file(WRITE ${OUTPUT}.new "// SPDX-License-Identifier: BSD-3-Clause
// The page of the preview, written by scripts/cmake/embed_page.cmake; change the files in app/preview/server/page instead.
#include \"app/preview/server/page_files.h\"

#include <array>

namespace meniscus {
namespace {

constexpr std::array<PageFile, ${count}> kFiles = {{
${entries}}};

}  // namespace

std::span<const PageFile> page_files() { return kFiles; }

}  // namespace meniscus
")
file(RENAME ${OUTPUT}.new ${OUTPUT})
