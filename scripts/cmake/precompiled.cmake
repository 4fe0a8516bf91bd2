# The large headers of other libraries are compiled once for a folder of programs, not once a file. Nothing else is
# among them, and no file relies on it: a build with MENISCUS_PRECOMPILED=OFF shows that each includes what it needs.
option(MENISCUS_PRECOMPILED "Compile the large headers of other libraries once" ON)

# For ccache gcc has to say that it read a precompiled header, and clang has to leave the time out of it.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  set(precompiled_options -fpch-preprocess)
else()
  set(precompiled_options "SHELL:-Xclang -fno-pch-timestamp")
endif()

# Libraries for others, and programs in C, are left out: a precompiled header fits one language and one kind of code only.
function(precompile_folder folder holder)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target ${targets})
    get_target_property(type ${target} TYPE)
    get_target_property(sources ${target} SOURCES)
    if(type MATCHES "^(STATIC_LIBRARY|OBJECT_LIBRARY|EXECUTABLE)$" AND NOT target STREQUAL holder
       AND NOT sources MATCHES "\\.c(;|$)")
      set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
      target_compile_options(${target} PRIVATE ${precompiled_options})
      target_precompile_headers(${target} REUSE_FROM ${holder})
    endif()
  endforeach()
  get_property(below DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(subfolder ${below})
    precompile_folder(${subfolder} ${holder})
  endforeach()
endfunction()

# meniscus_precompile(HEADERS headers... LINK targets...), last in a folder: for every library and program of it and of
# the folders below. LINK: where the headers come from.
function(meniscus_precompile)
  cmake_parse_arguments(P "" "" "HEADERS;LINK" ${ARGN})
  if(NOT MENISCUS_PRECOMPILED)
    return()
  endif()
  get_filename_component(name ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  set(holder meniscus_${name}_headers)
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/${holder}.cpp CONTENT "// Holds precompiled headers.\n")
  add_library(${holder} OBJECT ${CMAKE_BINARY_DIR}/generated/${holder}.cpp)
  set_target_properties(${holder} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
  target_compile_options(${holder} PRIVATE ${precompiled_options})
  target_link_libraries(${holder} PRIVATE meniscus_options ${P_LINK})
  target_precompile_headers(${holder} PRIVATE ${P_HEADERS})
  precompile_folder(${CMAKE_CURRENT_SOURCE_DIR} ${holder})
endfunction()
