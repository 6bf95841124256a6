# Benchmarks: measured by hand. The tests build them and run each with little to do, so that they cannot rot; what
# they take is not judged.
#
# gpp_run_benchmark(<name> <argument>...)
function(gpp_run_benchmark name)
  add_test(NAME ${PROJECT_NAME}_benchmark_${name} COMMAND ${PROJECT_NAME}_${name} ${ARGN}
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(${PROJECT_NAME}_benchmark_${name} PROPERTIES LABELS benchmark TIMEOUT 120)
endfunction()

if(CATKIN_ENABLE_TESTING AND GPP_WITH_study AND GPP_WITH_mapping AND GPP_WITH_simulation)
  add_custom_target(${PROJECT_NAME}_benchmarks)
  file(GLOB benchmark_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/benchmark/*.cpp)
  foreach(source ${benchmark_sources})
    get_filename_component(name ${source} NAME_WE)
    add_executable(${PROJECT_NAME}_${name} EXCLUDE_FROM_ALL ${source})
    target_link_libraries(${PROJECT_NAME}_${name} PRIVATE
      ${PROJECT_NAME}_study ${PROJECT_NAME}_mapping ${PROJECT_NAME}_simulation
      ${PROJECT_NAME}_test_support)
    gpp_precompile_headers(${PROJECT_NAME}_${name} ${PROJECT_NAME}_base)
    add_dependencies(${PROJECT_NAME}_benchmarks ${PROJECT_NAME}_${name})
  endforeach()
  add_dependencies(tests ${PROJECT_NAME}_benchmarks)
  gpp_run_benchmark(cancel_latency 3 2)
  gpp_run_benchmark(depth_camera worlds/dexrov_site.sdf 3)
  gpp_run_benchmark(engine_cost_to_go --side 256 --goal 10,10)
  gpp_run_benchmark(engine_growth --sides 64 --densities 0.1)
  gpp_run_benchmark(engine_queries --list all)
  gpp_run_benchmark(map_updates maps/study_site.yaml --side 300 --rounds 1)
  gpp_run_benchmark(rectangle_decomposition maps/study_site.yaml 20)
  gpp_run_benchmark(rectangle_repair maps/study_site.yaml 200)
  gpp_run_benchmark(rectangle_tables maps)
  gpp_run_benchmark(replanning --side 128 --edits 20 --rounds 1)
endif()
