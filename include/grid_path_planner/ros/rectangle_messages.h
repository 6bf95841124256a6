// Rectangle maps as messages and back.
//
//   publisher.publish(rectanglesToMessage(geometry, rectangles, "map", ros::Time::now()));
//   const RectangleMap map = rectangleMapFromMessage(message, Touching::BORDERS);   // InputError
//
// Rectangles -> message -> rectangles is the identity; of the geometry see occupancy_conversion.h.
//
// The class that is generated from RectangleMap.msg has the name of this package's own, so the two
// headers cannot meet in one file. Include this one instead of the generated one: here, and after
// it, the message is called RectangleMapMessage.
#pragma once

#define RectangleMap RectangleMapMessage
#include <grid_path_planner/RectangleMap.h>
#undef RectangleMap

#include <ros/time.h>

#include <string>
#include <vector>

#include "grid_path_planner/rectangles/rectangle_map.h"

namespace grid_path_planner {

// Empty rectangles are left out.
RectangleMapMessage rectanglesToMessage(const GridGeometry& geometry,
                                        const std::vector<CellRect>& rectangles,
                                        const std::string& frame_id, const ros::Time& stamp);

// Throws InputError for a geometry that cannot be, and naming the first rectangle that is empty,
// leaves the map or overlaps another.
RectangleMap rectangleMapFromMessage(const RectangleMapMessage& message, Touching touching);

}  // namespace grid_path_planner
