# meniscus_embed(<variable> FOLDER <folder> ROOT <what paths begin behind> HEADER <declares both> TYPE <struct of path and
# text> FUNCTION <gives them all>): the path of a C++ file in the build folder that holds the text of every file of FOLDER,
# written anew when one of them changes, so that what links it needs no files at run time.
set(MENISCUS_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/embed_files.cmake)

function(meniscus_embed variable)
  cmake_parse_arguments(PARSE_ARGV 1 embed "" "FOLDER;ROOT;HEADER;TYPE;FUNCTION" "")
  set(written ${CMAKE_BINARY_DIR}/generated/${embed_FUNCTION}.cpp)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${embed_FOLDER}/*)
  list(FILTER sources EXCLUDE REGEX "[.]md$")
  add_custom_command(
    OUTPUT ${written}
    COMMAND ${CMAKE_COMMAND} -DFOLDER=${embed_FOLDER} -DROOT=${embed_ROOT} -DOUTPUT=${written}
            -DHEADER=${embed_HEADER} -DTYPE=${embed_TYPE} -DFUNCTION=${embed_FUNCTION} -P ${MENISCUS_EMBED_SCRIPT}
    DEPENDS ${sources} ${MENISCUS_EMBED_SCRIPT}
    COMMENT "Embedding ${embed_FOLDER}" VERBATIM)
  set(${variable} ${written} PARENT_SCOPE)
endfunction()
