# `cmake --install` runs this after it installs the shared library in MENISCUS_FOLDER; it reports if programs will find
# the library only after the loader's cache is written again.
find_program(ldconfig ldconfig PATHS /sbin /usr/sbin NO_CACHE)
if(ldconfig AND NOT "$ENV{DESTDIR}")
  execute_process(COMMAND ${ldconfig} -N -X -v OUTPUT_VARIABLE searched ERROR_QUIET)
  execute_process(COMMAND ${ldconfig} -p OUTPUT_VARIABLE known ERROR_QUIET)
  string(FIND "\n${searched}" "\n${MENISCUS_FOLDER}:" is_searched)
  string(FIND "${known}" " ${MENISCUS_FOLDER}/libmeniscus.so." is_known)
  if(NOT is_searched EQUAL -1 AND is_known EQUAL -1)
    message(STATUS "Now run ldconfig, so that programs find the library")
  endif()
endif()
