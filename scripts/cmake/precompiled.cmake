# The large headers of other libraries are compiled once for some folders instead of once per file. No other headers are
# among them, and no file relies on it: a build with MENISCUS_PRECOMPILED=OFF shows that each includes what it needs.
option(MENISCUS_PRECOMPILED "Compile the large headers of other libraries once" ON)

# ccache needs gcc to report a precompiled header, and clang to leave its time out. If std::string is precompiled, gcc
# 12 does not know that it is from a system header, and warns of copies that never happen.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  set(precompiled_options -fpch-preprocess -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread -Wno-restrict)
else()
  set(precompiled_options "SHELL:-Xclang -fno-pch-timestamp")
endif()

# meniscus_precompile(HOLDER [SHARED] HEADERS headers... LINK targets... OPTIONS options...): compiles the headers with
# the options of a program that links these targets; SHARED if shared libraries use them, too. A precompiled header fits
# only if these options are the same.
function(meniscus_precompile holder)
  cmake_parse_arguments(P "SHARED" "" "HEADERS;LINK;OPTIONS" ${ARGN})
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/${holder}.cpp CONTENT "// Holds precompiled headers.\n")
  add_library(${holder} OBJECT EXCLUDE_FROM_ALL ${CMAKE_BINARY_DIR}/generated/${holder}.cpp)
  set_target_properties(${holder} PROPERTIES POSITION_INDEPENDENT_CODE ${P_SHARED})
  target_compile_options(${holder} PRIVATE ${precompiled_options} ${P_OPTIONS})
  target_link_libraries(${holder} PRIVATE meniscus_options ${P_LINK})
  target_precompile_headers(${holder} PRIVATE ${P_HEADERS})
endfunction()

# Makes targets use a precompiled header. If it is not SHARED, they are programs or linked to programs only.
function(meniscus_take_precompiled holder)
  if(NOT MENISCUS_PRECOMPILED)
    return()
  endif()
  get_target_property(shared ${holder} POSITION_INDEPENDENT_CODE)
  foreach(target ${ARGN})
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ${shared})
    target_compile_options(${target} PRIVATE ${precompiled_options})
    target_precompile_headers(${target} REUSE_FROM ${holder})
  endforeach()
endfunction()

# libraries_and_programs(RESULT FOLDER): returns the targets of a folder and of its subfolders.
function(libraries_and_programs result folder)
  get_property(found DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  get_property(below DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  set(all "")
  foreach(target ${found})
    get_target_property(type ${target} TYPE)
    if(type MATCHES "^(STATIC_LIBRARY|EXECUTABLE)$")
      list(APPEND all ${target})
    endif()
  endforeach()
  foreach(subfolder ${below})
    libraries_and_programs(theirs ${subfolder})
    list(APPEND all ${theirs})
  endforeach()
  set(${result} ${all} PARENT_SCOPE)
endfunction()
