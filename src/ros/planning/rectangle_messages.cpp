#include "ros/planning/rectangle_messages.h"

#include <cstdint>
#include <limits>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/ros/occupancy_conversion.h"

namespace grid_path_planner::nodes {

using base::InputError;
using grid::CellRect;
using grid::GridGeometry;
using planners::RectangleGraph;
using planners::Touching;

namespace {

CellRectangle rectangleToMessage(const CellRect& rect) {
  CellRectangle message;
  message.column = static_cast<std::uint32_t>(rect.column);
  message.row = static_cast<std::uint32_t>(rect.row);
  message.width = static_cast<std::uint32_t>(rect.width);
  message.height = static_cast<std::uint32_t>(rect.height);
  return message;
}

// A number of rectangle `number` as this package counts.
int integerOf(std::uint32_t value, std::size_t number) {
  if (value > static_cast<std::uint32_t>(std::numeric_limits<int>::max()))
    throw InputError("rectangle " + std::to_string(number) + " has a number beyond any map, " +
                     std::to_string(value));
  return static_cast<int>(value);
}

CellRect rectangleFromMessage(const CellRectangle& message, std::size_t number) {
  return {integerOf(message.column, number), integerOf(message.row, number),
          integerOf(message.width, number), integerOf(message.height, number)};
}

}  // namespace

RectangleMap rectanglesToMessage(const GridGeometry& geometry,
                                 const std::vector<CellRect>& rectangles,
                                 const std::string& frame_id, const ros::Time& stamp) {
  RectangleMap message;
  message.header.frame_id = frame_id;
  message.header.stamp = stamp;
  message.info = geometryToMessage(geometry, stamp);
  message.rectangles.reserve(rectangles.size());
  for (const CellRect& rect : rectangles)
    if (!rect.empty()) message.rectangles.push_back(rectangleToMessage(rect));
  return message;
}

RectangleGraph rectanglesFromMessage(const RectangleMap& message, Touching touching) {
  const GridGeometry geometry = geometryFromMessage(message.info);
  std::vector<CellRect> rectangles;
  rectangles.reserve(message.rectangles.size());
  for (const CellRectangle& rect : message.rectangles)
    rectangles.push_back(rectangleFromMessage(rect, rectangles.size()));
  return RectangleGraph(geometry, std::move(rectangles), touching);
}

}  // namespace grid_path_planner::nodes
