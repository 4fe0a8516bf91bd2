# `cpack` makes a Debian package of what is installed; its dependencies are found by dpkg-shlibdeps.
set(MENISCUS_MAINTAINER "Meniscus developers <maintainers@meniscus.invalid>" CACHE STRING
    "Whom a Debian package names as its maintainer")

# Debian wants a changelog of its own form, with the date of the release.
execute_process(COMMAND git -C ${CMAKE_SOURCE_DIR} log -1 --format=%cD OUTPUT_VARIABLE date ERROR_QUIET
                OUTPUT_STRIP_TRAILING_WHITESPACE)
if(NOT date)
  file(TIMESTAMP ${CMAKE_SOURCE_DIR}/CHANGELOG.md date "%a, %d %b %Y %H:%M:%S +0000" UTC)
endif()
set(changelog ${CMAKE_BINARY_DIR}/generated/debian/changelog)
file(CONFIGURE OUTPUT ${changelog} CONTENT [[
meniscus (@PROJECT_VERSION@) unstable; urgency=medium

  * Release @PROJECT_VERSION@; CHANGELOG.md tells what is new.

 -- @MENISCUS_MAINTAINER@  @date@
]] @ONLY)
add_custom_command(OUTPUT ${changelog}.gz COMMAND ${GZIP} -9nkf ${changelog} DEPENDS ${changelog} VERBATIM
                   COMMENT "")
add_custom_target(meniscus_debian_changelog ALL DEPENDS ${changelog}.gz)
install(FILES ${changelog}.gz ${CMAKE_SOURCE_DIR}/CHANGELOG.md DESTINATION share/doc/meniscus COMPONENT program)

set(CPACK_GENERATOR DEB)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PACKAGE_NAME meniscus)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT ${MENISCUS_MAINTAINER})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_POST_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/ldconfig_by_trigger.cmake)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SECTION science)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME meniscus)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "Meniscus computes the solvent-excluded surface of a molecule exactly: as
spheres, tori and clipped spheres, closed and certified, never as a mesh that
approximates them. It does so on the GPU or the CPU, shows the surface while it
changes, ray casts it to pictures and films, and hands the same patches to
POV-Ray and, with a closed mesh, to Blender.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# Loaded by name: GL by epoxy. What draws, films and renders may be missing where only areas are wanted.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libegl1, libgl1")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS
    "libegl-mesa0, libgl1-mesa-dri, fonts-dejavu-core, ffmpeg, povray, povray-includes, blender")
include(CPack)
