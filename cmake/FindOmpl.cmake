# OMPL. Its own package file (1.5, Debian) names Boost files that libompl-dev does not install. Target ompl::ompl.
if(NOT TARGET ompl::ompl)
  find_path(Ompl_INCLUDE_DIR ompl/config.h PATH_SUFFIXES ompl-1.5 ompl-1.6 ompl-1.7)
  find_library(Ompl_LIBRARY ompl)
  find_package(Boost 1.58 REQUIRED)
  include(FindPackageHandleStandardArgs)
  find_package_handle_standard_args(Ompl REQUIRED_VARS Ompl_LIBRARY Ompl_INCLUDE_DIR)
  if(Ompl_FOUND)
    add_library(ompl::ompl UNKNOWN IMPORTED)
    set_target_properties(ompl::ompl PROPERTIES
      IMPORTED_LOCATION ${Ompl_LIBRARY}
      INTERFACE_INCLUDE_DIRECTORIES ${Ompl_INCLUDE_DIR}
      INTERFACE_LINK_LIBRARIES "Boost::headers;Eigen3::Eigen")
  endif()
  mark_as_advanced(Ompl_INCLUDE_DIR Ompl_LIBRARY)
endif()
