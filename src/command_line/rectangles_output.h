// The output of `grid_path rectangles`: JSON, text and picture.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "command_line/rectangles_result.h"

namespace grid_path_planner::command_line {

// Rectangles, sizes, and with request.weight the weight of every connection.
nlohmann::json jsonOf(const RectanglesRequest& request, const RectanglesResult& result);

// Text on the standard output, with the first few connections where there are many.
void print(const RectanglesRequest& request, const RectanglesResult& result);

// The rectangles on `map`, with request.weight the connections too. Throws InputError naming the
// file.
void draw(const std::string& file, const RectanglesRequest& request, const RectanglesResult& result,
          const grid::OccupancyGrid& map);

}  // namespace grid_path_planner::command_line
