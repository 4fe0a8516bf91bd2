# meniscus_embed(<variable> FOLDER <folder> ROOT <folder that paths are relative to> HEADER <declares both> TYPE <struct of
# path and text> FUNCTION <returns them all> [DOCUMENTS]): sets the variable to a C++ file in the build folder that holds
# the text of every file of FOLDER, so that what links it needs no files at run time. It is written again when one of the
# files changes. Documents (*.md) are left out; with DOCUMENTS they are all there is.
set(MENISCUS_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/embed_files.cmake)

function(meniscus_embed variable)
  cmake_parse_arguments(PARSE_ARGV 1 embed "DOCUMENTS" "FOLDER;ROOT;HEADER;TYPE;FUNCTION" "")
  set(written ${CMAKE_BINARY_DIR}/generated/${embed_FUNCTION}.cpp)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${embed_FOLDER}/*)
  if(embed_DOCUMENTS)
    set(filter INCLUDE)
  else()
    set(filter EXCLUDE)
  endif()
  list(FILTER sources ${filter} REGEX "[.]md$")
  add_custom_command(
    OUTPUT ${written}
    COMMAND ${CMAKE_COMMAND} -DFOLDER=${embed_FOLDER} -DROOT=${embed_ROOT} -DOUTPUT=${written}
            -DHEADER=${embed_HEADER} -DTYPE=${embed_TYPE} -DFUNCTION=${embed_FUNCTION} -DFILTER=${filter} -P ${MENISCUS_EMBED_SCRIPT}
    DEPENDS ${sources} ${MENISCUS_EMBED_SCRIPT}
    COMMENT "Embedding ${embed_FOLDER}" VERBATIM)
  set(${variable} ${written} PARENT_SCOPE)
endfunction()
