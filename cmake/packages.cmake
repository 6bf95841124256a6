# Packages for Debian and Ubuntu, a .deb a component and one of grid_path (`commands`), of what cmake/install.cmake installs:
#
#   scripts/build --packages FOLDER      # or `cpack -G DEB` in a folder that was built
#
# They install below /opt/ros/noetic, where that is, else below /usr. What a package needs of the system is read from its
# programs and libraries by dpkg-shlibdeps, what it needs of the others from what is linked; programs in Python and the
# messages of others are named here.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME grid-path-planner)
set(CPACK_PACKAGE_CONTACT "the grid_path_planner developers <maintainers@users.noreply.github.com>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Path planning for vehicles on occupancy grids (ROS 1)")
set(CPACK_PACKAGE_DESCRIPTION "Nodes, libraries and launch files of the ROS 1 package grid_path_planner.")
set(CPACK_DEBIAN_PACKAGE_SECTION misc)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CATKIN_DEVEL_PREFIX}/lib)  # of CMake 3.20, which finds the others so
set(CPACK_STRIP_FILES ON)

set(runtime_planning python3-roslaunch rosbash python3-rosbag python3-rospy python3-rostopic python3-rosservice
  python3-rosnode python3-rosparam python3-geometry-msgs python3-nav-msgs python3-rosgraph-msgs python3-std-msgs python3-std-srvs)
set(runtime_rviz rviz)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
if(EXISTS /opt/ros/noetic)
  set(CPACK_PACKAGE_NAME ros-noetic-grid-path-planner)
  set(CPACK_PACKAGING_INSTALL_PREFIX /opt/ros/noetic)
  set(runtime_planning ros-noetic-roslaunch ros-noetic-rosbash ros-noetic-rosbag ros-noetic-rospy ros-noetic-rostopic
    ros-noetic-rosservice ros-noetic-rosnode ros-noetic-rosparam ros-noetic-geometry-msgs ros-noetic-nav-msgs ros-noetic-rosgraph-msgs
    ros-noetic-std-msgs ros-noetic-std-srvs)
  set(runtime_rviz ros-noetic-rviz)
endif()

# gpp_rooms_below(<variable> <target>): the rooms that it is linked with, static libraries in between included.
function(gpp_rooms_below variable target)
  set(found)
  get_target_property(linked ${target} LINK_LIBRARIES)
  foreach(library ${linked})
    if(library IN_LIST rooms)
      list(APPEND found ${library})
    elseif(library MATCHES "^${PROJECT_NAME}_" AND TARGET ${library})
      gpp_rooms_below(further ${library})
      list(APPEND found ${further})
    endif()
  endforeach()
  set(${variable} ${found} PARENT_SCOPE)
endfunction()

set(CPACK_COMPONENTS_ALL)
foreach(target ${rooms} ${executables})
  gpp_component_of(component ${target})
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  gpp_rooms_below(below ${target})
  foreach(room ${below})
    gpp_component_of(other ${room})
    list(APPEND needs_${component} ${other})
  endforeach()
endforeach()
list(REMOVE_DUPLICATES CPACK_COMPONENTS_ALL)
foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} upper)
  list(APPEND needs_${component} planning)
  list(REMOVE_DUPLICATES needs_${component})
  list(REMOVE_ITEM needs_${component} ${component})
  set(CPACK_COMPONENT_${upper}_DEPENDS ${needs_${component}})
  list(JOIN runtime_${component} ", " CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS)
endforeach()
# Launch files that start nodes of several components are those of simulation.
set(recommended)
foreach(component driving mapping avoidance localization)
  if(component IN_LIST CPACK_COMPONENTS_ALL)
    list(APPEND recommended ${CPACK_PACKAGE_NAME}-${component})
  endif()
endforeach()
list(JOIN recommended ", " CPACK_DEBIAN_SIMULATION_PACKAGE_RECOMMENDS)
include(CPack)
