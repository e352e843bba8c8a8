# Read by find_package(light_field_depth), from an install space without ROS as well as from catkin's spaces:
# light_field_depth::core, light_field_depth::evaluation and light_field_depth::io.
include(CMakeFindDependencyMacro)
find_dependency(OpenCV COMPONENTS core)
find_dependency(Threads)
# In a workspace that is built as one project they are there already.
if(NOT TARGET light_field_depth::core)
  include("${light_field_depth_DIR}/light_field_depthTargets.cmake")
endif()
