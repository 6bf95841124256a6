// What `grid_path rectangles` is asked.
#pragma once

#include <boost/program_options.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/rectangles/connections.h"
#include "grid_path_planner/rectangles/decomposition.h"
#include "grid_path_planner/search/search_options.h"

namespace grid_path_planner::tools {

struct RectangleQuestion {
  std::string map;
  MapFileOptions reading;
  bool unknown_is_free = false;
  bool merged_runs = false;
  DecompositionLimits limits;
  std::optional<RectangleWeight> weight;
  Touching touching = Touching::BORDERS;
  std::int64_t memory_limit = SearchOptions().memory_limit;  // MB
};

// The options of the command line, those of what it writes among them.
boost::program_options::options_description describeRectangles();

// Throws InputError naming the option.
RectangleQuestion rectangleQuestionFrom(const boost::program_options::variables_map& values);

}  // namespace grid_path_planner::tools
