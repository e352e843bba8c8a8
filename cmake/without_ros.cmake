# A CMake package of its own: the libraries without ROS, their headers and a package configuration.
message(STATUS "Without ROS: the libraries core, evaluation and io, and the programs estimate and evaluate")
if(BUILD_TESTING)
  enable_testing()
  find_package(GTest REQUIRED)
endif()

include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(LFD_LIB_DESTINATION ${CMAKE_INSTALL_LIBDIR})
set(LFD_PROGRAM_DESTINATION ${CMAKE_INSTALL_LIBDIR}/${PROJECT_NAME})
set(LFD_PROGRAM_OUTPUT ${PROJECT_BINARY_DIR})
set(LFD_CMAKE_DESTINATION ${CMAKE_INSTALL_DATADIR}/${PROJECT_NAME}/cmake)
set(LFD_BUILT_CMAKE_FOLDER ${PROJECT_BINARY_DIR})

configure_package_config_file(cmake/${PROJECT_NAME}Config.cmake.in ${PROJECT_NAME}Config.cmake
  INSTALL_DESTINATION ${LFD_CMAKE_DESTINATION})
write_basic_package_version_file(${PROJECT_NAME}ConfigVersion.cmake COMPATIBILITY SameMinorVersion)
configure_file(cmake/${PROJECT_NAME}-extras.cmake ${PROJECT_NAME}-extras.cmake COPYONLY)
install(FILES
  ${PROJECT_BINARY_DIR}/${PROJECT_NAME}Config.cmake ${PROJECT_BINARY_DIR}/${PROJECT_NAME}ConfigVersion.cmake
  ${PROJECT_BINARY_DIR}/${PROJECT_NAME}-extras.cmake
  DESTINATION ${LFD_CMAKE_DESTINATION})
install(DIRECTORY include/${PROJECT_NAME}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${PROJECT_NAME}
  PATTERN ros EXCLUDE)
