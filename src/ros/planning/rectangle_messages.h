// Rectangle maps as messages and back.
//
//   publisher.publish(rectanglesToMessage(geometry, rectangles, "map", ros::Time::now()));
//   const RectangleGraph map = rectanglesFromMessage(message, Touching::BORDERS);   // InputError
//
// Rectangles -> message -> rectangles is the identity; for the geometry see occupancy_conversion.h.
#pragma once

#include <grid_path_planner/RectangleMap.h>
#include <ros/time.h>

#include <string>
#include <vector>

#include "grid_path_planner/planners/rectangle_graph.h"

namespace grid_path_planner::nodes {

// Empty rectangles are left out.
RectangleMap rectanglesToMessage(const grid::GridGeometry& geometry,
                                 const std::vector<grid::CellRect>& rectangles,
                                 const std::string& frame_id, const ros::Time& stamp);

// Throws InputError for an invalid geometry, and one that names the first rectangle that is empty,
// reaches outside the map or overlaps another.
planners::RectangleGraph rectanglesFromMessage(const RectangleMap& message,
                                               planners::Touching touching);

}  // namespace grid_path_planner::nodes
