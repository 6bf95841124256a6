// What `grid_path rectangles` says and draws.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "command_line/rectangles_result.h"

namespace grid_path_planner::command_line {

// All of it: rectangles, sizes, and with question.weight the weight of every connection.
nlohmann::json jsonOf(const RectangleQuestion& question, const RectangleAnswer& answer);

// Sentences on the standard output; of the connections a few, unless there are no more.
void print(const RectangleQuestion& question, const RectangleAnswer& answer);

// The rectangles on `map`, with question.weight the connections too. Throws InputError naming the
// file.
void draw(const std::string& file, const RectangleQuestion& question, const RectangleAnswer& answer,
          const grid::OccupancyGrid& map);

}  // namespace grid_path_planner::command_line
