# Benchmarks: measured by hand, built on demand (cmake --build build --target grid_path_planner_benchmarks).
if(CATKIN_ENABLE_TESTING AND GPP_WITH_study AND GPP_WITH_mapping AND GPP_WITH_simulation)
  add_custom_target(${PROJECT_NAME}_benchmarks)
  file(GLOB benchmark_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/benchmark/*.cpp)
  foreach(source ${benchmark_sources})
    get_filename_component(name ${source} NAME_WE)
    add_executable(${PROJECT_NAME}_${name} EXCLUDE_FROM_ALL ${source})
    target_link_libraries(${PROJECT_NAME}_${name} PRIVATE
      ${PROJECT_NAME}_study ${PROJECT_NAME}_mapping ${PROJECT_NAME}_simulation
      ${PROJECT_NAME}_test_support)
    add_dependencies(${PROJECT_NAME}_benchmarks ${PROJECT_NAME}_${name})
  endforeach()
endif()
