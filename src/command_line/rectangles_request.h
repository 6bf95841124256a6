// The options of `grid_path rectangles`.
#pragma once

#include <boost/program_options.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/planners/connections.h"
#include "grid_path_planner/planners/decomposition.h"
#include "grid_path_planner/planners/search_options.h"

namespace grid_path_planner::command_line {

struct RectanglesRequest {
  std::string map;
  grid::MapFileOptions reading;
  bool unknown_is_free = false;
  bool merged_runs = false;
  planners::DecompositionLimits limits;
  std::optional<planners::RectangleWeight> weight;
  planners::Touching touching = planners::Touching::BORDERS;
  std::int64_t memory_limit =  // MB
      static_cast<std::int64_t>(planners::memoryLimitOf({}) / 1000000);
};

// The options of the command line, with those of the output.
boost::program_options::options_description describeRectangles();

// Throws InputError naming the option.
RectanglesRequest rectanglesRequestFrom(const boost::program_options::variables_map& values);

}  // namespace grid_path_planner::command_line
