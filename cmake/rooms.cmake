# A room is a folder of src/ (and include/, test/) with one idea; its CMakeLists finds the libraries that it
# needs and names the rooms below it.

# The headers of the standard library, Eigen, gtest and ROS are parsed once for many sources (doc/dependencies.md has
# what that saves). A source includes what it uses all the same: scripts/check_noetic compiles without these.
set(GPP_PRECOMPILED_HEADERS <algorithm> <array> <atomic> <cassert> <chrono> <cmath> <cstdint> <cstdio> <cstdlib>
  <cstring> <deque> <exception> <filesystem> <fstream> <functional> <iomanip> <iostream> <iterator> <limits> <map>
  <memory> <mutex> <numeric> <optional> <random> <set> <sstream> <stdexcept> <string> <string_view> <thread> <tuple>
  <type_traits> <unordered_map> <utility> <vector> <Eigen/Core> <Eigen/Geometry>)
set(GPP_PRECOMPILED_ROS_HEADERS <ros/ros.h> <ros/callback_queue.h> <nodelet/nodelet.h> <pluginlib/class_list_macros.hpp>
  <diagnostic_updater/diagnostic_updater.h> <dynamic_reconfigure/server.h> <tf2_ros/transform_listener.h>
  <tf2_geometry_msgs/tf2_geometry_msgs.h> <geometry_msgs/PoseStamped.h> <nav_msgs/OccupancyGrid.h> <nav_msgs/Path.h>
  <visualization_msgs/MarkerArray.h>)

option(GRID_PATH_PLANNER_UNITY_BUILD "Compile several sources of a library as one" ON)

# gpp_precompile_headers(<target> <owner>): the owner's precompiled headers; the owner itself makes them of
# ${ARGN}. All their users have equal options, so all are position-independent and define no symbol of their own.
function(gpp_precompile_headers target owner)
  set_target_properties(${target} PROPERTIES DEFINE_SYMBOL "")
  get_target_property(type ${target} TYPE)
  if(NOT type STREQUAL "SHARED_LIBRARY")
    target_compile_options(${target} PRIVATE -fPIC)
  endif()
  if(target STREQUAL owner)
    target_link_libraries(${target} PRIVATE Eigen3::Eigen)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  else()
    target_precompile_headers(${target} REUSE_FROM ${owner})
  endif()
endfunction()

# gpp_unite_sources(<target> <number> [<source apart>...]): so many sources are compiled as one, unless
# GRID_PATH_PLANNER_UNITY_BUILD is OFF.
function(gpp_unite_sources target number)
  if(GRID_PATH_PLANNER_UNITY_BUILD)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${number})
    set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
endfunction()

# gpp_add_room(<room> [FOLDER folder] [UNITY] [APART source...] [ROOMS room...] [LIBRARIES library...])
# The library grid_path_planner_<room> from all sources below src/<folder> (default: src/<room>).
# UNITY: several sources are compiled as one, so no two of them have a name of an anonymous namespace in common; not
# those that are named APART, where a class has members of such a type. costmap, grid and planners, whose
# speed counts most, are not built so.
function(gpp_add_room room)
  cmake_parse_arguments(ARG "UNITY" "FOLDER" "APART;ROOMS;LIBRARIES" ${ARGN})
  if(NOT ARG_FOLDER)
    set(ARG_FOLDER ${room})
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${ARG_FOLDER}/*.cpp)
  set(target ${PROJECT_NAME}_${room})
  add_library(${target} ${sources})
  target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR}/include PRIVATE ${PROJECT_SOURCE_DIR}/src)
  if(ARG_UNITY)
    gpp_unite_sources(${target} 16 ${ARG_APART})
  endif()
  foreach(below ${ARG_ROOMS})
    target_link_libraries(${target} PUBLIC ${PROJECT_NAME}_${below})
  endforeach()
  target_link_libraries(${target} PUBLIC ${ARG_LIBRARIES})
  if(room STREQUAL base)
    gpp_precompile_headers(${target} ${target} ${GPP_PRECOMPILED_HEADERS})
  elseif(room STREQUAL ros_guard)
    gpp_precompile_headers(${target} ${target} ${GPP_PRECOMPILED_HEADERS} ${GPP_PRECOMPILED_ROS_HEADERS})
  elseif(room MATCHES "^ros_")
    gpp_precompile_headers(${target} ${PROJECT_NAME}_ros_guard)
  else()
    gpp_precompile_headers(${target} ${PROJECT_NAME}_base)
  endif()
  set_property(GLOBAL APPEND PROPERTY GPP_ROOM_TARGETS ${target})
endfunction()

# gpp_add_sources_hash(<room> <rooms>...): gives the room's library sources_hash.h, a hash of the sources of those rooms,
# which decide how a run of its studies goes: one that was begun by other sources is not gone on with.
function(gpp_add_sources_hash room)
  set(globs)
  foreach(each ${ARGN})
    list(APPEND globs ${PROJECT_SOURCE_DIR}/src/${each}/*.cpp ${PROJECT_SOURCE_DIR}/src/${each}/*.h
      ${PROJECT_SOURCE_DIR}/include/${PROJECT_NAME}/${each}/*.h)
  endforeach()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${globs})
  string(REPLACE ";" "," rooms "${ARGN}")
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/generated)
  add_custom_command(OUTPUT ${folder}/sources_hash.h
    COMMAND ${CMAKE_COMMAND} -DROOT=${PROJECT_SOURCE_DIR} -DROOMS=${rooms} -DOUTPUT=${folder}/sources_hash.h
      -P ${PROJECT_SOURCE_DIR}/cmake/hash_sources.cmake
    DEPENDS ${sources} ${PROJECT_SOURCE_DIR}/cmake/hash_sources.cmake)
  target_sources(${PROJECT_NAME}_${room} PRIVATE ${folder}/sources_hash.h)
  target_include_directories(${PROJECT_NAME}_${room} PRIVATE ${folder})
endfunction()

# gpp_add_executable(<name> <source> <library...>): target with the package's prefix, file with the short name.
function(gpp_add_executable name source)
  set(target ${PROJECT_NAME}_${name})
  add_executable(${target} ${source})
  set_target_properties(${target} PROPERTIES OUTPUT_NAME ${name})
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  foreach(library ${ARGN})
    target_link_libraries(${target} PRIVATE ${PROJECT_NAME}_${library})
  endforeach()
  set_property(GLOBAL APPEND PROPERTY GPP_EXECUTABLES ${target})
endfunction()

# gpp_set_computing(<test>...): these compute all the time, while those with a roscore mostly wait. They begin
# first, and no more of them run at a time than half as many as there are cores, so that others keep their deadlines.
function(gpp_set_computing)
  cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)
  math(EXPR half "(${cores} + 1) / 2")
  foreach(test ${ARGN})
    set_property(GLOBAL APPEND PROPERTY GPP_COMPUTING_TESTS ${test})
    get_property(tests GLOBAL PROPERTY GPP_COMPUTING_TESTS)
    list(LENGTH tests number)
    math(EXPR turn "${number} % ${half}")
    set_tests_properties(${test} PROPERTIES COST 1000 RESOURCE_LOCK computing_${turn})
  endforeach()
endfunction()

# gpp_add_shards(<target> <number>): so many tests of ctest, each of which runs its share of a gtest program's.
function(gpp_add_shards target number)
  foreach(shard RANGE 1 ${number})
    math(EXPR index "${shard} - 1")
    set(name _ctest_${PROJECT_NAME}_gtest_${target}_${shard}_of_${number})  # as catkin names the others
    add_test(NAME ${name} COMMAND ${target} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
    set_tests_properties(${name} PROPERTIES ENVIRONMENT
      "GTEST_TOTAL_SHARDS=${number};GTEST_SHARD_INDEX=${index};GTEST_OUTPUT=xml:${CATKIN_TEST_RESULTS_DIR}/${PROJECT_NAME}/${name}.xml")
    gpp_set_computing(${name})
  endforeach()
endfunction()

# gpp_add_room_test(<room> [<libraries>] [PRECOMPILED owner] [SHARDS number]): all *_test.cpp below test/<room> as one gtest
# program, sixteen of them compiled as one. Its precompiled headers are those of test_support, or the owner's. Where its tests
# take more than a minute of CPU, so many tests of ctest run a share of them each.
function(gpp_add_room_test room)
  cmake_parse_arguments(ARG "" "PRECOMPILED;SHARDS" "" ${ARGN})
  if(NOT ARG_PRECOMPILED)
    set(ARG_PRECOMPILED ${PROJECT_NAME}_test_support)
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/${room}/*_test.cpp)
  set(target ${PROJECT_NAME}_${room}_test)
  if(ARG_SHARDS)
    catkin_add_executable_with_gtest(${target} ${sources} EXCLUDE_FROM_ALL)
  else()
    catkin_add_gtest(${target} ${sources} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  endif()
  if(TARGET ${target})
    foreach(library ${ARG_UNPARSED_ARGUMENTS})
      target_link_libraries(${target} ${PROJECT_NAME}_${library})
    endforeach()
    target_link_libraries(${target} ${PROJECT_NAME}_test_support gtest gtest_main)
    gpp_precompile_headers(${target} ${ARG_PRECOMPILED})
    gpp_unite_sources(${target} 16)
    if(ARG_SHARDS)
      add_dependencies(tests ${target})
      gpp_add_shards(${target} ${ARG_SHARDS})
    else()
      gpp_set_computing(_ctest_${PROJECT_NAME}_gtest_${target})
    endif()
  endif()
endfunction()
