# Run by cpack behind the packages: what CPack makes of a shared library are scripts that call ldconfig, for modules of a
# program too. Debian wants a trigger instead, and only where the library is one for others.
foreach(package ${CPACK_PACKAGE_FILES})
  set(tree ${package}.tree)
  file(REMOVE_RECURSE ${tree})
  execute_process(COMMAND dpkg-deb --raw-extract ${package} ${tree} COMMAND_ERROR_IS_FATAL ANY)
  file(REMOVE ${tree}/DEBIAN/postinst ${tree}/DEBIAN/postrm)
  file(GLOB libraries ${tree}/usr/lib/*.so.* ${tree}/usr/lib/*-linux-*/*.so.*)
  if(libraries)
    file(WRITE ${tree}/DEBIAN/triggers "activate-noawait ldconfig\n")
  endif()
  execute_process(COMMAND dpkg-deb --build --root-owner-group ${tree} ${package} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  file(REMOVE_RECURSE ${tree})
endforeach()
