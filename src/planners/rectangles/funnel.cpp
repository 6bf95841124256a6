#include "planners/rectangles/funnel.h"

#include <array>

namespace grid_path_planner::planners {

using costmap::CostGrid;
using costmap::SegmentPoint;
using costmap::waypointOf;
using grid::Cell;
using grid::CellRect;

namespace {

constexpr std::int64_t kUnit = SegmentPoint::kUnitsPerCell;

// A border, with its ends as seen in the direction in which the path crosses it.
struct Opening {
  SegmentPoint left;
  SegmentPoint right;
};

Opening openingOf(const CellRect& from, const Connection& step) {
  const bool upright = step.side == Side::EAST || step.side == Side::WEST;
  const int line = step.side == Side::EAST    ? from.column + from.width
                   : step.side == Side::WEST  ? from.column
                   : step.side == Side::NORTH ? from.row + from.height
                                              : from.row;
  const auto point = [upright, line](int along) {
    return upright ? SegmentPoint{line * kUnit, along * kUnit}
                   : SegmentPoint{along * kUnit, line * kUnit};
  };
  const SegmentPoint low = point(step.first), high = point(step.first + step.length);
  // Eastwards the greater row is on the left, northwards the smaller column.
  const bool high_is_left = step.side == Side::EAST || step.side == Side::SOUTH;
  return high_is_left ? Opening{high, low} : Opening{low, high};
}

// The centres of the border's cells on the side of the rectangle, and beyond.
std::array<Opening, 2> openingsBetweenCentres(const CostGrid& lattice, const CellRect& from,
                                              const Connection& step) {
  const bool upright = step.side == Side::EAST || step.side == Side::WEST;
  const bool ahead = step.side == Side::EAST || step.side == Side::NORTH;
  const int nearest = upright ? from.column : from.row;
  const int line = ahead ? nearest + (upright ? from.width : from.height) - 1 : nearest;
  const bool high_is_left = step.side == Side::EAST || step.side == Side::SOUTH;
  const auto opening = [&](int at) {
    const auto point = [&](int along) {
      return waypointOf(lattice, upright ? Cell{at, along} : Cell{along, at});
    };
    const SegmentPoint low = point(step.first), high = point(step.first + step.length - 1);
    return high_is_left ? Opening{high, low} : Opening{low, high};
  };
  return {opening(line), opening(ahead ? line + 1 : line - 1)};
}

std::vector<Opening> openingsOf(const RectangleGraph& map, const RectangleRoute& route,
                                SegmentPoint goal, const CostGrid* lattice) {
  std::vector<Opening> openings;
  std::uint32_t rectangle = route.first;
  for (const Connection& step : route.steps) {
    const CellRect& from = map.rectangles()[rectangle];
    if (lattice)
      for (const Opening& opening : openingsBetweenCentres(*lattice, from, step))
        openings.push_back(opening);
    else
      openings.push_back(openingOf(from, step));
    rectangle = step.to;
  }
  openings.push_back({goal, goal});
  return openings;
}

// Positive where c lies to the left of the ray from a through b.
std::int64_t turn(SegmentPoint a, SegmentPoint b, SegmentPoint c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

}  // namespace

std::vector<SegmentPoint> shortestThrough(const RectangleGraph& map, const RectangleRoute& route,
                                          SegmentPoint start, SegmentPoint goal,
                                          const CostGrid* lattice) {
  const std::vector<Opening> openings = openingsOf(map, route, goal, lattice);
  std::vector<SegmentPoint> points = {start};
  SegmentPoint left = start, right = start;
  std::size_t left_opening = 0, right_opening = 0;  // of the funnel's sides
  const auto turnAt = [&](SegmentPoint corner, std::size_t opening) {
    if (corner != points.back()) points.push_back(corner);
    left = right = corner;
    left_opening = right_opening = opening;
    return opening;
  };
  for (std::size_t i = 0; i < openings.size(); ++i) {
    const SegmentPoint apex = points.back();
    const Opening& next = openings[i];
    // A side that narrows the funnel is moved. Where it would cross the other side, the path turns
    // at that side, and the scan restarts at its opening.
    if (turn(apex, right, next.right) >= 0) {
      if (right != apex && turn(apex, left, next.right) >= 0) {
        i = turnAt(left, left_opening);
        continue;
      }
      right = next.right;
      right_opening = i;
    }
    if (turn(apex, left, next.left) <= 0) {
      if (left != apex && turn(apex, right, next.left) <= 0) {
        i = turnAt(right, right_opening);
        continue;
      }
      left = next.left;
      left_opening = i;
    }
  }
  if (points.back() != goal) points.push_back(goal);
  return points;
}

}  // namespace grid_path_planner::planners
