# The files that `cmake --install` installs and the Debian packages contain. The program finds its module in
# ../lib/meniscus and the Blender add-on in ../share/meniscus, so that the prefix can be moved.
find_program(GZIP gzip REQUIRED)
file(GLOB msms_pages CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/app/msms/man/*.1)
set(share ${CMAKE_BINARY_DIR}/share_of_program)
add_custom_command(
  OUTPUT ${share}/man/man1/meniscus.1.gz
  COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:meniscus> -DFOLDER=${share} -DGZIP=${GZIP}
          -DPAGES=${CMAKE_SOURCE_DIR}/app/msms/man -P ${CMAKE_CURRENT_LIST_DIR}/make_share.cmake
  DEPENDS ${msms_pages} meniscus ${CMAKE_CURRENT_LIST_DIR}/make_share.cmake
  COMMENT "Writing manual and completion" VERBATIM)
add_custom_target(meniscus_share ALL DEPENDS ${share}/man/man1/meniscus.1.gz)

install(TARGETS meniscus RUNTIME DESTINATION bin COMPONENT program)
foreach(module meniscus_openimageio meniscus_hdf5)
  if(TARGET ${module})
    install(TARGETS ${module} LIBRARY DESTINATION lib/meniscus COMPONENT program
            PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
  endif()
endforeach()
install(DIRECTORY ${CMAKE_SOURCE_DIR}/exporters/blender/addon DESTINATION share/meniscus COMPONENT program
        PATTERN __pycache__ EXCLUDE)
install(FILES ${CMAKE_SOURCE_DIR}/exporters/pymol/meniscus_plugin.py DESTINATION share/meniscus COMPONENT program)
install(DIRECTORY ${share}/ DESTINATION share COMPONENT program)
install(DIRECTORY ${CMAKE_CURRENT_LIST_DIR}/share/ DESTINATION share COMPONENT program)  # files for desktops
install(FILES ${CMAKE_SOURCE_DIR}/README.md ${CMAKE_SOURCE_DIR}/SECURITY.md DESTINATION share/doc/meniscus
        COMPONENT program)
