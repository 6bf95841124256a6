#include "support/kept_distance.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/linestring.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <cmath>

namespace grid_path_planner::test {

using grid::OccupancyGrid;

namespace {

namespace bg = boost::geometry;
using Point = bg::model::d2::point_xy<double>;
using Line = bg::model::linestring<Point>;
using Polygon = bg::model::polygon<Point>;

// The map's own frame: metres from its corner, along its sides.
Point inMapFrame(const Eigen::Vector2d& point, const OccupancyGrid& map) {
  const auto& origin = map.geometry().origin();
  const double x = point.x() - origin.x, y = point.y() - origin.y;
  return {std::cos(origin.yaw) * x + std::sin(origin.yaw) * y,
          -std::sin(origin.yaw) * x + std::cos(origin.yaw) * y};
}

Polygon box(double left, double bottom, double right, double top) {
  Polygon polygon;
  for (const Point& corner : {Point(left, bottom), Point(left, top), Point(right, top),
                              Point(right, bottom), Point(left, bottom)})
    bg::append(polygon.outer(), corner);
  return polygon;
}

bool keptFrom(std::int8_t value, const KeptFrom& from) {
  if (value >= 65) return from.occupied;
  return from.unknown && (value < 0 || value > 25);
}

double toCells(const Line& segment, const OccupancyGrid& map, const KeptFrom& from, double limit) {
  const double side = map.geometry().resolution();
  const auto cellOf = [side](double coordinate, int count) {
    return static_cast<int>(std::min(std::max(std::floor(coordinate / side), 0.0), count - 1.0));
  };
  const Point &a = segment.front(), &b = segment.back();
  const int left = cellOf(std::min(a.x(), b.x()) - limit, map.width());
  const int right = cellOf(std::max(a.x(), b.x()) + limit, map.width());
  const int bottom = cellOf(std::min(a.y(), b.y()) - limit, map.height());
  const int top = cellOf(std::max(a.y(), b.y()) + limit, map.height());
  double least = limit;
  for (int row = bottom; row <= top; ++row)
    for (int column = left; column <= right; ++column) {
      if (!keptFrom(map.row(row)[column], from)) continue;
      const Polygon square = box(column * side, row * side, (column + 1) * side, (row + 1) * side);
      least = std::min(least, double(bg::distance(segment, square)));
    }
  return least;
}

double toBorder(const Line& segment, const OccupancyGrid& map, double limit) {
  const double width = map.width() * map.geometry().resolution();
  const double height = map.height() * map.geometry().resolution();
  Line border;
  for (const Point& corner :
       {Point(0, 0), Point(width, 0), Point(width, height), Point(0, height), Point(0, 0)})
    bg::append(border, corner);
  const bool inside = bg::covered_by(segment, box(0, 0, width, height));
  return inside ? std::min(limit, double(bg::distance(segment, border))) : 0.0;
}

}  // namespace

double leastDistance(const std::vector<Eigen::Vector2d>& points, const OccupancyGrid& map,
                     const KeptFrom& from, double limit) {
  double least = limit;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Line segment;
    bg::append(segment, inMapFrame(points[i == 0 ? 0 : i - 1], map));
    bg::append(segment, inMapFrame(points[i], map));
    least = std::min(least, toCells(segment, map, from, least));
    if (from.border) least = std::min(least, toBorder(segment, map, least));
  }
  return least;
}

}  // namespace grid_path_planner::test
