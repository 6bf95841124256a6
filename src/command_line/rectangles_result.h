// A map cut into rectangles, with the figures that `grid_path rectangles` prints.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "command_line/rectangles_request.h"
#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/planners/map_sizes.h"
#include "grid_path_planner/planners/rectangle_graph.h"

namespace grid_path_planner::command_line {

struct RectanglesResult {
  std::vector<grid::CellRect> in_file;  // rows as the file has them
  planners::RectangleGraph map;         // the same, in the same order, rows as in Cell
  planners::MapSizes sizes;
  double time_ms = 0.0;
};

// Cuts the rows in the file's order, since the order among equal rectangles depends on it: the same
// picture gives the same rectangles in any format. Throws InputError where the map needs more than
// request.memory_limit, before that is taken.
RectanglesResult cutIntoRectangles(const RectanglesRequest& request,
                                   const grid::OccupancyGrid& map);

// The weight of the step over one of `from`'s connections.
double weightOf(const planners::RectangleGraph& map, planners::RectangleWeight weight,
                std::uint32_t from, const planners::Connection& step);

// Calls visit(from, connection) for each connection: twice for every border.
template <class Visit>
void visitConnections(const planners::RectangleGraph& map, Visit&& visit) {
  for (std::uint32_t from = 0; from < map.rectangles().size(); ++from)
    for (const planners::Connection& step : map.connections().of(from)) visit(from, step);
}

// The middle between its outer corners, in cells.
Eigen::Vector2d centreOf(const grid::CellRect& rect);

}  // namespace grid_path_planner::command_line
