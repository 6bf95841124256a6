# What is built. -DGRID_PATH_PLANNER_COMPONENTS="planning;driving" (or "planning,driving") leaves out what the
# others need.
#
#   planning    path_planner, map_publisher, grid_path (plan, convert, rectangles): always built
#   driving     navigate_path, teleop_joy
#   avoidance   local_planner
#   mapping     projected_map, grid_path project: needs OctoMap
#   simulation  simulator: needs SDFormat, Assimp and Embree
#   study       grid_path scenarios, grid_path study; with avoidance, mapping and simulation grid_path flights
#
# Sets GPP_WITH_<component>, GPP_FOLDERS (of src/, from the ground up), GPP_ROOMS (the libraries that
# they make), GPP_NODES, GPP_CONFIGURATIONS, GPP_LAUNCH_FILES and what the components need of catkin.
set(GPP_ALL_COMPONENTS planning driving avoidance mapping simulation study)
set(GRID_PATH_PLANNER_COMPONENTS "${GPP_ALL_COMPONENTS}" CACHE STRING
  "Components to build beside planning, of: ${GPP_ALL_COMPONENTS}")
string(REPLACE "," ";" components "${GRID_PATH_PLANNER_COMPONENTS}")
foreach(component ${components})
  if(NOT component IN_LIST GPP_ALL_COMPONENTS)
    message(FATAL_ERROR "GRID_PATH_PLANNER_COMPONENTS: there is no '${component}'; known are ${GPP_ALL_COMPONENTS}")
  endif()
  set(GPP_WITH_${component} TRUE)
endforeach()
set(GPP_WITH_planning TRUE)

set(GPP_FOLDERS base grid costmap path planners planning)
set(GPP_ROOMS ${GPP_FOLDERS})
set(ros_rooms ros_common ros_planning)
set(GPP_NODES path_planner map_publisher)
set(GPP_CONFIGURATIONS PathPlanner MapPublisher)
set(GPP_CATKIN_EXPORTS actionlib actionlib_msgs dynamic_reconfigure geometry_msgs message_runtime nav_msgs
  nodelet roscpp sensor_msgs std_msgs tf2_ros visualization_msgs)
set(GPP_CATKIN_COMPONENTS actionlib actionlib_msgs diagnostic_msgs diagnostic_updater dynamic_reconfigure
  geometry_msgs map_msgs message_generation nav_msgs nodelet pluginlib rosbag roscpp sensor_msgs std_msgs tf2 tf2_geometry_msgs
  tf2_msgs tf2_ros visualization_msgs)
set(GPP_EXPORTED_LIBRARIES EIGEN3)
set(GPP_LAUNCH_FILES map_file planner rviz)

if(GPP_WITH_study)
  list(APPEND GPP_FOLDERS study)
  list(APPEND GPP_ROOMS study)
endif()
if(GPP_WITH_driving)
  list(APPEND GPP_FOLDERS following)
  list(APPEND GPP_ROOMS following)
  list(APPEND ros_rooms ros_driving)
  list(APPEND GPP_NODES navigate_path teleop_joy)
  list(APPEND GPP_CONFIGURATIONS NavigatePath TeleopJoy)
  list(APPEND GPP_LAUNCH_FILES navigate_path teleop_joy)
endif()
if(GPP_WITH_avoidance)
  list(APPEND GPP_FOLDERS avoidance)
  list(APPEND GPP_ROOMS avoidance)
  list(APPEND ros_rooms ros_avoidance)
  list(APPEND GPP_NODES local_planner)
  list(APPEND GPP_CONFIGURATIONS LocalPlanner)
  list(APPEND GPP_LAUNCH_FILES local_planner)
endif()
if(GPP_WITH_mapping)
  find_package(octomap REQUIRED)
  list(APPEND GPP_FOLDERS mapping)
  list(APPEND GPP_ROOMS mapping)
  list(APPEND ros_rooms ros_mapping)
  list(APPEND GPP_NODES projected_map)
  list(APPEND GPP_CONFIGURATIONS ProjectedMap)
  list(APPEND GPP_EXPORTED_LIBRARIES OCTOMAP)
  list(APPEND GPP_LAUNCH_FILES perception_octomap)
endif()
if(GPP_WITH_simulation)
  list(APPEND GPP_FOLDERS simulation read_world)
  list(APPEND GPP_ROOMS simulation)
  list(APPEND ros_rooms ros_simulation)
  list(APPEND GPP_NODES simulator)
  list(APPEND GPP_CONFIGURATIONS Simulator)
  list(APPEND GPP_LAUNCH_FILES startup_simulation startup_vehicle_sim startup_vessel_sim)
  list(APPEND GPP_CATKIN_COMPONENTS rosgraph_msgs)
endif()
if(GPP_WITH_driving AND GPP_WITH_mapping AND GPP_WITH_simulation)
  list(APPEND GPP_LAUNCH_FILES demo)
endif()
if(GPP_WITH_avoidance AND GPP_WITH_mapping AND GPP_WITH_simulation AND GPP_WITH_study)
  list(APPEND GPP_FOLDERS flights)
  list(APPEND GPP_ROOMS flights)
endif()
if(GPP_WITH_driving OR GPP_WITH_mapping OR GPP_WITH_avoidance)
  list(APPEND GPP_CATKIN_COMPONENTS std_srvs)
  list(APPEND GPP_CATKIN_EXPORTS std_srvs)
endif()
list(APPEND GPP_FOLDERS ros nodes command_line)
list(APPEND GPP_ROOMS ${ros_rooms})
