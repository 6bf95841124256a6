// A map cut into rectangles, and what `grid_path rectangles` tells of it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/rectangles/map_sizes.h"
#include "grid_path_planner/rectangles/rectangle_graph.h"
#include "rectangle_question.h"

namespace grid_path_planner::tools {

struct RectangleAnswer {
  std::vector<CellRect> in_file;  // rows as the file has them
  RectangleGraph map;             // the same, in the same order, rows as in Cell
  MapSizes sizes;
  double time_ms = 0.0;
};

// Cut as the file has its rows, since the order among equal rectangles depends on it: the same
// picture gives the same rectangles in any format. Throws InputError where the map needs more than
// question.memory_limit, before that is taken.
RectangleAnswer answerOf(const RectangleQuestion& question, const OccupancyGrid& map);

// Of the step over one of `from`'s connections.
double weightOf(const RectangleGraph& map, RectangleWeight weight, std::uint32_t from,
                const Connection& step);

// Calls visit(from, connection) for each, which is twice for every border.
template <class Visit>
void visitConnections(const RectangleGraph& map, Visit&& visit) {
  for (std::uint32_t from = 0; from < map.rectangles().size(); ++from)
    for (const Connection& step : map.connections().of(from)) visit(from, step);
}

// Between its outer corners, in cells.
Eigen::Vector2d centreOf(const CellRect& rect);

}  // namespace grid_path_planner::tools
