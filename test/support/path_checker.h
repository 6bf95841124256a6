// What is wrong with a path, in words: an implementation of its own, brute and simple, that shares
// no code with the planners it judges.
//
//   EXPECT_EQ(pathViolations(path, start, goal, map, rules), kNoViolations);
//
// A path is right where its ends are the poses asked for, no two poses that follow each other
// coincide (but for the two of a turn or a climb on the spot), every number is finite, and every
// segment is legal at full resolution: it meets no blocked cell's interior, does not run between
// two blocked cells, and passes no lattice point whose diagonal pair is blocked (an end that was
// asked for may lie on one), while grazing a corner is legal. A cell is blocked by its class,
// outside the map, or where its centre is nearer than `radius` to the edge of an occupied cell.
// Segments are compared with every cell of their bounding box, not sampled.
#pragma once

#include <string>
#include <vector>

#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/path/path.h"

namespace grid_path_planner::test {

struct PathRules {
  grid::OccupancyThresholds thresholds;
  double radius = 0.0;  // m
  bool unknown_is_passable = true;
  bool occupied_is_passable = false;
  bool cut_corners = false;  // lattice points are not looked at
  // In cells: how deep a segment may cut into a corner or an edge before it counts. Rounding in
  // world coordinates, and the 1/4096 cell to which planners may round points, stay below.
  double slack = 1.0 / 2048.0;
};

const std::vector<std::string> kNoViolations;

// The path's yaw at its first pose is a matter of the heading mode and not judged, nor are heights
// but for being finite.
std::vector<std::string> pathViolations(const path::Path& path, const path::Pose& start,
                                        const path::Pose& goal, const grid::OccupancyGrid& map,
                                        const PathRules& rules = {});

}  // namespace grid_path_planner::test
