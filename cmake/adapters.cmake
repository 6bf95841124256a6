# Plugins of the planner for programs that are not ours. Each is built where its interface is in the workspace, or
# below it, when this is configured: their packages are not in Debian.
#
#   move_base        grid_path_planner/GridPathPlanner, a nav_core::BaseGlobalPlanner: needs nav_core, costmap_2d
#   move_base_flex   grid_path_planner/GridPathPlanner, a mbf_costmap_core::CostmapPlanner: needs mbf_costmap_core
#
# Sets GPP_ADAPTERS, those that are built; with -DGRID_PATH_PLANNER_ADAPTERS=OFF none is.
option(GRID_PATH_PLANNER_ADAPTERS "Build the plugins for move_base and Move Base Flex where these are" ON)
set(GPP_ADAPTERS)

# gpp_find_adapter(<adapter> <package>...): adds it where all packages are found.
macro(gpp_find_adapter adapter)
  set(missing)
  foreach(package ${ARGN})
    find_package(${package} QUIET)
    if(NOT ${package}_FOUND)
      list(APPEND missing ${package})
    endif()
  endforeach()
  if(missing)
    string(REPLACE ";" " and " missing "${missing}")
    message(STATUS "Planner plugin for ${adapter}: not built, without ${missing}")
    set_property(GLOBAL APPEND PROPERTY GPP_LEFT_OUT "${adapter}'s plugin without ${missing}")
  else()
    message(STATUS "Planner plugin for ${adapter}: built")
    list(APPEND GPP_ADAPTERS ${adapter})
  endif()
endmacro()

if(GRID_PATH_PLANNER_ADAPTERS)
  gpp_find_adapter(move_base nav_core costmap_2d)
  gpp_find_adapter(move_base_flex mbf_costmap_core costmap_2d)
endif()
