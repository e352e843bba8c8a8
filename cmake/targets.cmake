# One way to declare a library, a tool and a test. LFD_LIB_DESTINATION, LFD_PROGRAM_DESTINATION and LFD_CMAKE_DESTINATION
# say where they are installed, LFD_PROGRAM_OUTPUT where programs are built.

set(LFD_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
  $<$<BOOL:${LIGHT_FIELD_DEPTH_WERROR}>:-Werror>)

# Settings shared by every target: the public headers, the internal ones (by their path in src/), warnings; headers of
# others count as system headers.
function(lfd_configure target)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>
    PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_compile_options(${target} PRIVATE ${LFD_WARNINGS})
  target_compile_features(${target} PUBLIC cxx_std_17)
  # Installed libraries and programs find each other.
  set_target_properties(${target} PROPERTIES INSTALL_RPATH "$ORIGIN;$ORIGIN/..")
endfunction()

# What reads bytes of others is compiled with the checks that the compiler offers; the core, which gets checked values
# and whose loops are hot, is not.
function(lfd_harden target)
  target_compile_options(${target} PRIVATE
    $<$<CONFIG:Release>:-U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2 -fstack-protector-strong>)
endfunction()

# Counts the lines that run, where the room (src/ROOM) is one of LIGHT_FIELD_DEPTH_COVERAGE. For one instruction set: each one more
# takes the compiler minutes, and counts the same lines again.
function(lfd_count_lines target)
  get_filename_component(room ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  if(room IN_LIST LIGHT_FIELD_DEPTH_COVERAGE)
    target_compile_options(${target} PRIVATE -O1 -g1 --coverage -fprofile-update=atomic -DHWY_COMPILE_ONLY_STATIC)
    target_link_libraries(${target} PRIVATE --coverage)
  endif()
endfunction()

# lfd_library(NAME [EXPORT_NAME ...] SOURCES ... LINK ... PRIVATE_LINK ... SYSTEM_INCLUDES ...)
# With EXPORT_NAME others may link it as light_field_depth::EXPORT_NAME.
function(lfd_library name)
  cmake_parse_arguments(ARG "" "EXPORT_NAME" "SOURCES;LINK;PRIVATE_LINK;SYSTEM_INCLUDES" ${ARGN})
  add_library(${name} SHARED ${ARG_SOURCES})
  lfd_configure(${name})
  target_include_directories(${name} SYSTEM PUBLIC "$<BUILD_INTERFACE:${ARG_SYSTEM_INCLUDES}>")
  target_link_libraries(${name} PUBLIC ${ARG_LINK} PRIVATE ${ARG_PRIVATE_LINK})
  lfd_count_lines(${name})
  set(export)
  if(ARG_EXPORT_NAME)
    add_library(${PROJECT_NAME}::${ARG_EXPORT_NAME} ALIAS ${name})
    set_target_properties(${name} PROPERTIES EXPORT_NAME ${ARG_EXPORT_NAME})
    set(export EXPORT ${PROJECT_NAME}Targets)
  endif()
  install(TARGETS ${name} ${export}
    ARCHIVE DESTINATION ${LFD_LIB_DESTINATION}
    LIBRARY DESTINATION ${LFD_LIB_DESTINATION}
    RUNTIME DESTINATION bin)
endfunction()

# lfd_executable(NAME SOURCES ... LINK ...): a program that rosrun finds.
function(lfd_executable name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  lfd_configure(${name})
  lfd_harden(${name})
  target_link_libraries(${name} PRIVATE ${ARG_LINK})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${LFD_PROGRAM_OUTPUT})
  install(TARGETS ${name} RUNTIME DESTINATION ${LFD_PROGRAM_DESTINATION})
endfunction()

# Test programs call the libraries, whose loops are the hot ones: with -O1 they are there in two thirds of the time. What nearly
# all of them include is compiled once (HEADERS, a target of test/CMakeLists.txt).
function(lfd_test_program name headers)
  lfd_configure(${name})
  target_compile_options(${name} PRIVATE -O1)
  target_precompile_headers(${name} REUSE_FROM ${headers})
endfunction()

# lfd_gtest(NAME SOURCES ... LINK ...): a unit test without a ROS master.
function(lfd_gtest name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  if(LFD_WITH_ROS)
    catkin_add_gtest(${name} ${ARG_SOURCES} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
    target_link_libraries(${name} gtest_main)
  else()
    add_executable(${name} ${ARG_SOURCES})
    target_link_libraries(${name} GTest::gtest_main)
    add_test(NAME ${name} COMMAND ${name} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  endif()
  set(headers light_field_depth_test_headers)
  if("light_field_depth_ros" IN_LIST ARG_LINK)
    set(headers light_field_depth_ros_test_headers)
  endif()
  lfd_test_program(${name} ${headers})
  target_link_libraries(${name} light_field_depth_test_support ${ARG_LINK})
endfunction()
