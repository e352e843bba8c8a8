# One way to declare a library, a tool and a test.

set(LFD_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
  $<$<BOOL:${LIGHT_FIELD_DEPTH_WERROR}>:-Werror>)

# Settings shared by every target: the public headers, the internal ones (by their path in src/), warnings; headers of
# others count as system headers.
function(lfd_configure target)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>
    PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_compile_options(${target} PRIVATE ${LFD_WARNINGS})
endfunction()

# lfd_library(NAME SOURCES ... LINK ... SYSTEM_INCLUDES ...)
function(lfd_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;SYSTEM_INCLUDES" ${ARGN})
  add_library(${name} SHARED ${ARG_SOURCES})
  lfd_configure(${name})
  target_include_directories(${name} SYSTEM PUBLIC ${ARG_SYSTEM_INCLUDES})
  target_link_libraries(${name} PUBLIC ${ARG_LINK})
  install(TARGETS ${name}
    ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
    LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
    RUNTIME DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION})
endfunction()

# lfd_executable(NAME SOURCES ... LINK ...): a program that rosrun finds.
function(lfd_executable name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  lfd_configure(${name})
  target_link_libraries(${name} PRIVATE ${ARG_LINK})
  set_target_properties(${name} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
  install(TARGETS ${name} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
endfunction()

# lfd_gtest(NAME SOURCES ... LINK ...): a unit test without a ROS master.
function(lfd_gtest name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  catkin_add_gtest(${name} ${ARG_SOURCES} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  lfd_configure(${name})
  target_link_libraries(${name} light_field_depth_test_support ${ARG_LINK} gtest_main)
endfunction()
