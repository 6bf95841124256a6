#include "planning/path_ends.h"

#include <algorithm>
#include <sstream>
#include <vector>

#include "grid_path_planner/planning/nearest_cell.h"
#include "planning/message_text.h"
#include "planning/start_escape.h"

namespace grid_path_planner::planning {

using base::Status, base::StopPoll;
using costmap::CostmapOptions, costmap::KeptDistances;
using grid::Cell, grid::GridGeometry, grid::Occupancy;
using path::Pose;

namespace {

// How far the cell may be that a path's end is joined to, where the end's own centre is not in sight.
constexpr double kCellsAround = 2.0;

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
  const bool passable = costs_.passable(*cell);
  if (passable && !segments_.measured()) return PathEnd{*cell, position, "", false};
  if (segments_.measured() && !closed(costs_.occupancy(*cell))) {
    if (const auto measured = measuredStart(position)) return measured;
  }
  const std::optional<PathEnd> escape =
      escapeStart([this](Cell other) { return costs_.passable(other); });
  if (escape) return escape;
  failure.status = Status::START_OCCUPIED;
  failure.message =
      "start " + positionText(position) + " " +
      (passable ? "is nearer to obstacles than every straight line away from it allows"
                : whyBlocked(*cell)) +
      (options_.start_escape_radius > 0.0 ? noEscapeText(position) : escapeText(position));
  return std::nullopt;
}

// That no line within start_escape_radius leads out.
std::string PathEnds::noEscapeText(const Eigen::Vector2d& position) const {
  const double radius = options_.start_escape_radius;
  const std::string lines = StartEscape(costs_, leastDistances(), position, radius, stop_).text();
  return ", with no passable cell within the start_escape_radius of " + metresText(radius) +
         (lines.empty() ? "" : " on a straight line that " + lines);
}

// What start_escape_radius a start needs that only keeps too little distance; empty for others.
std::string PathEnds::escapeText(const Eigen::Vector2d& position) const {
  if (closed(costs_.occupancy(*costs_.geometry().cellAt(position)))) return "";
  const KeptDistances kept = costs_.keptDistances();
  const auto nearest =
      nearestEscape(position, 2.0 * std::max({kept.occupied, kept.unknown, kept.outside}),
                    [this](Cell cell) { return costs_.passable(cell); });
  if (!nearest) return "";
  return "; the nearest passable cell is " + metresText(nearest->length) +
         " away, which a start_escape_radius of no less allows";
}

// What a start is judged by that is nearer, or in one: as kept, and nothing closed is entered.
KeptDistances PathEnds::leastDistances() const {
  KeptDistances least = costs_.keptDistances();
  if (closed(Occupancy::OCCUPIED))
    least.occupied = std::max(least.occupied, options_.costmap.radius);
  if (closed(Occupancy::UNKNOWN)) least.unknown = std::max(least.unknown, 0.0);
  return least;
}

// The nearest usable cell to which a line leads out of a start. Where there is none, as from the middle of a door
// of an even number of cells, the nearest point between the centres of two or four.
template <class Usable>
std::optional<PathEnds::Escape> PathEnds::nearestEscape(const Eigen::Vector2d& position,
                                                        double radius, Usable&& usable) const {
  const GridGeometry& geometry = costs_.geometry();
  const StartEscape escape(costs_, leastDistances(), position, radius, stop_);
  StopPoll poll(stop_, 64);
  std::optional<Escape> nearest;
  for (const Cell& other : {Cell{0, 0}, Cell{1, 0}, Cell{0, 1}, Cell{1, 1}}) {
    const Eigen::Vector2d corner(0.5 * other.column, 0.5 * other.row);
    const Eigen::Vector2d origin = geometry.worldFromGrid(corner);
    const GridGeometry between(geometry.width(), geometry.height(), geometry.resolution(),
                               {origin.x(), origin.y(), geometry.origin().yaw});
    const auto found = nearestCell(between, position, radius, [&](Cell cell) {
      for (const int column : {0, other.column})
        for (const int row : {0, other.row})
          if (!usable({cell.column + column, cell.row + row})) return false;
      poll();
      return escape.leads(between.centre(cell));
    });
    if (found && (!nearest || found->distance < nearest->length))
      nearest = Escape{found->cell, between.centre(found->cell), found->distance};
    if (nearest && other == Cell{0, 0}) break;
  }
  return nearest;
}

// The passable cell nearest a position to whose centre a straight line is legal: mostly its own.
template <class Legal>
std::optional<Cell> PathEnds::joinedCell(const Eigen::Vector2d& position, Legal&& legal) const {
  const GridGeometry& geometry = costs_.geometry();
  const auto joins = [&](Cell cell) {
    return costs_.passable(cell) && legal(geometry.centre(cell));
  };
  const std::optional<Cell> own = geometry.cellAt(position);
  if (own && joins(*own)) return own;
  const auto nearest = nearestCell(geometry, position, kCellsAround * geometry.resolution(), joins);
  return nearest ? std::optional<Cell>(nearest->cell) : std::nullopt;
}

// From a start in a cell of a class that is entered: none where every line to a centre near by comes nearer.
std::optional<PathEnd> PathEnds::measuredStart(const Eigen::Vector2d& position) const {
  const auto cell = joinedCell(position, [&](const Eigen::Vector2d& centre) {
    return segments_.leavesStart(position, centre);
  });
  if (!cell) return std::nullopt;
  const std::string near = tooNear(position);
  return PathEnd{*cell, position, near.empty() ? "" : "the start " + near, false};
}

// At a goal in a passable cell.
std::optional<PathEnd> PathEnds::measuredGoal(const Eigen::Vector2d& position,
                                              std::string& why) const {
  why = tooNear(position);
  if (!why.empty()) return std::nullopt;
  const auto cell = joinedCell(
      position, [&](const Eigen::Vector2d& centre) { return segments_.keeps(centre, position); });
  if (cell) return PathEnd{*cell, position, "", false};
  why = "lies where no straight line leads to it at the distances that are kept";
  return std::nullopt;
}

// The nearest cell within start_escape_radius of which `usable` holds, and to which a line leads out.
template <class Usable>
std::optional<PathEnd> PathEnds::escapeStart(Usable&& usable) const {
  const Eigen::Vector2d position = planar(request_.start);
  const double radius = options_.start_escape_radius;
  if (radius <= 0.0) return std::nullopt;
  const auto nearest = nearestEscape(position, radius, usable);
  if (!nearest) return std::nullopt;
  return PathEnd{nearest->cell, position,
                 "start " + whyBlocked(*costs_.geometry().cellAt(position)) +
                     ": the path leaves it for a passable cell " + metresText(nearest->length) +
                     " away",
                 true, nearest->point};
}

std::optional<PathEnd> PathEnds::escapeTowards(const PathEnd& goal) const {
  const std::vector<std::uint8_t> reached =
      search_.reachable(goal.cell, options_.retry_finer, stop_);
  return escapeStart([&](Cell cell) {
    return costs_.passable(cell) && reached[costs_.geometry().index(cell).value()] != 0;
  });
}

std::optional<PathEnd> PathEnds::goal(const PathEnd& start, Plan& failure) const {
  const Eigen::Vector2d position = planar(request_.goal);
  const std::optional<Cell> cell = costs_.geometry().cellAt(position);
  if (!cell) {
    // As move_base's clients have it, who ask for places at the border of what is known.
    const auto beside =
        nearestCell(costs_.geometry(), position, options_.tolerance, [](Cell) { return true; });
    if (beside) {
      if (const auto substitute = substituteGoal(start, "is outside the map")) return substitute;
    }
    failure.status = Status::GOAL_OUTSIDE_MAP;
    failure.message = "goal " + positionText(position) + outsideMap();
    return std::nullopt;
  }
  std::string why = costs_.passable(*cell) ? complaintAt(position) : whyBlocked(*cell);
  if (why.empty()) {
    if (!segments_.measured()) return PathEnd{*cell, position, "", false};
    if (const auto measured = measuredGoal(position, why)) return measured;
  }

  const double tolerance = options_.tolerance;
  if (tolerance > 0.0) {
    const std::optional<PathEnd> substitute = substituteGoal(start, why);
    if (substitute) return substitute;
  }
  failure.status = Status::GOAL_OCCUPIED;
  failure.message = "goal " + positionText(position) + " " + why;
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
      nearestCell(geometry, planar(request_.goal), options_.tolerance, [&](Cell cell) {
        return reached[geometry.index(cell).value()] != 0 &&
               complaintAt(geometry.centre(cell)).empty();
      });
  if (!nearest) return std::nullopt;
  return PathEnd{nearest->cell, geometry.centre(nearest->cell),
                 "goal " + why + ": the path ends " + metresText(nearest->distance) + " from it",
                 true};
}

std::string PathEnds::complaintAt(const Eigen::Vector2d& position) const {
  if (!complaint_ || request_.any_goal_heading) return "";
  Pose pose = request_.goal;
  pose.position.head<2>() = position;
  return complaint_(pose);
}

// Whether cells of the class are not entered, however far others are.
bool PathEnds::closed(Occupancy occupancy) const {
  const CostmapOptions& costmap = options_.costmap;
  return (occupancy == Occupancy::OCCUPIED && !costmap.occupied_is_passable) ||
         (occupancy == Occupancy::UNKNOWN && !costmap.unknown_is_passable);
}

std::string PathEnds::whyBlocked(Cell cell) const {
  const Occupancy occupancy = costs_.occupancy(cell);
  if (closed(occupancy))
    return occupancy == Occupancy::OCCUPIED
               ? "is in an occupied cell"
               : "is in an unknown cell and unknown_is_passable is false";
  const KeptDistances kept = costs_.keptDistances();
  const KeptDistances own = segments_.at(costs_.geometry().centre(cell));
  const bool of_occupied = own.occupied < kept.occupied;
  if (!of_occupied && own.unknown < kept.unknown)
    return "is nearer than the radius_to_unknown of " + metresText(kept.unknown) +
           " to an unknown cell";
  if (!of_occupied && own.outside < kept.outside)
    return "is nearer than " + metresText(kept.outside) + " to the border of the map";
  return "is nearer than the radius of " + metresText(options_.costmap.radius) +
         " to an occupied cell";
}

std::string PathEnds::tooNear(const Eigen::Vector2d& position) const {
  const KeptDistances kept = costs_.keptDistances();
  const KeptDistances own = segments_.at(position);
  if (own.occupied < kept.occupied)
    return "is " + metresText(own.occupied) + " from an occupied cell, nearer than the radius of " +
           metresText(kept.occupied);
  if (own.unknown < kept.unknown)
    return "is " + metresText(own.unknown) +
           " from an unknown cell, nearer than the radius_to_unknown of " +
           metresText(kept.unknown);
  if (own.outside < kept.outside)
    return "is " + metresText(own.outside) + " from the border of the map, nearer than the " +
           metresText(kept.outside) + " that outside keeps";
  return "";
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
