// Rectangle maps as markers for rviz.
#pragma once

#include <ros/time.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "grid_path_planner/grid/grid_geometry.h"

namespace grid_path_planner::nodes {

// As many as rviz draws without delay; the first rectangles are the largest.
constexpr std::size_t kMostShownRectangles = 50000;
constexpr std::size_t kMostNumberedRectangles = 200;

// Namespaces "rectangles" (filled, a colour a number), "outlines" and "numbers" (from 1, of the
// first kMostNumberedRectangles, as large as they fit). The first marker deletes all that the
// topic showed before.
visualization_msgs::MarkerArray rectangleMarkers(const grid::GridGeometry& geometry,
                                                 const std::vector<grid::CellRect>& rectangles,
                                                 const std::string& frame_id,
                                                 const ros::Time& stamp);

}  // namespace grid_path_planner::nodes
