// Options of planner rectangle_map.
#pragma once

#include <utility>
#include <vector>

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::planners {

// What rectangle_map's search adds up (rectangles/rectangle_route.h).
enum class RectangleWeight { AREA, BORDER, DISTANCE, CONNECTIONS, LENGTH };
const std::vector<std::pair<const char*, RectangleWeight>>& choicesOf(RectangleWeight);

struct RectangleMapOptions {
  RectangleWeight rectangle_weight = RectangleWeight::LENGTH;
  bool rectangle_funnel = true;
};

template <class Visitor>
void visitOptions(RectangleMapOptions& o, Visitor&& visit) {
  visit("rectangle_weight", o.rectangle_weight,
        base::OptionInfo{
            "What rectangle_map adds up from rectangle to rectangle; all but length are the "
            "published ones and may lead far around",
            ""});
  visit("rectangle_funnel", o.rectangle_funnel,
        base::OptionInfo{
            "Whether rectangle_map pulls its path taut; false: through the middles of the "
            "borders, as published",
            ""});
}

}  // namespace grid_path_planner::planners
