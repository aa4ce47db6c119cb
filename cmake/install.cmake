# What is installed, and how it is found again: find_package(handey) for CMake, handey.pc for everything else.
# All of it is the component `development`, which a Python wheel (SKBUILD) leaves out.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(handey_in_wheel "")
if(SKBUILD)
  set(handey_in_wheel EXCLUDE_FROM_ALL)
endif()
if(NOT SKBUILD OR HANDEY_BUILD_TESTS)
  set_target_properties(handey_static handey_shared PROPERTIES EXCLUDE_FROM_ALL FALSE)
endif()
set(handey_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/handey)

foreach(kind static shared)
  install(TARGETS handey_${kind} EXPORT handey_${kind}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development ${handey_in_wheel}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development ${handey_in_wheel})
  install(EXPORT handey_${kind} NAMESPACE handey:: FILE handey_${kind}_targets.cmake
    DESTINATION ${handey_package_dir} COMPONENT development ${handey_in_wheel})
endforeach()
install(DIRECTORY cpp/include/handey DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT development ${handey_in_wheel} FILES_MATCHING PATTERN "*.hpp")

configure_package_config_file(cmake/handeyConfig.cmake.in handeyConfig.cmake
  INSTALL_DESTINATION ${handey_package_dir} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(handeyConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
    ${CMAKE_CURRENT_BINARY_DIR}/handeyConfig.cmake
    ${CMAKE_CURRENT_BINARY_DIR}/handeyConfigVersion.cmake
    cmake/FindOmpl.cmake
    cmake/FindPolyclipping.cmake
  DESTINATION ${handey_package_dir} COMPONENT development ${handey_in_wheel})

# Where the package file stands relative to the prefix, so that the installed tree can be moved.
file(RELATIVE_PATH handey_prefix_from_pc
  /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
configure_file(cmake/handey.pc.in handey.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/handey.pc
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development ${handey_in_wheel})
