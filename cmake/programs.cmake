# Executables: a node is a main of a few lines around a class of the ros room; the command line is
# made of all of src/tools.
foreach(node path_planner navigate_path map_publisher simulator)
  if(EXISTS ${PROJECT_SOURCE_DIR}/src/nodes/${node}.cpp)
    gpp_add_executable(${node} src/nodes/${node}.cpp ros)
  endif()
endforeach()

file(GLOB tool_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/tools/*.cpp)
if(tool_sources)
  gpp_add_executable(grid_path "${tool_sources}" ros)
  target_link_libraries(${PROJECT_NAME}_grid_path PRIVATE Boost::program_options nlohmann_json::nlohmann_json)
endif()
