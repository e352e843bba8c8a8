# Whether there is ROS (LFD_WITH_ROS), and what the package needs besides. Highway, CLI11 and nlohmann-json come from the
# system where it has a version that will do, else as a release that is fixed by its hash;
# FETCHCONTENT_SOURCE_DIR_HIGHWAY, _CLI11 and _NLOHMANN_JSON name folders that hold such a release already.
if(LIGHT_FIELD_DEPTH_WITH_ROS STREQUAL AUTO)
  find_package(catkin QUIET)
  set(LFD_WITH_ROS ${catkin_FOUND})
else()
  set(LFD_WITH_ROS ${LIGHT_FIELD_DEPTH_WITH_ROS})
endif()

option(LIGHT_FIELD_DEPTH_FETCH "Fetch Highway, CLI11 and nlohmann-json even where the system has them" OFF)

find_package(OpenCV REQUIRED COMPONENTS core imgproc imgcodecs video OPTIONAL_COMPONENTS calib3d ximgproc optflow)
find_package(Eigen3 REQUIRED)
find_package(Boost REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(JPEG REQUIRED)
find_package(Threads REQUIRED)

include(FetchContent)
if(POLICY CMP0135)
  cmake_policy(SET CMP0135 NEW)  # what is unpacked is as new as its download
endif()

# lfd_find_or_fetch(PACKAGE VERSION TARGET FETCHED_TARGET NAME ... URL ... SHA256 ...)
# Makes TARGET there: that of a system's PACKAGE of at least VERSION, or an alias of FETCHED_TARGET.
macro(lfd_find_or_fetch package version target fetched_target)
  cmake_parse_arguments(FETCH "" "NAME;URL;SHA256" "" ${ARGN})
  if(NOT LIGHT_FIELD_DEPTH_FETCH)
    find_package(${package} ${version} CONFIG QUIET)
  endif()
  if(TARGET ${target})
    message(STATUS "${package}: the system's ${${package}_VERSION} (at least ${version} is needed)")
  else()
    if(${package}_CONSIDERED_VERSIONS)
      message(STATUS "${package}: the system's ${${package}_CONSIDERED_VERSIONS} is older than ${version}")
    endif()
    message(STATUS "${package}: taken from FETCHCONTENT_SOURCE_DIR or ${FETCH_URL}")
    FetchContent_Declare(${FETCH_NAME} URL ${FETCH_URL} URL_HASH SHA256=${FETCH_SHA256})
    FetchContent_GetProperties(${FETCH_NAME})
    if(NOT ${FETCH_NAME}_POPULATED)
      FetchContent_Populate(${FETCH_NAME})
      # Neither built nor installed beyond what our targets use.
      add_subdirectory("${${FETCH_NAME}_SOURCE_DIR}" "${${FETCH_NAME}_BINARY_DIR}" EXCLUDE_FROM_ALL)
    endif()
    # Warnings are for our own headers.
    get_target_property(FETCH_INCLUDES ${fetched_target} INTERFACE_INCLUDE_DIRECTORIES)
    set_target_properties(${fetched_target} PROPERTIES INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${FETCH_INCLUDES}")
    if(NOT TARGET ${target})
      add_library(${target} ALIAS ${fetched_target})
    endif()
  endif()
endmacro()

# Highway's own rules of installation stay: release 1.0.3 cannot do without them, and EXCLUDE_FROM_ALL leaves them out.
foreach(option HWY_ENABLE_TESTS HWY_ENABLE_EXAMPLES HWY_ENABLE_CONTRIB JSON_BuildTests JSON_Install
    CLI11_BUILD_TESTS CLI11_BUILD_EXAMPLES CLI11_BUILD_DOCS CLI11_INSTALL)
  set(${option} OFF CACHE INTERNAL "")
endforeach()
# Part of our shared library instead of a library of its own.
set(HWY_FORCE_STATIC_LIBS ON CACHE INTERNAL "")

lfd_find_or_fetch(hwy 1.0 hwy::hwy hwy
  NAME highway
  URL https://github.com/google/highway/archive/refs/tags/1.0.7.tar.gz
  SHA256 5434488108186c170a5e2fca5e3c9b6ef59a1caa4d520b008a9b8be6b8abe6c5)
get_target_property(LFD_HWY_IMPORTED hwy::hwy IMPORTED)
# On ARM: NEON alone, as vectors whose length is known at run time only (SVE) can be no members of a struct, as they are in
# our kernels. Highway gives its functions the target "+crypto"; GCC would refuse to inline them into the constructors that it
# makes for these structs, which stay without it. No instruction of that extension is used.
set(LFD_HWY_DEFINITIONS)
set(LFD_HWY_OPTIONS)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  set(LFD_HWY_DEFINITIONS "HWY_DISABLED_TARGETS=(HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128)")
  set(LFD_HWY_OPTIONS $<$<CXX_COMPILER_ID:GNU>:-march=armv8-a+crypto>)
endif()
if(LFD_HWY_IMPORTED)
  # Without HWY_SHARED_DEFINE, which is for Windows.
  set_target_properties(hwy::hwy PROPERTIES INTERFACE_COMPILE_DEFINITIONS "${LFD_HWY_DEFINITIONS}")
  set_property(TARGET hwy::hwy APPEND PROPERTY INTERFACE_COMPILE_OPTIONS ${LFD_HWY_OPTIONS})
else()
  set_target_properties(hwy PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_compile_definitions(hwy INTERFACE ${LFD_HWY_DEFINITIONS})
  target_compile_options(hwy INTERFACE ${LFD_HWY_OPTIONS})
endif()
lfd_find_or_fetch(CLI11 2.0 CLI11::CLI11 CLI11
  NAME cli11
  URL https://github.com/CLIUtils/CLI11/archive/refs/tags/v2.4.1.tar.gz
  SHA256 73b7ec52261ce8fe980a29df6b4ceb66243bb0b779451dbd3d014cfec9fdbb58)
lfd_find_or_fetch(nlohmann_json 3.7.3 nlohmann_json::nlohmann_json nlohmann_json
  NAME nlohmann_json
  URL https://github.com/nlohmann/json/archive/refs/tags/v3.11.2.tar.gz
  SHA256 d69f9deb6a75e2580465c6c4c5111b89c4dc2fa94e3a85fcd2ffcd9a143d9273)

option(LIGHT_FIELD_DEPTH_BENCHMARK "Build the program bench, where Google Benchmark is found" ON)
if(LIGHT_FIELD_DEPTH_BENCHMARK)
  find_package(benchmark QUIET)
endif()
