# What repeats the options of the nodes is made by one program, option_files, from their visitOptions: the .cfg
# files of dynamic_reconfigure in the build folder, config/<node>.yaml and the tables of the documentation in the
# source folder (committed; a test says when they are out of date).

# gpp_make_configurations(<variable> <config>...): <variable> lists <config>.cfg of each, made when built.
function(gpp_make_configurations variable)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/cfg)
  file(MAKE_DIRECTORY ${folder})
  set(configurations)
  foreach(config ${ARGN})
    list(APPEND configurations ${folder}/${config}.cfg)
  endforeach()
  add_custom_command(OUTPUT ${configurations}
    COMMAND ${PROJECT_NAME}_option_files cfg ${folder}
    DEPENDS ${PROJECT_NAME}_option_files
    COMMENT "Generating .cfg files from the options of the nodes")
  set(${variable} ${configurations} PARENT_SCOPE)
endfunction()

# gpp_add_option_files(): the program. It is built before the headers of dynamic_reconfigure, and describes all
# nodes whatever components are built, so it takes of the rooms above only the sources that name choices.
function(gpp_add_option_files)
  set(folder ${PROJECT_SOURCE_DIR}/src)
  add_library(${PROJECT_NAME}_option_texts STATIC ${folder}/option_files/option_files.cpp)
  target_include_directories(${PROJECT_NAME}_option_texts PUBLIC ${folder})
  target_link_libraries(${PROJECT_NAME}_option_texts PUBLIC ${PROJECT_NAME}_base)
  gpp_precompile_headers(${PROJECT_NAME}_option_texts ${PROJECT_NAME}_base)
  set(target ${PROJECT_NAME}_option_files)
  add_executable(${target} ${folder}/option_files/main.cpp ${folder}/avoidance/pilot_options.cpp
    ${folder}/following/follower_options.cpp ${folder}/localization/filter_options.cpp
    ${folder}/layers/map_layers_options.cpp ${folder}/mapping/projection_options.cpp
    ${folder}/ros/input/input_rules.cpp ${folder}/ros/planning/path_planner_options.cpp
    ${folder}/simulation/sensors/laser_options.cpp ${folder}/vision/marker_pose_options.cpp)
  set_target_properties(${target} PROPERTIES OUTPUT_NAME option_files
    RUNTIME_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})  # not beside the nodes: it is a tool of the build
  target_link_libraries(${target} PRIVATE ${PROJECT_NAME}_option_texts ${PROJECT_NAME}_planning)
  gpp_precompile_headers(${target} ${PROJECT_NAME}_base)
  add_custom_target(${PROJECT_NAME}_write_options
    COMMAND ${target} write ${PROJECT_SOURCE_DIR}
    COMMENT "Writing config/ and the tables of the documentation")
endfunction()
