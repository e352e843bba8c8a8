# A catkin package: messages, run-time parameters, package configuration, and what is installed besides the targets.
find_package(catkin REQUIRED COMPONENTS
  camera_calibration_parsers cv_bridge diagnostic_updater dynamic_reconfigure geometry_msgs image_geometry image_transport
  message_generation nodelet pcl_conversions pcl_ros pluginlib rosbag roscpp roslib sensor_msgs std_msgs std_srvs stereo_msgs tf2_ros)

find_package(PCL REQUIRED COMPONENTS common io)
find_package(OpenCV REQUIRED COMPONENTS core)  # all that the public headers need

include(cmake/ros_interfaces.cmake)

catkin_package(
  INCLUDE_DIRS include
  LIBRARIES light_field_depth_core light_field_depth_evaluation light_field_depth_io light_field_depth_ros
  CATKIN_DEPENDS cv_bridge diagnostic_updater dynamic_reconfigure geometry_msgs image_transport message_runtime nodelet roscpp
    sensor_msgs std_msgs std_srvs stereo_msgs
  DEPENDS OpenCV
  CFG_EXTRAS light_field_depth-extras.cmake)

set(LFD_LIB_DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
set(LFD_PROGRAM_DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
set(LFD_PROGRAM_OUTPUT ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
set(LFD_CMAKE_DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/cmake)
set(LFD_BUILT_CMAKE_FOLDER ${CATKIN_DEVEL_PREFIX}/${LFD_CMAKE_DESTINATION})

install(DIRECTORY include/${PROJECT_NAME}/ DESTINATION ${CATKIN_PACKAGE_INCLUDE_DESTINATION})
install(DIRECTORY launch config data DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
install(FILES nodelet_plugins.xml DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
