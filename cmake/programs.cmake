# Executables: a node is a main of a few lines around a class of the ros room; the command line is
# made of all of src/tools.
foreach(node path_planner navigate_path map_publisher projected_map simulator teleop_joy)
  if(EXISTS ${PROJECT_SOURCE_DIR}/src/nodes/${node}.cpp)
    gpp_add_executable(${node} src/nodes/${node}.cpp ros)
  endif()
endforeach()

# The commands are a library, so that tests call them without a process.
file(GLOB command_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/tools/*.cpp)
list(REMOVE_ITEM command_sources ${PROJECT_SOURCE_DIR}/src/tools/main.cpp)
find_package(MPI QUIET COMPONENTS CXX)  # optional: `grid_path study` on several machines
if(NOT MPI_CXX_FOUND)
  list(REMOVE_ITEM command_sources ${PROJECT_SOURCE_DIR}/src/tools/mpi_workers.cpp)
endif()
add_library(${PROJECT_NAME}_commands STATIC ${command_sources})
target_include_directories(${PROJECT_NAME}_commands PUBLIC ${PROJECT_SOURCE_DIR}/src/tools)
target_link_libraries(${PROJECT_NAME}_commands PUBLIC ${PROJECT_NAME}_ros Boost::program_options
  nlohmann_json::nlohmann_json)
if(MPI_CXX_FOUND)
  target_compile_definitions(${PROJECT_NAME}_commands PRIVATE GPP_HAVE_MPI OMPI_SKIP_MPICXX)
  target_link_libraries(${PROJECT_NAME}_commands PUBLIC MPI::MPI_CXX)
endif()
gpp_add_executable(grid_path src/tools/main.cpp commands)

# Benchmarks: measured by hand, built on demand (cmake --build build --target grid_path_planner_benchmarks).
add_custom_target(${PROJECT_NAME}_benchmarks)
file(GLOB benchmark_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/benchmark/*.cpp)
foreach(source ${benchmark_sources})
  get_filename_component(name ${source} NAME_WE)
  add_executable(${PROJECT_NAME}_${name} EXCLUDE_FROM_ALL ${source})
  target_link_libraries(${PROJECT_NAME}_${name} PRIVATE
    ${PROJECT_NAME}_study ${PROJECT_NAME}_octree ${PROJECT_NAME}_simulation
    ${PROJECT_NAME}_test_support)
  add_dependencies(${PROJECT_NAME}_benchmarks ${PROJECT_NAME}_${name})
endforeach()
