# meniscus_embed(<variable> FOLDER <folder> ROOT <folder that paths are relative to> HEADER <declares both> TYPE <struct of
# path and text> FUNCTION <returns them all> [ONLY <pattern>]): sets the variable to a C++ file in the build folder that
# holds the text of every file of FOLDER whose path matches the pattern, so that what links it needs no files at run time.
# It is written again when one of the files changes. Without a pattern, all files but documents (*.md) are taken.
set(MENISCUS_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/embed_files.cmake)

function(meniscus_embed variable)
  cmake_parse_arguments(PARSE_ARGV 1 embed "" "FOLDER;ROOT;HEADER;TYPE;FUNCTION;ONLY" "")
  set(written ${CMAKE_BINARY_DIR}/generated/${embed_FUNCTION}.cpp)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${embed_FOLDER}/*)
  set(filter EXCLUDE)
  if(embed_ONLY)
    set(filter INCLUDE)
  else()
    set(embed_ONLY "[.]md$")
  endif()
  list(FILTER sources ${filter} REGEX "${embed_ONLY}")
  add_custom_command(
    OUTPUT ${written}
    COMMAND ${CMAKE_COMMAND} -DFOLDER=${embed_FOLDER} -DROOT=${embed_ROOT} -DOUTPUT=${written}
            -DHEADER=${embed_HEADER} -DTYPE=${embed_TYPE} -DFUNCTION=${embed_FUNCTION} -DFILTER=${filter}
            -DPATTERN=${embed_ONLY} -P ${MENISCUS_EMBED_SCRIPT}
    DEPENDS ${sources} ${MENISCUS_EMBED_SCRIPT}
    COMMENT "Embedding ${embed_FOLDER}" VERBATIM)
  add_custom_target(${embed_FUNCTION}_file DEPENDS ${written})  # else it waits for all that its user links
  set(${variable} ${written} PARENT_SCOPE)
endfunction()
