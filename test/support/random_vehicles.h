// Descriptions of random vehicles, and how far their outlines reach into a map, by Boost.Geometry.
#pragma once

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "grid_path_planner/grid/occupancy.h"
#include "vehicle/motion_model.h"

namespace grid_path_planner::test {

inline vehicle::Description randomDescription(std::mt19937& random) {
  std::uniform_real_distribution<double> part(0.0, 1.0);
  vehicle::Description robot;
  robot.drive = static_cast<vehicle::Drive>(1 + random() % 3);
  if (random() % 2 == 0) {
    robot.radius = 0.1 + 0.2 * part(random);
  } else {
    const auto text = [](double x, double y) {
      return "[" + std::to_string(x) + ", " + std::to_string(y) + "]";
    };
    const double front = 0.1 + 0.4 * part(random), rear = 0.1 + 0.2 * part(random);
    const double side = 0.1 + 0.1 * part(random);
    robot.outline = "[" + text(front, side) + ", " + text(-rear, side) + ", " + text(-rear, -side) +
                    ", " + text(front, -side) + "]";
  }
  robot.max_speed = 0.3 + part(random);
  const bool everywhere = robot.drive == vehicle::Drive::OMNIDIRECTIONAL;
  robot.max_backward_speed = !everywhere && random() % 2 == 0 ? 0.0 : 0.5 * robot.max_speed;
  if (everywhere) robot.max_sideways_speed = 0.1 + 0.5 * part(random);
  robot.max_yaw_rate = 0.5 + 1.5 * part(random);
  robot.max_acceleration = 0.5 + part(random);
  robot.max_yaw_acceleration = 1.0 + 2.0 * part(random);
  if (robot.drive == vehicle::Drive::CAR) robot.least_turning_radius = 0.3 + 0.5 * part(random);
  robot.dead_time = random() % 2 == 0 ? 0.0 : 0.2 * part(random);
  robot.time_constant = random() % 2 == 0 ? 0.0 : 0.2 * part(random);
  return robot;
}

// The depth in metres, about, to which the outline reaches into occupied cells (65 and more) at a pose; 0: it touches none. Of
// a disc exactly; of a polygon the root of the largest area that it shares with a cell.
inline double depthInCells(const vehicle::Description& robot, const vehicle::PlanarState& state,
                           const grid::OccupancyGrid& map) {
  namespace bg = boost::geometry;
  using Point = bg::model::d2::point_xy<double>;
  using Polygon = bg::model::polygon<Point, false>;
  using CellBox = bg::model::box<Point>;
  const double c = std::cos(state.yaw), s = std::sin(state.yaw);
  const double resolution = map.geometry().resolution();
  Polygon outline;
  const auto footprint = vehicle::Footprint::fromText("outline", robot.outline);
  for (const Eigen::Vector2d& p : footprint.corners()) {
    const Eigen::Vector2d turned(c * p.x() - s * p.y(), s * p.x() + c * p.y());
    const Eigen::Vector2d at = map.geometry().gridFromWorld(state.position + turned);
    bg::append(outline, Point(at.x(), at.y()));
  }
  bg::correct(outline);
  const Eigen::Vector2d centre = map.geometry().gridFromWorld(state.position);
  double deepest = 0.0;
  const double reach = 1.0 / resolution;  // cells: no outline is larger
  const auto index = [](double at, int size) {
    return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(size)));
  };
  for (int row = index(centre.y() - reach, map.height());
       row < index(centre.y() + reach, map.height()); ++row)
    for (int column = index(centre.x() - reach, map.width());
         column < index(centre.x() + reach, map.width()); ++column) {
      if (map.row(row)[column] < 65) continue;
      const CellBox cell(Point(column, row), Point(column + 1, row + 1));
      if (robot.radius > 0.0) {
        const double distance = bg::distance(Point(centre.x(), centre.y()), cell) * resolution;
        deepest = std::max(deepest, robot.radius - distance);
        continue;
      }
      std::vector<Polygon> shared;
      bg::intersection(outline, cell, shared);
      double area = 0.0;
      for (const Polygon& part : shared) area += bg::area(part);
      deepest = std::max(deepest, std::sqrt(area) * resolution);
    }
  return deepest;
}

}  // namespace grid_path_planner::test
