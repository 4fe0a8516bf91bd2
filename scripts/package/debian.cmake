# `cpack` makes Debian packages: the program; the shared library, named after its soname; what programs that use it are
# compiled with; the Python package; the manual. dpkg-shlibdeps finds the packages of linked libraries.
set(MENISCUS_MAINTAINER "Meniscus developers <maintainers@meniscus.invalid>" CACHE STRING
    "Whom a Debian package names as its maintainer")
set(generated ${CMAKE_BINARY_DIR}/generated/debian)

# Debian wants a changelog of its own form, with the date of the release. Files have that date, too.
execute_process(COMMAND git -C ${CMAKE_SOURCE_DIR} log -1 "--format=%cD;%ct" OUTPUT_VARIABLE date ERROR_QUIET
                OUTPUT_STRIP_TRAILING_WHITESPACE)
if(NOT date)
  file(TIMESTAMP ${CMAKE_SOURCE_DIR}/CHANGELOG.md date "%a, %d %b %Y %H:%M:%S +0000;%s" UTC)
endif()
list(POP_BACK date CPACK_MENISCUS_SECONDS)
file(CONFIGURE OUTPUT ${generated}/changelog CONTENT [[
meniscus (@PROJECT_VERSION@) unstable; urgency=medium

  * Release @PROJECT_VERSION@; CHANGELOG.md tells what is new.

 -- @MENISCUS_MAINTAINER@  @date@
]] @ONLY)
execute_process(COMMAND ${GZIP} -9nkf ${generated}/changelog COMMAND_ERROR_IS_FATAL ANY)
install(FILES ${CMAKE_SOURCE_DIR}/CHANGELOG.md DESTINATION share/doc/meniscus COMPONENT program)

# The notices of what is compiled into the program and the library, by the packages that it came from.
file(READ ${CMAKE_SOURCE_DIR}/LICENSE notices)
string(APPEND notices "
The Blender add-on, /usr/share/meniscus/addon, is under the GNU General Public License, version 3 or later:
/usr/share/common-licenses/GPL-3.
")
foreach(package gemmi-dev tao-pegtl-dev libcli11-dev libglm-dev nlohmann-json3-dev libdeflate-dev libboost-dev fonts-liberation2)
  if(EXISTS /usr/share/doc/${package}/copyright)
    file(READ /usr/share/doc/${package}/copyright text)
    string(APPEND notices "\nParts of this package are compiled from the package ${package}:\n\n${text}")
  endif()
endforeach()
file(WRITE ${generated}/copyright "${notices}")

set(CPACK_GENERATOR DEB)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PACKAGE_NAME meniscus)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT ${MENISCUS_MAINTAINER})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_POST_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/debian_rules.cmake)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)

# debian_package(COMPONENT NAME SECTION section DESCRIPTION text...): what is installed as this component, with the
# papers that Debian asks for. The description's first line is its title.
set(CPACK_COMPONENTS_ALL "")
macro(debian_package component name)
  cmake_parse_arguments(P "" "SECTION;DESCRIPTION;DEPENDS;RECOMMENDS;SUGGESTS;ARCHITECTURE;COPYRIGHT" "CONTROL" ${ARGN})
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  install(FILES ${generated}/changelog.gz DESTINATION share/doc/${name} COMPONENT ${component} EXCLUDE_FROM_ALL)
  if(NOT P_COPYRIGHT)
    set(P_COPYRIGHT ${CMAKE_SOURCE_DIR}/LICENSE)
  endif()
  install(FILES ${P_COPYRIGHT} DESTINATION share/doc/${name} RENAME copyright COMPONENT ${component}
          EXCLUDE_FROM_ALL)
  string(TOUPPER CPACK_DEBIAN_${component} variable)
  set(${variable}_PACKAGE_NAME ${name})
  set(${variable}_PACKAGE_SECTION ${P_SECTION})
  set(${variable}_DESCRIPTION ${P_DESCRIPTION})
  set(${variable}_PACKAGE_DEPENDS ${P_DEPENDS})
  set(${variable}_PACKAGE_RECOMMENDS ${P_RECOMMENDS})
  set(${variable}_PACKAGE_SUGGESTS ${P_SUGGESTS})
  set(${variable}_PACKAGE_CONTROL_EXTRA ${P_CONTROL})
  set(${variable}_PACKAGE_CONTROL_STRICT_PERMISSION ON)
  if(P_ARCHITECTURE)
    set(${variable}_PACKAGE_ARCHITECTURE ${P_ARCHITECTURE})
  else()
    set(${variable}_PACKAGE_SHLIBDEPS ON)
  endif()
endmacro()

# GL is loaded by name, by epoxy. Packages for drawing, films and rendering are optional for users of areas alone.
debian_package(program meniscus
  SECTION science
  COPYRIGHT ${generated}/copyright
  DEPENDS "libegl1, libgl1"
  RECOMMENDS "libegl-mesa0, libgl1-mesa-dri, fonts-dejavu-core, ffmpeg, povray, povray-includes, blender"
  SUGGESTS "meniscus-doc, chemical-mime-data"
  CONTROL ${CMAKE_CURRENT_LIST_DIR}/program/postinst ${CMAKE_CURRENT_LIST_DIR}/program/prerm
  DESCRIPTION "Exact, analytic solvent-excluded surfaces of molecules
Meniscus computes the solvent-excluded surface of a molecule exactly: as
spheres, tori and clipped spheres, closed and certified, never as a mesh that
approximates them. It does so on the GPU or the CPU, shows the surface while it
changes, ray casts it to pictures and films, and hands the same patches to
POV-Ray and, with a closed mesh, to Blender.")

set(about "The library computes the solvent-excluded surface of a molecule exactly, with
areas, volumes, components, areas of atoms, the analytic patches, closed
meshes, distances to the surface, and ray-cast pictures of it.")
set(library libmeniscus${PROJECT_VERSION_MAJOR})
set(CPACK_MENISCUS_SYMBOLS ${CMAKE_CURRENT_LIST_DIR}/libmeniscus.symbols)
file(WRITE ${generated}/shlibs "libmeniscus ${PROJECT_VERSION_MAJOR} ${library} (>= ${PROJECT_VERSION})\n")
debian_package(libmeniscus ${library}
  SECTION libs
  COPYRIGHT ${generated}/copyright
  RECOMMENDS "libegl1, libgl1, libegl-mesa0, libgl1-mesa-dri"
  CONTROL ${generated}/shlibs
  DESCRIPTION "Exact solvent-excluded surfaces of molecules - shared library
${about}
.
This package has the shared library.")

debian_package(libmeniscus-dev libmeniscus-dev
  SECTION libdevel
  DEPENDS "${library} (= ${PROJECT_VERSION})"
  DESCRIPTION "Exact solvent-excluded surfaces of molecules - headers
${about}
.
This package has the headers for C99 and C++20, and what CMake and pkg-config
need to compile a program that uses the library.")

install(DIRECTORY ${CMAKE_SOURCE_DIR}/exporters/bindings/python/meniscus DESTINATION lib/python3/dist-packages
        COMPONENT python3-meniscus EXCLUDE_FROM_ALL PATTERN __pycache__ EXCLUDE)
file(CONFIGURE OUTPUT ${generated}/METADATA CONTENT [[
Metadata-Version: 2.1
Name: meniscus-ses
Version: @PROJECT_VERSION@
Summary: Exact solvent-excluded surfaces of molecules: areas, volumes, patches, meshes, distances, pictures
License: BSD-3-Clause
Requires-Python: >=3.9
Requires-Dist: numpy>=1.21
]] @ONLY)
install(FILES ${generated}/METADATA DESTINATION lib/python3/dist-packages/meniscus_ses-${PROJECT_VERSION}.dist-info
        COMPONENT python3-meniscus EXCLUDE_FROM_ALL)
debian_package(python3-meniscus python3-meniscus
  SECTION python
  ARCHITECTURE all
  DEPENDS "python3:any (>= 3.9~), python3-numpy, ${library} (>= ${PROJECT_VERSION})"
  CONTROL ${CMAKE_CURRENT_LIST_DIR}/python/postinst ${CMAKE_CURRENT_LIST_DIR}/python/prerm
  DESCRIPTION "Exact solvent-excluded surfaces of molecules - Python 3
${about}
.
This package has the Python 3 package: arrays of numpy in, arrays of numpy out.")

# The manual: the site that scripts/manual.sh made in MENISCUS_SITE, or its Markdown.
set(MENISCUS_SITE "" CACHE PATH "The manual as a site, made by scripts/manual.sh, for the package meniscus-doc")
file(READ ${CMAKE_SOURCE_DIR}/LICENSE notices)
if(MENISCUS_SITE)
  install(DIRECTORY ${MENISCUS_SITE}/ DESTINATION share/doc/meniscus/html COMPONENT meniscus-doc
          PATTERN "*.map" EXCLUDE PATTERN lunr EXCLUDE PATTERN "sitemap*" EXCLUDE)  # lunr: other languages
  file(READ ${MENISCUS_SITE}/assets/LICENSE text)
  string(APPEND notices "\nThe theme of the pages is Material for MkDocs. It holds lunr, Copyright (C) 2020 Oliver Nightingale, under the same terms:\n\n${text}")
else()
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs DESTINATION share/doc/meniscus COMPONENT meniscus-doc)
endif()
file(WRITE ${generated}/copyright_of_manual "${notices}")
debian_package(meniscus-doc meniscus-doc
  SECTION doc
  ARCHITECTURE all
  COPYRIGHT ${generated}/copyright_of_manual
  DESCRIPTION "Exact solvent-excluded surfaces of molecules - manual
Meniscus computes the solvent-excluded surface of a molecule exactly, makes
pictures and films of it, and exports it to POV-Ray and Blender.
.
This package has the manual: tutorials, one page for each task, a gallery with
the commands of its pictures, and the reference.")
include(CPack)
