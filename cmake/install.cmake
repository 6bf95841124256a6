# What an install space gets: everything that `roslaunch grid_path_planner demo.launch` and a package
# that builds on the libraries need.
# `cmake --install build --component driving` installs a component alone; cmake/packages.cmake makes packages of them.
get_property(rooms GLOBAL PROPERTY GPP_ROOM_TARGETS)
get_property(executables GLOBAL PROPERTY GPP_EXECUTABLES)
set(GPP_COMPONENT_OF_grid_path commands)
set(GPP_COMPONENT_OF_read_world simulation)

# gpp_component_of(<variable> <item>): the component that a room, a program or a launch file is installed with.
function(gpp_component_of variable item)
  set(is_target FALSE)
  if(item MATCHES "^${PROJECT_NAME}_")
    set(is_target TRUE)
  endif()
  string(REGEX REPLACE "^${PROJECT_NAME}_" "" item ${item})
  set(component ${CMAKE_INSTALL_DEFAULT_COMPONENT_NAME})
  # The room vehicle is of planning, the launch file of that name of simulation.
  if(DEFINED GPP_COMPONENT_OF_${item} AND NOT (is_target AND item IN_LIST GPP_PLANNING_ROOMS))
    set(component ${GPP_COMPONENT_OF_${item}})
  endif()
  set(${variable} ${component} PARENT_SCOPE)
endfunction()

foreach(room ${rooms})
  gpp_component_of(component ${room})
  install(TARGETS ${room} COMPONENT ${component}
    ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
    LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
    RUNTIME DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION})
endforeach()
foreach(executable ${executables})
  gpp_component_of(component ${executable})
  install(TARGETS ${executable} COMPONENT ${component} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
endforeach()
foreach(folder ${GPP_FOLDERS})
  if(IS_DIRECTORY ${PROJECT_SOURCE_DIR}/include/${PROJECT_NAME}/${folder})
    gpp_component_of(component ${folder})
    install(DIRECTORY include/${PROJECT_NAME}/${folder} COMPONENT ${component}
      DESTINATION ${CATKIN_PACKAGE_INCLUDE_DESTINATION})
  endif()
endforeach()
install(DIRECTORY config rviz maps urdf worlds DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
foreach(name ${GPP_LAUNCH_FILES})
  gpp_component_of(component ${name})
  install(FILES launch/${name}.launch COMPONENT ${component} DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/launch)
endforeach()

# nodelet_plugins.xml without the libraries of components that are not built
file(STRINGS nodelet_plugins.xml lines)
set(nodelet_plugins)
set(keep TRUE)
foreach(line IN LISTS lines)
  if(line MATCHES "<library path=\"lib/lib${PROJECT_NAME}_([a-z_]+)\"" AND NOT CMAKE_MATCH_1 IN_LIST GPP_ROOMS)
    set(keep FALSE)
  endif()
  if(keep)
    string(APPEND nodelet_plugins "${line}\n")
  endif()
  if(line MATCHES "</library>")
    set(keep TRUE)
  endif()
endforeach()
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/nodelet_plugins.xml "${nodelet_plugins}")
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/nodelet_plugins.xml DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
if(GPP_ADAPTERS)
  install(FILES planner_plugins.xml DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
endif()
if(GPP_WITH_rviz)
  install(FILES rviz_plugins.xml COMPONENT rviz DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
endif()
catkin_install_python(PROGRAMS scripts/demo_run.py scripts/flight_demo_run.py scripts/localization_demo_run.py
  scripts/rviz_on_map
  DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(FILES scripts/ros_session.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})  # of those
