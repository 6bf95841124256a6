# What an install space gets: everything that `roslaunch grid_path_planner demo.launch` and a package
# that builds on the libraries need.
get_property(rooms GLOBAL PROPERTY GPP_ROOM_TARGETS)
get_property(executables GLOBAL PROPERTY GPP_EXECUTABLES)
install(TARGETS ${rooms}
  ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  RUNTIME DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION})
install(TARGETS ${executables} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(DIRECTORY include/${PROJECT_NAME}/ DESTINATION ${CATKIN_PACKAGE_INCLUDE_DESTINATION})
install(DIRECTORY launch config rviz maps urdf worlds DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
install(FILES nodelet_plugins.xml DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
catkin_install_python(PROGRAMS scripts/demo_run.py scripts/ros_session.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
