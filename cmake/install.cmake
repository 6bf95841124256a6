# What an install space gets: everything that `roslaunch grid_path_planner demo.launch` and a package
# that builds on the libraries need.
get_property(rooms GLOBAL PROPERTY GPP_ROOM_TARGETS)
get_property(executables GLOBAL PROPERTY GPP_EXECUTABLES)
install(TARGETS ${rooms}
  ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  RUNTIME DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION})
install(TARGETS ${executables} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
foreach(folder ${GPP_FOLDERS})
  if(IS_DIRECTORY ${PROJECT_SOURCE_DIR}/include/${PROJECT_NAME}/${folder})
    install(DIRECTORY include/${PROJECT_NAME}/${folder} DESTINATION ${CATKIN_PACKAGE_INCLUDE_DESTINATION})
  endif()
endforeach()
install(DIRECTORY config rviz maps urdf worlds DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
foreach(name ${GPP_LAUNCH_FILES})
  install(FILES launch/${name}.launch DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/launch)
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
  install(FILES rviz_plugins.xml DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
endif()
catkin_install_python(PROGRAMS scripts/demo_run.py scripts/flight_demo_run.py scripts/ros_session.py scripts/rviz_on_map
  DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
