#include "planning/path_ends.h"

#include <sstream>
#include <vector>

#include "grid_path_planner/planning/nearest_cell.h"
#include "planning/message_text.h"

namespace grid_path_planner::planning {

using base::Status;
using costmap::CostmapOptions;
using grid::Cell, grid::GridGeometry, grid::Occupancy;
using path::Pose;

namespace {

Eigen::Vector2d planar(const Pose& pose) {
  return pose.position.head<2>();
}

}  // namespace

std::optional<PathEnd> PathEnds::start(Plan& failure) const {
  const Eigen::Vector2d position = planar(request_.start);
  const std::optional<Cell> cell = costs_.geometry().cellAt(position);
  if (!cell) {
    failure.status = Status::START_OUTSIDE_MAP;
    failure.message = "start " + positionText(position) + outsideMap();
    return std::nullopt;
  }
  if (costs_.passable(*cell)) return PathEnd{*cell, position, "", false};

  const std::optional<PathEnd> escape =
      escapeStart([this](Cell other) { return costs_.passable(other); });
  if (escape) return escape;
  const double radius = options_.start_escape_radius;
  failure.status = Status::START_OCCUPIED;
  failure.message = "start " + positionText(position) + " " + whyBlocked(*cell);
  if (radius > 0.0) failure.message += ", with no passable cell within " + metresText(radius);
  return std::nullopt;
}

// The nearest cell within start_escape_radius of which `usable` holds.
template <class Usable>
std::optional<PathEnd> PathEnds::escapeStart(Usable&& usable) const {
  const Eigen::Vector2d position = planar(request_.start);
  const double radius = options_.start_escape_radius;
  if (radius <= 0.0) return std::nullopt;
  const auto nearest = nearestCell(costs_.geometry(), position, radius, usable);
  if (!nearest) return std::nullopt;
  return PathEnd{nearest->cell, position,
                 "start " + whyBlocked(*costs_.geometry().cellAt(position)) +
                     ": the path leaves it for a passable cell " + metresText(nearest->distance) +
                     " away",
                 true};
}

std::optional<PathEnd> PathEnds::escapeTowards(const PathEnd& goal) const {
  const std::vector<std::uint8_t> reached =
      search_.reachable(goal.cell, options_.retry_finer, stop_);
  return escapeStart(
      [&](Cell cell) { return reached[costs_.geometry().index(cell).value()] != 0; });
}

std::optional<PathEnd> PathEnds::goal(const PathEnd& start, Plan& failure) const {
  const Eigen::Vector2d position = planar(request_.goal);
  const std::optional<Cell> cell = costs_.geometry().cellAt(position);
  if (!cell) {
    failure.status = Status::GOAL_OUTSIDE_MAP;
    failure.message = "goal " + positionText(position) + outsideMap();
    return std::nullopt;
  }
  if (costs_.passable(*cell)) return PathEnd{*cell, position, "", false};

  const double tolerance = options_.tolerance;
  if (tolerance > 0.0) {
    const std::optional<PathEnd> substitute = substituteGoal(start, whyBlocked(*cell));
    if (substitute) return substitute;
  }
  failure.status = Status::GOAL_OCCUPIED;
  failure.message = "goal " + positionText(position) + " " + whyBlocked(*cell);
  if (tolerance > 0.0)
    failure.message += ", with no reachable cell within the tolerance of " + metresText(tolerance);
  return std::nullopt;
}

std::optional<PathEnd> PathEnds::substituteGoal(const PathEnd& start,
                                                const std::string& why) const {
  const std::vector<std::uint8_t> reached =
      search_.reachable(start.cell, options_.retry_finer, stop_);
  const GridGeometry& geometry = costs_.geometry();
  const auto nearest =
      nearestCell(geometry, planar(request_.goal), options_.tolerance,
                  [&](Cell cell) { return reached[geometry.index(cell).value()] != 0; });
  if (!nearest) return std::nullopt;
  return PathEnd{nearest->cell, geometry.centre(nearest->cell),
                 "goal " + why + ": the path ends " + metresText(nearest->distance) + " from it",
                 true};
}

std::string PathEnds::whyBlocked(Cell cell) const {
  const CostmapOptions& costmap = options_.costmap;
  switch (costs_.occupancy(cell)) {
    case Occupancy::OCCUPIED:
      if (!costmap.occupied_is_passable) return "is in an occupied cell";
      break;
    case Occupancy::UNKNOWN:
      if (!costmap.unknown_is_passable)
        return "is in an unknown cell and unknown_is_passable is false";
      break;
    case Occupancy::FREE:
      break;
  }
  return "is nearer than the radius of " + metresText(costmap.radius) + " to an occupied cell";
}

std::string PathEnds::outsideMap() const {
  const GridGeometry& geometry = costs_.geometry();
  std::ostringstream out;
  out << " lies outside the map of " << geometry.width() << 'x' << geometry.height() << " cells of "
      << geometry.resolution() << " m from "
      << positionText({geometry.origin().x, geometry.origin().y});
  return out.str();
}

}  // namespace grid_path_planner::planning
