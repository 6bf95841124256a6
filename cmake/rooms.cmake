# A room is a folder of include/, src/ and test/ with one idea; its link line names the floors below.

# gpp_add_room(<room> [ROOMS room...] [LIBRARIES library...])
# The library grid_path_planner_<room> from src/<room>/*.cpp.
function(gpp_add_room room)
  cmake_parse_arguments(ARG "" "" "ROOMS;LIBRARIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${room}/*.cpp)
  set(target ${PROJECT_NAME}_${room})
  add_library(${target} ${sources})
  target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR}/include)
  foreach(below ${ARG_ROOMS})
    target_link_libraries(${target} PUBLIC ${PROJECT_NAME}_${below})
  endforeach()
  target_link_libraries(${target} PUBLIC ${ARG_LIBRARIES})
  set_property(GLOBAL APPEND PROPERTY GPP_ROOMS ${target})
endfunction()

# gpp_add_executable(<name> <source> <room>): target with the package's prefix, file with the short name.
function(gpp_add_executable name source room)
  set(target ${PROJECT_NAME}_${name})
  add_executable(${target} ${source})
  set_target_properties(${target} PROPERTIES OUTPUT_NAME ${name})
  target_link_libraries(${target} PRIVATE ${PROJECT_NAME}_${room})
  set_property(GLOBAL APPEND PROPERTY GPP_EXECUTABLES ${target})
endfunction()

# gpp_add_room_test(<room> [rooms...]): all of test/<room>/*_test.cpp as one gtest program.
function(gpp_add_room_test room)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/${room}/*_test.cpp)
  if(NOT sources)
    return()
  endif()
  set(target ${PROJECT_NAME}_${room}_test)
  catkin_add_gtest(${target} ${sources} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  if(TARGET ${target})
    target_link_libraries(${target} ${PROJECT_NAME}_${room} ${PROJECT_NAME}_test_support gtest gtest_main)
  endif()
endfunction()

# gpp_add_rostest(<name>): test/ros/<name>.test with the gtest of test/ros/<name>_rostest.cpp, which the
# launch file names as type="grid_path_planner_<name>_rostest". Each has a roscore on a free port of
# its own, so they may run side by side; logs stay in the build folder.
function(gpp_add_rostest name)
  set(target ${PROJECT_NAME}_${name}_rostest)
  add_rostest_gtest(${target} ${PROJECT_SOURCE_DIR}/test/ros/${name}.test
    ${PROJECT_SOURCE_DIR}/test/ros/${name}_rostest.cpp
    ${PROJECT_SOURCE_DIR}/test/ros/support/rostest_main.cpp)
  if(TARGET ${target})
    target_link_libraries(${target} ${PROJECT_NAME}_ros ${PROJECT_NAME}_test_support)
    target_compile_definitions(${target} PRIVATE
      GPP_TEST_DATA="${PROJECT_SOURCE_DIR}/test/data" GPP_DEVEL="${CATKIN_DEVEL_PREFIX}")
    set_tests_properties(_ctest_${PROJECT_NAME}_rostest_test_ros_${name}.test PROPERTIES TIMEOUT 120
      ENVIRONMENT "ROS_HOME=${CMAKE_BINARY_DIR}/ros_home;ROS_LOG_DIR=${CMAKE_BINARY_DIR}/ros_home/log;ROS_HOSTNAME=localhost")
  endif()
endfunction()
